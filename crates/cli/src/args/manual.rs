//! What `radiosity completions` and `radiosity man` are told.

use std::path::PathBuf;

use clap_complete::Shell;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
bash:        radiosity completions bash > ~/.local/share/bash-completion/completions/radiosity
zsh:         radiosity completions zsh > ~/.zfunc/_radiosity    (with fpath+=~/.zfunc)
fish:        radiosity completions fish > ~/.config/fish/completions/radiosity.fish
powershell:  radiosity completions powershell >> $PROFILE
elvish:      radiosity completions elvish >> ~/.config/elvish/rc.elv")]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// Folder for a page of the program and one of each command, as radiosity-solve.1 [default: the
    /// program's alone, on stdout]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}
