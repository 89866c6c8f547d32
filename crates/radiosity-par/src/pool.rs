//! A thread pool of one's own: nothing global, and a known number of threads.

use std::num::NonZeroUsize;

use radiosity_core::Executor;
use rayon::prelude::*;

use crate::Error;

/// Runs loops on a fixed number of threads, by work stealing.
///
/// Items are independent, so which thread takes which changes nothing in the result.
pub struct Pool {
    /// `None` for one thread: the caller's own, without a pool.
    pool: Option<rayon::ThreadPool>,
    threads: usize,
}

impl Pool {
    /// A pool of `threads` threads; 0 takes as many as the machine can run at once.
    ///
    /// # Errors
    /// If the operating system refuses the threads.
    pub fn new(threads: usize) -> Result<Self, Error> {
        let available = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let threads = if threads == 0 { available() } else { threads };
        if threads == 1 {
            return Ok(Self { pool: None, threads });
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("radiosity-{i}"))
            .build()
            .map_err(|source| Error::new(threads, source))?;
        Ok(Self { pool: Some(pool), threads })
    }
}

impl Executor for Pool {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        match &self.pool {
            // A single item is not worth waking anybody.
            Some(pool) if items.len() > 1 => {
                pool.install(|| items.par_iter_mut().with_max_len(1).for_each(&f));
            }
            _ => items.iter_mut().for_each(f),
        }
    }

    fn threads(&self) -> usize {
        self.threads
    }
}

impl std::fmt::Debug for Pool {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Pool({} threads)", self.threads)
    }
}
