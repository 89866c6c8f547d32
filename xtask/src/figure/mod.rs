//! Diagrams as data: curves over two logarithmic axes, drawn as SVG by [`Figure::svg`].
//!
//! The same figure gives the same bytes: nothing here knows a date, a random number or the
//! machine's fonts.

mod axis;
mod bars;
mod draw;
mod look;

pub(crate) use axis::{Axis, Labels};
pub(crate) use bars::{Bar, Bars, Part};
pub(crate) use look::{Color, Look, Marker, Stroke, color};

/// A diagram with two logarithmic axes and its legend beside it.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    pub(crate) title: String,
    /// What was measured with what, a line each, under the title.
    pub(crate) notes: Vec<String>,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) levels: Vec<Level>,
    /// Later curves are drawn over earlier ones.
    pub(crate) curves: Vec<Curve>,
    pub(crate) legend: Vec<Entry>,
}

/// Points in the order in which a line joins them.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) look: Look,
    pub(crate) points: Vec<Point>,
}

/// A place on the diagram. What is not above 0 has no place on a logarithmic axis: it is left
/// out, and the line with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Ends of the whisker along x.
    pub(crate) whisker: Option<(f64, f64)>,
    /// Ends of the whisker along y.
    pub(crate) rise: Option<(f64, f64)>,
}

/// A horizontal line over the whole width.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level {
    pub(crate) y: f64,
    pub(crate) look: Look,
}

/// A line of the legend: with a sample it names a look, without one it is a heading.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) sample: Option<Look>,
    pub(crate) text: String,
}

impl Entry {
    pub(crate) fn of(look: Look, text: impl Into<String>) -> Self {
        Self { sample: Some(look), text: text.into() }
    }

    pub(crate) fn heading(text: impl Into<String>) -> Self {
        Self { sample: None, text: text.into() }
    }
}

impl Point {
    pub(crate) fn at(x: f64, y: f64) -> Self {
        Self { x, y, whisker: None, rise: None }
    }

    fn has_a_place(self) -> bool {
        self.x > 0.0 && self.y > 0.0 && self.x.is_finite() && self.y.is_finite()
    }
}
