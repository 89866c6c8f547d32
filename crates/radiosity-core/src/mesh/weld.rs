//! Input triangles to roots over shared vertices.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use scene::{Face, Scene, Sides, VertexId};

use super::Root;

/// A triangle whose height over its longest edge is below this share of that edge has no
/// usable normal: f64 corners are rounded to about 1e-16 of their size.
const LEAST_HEIGHT: f64 = 1e-12;

/// Welds bitwise equal positions, and makes a root of each lit side of each triangle that
/// has area: vertices, roots, and the roots' corners.
///
/// Of triangles over the same three vertices that face the same way, the first alone takes
/// part: two would both receive the light of one, and give out twice of it.
pub(super) fn roots(scene: &Scene) -> (Vec<DVec3>, Vec<Root>, Vec<[VertexId; 3]>) {
    let mut vertices = Vec::new();
    let mut known: HashMap<[u64; 3], VertexId> = HashMap::new();
    let mut weld = |p: DVec3| {
        // Adding 0 turns −0 into 0.
        let key = (p + DVec3::ZERO).to_array().map(f64::to_bits);
        *known.entry(key).or_insert_with(|| {
            vertices.push(p);
            VertexId::from(vertices.len() - 1)
        })
    };
    let mut seen = HashSet::new();
    let mut roots = Vec::new();
    let mut corners = Vec::new();
    for id in scene.ids() {
        let p = scene.corners(id);
        let Some(normal) = unit_normal(p) else { continue };
        let material = scene.material_of(id);
        let root = Root {
            triangle: id,
            face: Face::Front,
            normal,
            reflectance: material.reflectance,
            emittance: material.emittance,
        };
        let [a, b, c] = p.map(&mut weld);
        if !seen.insert(turned([a, b, c])) {
            continue;
        }
        roots.push(root);
        corners.push([a, b, c]);
        if material.sides == Sides::Both {
            roots.push(Root { face: Face::Back, normal: -normal, ..root });
            corners.push([a, c, b]);
        }
    }
    (vertices, roots, corners)
}

/// The corners, turned so that the smallest comes first; the winding stays.
fn turned([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    match a.min(b).min(c) {
        first if first == a => [a, b, c],
        first if first == b => [b, c, a],
        _ => [c, a, b],
    }
}

fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let longest =
        (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    // Scaled to unit size first: areas of tiny or huge scenes leave the range of f64.
    let scale = longest.sqrt();
    let cross = ((b - a) / scale).cross((c - a) / scale);
    let height = cross.length();
    (height > LEAST_HEIGHT).then(|| cross / height)
}
