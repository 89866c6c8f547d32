//! The bar on the terminal, below everything that is said.

use std::time::Duration;

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Redraws a second: a clock that seems to run, and no work worth mentioning.
const REDRAWS: u8 = 10;

/// Steps of a whole bar.
const WHOLE: u64 = 1000;

/// Where bars are drawn.
pub(crate) struct Bars {
    shown: bool,
    all: MultiProgress,
}

impl Bars {
    /// On stderr, or nowhere.
    pub(crate) fn new(shown: bool) -> Self {
        let target = match shown {
            true => ProgressDrawTarget::stderr_with_hz(REDRAWS),
            false => ProgressDrawTarget::hidden(),
        };
        Self { shown, all: MultiProgress::with_draw_target(target) }
    }

    /// Whether there is one to see.
    pub(crate) fn shown(&self) -> bool {
        self.shown
    }

    /// Takes the bar away while something is written, and draws it again below.
    pub(crate) fn suspend<T>(&self, write: impl FnOnce() -> T) -> T {
        if self.shown { self.all.suspend(write) } else { write() }
    }

    /// A bar of its own, at the bottom.
    pub(crate) fn bar(&self) -> Bar {
        let bar = self.all.add(ProgressBar::new(WHOLE));
        if let Ok(style) = ProgressStyle::with_template("{spinner} [{bar:20}] {wide_msg}") {
            bar.set_style(style.progress_chars("=> "));
        }
        if self.shown {
            // What takes long between two steps still shows that it lives.
            bar.enable_steady_tick(Duration::from_secs(1) / u32::from(REDRAWS));
        }
        Bar(bar)
    }
}

/// A bar.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    /// Shows a share of the work as done, and a line of text.
    pub(crate) fn show(&self, done: f64, text: &str) {
        self.0.set_position((done.clamp(0.0, 1.0) * WHOLE as f64) as u64);
        self.0.set_message(text.to_owned());
    }

    /// Takes it away.
    pub(crate) fn clear(&self) {
        self.0.finish_and_clear();
    }
}
