//! How far two meshes of one scene are apart in their light.
//!
//! The forest grows by halving the longest edge, in an order that does not depend on how far
//! it goes: the nodes of the coarser mesh are the first nodes of the finer one. So a leaf of
//! the one is an inner node of the other, and both can be compared place by place.

use scene::{Rgb, Scene, Solution};

use super::place::{self, Probe};
use super::statement::Measured;
use super::surface::{Counted, Sides};
use crate::mesh::Mesh;

/// A mesh with its light.
#[derive(Clone, Copy)]
pub(super) struct Lit<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) solution: &'a Solution,
}

/// How many times as many elements the finer mesh has, as far as its difference from the coarser one
/// is concerned.
///
/// Where meshes follow the light, it is not the same everywhere. By number it would be right if all
/// elements erred alike; as the geometric mean over the area, if all places did. The truth lies
/// between, and so does this: the geometric mean of both.
pub(super) fn finer(coarse: &Mesh, fine: &Mesh) -> f64 {
    let by_number = fine.elements.len() as f64 / coarse.elements.len().max(1) as f64;
    let (mut logarithms, mut area) = (0.0, 0.0);
    for (node, parts) in coarse.nodes.iter().zip(&fine.nodes).filter(|(node, _)| node.is_leaf()) {
        let own = coarse.elements[node.elements.start as usize].area;
        logarithms += own * (parts.elements.len() as f64).log2();
        area += own;
    }
    if area > 0.0 { (by_number * (logarithms / area).exp2()).sqrt() } else { 1.0 }
}

/// Differences of the means of the input triangles' sides.
pub(super) fn of_triangles(scene: &Scene, coarse: Lit, fine: Lit, counted: Counted) -> Measured {
    let a = Sides::of(scene, coarse.mesh, coarse.solution, counted);
    let b = Sides::of(scene, fine.mesh, fine.solution, counted);
    let mut sums = Sums::default();
    for ((area, one), (other_area, other)) in a.sides.iter().zip(&b.sides) {
        if *area > 0.0 && *other_area > 0.0 {
            sums.add(*other_area, (*one / *area - *other / *other_area).abs());
        }
    }
    sums.relative(&b)
}

/// Differences at the middle of each element of the finer mesh.
pub(super) fn of_points(scene: &Scene, coarse: Lit, fine: Lit, counted: Counted) -> Measured {
    let whole = Sides::of(scene, fine.mesh, fine.solution, counted);
    let mut sums = Sums::default();
    for (id, node) in coarse.mesh.nodes.iter().enumerate() {
        if !node.is_leaf() {
            continue;
        }
        let element = node.elements.start as usize;
        if !counted.counts(coarse.mesh, &coarse.mesh.elements[element]) {
            continue;
        }
        let at_corners = coarse.solution.elements[element].corner_exitance;
        let corners = coarse.mesh.corners(node.vertices);
        for e in fine.mesh.nodes[id].elements.clone() {
            let finer = &fine.mesh.elements[e as usize];
            let [a, b, c] = fine.mesh.corners(finer.vertices);
            let weights = place::weights(corners, (a + b + c) / 3.0);
            let there: Rgb = at_corners.iter().zip(weights).map(|(b, w)| *b * w).sum();
            let here: Rgb = fine.solution.elements[e as usize].corner_exitance.into_iter().sum();
            sums.add(finer.area, (here / 3.0 - there).abs());
        }
    }
    sums.relative(&whole)
}

/// Differences at places where both computed the irradiance, but for triangles that emit; each
/// counts by its area, or all alike. Those of exitance or of irradiance, whichever are larger.
pub(super) fn of_places(scene: &Scene, probes: &[Probe], coarse: &[Rgb], fine: &[Rgb]) -> Measured {
    let counted = |probe: &Probe| probe.material(scene).is_none_or(|m| !m.emits());
    let leaving = |probe: &Probe| probe.material(scene).map_or(Rgb::ZERO, |m| m.reflectance);
    let of = |share: &dyn Fn(&Probe) -> Rgb| {
        let by_area = probes.iter().all(|p| p.area().is_some());
        let mut sums = Sums::default();
        let (mut power, mut area) = (Rgb::ZERO, 0.0);
        for (probe, (a, b)) in probes.iter().zip(coarse.iter().zip(fine)) {
            if !counted(probe) {
                continue;
            }
            let weight = probe.area().filter(|_| by_area).unwrap_or(1.0);
            sums.add(weight, (share(probe) * (*a - *b)).abs());
            power += share(probe) * *b * weight;
            area += weight;
        }
        let mean = if area > 0.0 { power / area } else { Rgb::ZERO };
        Measured { e1: sums.total.share_of(power), einf: sums.largest.share_of(mean) }
    };
    of(&leaving).max(of(&|_| Rgb::splat(1.0)))
}

#[derive(Default)]
struct Sums {
    total: Rgb,
    largest: Rgb,
}

impl Sums {
    fn add(&mut self, area: f64, difference: Rgb) {
        self.total += difference * area;
        self.largest = Rgb([0, 1, 2].map(|c| self.largest[c].max(difference[c])));
    }

    fn relative(&self, whole: &Sides) -> Measured {
        Measured { e1: self.total.share_of(whole.power), einf: self.largest.share_of(whole.mean()) }
    }
}
