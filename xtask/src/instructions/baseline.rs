//! What was counted, as it is kept in JSON.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::toolchain::Toolchain;

/// All kernels with one toolchain.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Baseline {
    pub(super) toolchain: Toolchain,
    /// In the order of the program's list.
    pub(super) kernels: Vec<Counted>,
}

/// One kernel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Counted {
    pub(super) name: String,
    /// Above 0.
    pub(super) instructions: u64,
}

impl Baseline {
    /// Reads a kept baseline.
    ///
    /// # Errors
    /// Names the file, the line and what is wrong there.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let failed = |e: String| format!("{}: {e}", path.display());
        let text = fs::read_to_string(path).map_err(|e| failed(e.to_string()))?;
        Self::parse(&text).map_err(failed)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let read: Self = serde_json::from_str(text).map_err(|e| e.to_string())?;
        match read.kernels.iter().find(|kernel| kernel.instructions == 0) {
            Some(Counted { name, .. }) => {
                Err(format!("{name}: 0 instructions, expected at least one"))
            }
            None => Ok(read),
        }
    }

    /// The text to be kept.
    pub(super) fn text(&self) -> Result<String, String> {
        let text = serde_json::to_string_pretty(self).map_err(|e| e.to_string())?;
        Ok(text + "\n")
    }
}

/// A baseline to try things on.
#[cfg(test)]
pub(super) fn sample() -> Baseline {
    let counted = |(name, instructions): (&str, u64)| Counted { name: name.into(), instructions };
    Baseline {
        toolchain: Toolchain {
            rustc: "rustc 1.95.0 (59807616e 2026-04-14)".into(),
            host: "x86_64-unknown-linux-gnu".into(),
            valgrind: "valgrind-3.19.0".into(),
            libc: "glibc 2.36".into(),
        },
        kernels: [("a/one", 1_234_567), ("a/two", 1000), ("b/three", 20_000)].map(counted).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_comes_back() {
        let baseline = sample();
        assert_eq!(Baseline::parse(&baseline.text().unwrap()), Ok(baseline));
    }

    /// A change is a share of the count before, and there is no share of nothing.
    #[test]
    fn a_kernel_without_instructions_is_refused() {
        let text = sample().text().unwrap().replace("20000", "0");
        let refused = Baseline::parse(&text).unwrap_err();
        assert_eq!(refused, "b/three: 0 instructions, expected at least one");
        assert!(Baseline::parse("{}").is_err());
    }
}
