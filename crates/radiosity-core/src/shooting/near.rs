//! Elements so near a bright shooter that their corners do not stand for their area.
//!
//! Such an element gets receiver points inside: the more of them, the nearer, the smaller
//! and the brighter the shooter is. Where a lamp touches a wall, its foot and its shadow lie
//! inside single elements, and there most of the error of the means arises.
//!
//! Shooters no brighter than others must not get them: the form factors of one corner to all
//! it sees sum to 1, and so do the means of corners; a mixture of two rules does not, and at
//! reflectance ρ a row that is off by δ is off by δ/(1 − ρ) in the light.

use std::ops::Range;

use glam::DVec3;

use super::blocks::{Block, Blocks};
use super::light::RUN;
use crate::config::Exchange;
use crate::mesh::{Element, Mesh, Patch, ReceiverPoint, bounding};

/// An element is near when the gap between its bounding sphere and the shooter is below this many
/// of its own radii.
const NEAR_RADII: f64 = 3.9;

/// More than distances computed in two ways differ by, as a share of themselves.
const ROUNDING: f64 = 1e-9;

/// A near element is quartered until what a part may receive is at most this share of what the
/// whole scene receives: small elements need fewer parts. Ten times more care changed no digit of
/// the errors in docs/design.md.
const PART_SHARE: f64 = 1e-3;

/// A near element is quartered at most this often: 64 parts of six points.
const MOST_QUARTERINGS: u32 = 3;

/// Six points on a triangle, exact for quartics: two orbits of (weight, a); corner weights
/// (1 − 2a, a, a) (Dunavant 1985, degree 4).
const SIX_POINTS: [(f64, f64); 2] = [
    (0.223_381_589_678_011, 0.445_948_490_915_965),
    (0.109_951_743_655_322, 0.091_576_213_509_771),
];

/// A near element, and its points among [`Near::points`].
#[derive(Clone, Copy, Debug)]
pub(super) struct NearElement {
    pub(super) element: u32,
    pub(super) first: u32,
    pub(super) last: u32,
}

/// What near elements are wanted for.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// Channels that are computed.
    pub(super) channels: usize,
    /// Roots that receive nothing; none if absent.
    pub(super) black: &'a [bool],
    /// Which receivers light may reach.
    pub(super) blocks: &'a Blocks,
}

/// The near elements of one shot, in the order of the elements.
#[derive(Default)]
pub(super) struct Near {
    pub(super) elements: Vec<NearElement>,
    pub(super) points: Vec<ReceiverPoint>,
    /// Share of its element that each point stands for.
    pub(super) weights: Vec<f64>,
    /// Irradiance arriving at each point, in each channel that is computed.
    pub(super) arriving: Vec<f64>,
    /// The points in blocks, none of which is in two runs.
    blocks: Vec<Block>,
    /// Where the blocks of each run are.
    of_runs: Vec<Range<u32>>,
}

impl Near {
    /// Finds the elements near a shooter and places points in them.
    ///
    /// `light` is the shooter's unshot exitance over what [`bright`](crate::ShootingConfig::bright)
    /// asks for: at 1 and below, nothing is near, and nothing is looked for.
    pub(super) fn find(
        &mut self,
        mesh: &Mesh,
        shooter: &Patch,
        exchange: Exchange,
        light: f64,
        wanted: &Wanted,
    ) {
        let Wanted { channels, black, blocks: receivers } = *wanted;
        self.elements.clear();
        self.points.clear();
        self.weights.clear();
        self.arriving.clear();
        self.blocks.clear();
        self.of_runs.clear();
        if light <= 1.0 {
            return;
        }
        let source = Source {
            patch: shooter,
            corners: mesh.corners(mesh.nodes[shooter.node as usize].vertices),
            normal: mesh.roots[mesh.nodes[shooter.node as usize].root as usize].normal,
            exchange,
            light,
            scene_area: mesh.elements.iter().map(|e| e.area).sum(),
        };
        for patch in &mesh.patches {
            // An element lies inside its patch's sphere, and its radius is at most the patch's.
            let reach = shooter.radius + patch.radius * (2.0 + NEAR_RADII);
            if patch.centroid.distance_squared(shooter.centroid) > reach * reach {
                continue;
            }
            let root = mesh.nodes[patch.node as usize].root as usize;
            if black.get(root).is_some_and(|black| *black) {
                continue;
            }
            for e in patch.elements.clone() {
                self.consider(mesh, &source, e);
            }
        }
        self.arriving.resize(self.points.len() * channels, 0.0);
        self.sort(mesh, receivers);
        self.begin_runs(self.points.len().div_ceil(RUN) as u32);
    }

    /// Puts the points of each element into blocks.
    fn sort(&mut self, mesh: &Mesh, receivers: &Blocks) {
        for i in 0..self.elements.len() {
            let near = self.elements[i];
            let element = &mesh.elements[near.element as usize];
            // Those that no light reaches keep their place: where segments start hangs on it.
            let last = if receivers.want(element) { near.last } else { near.first };
            let corners = mesh.corners(element.vertices);
            let space = receivers.space_of(mesh, &(near.element..near.element + 1));
            let whole = Block::of_element(corners, mesh.root_of(element).normal, space);
            let mut first = near.first;
            while first < last {
                let run = first / RUN as u32;
                self.begin_runs(run + 1);
                let end = last.min((run + 1) * RUN as u32);
                self.blocks.push(Block { receivers: first..end, ..whole.clone() });
                self.of_runs[run as usize].end = self.blocks.len() as u32;
                first = end;
            }
        }
    }

    /// Begins runs of points until there are so many.
    fn begin_runs(&mut self, runs: u32) {
        let start = self.blocks.len() as u32;
        self.of_runs.resize(self.of_runs.len().max(runs as usize), start..start);
    }

    /// What a shot reads and writes.
    pub(super) fn slots(&mut self) -> NearSlots<'_> {
        let Self { points, weights, arriving, blocks, of_runs, .. } = self;
        NearSlots { points, weights, arriving, blocks: NearBlocks { blocks, of_runs } }
    }

    /// Whether any of these elements is near.
    pub(super) fn any_of(&self, elements: &Range<u32>) -> bool {
        let at = self.elements.partition_point(|n| n.element < elements.start);
        self.elements.get(at).is_some_and(|near| near.element < elements.end)
    }

    /// The mean irradiance over a near element, or `None` if it is not near.
    pub(super) fn mean<const N: usize>(&self, element: u32) -> Option<[f64; N]> {
        if self.elements.is_empty() {
            return None;
        }
        let at = self.elements.partition_point(|n| n.element < element);
        let near = self.elements.get(at).filter(|n| n.element == element)?;
        let range = near.first as usize..near.last as usize;
        let mut mean = [0.0; N];
        let arriving = &self.arriving.as_chunks::<N>().0[range.clone()];
        for (weight, arriving) in self.weights[range].iter().zip(arriving) {
            for (mean, arriving) in mean.iter_mut().zip(arriving) {
                *mean += arriving * weight;
            }
        }
        Some(mean)
    }

    fn consider(&mut self, mesh: &Mesh, source: &Source, id: u32) {
        let element = &mesh.elements[id as usize];
        let corners = mesh.corners(element.vertices);
        let (centroid, radius) = bounding(corners);
        // The shooter lies inside its sphere: what is too far from that need not be measured.
        let reach = (source.patch.radius + radius * (1.0 + NEAR_RADII)) * (1.0 + ROUNDING);
        if centroid.distance_squared(source.patch.centroid) > reach * reach {
            return;
        }
        let gap = distance_to(source.corners, centroid) - radius;
        let in_front = |c: &DVec3| source.normal.dot(*c - source.patch.centroid) > 0.0;
        let facing = source.exchange == Exchange::Paired || corners.iter().any(in_front);
        if gap > NEAR_RADII * radius || !facing {
            return;
        }
        let first = self.points.len() as u32;
        self.quarter(mesh, element, corners, 1.0, source.quarterings(element.area, radius, gap));
        self.elements.push(NearElement { element: id, first, last: self.points.len() as u32 });
    }

    fn quarter(&mut self, mesh: &Mesh, element: &Element, p: [DVec3; 3], share: f64, times: u32) {
        let [a, b, c] = p;
        if times > 0 {
            let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
            for part in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]] {
                self.quarter(mesh, element, part, share / 4.0, times - 1);
            }
            return;
        }
        let root = mesh.root_of(element);
        for (weight, w) in SIX_POINTS {
            for corner in 0..3 {
                let position = (0..3)
                    .map(|i| p[i] * if i == corner { 1.0 - 2.0 * w } else { w })
                    .fold(DVec3::ZERO, |sum, q| sum + q);
                let (normal, triangle) = (root.normal, root.triangle.0);
                self.points.push(ReceiverPoint { position, normal, triangle });
                self.weights.push(weight * share);
            }
        }
    }
}

/// The points of near elements, with their slots.
pub(super) struct NearSlots<'a> {
    pub(super) points: &'a [ReceiverPoint],
    pub(super) weights: &'a [f64],
    pub(super) arriving: &'a mut [f64],
    pub(super) blocks: NearBlocks<'a>,
}

/// Their blocks.
#[derive(Clone, Copy)]
pub(super) struct NearBlocks<'a> {
    blocks: &'a [Block],
    of_runs: &'a [Range<u32>],
}

impl<'a> NearBlocks<'a> {
    /// Those of a run of points.
    pub(super) fn of_run(self, run: usize) -> &'a [Block] {
        let Range { start, end } = self.of_runs[run];
        &self.blocks[start as usize..end as usize]
    }
}

/// The shooter, as near elements see it.
struct Source<'a> {
    patch: &'a Patch,
    corners: [DVec3; 3],
    normal: DVec3,
    exchange: Exchange,
    light: f64,
    /// Area of all elements.
    scene_area: f64,
}

impl Source<'_> {
    /// How often to quarter an element of this area and radius.
    fn quarterings(&self, area: f64, radius: f64, gap: f64) -> u32 {
        // A shooter smaller than the element lights a spot about as wide as the gap or itself.
        let spot = (radius / gap.max(self.patch.radius)).log2();
        // Each quartering divides what one part brings by 4.
        let parts = (self.light * area / (PART_SHARE * self.scene_area)).log2() / 2.0;
        spot.max(parts).ceil().clamp(0.0, f64::from(MOST_QUARTERINGS)) as u32
    }
}

/// The distance of a place from a triangle.
fn distance_to(corners: [DVec3; 3], place: DVec3) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let edges = [(a, b), (b, c), (c, a)];
    let above = edges.iter().all(|(p, q)| (*q - *p).cross(place - *p).dot(normal) >= 0.0);
    if above && normal != DVec3::ZERO {
        return (place - a).dot(normal).abs() / normal.length();
    }
    let from_edge = |(p, q): &(DVec3, DVec3)| {
        let way = *q - *p;
        let along = ((place - *p).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        place.distance(*p + way * along)
    };
    edges.iter().map(from_edge).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_from_a_triangle() {
        // By hand: above it, beside an edge, beyond a corner.
        let corners = [DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 3.0];
        for (place, distance) in [
            (DVec3::new(1.0, 1.0, -2.0), 2.0),
            (DVec3::new(1.0, -3.0, 4.0), 5.0),
            (DVec3::new(-2.0, -2.0, 1.0), 3.0),
            (DVec3::new(3.0, 3.0, 0.0), 4.5f64.sqrt()),
        ] {
            assert!((distance_to(corners, place) - distance).abs() < 1e-14, "{place}");
        }
    }

    #[test]
    fn six_points_integrate_quartics() {
        // ∫ λ₀⁴ over a triangle of area 1 = 2·4!/6! = 1/15 (Stroud 1971).
        let value: f64 =
            SIX_POINTS.iter().map(|(w, a)| w * ((1.0 - 2.0 * a).powi(4) + 2.0 * a.powi(4))).sum();
        assert!((value - 1.0 / 15.0).abs() < 1e-14, "{value}");
    }
}
