//! Text as rows, with the place of whatever is wrong.

use std::io::{BufRead, BufReader, Read};

use scene::Rgb;

use super::Row;
use crate::{Error, ErrorKind};

/// The columns that the reader knows; the first five must be there.
const COLUMNS: [&str; 10] =
    ["triangle", "area", "B_r", "B_g", "B_b", "se_r", "se_g", "se_b", "emits", "ambiguous"];
const REQUIRED: usize = 5;
const STANDARD_ERROR: std::ops::Range<usize> = 5..8;

/// Reads rows by the names in the first line, in any order: `triangle`, `area`, `B_r`,
/// `B_g`, `B_b`, and where present `se_r`, `se_g`, `se_b`, `emits`, `ambiguous` (0 or 1).
/// Other columns are passed over.
///
/// # Errors
/// [`ErrorKind::Text`] with line and column for a missing, repeated or malformed value;
/// [`ErrorKind::Read`] for what the source answers.
///
/// # Examples
/// ```
/// let text = "emits,triangle,area,B_r,B_g,B_b\n1,0,2.5,7,8,9\n";
/// let rows = output::csv::read(text.as_bytes())?;
/// assert_eq!(rows[0].exitance.0, [7.0, 8.0, 9.0]);
/// assert!(rows[0].emits);
/// let error = output::csv::read("triangle,area,B_r,B_g\n".as_bytes()).unwrap_err();
/// assert_eq!(error.to_string(), "1:22: expected a column named B_b");
/// # Ok::<(), output::Error>(())
/// ```
pub fn read(source: impl Read) -> Result<Vec<Row>, Error> {
    let mut source = BufReader::new(source);
    let mut bytes = Vec::new();
    let mut header: Option<Header> = None;
    let mut rows = Vec::new();
    for line in 1.. {
        bytes.clear();
        let length = source.read_until(b'\n', &mut bytes);
        if length.map_err(|e| Error::caused(ErrorKind::Read, e))? == 0 {
            break;
        }
        let text = Line::new(line, &bytes)?;
        match &header {
            None => header = Some(Header::read(&text)?),
            Some(header) => rows.push(header.row(&text)?),
        }
    }
    match header {
        Some(_) => Ok(rows),
        None => Err(fail(1, 1, "expected a first line that names the columns")),
    }
}

/// Where each known column stands.
struct Header {
    fields: usize,
    places: [Option<usize>; COLUMNS.len()],
}

impl Header {
    fn read(line: &Line) -> Result<Self, Error> {
        let mut places = [None; COLUMNS.len()];
        let mut fields = 0;
        for (at, name) in line.fields() {
            if let Some(known) = COLUMNS.iter().position(|c| *c == name)
                && places[known].replace(fields).is_some()
            {
                return Err(line.fail(at, format!("a second column named {name}")));
            }
            fields += 1;
        }
        let absent = |i: &usize| places[*i].is_none();
        if let Some(i) = (0..REQUIRED).find(absent) {
            return Err(line.fail(line.end(), format!("expected a column named {}", COLUMNS[i])));
        }
        if let Some(i) = STANDARD_ERROR.clone().find(absent)
            && !STANDARD_ERROR.clone().all(|i| absent(&i))
        {
            let message = format!("expected a column named {} beside the others", COLUMNS[i]);
            return Err(line.fail(line.end(), message));
        }
        Ok(Self { fields, places })
    }

    fn row(&self, line: &Line) -> Result<Row, Error> {
        let fields: Vec<_> = line.fields().collect();
        if fields.len() != self.fields {
            let (given, named) = (fields.len(), self.fields);
            // The first field too many, or where the next one should follow.
            let at = fields.get(named).map_or(line.end(), |f| f.0);
            return Err(line.fail(at, format!("{given} values for {named} columns")));
        }
        let get = |column: usize| self.places[column].map(|place| (column, fields[place]));
        // The header has checked that the first five are there; the loop keeps it so.
        let number = |column| line.number(get(column)).map(Option::unwrap_or_default);
        let flag = |column| line.flag(get(column));
        Ok(Row {
            triangle: line.index(get(0))?,
            area: line.not_negative(get(1))?.unwrap_or_default(),
            exitance: Rgb([number(2)?, number(3)?, number(4)?]),
            se: match [5, 6, 7].map(|c| line.not_negative(get(c))) {
                [r, g, b] => match (r?, g?, b?) {
                    (Some(r), Some(g), Some(b)) => Some(Rgb([r, g, b])),
                    _ => None,
                },
            },
            emits: flag(8)?,
            ambiguous: flag(9)?,
        })
    }
}

/// A column's number, and the field that stands in it with its place in the line.
type Field<'a> = Option<(usize, (usize, &'a str))>;

/// A line of text that knows where it is.
struct Line<'a> {
    number: usize,
    text: &'a str,
}

impl<'a> Line<'a> {
    fn new(number: usize, bytes: &'a [u8]) -> Result<Self, Error> {
        match std::str::from_utf8(bytes) {
            Ok(text) => {
                let text = text.strip_suffix('\n').unwrap_or(text);
                Ok(Self { number, text: text.strip_suffix('\r').unwrap_or(text) })
            }
            Err(error) => {
                let good = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
                Err(fail(number, good.chars().count() + 1, "expected UTF-8 text"))
            }
        }
    }

    /// The values between the commas, each with its byte offset.
    fn fields(&self) -> impl Iterator<Item = (usize, &'a str)> + use<'a> {
        let mut next = 0;
        self.text.split(',').map(move |field| {
            let at = next;
            next += field.len() + 1;
            (at, field.trim())
        })
    }

    fn end(&self) -> usize {
        self.text.len()
    }

    fn fail(&self, at: usize, message: impl Into<String>) -> Error {
        fail(self.number, self.text[..at].chars().count() + 1, message)
    }

    fn expected(&self, (column, (at, text)): (usize, (usize, &str)), what: &str) -> Error {
        self.fail(at, format!("{}: expected {what}, found {text:?}", COLUMNS[column]))
    }

    fn number(&self, field: Field) -> Result<Option<f64>, Error> {
        let read = |field: (usize, (usize, &str))| match field.1.1.parse() {
            Ok(value) if f64::is_finite(value) => Ok(value),
            _ => Err(self.expected(field, "a finite number")),
        };
        field.map(read).transpose()
    }

    fn not_negative(&self, field: Field) -> Result<Option<f64>, Error> {
        match (self.number(field)?, field) {
            (Some(value), Some(field)) if value < 0.0 => {
                Err(self.expected(field, "a number of at least 0"))
            }
            (value, _) => Ok(value),
        }
    }

    fn index(&self, field: Field) -> Result<u32, Error> {
        let read = |field: (usize, (usize, &str))| {
            field.1.1.parse().map_err(|_| self.expected(field, "a triangle's number"))
        };
        field.map_or(Ok(0), read)
    }

    fn flag(&self, field: Field) -> Result<bool, Error> {
        match field {
            None => Ok(false),
            Some((_, (_, "0"))) => Ok(false),
            Some((_, (_, "1"))) => Ok(true),
            Some(field) => Err(self.expected(field, "0 or 1")),
        }
    }
}

fn fail(line: usize, column: usize, message: impl Into<String>) -> Error {
    Error::new(ErrorKind::Text { line, column, message: message.into() })
}
