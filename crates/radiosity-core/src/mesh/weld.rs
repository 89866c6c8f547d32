//! Input triangles to roots over shared vertices, cut along contacts.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use scene::{Face, Scene, Sides, TriangleId, VertexId};

use super::Root;
use super::cut::{self, Cut, Edge, Surface};

/// A triangle whose height over its longest edge is below this share of that edge has no
/// usable normal: f64 corners are rounded to about 1e-16 of their size.
const LEAST_HEIGHT: f64 = 1e-12;

/// A triangle with no edge as long as this, in the scene's unit, counts as a point: fourth
/// powers of distances must stay in the range of f64.
const LEAST_EDGE: f64 = 1e-75;

/// The lit sides of the triangles, in pieces.
pub(super) struct Roots {
    pub(super) vertices: Vec<DVec3>,
    pub(super) roots: Vec<Root>,
    /// The corners of each root.
    pub(super) corners: Vec<[VertexId; 3]>,
    /// Edges along contacts.
    pub(super) barriers: HashSet<Edge>,
}

impl Roots {
    /// Leaves out those vertices from `first` on that no root has: where cuts were thought of
    /// and not made.
    fn leave_out_unused(&mut self, first: usize) {
        if first == self.vertices.len() {
            return;
        }
        let mut used = vec![false; self.vertices.len()];
        used[..first].fill(true);
        for vertex in self.corners.iter().flatten() {
            used[vertex.index()] = true;
        }
        let mut number = vec![VertexId(0); used.len()];
        let mut kept = 0;
        for (old, _) in used.iter().enumerate().filter(|(_, used)| **used) {
            number[old] = VertexId::from(kept);
            self.vertices[kept] = self.vertices[old];
            kept += 1;
        }
        self.vertices.truncate(kept);
        let new = |vertex: VertexId| number[vertex.index()];
        for corners in &mut self.corners {
            *corners = corners.map(new);
        }
        // Numbers keep their order, and with it the order in an edge.
        self.barriers = self.barriers.iter().map(|&(a, b)| (new(a), new(b))).collect();
    }
}

/// Welds bitwise equal positions, cuts the triangles along contacts if `cuts` says so, and
/// makes a root of each piece of each lit side of each triangle that has area.
///
/// Of triangles over the same three vertices that face the same way, the first alone takes
/// part: two would both receive the light of one, and give out twice of it.
pub(super) fn roots(scene: &Scene, cuts: bool, extent: f64) -> Roots {
    let (mut vertices, triangles, surfaces) = surfaces(scene);
    let before = vertices.len();
    let cut = if cuts { cut::cut(&mut vertices, &surfaces, extent) } else { Cut::default() };
    let mut roots = Vec::with_capacity(surfaces.len());
    let mut corners = Vec::with_capacity(surfaces.len());
    for (number, (surface, triangle)) in surfaces.iter().zip(triangles).enumerate() {
        let material = scene.material_of(triangle);
        let front = Root {
            triangle,
            face: Face::Front,
            normal: surface.normal,
            reflectance: material.reflectance,
            emittance: material.emittance,
        };
        let whole = [surface.corners];
        let pieces = cut.pieces.get(&number).map_or(whole.as_slice(), Vec::as_slice);
        roots.extend(pieces.iter().map(|_| front));
        corners.extend(pieces);
        if surface.two_sided {
            let back = Root { face: Face::Back, normal: -front.normal, ..front };
            roots.extend(pieces.iter().map(|_| back));
            corners.extend(pieces.iter().map(|&[a, b, c]| [a, c, b]));
        }
    }
    let mut all = Roots { vertices, roots, corners, barriers: cut.barriers };
    all.leave_out_unused(before);
    all
}

/// The welded vertices, and the triangles that take part with their ids.
fn surfaces(scene: &Scene) -> (Vec<DVec3>, Vec<TriangleId>, Vec<Surface>) {
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
    let mut triangles = Vec::new();
    let mut surfaces = Vec::new();
    for id in scene.ids() {
        let p = scene.corners(id);
        let Some(normal) = unit_normal(p) else { continue };
        let corners = p.map(&mut weld);
        if seen.insert(turned(corners)) {
            triangles.push(id);
            let two_sided = scene.material_of(id).sides == Sides::Both;
            surfaces.push(Surface { corners, normal, two_sided });
        }
    }
    (vertices, triangles, surfaces)
}

/// The corners, turned so that the smallest comes first; the winding stays.
fn turned([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    match a.min(b).min(c) {
        first if first == a => [a, b, c],
        first if first == b => [b, c, a],
        _ => [c, a, b],
    }
}

/// The diagonal of the bounds of all triangles that take part.
pub(super) fn extent(scene: &Scene) -> f64 {
    let taking_part = scene.ids().map(|id| scene.corners(id)).filter(|p| unit_normal(*p).is_some());
    let bounds = taking_part.flatten().fold(None, |bounds: Option<(DVec3, DVec3)>, p| {
        let (low, high) = bounds.unwrap_or((p, p));
        Some((low.min(p), high.max(p)))
    });
    bounds.map_or(0.0, |(low, high)| (high - low).length())
}

pub(super) fn unit_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let longest =
        (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    // Scaled to unit size first: areas of tiny or huge scenes leave the range of f64.
    let scale = longest.sqrt();
    if scale < LEAST_EDGE {
        return None;
    }
    let cross = ((b - a) / scale).cross((c - a) / scale);
    let height = cross.length();
    (height > LEAST_HEIGHT).then(|| cross / height)
}
