//! Scenes that closed forms speak of, built in code.

use glam::DVec3;
use scene::{Material, Scene, SceneBuilder};
use serde::Deserialize;

use crate::Error;

/// Subdivisions of a sphere, at most: 20·4⁵ facets.
pub const MAX_LEVEL: u32 = 5;

/// A named scene with its measures, in any unit of length.
///
/// Fronts face the light: boxes and outer spheres inwards, things within them outwards.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// A closed box from the origin; groups `x0 x1 y0 y1 z0 z1`, two triangles each.
    Box {
        /// Its far corner.
        size: [f64; 3],
    },
    /// A closed box with a smaller one standing free in it; groups as for `Box`, and `inner`.
    Furnished {
        /// The far corner of the outer box.
        size: [f64; 3],
        /// The near corner of the inner box.
        low: [f64; 3],
        /// The far corner of the inner box.
        high: [f64; 3],
    },
    /// Two equal squares that face each other, and nothing else; groups `lower`, `upper`.
    TwoPlates {
        /// Their side.
        side: f64,
        /// The distance between them.
        gap: f64,
    },
    /// Two tessellated spheres around one centre; groups `inner`, `outer`.
    ///
    /// Both have the same facets but for their size. So A₁/A₂ = (r₁/r₂)² and F₁₂ = 1 hold for
    /// the facets too; only the light on the outer one is less even than on a sphere.
    ConcentricSpheres {
        /// Radius of the inner one, through its vertices.
        inner: f64,
        /// Radius of the outer one.
        outer: f64,
        /// How often each of the 20 faces of an icosahedron is split in four.
        level: u32,
    },
    /// A tessellated sphere seen from inside; groups `wall`, `port`.
    IntegratingSphere {
        /// How often each of the 20 faces of an icosahedron is split in four.
        level: u32,
        /// How many of the 20 faces are the port: each is a twentieth of the area.
        port_faces: usize,
    },
    /// A tessellated sphere seen from inside; groups `wall`, `cap`.
    CappedSphere {
        /// How often each of the 20 faces of an icosahedron is split in four.
        level: u32,
        /// The cap's share of the area, up to half a facet's.
        share: f64,
    },
}

/// A group's name and its triangles.
pub type Group = (&'static str, Vec<[DVec3; 3]>);

impl Geometry {
    /// The groups with their triangles.
    ///
    /// # Errors
    /// A sphere of more than [`MAX_LEVEL`] subdivisions, or of more than 20 port faces.
    pub fn groups(&self) -> Result<Vec<Group>, Error> {
        match *self {
            Self::Box { size } => Ok(box_inside([0.0; 3], size)),
            Self::Furnished { size, low, high } => {
                let mut groups = box_inside([0.0; 3], size);
                let outside = box_inside(low, high).into_iter().flat_map(|(_, face)| face);
                groups.push(("inner", outside.map(reversed).collect()));
                Ok(groups)
            }
            Self::TwoPlates { side, gap } => {
                let plate = |z| {
                    quad(
                        [[0, 0], [1, 0], [1, 1], [0, 1]]
                            .map(|[x, y]| DVec3::new(f64::from(x) * side, f64::from(y) * side, z)),
                    )
                };
                let upper = plate(gap).into_iter().map(reversed).collect();
                Ok(vec![("lower", plate(0.0).to_vec()), ("upper", upper)])
            }
            Self::ConcentricSpheres { inner, outer, level } => {
                let facets = icosphere(level)?;
                let scaled = |r: f64| facets.iter().map(move |t| t.map(|p| p * r));
                Ok(vec![
                    ("inner", scaled(inner).collect()),
                    ("outer", scaled(outer).map(reversed).collect()),
                ])
            }
            Self::CappedSphere { level, share } => {
                let mut facets: Vec<_> = icosphere(level)?.into_iter().map(reversed).collect();
                let height = |t: &[DVec3; 3]| (t[0] + t[1] + t[2]).z;
                facets.sort_by(|a, b| height(b).total_cmp(&height(a)));
                let area = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).length();
                let whole: f64 = facets.iter().map(area).sum();
                let mut passed = 0.0;
                let mut in_cap = |t: &[DVec3; 3]| {
                    passed += area(t);
                    passed - area(t) / 2.0 < share * whole
                };
                let facets_of_cap = facets.iter().take_while(|t| in_cap(t)).count();
                let wall = facets.split_off(facets_of_cap);
                Ok(vec![("wall", wall), ("cap", facets)])
            }
            Self::IntegratingSphere { level, port_faces } => {
                if port_faces > 20 {
                    return Err(Error::new("port_faces", "expected at most 20"));
                }
                let mut facets: Vec<_> = icosphere(level)?.into_iter().map(reversed).collect();
                let wall = facets.split_off(port_faces * facets.len() / 20);
                Ok(vec![("wall", wall), ("port", facets)])
            }
        }
    }

    /// The scene, with a material for each group.
    ///
    /// # Errors
    /// As for [`Geometry::groups`]; a material or a measure that a scene refuses.
    pub fn scene(
        &self,
        mut material_of: impl FnMut(&str) -> Result<Material, Error>,
    ) -> Result<Scene, Error> {
        let mut builder = SceneBuilder::new();
        for (name, triangles) in self.groups()? {
            let refused = |error| Error::caused(format!("group {name}"), error);
            let group = builder.group(name);
            let material = builder.material(material_of(name)?).map_err(refused)?;
            for corners in triangles {
                let vertices = corners.map(|p| builder.vertex(p));
                builder.triangle(vertices, material, group).map_err(refused)?;
            }
        }
        Ok(builder.finish())
    }
}

/// The six faces of a box, counter-clockwise seen from inside.
fn box_inside(low: [f64; 3], high: [f64; 3]) -> Vec<Group> {
    let (low, high) = (DVec3::from(low), DVec3::from(high));
    let pick = |bit: usize, near: f64, far: f64| if bit == 0 { near } else { far };
    let corner = |i: usize| {
        DVec3::new(
            pick(i & 1, low.x, high.x),
            pick(i >> 1 & 1, low.y, high.y),
            pick(i >> 2, low.z, high.z),
        )
    };
    [
        ("x0", [0, 2, 6, 4]),
        ("x1", [1, 5, 7, 3]),
        ("y0", [0, 4, 5, 1]),
        ("y1", [2, 3, 7, 6]),
        ("z0", [0, 1, 3, 2]),
        ("z1", [4, 6, 7, 5]),
    ]
    .map(|(name, face)| (name, quad(face.map(corner)).to_vec()))
    .to_vec()
}

fn quad([a, b, c, d]: [DVec3; 4]) -> [[DVec3; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn reversed([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    [a, c, b]
}

/// A unit sphere of 20·4^level facets, seen from outside; the facets of one face of the
/// icosahedron stand together.
fn icosphere(level: u32) -> Result<Vec<[DVec3; 3]>, Error> {
    if level > MAX_LEVEL {
        return Err(Error::new("level", format!("{level}, expected at most {MAX_LEVEL}")));
    }
    let mut facets = icosahedron();
    for _ in 0..level {
        let split = |[a, b, c]: [DVec3; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        facets = facets.into_iter().flat_map(split).collect();
    }
    Ok(facets)
}

/// The 20 faces: the triples among the 12 cyclic permutations of (0, ±1, ±φ) that lie an
/// edge apart from each other.
fn icosahedron() -> Vec<[DVec3; 3]> {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut corners = Vec::new();
    for one in [-1.0, 1.0] {
        for phi in [-golden, golden] {
            corners.push(DVec3::new(0.0, one, phi).normalize());
            corners.push(DVec3::new(one, phi, 0.0).normalize());
            corners.push(DVec3::new(phi, 0.0, one).normalize());
        }
    }
    // Neighbours have the cosine 1/√5 ≈ .45, all others at most −.45.
    let near = |a: DVec3, b: DVec3| a.dot(b) > 0.0;
    let mut faces = Vec::with_capacity(20);
    for (i, &a) in corners.iter().enumerate() {
        for (j, &b) in corners.iter().enumerate().skip(i + 1) {
            for &c in &corners[j + 1..] {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outwards = (b - a).cross(c - a).dot(a) > 0.0;
                    faces.push(if outwards { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    faces
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn area(triangles: &[[DVec3; 3]]) -> f64 {
        triangles.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a).length() / 2.0).sum()
    }

    /// Enclosed volume, by the divergence theorem: above 0 where fronts face outwards.
    fn volume(triangles: &[[DVec3; 3]]) -> f64 {
        triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum()
    }

    #[test]
    fn fronts_face_the_light_and_the_surface_is_closed() {
        let room = Geometry::Furnished { size: [2., 3., 4.], low: [0.5; 3], high: [1.5; 3] };
        let groups = room.groups().expect("the measures are in range");
        let walls: Vec<_> = groups[..6].iter().flat_map(|g| g.1.clone()).collect();
        assert!((volume(&walls) + 24.0).abs() < 1e-12 && (area(&walls) - 52.0).abs() < 1e-12);
        assert!((volume(&groups[6].1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_sphere_approaches_its_area_with_every_level() {
        // An icosahedron has 20 triangles of edge a = 1 / sin 72° for a radius of 1.
        let edge = 1.0 / 72f64.to_radians().sin();
        let mut last = 1.0 - 5.0 * 3f64.sqrt() * edge * edge / (4.0 * PI);
        for level in 0..4 {
            let facets = icosphere(level).expect("the level is in range");
            assert_eq!(facets.len(), 20 << (2 * level));
            let lost = 1.0 - area(&facets) / (4.0 * PI);
            // Half the edge, a quarter of the loss; the first halving of so coarse a shape
            // gains less.
            let gain = if level == 0 { 1.0..1.0 + 1e-12 } else { 3.3..4.1 };
            assert!(gain.contains(&(last / lost + 1e-13)), "{level} {last} {lost}");
            last = lost;
            let port = facets.len() / 20;
            assert!((area(&facets[..port]) * 20.0 / area(&facets) - 1.0).abs() < 1e-12);
        }
        assert!(icosphere(6).is_err());
    }
}
