//! The same bits on any number of threads, with any loop, every time.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use radiosity_core::{Executor, Sequential};
use radiosity_par::{Loop, Pool};

mod support;

use support::Room;

#[test]
fn on_1_to_24_threads_with_every_loop_again_and_again() {
    let room = Room::with_elements(4000);
    let expected = room.solve(&Sequential);
    assert!(expected.rays > 100_000, "the test must have work to share out");
    for threads in [1, 2, 3, 5, 8, 24] {
        for schedule in ["static", "dynamic:1", "dynamic:3", "guided:1", "tasks"] {
            let pool = Pool::with_loop(threads, schedule.parse::<Loop>().unwrap()).unwrap();
            assert_eq!(pool.threads(), threads);
            for run in 1..=2 {
                assert!(room.solve(&pool) == expected, "{pool:?}, run {run}");
            }
        }
    }
}

#[test]
fn zero_asks_for_all_the_machine_has() {
    let available = std::thread::available_parallelism().unwrap().get();
    assert_eq!(Pool::new(0).unwrap().threads(), available);
}

#[test]
fn the_callers_own_pool_stays_untouched() {
    // Items run on threads that bear our name.
    for schedule in ["static", "dynamic:1", "guided:1", "tasks"] {
        let names = std::sync::Mutex::new(Vec::new());
        let mut items = [(); 64];
        Pool::with_loop(2, schedule.parse().unwrap()).unwrap().for_each(&mut items, |()| {
            let name = std::thread::current().name().unwrap_or("").to_owned();
            names.lock().unwrap().push(name);
        });
        let names = names.into_inner().unwrap();
        assert!(names.iter().all(|n| n.starts_with("radiosity-")), "{schedule}: {names:?}");
    }
}
