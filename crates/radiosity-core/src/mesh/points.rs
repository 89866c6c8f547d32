//! Receiver points: where the irradiance is computed, shared by coplanar neighbours.
//!
//! The elements around a vertex fall into sectors. Two neighbours are in one sector when
//! they are coplanar, face the same way, and no other surface meets the edge between them
//! (which is then a barrier, or an edge of that surface):
//! on the two sides of a wall that stands on a floor the light differs, so the floor has a
//! point on each side of it. A point whose sector does not surround the vertex moves a
//! little into the sector, off the rim where visibility and form factors are undecided.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use glam::DVec3;
use rustc_hash::FxHashSet;
use scene::VertexId;

use super::Mesh;
use super::cut::{Edge, edge};
use crate::executor::Executor;

/// Neighbours whose normals are closer than this angle, in radians, are coplanar: far above
/// the rounding of f64 normals, far below any crease one could see.
pub(super) const COPLANAR_ANGLE: f64 = 1e-5;

/// How far a point on a rim moves into its sector, as a share of the way to the mean
/// centroid of its elements: 1 % of an element, far above the rounding of f32 rays at
/// elements of a ten-thousandth of the scene.
const INSET: f64 = 0.02;

/// The corners of a sector that surrounds its vertex sum to a full turn within this, radians.
const FULL_TURN_SLACK: f64 = 1e-6;

/// A place where irradiance is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReceiverPoint {
    /// Where.
    pub position: DVec3,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// The input triangle it lies on (one of them, if it is shared).
    pub triangle: u32,
}

/// An element's corner at some vertex.
#[derive(Clone, Copy)]
struct Corner {
    element: u32,
    which: u32,
}

/// Vertices or points per run of an executor.
const RUN: usize = 1024;

/// Places the points, numbered in the order in which the elements first use them.
pub(super) fn place<E: Executor>(mesh: &mut Mesh, barriers: &FxHashSet<Edge>, executor: &E) {
    const NONE: u32 = u32::MAX;
    let around = Around::of(mesh);
    let leaders = around.leaders(mesh, barriers, executor);
    // Number them; the first corner to use a point is in the sector that it is of.
    let mut point_of_leader = vec![NONE; leaders.len()];
    let mut of_points: Vec<(u32, u32)> = Vec::new();
    for (element, slots) in mesh.elements.iter_mut().zip(&around.slots) {
        for k in 0..3 {
            let leader = leaders[slots[k] as usize];
            let point = &mut point_of_leader[leader as usize];
            if *point == NONE {
                *point = of_points.len() as u32;
                of_points.push((element.vertices[k].0, leader));
            }
            element.points[k] = *point;
        }
    }
    let nowhere = ReceiverPoint { position: DVec3::ZERO, normal: DVec3::ZERO, triangle: 0 };
    let mut points = vec![nowhere; of_points.len()];
    let mut runs: Vec<_> = of_points.chunks(RUN).zip(points.chunks_mut(RUN)).collect();
    executor.for_each(&mut runs, |(of_points, points)| {
        for ((vertex, leader), point) in of_points.iter().zip(points.iter_mut()) {
            let at = around.at(*vertex);
            let sector = at.clone().filter(|slot| leaders[*slot] == *leader);
            let corners = sector.map(|slot| &around.corners[slot]);
            *point = position(mesh, mesh.vertices[*vertex as usize], corners);
        }
    });
    mesh.points = points;
}

/// The element corners around each vertex.
struct Around {
    /// Where those of each vertex start.
    starts: Vec<u32>,
    /// In element order at each vertex.
    corners: Vec<Corner>,
    /// Where each element's corners are among them.
    slots: Vec<[u32; 3]>,
}

impl Around {
    fn of(mesh: &Mesh) -> Self {
        let mut starts = vec![0u32; mesh.vertices.len() + 1];
        for v in mesh.elements.iter().flat_map(|e| e.vertices) {
            starts[v.index() + 1] += 1;
        }
        for i in 0..mesh.vertices.len() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut corners = vec![Corner { element: 0, which: 0 }; 3 * mesh.elements.len()];
        let slots = (0u32..).zip(&mesh.elements).map(|(element, e)| {
            [0, 1, 2].map(|which| {
                let slot = &mut next[e.vertices[which as usize].index()];
                corners[*slot as usize] = Corner { element, which };
                *slot += 1;
                *slot - 1
            })
        });
        let slots = slots.collect();
        Self { starts, corners, slots }
    }

    /// The corners at a vertex.
    fn at(&self, vertex: u32) -> Range<usize> {
        self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize
    }

    /// The first corner in the sector of each.
    fn leaders<E: Executor>(
        &self,
        mesh: &Mesh,
        barriers: &FxHashSet<Edge>,
        executor: &E,
    ) -> Vec<u32> {
        let mut leaders = vec![0; self.corners.len()];
        let mut rest = leaders.as_mut_slice();
        let mut runs = Vec::new();
        for first in (0..mesh.vertices.len()).step_by(RUN) {
            let vertices = first as u32..mesh.vertices.len().min(first + RUN) as u32;
            let slots = self.starts[vertices.end as usize] - self.starts[first];
            let slots = rest.split_off_mut(..slots as usize).expect("all corners have slots");
            runs.push((vertices, slots));
        }
        executor.for_each(&mut runs, |(vertices, slots)| {
            let mut sectors = Sectors::default();
            let first = self.starts[vertices.start as usize] as usize;
            for vertex in vertices.clone() {
                let at = self.at(vertex);
                sectors.find(mesh, &self.corners[at.clone()], vertex, barriers);
                for (i, slot) in at.clone().enumerate() {
                    slots[slot - first] = (at.start + sectors.leader(i)) as u32;
                }
            }
        });
        leaders
    }
}

/// Union–find over the corners at one vertex; scratch space kept between vertices.
#[derive(Default)]
struct Sectors {
    parent: Vec<usize>,
    /// (the edge's far vertex, corner), sorted.
    spokes: Vec<(u32, usize)>,
    /// How far each sector turns, at its leader.
    turns: Vec<f64>,
}

impl Sectors {
    fn find(&mut self, mesh: &Mesh, at: &[Corner], vertex: u32, barriers: &FxHashSet<Edge>) {
        self.parent.clear();
        self.parent.extend(0..at.len());
        self.spokes.clear();
        for (i, corner) in at.iter().enumerate() {
            let v = mesh.elements[corner.element as usize].vertices;
            let k = corner.which as usize;
            self.spokes.push((v[(k + 1) % 3].0, i));
            self.spokes.push((v[(k + 2) % 3].0, i));
        }
        self.spokes.sort_unstable();
        let spokes = std::mem::take(&mut self.spokes);
        let mut bounded = false;
        for group in spokes.chunk_by(|a, b| a.0 == b.0) {
            let spoke = edge(VertexId(vertex), VertexId(group[0].0));
            if !barriers.is_empty() && barriers.contains(&spoke) {
                bounded = true;
            } else {
                self.join_across(mesh, at, group);
            }
        }
        self.spokes = spokes;
        if bounded {
            self.part_around_tips(mesh, at);
        }
    }

    /// Parts the sectors that reach more than half around the vertex, which is the tip of
    /// something: there, light depends on the direction in which one comes near, as some of
    /// the elements lie before a face that others lie beside.
    fn part_around_tips(&mut self, mesh: &Mesh, at: &[Corner]) {
        self.turns.clear();
        self.turns.resize(at.len(), 0.0);
        for (i, corner) in at.iter().enumerate() {
            let leader = self.leader(i);
            self.turns[leader] += angle(mesh, *corner);
        }
        let leaders: Vec<usize> = (0..at.len()).map(|i| self.leader(i)).collect();
        for (i, leader) in leaders.into_iter().enumerate() {
            if self.turns[leader] > PI + FULL_TURN_SLACK {
                self.parent[i] = i;
            }
        }
    }

    /// Joins the corners on the two sides of one edge, unless another surface meets it.
    fn join_across(&mut self, mesh: &Mesh, at: &[Corner], group: &[(u32, usize)]) {
        let normal = |i: usize| {
            let element = &mesh.elements[at[i].element as usize];
            mesh.roots[element.root as usize].normal
        };
        let first = normal(group[0].1);
        // |sine| of the angle between the planes, either way up.
        let coplanar = |n: DVec3| first.cross(n).length() < COPLANAR_ANGLE;
        if !group.iter().all(|&(_, i)| coplanar(normal(i))) {
            return;
        }
        for facing in [true, false] {
            let mut same =
                group.iter().map(|g| g.1).filter(|&i| (first.dot(normal(i)) > 0.0) == facing);
            if let Some(one) = same.next() {
                for other in same {
                    self.join(one, other);
                }
            }
        }
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.leader(a), self.leader(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// The smallest corner of the sector.
    fn leader(&self, mut i: usize) -> usize {
        while self.parent[i] != i {
            i = self.parent[i];
        }
        i
    }
}

/// The angle of an element at a corner.
fn angle(mesh: &Mesh, corner: Corner) -> f64 {
    let p = mesh.corners(mesh.elements[corner.element as usize].vertices);
    let k = corner.which as usize;
    (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k])
}

fn position<'a>(
    mesh: &Mesh,
    vertex: DVec3,
    sector: impl Iterator<Item = &'a Corner>,
) -> ReceiverPoint {
    let mut turn = 0.0;
    let mut weighted = DVec3::ZERO;
    let mut area = 0.0;
    let mut owner = None;
    for corner in sector {
        let element = &mesh.elements[corner.element as usize];
        let p = mesh.corners(element.vertices);
        turn += angle(mesh, *corner);
        weighted += ((p[0] + p[1] + p[2]) / 3.0 - vertex) * element.area;
        area += element.area;
        owner.get_or_insert(element.root);
    }
    let root = &mesh.roots[owner.expect("a sector has at least the corner that asked") as usize];
    let inside = turn > TAU - FULL_TURN_SLACK;
    let step = if inside || area == 0.0 { DVec3::ZERO } else { weighted / area * INSET };
    ReceiverPoint { position: vertex + step, normal: root.normal, triangle: root.triangle.0 }
}
