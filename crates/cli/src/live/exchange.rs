//! What the work and its readers share: the newest frame, whether another was asked for, and stop.
//!
//! The work never waits here: it looks whether someone asked, and puts a frame in place. Readers take
//! their time with a copy of the handle.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::interrupt::Interrupt;

/// The newest frame, and who waits for what.
#[derive(Default)]
pub(super) struct Exchange {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    /// Bytes of the newest frame.
    frame: Option<Arc<Vec<u8>>>,
    /// Frames so far: the newest one's number.
    number: u64,
    /// Whether a reader asked for one that is newer.
    asked: bool,
    /// When one last did.
    last_asked: Option<Instant>,
    /// Whether the newest frame is the last.
    done: bool,
    /// Readers that are being answered.
    answering: usize,
    /// Whether one has been given the last frame.
    last_given: bool,
    interrupt: Option<Interrupt>,
    /// Whether it is to stop, if it was said before there was work.
    stop: bool,
}

impl Exchange {
    /// Whatever a thread did that panicked, the state is only numbers and handles.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether a reader waits for a frame.
    pub(super) fn asked(&self) -> bool {
        self.lock().asked
    }

    /// Whether a reader has asked lately.
    pub(super) fn watched(&self, lately: Duration) -> bool {
        self.lock().last_asked.is_some_and(|at| at.elapsed() <= lately)
    }

    /// The number that the next frame will have.
    pub(super) fn next_number(&self) -> u64 {
        self.lock().number + 1
    }

    /// Puts a frame in place of the one before.
    pub(super) fn put(&self, frame: Vec<u8>, done: bool) {
        let mut state = self.lock();
        state.frame = Some(Arc::new(frame));
        state.number += 1;
        state.asked = false;
        state.done = done;
        drop(state);
        self.changed.notify_all();
    }

    /// The newest frame, once it is newer than the one numbered `after`, or none within `patience`.
    pub(super) fn newer(&self, after: u64, patience: Duration) -> Option<Arc<Vec<u8>>> {
        let clock = Instant::now();
        let mut state = self.lock();
        loop {
            state.last_asked = Some(Instant::now());
            if state.number > after {
                state.last_given |= state.done;
                return state.frame.clone();
            }
            // Nothing follows the last.
            state.asked = !state.done;
            let left = patience.checked_sub(clock.elapsed())?;
            let waited = self.changed.wait_timeout(state, left);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// What hears the word to stop.
    pub(super) fn heed(&self, interrupt: &Interrupt) {
        let mut state = self.lock();
        if state.stop {
            interrupt.raise();
        }
        state.interrupt = Some(interrupt.clone());
    }

    /// Ends the work, and keeps its light.
    pub(super) fn stop(&self) {
        let mut state = self.lock();
        state.stop = true;
        if let Some(interrupt) = &state.interrupt {
            interrupt.raise();
        }
    }

    /// Counts a reader that is being answered, until what it returns is dropped.
    pub(super) fn answering(self: &Arc<Self>) -> Answering {
        self.lock().answering += 1;
        Answering(Arc::clone(self))
    }

    /// Waits until readers have what they are given, the last frame if there is one, or time is up.
    pub(super) fn drain(&self, most: Duration) {
        let clock = Instant::now();
        let mut state = self.lock();
        while state.answering > 0 || state.done && !state.last_given {
            let Some(left) = most.checked_sub(clock.elapsed()) else { return };
            let waited = self.changed.wait_timeout(state, left);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// A reader that is being answered.
pub(super) struct Answering(Arc<Exchange>);

impl Drop for Answering {
    fn drop(&mut self) {
        self.0.lock().answering -= 1;
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_asked_for_and_given_once() {
        let exchange = Exchange::default();
        assert!(!exchange.asked());
        assert_eq!(exchange.newer(0, Duration::ZERO), None);
        assert!(exchange.asked() && exchange.watched(Duration::from_secs(60)));
        exchange.put(vec![1], false);
        assert!(!exchange.asked());
        assert_eq!(exchange.newer(0, Duration::ZERO).as_deref(), Some(&vec![1]));
        assert!(!exchange.asked(), "what was there was given");
        assert_eq!(exchange.newer(1, Duration::ZERO), None);
        exchange.put(vec![2], true);
        assert_eq!(exchange.newer(1, Duration::ZERO).as_deref(), Some(&vec![2]));
        assert_eq!(exchange.newer(2, Duration::ZERO), None);
        assert!(!exchange.asked(), "nothing follows the last");
    }

    #[test]
    fn stop_is_heard_before_and_after_the_work_begins() {
        for early in [true, false] {
            let (exchange, interrupt) = (Exchange::default(), Interrupt::default());
            if early {
                exchange.stop();
                exchange.heed(&interrupt);
            } else {
                exchange.heed(&interrupt);
                assert!(!interrupt.heard());
                exchange.stop();
            }
            assert!(interrupt.heard());
        }
    }
}
