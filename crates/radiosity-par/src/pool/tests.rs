//! Every loop visits every item once, whoever calls it and whatever happens inside.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Condvar, Mutex};
use std::time::Duration;

use super::*;

fn loops() -> impl Iterator<Item = Loop> {
    let texts = ["static", "dynamic:1", "dynamic:3", "guided:1", "guided:4", "tasks"];
    texts.into_iter().map(|text| text.parse().unwrap())
}

fn pools(threads: &[usize]) -> impl Iterator<Item = Pool> {
    threads.iter().flat_map(|&n| loops().map(move |l| Pool::with_loop(n, l).unwrap()))
}

fn pool(threads: usize, schedule: &str) -> Pool {
    Pool::with_loop(threads, schedule.parse().unwrap()).unwrap()
}

/// The number of the pool's thread this runs on.
fn thread_number() -> Option<usize> {
    std::thread::current().name()?.strip_prefix("radiosity-")?.parse().ok()
}

/// The thread that visited each of `len` items.
fn visitors(pool: &Pool, len: usize) -> Vec<Option<usize>> {
    let mut items = vec![None; len];
    pool.for_each(&mut items, |item| *item = thread_number());
    items
}

/// The thread that visited each of `len` items, where the first item ends only when `others`
/// other items have.
fn visitors_while_the_first_waits(pool: &Pool, len: usize, others: usize) -> Vec<usize> {
    // Far longer than the empty items can take; reached only if the loop is wrong.
    const PATIENCE: Duration = Duration::from_secs(30);
    let (done, changed) = (Mutex::new(0), Condvar::new());
    let mut items: Vec<_> = (0..len).map(|i| (i, None)).collect();
    pool.for_each(&mut items, |(i, visitor)| {
        *visitor = thread_number();
        let mut done = done.lock().unwrap();
        if *i == 0 {
            let waits = |done: &mut usize| *done < others;
            done = changed.wait_timeout_while(done, PATIENCE, waits).unwrap().0;
            assert_eq!(*done, others, "{pool:?}: items wait behind a busy thread");
        }
        *done += 1;
        changed.notify_all();
    });
    items.into_iter().map(|(_, visitor)| visitor.unwrap()).collect()
}

#[test]
fn each_item_is_visited_once() {
    for pool in pools(&[1, 2, 3, 5, 8, 24]) {
        for len in [0, 1, 2, 7, 1000] {
            let mut visits = vec![0; len];
            pool.for_each(&mut visits, |n| *n += 1);
            assert_eq!(visits, vec![1; len], "{pool:?}");
        }
    }
}

#[test]
fn items_without_size_are_visited_once_too() {
    for pool in pools(&[3]) {
        let visits = Mutex::new(0);
        pool.for_each(&mut [(); 100], |()| *visits.lock().unwrap() += 1);
        assert_eq!(visits.into_inner().unwrap(), 100, "{pool:?}");
    }
}

#[test]
fn a_loop_within_a_loop_of_the_same_pool() {
    for pool in pools(&[1, 2, 3, 8]) {
        let mut rows = vec![vec![0; 37]; 19];
        for round in 1..=5 {
            pool.for_each(&mut rows, |row| pool.for_each(row, |n| *n += 1));
            assert_eq!(rows, vec![vec![round; 37]; 19], "{pool:?}");
        }
    }
}

#[test]
fn a_loop_within_a_loop_of_another_pool() {
    for outer in pools(&[2, 3]) {
        for inner in pools(&[3]) {
            let mut rows = vec![vec![0; 17]; 9];
            outer.for_each(&mut rows, |row| inner.for_each(row, |n| *n += 1));
            assert_eq!(rows, vec![vec![1; 17]; 9], "{inner:?} within {outer:?}");
        }
    }
}

#[test]
fn several_threads_use_one_pool_at_once() {
    for pool in pools(&[1, 2, 3, 8]) {
        std::thread::scope(|scope| {
            for caller in 0..4 {
                let pool = &pool;
                scope.spawn(move || {
                    let mut visits = vec![0; 50 + caller];
                    for round in 1..=20 {
                        pool.for_each(&mut visits, |n| *n += 1);
                        assert!(visits.iter().all(|&n| n == round), "{pool:?}: {visits:?}");
                    }
                });
            }
        });
    }
}

#[test]
fn a_panic_comes_back_and_leaves_the_pool_usable() {
    for pool in pools(&[1, 2, 3, 8]) {
        for bad in [0, 5, 99] {
            let mut items: Vec<usize> = (0..100).collect();
            let run = || {
                // `resume_unwind` says nothing on the terminal.
                pool.for_each(&mut items, |&mut n| {
                    if n == bad {
                        std::panic::resume_unwind(Box::new(n));
                    }
                });
            };
            let panic = catch_unwind(AssertUnwindSafe(run)).expect_err("an item panics");
            assert_eq!(panic.downcast_ref(), Some(&bad), "{pool:?}");
        }
        let mut visits = vec![0; 100];
        pool.for_each(&mut visits, |n| *n += 1);
        assert_eq!(visits, vec![1; 100], "{pool:?}");
    }
}

#[test]
fn a_panic_on_every_thread_comes_back_once() {
    for pool in pools(&[2, 8]) {
        let mut items = vec![(); 100];
        let run = || pool.for_each(&mut items, |()| std::panic::resume_unwind(Box::new("all")));
        let panic = catch_unwind(AssertUnwindSafe(run)).expect_err("every item panics");
        assert_eq!(panic.downcast_ref(), Some(&"all"), "{pool:?}");
    }
}

/// 10 items on 3 threads, by hand: 4, 3 and 3.
#[test]
fn static_gives_each_thread_one_share_always_the_same() {
    let pool = pool(3, "static");
    for _ in 0..20 {
        assert_eq!(visitors(&pool, 10), [0, 0, 0, 0, 1, 1, 1, 2, 2, 2].map(Some));
        assert_eq!(visitors(&pool, 2), [0, 1].map(Some));
    }
}

/// While one thread waits in the first item, the others take 993; 6 stay behind the first.
#[test]
fn dynamic_keeps_a_chunk_on_one_thread() {
    let visitors = visitors_while_the_first_waits(&pool(3, "dynamic:7"), 1000, 993);
    for chunk in visitors.chunks(7) {
        assert!(chunk.iter().all(|v| *v == chunk[0]), "{chunk:?}");
    }
}

/// A third of 999 items is the first chunk: 333 items, of which 332 stay behind the first.
#[test]
fn guided_begins_with_an_even_share() {
    let visitors = visitors_while_the_first_waits(&pool(3, "guided:1"), 999, 666);
    assert!(visitors[..333].iter().all(|v| *v == visitors[0]));
    assert!(visitors[333..].iter().all(|v| *v != visitors[0]));
}

#[test]
fn a_free_thread_takes_what_a_busy_one_cannot() {
    for schedule in ["dynamic:1", "tasks"] {
        let visitors = visitors_while_the_first_waits(&pool(2, schedule), 50, 49);
        assert!(visitors[1..].iter().all(|v| *v != visitors[0]), "{schedule}: {visitors:?}");
    }
}

#[test]
fn one_chunk_stays_with_the_caller() {
    for schedule in ["dynamic:10", "guided:10"] {
        let pool = pool(3, schedule);
        assert_eq!(visitors(&pool, 10), [None; 10], "{schedule}");
        assert!(visitors(&pool, 11).iter().all(Option::is_some), "{schedule}");
    }
}

#[test]
fn a_pool_says_what_it_is() {
    assert_eq!(Pool::new(2).unwrap().schedule(), Loop::default());
    assert_eq!(format!("{:?}", pool(2, "guided")), "Pool(2 threads, guided:1)");
}
