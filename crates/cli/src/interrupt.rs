//! Ctrl-C: the first ends the work and keeps its light, the second ends the program.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::screen;

/// What a shell reports of a program that Ctrl-C ended: 128 and SIGINT's number.
const EXIT_CODE: i32 = 130;

/// Whether someone wants the work to end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Hears SIGINT, SIGTERM and the closing of the terminal from now on; to be called once.
    ///
    /// A program that was told to outlive its terminal (`nohup`) hears none of them: they would
    /// all be heard or none, and it keeps the handling that it was started with.
    pub(crate) fn listen() -> Self {
        let interrupt = Self::default();
        if ignores_hangup() {
            return interrupt;
        }
        let heard = interrupt.clone();
        let listening = ctrlc::set_handler(move || {
            if heard.0.swap(true, Ordering::Relaxed) {
                process::exit(EXIT_CODE);
            }
        });
        if let Err(error) = listening {
            screen::warning(&format!("Ctrl-C will end the program without any output: {error}"));
        }
        interrupt
    }

    /// Says stop, as a first Ctrl-C does; never more than that.
    #[cfg(feature = "live")]
    pub(crate) fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was heard.
    pub(crate) fn heard(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Whether SIGHUP is ignored, where /proc tells.
fn ignores_hangup() -> bool {
    // SIGHUP is signal 1, and the lowest bit of the mask.
    std::fs::read_to_string("/proc/self/status").is_ok_and(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|m| m & 1 == 1)
    })
}
