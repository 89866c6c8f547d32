//! Flags for what the program says, and how: the same for every command.

use clap::ValueEnum;

#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Terminal")]
pub(crate) struct TerminalArgs {
    /// Say nothing but warnings and errors, and show no progress
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,

    /// What stderr carries: text, or a JSON object a line (docs/log.md says what each field is)
    #[arg(
        long,
        value_enum,
        value_name = "AS",
        default_value_t = LogArg::Text,
        hide_possible_values = true,
        global = true
    )]
    pub(crate) log: LogArg,

    /// Colours on stderr: `auto` (on a terminal, unless NO_COLOR is set), `always` or `never`
    #[arg(
        long,
        value_enum,
        value_name = "WHEN",
        default_value_t = ColorArg::Auto,
        hide_possible_values = true,
        global = true
    )]
    pub(crate) color: ColorArg,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LogArg {
    Text,
    Json,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorArg {
    Auto,
    Always,
    Never,
}

impl TerminalArgs {
    /// What a command line that was not understood asks for, as far as its words tell: its own
    /// errors are said that way, too.
    pub(crate) fn glance(words: &[std::ffi::OsString]) -> Self {
        let words: Vec<_> = words.iter().map(|word| word.to_string_lossy()).collect();
        let value = |flag: &str| {
            words.iter().enumerate().find_map(|(i, word)| {
                let rest = word.strip_prefix(flag)?;
                match rest.strip_prefix('=') {
                    Some(value) => Some(value),
                    None if rest.is_empty() => words.get(i + 1).map(AsRef::as_ref),
                    None => None,
                }
            })
        };
        fn named<T: ValueEnum>(name: Option<&str>, otherwise: T) -> T {
            name.and_then(|name| T::from_str(name, false).ok()).unwrap_or(otherwise)
        }
        Self {
            quiet: words.iter().any(|word| word == "-q" || word == "--quiet"),
            log: named(value("--log"), LogArg::Text),
            color: named(value("--color"), ColorArg::Auto),
        }
    }
}

impl From<ColorArg> for clap::ColorChoice {
    fn from(arg: ColorArg) -> Self {
        match arg {
            ColorArg::Auto => Self::Auto,
            ColorArg::Always => Self::Always,
            ColorArg::Never => Self::Never,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_glance_sees_what_is_asked_for() {
        let glance = |line: &str| {
            let words: Vec<_> = line.split(' ').map(Into::into).collect();
            let TerminalArgs { quiet, log, color } = TerminalArgs::glance(&words);
            (quiet, log, color)
        };
        assert_eq!(glance("solve --nonsense"), (false, LogArg::Text, ColorArg::Auto));
        assert_eq!(glance("solve -q --log json"), (true, LogArg::Json, ColorArg::Auto));
        assert_eq!(glance("--color=never --log=json x"), (false, LogArg::Json, ColorArg::Never));
        assert_eq!(glance("--color blue --log"), (false, LogArg::Text, ColorArg::Auto));
        assert_eq!(glance("--logs json --colors=never"), (false, LogArg::Text, ColorArg::Auto));
    }
}
