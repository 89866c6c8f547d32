//! A thread pool of one's own: nothing global, and a known number of threads.

use std::num::NonZeroUsize;

use radiosity_core::Executor;
use rayon::ThreadPool;

use crate::{Error, Loop, hand_out};

#[cfg(test)]
mod tests;

/// Runs loops on a fixed number of threads, shared out as its [`Loop`] says.
///
/// Items are independent, so which thread takes which changes nothing in the result. A panic in
/// a loop comes back to the caller after all threads have left that loop, and the pool stays
/// usable. Loops may nest, and several threads may use one pool at once.
pub struct Pool {
    /// `None` for one thread: the caller's own, without a pool.
    pool: Option<ThreadPool>,
    threads: usize,
    schedule: Loop,
}

impl Pool {
    /// A pool of `threads` threads with the default loop; 0 takes as many as the machine can
    /// run at once.
    ///
    /// # Errors
    /// If the operating system refuses the threads.
    pub fn new(threads: usize) -> Result<Self, Error> {
        Self::with_loop(threads, Loop::default())
    }

    /// A pool of `threads` threads that share out items as `schedule` says; 0 takes as many as
    /// the machine can run at once.
    ///
    /// # Errors
    /// If the operating system refuses the threads.
    pub fn with_loop(threads: usize, schedule: Loop) -> Result<Self, Error> {
        let available = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let threads = if threads == 0 { available() } else { threads };
        if threads == 1 {
            return Ok(Self { pool: None, threads, schedule });
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("radiosity-{i}"))
            .build()
            .map_err(|source| Error::new(threads, source))?;
        Ok(Self { pool: Some(pool), threads, schedule })
    }

    /// Runs `work` on a thread of the pool, and waits for it: its loops then start without waking the
    /// pool first, which pays where many loops follow each other.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// How the items are shared out.
    #[must_use]
    pub fn schedule(&self) -> Loop {
        self.schedule
    }
}

impl Executor for Pool {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        let grain = self.schedule.grain();
        let pool = match &self.pool {
            // What one thread would take at once is not worth waking anybody.
            Some(pool) if items.len() > grain => pool,
            _ => return items.iter_mut().for_each(f),
        };
        let threads = self.threads;
        let takers = threads.min(items.len().div_ceil(grain));
        match self.schedule {
            Loop::Static => hand_out::shares(pool, items, f),
            Loop::Dynamic(chunk) => hand_out::chunks(pool, items, takers, |_| chunk.get(), f),
            Loop::Guided(least) => {
                let size = |left| hand_out::guided(left, threads, least.get());
                hand_out::chunks(pool, items, takers, size, f);
            }
            Loop::Tasks => hand_out::halves(pool, items, f),
        }
    }

    fn threads(&self) -> usize {
        self.threads
    }
}

impl std::fmt::Debug for Pool {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Pool({} threads, {})", self.threads, self.schedule)
    }
}
