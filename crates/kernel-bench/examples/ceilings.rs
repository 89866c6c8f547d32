//! What this machine can do at most: bytes and arithmetic, on one core and on all.
//!
//! ```sh
//! cargo run --release -p kernel-bench --example ceilings
//! RUSTFLAGS="-C target-cpu=native" cargo run --release -p kernel-bench --example ceilings
//! ```
//!
//! The first is compiled as the program is, for plain x86-64; the second for this processor, with all
//! its lanes.
//!
//! # References
//! J. D. McCalpin, "Memory Bandwidth and Machine Balance in Current High Performance Computers",
//! IEEE TCCA Newsletter (1995): the triad a = b + s·c, counted as three arrays.

#![allow(clippy::print_stdout, reason = "a program for the terminal")]

use std::hint::black_box;
use std::sync::Barrier;
use std::thread;
use std::time::Instant;

/// Numbers of an array of the triad: 64 MB, more than any cache of a core.
const LONG: usize = 8 << 20;

/// Numbers of an array that stays in a core's own cache: 8 kB, three of them.
const SHORT: usize = 1 << 10;

/// Numbers of 64 bits in a vector of the widest kind that this is compiled for.
const LANES: usize = if cfg!(target_feature = "avx512f") {
    8
} else if cfg!(target_feature = "avx") {
    4
} else {
    2
};

/// Vectors whose chains of additions and multiplications do not wait for each other: two pipes, four
/// or five steps deep, and few enough for sixteen registers.
const VECTORS: usize = 12;

/// The best of so many readings counts.
const READINGS: usize = 7;

fn main() {
    let cores = thread::available_parallelism().map_or(1, std::num::NonZero::get);
    println!("| | 1 thread | {cores} threads |\n|---|---|---|");
    let row = |name: &str, work: &(dyn Fn() -> f64 + Sync)| {
        println!("| {name} | {:.1} | {:.1} |", best(1, work), best(cores, work));
    };
    row("triad in memory, GB/s", &|| triad(LONG, 4));
    row("triad in cache, GB/s", &|| triad(SHORT, 200_000));
    row("f64, Gflop/s", &|| arithmetic::<_, { VECTORS * LANES }>(1.0_f64, 1e-9));
    row("f32, Gflop/s", &|| arithmetic::<_, { 2 * VECTORS * LANES }>(1.0_f32, 1e-6));
}

/// The most that `threads` do at once, of several readings: units of 1e9 a second.
fn best(threads: usize, work: &(dyn Fn() -> f64 + Sync)) -> f64 {
    let reading = || {
        let barrier = Barrier::new(threads);
        let rates = thread::scope(|scope| {
            let run = || {
                scope.spawn(|| {
                    barrier.wait();
                    work()
                })
            };
            let running: Vec<_> = (0..threads).map(|_| run()).collect();
            let rates = running.into_iter().map(|t| t.join().expect("nothing in it panics"));
            rates.sum::<f64>()
        });
        rates / 1e9
    };
    (0..READINGS).map(|_| reading()).fold(0.0, f64::max)
}

/// Bytes a second of `rounds` triads over arrays of `length` numbers.
fn triad(length: usize, rounds: usize) -> f64 {
    let (mut a, b, c) = (vec![0.0_f64; length], vec![1.0; length], vec![2.0; length]);
    let clock = Instant::now();
    for round in 0..rounds {
        let factor = black_box(round as f64);
        for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
            *a = b + factor * c;
        }
        black_box(&mut a);
    }
    (3 * size_of::<f64>() * length * rounds) as f64 / clock.elapsed().as_secs_f64()
}

/// A number of either width.
trait Number: Copy {
    fn multiply_add(self, factor: Self, summand: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn multiply_add(self, factor: Self, summand: Self) -> Self {
        if cfg!(target_feature = "fma") {
            self.mul_add(factor, summand)
        } else {
            self * factor + summand
        }
    }
}

impl Number for f32 {
    #[inline(always)]
    fn multiply_add(self, factor: Self, summand: Self) -> Self {
        if cfg!(target_feature = "fma") {
            self.mul_add(factor, summand)
        } else {
            self * factor + summand
        }
    }
}

/// Additions and multiplications a second, in chains within registers.
fn arithmetic<T: Number, const CHAINS: usize>(factor: T, summand: T) -> f64 {
    const ROUNDS: usize = 4_000_000;
    let (factor, summand) = (black_box(factor), black_box(summand));
    let mut chains = [summand; CHAINS];
    let clock = Instant::now();
    for _ in 0..ROUNDS {
        for chain in &mut chains {
            *chain = chain.multiply_add(factor, summand);
        }
    }
    black_box(&mut chains);
    (2 * CHAINS * ROUNDS) as f64 / clock.elapsed().as_secs_f64()
}
