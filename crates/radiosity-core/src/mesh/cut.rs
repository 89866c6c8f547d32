//! Contact cuts: triangles are parted where others touch or cross them.
//!
//! An element on both sides of a wall that stands on it would receive light on one side and
//! give some of it off on the other, and one that reaches under a box would shine from there.
//! So each triangle is cut along the segments in which others meet it, before it is bisected:
//! then no element lies on both sides of a contact. Only what stands before a lit side counts.
//!
//! What lies in one plane and faces the same way does not touch but *overlap*: the later triangle
//! is cut along the outline of the earlier one, and what that covers of it is left out.
//!
//! An edge between two coplanar triangles may be such a contact as well: then nothing has to be
//! cut but the edge itself, and the two sides are still to be kept apart. All edges along
//! contacts are therefore named as *barriers*, across which receiver points are not shared.

mod contact;
mod drawing;
mod face;
mod overlap;
mod pairs;
mod places;
mod plan;

use std::ops::ControlFlow;

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use scene::VertexId;

use contact::Contact;
use overlap::Overlap;
use pairs::Bounds;
use places::Places;
use plan::{Neighbours, Plan};

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
    /// Which sides take light: front, back.
    pub(super) lit: [bool; 2],
}

/// A piece of a triangle.
pub(super) struct Piece {
    pub(super) corners: [VertexId; 3],
    /// Which sides take part: front, back.
    pub(super) lit: [bool; 2],
}

/// What becomes of the triangles.
#[derive(Default)]
pub(super) struct Cut {
    /// The pieces of each triangle that does not stay as it is, by its number, and those that are
    /// covered.
    pub(super) pieces: FxHashMap<usize, Vec<Piece>>,
    /// Edges of pieces along contacts.
    pub(super) barriers: FxHashSet<Edge>,
}

/// Cuts triangles along their contacts and overlaps, and adds the vertices that this takes.
/// `extent` is the diagonal of the scene's bounds.
pub(super) fn cut(vertices: &mut Vec<DVec3>, surfaces: &[Surface], extent: f64) -> Cut {
    if !LENGTHS.contains(&extent) {
        return Cut::default();
    }
    let near = NEAR * extent;
    let Meetings { contacts, overlaps } = meetings(vertices, surfaces, near);
    if contacts.is_empty() && overlaps.is_empty() {
        return Cut::default();
    }
    let seams: Vec<_> = overlaps
        .iter()
        .filter(|(_, overlap)| !overlap.whole)
        .flat_map(|&([i, j], _)| {
            let seams = overlap::seams(vertices, [&surfaces[i], &surfaces[j]], near);
            seams.into_iter().map(move |ends| (j, ends))
        })
        .collect();
    let neighbours = Neighbours::new(surfaces);
    let mut places = Places::new(vertices, near);
    let mut plan = Plan::default();
    for (pair, contact) in contacts {
        for (number, parts) in pair.into_iter().zip(contact.parts) {
            if parts {
                let ends = contact.ends.map(|end| places.vertex_of(end, &surfaces[number]));
                plan.part(number, ends, surfaces, &places, &neighbours);
            }
        }
    }
    for (pair, overlap) in overlaps {
        plan.cover(pair, overlap);
    }
    for (number, ends) in seams {
        let ends = ends.map(|end| places.vertex_of(end, &surfaces[number]));
        plan.seam(number, ends, surfaces, &places, &neighbours);
    }
    let sides: usize = surfaces.iter().map(Surface::sides).sum();
    plan.carry_out(surfaces, &mut places, PIECES_ANYWAY.max(PIECES_PER_SIDE * sides))
}

/// How triangles meet, each pair in the order of the triangles.
#[derive(Default)]
struct Meetings {
    /// Those contacts that part something.
    contacts: Vec<([usize; 2], Contact)>,
    overlaps: Vec<([usize; 2], Overlap)>,
}

/// All meetings, in the order of the triangles.
fn meetings(vertices: &[DVec3], surfaces: &[Surface], near: f64) -> Meetings {
    let bounds: Vec<Bounds> = surfaces
        .iter()
        .map(|s| Bounds::around(&s.corners.map(|v| vertices[v.index()]), near))
        .collect();
    let mut left = PAIRS_PER_TRIANGLE.saturating_mul(surfaces.len()).saturating_add(PAIRS_ANYWAY);
    let mut found = Meetings::default();
    let all = pairs::overlapping(&bounds, |i, j| {
        left -= 1;
        if left == 0 {
            return ControlFlow::Break(());
        }
        let pair = [&surfaces[i], &surfaces[j]];
        // Neighbours meet in their edge, which parts neither.
        let common = pair[0].corners.iter().filter(|v| pair[1].corners.contains(v)).count();
        if let Some(overlap) = overlap::between(vertices, pair, near) {
            found.overlaps.push(([i, j], overlap));
        } else if common < 2
            && let Some(contact) = contact::between(vertices, pair, near)
            && contact.parts != [false; 2]
        {
            found.contacts.push(([i, j], contact));
        }
        ControlFlow::Continue(())
    });
    if all.is_break() {
        return Meetings::default();
    }
    found.contacts.sort_by_key(|(pair, _)| *pair);
    found.overlaps.sort_by_key(|(pair, _)| *pair);
    found
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
        self.lit.into_iter().filter(|lit| *lit).count()
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
