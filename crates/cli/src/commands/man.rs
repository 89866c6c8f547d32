//! `radiosity man`: manual pages of the program and of each command.

use std::path::Path;

use clap::{Command, CommandFactory};
use clap_mangen::Man;

use crate::args::{Args, ManArgs};
use crate::failure::Failure;
use crate::files;
use crate::screen::{self, Event, tell};

/// Writes a page for each into a folder, or that of the program alone on stdout.
pub(crate) fn run(args: &ManArgs) -> Result<(), Failure> {
    let mut root = Args::command().disable_help_subcommand(true);
    root.build();
    let Some(folder) = &args.output else {
        let page = page(root).map_err(|e| Failure::Failed(format!("stdout: {e}")))?;
        return screen::result(String::from_utf8_lossy(&page).trim_end());
    };
    if !folder.is_dir() {
        let message = format!("{}: is no folder; make it first", folder.display());
        return Err(Failure::Failed(message));
    }
    let commands: Vec<Command> = root.get_subcommands().cloned().collect();
    let mut written = Vec::new();
    for command in [root].into_iter().chain(commands) {
        written.push(write(folder, command)?);
    }
    tell(|| Event::Written { files: &written }, &format!("written: {}", written.join(", ")));
    Ok(())
}

/// A page in the folder; its name.
fn write(folder: &Path, command: Command) -> Result<String, Failure> {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name());
    let path = folder.join(format!("{name}.1"));
    files::check(&path)?;
    let page = page(command).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    output::replace_file(&path, |out| Ok(out.write_all(&page)?))?;
    Ok(path.display().to_string())
}

fn page(command: Command) -> std::io::Result<Vec<u8>> {
    let mut page = Vec::new();
    Man::new(command).manual("radiosity").render(&mut page)?;
    Ok(page)
}
