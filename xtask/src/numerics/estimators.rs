//! Error against cost of the form-factor estimators, by distance.

use super::table::Table;
use crate::figure::{
    Axis, Color, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color,
};

/// The estimators without a tolerance, their marker and what they are called.
const FIXED: [(&str, Marker, &str); 4] = [
    ("kernel 1", Marker::Triangle, "kernel, 1 point each"),
    ("kernel 3x3", Marker::Square, "kernel, 3 points each"),
    ("lambert 1", Marker::Cross, "Lambert at 1 point"),
    ("lambert 3", Marker::Frame, "Lambert at 3 points"),
];

/// Near is dark; beyond the last, distances stay as light.
const COLORS: [Color; 6] =
    [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [110, 190, 70], [205, 180, 0]];

/// A curve of `between` for each distance, and the fixed rules as markers in its colour.
pub(super) fn figure(table: &Table) -> Result<Figure, String> {
    let mut figure = Figure {
        title: "Form factors of two triangles: error against cost".into(),
        notes: vec![
            format!("{}, 1 thread", table.note),
            "random pairs of one size, each wholly in front of the other; errors below 1e-10 are \
             the reference's"
                .into(),
        ],
        x: Axis::new("time per pair, nanoseconds", Labels::Plain),
        y: Axis::new("relative error, 95th percentile", Labels::Plain),
        levels: Vec::new(),
        curves: Vec::new(),
        legend: key(),
    };
    let mut distances: Vec<&str> = Vec::new();
    for row in table.rows() {
        let text = row.text("distance")?;
        if !distances.contains(&text) {
            distances.push(text);
        }
    }
    for (rank, distance) in distances.into_iter().enumerate() {
        let color = COLORS[rank.min(COLORS.len() - 1)];
        let line = Look::new(color, Stroke::Solid, Marker::Dot);
        let sample = Look { width: 4, ..Look::new(color, Stroke::Solid, Marker::None) };
        figure.legend.push(Entry::of(sample, distance));
        let mut between = Vec::new();
        for row in table.rows() {
            if row.text("distance")? != distance {
                continue;
            }
            let point = Point::at(row.number("nanoseconds")?, row.number("error")?);
            let estimator = row.text("estimator")?;
            if estimator == "between" {
                between.push(point);
                continue;
            }
            let (_, marker, _) = FIXED
                .into_iter()
                .find(|(name, ..)| *name == estimator)
                .ok_or_else(|| format!("unknown estimator `{estimator}`"))?;
            let look = Look::new(color, Stroke::None, marker);
            figure.curves.push(Curve { look, points: vec![point] });
        }
        figure.curves.push(Curve { look: line, points: between });
    }
    Ok(figure)
}

fn key() -> Vec<Entry> {
    let black = |stroke, marker| Look::new(color::BLACK, stroke, marker);
    let between = Entry::of(black(Stroke::Solid, Marker::Dot), "between, 1e-1 to 1e-8");
    let fixed = FIXED.map(|(_, marker, text)| Entry::of(black(Stroke::None, marker), text));
    let mut entries = vec![Entry::heading("Estimators"), between];
    entries.extend(fixed);
    entries.push(Entry::heading("Distance, longest edges"));
    entries
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "# Some CPU\n\
        distance,estimator,tolerance,nanoseconds,error\n\
        1,kernel 1,,3.5,0.36\n\
        1,between,1e-2,4000,2e-4\n\
        1,between,1e-4,5000,1e-6\n\
        4,kernel 1,,3.5,0.037\n\
        4,between,1e-2,140,0\n";

    #[test]
    fn each_distance_has_a_curve_and_its_fixed_rules() {
        let figure = figure(&Table::parse(TABLE).unwrap()).unwrap();
        let lines: Vec<_> =
            figure.curves.iter().filter(|c| c.look.stroke == Stroke::Solid).collect();
        assert_eq!(lines.len(), 2);
        assert_eq!(lines[0].points, [Point::at(4000.0, 2e-4), Point::at(5000.0, 1e-6)]);
        let triangle = |c: &&Curve| c.look.marker == Marker::Triangle;
        let markers: Vec<_> = figure.curves.iter().filter(triangle).collect();
        assert_eq!(markers[1].points, [Point::at(3.5, 0.037)]);
        assert_ne!(markers[0].look.color, markers[1].look.color);
        assert_eq!(figure.notes[0], "Some CPU, 1 thread");
    }

    #[test]
    fn an_unknown_estimator_is_refused() {
        let table = Table::parse(&TABLE.replace("kernel 1", "guess")).unwrap();
        assert_eq!(figure(&table).unwrap_err(), "unknown estimator `guess`");
    }
}
