//! View factors between two plates over distance, beside the closed forms.
//!
//! `cargo run -p radiosity-form-factor --example plates [-- TOLERANCE]`
//!
//! Unit squares that face each other at distance d; a floor of depth 1 and a wall of height d that
//! meet along an edge of length 1; and the facing squares once more with a wall between them from
//! edge to edge, so that each half sees its own half alone. The tolerance is what is asked of each,
//! 1e-4 by default. Exit code 1 if a value is further from its closed form than it states.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::{FRAC_PI_4, PI};

use form_factor::{Estimate, Occluders, Polygon, between, between_occluded};
use glam::{DVec3, dvec3};

const DISTANCES: [f64; 9] = [0.01, 0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0];

/// Absolute: the closed forms' terms are at most about 2 and cancel; some tens of roundings of f64.
const ROUNDING: f64 = 1e-14;

fn main() -> Result<(), Box<dyn Error>> {
    let tolerance: f64 = match std::env::args().nth(1) {
        Some(text) => text.parse().map_err(|error| format!("tolerance {text}: {error}"))?,
        None => 1e-4,
    };
    println!("distance  {:21}  {:21}  facing, wall between", "facing", "meeting");
    let mut wrong = 0;
    for d in DISTANCES {
        let floor = rectangle(DVec3::ZERO, DVec3::X, DVec3::Y)?;
        let facing = rectangle(DVec3::Z * d, DVec3::Y, DVec3::X)?;
        let meeting = rectangle(DVec3::ZERO, DVec3::Y, DVec3::Z * d)?;
        // At x = 1/2, from edge to edge and from plate to plate.
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, d), (0.0, d)];
        let [p, q, r, s] = corners.map(|(y, z)| dvec3(0.5, y, z));
        let wall = Occluders::build(&[[p, q, r], [p, r, s]]);

        let cells = [
            (between(&floor, &facing, tolerance), parallel(1.0, 1.0, d)),
            (between(&floor, &meeting, tolerance), perpendicular(d)),
            (between_occluded(&floor, &facing, &wall, tolerance), parallel(0.5, 1.0, d)),
        ];
        let mut row = format!("{d:>8}");
        for (Estimate { value, error, .. }, exact) in cells {
            // What the closed form itself rounds away grows where it divides by a small area.
            if (value - exact).abs() > error + ROUNDING * (1.0 + d * d) {
                wrong += 1;
                row += " wrong:";
            }
            row += &format!("  {value:.10} ± {:<6}", format!("{error:.0e}"));
        }
        println!("{}", row.trim_end());
    }
    match wrong {
        0 => Ok(()),
        n => Err(format!("{n} values are further off than they state").into()),
    }
}

/// The rectangle from `corner` along `u` and `v`, which faces u × v.
fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> Result<Polygon, Box<dyn Error>> {
    let corners = [corner, corner + u, corner + u + v, corner + v];
    Polygon::new(&corners).ok_or_else(|| format!("no rectangle: {corners:?}").into())
}

/// Equal, parallel, directly opposed rectangles a × b at distance c (Howell, *A Catalog of
/// Radiation Heat Transfer Configuration Factors*, C-11).
fn parallel(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (p, q) = (1.0 + x * x, 1.0 + y * y);
    // ln_1p, since the logarithm's argument comes close to 1 for far plates.
    let logarithm = 0.5 * (x * x * y * y / (p + y * y)).ln_1p();
    let arcs = x * q.sqrt() * (x / q.sqrt()).atan() + y * p.sqrt() * (y / p.sqrt()).atan()
        - x * x.atan()
        - y * y.atan();
    2.0 / (PI * x * y) * (logarithm + arcs)
}

/// From a rectangle of depth 1 to one of height h at a right angle, common edge 1 (Howell, C-14).
fn perpendicular(h: f64) -> f64 {
    let (hh, s) = (h * h, (1.0 + h * h).sqrt());
    let logarithm = 0.25
        * ((2.0 * (1.0 + hh) / (2.0 + hh)).ln()
            + ((2.0 + hh) / (2.0 * (1.0 + hh))).ln()
            + hh * (hh * (2.0 + hh) / ((1.0 + hh) * (1.0 + hh))).ln());
    (FRAC_PI_4 + h * (1.0 / h).atan() - s * (1.0 / s).atan() + logarithm) / PI
}
