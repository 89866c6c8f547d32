//! Records from a stream of text.

use std::io::Read;
use std::iter::FusedIterator;

use crate::lexer::{Lexer, MAX_WORD};
use crate::{Error, Expected, TriRecord};

/// The word that begins a record.
const KEYWORD: &[u8] = b"Triangle";

/// Reads records one at a time, in bounded memory however long the file is.
///
/// It holds a buffer of 256 KiB, so the source needs none of its own. A record without normals
/// ends where the next word is not a number, so it comes out once that word's first byte is read.
/// After an error the iterator ends.
///
/// # Errors
/// The first word that does not belong where it stands, the end of the file within a record, and
/// failures of the source.
///
/// # Examples
/// ```
/// let text = "Triangle\n255 0 0  0 0 0\n0 0 0\n1 0 0\n0 1 0\nTriangle\n255 0 0  0 0";
/// let mut reader = tri_io::Reader::new(text.as_bytes());
/// let record = reader.next().unwrap()?;
/// assert_eq!(record.front, [255, 0, 0]);
/// assert_eq!(record.vertices[2], [0.0, 1.0, 0.0]);
///
/// let error = reader.next().unwrap().unwrap_err();
/// assert_eq!(error.to_string(), "7:13: expected an integer from 0 to 255, found end of file");
/// assert!(reader.next().is_none());
/// # Ok::<(), tri_io::Error>(())
/// ```
#[derive(Debug)]
pub struct Reader<R> {
    lexer: Lexer<R>,
    line: u64,
    ended: bool,
}

impl<R: Read> Reader<R> {
    /// Starts reading at the source's next byte.
    pub fn new(source: R) -> Self {
        Self { lexer: Lexer::new(source), line: 1, ended: false }
    }

    /// The line, counted from 1, where the last record began, the failed one included.
    ///
    /// # Examples
    /// ```
    /// let text = "# two corners coincide\nTriangle 9 9 9 0 0 0\n0 0 0\n1 0 0\n1 0 0\n";
    /// let mut reader = tri_io::Reader::new(text.as_bytes());
    /// assert!(reader.next().unwrap().is_ok());
    /// assert_eq!(reader.line(), 2);
    /// ```
    #[must_use]
    pub fn line(&self) -> u64 {
        self.line
    }

    fn record(&mut self) -> Result<Option<TriRecord>, Error> {
        if self.lexer.peek()?.is_none() {
            return Ok(None);
        }
        self.line = self.lexer.line();
        if !self.lexer.keyword(KEYWORD)? {
            return Err(self.lexer.unexpected(Expected::Keyword));
        }
        let front = self.colour()?;
        let back = self.colour()?;
        let (vertices, normals) = self.corners()?;
        Ok(Some(TriRecord { front, back, vertices, normals }))
    }

    fn colour(&mut self) -> Result<[u8; 3], Error> {
        let mut colour = [0; 3];
        for channel in &mut colour {
            *channel = match self.lexer.channel()? {
                Some(value) => value,
                None => return Err(self.lexer.unexpected(Expected::Channel)),
            };
        }
        Ok(colour)
    }

    /// Reads 9 numbers, or 18 if normals are held.
    ///
    /// How many numbers follow decides, in any layout. Only a first vertex with exactly six
    /// numbers on a line of its own always means normals: else a file with normals that was cut
    /// after nine numbers would pass, with a normal taken for a vertex.
    #[inline]
    fn corners(&mut self) -> Result<Corners, Error> {
        let colour_line = self.lexer.line();
        let mut numbers = [0.0; 18];
        let mut lines = [0; 9];
        for index in 0..9 {
            numbers[index] = self.coordinate(index)?;
            lines[index] = self.lexer.line();
        }
        let six_on_own_line =
            lines[0] != colour_line && lines[5] == lines[0] && lines[6] != lines[0];
        if six_on_own_line || self.number_follows()? {
            let first_goes_on = lines[3] == lines[2];
            return self.with_normals(numbers, first_goes_on);
        }
        let [x0, y0, z0, x1, y1, z1, x2, y2, z2, ..] = numbers;
        Ok(([[x0, y0, z0], [x1, y1, z1], [x2, y2, z2]], None))
    }

    /// Reads the numbers after the ninth.
    ///
    /// If the first vertex ends its line there is hardly room for normals, so a wrong count is
    /// blamed on the tenth number: a `Triangle` is missing before it. If the line goes on, the
    /// place where the numbers end, or should have ended, is blamed.
    fn with_normals(
        &mut self,
        mut numbers: [f64; 18],
        first_goes_on: bool,
    ) -> Result<Corners, Error> {
        let tenth = (!first_goes_on).then(|| self.lexer.unexpected(Expected::Keyword));
        for (index, number) in numbers.iter_mut().enumerate().skip(9) {
            if !self.number_follows()? {
                return Err(tenth.unwrap_or_else(|| self.not_a_coordinate(index)));
            }
            *number = self.coordinate(index)?;
        }
        if self.number_follows()? {
            return Err(tenth.unwrap_or_else(|| self.lexer.unexpected(Expected::Keyword)));
        }
        let triple = |first: usize| [numbers[first], numbers[first + 1], numbers[first + 2]];
        Ok(([triple(0), triple(6), triple(12)], Some([triple(3), triple(9), triple(15)])))
    }

    #[inline]
    fn coordinate(&mut self, index: usize) -> Result<f64, Error> {
        match self.lexer.number()? {
            Some(value) => Ok(value),
            None => Err(self.not_a_coordinate(index)),
        }
    }

    /// Whether the next word looks like a number, one that is misspelt or not finite included.
    #[inline]
    fn number_follows(&mut self) -> Result<bool, Error> {
        Ok(self.lexer.peek()?.is_some_and(|byte| {
            matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'n' | b'N' | b'i' | b'I')
        }))
    }

    /// The error that no number stands here: none at all, a bad one, or one that is too long.
    #[cold]
    fn not_a_coordinate(&mut self, index: usize) -> Error {
        let expected = match self.lexer.peek() {
            Err(error) => return error,
            Ok(None) => Expected::Coordinate(index as u8 + 1),
            Ok(Some(_)) => match self.lexer.word() {
                Err(error) => return error,
                Ok(word) if word == KEYWORD => Expected::Coordinate(index as u8 + 1),
                Ok(word) if word.len() > MAX_WORD => Expected::ShortNumber,
                Ok(_) => Expected::Number,
            },
        };
        self.lexer.unexpected(expected)
    }
}

type Corners = ([[f64; 3]; 3], Option<[[f64; 3]; 3]>);

impl<R: Read> Iterator for Reader<R> {
    type Item = Result<TriRecord, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let item = self.record().transpose();
        self.ended = !matches!(item, Some(Ok(_)));
        item
    }
}

impl<R: Read> FusedIterator for Reader<R> {}
