//! Words of OBJ and MTL text, with their places.

use crate::{Error, ErrorKind};

/// A word and where it begins, both counted from 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    pub(super) line: u32,
    pub(super) column: u32,
}

impl<'a> Token<'a> {
    /// A failure at this word.
    pub(super) fn expected(self, file: &str, what: &str) -> Error {
        Error::new(ErrorKind::Syntax, file, format!("expected {what}, found {:?}", self.text))
            .at(self.line.into(), self.column.into())
    }

    /// The word as a number; `nan` and `inf` are numbers here, for the caller to judge.
    pub(super) fn number(self, file: &str) -> Result<f64, Error> {
        self.text.parse().map_err(|_| self.expected(file, "a number"))
    }

    /// The word as a finite number.
    pub(super) fn finite(self, file: &str) -> Result<f64, Error> {
        let number = self.number(file)?;
        if number.is_finite() { Ok(number) } else { Err(self.expected(file, "a finite number")) }
    }

    /// The word after its first `bytes` bytes.
    pub(super) fn skip(self, bytes: usize) -> Self {
        Self { text: &self.text[bytes..], column: self.column + bytes as u32, ..self }
    }
}

/// Calls `visit` with the words of each line that has any; a backslash at the end of a
/// line joins the next one to it.
pub(super) fn for_each_line<'a>(
    text: &'a str,
    mut visit: impl FnMut(&[Token<'a>]) -> Result<(), Error>,
) -> Result<(), Error> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut words = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let number = u32::try_from(index + 1).unwrap_or(u32::MAX);
        let (line, goes_on) = match line.trim_end().strip_suffix('\\') {
            Some(line) => (line, true),
            None => (line, false),
        };
        for word in line.split_whitespace() {
            // A word is a part of its line, so the distance between the two is its column.
            let column = word.as_ptr() as usize - line.as_ptr() as usize + 1;
            words.push(Token { text: word, line: number, column: column as u32 });
        }
        if !goes_on {
            visit_words(&mut words, &mut visit)?;
        }
    }
    visit_words(&mut words, &mut visit)
}

fn visit_words<'a>(
    words: &mut Vec<Token<'a>>,
    visit: &mut impl FnMut(&[Token<'a>]) -> Result<(), Error>,
) -> Result<(), Error> {
    if words.first().is_some_and(|first| !first.text.starts_with('#')) {
        visit(words)?;
    }
    words.clear();
    Ok(())
}

/// The words up to a comment. Names are not cut this way: they may hold a `#`.
pub(super) fn without_comment<'a, 't>(words: &'t [Token<'a>]) -> &'t [Token<'a>] {
    let end = words.iter().position(|word| word.text.starts_with('#')).unwrap_or(words.len());
    &words[..end]
}

/// The words as one name.
pub(super) fn name(words: &[Token<'_>]) -> String {
    words.iter().map(|word| word.text).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_survive_joined_lines_comments_and_a_byte_order_mark() {
        let text = "\u{feff}# all\r\nv 1  2\\\r\n  3 # x\n\n  f é g\n\\";
        let mut seen = Vec::new();
        for_each_line(text, |words| {
            let words = without_comment(words);
            seen.push(
                words.iter().map(|w| (w.text.to_owned(), w.line, w.column)).collect::<Vec<_>>(),
            );
            Ok(())
        })
        .unwrap();
        let word = |text: &str, line, column| (text.to_owned(), line, column);
        assert_eq!(
            seen,
            [
                vec![word("v", 2, 1), word("1", 2, 3), word("2", 2, 6), word("3", 3, 3)],
                vec![word("f", 5, 3), word("é", 5, 5), word("g", 5, 8)],
            ]
        );
    }
}
