//! The four loops at work on something else than light: rows of the Mandelbrot set.
//!
//! `cargo run -p radiosity-par --example loops [-- THREADS]`
//!
//! Rows through the middle of the set cost some hundred times what those at its rim do, so shares of
//! equal length are not equal work: `static` waits for whoever got the middle. All loops must compute
//! the same counts, and those an area near the known one, 1.5065918849 (Förstemann 2012, by counting,
//! too); exit code 1 if not.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::time::Instant;

use radiosity_core::{Executor, Sequential};
use radiosity_par::{Loop, Pool};

/// Points of the grid in each direction, over [−2, 1/2] × [−5/4, 5/4].
const SIDE: usize = 256;
/// The grid's spacing.
const CELL: f64 = 2.5 / SIDE as f64;
/// Steps after which a point counts as one that stays.
const STEPS: u16 = 2000;
const AREA: f64 = 1.506_591_884_9;
/// Absolute: points that take longer than all steps to leave count as inside. Their area shrinks as
/// 1 / steps (0.0088 at 500), and comes to 0.0022; as much again for the grid.
const ALLOWED: f64 = 0.005;

/// One row: where it lies, and after how many steps each of its points leaves.
#[derive(Clone, PartialEq)]
struct Row {
    y: f64,
    steps: Vec<u16>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let threads = match std::env::args().nth(1) {
        Some(text) => text.parse().map_err(|error| format!("threads {text}: {error}"))?,
        None => 0,
    };
    let blank: Vec<Row> = (0..SIDE).map(|j| Row { y: at(j) - 1.25, steps: Vec::new() }).collect();
    let mut alone = blank.clone();
    timed("alone", || Sequential.for_each(&mut alone, fill));

    for name in ["static", "dynamic:4", "guided:2", "tasks"] {
        let pool = Pool::with_loop(threads, name.parse::<Loop>()?)?;
        let mut rows = blank.clone();
        timed(name, || pool.for_each(&mut rows, fill));
        if rows != alone {
            return Err(format!("{name} counts otherwise than one thread").into());
        }
    }
    let inside = alone.iter().flat_map(|row| &row.steps).filter(|steps| **steps == STEPS).count();
    let area = inside as f64 * CELL * CELL;
    println!("area {area:.4}, known to be {AREA:.4}");
    match (area - AREA).abs() <= ALLOWED {
        true => Ok(()),
        false => Err(format!("the area is not within {ALLOWED}").into()),
    }
}

fn timed(name: &str, work: impl FnOnce()) {
    let start = Instant::now();
    work();
    println!("{name:10} {:6.1} ms", 1e3 * start.elapsed().as_secs_f64());
}

/// The middle of cell k from the lower end.
fn at(k: usize) -> f64 {
    CELL * (k as f64 + 0.5)
}

fn fill(row: &mut Row) {
    row.steps = (0..SIDE).map(|i| steps(at(i) - 2.0, row.y)).collect();
}

/// Steps of z ← z² + c until |z| > 2.
fn steps(x: f64, y: f64) -> u16 {
    let (mut a, mut b) = (0.0, 0.0);
    for step in 0..STEPS {
        if a * a + b * b > 4.0 {
            return step;
        }
        (a, b) = (a * a - b * b + x, 2.0 * a * b + y);
    }
    STEPS
}
