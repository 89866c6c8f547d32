//! Words of a View3D file, with their places.

use crate::{Error, ErrorKind};

/// The words of one line that are still to be read.
pub(super) struct Words<'a> {
    file: &'a str,
    text: &'a str,
    line: u64,
    at: usize,
}

/// A word and its column in bytes, counted from 1.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    pub(super) text: &'a str,
    column: u64,
}

impl<'a> Words<'a> {
    /// The words of the line `line`, counted from 1. What stands between words, and a `!`
    /// at the begin of one, is as View3D has it: blanks, commas and NULs, and a comment.
    pub(super) fn new(file: &'a str, text: &'a str, line: u64) -> Self {
        Self { file, text, line, at: 0 }
    }

    /// The number of the line, counted from 1.
    pub(super) fn line(&self) -> u64 {
        self.line
    }

    /// The next word of the line, if there is one.
    pub(super) fn next_word(&mut self) -> Option<Word<'a>> {
        let parts = |c: char| c.is_whitespace() || c == ',' || c == '\0';
        let rest = &self.text[self.at..];
        let start = self.at + rest.find(|c| !parts(c)).unwrap_or(rest.len());
        let rest = &self.text[start..];
        if rest.is_empty() || rest.starts_with('!') {
            self.at = self.text.len();
            return None;
        }
        self.at = start + rest.find(parts).unwrap_or(rest.len());
        Some(Word { text: &self.text[start..self.at], column: start as u64 + 1 })
    }

    /// The next word, which must be there.
    pub(super) fn word(&mut self, what: &str) -> Result<Word<'a>, Error> {
        let end = self.text.trim_end().len() as u64 + 1;
        self.next_word().ok_or_else(|| {
            let message = format!("expected {what}, found the end of the line");
            Error::new(ErrorKind::Syntax, self.file, message).at(self.line, end)
        })
    }

    /// The next word as a number that is `sound`; `what` says which those are.
    pub(super) fn number(&mut self, what: &str, sound: impl Fn(f64) -> bool) -> Result<f64, Error> {
        let word = self.word(what)?;
        match word.text.parse() {
            Ok(number) if sound(number) => Ok(number),
            _ => Err(self.expected(word, what)),
        }
    }

    /// The next word as a whole number from `range`.
    pub(super) fn whole(
        &mut self,
        what: &str,
        range: std::ops::RangeInclusive<usize>,
    ) -> Result<usize, Error> {
        let word = self.word(what)?;
        match word.text.parse() {
            Ok(number) if range.contains(&number) => Ok(number),
            _ => Err(self.expected(word, what)),
        }
    }

    /// A failure at `word`.
    pub(super) fn expected(&self, word: Word<'_>, what: &str) -> Error {
        let message = format!("expected {what}, found {:?}", word.text);
        Error::new(ErrorKind::Syntax, self.file, message).at(self.line, word.column)
    }
}
