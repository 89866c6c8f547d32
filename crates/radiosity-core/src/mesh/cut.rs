//! Contact cuts: triangles are parted where others touch or cross them.
//!
//! An element on both sides of a wall that stands on it would receive light on one side and
//! give some of it off on the other, and one that reaches under a box would shine from there.
//! So each triangle is cut along the segments in which others meet it, before it is bisected:
//! then no element lies on both sides of a contact. Only what stands before a lit side counts,
//! and what lies in the same plane does not cut.
//!
//! An edge between two coplanar triangles may be such a contact as well: then nothing has to be
//! cut but the edge itself, and the two sides are still to be kept apart. All edges along
//! contacts are therefore named as *barriers*, across which receiver points are not shared.

mod contact;
mod drawing;
mod face;
mod pairs;
mod places;

use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

use glam::DVec3;
use scene::VertexId;

use super::points::COPLANAR_ANGLE;
use super::triangle_area;
use contact::{Contact, End};
use face::Face;
use pairs::Bounds;
use places::Places;

/// How far, in diagonals of the scene's bounds, what touches may be apart: above the rounding
/// of coordinates stored as f32, and a fifth of the length by which segments keep off surfaces,
/// so that light cannot tell. Contacts shorter than this are left out.
const NEAR: f64 = 1e-6;

/// How many pairs of triangles with overlapping boxes are looked at, for each triangle on
/// average and in any case. A scene with more is a thicket rather than a building; it is left
/// uncut rather than examined for minutes.
const PAIRS_PER_TRIANGLE: usize = 300;
const PAIRS_ANYWAY: usize = 1_000_000;

/// Lengths, in the scene's unit, whose squares f64 holds with all their digits.
const LENGTHS: std::ops::Range<f64> = 1e-100..1e100;

/// How many pieces cuts may add, for each lit side on average and in any case: a church asks for
/// one a side, and walls that all cross each other for one a pair. The largest triangles come
/// first. It does not depend on how many elements are asked for, so that coarse meshes stay the
/// beginnings of fine ones.
const PIECES_PER_SIDE: usize = 4;
const PIECES_ANYWAY: usize = 1000;

/// An edge, the smaller vertex first.
pub(super) type Edge = (VertexId, VertexId);

/// A triangle to be cut.
pub(super) struct Surface {
    /// Counter-clockwise seen from the front.
    pub(super) corners: [VertexId; 3],
    /// Unit normal of the front.
    pub(super) normal: DVec3,
    /// Whether the back takes light, too.
    pub(super) two_sided: bool,
}

/// What becomes of the triangles.
#[derive(Default)]
pub(super) struct Cut {
    /// The pieces of each triangle that is cut, by its number.
    pub(super) pieces: HashMap<usize, Vec<[VertexId; 3]>>,
    /// Edges of pieces along contacts.
    pub(super) barriers: HashSet<Edge>,
}

/// Cuts triangles along their contacts, and adds the vertices that this takes. `extent` is the
/// diagonal of the scene's bounds.
pub(super) fn cut(vertices: &mut Vec<DVec3>, surfaces: &[Surface], extent: f64) -> Cut {
    if !LENGTHS.contains(&extent) {
        return Cut::default();
    }
    let near = NEAR * extent;
    let contacts = contacts(vertices, surfaces, near);
    if contacts.is_empty() {
        return Cut::default();
    }
    let neighbours = Neighbours::new(surfaces);
    let mut places = Places::new(vertices, near);
    let mut plan = Plan::default();
    for (pair, contact) in contacts {
        let ends = contact.ends.map(|end| match end {
            // Corners that should be one, but are not to the bit, are one for cuts.
            End::Corner(vertex) => places.vertex_at(places.position(vertex)),
            End::Edge(place) => places.vertex_at(place),
        });
        for (number, parts) in pair.into_iter().zip(contact.parts) {
            if parts {
                plan.add(number, ends, surfaces, &places, &neighbours);
            }
        }
    }
    let sides: usize = surfaces.iter().map(Surface::sides).sum();
    plan.carry_out(surfaces, &mut places, PIECES_ANYWAY.max(PIECES_PER_SIDE * sides))
}

/// All contacts that part something, in the order of the triangles.
fn contacts(vertices: &[DVec3], surfaces: &[Surface], near: f64) -> Vec<([usize; 2], Contact)> {
    let bounds: Vec<Bounds> = surfaces
        .iter()
        .map(|s| Bounds::around(&s.corners.map(|v| vertices[v.index()]), near))
        .collect();
    let mut left = PAIRS_PER_TRIANGLE.saturating_mul(surfaces.len()).saturating_add(PAIRS_ANYWAY);
    let mut contacts = Vec::new();
    let all = pairs::overlapping(&bounds, |i, j| {
        left -= 1;
        if left == 0 {
            return ControlFlow::Break(());
        }
        let [a, b] = [&surfaces[i], &surfaces[j]];
        // Neighbours meet in their edge, which parts neither.
        let common = a.corners.iter().filter(|v| b.corners.contains(v)).count();
        if common < 2
            && let Some(contact) = contact::between(vertices, [a, b], near)
            && contact.parts != [false; 2]
        {
            contacts.push(([i, j], contact));
        }
        ControlFlow::Continue(())
    });
    if all.is_break() {
        contacts.clear();
    }
    contacts.sort_by_key(|(pair, _)| *pair);
    contacts
}

/// The triangles at each edge.
struct Neighbours<'a> {
    surfaces: &'a [Surface],
    at_edge: HashMap<Edge, Vec<usize>>,
}

impl<'a> Neighbours<'a> {
    fn new(surfaces: &'a [Surface]) -> Self {
        let mut at_edge: HashMap<Edge, Vec<usize>> = HashMap::new();
        for (number, surface) in surfaces.iter().enumerate() {
            for k in 0..3 {
                at_edge.entry(surface.edge(k)).or_default().push(number);
            }
        }
        Self { surfaces, at_edge }
    }

    /// The triangles at an edge of a triangle that lie in its plane, itself among them.
    fn coplanar(&self, number: usize, edge: Edge) -> impl Iterator<Item = usize> + '_ {
        let normal = self.surfaces[number].normal;
        let coplanar =
            move |&n: &usize| self.surfaces[n].normal.cross(normal).length() < COPLANAR_ANGLE;
        self.at_edge.get(&edge).into_iter().flatten().copied().filter(coplanar)
    }
}

/// What is to be done to the triangles that are not left as they are.
#[derive(Default)]
struct Plan {
    faces: HashMap<usize, Face>,
}

impl Plan {
    /// Plans a cut through a triangle from one end to the other.
    fn add(
        &mut self,
        number: usize,
        ends: [VertexId; 2],
        surfaces: &[Surface],
        places: &Places<'_>,
        neighbours: &Neighbours<'_>,
    ) {
        let surface = &surfaces[number];
        let ends = ends.map(|end| surface.locate(end, places));
        if ends[0].vertex == ends[1].vertex {
            return;
        }
        let edge = (0..3).find(|&k| ends.iter().all(|end| end.on[k]));
        if let Some(k) = edge {
            // Along an edge: what to part is only there if the plane goes on beyond it.
            let edge = surface.edge(k);
            let others: Vec<usize> = neighbours.coplanar(number, edge).collect();
            if others.len() > 1 {
                for other in others {
                    let face = self.faces.entry(other).or_default();
                    face.along.push((edge, [ends[0].vertex, ends[1].vertex]));
                }
            }
            return;
        }
        for end in &ends {
            for k in (0..3).filter(|&k| end.on[k] && !surface.corners.contains(&end.vertex)) {
                // The edge is cut on its other side, too, so that the two sides stay joined.
                for other in neighbours.coplanar(number, surface.edge(k)) {
                    let face = self.faces.entry(other).or_default();
                    face.on_edges.push((surface.edge(k), end.vertex));
                }
            }
        }
        self.faces.entry(number).or_default().across.push(ends.map(|end| end.vertex));
    }

    /// Cuts the triangles, the largest first, while no more than `room` pieces are added.
    fn carry_out(self, surfaces: &[Surface], places: &mut Places<'_>, mut room: usize) -> Cut {
        let mut order: Vec<(f64, usize)> = self
            .faces
            .keys()
            .map(|&n| (triangle_area(surfaces[n].corners.map(|v| places.position(v))), n))
            .collect();
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut cut = Cut::default();
        for (_, number) in order {
            let surface = &surfaces[number];
            let Some((pieces, barriers)) = self.faces[&number].cut(surface, places, room) else {
                continue;
            };
            let added = (pieces.len() - 1) * surface.sides();
            if added <= room {
                room -= added;
                cut.barriers.extend(barriers);
                if added > 0 {
                    cut.pieces.insert(number, pieces);
                }
            }
        }
        cut
    }
}

/// A vertex on a triangle.
struct Located {
    vertex: VertexId,
    /// On which of the edges it lies; edge k begins at corner k.
    on: [bool; 3],
}

impl Surface {
    /// How many sides of it are lit.
    fn sides(&self) -> usize {
        1 + usize::from(self.two_sided)
    }

    fn edge(&self, k: usize) -> Edge {
        edge(self.corners[k], self.corners[(k + 1) % 3])
    }

    /// Where a vertex lies on the triangle; one near a corner is that corner.
    fn locate(&self, vertex: VertexId, places: &Places<'_>) -> Located {
        let place = places.position(vertex);
        let corner = self.corners.map(|v| places.position(v));
        let near_corner = |&k: &usize| corner[k].distance(place) <= places.near();
        if let Some(k) = (0..3).find(near_corner) {
            return Located {
                vertex: self.corners[k],
                on: [0, 1, 2].map(|e| e == k || e == (k + 2) % 3),
            };
        }
        let on = [0, 1, 2].map(|k| {
            let (from, to) = (corner[k], corner[(k + 1) % 3]);
            let inward = self.normal.cross(to - from).normalize_or_zero();
            (place - from).dot(inward).abs() <= places.near()
        });
        Located { vertex, on }
    }
}

pub(super) fn edge(a: VertexId, b: VertexId) -> Edge {
    (a.min(b), a.max(b))
}
