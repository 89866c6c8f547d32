//! Where and with what a matrix was measured.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::precision::{Machine, Program};

/// What records are of: other machines or programs have other records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Host {
    /// The day of the first run, UTC.
    pub(super) date: String,
    pub(super) host: String,
    pub(super) cpu: String,
    pub(super) cores: usize,
    /// Bytes of memory; nothing where the system does not tell.
    pub(super) memory: Option<u64>,
    pub(super) system: String,
    pub(super) toolchain: String,
    /// Of the sources; `-dirty` where files differ from it.
    pub(super) revision: String,
    /// CRC-32 of the program: what is timed, whatever the sources say.
    pub(super) program: String,
}

impl Host {
    /// This machine, called `name` if given, with this program.
    pub(super) fn this(root: &Path, program: &Program, name: Option<&str>) -> Result<Self, String> {
        let Machine { cpu, cores } = Machine::this();
        let facts = |name: &str| fs::read_to_string(name).ok().map(|text| text.trim().to_owned());
        let kernel = facts("/proc/sys/kernel/osrelease").unwrap_or_default();
        let own = facts("/proc/sys/kernel/hostname");
        let host = slug(name.or(own.as_deref()).unwrap_or("host"));
        Ok(Self {
            date: jiff::Timestamp::now().strftime("%F").to_string(),
            host: if host.is_empty() { "host".into() } else { host },
            cpu,
            cores,
            memory: facts("/proc/meminfo").as_deref().and_then(total),
            system: format!("{} {kernel}", std::env::consts::OS).trim().to_owned(),
            toolchain: said(root, "rustc", &["--version"])?,
            revision: said(root, "git", &["describe", "--always", "--dirty"])
                .unwrap_or_else(|_| "unknown".into()),
            program: format!("{:08x}", crc32fast::hash(&program.bytes()?)),
        })
    }

    /// The folder of its records.
    pub(super) fn folder(&self) -> String {
        format!("{}-{}", self.date, self.host)
    }

    /// Whether times are of the same machine, as far as one can see.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.cpu == other.cpu && self.cores == other.cores
    }

    /// Whether runs of both may stand in one list: machine and program are the same. The day may be
    /// another, and so may the revision, as long as it makes the same program.
    pub(super) fn may_go_on(&self, other: &Self) -> bool {
        let Self { date, revision, .. } = self.clone();
        *self == Self { date, revision, ..other.clone() }
    }
}

/// Small letters, digits and single hyphens: fit for a folder's name.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_ascii_lowercase).collect::<Vec<_>>().join("-")
}

/// Bytes of memory by /proc/meminfo.
fn total(facts: &str) -> Option<u64> {
    let line = facts.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    Some(line.trim().strip_suffix("kB")?.trim_end().parse::<u64>().ok()? * 1024)
}

/// The line that a command prints.
fn said(root: &Path, program: &str, words: &[&str]) -> Result<String, String> {
    let failed = |e: String| format!("{program} {}: {e}", words.join(" "));
    let output = Command::new(program).args(words).current_dir(root).output();
    let output = output.map_err(|e| failed(e.to_string()))?;
    if !output.status.success() {
        return Err(failed(output.status.to_string()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn names_become_folders() {
        assert_eq!(slug("AMD EPYC (2 cores)"), "amd-epyc-2-cores");
        assert_eq!(slug("../../etc"), "etc");
        assert_eq!(sample::host().folder(), "2026-01-31-some-host");
    }

    #[test]
    fn memory_is_read() {
        assert_eq!(total("MemFree: 1 kB\n"), None);
        assert_eq!(total("MemFree: 1 kB\nMemTotal:       16 kB\n"), Some(16384));
    }

    #[test]
    fn the_program_must_be_the_same() {
        let host = sample::host();
        let later = Host { date: "2026-02-01".into(), revision: "f".into(), ..host.clone() };
        assert!(host.may_go_on(&later));
        let rebuilt = Host { program: "0".into(), ..host.clone() };
        assert!(!host.may_go_on(&rebuilt) && host.is_like(&rebuilt));
        assert!(!host.is_like(&Host { cores: 16, ..host.clone() }));
    }
}
