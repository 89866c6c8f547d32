//! What is to be done to which triangle, gathered from all meetings and then carried out.

use std::ops::ControlFlow;

use glam::DVec3;
use rustc_hash::FxHashMap;
use scene::VertexId;

use super::face::Face;
use super::overlap::{self, Overlap};
use super::pairs::{self, Bounds};
use super::places::Places;
use super::{Cut, Edge, Piece, Surface};
use crate::mesh::points::COPLANAR_ANGLE;
use crate::mesh::triangle_area;

/// The triangles at each edge.
pub(super) struct Neighbours<'a> {
    surfaces: &'a [Surface],
    at_edge: FxHashMap<Edge, Vec<usize>>,
}

impl<'a> Neighbours<'a> {
    pub(super) fn new(surfaces: &'a [Surface]) -> Self {
        let mut at_edge: FxHashMap<Edge, Vec<usize>> = FxHashMap::default();
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
pub(super) struct Plan {
    faces: FxHashMap<usize, Face>,
    /// What covers a triangle: the number of the earlier one, and what of it.
    covers: FxHashMap<usize, Vec<(usize, Overlap)>>,
}

impl Plan {
    /// Plans a cut through a triangle from one end to the other, where something stands on it.
    pub(super) fn part(
        &mut self,
        number: usize,
        ends: [VertexId; 2],
        surfaces: &[Surface],
        places: &Places<'_>,
        neighbours: &Neighbours<'_>,
    ) {
        match Way::of(number, ends, surfaces, places) {
            Way::None => {}
            Way::Along(edge, ends) => {
                // What to part is only there if the plane goes on beyond the edge.
                let others: Vec<usize> = neighbours.coplanar(number, edge).collect();
                if others.len() > 1 {
                    for other in others {
                        self.faces.entry(other).or_default().along.push((edge, ends));
                    }
                }
            }
            Way::Across(ends, stops) => {
                self.stop(number, &stops, neighbours);
                self.faces.entry(number).or_default().across.push(ends);
            }
        }
    }

    /// Notes what the first of two triangles covers of the second.
    pub(super) fn cover(&mut self, [earlier, later]: [usize; 2], overlap: Overlap) {
        self.faces.entry(later).or_default();
        self.covers.entry(later).or_default().push((earlier, overlap));
    }

    /// Plans a cut through a triangle along what covers it, unless nothing of it would be left.
    pub(super) fn seam(
        &mut self,
        number: usize,
        ends: [VertexId; 2],
        surfaces: &[Surface],
        places: &Places<'_>,
        neighbours: &Neighbours<'_>,
    ) {
        if self.left(number, &surfaces[number]) == [false; 2] {
            return;
        }
        if let Way::Across(ends, stops) = Way::of(number, ends, surfaces, places) {
            self.stop(number, &stops, neighbours);
            self.faces.entry(number).or_default().seams.push(ends);
        }
    }

    /// Notes vertices on edges of a triangle. The edges are cut on their other side, too, so that
    /// the two sides stay joined.
    fn stop(&mut self, number: usize, stops: &[(Edge, VertexId)], neighbours: &Neighbours<'_>) {
        for &(edge, vertex) in stops {
            for other in neighbours.coplanar(number, edge) {
                self.faces.entry(other).or_default().on_edges.push((edge, vertex));
            }
        }
    }

    /// The lit sides of a triangle that no other one covers wholly.
    fn left(&self, number: usize, surface: &Surface) -> [bool; 2] {
        let whole = self.covers.get(&number).into_iter().flatten().filter(|(_, o)| o.whole);
        whole.fold(surface.lit, |lit, (_, o)| [0, 1].map(|side| lit[side] && !o.sides[side]))
    }

    /// Cuts the triangles, the largest first, while no more than `room` pieces are added.
    pub(super) fn carry_out(
        self,
        surfaces: &[Surface],
        places: &mut Places<'_>,
        mut room: usize,
    ) -> Cut {
        let mut order: Vec<(f64, usize)> = self
            .faces
            .keys()
            .map(|&n| (triangle_area(surfaces[n].corners.map(|v| places.position(v))), n))
            .collect();
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut cut = Cut::default();
        for (_, number) in order {
            let surface = &surfaces[number];
            let lit = self.left(number, surface);
            let cuts = if lit == [false; 2] {
                None
            } else {
                self.faces[&number].cut(surface, places, room)
            };
            let added = |pieces: &[_]| pieces.len().saturating_sub(1) * surface.sides();
            let mut pieces = vec![Piece { corners: surface.corners, lit }];
            if let Some((parts, barriers)) = cuts
                && added(&parts) <= room
            {
                room -= added(&parts);
                cut.barriers.extend(barriers);
                // A single part may be turned.
                if parts.len() > 1 {
                    pieces = parts.into_iter().map(|corners| Piece { corners, lit }).collect();
                }
                self.hide(number, &mut pieces, surfaces, places);
            }
            if pieces.len() > 1 || pieces[0].lit != surface.lit {
                cut.pieces.insert(number, pieces);
            }
        }
        cut
    }

    /// Leaves out the sides of pieces of a triangle that earlier ones cover.
    fn hide(&self, number: usize, pieces: &mut [Piece], surfaces: &[Surface], places: &Places<'_>) {
        let Some(covers) = self.covers.get(&number) else { return };
        let at = |corners: [VertexId; 3]| corners.map(|v| places.position(v));
        let middle = |piece: &Piece| at(piece.corners).iter().sum::<DVec3>() / 3.0;
        let near = places.near();
        // A floor may lie under ten thousand tiles, and so not each is held against each piece.
        let boxes = covers.iter().map(|(n, _)| Bounds::around(&at(surfaces[*n].corners), near));
        let dots = pieces.iter().map(|piece| Bounds::around(&[middle(piece)], near));
        let bounds: Vec<Bounds> = boxes.chain(dots).collect();
        let all = pairs::overlapping(&bounds, |i, j| {
            if let (Some((earlier, overlap)), Some(j)) =
                (covers.get(i), j.checked_sub(covers.len()))
            {
                let (surface, piece) = (&surfaces[*earlier], &mut pieces[j]);
                if overlap::contains(at(surface.corners), surface.normal, middle(piece), near) {
                    piece.lit = [0, 1].map(|side| piece.lit[side] && !overlap.sides[side]);
                }
            }
            ControlFlow::Continue(())
        });
        debug_assert!(all.is_continue());
    }
}

/// How a cut goes through a triangle.
enum Way {
    /// It is too short.
    None,
    /// Along an edge.
    Along(Edge, [VertexId; 2]),
    /// Across, with those of its ends that lie on edges.
    Across([VertexId; 2], Vec<(Edge, VertexId)>),
}

impl Way {
    fn of(number: usize, ends: [VertexId; 2], surfaces: &[Surface], places: &Places<'_>) -> Self {
        let surface = &surfaces[number];
        let located = ends.map(|end| surface.locate(end, places));
        let ends = [located[0].vertex, located[1].vertex];
        if ends[0] == ends[1] {
            return Self::None;
        }
        if let Some(k) = (0..3).find(|&k| located.iter().all(|end| end.on[k])) {
            return Self::Along(surface.edge(k), ends);
        }
        let mut stops = Vec::new();
        for end in &located {
            for k in (0..3).filter(|&k| end.on[k] && !surface.corners.contains(&end.vertex)) {
                stops.push((surface.edge(k), end.vertex));
            }
        }
        Self::Across(ends, stops)
    }
}
