//! What is typed, with what a config file says beside it.

#[cfg(feature = "config")]
mod config;
mod mistake;

use std::ffi::OsString;

use clap::{ArgMatches, CommandFactory, FromArgMatches};

use crate::absent;
use crate::args::{Args, TerminalArgs};
use crate::failure::Failure;
#[cfg(feature = "config")]
use config::Config;

/// A command line that is understood.
pub(crate) struct CommandLine {
    pub(crate) args: Args,
    #[cfg(feature = "config")]
    config: Option<Config>,
}

/// Understands a command line, the name of the program first.
///
/// Asked for help or its version, the program ends here.
pub(crate) fn read(words: &[OsString]) -> Result<CommandLine, Failure> {
    let color = TerminalArgs::glance(words).color;
    let mut command = Args::command().color(color.into());
    command.build();
    let matches = matches(&command, words)?;
    #[cfg(feature = "config")]
    if let Some(config) = Config::named(&matches, &command)? {
        let words = config.beside(words);
        let matches = self::matches(&command, &words).map_err(|failure| config.at(failure))?;
        return Ok(CommandLine { args: args(&matches)?, config: Some(config) });
    }
    Ok(CommandLine {
        args: args(&matches)?,
        #[cfg(feature = "config")]
        config: None,
    })
}

impl CommandLine {
    /// Takes it apart: the arguments, and a way to say where a wrong one stands.
    pub(crate) fn split(self) -> (Args, impl Fn(Failure) -> Failure) {
        #[cfg(feature = "config")]
        let config = self.config;
        (self.args, move |failure| {
            #[cfg(feature = "config")]
            if let Some(config) = &config {
                return config.at(failure);
            }
            failure
        })
    }
}

fn args(matches: &ArgMatches) -> Result<Args, Failure> {
    Args::from_arg_matches(matches).map_err(|e| Failure::Usage(e.to_string()))
}

fn matches(command: &clap::Command, words: &[OsString]) -> Result<ArgMatches, Failure> {
    command.clone().try_get_matches_from(words).map_err(|error| {
        if !error.use_stderr() {
            error.exit();
        }
        absent::of(&error).unwrap_or_else(|| {
            let known = |word: &OsString| command.find_subcommand(word);
            let name = words.iter().skip(1).find_map(known).map(clap::Command::get_name);
            Failure::Usage(mistake::text(&error, command, name))
        })
    })
}
