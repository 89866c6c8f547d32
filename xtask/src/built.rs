//! A release program of this workspace, built when it is needed.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// Builds the program `name` of a package with optimisation, and says where it lies.
pub(crate) fn program(root: &Path, package: &str, name: &str) -> Result<PathBuf, String> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let words =
        format!("build --release --package {package} --message-format json-render-diagnostics");
    println!("$ cargo {words}");
    let mut command = Command::new(cargo);
    // The messages are read, what cargo says to the user goes to the terminal.
    command.current_dir(root).args(words.split(' ')).stderr(Stdio::inherit());
    let built = command.output().map_err(|e| format!("cargo {words}: {e}"))?;
    if !built.status.success() {
        return Err(format!("failed: cargo {words}"));
    }
    executable(&String::from_utf8_lossy(&built.stdout), name)
        .ok_or_else(|| format!("cargo {words}: names no program `{name}`"))
}

/// The program's path among cargo's messages, a JSON object a line.
fn executable(messages: &str, name: &str) -> Option<PathBuf> {
    messages.lines().find_map(|line| {
        let message: Value = serde_json::from_str(line).ok()?;
        let is_it = message["target"]["name"] == name;
        is_it.then_some(())?;
        message["executable"].as_str().map(PathBuf::from)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_program_is_found_among_the_messages() {
        let messages = "\
            {\"reason\":\"compiler-artifact\",\"target\":{\"name\":\"glam\"},\"executable\":null}\n\
            not JSON\n\
            {\"target\":{\"name\":\"radiosity\"},\"executable\":\"/t/release/radiosity\"}\n";
        let found = executable(messages, "radiosity");
        assert_eq!(found, Some(PathBuf::from("/t/release/radiosity")));
        assert_eq!(executable(messages, "kernels"), None);
        assert_eq!(executable("{}\n", "radiosity"), None);
    }
}
