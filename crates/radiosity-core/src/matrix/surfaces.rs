//! What the rows of a matrix are: polygons that see and are seen by their fronts, each a row
//! or a part of one.

use std::collections::BTreeMap;

use form_factor::Polygon;
use scene::{Scene, Sides, TriangleId};

/// What a row stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// One input triangle.
    Triangles,
    /// All triangles of a named group.
    Groups,
}

/// Polygons in rows.
///
/// Only fronts take part: a two-sided surface is two polygons, in two rows.
#[derive(Clone, Debug, Default)]
pub struct Surfaces {
    pub(super) polygons: Vec<Polygon>,
    /// The row of each polygon.
    pub(super) rows: Vec<u32>,
    pub(super) names: Vec<String>,
}

impl Surfaces {
    /// No surfaces.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a row of these polygons; without any, there is no row.
    ///
    /// # Panics
    /// Past 2³²−1 rows, more than memory holds.
    pub fn row(&mut self, name: impl Into<String>, polygons: impl IntoIterator<Item = Polygon>) {
        self.polygons.extend(polygons);
        if self.polygons.len() > self.rows.len() {
            let row = u32::try_from(self.names.len()).expect("fewer than 2^32 rows fit in memory");
            self.rows.resize(self.polygons.len(), row);
            self.names.push(name.into());
        }
    }

    /// Each polygon a row of its own, named by its number from 0.
    #[must_use]
    pub fn each(polygons: impl IntoIterator<Item = Polygon>) -> Self {
        let mut surfaces = Self::new();
        for (i, polygon) in polygons.into_iter().enumerate() {
            surfaces.row(i.to_string(), [polygon]);
        }
        surfaces
    }

    /// The surfaces of a scene. Triangles without area have no row, nor have groups of them.
    ///
    /// A triangle's row is named by its number in the file, from 0. A later group of the same
    /// name is told apart by `#2`, `#3` and so on; backs of two-sided surfaces have rows of
    /// their own, whose names end in `:back`.
    #[must_use]
    pub fn of_scene(scene: &Scene, between: Between) -> Self {
        let names = match between {
            Between::Triangles => scene.ids().map(|id| id.0.to_string()).collect(),
            Between::Groups => distinct(scene.groups()),
        };
        let mut parts: Vec<[Vec<Polygon>; 2]> = vec![Default::default(); names.len()];
        for id in scene.ids() {
            let part = match between {
                Between::Triangles => id.index(),
                Between::Groups => scene.triangles()[id.index()].group.index(),
            };
            for (face, polygon) in faces(scene, id).into_iter().enumerate() {
                parts[part][face].extend(polygon);
            }
        }
        let mut surfaces = Self::new();
        for (name, [fronts, backs]) in names.into_iter().zip(parts) {
            surfaces.row(name.as_str(), fronts);
            surfaces.row(format!("{name}:back"), backs);
        }
        surfaces
    }

    /// How many polygons there are.
    #[must_use]
    pub fn polygons(&self) -> usize {
        self.polygons.len()
    }

    /// What the rows are called.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }
}

/// The sides of a triangle that take part, front first.
fn faces(scene: &Scene, id: TriangleId) -> [Option<Polygon>; 2] {
    let [a, b, c] = scene.corners(id);
    let back = match scene.material_of(id).sides {
        Sides::Front => None,
        Sides::Both => Polygon::triangle([a, c, b]),
    };
    [Polygon::triangle([a, b, c]), back]
}

/// Names told apart by a count where they repeat.
fn distinct(names: &[String]) -> Vec<String> {
    let mut seen: BTreeMap<&str, u32> = BTreeMap::new();
    let mut distinct = Vec::with_capacity(names.len());
    for name in names {
        let count = seen.entry(name).or_default();
        *count += 1;
        distinct.push(if *count == 1 { name.clone() } else { format!("{name}#{count}") });
    }
    distinct
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use scene::{Material, Rgb, SceneBuilder};

    use super::*;

    #[test]
    fn rows_are_named_after_what_is_in_them() {
        let mut builder = SceneBuilder::new();
        let groups = ["wall", "sheet", "line", "wall"].map(|name| builder.group(name));
        let mut material = |sides| {
            let (reflectance, emittance) = (Rgb::splat(0.5), Rgb::ZERO);
            builder.material(Material { name: "m".into(), reflectance, emittance, sides }).unwrap()
        };
        let (front, both) = (material(Sides::Front), material(Sides::Both));
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X * 2.0];
        let [a, b, c, d] = corners.map(|p| builder.vertex(p));
        for (vertices, material, group) in [
            ([a, b, c], front, 0),
            ([a, b, c], both, 1),
            ([a, b, d], front, 2),
            ([a, c, b], front, 3),
            ([a, d, c], front, 0),
        ] {
            builder.triangle(vertices, material, groups[group]).unwrap();
        }
        let scene = builder.finish();
        let of_groups = Surfaces::of_scene(&scene, Between::Groups);
        assert_eq!(of_groups.names(), ["wall", "sheet", "sheet:back", "wall#2"]);
        assert_eq!(of_groups.rows, [0, 0, 1, 2, 3]);
        assert_eq!(of_groups.polygons[3].normal(), -of_groups.polygons[2].normal());
        let each = Surfaces::of_scene(&scene, Between::Triangles);
        assert_eq!(each.names(), ["0", "1", "1:back", "3", "4"]);
        assert_eq!((each.polygons(), each.rows.len()), (5, 5));
    }
}
