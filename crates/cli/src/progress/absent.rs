//! No bars: what is drawn without the feature `progress`.

/// Where bars would be drawn.
pub(crate) struct Bars;

impl Bars {
    /// None, shown or not.
    pub(crate) fn new(_: bool) -> Self {
        Self
    }

    /// Whether there is one to see: never.
    pub(crate) fn shown(&self) -> bool {
        false
    }

    /// Writes where a bar would stand.
    pub(crate) fn suspend<T>(&self, write: impl FnOnce() -> T) -> T {
        write()
    }

    /// Draws none.
    pub(crate) fn bar(&self) -> Bar {
        Bar
    }
}

/// A bar that nobody sees.
pub(crate) struct Bar;

impl Bar {
    /// Shows nothing.
    pub(crate) fn show(&self, _: f64, _: &str) {}

    /// Clears nothing.
    pub(crate) fn clear(&self) {}
}
