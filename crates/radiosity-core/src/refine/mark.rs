//! Where the next mesh needs more elements: where light is not what its neighbours foretell.
//!
//! Each vertex that a bisection brought is a test of the mesh before: there the exitance was
//! computed, and halfway between the ends of the halved edge it would have been interpolated. The
//! difference over the squared length is the curvature c of the light there, and an element of
//! edge h errs by some c·h². Elements of equal error times area have a density that goes with
//! √c. All light counts together, so a dim shooter's shadow splits nothing.

use scene::{Rgb, VertexId};

use super::difference::Lit;
use super::surface::Counted;
use crate::executor::Executor;
use crate::mesh::{Mesh, triangle_area};

/// Roots per run of an executor.
const RUN: usize = 64;

/// Every element gets this share of the mean density, whatever its light: so half of the elements
/// go where nothing was seen yet, and every feature is met in the end.
const FLOOR: f64 = 1.0;

/// No density is more than this many times the mean: what it was computed from is a sample of the
/// light. Chosen with the floor on two scenes (docs/design.md).
const MOST: f64 = 4.0;

/// Densities are rounded to so many steps per doubling, or rounding errors would break ties between
/// elements that are alike.
const STEPS: f64 = 4.0;

/// The bisections above an element that speak for it: the longest edges of two in line point in
/// different directions.
const ANCESTORS: u8 = 2;

/// The density that the place of each element deserves in the next mesh, beside the others.
pub(super) fn densities<E: Executor>(
    lit: Lit,
    mean: Rgb,
    counted: Counted,
    executor: &E,
) -> Vec<f64> {
    let mesh = lit.mesh;
    let mut found = vec![Found::default(); mesh.elements.len()];
    let mut rest = found.as_mut_slice();
    let mut runs = Vec::new();
    for first in (0..mesh.roots.len()).step_by(RUN) {
        let roots = first..(first + RUN).min(mesh.roots.len());
        let elements = roots.clone().map(|r| mesh.nodes[r].elements.len()).sum();
        let slots = rest.split_off_mut(..elements).expect("roots hold all elements, in order");
        runs.push((roots, slots));
    }
    executor.for_each(&mut runs, |(roots, slots)| {
        let first = mesh.nodes[roots.start].elements.start;
        let mut mark = Mark { lit, mean, first, slots };
        for root in roots.clone() {
            mark.visit(root as u32);
        }
    });
    smooth(mesh, counted, &found)
}

/// The largest curvature of the light around an element, and how many bisections said so.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    curvature: f64,
    by: u8,
}

/// A run of roots with the slots of its elements.
struct Mark<'a> {
    lit: Lit<'a>,
    /// Exitance that counts as 1.
    mean: Rgb,
    first: u32,
    slots: &'a mut [Found],
}

impl Mark<'_> {
    /// The exitance at the corners of a node; on the way, marks the elements below it.
    fn visit(&mut self, id: u32) -> [Rgb; 3] {
        let mesh = self.lit.mesh;
        let node = &mesh.nodes[id as usize];
        if node.is_leaf() {
            return self.lit.solution.elements[node.elements.start as usize].corner_exitance;
        }
        let parts: Vec<[Rgb; 3]> = node.children.clone().map(|part| self.visit(part)).collect();
        let half = |p: Rgb, q: Rgb| (p + q) / 2.0;
        let first = mesh.nodes[node.children.start as usize].vertices;
        // At the corners, starting with the first part's; at the new vertex; interpolated there.
        let (corners, new, between, squared) = match *parts {
            // The halves of a–b–c are a–m–c and m–b–c.
            [[a, m, c], [other_m, b, other_c]] => {
                let far = mesh.nodes[node.children.start as usize + 1].vertices[1];
                let place = |v: VertexId| mesh.vertices[v.index()];
                let squared = place(first[0]).distance_squared(place(far));
                ([a, b, half(c, other_c)], half(m, other_m), half(a, b), squared)
            }
            // The thirds are a–b–m, b–c–m and c–a–m.
            [[a, b, m], [other_b, c, m2], [other_c, other_a, m3]] => {
                let corners = [half(a, other_a), half(b, other_b), half(c, other_c)];
                let between = corners.into_iter().sum::<Rgb>() / 3.0;
                let area = triangle_area(mesh.corners(node.vertices));
                (corners, (m + m2 + m3) / 3.0, between, 2.0 * area)
            }
            _ => unreachable!("nodes are split into two or three"),
        };
        let surplus = (new - between).abs().share_of(self.mean).max_channel();
        let range = node.elements.start - self.first..node.elements.end - self.first;
        for slot in &mut self.slots[range.start as usize..range.end as usize] {
            if slot.by < ANCESTORS {
                slot.by += 1;
                slot.curvature = slot.curvature.max(surplus / squared);
            }
        }
        // As the node's own vertices are turned.
        let turn = node.vertices.iter().position(|v| *v == first[0]).unwrap_or(0);
        [0, 1, 2].map(|i| corners[(i + 3 - turn) % 3])
    }
}

/// Curvatures to densities: their roots, between limits about the mean, in steps.
fn smooth(mesh: &Mesh, counted: Counted, found: &[Found]) -> Vec<f64> {
    let (mut sum, mut area) = (0.0, 0.0);
    for (element, found) in mesh.elements.iter().zip(found) {
        if counted.counts(mesh, element) && found.by > 0 {
            sum += found.curvature.sqrt() * element.area;
            area += element.area;
        }
    }
    let mean = if area > 0.0 { sum / area } else { 0.0 };
    let density = |(element, found): (&crate::mesh::Element, &Found)| {
        if mean <= 0.0 || !mean.is_finite() {
            return 1.0;
        }
        let own = match counted.counts(mesh, element) && found.by > 0 {
            true => (found.curvature.sqrt() / mean).min(MOST),
            false => 1.0,
        };
        ((own + FLOOR).log2() * STEPS).round().exp2().powf(1.0 / STEPS)
    };
    mesh.elements.iter().zip(found).map(density).collect()
}
