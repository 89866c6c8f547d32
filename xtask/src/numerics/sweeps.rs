//! Sweeps until a millionth of the light is unshot, against the reflectance.

use super::table::Table;
use crate::figure::{Axis, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color};

/// Plain and corrected shooting over mean bounces, 1 / (1 − reflectance).
pub(super) fn figure(table: &Table) -> Result<Figure, String> {
    let plain = Look::new(color::VERMILION, Stroke::Solid, Marker::Dot);
    let given_up = Look::new(color::VERMILION, Stroke::None, Marker::Ring);
    let corrected = Look { width: 3, ..Look::new(color::BLUE, Stroke::Solid, Marker::Dot) };
    Ok(Figure {
        title: "Sweeps until 1e-6 of the light is unshot".into(),
        notes: vec![
            "closed cube of one reflectance, one face emits, 384 elements; a sweep is one shot \
             per patch"
                .into(),
        ],
        x: Axis::new("mean number of bounces, 1 / (1 − reflectance)", Labels::Plain),
        y: Axis::new("sweeps", Labels::Plain),
        levels: Vec::new(),
        curves: vec![
            Curve { look: plain, points: points(table, "never", "converged")? },
            Curve { look: given_up, points: points(table, "never", "limit")? },
            Curve { look: corrected, points: points(table, "auto", "converged")? },
        ],
        legend: vec![
            Entry::of(plain, "plain shooting"),
            Entry::of(given_up, "plain, not done by then"),
            Entry::of(corrected, "with ambient corrections"),
        ],
    })
}

/// The rows of one kind of shooting that stopped for one reason.
fn points(table: &Table, correction: &str, stopped: &str) -> Result<Vec<Point>, String> {
    let mut points = Vec::new();
    for row in table.rows() {
        if row.text("correction")? == correction && row.text("stopped")? == stopped {
            let bounces = 1.0 / (1.0 - row.number("reflectance")?);
            points.push(Point::at(bounces, row.number("sweeps")?));
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_given_up_is_no_part_of_the_curve() {
        let table = Table::parse(
            "reflectance,correction,sweeps,stopped\n\
             0.5,auto,10,converged\n\
             0.5,never,11,converged\n\
             0.75,auto,8,converged\n\
             0.75,never,1000,limit\n\
             0.875,never,20,stalled\n",
        );
        let figure = figure(&table.unwrap()).unwrap();
        let points: Vec<_> = figure.curves.iter().map(|c| c.points.clone()).collect();
        assert_eq!(points[0], [Point::at(2.0, 11.0)]);
        assert_eq!(points[1], [Point::at(4.0, 1000.0)]);
        assert_eq!(points[2], [Point::at(2.0, 10.0), Point::at(4.0, 8.0)]);
    }
}
