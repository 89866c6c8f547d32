//! Records to text.

use std::io::{self, BufWriter, Write};

use crate::{FloatBuffer, TriRecord, write_f64};

/// Writes records with numbers that read back to the same bits.
///
/// Each record is the word `Triangle`, a line of colours, and a line per vertex, its normal on
/// the same line. Output is buffered; [`finish`](Self::finish) writes the rest and reports
/// failure, which dropping the writer cannot do.
///
/// # Examples
/// ```
/// # let text = "Triangle 9 9 9 0 0 0\n0 0 0 1.50 0 0 0 1 -0.0";
/// let record = tri_io::Reader::new(text.as_bytes()).next().unwrap()?;
/// let mut writer = tri_io::Writer::new(Vec::new());
/// writer.write(&record)?;
/// let bytes = writer.finish()?;
/// assert_eq!(bytes, b"Triangle\n9 9 9 0 0 0\n0 0 0\n1.5 0 0\n0 1 -0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Writer<W: Write> {
    output: BufWriter<W>,
    /// The record being spelt, so that a refused one leaves no trace.
    text: Vec<u8>,
}

impl<W: Write> Writer<W> {
    /// Starts writing at the output's next byte.
    pub fn new(output: W) -> Self {
        Self { output: BufWriter::with_capacity(64 * 1024, output), text: Vec::new() }
    }

    /// Writes one record.
    ///
    /// # Errors
    /// `InvalidInput` if a coordinate is not finite, in which case nothing of the record is
    /// written and the writer can go on; and failures of the output.
    ///
    /// # Examples
    /// ```
    /// # let text = "Triangle 9 9 9 0 0 0\n0 0 0  1 0 0  0 1 0";
    /// # let mut record = tri_io::Reader::new(text.as_bytes()).next().unwrap()?;
    /// let mut writer = tri_io::Writer::new(Vec::new());
    /// record.vertices[1][2] = f64::NAN;
    /// let error = writer.write(&record).unwrap_err();
    /// assert_eq!(error.to_string(), "vertex 2 has z = NaN, and a .tri file holds finite numbers");
    /// assert_eq!(writer.finish()?, b"");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&mut self, record: &TriRecord) -> io::Result<()> {
        check_finite("vertex", &record.vertices)?;
        record.normals.as_ref().map_or(Ok(()), |normals| check_finite("normal", normals))?;

        self.text.clear();
        self.text.extend_from_slice(b"Triangle\n");
        for (index, &channel) in record.front.iter().chain(&record.back).enumerate() {
            if index > 0 {
                self.text.push(b' ');
            }
            self.push_channel(channel);
        }
        self.text.push(b'\n');
        for (index, vertex) in record.vertices.iter().enumerate() {
            self.push_triple(vertex);
            if let Some(normals) = &record.normals {
                self.text.push(b' ');
                self.push_triple(&normals[index]);
            }
            self.text.push(b'\n');
        }
        self.output.write_all(&self.text)
    }

    /// Writes what is still buffered, flushes the output and gives it back.
    ///
    /// # Errors
    /// Failures of the output.
    pub fn finish(mut self) -> io::Result<W> {
        self.output.flush()?;
        self.output.into_inner().map_err(io::IntoInnerError::into_error)
    }

    fn push_triple(&mut self, triple: &[f64; 3]) {
        let mut buffer = FloatBuffer::new();
        for (index, &value) in triple.iter().enumerate() {
            if index > 0 {
                self.text.push(b' ');
            }
            self.text.extend_from_slice(write_f64(value, &mut buffer).as_bytes());
        }
    }

    fn push_channel(&mut self, channel: u8) {
        for (power, least) in [(100, 100), (10, 10), (1, 0)] {
            if channel >= least {
                self.text.push(b'0' + channel / power % 10);
            }
        }
    }
}

fn check_finite(what: &str, triples: &[[f64; 3]; 3]) -> io::Result<()> {
    for (index, triple) in triples.iter().enumerate() {
        for (axis, value) in ["x", "y", "z"].iter().zip(triple) {
            if !value.is_finite() {
                let number = index + 1;
                let message = format!(
                    "{what} {number} has {axis} = {value}, and a .tri file holds finite numbers"
                );
                return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
            }
        }
    }
    Ok(())
}
