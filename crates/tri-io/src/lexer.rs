//! Bytes to words and numbers, with their line and column, through a buffer of fixed size.

use std::io::{self, Read};

use crate::decimal::{self, ends_word};
use crate::{Error, ErrorKind, Expected, Found};

/// Bytes read at once: large enough to hide the cost of a read, small enough for a cache.
const BUFFER_SIZE: usize = 256 * 1024;

/// The longest number that is read. The longest that is ever needed, the exact decimal of the
/// smallest `f64`, has 1077 bytes.
pub(crate) const MAX_WORD: usize = 4096;

/// Bytes of an offending word that a message quotes.
const MAX_QUOTE: usize = 32;

/// A cursor over a source of bytes.
#[derive(Debug)]
pub(crate) struct Lexer<R> {
    source: R,
    buffer: Box<[u8]>,
    /// The unread bytes are `buffer[start..end]`.
    start: usize,
    end: usize,
    /// Bytes of the source that went before `buffer[0]`.
    passed: u64,
    line: u64,
    /// Bytes of the source that go before the cursor's line.
    line_start: u64,
}

impl<R: Read> Lexer<R> {
    pub(crate) fn new(source: R) -> Self {
        let buffer = vec![0; BUFFER_SIZE].into_boxed_slice();
        Self { source, buffer, start: 0, end: 0, passed: 0, line: 1, line_start: 0 }
    }

    /// The cursor's line, counted from 1.
    pub(crate) fn line(&self) -> u64 {
        self.line
    }

    /// Moves to the next word and gives its first byte, or `None` at the end of the file.
    #[inline]
    pub(crate) fn peek(&mut self) -> Result<Option<u8>, Error> {
        loop {
            while let Some(&byte) = self.buffer[..self.end].get(self.start) {
                if !ends_word(byte) {
                    return Ok(Some(byte));
                }
                self.start += 1;
                if byte == b'\n' {
                    self.line += 1;
                    self.line_start = self.passed + self.start as u64;
                } else if byte == b'#' {
                    self.skip_comment()?;
                }
            }
            if !self.refill()? {
                return Ok(None);
            }
        }
    }

    /// Reads the next word as a finite number; stays before it, giving `None`, if it is not one.
    #[inline]
    pub(crate) fn number(&mut self) -> Result<Option<f64>, Error> {
        if self.peek()?.is_none() {
            return Ok(None);
        }
        if let Some((value, length)) = decimal::fast_prefix(&self.buffer[self.start..self.end]) {
            self.start += length;
            return Ok(Some(value));
        }
        self.parsed(decimal::parse)
    }

    /// Reads the next word as an integer from 0 to 255; stays before it if it is not one.
    #[inline]
    pub(crate) fn channel(&mut self) -> Result<Option<u8>, Error> {
        if self.peek()?.is_none() {
            return Ok(None);
        }
        let unread = &self.buffer[self.start..self.end];
        if let Some((value, length)) = decimal::fast_channel(unread) {
            self.start += length;
            return Ok(Some(value));
        }
        self.parsed(|word| std::str::from_utf8(word).ok()?.parse().ok())
    }

    /// Steps over the next word if it is `expected`, and says whether it was.
    #[inline]
    pub(crate) fn keyword(&mut self, expected: &[u8]) -> Result<bool, Error> {
        let matches = self.peek()?.is_some() && self.word()? == expected;
        if matches {
            self.start += expected.len();
        }
        Ok(matches)
    }

    /// The error that the next word, or the end of the file, is not what was expected.
    #[cold]
    pub(crate) fn unexpected(&mut self, expected: Expected) -> Error {
        let found = match self.peek() {
            Err(error) => return error,
            Ok(None) => Found::EndOfFile,
            Ok(Some(_)) => match self.word() {
                Err(error) => return error,
                Ok(word) => Found::Word(quote(word)),
            },
        };
        Error::new(ErrorKind::Unexpected { expected, found }, self.place())
    }

    /// The word at the cursor, without stepping over it; cut once it is longer than `MAX_WORD`.
    #[inline]
    pub(crate) fn word(&mut self) -> Result<&[u8], Error> {
        let mut length = 0;
        loop {
            let unread = &self.buffer[self.start..self.end];
            let rest = &unread[length..];
            let end = rest.iter().position(|&byte| ends_word(byte));
            length += end.unwrap_or(rest.len());
            if end.is_some() || length > MAX_WORD || !self.refill()? {
                break;
            }
        }
        Ok(&self.buffer[self.start..self.start + length.min(MAX_WORD + 1)])
    }

    /// Steps over the word at the cursor if `parse` takes it; a cut word is not even tried.
    fn parsed<T>(&mut self, parse: impl FnOnce(&[u8]) -> Option<T>) -> Result<Option<T>, Error> {
        let word = self.word()?;
        let length = word.len();
        let value = if length > MAX_WORD { None } else { parse(word) };
        if value.is_some() {
            self.start += length;
        }
        Ok(value)
    }

    /// Moves to the line break that ends the comment, or to the end of the file.
    fn skip_comment(&mut self) -> Result<(), Error> {
        loop {
            let unread = &self.buffer[self.start..self.end];
            match unread.iter().position(|&byte| byte == b'\n') {
                Some(length) => {
                    self.start += length;
                    return Ok(());
                }
                None => self.start = self.end,
            }
            if !self.refill()? {
                return Ok(());
            }
        }
    }

    /// Adds bytes after the unread ones, which may move; says `false` at the end of the file.
    #[cold]
    fn refill(&mut self) -> Result<bool, Error> {
        if self.start == self.end || self.end == self.buffer.len() {
            // The unread bytes are at most a word, so this makes room.
            self.buffer.copy_within(self.start..self.end, 0);
            self.passed += self.start as u64;
            self.end -= self.start;
            self.start = 0;
        }
        loop {
            match self.source.read(&mut self.buffer[self.end..]) {
                Ok(count) => {
                    self.end += count;
                    return Ok(count != 0);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(Error::new(ErrorKind::Io(error), self.place())),
            }
        }
    }

    /// The cursor's line and column, both counted from 1.
    fn place(&self) -> (u64, u64) {
        (self.line, self.passed + self.start as u64 - self.line_start + 1)
    }
}

/// The beginning of a word, fit for a message.
fn quote(word: &[u8]) -> String {
    if word.len() <= MAX_QUOTE {
        String::from_utf8_lossy(word).into_owned()
    } else {
        String::from_utf8_lossy(&word[..MAX_QUOTE]).into_owned() + "…"
    }
}
