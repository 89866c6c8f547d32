//! What is wrong with a command line, in one line that says what to type instead.

use std::num::{ParseFloatError, ParseIntError};

use clap::Command;
use clap::error::{ContextKind, ContextValue, Error, ErrorKind};

/// What is wrong with the arguments of `command`, or of its subcommand `name`.
pub(super) fn text(error: &Error, command: &Command, name: Option<&str>) -> String {
    let hint = match name {
        Some(name) => format!("`radiosity help {name}` lists what it takes"),
        None => "`radiosity help` lists the commands".into(),
    };
    let flag = || flag(error);
    match error.kind() {
        ErrorKind::ValueValidation | ErrorKind::InvalidValue | ErrorKind::InvalidUtf8 => {
            match value(error) {
                Some(found) if found.is_empty() => {
                    format!("{}: expected {} after it; {hint}", flag(), placeholder(error))
                }
                Some(found) => format!("{} {found}: {}", flag(), expected(error)),
                None => format!("an argument is not UTF-8; {hint}"),
            }
        }
        ErrorKind::UnknownArgument => unknown(error, command, name, &hint),
        ErrorKind::InvalidSubcommand => {
            let found = strings(error, ContextKind::InvalidSubcommand).join(" ");
            let meant = meant(error, ContextKind::SuggestedSubcommand);
            let scene = std::path::Path::new(&found).extension().is_some();
            match meant {
                None if scene => {
                    format!(
                        "{found}: expected a command before it, such as `radiosity solve {found}`"
                    )
                }
                meant => format!("{found}: is no command{}; {hint}", meant.unwrap_or_default()),
            }
        }
        ErrorKind::ArgumentConflict => {
            let others = strings(error, ContextKind::PriorArg);
            let others: Vec<_> = others.iter().map(|arg| bare(arg)).collect();
            match others.as_slice() {
                [other] if *other == flag() => format!("{other}: is given twice; leave one out"),
                [] => format!("{}: does not go with the other arguments; leave one out", flag()),
                others => {
                    let others = others.join(" and ");
                    format!("{}: does not go with {others}; leave one out", flag())
                }
            }
        }
        ErrorKind::MissingRequiredArgument => {
            let missing = strings(error, ContextKind::InvalidArg).join(" and ");
            format!("{}: needs {missing}; {hint}", name.unwrap_or("radiosity"))
        }
        ErrorKind::TooManyValues => {
            format!("{} {}: takes no more values", flag(), value(error).unwrap_or_default())
        }
        // Every other kind is text in more than one line.
        _ => {
            let text = error.to_string();
            let text = text.lines().next().unwrap_or_default();
            format!("{}; {hint}", text.strip_prefix("error: ").unwrap_or(text))
        }
    }
}

/// What a value should have been, if that is the error.
pub(super) fn expected(error: &Error) -> String {
    let allowed = strings(error, ContextKind::ValidValue);
    if !allowed.is_empty() {
        let meant = meant(error, ContextKind::SuggestedValue).unwrap_or_default();
        return format!("expected {}{meant}", either(&allowed));
    }
    match std::error::Error::source(error) {
        Some(source) if source.is::<ParseIntError>() => {
            "expected a whole number, at least 0, such as 100".into()
        }
        Some(source) if source.is::<ParseFloatError>() => "expected a number, such as 0.5".into(),
        Some(source) => source.to_string(),
        None => format!("expected {}", placeholder(error)),
    }
}

/// A flag that is not known, or a word too many.
fn unknown(error: &Error, command: &Command, name: Option<&str>, hint: &str) -> String {
    let found = strings(error, ContextKind::InvalidArg).join(" ");
    if !found.starts_with('-') {
        return format!("{found}: is one argument too many; {hint}");
    }
    if found.parse::<f64>().is_ok() {
        return format!("{found}: is taken for a flag; no value here may be below 0; {hint}");
    }
    let others: Vec<&str> = command
        .get_subcommands()
        .filter(|other| Some(other.get_name()) != name)
        .filter(|other| other.get_arguments().any(|arg| long(arg) == found))
        .map(Command::get_name)
        .collect();
    match (meant(error, ContextKind::SuggestedArg), others.as_slice()) {
        (Some(meant), _) => format!("{found}: is no flag{meant}; {hint}"),
        (None, []) => format!("{found}: is no flag; {hint}"),
        (None, others) => format!("{found}: is a flag of {}; {hint}", others.join(" and ")),
    }
}

fn long(arg: &clap::Arg) -> String {
    format!("--{}", arg.get_long().unwrap_or_default())
}

/// The flag that the error is about, without its value.
fn flag(error: &Error) -> String {
    strings(error, ContextKind::InvalidArg).first().map(|arg| bare(arg)).unwrap_or_default()
}

/// `--error <X>` without its value, `<SCENE>` without its brackets.
fn bare(arg: &str) -> String {
    let word = arg.split([' ', '=']).next().unwrap_or_default();
    word.trim_matches(['<', '>', '[', ']', '.']).to_owned()
}

/// `X` of `--error <X>`.
fn placeholder(error: &Error) -> String {
    let arg = strings(error, ContextKind::InvalidArg).join(" ");
    let inside = arg.split_once('<').and_then(|(_, rest)| rest.split_once('>'));
    inside.map_or_else(|| "another value".into(), |(name, _)| name.to_owned())
}

fn value(error: &Error) -> Option<String> {
    match error.get(ContextKind::InvalidValue)? {
        ContextValue::String(value) => Some(value.clone()),
        _ => None,
    }
}

/// What was probably meant, as the end of a sentence.
fn meant(error: &Error, kind: ContextKind) -> Option<String> {
    let close = strings(error, kind);
    (!close.is_empty()).then(|| format!("; did you mean {}?", either(&close)))
}

/// `a, b or c`.
pub(super) fn either(all: &[String]) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
    }
}

fn strings(error: &Error, kind: ContextKind) -> Vec<String> {
    match error.get(kind) {
        Some(ContextValue::String(one)) => vec![one.clone()],
        Some(ContextValue::Strings(all)) => all.clone(),
        _ => Vec::new(),
    }
}
