//! Who gets which items: one function for each kind of loop.
//!
//! No lock is held while an item is worked on, so a panic there poisons nothing and a loop
//! within a loop waits for nobody's lock. Threads that find no items go to sleep.

use std::mem;
use std::sync::{Mutex, MutexGuard};

use rayon::ThreadPool;
use rayon::prelude::*;

/// Share i of the items to thread i.
pub(crate) fn shares<T: Send>(pool: &ThreadPool, items: &mut [T], f: impl Fn(&mut T) + Sync) {
    let threads = pool.current_num_threads();
    let (least, longer) = (items.len() / threads, items.len() % threads);
    let mut rest = items;
    let shares: Vec<_> = (0..threads)
        .map(|i| take(&mut rest, least + usize::from(i < longer)))
        .map(Mutex::new)
        .collect();
    // Each thread of the pool runs this once, wherever the others are.
    pool.broadcast(|thread| {
        let share = mem::take(&mut *lock(&shares[thread.index()]));
        share.iter_mut().for_each(&f);
    });
}

/// The next chunk to whoever comes for it; `size` says how long, given how many items are left.
pub(crate) fn chunks<T: Send>(
    pool: &ThreadPool,
    items: &mut [T],
    takers: usize,
    size: impl Fn(usize) -> usize + Sync,
    f: impl Fn(&mut T) + Sync,
) {
    let queue = Mutex::new(items);
    let take_turns = || {
        loop {
            let chunk = {
                let mut rest = lock(&queue);
                let size = size(rest.len());
                take(&mut rest, size)
            };
            if chunk.is_empty() {
                return;
            }
            chunk.iter_mut().for_each(&f);
        }
    };
    // Not a broadcast: a thread that is busy elsewhere is not waited for, and where there are
    // more threads than cores, those that are awake do the work of those that are not.
    pool.scope(|scope| {
        for _ in 1..takers {
            scope.spawn(|_| take_turns());
        }
        take_turns();
    });
}

/// Halves, as long as somebody has time for them.
pub(crate) fn halves<T: Send>(pool: &ThreadPool, items: &mut [T], f: impl Fn(&mut T) + Sync) {
    pool.install(|| items.par_iter_mut().with_max_len(1).for_each(&f));
}

/// How many items a guided loop hands out next.
pub(crate) fn guided(left: usize, threads: usize, least: usize) -> usize {
    (left / threads).max(least)
}

/// Takes up to `size` items off the front.
fn take<'a, T>(rest: &mut &'a mut [T], size: usize) -> &'a mut [T] {
    let size = size.min(rest.len());
    rest.split_off_mut(..size).expect("the size is at most the length")
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().expect("whoever holds it only splits a slice, and cannot panic")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: a quarter of what is left, rounded down, until that falls below 3.
    #[test]
    fn guided_chunks_shrink_to_the_least() {
        let mut left: usize = 40;
        let mut sizes = Vec::new();
        while left > 0 {
            let size = guided(left, 4, 3).min(left);
            sizes.push(size);
            left -= size;
        }
        assert_eq!(sizes, [10, 7, 5, 4, 3, 3, 3, 3, 2]);
    }

    #[test]
    fn guided_takes_at_least_one_when_less_than_one_each_is_left() {
        assert_eq!(guided(3, 8, 1), 1);
    }
}
