//! Where light that leaves a patch ends up: at fronts, at backs, or nowhere.
//!
//! A sample of directions per patch, fixed for all runs. It splits what the shots could not
//! deliver into light that left the scene, light that met a back, and the form factors'
//! own defect; it does not change the light.

use std::f64::consts::TAU;

use accel::Bvh;
use glam::DVec3;
use scene::{Rgb, Scene, Sides};

use crate::config::Exchange;
use crate::executor::Executor;
use crate::mesh::{Mesh, Patch};
use crate::shooting::SEGMENT_LIFT;

/// Directions per patch: the ledger sums over hundreds of patches, so few are enough, and
/// in a closed scene any number gives the exact 0.
const DIRECTIONS: u32 = 32;

/// Rays start this share of the way to the patch's centroid off its rim, where a neighbour
/// may lie in the ray's own plane.
const OFF_RIM: f64 = 0.02;

/// Shares of the light leaving a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fate {
    /// Leaves the scene.
    pub escapes: f64,
    /// Meets a side that takes no light.
    pub meets_back: f64,
}

/// The fates of all patches' light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    pub(crate) fates: Vec<Fate>,
}

impl Census {
    /// Samples where each patch's light goes; `bvh` holds the scene's triangles in order.
    #[must_use]
    pub fn take<E: Executor>(
        scene: &Scene,
        mesh: &Mesh,
        bvh: &Bvh,
        exchange: Exchange,
        executor: &E,
    ) -> Self {
        let mut work: Vec<(u32, &Patch, Fate)> =
            (0u32..).zip(&mesh.patches).map(|(n, p)| (n, p, Fate::default())).collect();
        executor.for_each(&mut work, |(number, patch, fate)| {
            *fate = fate_of(scene, mesh, bvh, exchange, *number, patch);
        });
        Self { fates: work.into_iter().map(|w| w.2).collect() }
    }

    /// The fates, in the order of the mesh's patches.
    #[must_use]
    pub fn fates(&self) -> &[Fate] {
        &self.fates
    }

    /// The power that met backs, of a shot's power.
    pub(crate) fn wrong_side(&self, patch: usize, power: Rgb) -> Rgb {
        self.fates.get(patch).map_or(Rgb::ZERO, |f| power * f.meets_back)
    }

    /// The power that left the scene, of a shot's power.
    pub(crate) fn escaped(&self, patch: usize, power: Rgb) -> Rgb {
        self.fates.get(patch).map_or(Rgb::ZERO, |f| power * f.escapes)
    }
}

fn fate_of(
    scene: &Scene,
    mesh: &Mesh,
    bvh: &Bvh,
    exchange: Exchange,
    number: u32,
    patch: &Patch,
) -> Fate {
    // Patches of one plane must not all look the same way.
    let shift = spread(number);
    let node = &mesh.nodes[patch.node as usize];
    let normal = mesh.roots[node.root as usize].normal;
    let corners = mesh.corners(node.vertices);
    let (mut escapes, mut meets_back) = (0u32, 0u32);
    for i in 0..DIRECTIONS {
        // In the paired rule every other direction leaves from the back.
        let side = if exchange == Exchange::Paired && i % 2 == 1 { -1.0 } else { 1.0 };
        let out = normal * side;
        let origin = place(corners, i) + out * (SEGMENT_LIFT * mesh.extent);
        match bvh.nearest(origin, direction(out, i, shift)) {
            None => escapes += 1,
            Some(hit) => {
                let triangle = scene::TriangleId(hit.triangle);
                let takes_both = scene.material_of(triangle).sides == Sides::Both;
                meets_back += u32::from(!takes_both && hit.front != (side > 0.0));
            }
        }
    }
    let share = |n: u32| f64::from(n) / f64::from(DIRECTIONS);
    Fate { escapes: share(escapes), meets_back: share(meets_back) }
}

/// The i-th of a sequence of points spread over the unit square: multiples of the powers of
/// the plastic number, the golden ratio of two dimensions (Roberts 2018).
fn spread(i: u32) -> [f64; 2] {
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|s| (0.5 + s * f64::from(i)).fract())
}

/// The i-th of a set of places spread over a triangle, off its rim.
fn place([a, b, c]: [DVec3; 3], i: u32) -> DVec3 {
    let [u, v] = spread(i);
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let on_triangle = a + (b - a) * u + (c - a) * v;
    on_triangle.lerp((a + b + c) / 3.0, OFF_RIM)
}

/// The i-th of a set of directions spread like cosθ around `up`: Hammersley points, shifted
/// round the square (Cranley & Patterson 1976) and projected from a disk (Malley 1988).
fn direction(up: DVec3, i: u32, shift: [f64; 2]) -> DVec3 {
    let u = ((f64::from(i) + 0.5) / f64::from(DIRECTIONS) + shift[0]).fract();
    let v = (f64::from(i.reverse_bits()) / 4_294_967_296.0 + shift[1]).fract();
    let (x, y) = up.any_orthonormal_pair();
    let (sine, cosine) = (TAU * v).sin_cos();
    (x * (u.sqrt() * cosine) + y * (u.sqrt() * sine) + up * (1.0 - u).sqrt()).normalize()
}
