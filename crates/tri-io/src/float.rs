//! Floats to their shortest text, without allocation.
//!
//! The digits come from `zmij`, which the bench `float_text` found the fastest of the crates
//! compared (README.md has the figures). What is ours is the choice of form.

/// Room for the text of one float.
///
/// # Examples
/// ```
/// let mut buffer = tri_io::FloatBuffer::new();
/// assert_eq!(tri_io::write_f32(0.1, &mut buffer), "0.1");
/// ```
#[derive(Default)]
pub struct FloatBuffer(zmij::Buffer);

impl FloatBuffer {
    /// Makes room; this costs nothing, so there is no need to keep a buffer.
    #[inline]
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

impl std::fmt::Debug for FloatBuffer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FloatBuffer").finish_non_exhaustive()
    }
}

/// Writes an `f32` with as few digits as parse back to the same bits.
///
/// From 1e-6 up to, not including, 1e13 the form is plain, whole numbers without a point (`250`,
/// `-0`); outside it is `1.5e-7`, `1e+30`. Rust's and C's parsers read all of these. A value that
/// is not finite becomes `NaN` (its sign and payload are lost), `inf` or `-inf`.
///
/// # Examples
/// ```
/// use tri_io::{FloatBuffer, write_f32};
/// let mut buffer = FloatBuffer::new();
/// assert_eq!(write_f32(250.0, &mut buffer), "250");
/// assert_eq!(write_f32(-99.99999, &mut buffer), "-99.99999");
/// assert_eq!(write_f32(1.5e-7, &mut buffer), "1.5e-7");
/// ```
#[inline]
pub fn write_f32(value: f32, buffer: &mut FloatBuffer) -> &str {
    without_point_zero(buffer.0.format(value))
}

/// Writes an `f64` with as few digits as parse back to the same bits.
///
/// As [`write_f32`], with the plain form from 1e-5 up to, not including, 1e16.
///
/// # Examples
/// ```
/// use tri_io::{FloatBuffer, write_f64};
/// let mut buffer = FloatBuffer::new();
/// assert_eq!(write_f64(0.1 + 0.2, &mut buffer), "0.30000000000000004");
/// assert_eq!(write_f64(-0.0, &mut buffer), "-0");
/// ```
#[inline]
pub fn write_f64(value: f64, buffer: &mut FloatBuffer) -> &str {
    without_point_zero(buffer.0.format(value))
}

/// Counts instead of branching: whether a coordinate is whole cannot be predicted, and a
/// wrong guess costs as much as a third of the digits (bench `float_text`, coordinates).
#[inline]
fn without_point_zero(text: &str) -> &str {
    let [.., point, zero] = text.as_bytes() else { return text };
    let ends = (*point == b'.') & (*zero == b'0');
    &text[..text.len() - 2 * usize::from(ends)]
}
