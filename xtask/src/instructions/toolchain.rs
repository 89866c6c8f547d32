//! What counts depend on besides the code: the compiler, valgrind, and the C library.

use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};

/// Versions, as the programs state them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Toolchain {
    /// `rustc 1.95.0 (59807616e 2026-04-14)`.
    pub(super) rustc: String,
    /// `x86_64-unknown-linux-gnu`.
    pub(super) host: String,
    /// `valgrind-3.19.0`.
    pub(super) valgrind: String,
    /// `glibc 2.36`, or `unknown`: copies, allocations and arc tangents are the library's.
    pub(super) libc: String,
}

impl Toolchain {
    /// That of this machine; nothing if valgrind is not installed.
    pub(super) fn here(root: &Path) -> Result<Option<Self>, String> {
        let Some(valgrind) = said(root, "valgrind", "--version")? else { return Ok(None) };
        // Cargo says which compiler it uses, if it is not the one of the path.
        let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
        let verbose = said(root, &rustc, "-vV")?.ok_or_else(|| format!("{rustc}: not found"))?;
        let libc = said(root, "getconf", "GNU_LIBC_VERSION").ok().flatten();
        Ok(Some(Self::of(&verbose, &valgrind, libc.as_deref())?))
    }

    /// From what each program says.
    fn of(rustc: &str, valgrind: &str, libc: Option<&str>) -> Result<Self, String> {
        let host = rustc.lines().find_map(|line| line.strip_prefix("host: "));
        let unknown = || format!("`rustc -vV` names no host, but: {rustc}");
        Ok(Self {
            rustc: first_line(rustc),
            host: host.ok_or_else(unknown)?.to_owned(),
            valgrind: first_line(valgrind),
            libc: libc.map_or_else(|| "unknown".into(), first_line),
        })
    }

    /// What is not as it was when the baseline was written: `rustc 1.96.0 instead of 1.95.0`.
    pub(super) fn differences(&self, baseline: &Self) -> Vec<String> {
        let pairs = [
            (&self.rustc, &baseline.rustc),
            (&self.host, &baseline.host),
            (&self.valgrind, &baseline.valgrind),
            (&self.libc, &baseline.libc),
        ];
        let differ = pairs.into_iter().filter(|(here, there)| here != there);
        differ.map(|(here, there)| format!("{here} instead of {there}")).collect()
    }
}

fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().trim().to_owned()
}

/// What a program prints; nothing if there is no such program.
fn said(root: &Path, program: &str, argument: &str) -> Result<Option<String>, String> {
    match Command::new(program).current_dir(root).arg(argument).output() {
        Ok(output) if output.status.success() => {
            Ok(Some(String::from_utf8_lossy(&output.stdout).into_owned()))
        }
        Ok(output) => Err(format!("{program} {argument}: {}", output.status)),
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
        Err(e) => Err(format!("{program}: {e}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RUSTC: &str = "rustc 1.95.0 (59807616e 2026-04-14)\nbinary: rustc\nhost: x86_64-unknown-linux-gnu\nrelease: 1.95.0\n";

    fn toolchain(rustc: &str) -> Toolchain {
        Toolchain::of(rustc, "valgrind-3.19.0\n", Some("glibc 2.36\n")).unwrap()
    }

    #[test]
    fn versions_are_read() {
        let Toolchain { rustc, host, valgrind, libc } = toolchain(RUSTC);
        assert_eq!((rustc.as_str(), host.as_str()), (&RUSTC[..35], "x86_64-unknown-linux-gnu"));
        assert_eq!((valgrind.as_str(), libc.as_str()), ("valgrind-3.19.0", "glibc 2.36"));
        assert_eq!(Toolchain::of(RUSTC, "valgrind-3.19.0", None).unwrap().libc, "unknown");
        assert!(Toolchain::of("rustc 1.95.0\n", "valgrind-3.19.0", None).is_err());
    }

    #[test]
    fn differences_are_named() {
        let here = toolchain(&RUSTC.replace("1.95.0 (59807616e 2026-04-14)", "1.96.0"));
        let found = here.differences(&toolchain(RUSTC));
        assert_eq!(found, ["rustc 1.96.0 instead of rustc 1.95.0 (59807616e 2026-04-14)"]);
        assert!(here.differences(&here).is_empty());
    }

    #[test]
    fn a_program_that_is_not_there_says_nothing() {
        assert_eq!(said(Path::new("."), "no-such-program-as-this", "--version"), Ok(None));
    }
}
