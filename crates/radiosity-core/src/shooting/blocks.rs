//! Receivers in blocks: what holds of a box of them holds of each.
//!
//! A shot leaves a block out when its box lies behind the shooter, when the shooter lies behind the
//! plane that they share, when they are in another sealed space, or when a wall hides all of them;
//! and it asks for no segment where nothing rises between.

use std::ops::Range;

use accel::Occluder;
use accel::proof::Plane;
use glam::DVec3;

use super::light::RUN;
use crate::mesh::{Element, Mesh, ReceiverPoint};
use crate::needs::{self, Needs};

/// Receivers of one plane in a block, at most: two batches of segments.
pub(super) const MOST: usize = 32;

/// Receivers after which a block ends where the plane changes: smaller blocks cost more than they
/// spare.
const FEW: usize = 8;

/// Receivers that follow each other.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) receivers: Range<u32>,
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    /// The plane that they lie in, if they do: the lowest through one of them.
    pub(super) plane: Option<Plane>,
    /// The sealed space that they lie in, if it is known and the same.
    pub(super) space: Option<u64>,
}

/// The blocks of those receivers that light may reach.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    all: Vec<Block>,
    /// Where those of each run of receivers are.
    of_runs: Vec<Range<u32>>,
    /// The first and the last run in which each patch has points.
    of_patches: Vec<(u32, u32)>,
    /// The sealed space of each receiver; empty where there is but one.
    spaces: Vec<Option<u64>>,
    /// Whether each receiver is in a block; empty if all are.
    wanted: Vec<bool>,
    /// Receivers that are in no block, of those that the mesh has.
    pub(super) left_out: usize,
}

/// A receiver with what tells it from its neighbours.
#[derive(Clone, Copy)]
struct Place {
    index: usize,
    normal: DVec3,
    position: DVec3,
    space: Option<u64>,
}

impl Blocks {
    /// Sorts out the receivers that may get light, and puts them into blocks of at most so many.
    pub(super) fn of(
        most: usize,
        mesh: &Mesh,
        receivers: &[ReceiverPoint],
        occluder: &dyn Occluder,
        needs: &Needs,
        lift: f64,
    ) -> Self {
        let mut spaces = Vec::new();
        if !needs.singles {
            spaces.extend(receivers.iter().map(|r| occluder.space(r.position + r.normal * lift)));
            let one = spaces.windows(2).all(|pair| pair[0] == pair[1]);
            if one || pierced(mesh, &spaces, occluder, lift) {
                spaces.clear();
            }
        }
        let of_patches = mesh.patches.iter().map(|patch| {
            let elements = patch.elements.start as usize..patch.elements.end as usize;
            let points = mesh.elements[elements].iter().flat_map(|e| e.points);
            let (first, last) = points.fold((u32::MAX, 0), |(a, b), p| (a.min(p), b.max(p)));
            (first / RUN as u32, last / RUN as u32)
        });
        let of_patches = of_patches.collect();
        let wanted = wanted(mesh, receivers.len(), &spaces, needs);
        let mut blocks = Self { spaces, of_patches, ..Self::default() };
        let place = |index: usize| Place {
            index,
            normal: receivers[index].normal,
            position: receivers[index].position,
            space: blocks.spaces.get(index).copied().flatten(),
        };
        let mut all = Vec::new();
        for first in (0..receivers.len()).step_by(RUN) {
            let start = all.len() as u32;
            let run = (first..(first + RUN).min(receivers.len())).filter(|i| wanted[*i]);
            let mut open: Vec<Place> = Vec::new();
            for next in run.map(place) {
                if open.last().is_some_and(|last| ends(most, &open, last, &next, mesh.extent)) {
                    all.push(Block::of(&open, mesh.extent));
                    open.clear();
                }
                open.push(next);
            }
            if !open.is_empty() {
                all.push(Block::of(&open, mesh.extent));
            }
            blocks.of_runs.push(start..all.len() as u32);
        }
        blocks.left_out = wanted[..mesh.points.len()].iter().filter(|w| !**w).count();
        if blocks.left_out > 0 {
            blocks.wanted = wanted;
        }
        blocks.all = all;
        blocks
    }

    /// Blocks of three for some of the mesh's points, numbered from 0: the corners of single elements.
    pub(super) fn around(
        &self,
        mesh: &Mesh,
        receivers: &[ReceiverPoint],
        points: &[u32],
    ) -> Vec<Block> {
        let place = |(index, (receiver, point)): (usize, (&ReceiverPoint, &u32))| Place {
            index,
            normal: receiver.normal,
            position: receiver.position,
            space: self.spaces.get(*point as usize).copied().flatten(),
        };
        let places: Vec<Place> = receivers.iter().zip(points).enumerate().map(place).collect();
        places.chunks(3).map(|corners| Block::of(corners, mesh.extent)).collect()
    }

    /// Each of them.
    pub(super) fn all(&self) -> &[Block] {
        &self.all
    }

    /// Those of a run of receivers.
    pub(super) fn of_run(&self, run: usize) -> &[Block] {
        let Range { start, end } = self.of_runs[run];
        &self.all[start as usize..end as usize]
    }

    /// Whether any corner of an element is in a block.
    pub(super) fn want(&self, element: &Element) -> bool {
        self.wanted.is_empty() || element.points.iter().any(|p| self.wanted[*p as usize])
    }

    /// The runs in which a patch has points.
    pub(super) fn runs_of(&self, patch: usize) -> Range<usize> {
        let (first, last) = self.of_patches[patch];
        first as usize..last as usize + 1
    }

    /// The sealed space that all of a patch lies in, if it is known.
    pub(super) fn space_of(&self, mesh: &Mesh, elements: &Range<u32>) -> Option<u64> {
        if self.spaces.is_empty() {
            return None;
        }
        let elements = &mesh.elements[elements.start as usize..elements.end as usize];
        let mut spaces = elements.iter().flat_map(|e| e.points).map(|p| self.spaces[p as usize]);
        let first = spaces.next()??;
        spaces.all(|space| space == Some(first)).then_some(first)
    }
}

/// Whether an element lies in several spaces, since something seals it in part: its light would go from one
/// to the other, and so it must if spaces are told apart or not.
fn pierced(mesh: &Mesh, spaces: &[Option<u64>], occluder: &dyn Occluder, lift: f64) -> bool {
    mesh.elements.iter().any(|element| {
        let [a, b, c] = mesh.corners(element.vertices);
        let middle = (a + b + c) / 3.0 + mesh.root_of(element).normal * lift;
        let own = occluder.space(middle);
        element.points.iter().any(|p| spaces[*p as usize] != own)
    })
}

/// Which receivers may get light that matters: probes; points of elements that reflect some of it, and
/// that lie in a sealed space with a lamp.
fn wanted(mesh: &Mesh, receivers: usize, spaces: &[Option<u64>], needs: &Needs) -> Vec<bool> {
    let mut wanted = vec![true; receivers];
    if !needs.black {
        wanted[..mesh.points.len()].fill(false);
        let black = needs::black(&mesh.roots);
        for element in mesh.elements.iter().filter(|e| !black[e.root as usize]) {
            element.points.iter().for_each(|p| wanted[*p as usize] = true);
        }
    }
    if !spaces.is_empty() {
        let emits = |e: &&Element| mesh.root_of(e).emittance.max_channel() > 0.0;
        let lamps = mesh.elements.iter().filter(emits).flat_map(|e| e.points);
        let mut lit: Vec<Option<u64>> = lamps.map(|p| spaces[p as usize]).collect();
        lit.sort_unstable();
        lit.dedup();
        // A lamp that is nobody knows where may light all.
        if !lit.contains(&None) {
            for (wanted, space) in wanted.iter_mut().zip(spaces) {
                *wanted &= space.is_none() || lit.binary_search(space).is_ok();
            }
        }
    }
    wanted
}

/// Whether a block ends before the next receiver.
fn ends(most: usize, open: &[Place], last: &Place, next: &Place, extent: f64) -> bool {
    if next.index != last.index + 1 || next.space != last.space || open.len() == most {
        return true;
    }
    let plane = Plane::through(last.position, last.normal);
    let same = next.normal == last.normal && plane.height(next.position).abs() <= FLAT * extent;
    !same && open.len() >= FEW.min(most / 2)
}

/// Places no farther than this from a plane, as a share of the extent, lie in it.
const FLAT: f64 = 1e-10;

impl Block {
    /// Places in an element with this normal, numbered by the caller.
    pub(super) fn of_element(corners: [DVec3; 3], normal: DVec3, space: Option<u64>) -> Self {
        let [a, b, c] = corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        Self { receivers: 0..0, low, high, plane: Some(Plane::through(a, normal)), space }
    }

    fn of(places: &[Place], extent: f64) -> Self {
        let (first, last) = (&places[0], &places[places.len() - 1]);
        let (mut low, mut high) = (first.position, first.position);
        for place in places {
            (low, high) = (low.min(place.position), high.max(place.position));
        }
        let through = Plane::through(first.position, first.normal);
        let flat = |p: &Place| {
            p.normal == first.normal && through.height(p.position).abs() <= FLAT * extent
        };
        let heights = places.iter().map(|p| through.height(p.position));
        let lowest = Plane { offset: through.offset + heights.fold(0.0, f64::min), ..through };
        Self {
            receivers: first.index as u32..last.index as u32 + 1,
            low,
            high,
            plane: places.iter().all(flat).then_some(lowest),
            space: first.space.filter(|_| places.iter().all(|p| p.space == first.space)),
        }
    }
}
