//! Input triangles to roots over shared vertices, cut along contacts.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use scene::{Face, Scene, Sides, TriangleId, VertexId};

use super::Root;
use super::cut::{self, Cut, Edge, Piece, Surface};

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
    pub(super) barriers: FxHashSet<Edge>,
    /// How many triangles are covered by earlier ones, wholly or in part, copies among them.
    pub(super) covered: usize,
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
        // Numbers keep their order, and with it the order in an edge. What is covered may have had
        // barriers of its own.
        let kept = self.barriers.iter().filter(|(a, b)| used[a.index()] && used[b.index()]);
        self.barriers = kept.map(|&(a, b)| (new(a), new(b))).collect();
    }
}

/// Welds bitwise equal positions, cuts the triangles along contacts and overlaps if `cuts` says
/// so, and makes a root of each piece of each lit side of each triangle that has area.
///
/// Of sides that face the same way, over the same three vertices or in one plane, the first alone
/// takes part: two would both receive the light of one, and give out twice of it.
pub(super) fn roots(scene: &Scene, cuts: bool, extent: f64) -> Roots {
    let Surfaces { mut vertices, triangles, surfaces, copies } = surfaces(scene);
    let mut covered = copies;
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
        let back = Root { face: Face::Back, normal: -front.normal, ..front };
        let whole = [Piece { corners: surface.corners, lit: surface.lit }];
        let pieces = cut.pieces.get(&number).map_or(whole.as_slice(), Vec::as_slice);
        let asked = [true, material.sides == Sides::Both];
        covered += usize::from(pieces.iter().any(|piece| piece.lit != asked));
        for (side, root) in [front, back].into_iter().enumerate() {
            for piece in pieces.iter().filter(|piece| piece.lit[side]) {
                let [a, b, c] = piece.corners;
                roots.push(root);
                corners.push(if side == 0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    let mut all = Roots { vertices, roots, corners, barriers: cut.barriers, covered };
    all.leave_out_unused(before);
    all
}

/// The triangles that take part.
#[derive(Default)]
struct Surfaces {
    /// Welded positions.
    vertices: Vec<DVec3>,
    triangles: Vec<TriangleId>,
    /// The same, without the sides that are there already.
    surfaces: Vec<Surface>,
    /// How many triangles with area take no part, since all their sides are there already.
    copies: usize,
}

fn surfaces(scene: &Scene) -> Surfaces {
    let mut all = Surfaces::default();
    let mut known: FxHashMap<[u64; 3], VertexId> = FxHashMap::default();
    let mut seen = FxHashSet::default();
    for id in scene.ids() {
        let p = scene.corners(id);
        let Some(normal) = unit_normal(p) else { continue };
        let corners = p.map(|p| {
            // Adding 0 turns −0 into 0.
            let key = (p + DVec3::ZERO).to_array().map(f64::to_bits);
            *known.entry(key).or_insert_with(|| {
                all.vertices.push(p);
                VertexId::from(all.vertices.len() - 1)
            })
        });
        let [a, b, c] = corners;
        let back = scene.material_of(id).sides == Sides::Both;
        let lit = [seen.insert(turned(corners)), back && seen.insert(turned([a, c, b]))];
        if lit == [false; 2] {
            all.copies += 1;
        } else {
            all.triangles.push(id);
            all.surfaces.push(Surface { corners, normal, lit });
        }
    }
    all
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
pub(crate) fn extent(scene: &Scene) -> f64 {
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
