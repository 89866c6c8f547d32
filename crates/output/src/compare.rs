//! How far one solution is from another, row by row.

use crate::csv::Row;
use crate::{Error, ErrorKind};

/// The relative difference that two areas of one triangle may show: references are
/// written with six digits or so, while a wrong row is off by far more.
pub const AREA_TOLERANCE: f64 = 1e-4;

/// The difference that two writings of one barycentric coordinate may show.
pub const PLACE_TOLERANCE: f64 = 1e-5;

/// Error measures of a solution against a reference B*, per channel, over the rows that
/// neither side marks as emitting or ambiguous. A is the reference's area.
///
/// A measure whose denominator is 0 (a channel without light) is 0 where the numerator
/// is 0 too, and infinite otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Σ A·|B−B*| / Σ A·B*: the relative error of the power.
    pub e1: [f64; 3],
    /// √(Σ A·(B−B*)² / Σ A·B*²).
    pub e2: [f64; 3],
    /// max |B−B*| / area mean of B*: local, so corners and shadows show.
    pub einf: [f64; 3],
    /// Rows that entered the sums.
    pub rows_used: usize,
    /// Σ A·se / Σ A·B*: about how much of `e1` may be the reference's own noise; `None`
    /// where a used row of the reference has no standard error.
    pub reference_se: Option<[f64; 3]>,
}

impl Comparison {
    /// The headline: `e1` of the worst channel.
    #[must_use]
    pub fn worst_e1(&self) -> f64 {
        worst(self.e1)
    }

    /// `e2` of the worst channel.
    #[must_use]
    pub fn worst_e2(&self) -> f64 {
        worst(self.e2)
    }

    /// `einf` of the worst channel.
    #[must_use]
    pub fn worst_einf(&self) -> f64 {
        worst(self.einf)
    }
}

/// Compares a solution with a reference, which comes second.
///
/// # Errors
/// Different row counts, a row of another triangle or of another place on it (by more than
/// [`PLACE_TOLERANCE`]), areas that differ by more than
/// [`AREA_TOLERANCE`], a value that is not finite, or no row that both sides count.
///
/// # Examples
/// ```
/// use output::csv::read;
///
/// let ours = read("triangle,area,B_r,B_g,B_b\n0,2,3,1,0\n1,1,6,1,0\n".as_bytes())?;
/// let reference = read("triangle,area,B_r,B_g,B_b\n0,2,4,1,0\n1,1,8,1,0\n".as_bytes())?;
/// let error = output::compare(&ours, &reference)?;
/// assert_eq!(error.e1, [0.25, 0.0, 0.0]); // (2·1 + 1·2) / (2·4 + 1·8)
/// assert_eq!(error.worst_e1(), 0.25);
/// # Ok::<(), output::Error>(())
/// ```
pub fn compare(ours: &[Row], reference: &[Row]) -> Result<Comparison, Error> {
    let used = pair(ours, reference)?;
    if used.is_empty() {
        return Err(Error::new(ErrorKind::NoRows));
    }
    let total: f64 = used.iter().map(|(_, r)| r.area).sum();
    let channels = [0, 1, 2].map(|c| Sums::of(&used, c));
    let sampled = used.iter().all(|(_, r)| r.se.is_some());
    Ok(Comparison {
        e1: channels.map(|s| ratio(s.difference, s.light)),
        e2: channels.map(|s| ratio(s.difference_squared, s.light_squared).sqrt()),
        // |B−B*| / (Σ A B* / Σ A), with one division.
        einf: channels.map(|s| ratio(s.largest * total, s.light)),
        rows_used: used.len(),
        reference_se: sampled.then(|| channels.map(|s| ratio(s.standard_error, s.light))),
    })
}

/// The rows that count, side by side.
pub(crate) fn pair<'a>(
    ours: &'a [Row],
    reference: &'a [Row],
) -> Result<Vec<(&'a Row, &'a Row)>, Error> {
    if ours.len() != reference.len() {
        let (ours, reference) = (ours.len(), reference.len());
        return Err(Error::new(ErrorKind::RowCount { ours, reference }));
    }
    let mut used = Vec::with_capacity(ours.len());
    for (row, (o, r)) in ours.iter().zip(reference).enumerate() {
        if o.triangle != r.triangle {
            let (ours, reference) = (o.triangle, r.triangle);
            return Err(Error::new(ErrorKind::RowTriangle { row, ours, reference }));
        }
        let apart = |(a, b): (&f64, &f64)| (a - b).abs() > PLACE_TOLERANCE;
        if let (Some(ours), Some(reference)) = (o.uv, r.uv)
            && ours.iter().zip(&reference).any(apart)
        {
            return Err(Error::new(ErrorKind::RowPlace { row, ours, reference }));
        }
        let good = |row: &Row| row.area >= 0.0 && row.area.is_finite() && row.exitance.is_finite();
        if !good(o) || !good(r) || !r.se.is_none_or(scene::Rgb::is_finite) {
            return Err(Error::new(ErrorKind::RowValue { row }));
        }
        if (o.area - r.area).abs() > AREA_TOLERANCE * o.area.max(r.area) {
            let (ours, reference) = (o.area, r.area);
            return Err(Error::new(ErrorKind::RowArea { row, ours, reference }));
        }
        if ![o, r].iter().any(|row| row.emits || row.ambiguous) {
            used.push((o, r));
        }
    }
    Ok(used)
}

/// The sums of one channel.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    difference: f64,
    difference_squared: f64,
    largest: f64,
    light: f64,
    light_squared: f64,
    standard_error: f64,
}

impl Sums {
    fn of(rows: &[(&Row, &Row)], channel: usize) -> Self {
        let mut sums = Self::default();
        for (ours, reference) in rows {
            let light = reference.exitance[channel];
            let difference = (ours.exitance[channel] - light).abs();
            let area = reference.area;
            sums.difference += area * difference;
            sums.difference_squared += area * difference * difference;
            sums.largest = sums.largest.max(difference);
            sums.light += area * light;
            sums.light_squared += area * light * light;
            sums.standard_error += area * reference.se.map_or(0.0, |se| se[channel]);
        }
        sums
    }
}

fn ratio(error: f64, light: f64) -> f64 {
    match (error == 0.0, light > 0.0) {
        (true, _) => 0.0,
        (false, true) => error / light,
        (false, false) => f64::INFINITY,
    }
}

fn worst(channels: [f64; 3]) -> f64 {
    channels.into_iter().fold(0.0, f64::max)
}
