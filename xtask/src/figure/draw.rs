//! A [`Figure`] as SVG, through plotters.

use plotters::coord::Shift;
use plotters::coord::combinators::WithKeyPoints;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Scale;
use super::{Axis, Entry, Figure, Look, Marker, Point, Stroke};

/// Pixels of the whole diagram; GitHub shows a page's pictures about 850 wide.
const SIZE: (u32, u32) = (1040, 640);

/// The column to the right of the axes that holds the legend.
const LEGEND_WIDTH: i32 = 240;
const LEGEND_LINE: i32 = 22;
const LEGEND_GAP: i32 = 10;
/// The length of a legend's sample.
const SAMPLE: i32 = 40;

/// Where title and notes begin.
const LEFT: i32 = 16;

const TITLE: i32 = 24;
const NOTE: i32 = 16;
const TEXT: i32 = 17;

/// Half the size of a marker.
const MARKER: i32 = 4;

/// From one dash's start to the next, and the dash: (dash, gap).
const DASHES: (i32, i32) = (7, 5);
const DOTS: (i32, i32) = (2, 4);

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<LogAxis, LogAxis>>;
type LogAxis = WithKeyPoints<LogCoord<f64>>;
type Pixel = (i32, i32);
type Drawn = Result<(), String>;

impl Figure {
    /// The figure as the text of an SVG file.
    ///
    /// # Errors
    /// What plotters says; a figure of finite numbers draws.
    pub(crate) fn svg(&self) -> Result<String, String> {
        let mut text = String::new();
        let canvas = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        self.draw(&canvas).map_err(|e| format!("{}: {e}", self.title))?;
        drop(canvas);
        if !text.ends_with('\n') {
            text.push('\n');
        }
        Ok(text)
    }

    fn draw(&self, canvas: &Canvas) -> Drawn {
        said(canvas.fill(&WHITE))?;
        let heading = 20 + TITLE + (NOTE + 4) * self.notes.len() as i32;
        write(canvas, &self.title, (LEFT, TITLE), font(TITLE).style(FontStyle::Bold))?;
        for (line, note) in (1..).zip(&self.notes) {
            write(canvas, note, (LEFT, TITLE + 6 + line * (NOTE + 4)), font(NOTE))?;
        }
        let (width, _) = canvas.dim_in_pixel();
        let below = canvas.margin(heading + 8, 8, 8, LEGEND_WIDTH);
        let points = || self.curves.iter().flat_map(|c| &c.points).filter(|p| p.has_a_place());
        let whiskers = points().filter_map(|p| p.whisker).flat_map(|(a, b)| [a, b]);
        let x = Scale::over(points().map(|p| p.x).chain(whiskers));
        let rises = points().filter_map(|p| p.rise).flat_map(|(a, b)| [a, b]);
        let levels = self.levels.iter().map(|l| l.y);
        let y = Scale::over(points().map(|p| p.y).chain(rises).chain(levels));
        let chart = axes(&below, (&self.x, &x), (&self.y, &y))?;
        let place = |x: f64, y: f64| chart.plotting_area().map_coordinate(&(x, y));
        for level in self.levels.iter().filter(|l| l.y > 0.0 && l.y.is_finite()) {
            line(canvas, level.look, &[place(x.low, level.y), place(x.high, level.y)])?;
        }
        for curve in &self.curves {
            let placed: Vec<_> = curve.points.iter().filter(|p| p.has_a_place()).collect();
            let pixels: Vec<_> = placed.iter().map(|p| place(p.x, p.y)).collect();
            line(canvas, curve.look, &pixels)?;
            for (Point { x, y, whisker, rise }, at) in placed.iter().zip(pixels) {
                if let Some((low, high)) = *whisker {
                    bar(canvas, curve.look, place(low, *y), place(high, *y))?;
                }
                if let Some((low, high)) = *rise {
                    bar(canvas, curve.look, place(*x, low), place(*x, high))?;
                }
                marker(canvas, curve.look, at)?;
            }
        }
        let left = width as i32 - LEGEND_WIDTH + 8;
        let mut top = heading + 20;
        for (number, entry) in self.legend.iter().enumerate() {
            // A new group keeps its distance.
            top += if number > 0 && entry.sample.is_none() { LEGEND_GAP } else { 0 };
            draw_entry(canvas, entry, (left, top))?;
            top += LEGEND_LINE;
        }
        said(canvas.present())
    }
}

/// Draws the axes with their ticks, and gives what knows the places between them.
fn axes<'a>(
    canvas: &Canvas<'a>,
    (x_axis, x): (&Axis, &Scale),
    (y_axis, y): (&Axis, &Scale),
) -> Result<Chart<'a>, String> {
    let coordinate = |scale: &Scale| {
        let range = (scale.low..scale.high).log_scale();
        range.with_key_points(scale.major.clone()).with_light_points(scale.minor.clone())
    };
    let mut builder = ChartBuilder::on(canvas);
    builder.x_label_area_size(52).y_label_area_size(80);
    let mut chart = said(builder.build_cartesian_2d(coordinate(x), coordinate(y)))?;
    let x_label = |value: &f64| x_axis.labels.text(*value);
    let y_label = |value: &f64| y_axis.labels.text(*value);
    let mut mesh = chart.configure_mesh();
    mesh.x_desc(&x_axis.title).y_desc(&y_axis.title);
    mesh.x_label_formatter(&x_label).y_label_formatter(&y_label);
    mesh.label_style(font(TEXT)).axis_desc_style(font(TEXT));
    mesh.bold_line_style(RGBColor(205, 205, 205)).light_line_style(RGBColor(236, 236, 236));
    said(mesh.draw())?;
    Ok(chart)
}

/// A line of the legend; `at` is the middle of its left end.
fn draw_entry(canvas: &Canvas, entry: &Entry, at: Pixel) -> Drawn {
    let Some(look) = entry.sample else {
        return write(canvas, &entry.text, at, font(TEXT).style(FontStyle::Bold));
    };
    let (x, y) = at;
    line(canvas, look, &[at, (x + SAMPLE, y)])?;
    marker(canvas, look, (x + SAMPLE / 2, y))?;
    write(canvas, &entry.text, (x + SAMPLE + 8, y), font(NOTE))
}

/// A line through points, in the look's stroke.
fn line(canvas: &Canvas, look: Look, points: &[Pixel]) -> Drawn {
    let style = style(look).stroke_width(look.width);
    let dashed = |(size, gap)| DashedPathElement::new(points.to_vec(), size, gap, style);
    match look.stroke {
        _ if points.len() < 2 => Ok(()),
        Stroke::None => Ok(()),
        Stroke::Solid => said(canvas.draw(&PathElement::new(points, style))),
        Stroke::Dashed => said(canvas.draw(&dashed(DASHES))),
        Stroke::Dotted => said(canvas.draw(&dashed(DOTS))),
    }
}

/// A bar from `low` to `high` with a stop at either end.
fn bar(canvas: &Canvas, look: Look, low: Pixel, high: Pixel) -> Drawn {
    // The stops stand across the bar.
    let (across, up) = if low.1 == high.1 { (0, MARKER) } else { (MARKER, 0) };
    let stop = |(x, y): Pixel| [(x - across, y - up), (x + across, y + up)];
    for ends in [[low, high], stop(low), stop(high)] {
        said(canvas.draw(&PathElement::new(ends, style(look))))?;
    }
    Ok(())
}

fn marker(canvas: &Canvas, look: Look, at: Pixel) -> Drawn {
    let ink = style(look).stroke_width(2);
    let (filled, paper) = (ink.filled(), WHITE.filled());
    let (x, y) = at;
    let square = [(x - MARKER, y - MARKER), (x + MARKER, y + MARKER)];
    match look.marker {
        Marker::None => Ok(()),
        Marker::Dot => said(canvas.draw(&Circle::new(at, MARKER, filled))),
        Marker::Ring => {
            said(canvas.draw(&Circle::new(at, MARKER + 1, paper)))?;
            said(canvas.draw(&Circle::new(at, MARKER + 1, ink)))
        }
        Marker::Square => said(canvas.draw(&Rectangle::new(square, filled))),
        Marker::Frame => {
            said(canvas.draw(&Rectangle::new(square, paper)))?;
            said(canvas.draw(&Rectangle::new(square, ink)))
        }
        Marker::Triangle => said(canvas.draw(&TriangleMarker::new(at, MARKER + 2, filled))),
        Marker::Cross => said(canvas.draw(&Cross::new(at, MARKER + 1, ink))),
    }
}

/// Text that begins at `at`, which is half its height.
fn write(canvas: &Canvas, text: &str, at: Pixel, font: FontDesc<'static>) -> Drawn {
    let style = TextStyle::from(font).pos(Pos::new(HPos::Left, VPos::Center));
    said(canvas.draw(&Text::new(text, at, style)))
}

fn font(size: i32) -> FontDesc<'static> {
    ("sans-serif", size).into_font()
}

fn style(look: Look) -> ShapeStyle {
    let [r, g, b] = look.color;
    ShapeStyle::from(RGBColor(r, g, b))
}

/// What went wrong, in words.
fn said<T>(result: Result<T, impl std::fmt::Display>) -> Result<T, String> {
    result.map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::super::{Curve, Labels, Level, look::color};
    use super::*;

    fn figure() -> Figure {
        let look = Look::new(color::BLUE, Stroke::Solid, Marker::Dot);
        let points = [(0.1, 0.02), (1.0, 0.005), (20.0, 0.0)];
        let whisker = Some((0.05, 0.4));
        let points = points.map(|(x, y)| Point { x, y, whisker, rise: None }).to_vec();
        Figure {
            title: "Error & time".into(),
            notes: vec!["one <note>".into()],
            x: Axis::new("seconds", Labels::Plain),
            y: Axis::new("error", Labels::Percent),
            levels: vec![Level { y: 0.003, look: look.thin() }],
            curves: vec![Curve { look, points }],
            legend: vec![Entry::heading("Methods"), Entry::of(look, "refinement")],
        }
    }

    #[test]
    fn every_word_is_in_the_file_and_markup_is_not() {
        let svg = figure().svg().unwrap();
        for words in ["Error &amp; time", "one &lt;note&gt;", "seconds", "Methods", "refinement"] {
            assert!(svg.contains(words), "{words}: {svg}");
        }
        // Ticks: 0.1 s to 1 s with its whiskers, 0.3 % to 2 %.
        for tick in [">\n0.05\n<", ">\n0.1\n<", ">\n1\n<", ">\n0.5 %\n<", ">\n2 %\n<"] {
            assert!(svg.contains(tick), "{tick}: {svg}");
        }
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"), "{svg}");
    }

    /// Two points have a place and the third has none; the legend shows one marker.
    #[test]
    fn what_has_no_place_is_left_out() {
        let svg = figure().svg().unwrap();
        assert_eq!(svg.matches("<circle").count(), 3, "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn higher_is_worse_and_right_is_slower() {
        let svg = figure().svg().unwrap();
        let attribute = |circle: &str, name: &str| {
            let rest = circle.split(&format!("{name}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse::<i32>().unwrap()
        };
        let at: Vec<_> = svg
            .split("<circle")
            .skip(1)
            .map(|c| (attribute(c, "cx"), attribute(c, "cy")))
            .collect();
        assert!(at[0].0 < at[1].0, "{at:?}");
        // SVG counts from the top.
        assert!(at[0].1 < at[1].1, "{at:?}");
    }

    /// A bar along y widens its axis, as one along x does: from 0.5 % to 2 % without it.
    #[test]
    fn a_bar_along_y_has_its_place() {
        let mut figure = figure();
        figure.curves[0].points[0].rise = Some((0.002, 0.06));
        let svg = figure.svg().unwrap();
        assert!(svg.contains(">\n5 %\n<"), "{svg}");
    }

    #[test]
    fn the_same_figure_gives_the_same_bytes() {
        assert_eq!(figure().svg().unwrap(), figure().svg().unwrap());
    }

    #[test]
    fn an_empty_figure_draws() {
        let empty = Figure { levels: Vec::new(), curves: Vec::new(), ..figure() };
        assert!(empty.svg().unwrap().contains("Methods"));
    }
}
