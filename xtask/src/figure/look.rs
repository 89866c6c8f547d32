//! How lines and points look.

/// Red, green, blue; 0–255.
pub(crate) type Color = [u8; 3];

/// Colours that stay apart for colour-blind eyes on white (Okabe & Ito 2008).
pub(crate) mod color {
    use super::Color;

    pub(crate) const BLACK: Color = [0, 0, 0];
    pub(crate) const GREY: Color = [120, 120, 120];
    pub(crate) const BLUE: Color = [0, 114, 178];
    pub(crate) const ORANGE: Color = [230, 159, 0];
    pub(crate) const GREEN: Color = [0, 158, 115];
    pub(crate) const VERMILION: Color = [213, 94, 0];
    pub(crate) const PURPLE: Color = [204, 121, 167];
}

/// The line between points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stroke {
    Solid,
    Dashed,
    Dotted,
    /// Points alone.
    None,
}

/// What stands at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Dot,
    /// An open circle.
    Ring,
    Square,
    /// An open square.
    Frame,
    Triangle,
    Cross,
    /// The line alone.
    None,
}

/// Colour, line and marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Look {
    pub(crate) color: Color,
    pub(crate) stroke: Stroke,
    pub(crate) marker: Marker,
    /// Thickness of the line in pixels.
    pub(crate) width: u32,
}

impl Look {
    pub(crate) const fn new(color: Color, stroke: Stroke, marker: Marker) -> Self {
        Self { color, stroke, marker, width: 2 }
    }

    pub(crate) const fn thin(self) -> Self {
        Self { width: 1, ..self }
    }
}
