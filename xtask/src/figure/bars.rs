//! Stacked bars: what several wholes are made of, each as shares of itself.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Color;

/// A chart of bars with its legend above them.
#[derive(Clone, Debug)]
pub(crate) struct Bars {
    pub(crate) title: String,
    /// A line each, under the title.
    pub(crate) notes: Vec<String>,
    /// What the axis shows.
    pub(crate) x: String,
    pub(crate) parts: Vec<Part>,
    pub(crate) bars: Vec<Bar>,
}

/// A part of every bar.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) name: String,
    pub(crate) color: Color,
}

/// One whole.
#[derive(Clone, Debug)]
pub(crate) struct Bar {
    /// Lines to its left.
    pub(crate) labels: Vec<String>,
    /// Of each part, in one unit.
    pub(crate) sizes: Vec<f64>,
}

/// Pixels.
const WIDTH: i32 = 1040;
const LEFT: i32 = 16;
const BARS_LEFT: i32 = 280;
const BARS_RIGHT: i32 = WIDTH - 30;
const BAR: i32 = 46;
const GAP: i32 = 22;
const LINE: i32 = 20;
const AXIS: i32 = 56;
const TITLE: i32 = 24;
const TEXT: i32 = 16;

/// Room for the name of a part in the legend.
const NAME: i32 = 110;

/// A part of less than this share has no room for its number.
const LEAST_LABELLED: f64 = 0.04;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

impl Bars {
    /// The chart as the text of an SVG file.
    ///
    /// # Errors
    /// What plotters says; finite sizes draw.
    pub(crate) fn svg(&self) -> Result<String, String> {
        let per_line = ((WIDTH - 2 * LEFT) / NAME) as usize;
        let legend = self.parts.len().div_ceil(per_line) as i32;
        let head = TITLE + LINE * (self.notes.len() as i32 + legend) + 40;
        let height = head + self.bars.len() as i32 * (BAR + GAP) + AXIS;
        let mut text = String::new();
        let canvas = SVGBackend::with_string(&mut text, (WIDTH as u32, height as u32));
        let canvas = canvas.into_drawing_area();
        self.draw(&canvas, head, per_line).map_err(|e| format!("{}: {e}", self.title))?;
        drop(canvas);
        if !text.ends_with('\n') {
            text.push('\n');
        }
        Ok(text)
    }

    fn draw(&self, canvas: &Canvas, head: i32, per_line: usize) -> Result<(), String> {
        said(canvas.fill(&WHITE))?;
        let bold = font(TITLE).style(FontStyle::Bold);
        write(canvas, &self.title, (LEFT, TITLE), bold, (HPos::Left, &BLACK))?;
        let mut top = TITLE + 6;
        for note in &self.notes {
            top += LINE;
            write(canvas, note, (LEFT, top), font(TEXT), (HPos::Left, &BLACK))?;
        }
        for (number, part) in self.parts.iter().enumerate() {
            let x = LEFT + (number % per_line) as i32 * NAME;
            let y = top + 26 + (number / per_line) as i32 * LINE;
            rectangle(canvas, [(x, y - 7), (x + 14, y + 7)], part.color)?;
            write(canvas, &part.name, (x + 20, y), font(TEXT), (HPos::Left, &BLACK))?;
        }
        let end = head + self.bars.len() as i32 * (BAR + GAP);
        let place = |share: f64| BARS_LEFT + (share * f64::from(BARS_RIGHT - BARS_LEFT)) as i32;
        for step in 0..=5 {
            let share = f64::from(step) / 5.0;
            let line = vec![(place(share), head - 6), (place(share), end)];
            said(canvas.draw(&PathElement::new(line, RGBColor(205, 205, 205))))?;
            let text = format!("{} %", step * 20);
            write(canvas, &text, (place(share), end + 14), font(TEXT), (HPos::Center, &BLACK))?;
        }
        let middle = place(0.5);
        write(canvas, &self.x, (middle, end + 38), font(TEXT), (HPos::Center, &BLACK))?;
        for (number, bar) in self.bars.iter().enumerate() {
            self.draw_bar(canvas, bar, head + number as i32 * (BAR + GAP), place)?;
        }
        said(canvas.present())
    }

    fn draw_bar(
        &self,
        canvas: &Canvas,
        bar: &Bar,
        top: i32,
        place: impl Fn(f64) -> i32,
    ) -> Result<(), String> {
        let middle = top + BAR / 2;
        let first = middle - LINE * (bar.labels.len() as i32 - 1) / 2;
        for (line, label) in (0..).zip(&bar.labels) {
            let at = (BARS_LEFT - 12, first + line * LINE);
            write(canvas, label, at, font(TEXT), (HPos::Right, &BLACK))?;
        }
        let whole: f64 = bar.sizes.iter().sum();
        let mut start = 0.0;
        for (part, size) in self.parts.iter().zip(&bar.sizes) {
            let share = if whole > 0.0 { size / whole } else { 0.0 };
            let end = start + share;
            let (left, right) = (place(start), place(end));
            if right > left {
                rectangle(canvas, [(left, top), (right, top + BAR)], part.color)?;
            }
            if share >= LEAST_LABELLED {
                let ink = if lightness(part.color) > 0.5 { &BLACK } else { &WHITE };
                let text = format!("{:.0} %", share * 100.0);
                let at = (left.midpoint(right), middle);
                write(canvas, &text, at, font(TEXT), (HPos::Center, ink))?;
            }
            start = end;
        }
        Ok(())
    }
}

/// How light a colour looks, from 0 to 1.
fn lightness([r, g, b]: Color) -> f64 {
    // The luma of ITU-R BT.601.
    (0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)) / 255.0
}

/// A filled rectangle, its edge in white: neighbours stay apart in print.
fn rectangle(canvas: &Canvas, corners: [(i32, i32); 2], [r, g, b]: Color) -> Result<(), String> {
    said(canvas.draw(&Rectangle::new(corners, ShapeStyle::from(RGBColor(r, g, b)).filled())))?;
    said(canvas.draw(&Rectangle::new(corners, ShapeStyle::from(WHITE).stroke_width(1))))
}

fn write(
    canvas: &Canvas,
    text: &str,
    at: (i32, i32),
    font: FontDesc<'static>,
    (side, ink): (HPos, &RGBColor),
) -> Result<(), String> {
    let style = TextStyle::from(font).pos(Pos::new(side, VPos::Center)).color(ink);
    said(canvas.draw(&Text::new(text, at, style)))
}

fn font(size: i32) -> FontDesc<'static> {
    ("sans-serif", size).into_font()
}

fn said<T>(result: Result<T, impl std::fmt::Display>) -> Result<T, String> {
    result.map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bars() -> Bars {
        let part = |name: &str, color| Part { name: name.into(), color };
        Bars {
            title: "A & b".into(),
            notes: vec!["of <two>".into()],
            x: "share".into(),
            parts: vec![part("dark", [0, 0, 0]), part("light", [255, 255, 0])],
            bars: vec![Bar { labels: vec!["first".into()], sizes: vec![1.0, 3.0] }],
        }
    }

    #[test]
    fn parts_are_as_long_as_their_shares() {
        let svg = bars().svg().unwrap();
        // A quarter and three quarters of 730 pixels.
        assert!(svg.contains(r#"x="280" y="104" width="182""#), "{svg}");
        assert!(svg.contains(r#"x="462" y="104" width="548""#), "{svg}");
        for words in [">\n25 %\n<", ">\n75 %\n<", "A &amp; b", "of &lt;two&gt;", "first"] {
            assert!(svg.contains(words), "{words}: {svg}");
        }
    }

    #[test]
    fn nothing_has_no_parts() {
        let mut bars = bars();
        bars.bars[0].sizes = vec![0.0, 0.0];
        let svg = bars.svg().unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("75 %"), "{svg}");
    }

    #[test]
    fn numbers_can_be_read_on_their_parts() {
        assert!(lightness([240, 228, 66]) > 0.5 && lightness([0, 62, 118]) < 0.5);
    }
}
