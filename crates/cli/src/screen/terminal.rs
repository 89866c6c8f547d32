//! The terminal that this process has: what stderr carries, in which colours, below which bar.

use std::io::{IsTerminal, Write};
use std::sync::OnceLock;
use std::time::Instant;

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use serde::Serialize;

use super::Event;
use crate::args::{ColorArg, LogArg, TerminalArgs};
use crate::progress::Bars;

/// A process has one stderr, whoever writes to it; so this is set once, before the first line.
static TERMINAL: OnceLock<Terminal> = OnceLock::new();

/// Why the program fails.
pub(super) const ERROR: Style = AnsiColor::Red.on_default().bold();

/// What should be looked at.
pub(super) const WARNING: Style = AnsiColor::Yellow.on_default().bold();

/// Key numbers.
pub(super) const KEY: Style = Style::new().bold();

/// How stderr is written to.
pub(super) struct Terminal {
    start: Instant,
    pub(super) quiet: bool,
    pub(super) json: bool,
    colours: bool,
    pub(super) bars: Bars,
}

/// A line of `--log json`.
#[derive(Serialize)]
struct Line<'a> {
    #[serde(flatten)]
    event: &'a Event<'a>,
    /// Since the program began.
    seconds: f64,
}

/// Sets how stderr is written to; the first call counts.
pub(crate) fn open(args: TerminalArgs, start: Instant) {
    let mut first = false;
    let terminal = TERMINAL.get_or_init(|| {
        first = true;
        Terminal::of(args, start)
    });
    if first && terminal.json && !terminal.quiet {
        terminal.object(&Event::start());
    }
}

/// How stderr is written to: as plain text where nothing was set.
pub(super) fn terminal() -> &'static Terminal {
    TERMINAL.get_or_init(|| {
        let (quiet, log, color) = (false, LogArg::Text, ColorArg::Never);
        Terminal::of(TerminalArgs { quiet, log, color }, Instant::now())
    })
}

impl Terminal {
    fn of(args: TerminalArgs, start: Instant) -> Self {
        let stderr = std::io::stderr();
        let json = args.log == LogArg::Json;
        let colours = match args.color {
            ColorArg::Always => true,
            ColorArg::Never => false,
            ColorArg::Auto => AutoStream::choice(&stderr) != ColorChoice::Never,
        };
        let plain = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let shown = stderr.is_terminal() && !plain && !args.quiet && !json;
        Self { start, quiet: args.quiet, json, colours: colours && !json, bars: Bars::new(shown) }
    }

    /// A text in a style, where there are colours.
    pub(super) fn styled(&self, style: Style, text: &str) -> String {
        if self.colours { format!("{style}{text}{style:#}") } else { text.to_owned() }
    }

    /// Writes a line above the bar. A reader that went away is no reason to fail.
    pub(super) fn line(&self, text: &str) {
        self.bars.suspend(|| {
            let stderr = std::io::stderr().lock();
            let _ = match self.colours {
                true => writeln!(AutoStream::always(stderr), "{text}"),
                false => writeln!({ stderr }, "{text}"),
            };
        });
    }

    /// Writes a line of `--log json`.
    pub(super) fn object(&self, event: &Event<'_>) {
        let line = Line { event, seconds: self.start.elapsed().as_secs_f64() };
        if let Ok(text) = serde_json::to_string(&line) {
            self.line(&text);
        }
    }
}
