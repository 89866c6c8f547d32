//! A config file for `solve`: flags by their long names, which typed ones win over.
//!
//! Each key becomes the words that would have been typed, so that both are understood by the same
//! code; where a word is wrong, its place in the file is said. docs/config.md describes the file.

mod value;

use std::collections::HashSet;
use std::ffi::OsString;
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};
use toml::de::DeTable;

use super::mistake::{self, either};
use crate::failure::Failure;
use crate::{files, similar};
use value::words;

/// The command that has a config file.
const COMMAND: &str = "solve";

/// The scene, which has no flag.
const SCENE: &str = "scene";

/// A config file, as words for the command line.
pub(crate) struct Config {
    path: PathBuf,
    keys: Vec<Key>,
}

/// A key of the file that counts.
struct Key {
    /// `--error`, or `scene`.
    name: String,
    /// As typed; none for a flag that is off.
    words: Vec<OsString>,
    /// Line and column, from 1.
    place: (usize, usize),
}

impl Config {
    /// The file that --config names, if it does.
    pub(super) fn named(matches: &ArgMatches, root: &Command) -> Result<Option<Self>, Failure> {
        let (Some(typed), Some(command)) =
            (matches.subcommand_matches(COMMAND), root.find_subcommand(COMMAND))
        else {
            return Ok(None);
        };
        let Some(path) = typed.get_one::<PathBuf>("config") else { return Ok(None) };
        files::check_read(path)?;
        let failed = |e: std::io::Error| Failure::Failed(format!("{}: {e}", path.display()));
        let text = std::fs::read_to_string(path).map_err(failed)?;
        Self::parse(path, &text, typed, root, command).map(Some).map_err(Failure::Usage)
    }

    fn parse(
        path: &Path,
        text: &str,
        typed: &ArgMatches,
        root: &Command,
        command: &Command,
    ) -> Result<Self, String> {
        let at = |span: Range<usize>, message: &str| {
            let (line, column) = place(text, span.start);
            format!("{}:{line}:{column}: {message}", path.display())
        };
        let table = DeTable::parse(text).map_err(|e| {
            let message = e.message().lines().collect::<Vec<_>>().join("; ");
            at(e.span().unwrap_or(0..0), &message)
        })?;
        let beaten = beaten(typed, command);
        let mut entries: Vec<_> = table.get_ref().iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let mut keys = Vec::new();
        for (key, value) in entries {
            let name = key.get_ref().as_ref();
            let Some(arg) = argument(command, name) else {
                return Err(at(key.span(), &unknown(name, command)));
            };
            let words = words(path, name, arg, value.get_ref())
                .and_then(|words| check(root, name, &words).map(|()| words))
                .map_err(|message| at(value.span(), &format!("{name}: {message}")))?;
            if !beaten.contains(arg.get_id().as_str()) {
                let name = if name == SCENE { name.to_owned() } else { format!("--{name}") };
                keys.push(Key { name, words, place: place(text, key.span().start) });
            }
        }
        Ok(Self { path: path.to_owned(), keys })
    }

    /// The words typed, with those of the file behind the name of the command.
    pub(super) fn beside(&self, typed: &[OsString]) -> Vec<OsString> {
        let name = typed.iter().position(|word| word == COMMAND).unwrap_or(0);
        let (before, after) = typed.split_at(name + 1);
        let ours = self.keys.iter().flat_map(|key| &key.words);
        before.iter().chain(ours).chain(after).cloned().collect()
    }

    /// A failure with the place in the file, if it is about a flag that stands there.
    pub(crate) fn at(&self, failure: Failure) -> Failure {
        let Failure::Usage(message) = &failure else { return failure };
        let word = message.split([' ', ':', ',']).next().unwrap_or_default();
        let word = if word == "-o" { "--output" } else { word };
        match self.keys.iter().find(|key| key.name == word) {
            None => failure,
            Some(Key { place: (line, column), .. }) => {
                let path = self.path.display();
                Failure::Usage(format!("{path}:{line}:{column}: {message}"))
            }
        }
    }
}

/// The flag or the scene that a key stands for.
fn argument<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    let mut all = command.get_arguments().filter(|arg| settable(arg));
    all.find(|arg| key(arg) == Some(name))
}

/// What an argument is called in a file.
fn key(arg: &Arg) -> Option<&str> {
    if arg.is_positional() { Some(SCENE) } else { arg.get_long() }
}

/// Whether an argument may stand in a file.
fn settable(arg: &Arg) -> bool {
    !matches!(arg.get_id().as_str(), "config" | "help" | "version")
}

/// The arguments that the typed ones win over: themselves, and what does not go with them.
fn beaten(typed: &ArgMatches, command: &Command) -> HashSet<String> {
    let given =
        |arg: &Arg| typed.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
    let id = |arg: &Arg| arg.get_id().as_str().to_owned();
    let mut beaten = HashSet::new();
    for arg in command.get_arguments() {
        let conflicts = || command.get_arg_conflicts_with(arg);
        if given(arg) {
            beaten.insert(id(arg));
            beaten.extend(conflicts().into_iter().map(id));
        } else if conflicts().into_iter().any(given) {
            beaten.insert(id(arg));
        }
    }
    beaten
}

fn unknown(name: &str, command: &Command) -> String {
    let known = command.get_arguments().filter(|arg| settable(arg)).filter_map(key);
    let dashed = name.replace('_', "-");
    let hint = similar::meant(&dashed, known);
    format!(
        "{name}: is no key{hint}; keys are `{SCENE}` and the long flags of `radiosity help solve`"
    )
}

/// Whether the words are understood, each by itself.
fn check(root: &Command, name: &str, words: &[OsString]) -> Result<(), String> {
    use clap::error::ErrorKind::{InvalidUtf8, InvalidValue, ValueValidation};
    let line = ["radiosity", COMMAND].map(OsString::from);
    match root.clone().try_get_matches_from(line.iter().chain(words)) {
        Err(error) if matches!(error.kind(), InvalidUtf8 | InvalidValue | ValueValidation) => {
            let given = words.iter().map(|word| word.to_string_lossy());
            let given = given.map(|word| word.replacen(&format!("--{name}="), "", 1));
            let given = either(&given.collect::<Vec<_>>());
            Err(format!("{given}: {}", mistake::expected(&error)))
        }
        _ => Ok(()),
    }
}

/// Line and column of a byte, from 1; columns count characters.
fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.rsplit('\n').next().unwrap_or_default();
    (before.matches('\n').count() + 1, line.chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::value::{Takes, takes};
    use super::*;
    use crate::args::Args;

    /// What the file and the typed words come to, or what is wrong.
    fn resolve(text: &str, typed: &str) -> Result<Vec<String>, String> {
        let mut root = Args::command();
        root.build();
        let line = format!("radiosity solve --config conf/a.toml {typed}");
        let line: Vec<OsString> = line.split_whitespace().map(Into::into).collect();
        let matches = root.clone().try_get_matches_from(&line).unwrap();
        let command = root.find_subcommand(COMMAND).unwrap();
        let typed = matches.subcommand_matches(COMMAND).unwrap();
        let config = Config::parse(Path::new("conf/a.toml"), text, typed, &root, command)?;
        let words = config.beside(&line);
        match root.try_get_matches_from(&words) {
            Ok(_) => Ok(words[2..].iter().map(|w| w.to_str().unwrap().to_owned()).collect()),
            Err(error) => Err(config
                .at(Failure::Usage(mistake::text(&error, &Args::command(), Some(COMMAND))))
                .to_string()),
        }
    }

    /// A value of each kind that clap accepts for a flag.
    fn value(arg: &Arg) -> String {
        let allowed = arg.get_possible_values();
        let texts: Vec<String> = match allowed.first() {
            Some(value) => vec![format!("{:?}", value.get_name())],
            None => [
                "\"a.csv\"",
                "1",
                "\"1%\"",
                "\"30s\"",
                "\"2GB\"",
                "\"every:9\"",
                "\"9x9\"",
                "\"single\"",
                "\"static\"",
                "\"name\"",
            ]
            .map(Into::into)
            .into(),
        };
        let mut root = Args::command();
        root.build();
        let name = key(arg).unwrap();
        let fits = |text: &String| {
            let text = format!("x = {text}");
            let table = DeTable::parse(&text).unwrap();
            let (_, value) = table.get_ref().iter().next().unwrap();
            words(Path::new("a.toml"), name, arg, value.get_ref())
                .and_then(|words| check(&root, name, &words))
                .is_ok()
        };
        if takes(arg) == Takes::Switch {
            return "true".into();
        }
        texts.into_iter().find(fits).unwrap_or_else(|| panic!("{name}: no value fits"))
    }

    #[test]
    fn every_flag_of_solve_can_be_set() {
        let mut root = Args::command();
        root.build();
        let command = root.find_subcommand(COMMAND).unwrap();
        let mut count = 0;
        for arg in command.get_arguments().filter(|arg| settable(arg)) {
            let name = key(arg).unwrap();
            // Some go with others alone.
            let text = format!("{name} = {}\n", value(arg));
            let with = match name {
                "every" => "checkpoint = \"a.ckpt\"\n",
                "live-port" => "live = true\n",
                _ => "",
            };
            let words = resolve(&(text.clone() + with), "").unwrap();
            let own = if name == SCENE { "conf/a.csv".into() } else { format!("--{name}") };
            assert!(words.iter().any(|w| w.starts_with(&own)), "{text}: {words:?}");
            // And a date suits none.
            let message = resolve(&format!("{name} = 2020-01-01\n"), "").unwrap_err();
            assert!(
                message
                    .starts_with(&format!("conf/a.toml:1:{}: {name}: expected ", name.len() + 4)),
                "{message}"
            );
            count += 1;
        }
        assert!(count > 20, "{count}");
    }

    #[test]
    fn typed_flags_win_over_the_file_with_what_does_not_go_with_them() {
        let text =
            "scene = \"room.tri\"\nerror = 0.005\noutput = [\"a.csv\", \"-\"]\nambient = false\n";
        assert_eq!(
            resolve(text, "").unwrap(),
            [
                "conf/room.tri",
                "--error=0.005",
                "--output=conf/a.csv",
                "--output=-",
                "--config",
                "conf/a.toml"
            ]
        );
        let typed = resolve(text, "hall.tri --elements 9 -o b.ply").unwrap();
        assert_eq!(
            typed,
            ["--config", "conf/a.toml", "hall.tri", "--elements", "9", "-o", "b.ply"]
        );
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        for (text, expected) in [
            (
                "error = 0.5\n\nmax_time = \"9s\"\n",
                "3:1: max_time: is no key; did you mean max-time?",
            ),
            ("  elments = 9\n", "1:3: elments: is no key; did you mean elements?"),
            ("config = \"b.toml\"\n", "1:1: config: is no key"),
            ("elements = \"many\"\n", "1:12: elements: many: expected a whole number"),
            (
                "elements = true\n",
                "1:12: elements: expected a number, or a text in quotes, found true or false",
            ),
            (
                "elements = 0x10\n",
                "1:12: elements: expected a number, or a text in quotes, found a number that",
            ),
            ("ambient = 1\n", "1:11: ambient: expected true or false, found a number"),
            ("report = 5\n", "1:10: report: expected a file name in quotes, found a number"),
            ("output = [\"a.csv\", 5]\n", "1:10: output: expected file names, found a number"),
            ("error = 7\n", "1:9: error: 7: expected a share from 0 to 1"),
            (
                "accel = \"octre\"\n",
                "1:9: accel: octre: expected auto, octree, bvh or none; did you mean octree?",
            ),
            ("[solve]\nerror = 0.1\n", "1:2: solve: is no key"),
            ("error = \n", "1:9: "),
            ("error = 0.1\nerror = 0.2\n", "2:1: duplicate key"),
            ("error = 0.1\nelements = 9\n", "does not go with --e"),
        ] {
            let message = resolve(text, "").unwrap_err();
            assert!(message.starts_with("conf/a.toml:"), "{text}: {message}");
            assert!(message.contains(expected), "{text}: {message}");
            assert_eq!(message.lines().count(), 1, "{message}");
        }
    }
}
