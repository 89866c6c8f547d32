//! The file of --checkpoint: written when it is due, and read again.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use radiosity_core::{Checkpoint, Inconsistent, Kept};

use super::{Identity, container};
use crate::failure::Failure;
use crate::screen;
use crate::settings::Keeping;

/// Writes the state when it is due.
pub(crate) struct Keeper {
    path: PathBuf,
    every: Duration,
    identity: Identity,
    /// The end of the last writing: it must never take all of the time.
    last: Instant,
    written: u32,
    failed: bool,
}

impl Keeper {
    /// What the settings ask for, if they do.
    pub(crate) fn of(keeping: &Keeping, identity: &Identity) -> Option<Self> {
        keeping.checkpoint.as_ref().map(|path| Self {
            path: path.clone(),
            every: keeping.every,
            identity: identity.clone(),
            last: Instant::now(),
            written: 0,
            failed: false,
        })
    }

    /// Whether the state is to be written.
    pub(crate) fn due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes the state. What cannot be written is warned of, once: the work is worth more than
    /// its checkpoint.
    pub(crate) fn keep(&mut self, kept: &Kept<'_>) {
        match write(&self.path, &self.identity, kept) {
            Ok(()) => self.written += 1,
            Err(failure) if !self.failed => {
                screen::warning(&format!("checkpoint: {failure}; the work goes on without"));
                self.failed = true;
            }
            Err(_) => {}
        }
        self.last = Instant::now();
    }

    /// Says how to go on with work that a limit ended.
    pub(crate) fn say_how_to_go_on(&self) {
        if self.written > 0 {
            let path = self.path.display();
            screen::say(&format!("--resume {path} goes on from here"));
        }
    }
}

/// Writes a checkpoint beside the old one, and puts it in its place.
fn write(path: &Path, identity: &Identity, kept: &Kept<'_>) -> Result<(), Failure> {
    output::replace_file(path, |file| {
        container::write(file, &identity.text(), |out| kept.write(out)).map_err(output::Error::from)
    })?;
    Ok(())
}

/// Reads a checkpoint of this work.
pub(crate) fn read(path: &Path, identity: &Identity) -> Result<Checkpoint, Failure> {
    let failed = |message: String| failed(path, &message);
    let file = File::open(path).map_err(|e| failed(e.to_string()))?;
    let bytes = container::bytes(file).map_err(|e| failed(e.to_string()))?;
    let (there, state) = container::parts(&bytes).map_err(&failed)?;
    identity.check(there).map_err(&failed)?;
    Checkpoint::read(state).map_err(|e| inconsistent(path, e))
}

/// The state in the file contradicts itself, or this work.
pub(crate) fn inconsistent(path: &Path, error: Inconsistent) -> Failure {
    failed(path, &format!("is damaged, or of other work: {error}"))
}

fn failed(path: &Path, message: &str) -> Failure {
    Failure::Failed(format!("{}: {message}", path.display()))
}
