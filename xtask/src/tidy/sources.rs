//! Source files: each says what it is, and none is too long to read.

use super::Complaint;

/// A longer file holds more than one idea.
const MAX_LINES: usize = 700;

/// Files that may be longer, each with the reason.
const LONG_FILES: [(&str, &str); 0] = [];

/// Checks the first line and the length of one `.rs` file.
pub(super) fn check(file: &str, text: &str) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    if !text.starts_with("//!") && !text.starts_with("#![doc") {
        complaints.push(format!("{file}:1: the first line must be `//!` or `#![doc`"));
    }
    let lines = text.lines().count();
    if lines > MAX_LINES && !LONG_FILES.iter().any(|(long, _)| *long == file) {
        complaints.push(format!("{file}: has {lines} lines, more than {MAX_LINES}"));
    }
    complaints
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_says_nothing_about_itself_is_refused() {
        assert_eq!(check("a.rs", "//! A.\n"), Vec::<String>::new());
        assert_eq!(check("a.rs", "#![doc = include_str!(\"a\")]\n"), Vec::<String>::new());
        let expected = ["a.rs:1: the first line must be `//!` or `#![doc`"];
        assert_eq!(check("a.rs", "use std::fs;\n//! A.\n"), expected);
    }

    #[test]
    fn a_long_file_is_refused() {
        assert!(check("a.rs", &"//! A.\n".repeat(700)).is_empty());
        assert_eq!(check("a.rs", &"//! A.\n".repeat(701)), ["a.rs: has 701 lines, more than 700"]);
    }
}
