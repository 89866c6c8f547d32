//! What a key of a config file may hold, and the words that it stands for.

use std::any::TypeId;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::{Arg, ArgAction};
use toml::de::DeValue;

/// What a flag takes in the file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Takes {
    Switch,
    Path,
    Paths,
    Text,
    Value,
}

/// What was typed, had it been typed.
pub(super) fn words(
    path: &Path,
    name: &str,
    arg: &Arg,
    value: &DeValue,
) -> Result<Vec<OsString>, String> {
    let takes = takes(arg);
    let one = |text: &OsStr| {
        if arg.is_positional() {
            return text.to_owned();
        }
        let mut word = OsString::from(format!("--{name}="));
        word.push(text);
        word
    };
    let file = |text: &str| one(beside(path, text).as_os_str());
    match (takes, value) {
        (Takes::Switch, DeValue::Boolean(on)) => {
            Ok(if *on { vec![format!("--{name}").into()] } else { Vec::new() })
        }
        (Takes::Path | Takes::Paths, DeValue::String(text)) => Ok(vec![file(text)]),
        (Takes::Paths, DeValue::Array(all)) => all
            .iter()
            .map(|value| match value.get_ref() {
                DeValue::String(text) => Ok(file(text)),
                other => Err(format!("expected file names, found {}", found(other))),
            })
            .collect(),
        (Takes::Text | Takes::Value, DeValue::String(text)) => {
            Ok(vec![one(OsStr::new(text.as_ref()))])
        }
        (Takes::Value, DeValue::Integer(number)) if number.radix() == 10 => {
            Ok(vec![one(OsStr::new(number.as_str()))])
        }
        (Takes::Value, DeValue::Float(number)) => Ok(vec![one(OsStr::new(number.as_str()))]),
        (takes, other) => Err(format!("expected {}, found {}", takes.text(), found(other))),
    }
}

/// What an argument takes.
pub(super) fn takes(arg: &Arg) -> Takes {
    let value = arg.get_value_parser().type_id();
    match arg.get_action() {
        ArgAction::SetTrue => Takes::Switch,
        ArgAction::Append => Takes::Paths,
        _ if value == TypeId::of::<PathBuf>() => Takes::Path,
        _ if value == TypeId::of::<String>() => Takes::Text,
        _ => Takes::Value,
    }
}

impl Takes {
    fn text(self) -> &'static str {
        match self {
            Self::Switch => "true or false",
            Self::Path => "a file name in quotes",
            Self::Paths => "a file name in quotes, or several as [\"a.csv\", \"b.ply\"]",
            Self::Text => "a text in quotes",
            Self::Value => "a number, or a text in quotes",
        }
    }
}

fn found(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(number) if number.radix() != 10 => "a number that is not decimal",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// A name in the file is one beside the file; `-` is stdout.
fn beside(config: &Path, name: &str) -> PathBuf {
    match config.parent() {
        _ if name == "-" => PathBuf::from(name),
        Some(folder) => {
            let path = folder.join(name);
            // No flag, whatever it begins with.
            let flag = path.to_string_lossy().starts_with('-');
            if flag { Path::new(".").join(path) } else { path }
        }
        None => PathBuf::from(name),
    }
}
