//! Form factors and visibility, estimated a second time on a sample of elements.

use scene::{Rgb, Scene, Solution};

use super::statement::Measured;
use super::surface::{Counted, Sides, counted_elements, side_of};
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::Stopper;
use crate::shooting::Shooting;

/// Elements in the sample: enough for an error of the error of some ten per cent.
const SAMPLE: usize = 256;

/// What the sample says.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sampled {
    pub(super) triangles: Measured,
    pub(super) points: Measured,
    pub(super) rows: [f64; 2],
    pub(super) elements: usize,
}

impl Sampled {
    /// Nothing was sampled.
    pub(super) const UNKNOWN: Self = Self {
        triangles: Measured::UNKNOWN,
        points: Measured::UNKNOWN,
        rows: [0.0; 2],
        elements: 0,
    };
}

/// Compares what the shots brought to the corners of a sample of elements with a finer
/// estimate of the same.
///
/// The sample is systematic: every element stands in line for as long as its counted power,
/// and one is taken at equal steps. A difference δ is worth ρδ of exitance there. What the
/// differences have in common goes on to other surfaces, h̄/(1 − h̄) times, with h̄ the share of
/// the light shot that comes back.
///
/// `None` if it was stopped on the way.
pub(super) fn form_factors<E: Executor>(
    scene: &Scene,
    mesh: &Mesh,
    shooting: &Shooting<'_, E>,
    solution: &Solution,
    counted: Counted,
    stopper: Option<&Stopper>,
) -> Option<Sampled> {
    let whole = Sides::of(scene, mesh, solution, counted);
    let chosen = choose(mesh, solution, counted, whole.power.sum());
    if chosen.is_empty() {
        return Some(Sampled { rows: [1.0, 1.0], ..Sampled::default() });
    }
    let points: Vec<u32> = chosen.iter().flat_map(|c| mesh.elements[c.element].points).collect();
    let gathered = shooting.gather_unless(&points, stopper)?;
    let mut rows = [f64::INFINITY, 0.0f64];
    for g in &gathered {
        rows = [rows[0].min(g.row), rows[1].max(g.row)];
    }
    // Σ over the sample estimates ∫ over the surfaces: each stands for its share of the power.
    let mut absolute = Rgb::ZERO;
    let mut largest = Rgb::ZERO;
    let mut common = Rgb::ZERO;
    let mut by_side: Vec<OfSide> = Vec::new();
    for (c, corners) in chosen.iter().zip(gathered.chunks(3)) {
        let rho = mesh.root_of(&mesh.elements[c.element]).reflectance;
        let difference: Rgb = corners.iter().map(|g| g.irradiance - g.shot).sum();
        let exitance = rho * difference / 3.0;
        let power = exitance * c.stands_for;
        absolute += power.abs();
        common += power;
        largest = larger(largest, exitance.abs());
        match by_side.last_mut() {
            Some(last) if last.side == c.side => {
                last.power += power;
                last.area += c.stands_for;
            }
            _ => by_side.push(OfSide { side: c.side, power, area: c.stands_for }),
        }
    }
    let of_sides: Rgb = by_side.iter().map(|s| s.power.abs()).sum();
    let worst_side = by_side.iter().map(|s| s.power.abs() / s.area).fold(Rgb::ZERO, larger);
    let back = returning(mesh, solution);
    let spread = Rgb([0, 1, 2].map(|c| common[c].abs() * back[c] / (1.0 - back[c])));
    let relative = |sum: Rgb, most: Rgb| Measured {
        e1: (sum + spread).share_of(whole.power),
        einf: most.share_of(whole.mean()),
    };
    Some(Sampled {
        triangles: relative(of_sides, worst_side),
        points: relative(absolute, largest),
        rows,
        elements: chosen.len(),
    })
}

/// What the sample's elements on one side of a triangle have in common.
struct OfSide {
    side: usize,
    power: Rgb,
    area: f64,
}

fn larger(a: Rgb, b: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| a[c].max(b[c])))
}

/// An element of the sample.
struct Chosen {
    element: usize,
    side: usize,
    /// The area it stands for.
    stands_for: f64,
}

fn choose(mesh: &Mesh, solution: &Solution, counted: Counted, total: f64) -> Vec<Chosen> {
    let mut chosen: Vec<Chosen> = Vec::new();
    let step = total / SAMPLE as f64;
    let mut passed = 0.0;
    let mut next = step / 2.0;
    for (i, (element, lit)) in mesh.elements.iter().zip(&solution.elements).enumerate() {
        if !counted.counts(mesh, element) {
            continue;
        }
        let brightness = counted.part(mesh, element, lit.exitance).sum();
        passed += brightness * element.area;
        while step > 0.0 && passed > next {
            next += step;
            let stands_for = step / brightness;
            match chosen.last_mut() {
                Some(last) if last.element == i => last.stands_for += stands_for,
                _ => chosen.push(Chosen { element: i, side: side_of(lit), stands_for }),
            }
        }
    }
    chosen
}

/// The share of the exitance that is reflected light: what comes back of what is shot.
fn returning(mesh: &Mesh, solution: &Solution) -> Rgb {
    let (mut reflected, mut all) = (Rgb::ZERO, Rgb::ZERO);
    for (element, lit) in counted_elements(mesh, solution, Counted::Reflected) {
        reflected += (lit.exitance - mesh.root_of(element).emittance) * element.area;
        all += lit.exitance * element.area;
    }
    reflected.share_of(all)
}
