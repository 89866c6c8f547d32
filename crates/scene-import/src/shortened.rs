//! Names in messages: short, and on one line.

use std::fmt;

/// Characters of a name that a message quotes. A name may be as long as its file, and stand in the
/// message of each triangle.
const LONGEST: usize = 60;

/// A name, cut if it is long.
pub(crate) fn shortened(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

/// Text on one line: what steers a terminal is spelt out, as a file's names go to one.
pub(crate) struct OneLine<'a>(pub(crate) &'a str);

impl fmt::Display for OneLine<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for piece in self.0.split_inclusive(char::is_control) {
            match piece.char_indices().next_back() {
                Some((at, last)) if last.is_control() => {
                    write!(f, "{}{}", &piece[..at], last.escape_default())?;
                }
                _ => f.write_str(piece)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_are_cut_between_characters() {
        assert_eq!(shortened("wall"), "wall");
        assert_eq!(shortened(&"é".repeat(60)), "é".repeat(60));
        assert_eq!(shortened(&"é".repeat(61)), "é".repeat(60) + "…");
    }

    #[test]
    fn what_steers_a_terminal_is_spelt_out() {
        assert_eq!(OneLine("Wand, grün").to_string(), "Wand, grün");
        assert_eq!(OneLine("a\nb\u{1b}[2Jé\r").to_string(), "a\\nb\\u{1b}[2Jé\\r");
    }
}
