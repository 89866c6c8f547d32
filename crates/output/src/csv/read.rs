//! Text as rows, with the place of whatever is wrong.

use std::io::{BufRead, BufReader, Read};

use scene::Rgb;

use super::places::PLACE_SLACK;
use super::{FreePlace, Place, Places, Row};
use crate::{Error, ErrorKind};

/// The columns that the reader knows; those of [`ROW`], [`PLACE`] or [`FREE`] must be there.
const COLUMNS: [&str; 18] = [
    "triangle",
    "area",
    "B_r",
    "B_g",
    "B_b",
    "se_r",
    "se_g",
    "se_b",
    "emits",
    "ambiguous",
    "u",
    "v",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
];
const ROW: [usize; 5] = [0, 1, 2, 3, 4];
const PLACE: [usize; 3] = [0, 10, 11];
const FREE: [usize; 6] = [12, 13, 14, 15, 16, 17];
const STANDARD_ERROR: std::ops::Range<usize> = 5..8;
const UV: std::ops::Range<usize> = 10..12;

/// The length of a normal that was divided by its length differs from 1 by no more: the rounding of
/// a handful of operations.
const UNIT_SLACK: f64 = 4.0 * f64::EPSILON;

/// Bytes of a line: far more than any table has, and little enough for a source without end.
const MAX_LINE: u64 = 1 << 20;

/// Reads rows by the names in the first line, in any order: `triangle`, `area`, `B_r`,
/// `B_g`, `B_b`, and where present `se_r`, `se_g`, `se_b`, `emits`, `ambiguous` (0 or 1), `u`,
/// `v`. Other columns are passed over.
///
/// # Errors
/// [`ErrorKind::Text`] with line and column for a missing, repeated or malformed value, and for a
/// line of a mebibyte or more;
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
    let add = |rows: &mut Vec<Row>, header: &Header, line: &Line| {
        rows.push(header.row(line)?);
        Ok(())
    };
    lines(source, |_| &ROW, |_| Vec::new(), add)
}

/// Reads the columns of places on surfaces, or those of places in the open where they are named and
/// `triangle` is not.
pub(super) fn places(source: impl Read) -> Result<Places, Error> {
    let required = |has: &dyn Fn(usize) -> bool| -> &'static [usize] {
        if !has(PLACE[0]) && FREE.into_iter().any(has) { &FREE } else { &PLACE }
    };
    let none = |header: &Header| match header.places[PLACE[0]] {
        Some(_) => Places::Surface(Vec::new()),
        None => Places::Free(Vec::new()),
    };
    let add = |places: &mut Places, header: &Header, line: &Line| {
        match places {
            Places::Surface(all) => all.push(header.place(line)?),
            Places::Free(all) => all.push(header.free_place(line)?),
        }
        Ok(())
    };
    lines(source, required, none, add)
}

/// Reads the header, which says what it needs and what to begin with, and then adds each line.
fn lines<T>(
    source: impl Read,
    required: impl Fn(&dyn Fn(usize) -> bool) -> &'static [usize],
    none: impl Fn(&Header) -> T,
    add: impl Fn(&mut T, &Header, &Line) -> Result<(), Error>,
) -> Result<T, Error> {
    let mut source = BufReader::new(source);
    let mut bytes = Vec::new();
    let mut read: Option<(Header, T)> = None;
    for line in 1.. {
        bytes.clear();
        let length = source.by_ref().take(MAX_LINE).read_until(b'\n', &mut bytes);
        let length = length.map_err(|e| Error::caused(ErrorKind::Read, e))?;
        if length == 0 {
            break;
        }
        if length as u64 == MAX_LINE {
            return Err(fail(line, 1, format!("expected a line of less than {MAX_LINE} bytes")));
        }
        let text = Line::new(line, &bytes)?;
        match &mut read {
            None => {
                let header = Header::read(&text, &required)?;
                let values = none(&header);
                read = Some((header, values));
            }
            Some((header, values)) => add(values, header, &text)?,
        }
    }
    match read {
        Some((_, values)) => Ok(values),
        None => Err(fail(1, 1, "expected a first line that names the columns")),
    }
}

/// Where each known column stands.
struct Header {
    fields: usize,
    places: [Option<usize>; COLUMNS.len()],
}

impl Header {
    fn read(
        line: &Line,
        required: &impl Fn(&dyn Fn(usize) -> bool) -> &'static [usize],
    ) -> Result<Self, Error> {
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
        let required = required(&|i| places[i].is_some());
        if let Some(i) = required.iter().copied().find(absent) {
            return Err(line.fail(line.end(), format!("expected a column named {}", COLUMNS[i])));
        }
        for mut group in [STANDARD_ERROR, UV] {
            if let Some(i) = group.clone().find(absent)
                && !group.all(|i| absent(&i))
            {
                let message = format!("expected a column named {} beside the others", COLUMNS[i]);
                return Err(line.fail(line.end(), message));
            }
        }
        Ok(Self { fields, places })
    }

    /// The values of a line, as many as there are columns.
    fn fields<'a>(&self, line: &Line<'a>) -> Result<Vec<(usize, &'a str)>, Error> {
        let fields: Vec<_> = line.fields().collect();
        if fields.len() != self.fields {
            let (given, named) = (fields.len(), self.fields);
            // The first field too many, or where the next one should follow.
            let at = fields.get(named).map_or(line.end(), |f| f.0);
            return Err(line.fail(at, format!("{given} values for {named} columns")));
        }
        Ok(fields)
    }

    fn place(&self, line: &Line) -> Result<Place, Error> {
        let fields = self.fields(line)?;
        let get = |column: usize| self.places[column].map(|place| (column, fields[place]));
        let [u, v] = [10, 11].map(|c| line.not_negative(get(c)));
        // The header has checked that both are there.
        let uv = [u?.unwrap_or_default(), v?.unwrap_or_default()];
        if let Some(field) = get(11)
            && uv[0] + uv[1] > 1.0 + PLACE_SLACK
        {
            return Err(line.expected(field, "u + v of at most 1"));
        }
        Ok(Place { triangle: line.index(get(0))?, uv, area: line.not_negative(get(1))? })
    }

    fn free_place(&self, line: &Line) -> Result<FreePlace, Error> {
        let fields = self.fields(line)?;
        let get = |column: usize| self.places[column].map(|place| (column, fields[place]));
        // The header has checked that all are there.
        let number = |column| line.number(get(column)).map(Option::unwrap_or_default);
        let [x, y, z, a, b, c] = FREE.map(number);
        let normal = [a?, b?, c?];
        // Of the largest first, so that no square leaves the range of f64.
        let largest = normal.into_iter().fold(0.0, |m: f64, n| m.max(n.abs()));
        let scaled = normal.map(|n| n / largest);
        let length = scaled.into_iter().map(|n| n * n).sum::<f64>().sqrt();
        // What was written as a unit is one, and keeps its bits.
        let unit = (largest * length - 1.0).abs() <= UNIT_SLACK;
        let normal = if unit { normal } else { scaled.map(|n| n / length) };
        match get(FREE[5]) {
            Some(field) if largest == 0.0 => Err(line.expected(field, "a normal of some length")),
            _ => Ok(FreePlace { position: [x?, y?, z?], normal }),
        }
    }

    fn row(&self, line: &Line) -> Result<Row, Error> {
        let fields = self.fields(line)?;
        let get = |column: usize| self.places[column].map(|place| (column, fields[place]));
        // The header has checked that what a row needs is there; the loop keeps it so.
        let number = |column| line.number(get(column)).map(Option::unwrap_or_default);
        let flag = |column| line.flag(get(column));
        let uv = match [10, 11].map(|c| line.number(get(c))) {
            [u, v] => u?.zip(v?).map(|(u, v)| [u, v]),
        };
        Ok(Row {
            triangle: line.index(get(0))?,
            uv,
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
