//! `radiosity probe-grid`: places for probes, in a grid over a group of the scene.

use glam::{DVec2, DVec3};
use output::csv::{FreePlace, Places, write_places};
use scene::{Scene, TriangleId};

use crate::args::ProbeGridArgs;
use crate::commands::solve;
use crate::failure::Failure;
use crate::screen::{self, count, say};
use crate::{files, settings};

/// How far a corner may lie off the group's plane, as a share of the group's extent: coordinates
/// are often written with six digits.
const OFF_PLANE: f64 = 1e-4;

/// A cell longer than the spacing by this share is not divided once more: rounding of their quotient.
const WHOLE: f64 = 1e-9;

/// More places than this are a slip of the unit.
const MOST_PLACES: f64 = 1e7;

/// Writes the grid and says how many places it has.
pub(crate) fn run(args: &ProbeGridArgs) -> Result<(), Failure> {
    let read = settings::read(&args.read)?;
    let stdout = args.output.as_os_str() == "-";
    if !stdout {
        files::check_apart(Some(&args.scene), &[&args.output])?;
        files::check(&args.output)?;
    }
    let (file, imported) = solve::open(Some(&args.scene), &read)?;
    solve::check_factors(&file, &imported, &read)?;
    screen::diagnostics(&imported.diagnostics);
    let scene = &imported.scene;
    let triangles = triangles_of(&args.group, scene)?;
    let corners: Vec<_> = triangles.into_iter().map(|id| scene.corners(id)).collect();
    let places = grid(&corners, args.spacing, args.height)
        .map_err(|message| Failure::Failed(format!("{file}: group {:?}: {message}", args.group)))?;
    let number = places.len();
    let places = Places::Free(places);
    if stdout {
        let mut text = Vec::new();
        write_places(&mut text, &places)?;
        return screen::result(String::from_utf8_lossy(&text).trim_end());
    }
    output::replace_file(&args.output, |out| write_places(out, &places))?;
    say(&format!("written: {}: {} places", args.output.display(), count(number as u64)));
    Ok(())
}

/// The triangles with area of all groups of that name.
fn triangles_of(name: &str, scene: &Scene) -> Result<Vec<TriangleId>, Failure> {
    let named =
        |id: &TriangleId| scene.groups()[scene.triangles()[id.index()].group.index()] == name;
    let found: Vec<_> = scene.ids().filter(|id| named(id) && scene.area(*id) > 0.0).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let known: Vec<_> = scene.groups().iter().map(|group| format!("{group:?}")).collect();
    Err(Failure::Usage(format!(
        "--group {name:?}: expected a group with triangles; the scene has {}",
        known.join(", ")
    )))
}

/// The middles of the cells that lie over triangles of one plane, row by row.
fn grid(triangles: &[[DVec3; 3]], spacing: f64, height: f64) -> Result<Vec<FreePlace>, String> {
    let [origin, along, across, normal] = frame(triangles)?;
    let flat = |p: DVec3| DVec2::new((p - origin).dot(along), (p - origin).dot(across));
    let faces: Vec<_> = triangles.iter().map(|corners| corners.map(flat)).collect();
    let all = faces.iter().flatten();
    let low = all.clone().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = all.fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    let cells = ((high - low) / spacing * (1.0 - WHOLE)).ceil().max(DVec2::ONE);
    if cells.x * cells.y > MOST_PLACES {
        return Err(format!(
            "--spacing {spacing} makes {:.0e} places, expected at most {MOST_PLACES:.0e}",
            cells.x * cells.y
        ));
    }
    let size = (high - low) / cells;
    let mut places = Vec::new();
    for row in 0..cells.y as u32 {
        for column in 0..cells.x as u32 {
            let middle = low + size * (DVec2::new(f64::from(column), f64::from(row)) + 0.5);
            if faces.iter().any(|face| covers(face, middle)) {
                let at = origin + along * middle.x + across * middle.y + normal * height;
                places.push(FreePlace { position: at.to_array(), normal: normal.to_array() });
            }
        }
    }
    match places.is_empty() {
        true => Err(format!("no cell of --spacing {spacing} has its middle over it")),
        false => Ok(places),
    }
}

/// A point of the plane of the triangles, two axes along it, and its normal.
fn frame(triangles: &[[DVec3; 3]]) -> Result<[DVec3; 4], String> {
    let origin = triangles.first().map_or(DVec3::ZERO, |corners| corners[0]);
    let area = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a);
    let normal = triangles.iter().map(area).sum::<DVec3>().normalize_or_zero();
    let corners = triangles.iter().flatten().map(|p| *p - origin);
    let extent = corners.clone().map(DVec3::length).fold(0.0, f64::max);
    let off = corners.map(|p| p.dot(normal).abs()).fold(0.0, f64::max);
    let turned = triangles.iter().any(|corners| area(corners).dot(normal) <= 0.0);
    if normal == DVec3::ZERO || off > OFF_PLANE * extent || turned {
        return Err("expected triangles in one plane that face the same way".into());
    }
    // The world's axis that lies flattest, the first of equals: x of a floor in z-up and y-up.
    let size = normal.abs();
    let axis = match size.min_element() {
        least if size.x <= least => DVec3::X,
        least if size.y <= least => DVec3::Y,
        _ => DVec3::Z,
    };
    let along = (axis - normal * axis.dot(normal)).normalize();
    Ok([origin, along, normal.cross(along), normal])
}

/// Whether a triangle that runs counter-clockwise covers a point, its edges included.
fn covers([a, b, c]: &[DVec2; 3], p: DVec2) -> bool {
    let left = |from: &DVec2, to: &DVec2| (*to - *from).perp_dot(p - *from) >= 0.0;
    left(a, b) && left(b, c) && left(c, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles over the rectangle 3 × 2 at some place, facing along z.
    fn floor() -> [[DVec3; 3]; 2] {
        let p = |x: f64, y: f64| DVec3::new(10.0 + x, y, 5.0);
        let (a, b, c, d) = (p(0.0, 0.0), p(3.0, 0.0), p(3.0, 2.0), p(0.0, 2.0));
        [[a, b, c], [a, c, d]]
    }

    #[test]
    fn places_are_the_middles_of_equal_cells() {
        let places = grid(&floor(), 1.0, 0.8).unwrap();
        let expected: Vec<[f64; 3]> =
            [0.5, 1.5].into_iter().flat_map(|y| [10.5, 11.5, 12.5].map(|x| [x, y, 5.8])).collect();
        assert_eq!(places.len(), expected.len());
        for (place, expected) in places.iter().zip(expected) {
            let off = DVec3::from(place.position).distance(expected.into());
            assert!(off < 1e-14 && place.normal == [0.0, 0.0, 1.0], "{place:?}");
        }
        // Not a cell more for a spacing that divides a side, and one more for a little less.
        assert_eq!(grid(&floor(), 0.1, 0.0).unwrap().len(), 600);
        assert_eq!(grid(&floor(), 0.999, 0.0).unwrap().len(), 12);
        assert_eq!(grid(&floor(), 50.0, 0.0).unwrap().len(), 1);
    }

    #[test]
    fn what_the_group_does_not_cover_has_no_place() {
        // Half of a square of 4 × 4 cells, the diagonal's among them.
        let half = [[DVec3::ZERO, DVec3::X, DVec3::Y]];
        assert_eq!(grid(&half, 0.25, 0.0).unwrap().len(), 10);
        // A wall that faces along −y: rows from the bottom.
        let wall = [[DVec3::ZERO, DVec3::X, DVec3::Z]];
        let places = grid(&wall, 0.5, 0.1).unwrap();
        assert_eq!(places[0].normal, [0.0, -1.0, 0.0]);
        assert!(places[0].position[2] < places[2].position[2], "{places:?}");
        assert!(places.iter().all(|p| p.position[1] == -0.1));
    }

    #[test]
    fn other_shapes_are_refused() {
        let [mut first, second] = floor();
        first[0].z += 0.1;
        assert!(grid(&[first, second], 1.0, 0.0).is_err());
        first[0].z -= 0.1;
        first.reverse();
        assert!(grid(&[first, second], 1.0, 0.0).is_err(), "one faces down");
        assert!(grid(&floor(), 1e-6, 0.0).is_err(), "too many");
        // The middle of the only cell is in the gap between two corners of a square.
        let [a, b] = [DVec3::ZERO, DVec3::new(0.9, 0.9, 0.0)];
        let corner = |at: DVec3| [at, at + DVec3::X * 0.1, at + DVec3::Y * 0.1];
        assert!(grid(&[corner(a), corner(b)], 5.0, 0.0).is_err());
        assert!(grid(&[corner(a), corner(b)], 0.05, 0.0).is_ok());
    }
}
