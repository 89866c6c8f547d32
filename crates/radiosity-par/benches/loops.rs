//! The loops compared, and what false sharing costs: the tables of the crate's README.

#![expect(clippy::unwrap_used, reason = "a bench that cannot go on may panic")]

use std::hint::black_box;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use radiosity_core::Executor;
use radiosity_par::Pool;

#[path = "../tests/support/mod.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod support;

use support::Room;

/// A sum of inverse squares, about 1 ns a term: nothing but arithmetic in registers.
fn work(terms: u64) -> f64 {
    (1..=black_box(terms)).map(|i| 1.0 / (i * i) as f64).sum()
}

/// An item that knows what it costs, on cache lines of its own.
#[derive(Clone, Copy)]
#[repr(align(128))]
struct Item {
    terms: u64,
    sum: f64,
}

impl Item {
    fn run(&mut self) {
        self.sum = work(self.terms);
    }
}

fn items(len: usize, terms: u64) -> Vec<Item> {
    vec![Item { terms, sum: 0.0 }; len]
}

/// One thread for comparison, then each loop on two.
fn pools(chunk: usize) -> Vec<(String, Pool)> {
    let mut pools = vec![("one thread".to_owned(), Pool::new(1).unwrap())];
    let (dynamic, guided) = (format!("dynamic:{chunk}"), format!("guided:{chunk}"));
    for schedule in ["static", &dynamic, &guided, "tasks"] {
        pools.push((schedule.to_owned(), Pool::with_loop(2, schedule.parse().unwrap()).unwrap()));
    }
    pools
}

fn compare(criterion: &mut Criterion, name: &str, chunk: usize, items: &mut [Item]) {
    let mut group = criterion.benchmark_group(name);
    for (schedule, pool) in pools(chunk) {
        group.bench_function(schedule, |bencher| {
            bencher.iter(|| pool.for_each(items, Item::run));
        });
    }
}

/// A round with nothing to do: what a loop itself costs, one after the other, and then with
/// so much of the caller's own work between them that the threads fall asleep.
fn round(criterion: &mut Criterion) {
    let mut items = items(16, 0);
    compare(criterion, "round/awake", 1, &mut items);
    let mut group = criterion.benchmark_group("round/asleep");
    for (schedule, pool) in pools(1) {
        group.bench_function(schedule, |bencher| {
            bencher.iter_custom(|rounds| {
                let round = |_| {
                    black_box(work(200_000));
                    let start = Instant::now();
                    pool.for_each(&mut items, Item::run);
                    start.elapsed()
                };
                (0..rounds).map(round).sum()
            });
        });
    }
}

fn even(criterion: &mut Criterion) {
    compare(criterion, "even", 1, &mut items(256, 4_000));
}

/// One item costs as much as all others: two threads can halve the time, no more.
fn uneven(criterion: &mut Criterion) {
    for (name, place) in [("uneven/first", 0), ("uneven/last", 255)] {
        let mut items = items(256, 4_000);
        items[place].terms *= 255;
        compare(criterion, name, 1, &mut items);
    }
}

/// Items of 8 bytes and a few ns, so that neighbours share a cache line.
fn tiny(criterion: &mut Criterion) {
    let mut items = vec![1.0_f64; 100_000];
    for (name, chunk) in [("tiny/chunk 1", 1), ("tiny/chunk 256", 256)] {
        let mut group = criterion.benchmark_group(name);
        for (schedule, pool) in pools(chunk) {
            group.bench_function(schedule, |bencher| {
                bencher.iter(|| pool.for_each(&mut items, |x| *x = (*x + 1.0).sqrt()));
            });
        }
    }
}

/// The rounds as the solver has them: about 1000, of 46 uneven items on average.
fn shooting(criterion: &mut Criterion) {
    let room = Room::with_elements(30_000);
    let mut group = criterion.benchmark_group("shooting");
    group.sample_size(10);
    for (schedule, pool) in pools(1) {
        group.bench_function(schedule, |bencher| bencher.iter(|| room.solve(&pool)));
    }
}

/// Two counters on one cache line.
#[derive(Default)]
#[repr(align(128))]
struct SideBySide([AtomicU64; 2]);

/// A counter on lines of its own: 128 bytes, since processors fetch lines of 64 in pairs.
#[derive(Default)]
#[repr(align(128))]
struct Padded(AtomicU64);

/// Adds need the line to themselves, one by one; plain stores could hide it in their buffer.
fn count(counter: &AtomicU64) {
    for _ in 0..100_000 {
        counter.fetch_add(1, Ordering::Relaxed);
    }
}

fn counters(criterion: &mut Criterion) {
    // Static, so that each counter has a thread of its own.
    let pool = Pool::with_loop(2, radiosity_par::Loop::Static).unwrap();
    let mut group = criterion.benchmark_group("counters");
    let SideBySide(counters) = &SideBySide::default();
    let mut both = [&counters[0], &counters[1]];
    group.bench_function("side by side", |bencher| {
        bencher.iter(|| pool.for_each(&mut both, |counter| count(counter)));
    });
    let (a, b) = (Padded::default(), Padded::default());
    let mut both = [&a.0, &b.0];
    group.bench_function("padded", |bencher| {
        bencher.iter(|| pool.for_each(&mut both, |counter| count(counter)));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600));
    targets = round, even, uneven, tiny, shooting, counters
}
criterion_main!(benches);
