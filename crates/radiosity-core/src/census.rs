//! Where light that leaves a patch ends up: at fronts, at backs, or nowhere.
//!
//! A sample of directions per patch, fixed for all runs. It splits what the shots could not
//! deliver into light that left the scene, light that met a back, and the form factors'
//! own defect; it does not change the light.

use std::f64::consts::TAU;

use accel::{Bvh, NO_TRIANGLE, Occluder, Segment};
use glam::DVec3;
use scene::{Face, Rgb, Scene, Sides, TriangleId};

use crate::config::Exchange;
use crate::executor::Executor;
use crate::mesh::{Mesh, Patch};
use crate::needs;
use crate::observer::Stopper;
use crate::shooting::SEGMENT_LIFT;

/// Directions per patch: the ledger sums over hundreds of patches, so few are enough, and
/// in a closed scene any number gives the exact 0.
const DIRECTIONS: u32 = 32;

/// Points per run of an executor.
const RUN: usize = 256;

/// Rays start this share of the way to an element's centroid off its rim, where a neighbour
/// may lie in the ray's own plane.
const OFF_RIM: f64 = 0.02;

/// Shares of what leaves a patch, if its elements shine alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fate {
    /// Leaves the scene.
    pub escapes: f64,
    /// Meets a side that takes no light.
    pub meets_back: f64,
}

/// Where one sampled direction ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum End {
    /// At a side that takes light.
    #[default]
    Received,
    /// At a side that takes light, and reflects none of it.
    Black,
    /// At the back of a one-sided surface.
    Back,
    /// It starts inside something, where no light is: the light of its element comes from
    /// elsewhere on it.
    Inside,
    Nowhere,
}

/// One direction from one element of a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sample {
    element: u32,
    end: End,
}

/// The sampled directions of all patches: 8 bytes each, 256 a patch; and a byte per point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    /// [`DIRECTIONS`] for each patch.
    samples: Vec<Sample>,
    /// Whether each receiver point lies inside something: see [`Census::buried`].
    buried: Vec<bool>,
    /// No samples were needed: all light arrives.
    closed: bool,
}

/// A shot's power that met backs, and that left the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Lost {
    pub(crate) wrong_side: Rgb,
    pub(crate) escaped: Rgb,
    /// Met surfaces that reflect none of it: counted where those receive nothing.
    pub(crate) black: Rgb,
}

impl Census {
    /// Of a closed scene in which every place sees all that it faces: all light arrives, and no place
    /// lies inside of anything. Not one direction is followed.
    #[must_use]
    pub fn closed() -> Self {
        Self { closed: true, ..Self::default() }
    }

    /// How many directions were followed, at least: those of the samples and of the points.
    #[must_use]
    pub fn directions(&self) -> u64 {
        (self.samples.len() + self.buried.len()) as u64
    }

    /// Samples where each patch's light goes; `bvh` holds the scene's triangles in order.
    #[must_use]
    pub fn take<E: Executor>(
        scene: &Scene,
        mesh: &Mesh,
        bvh: &Bvh,
        exchange: Exchange,
        executor: &E,
    ) -> Self {
        Self::take_unless(scene, mesh, bvh, exchange, executor, None).unwrap_or_default()
    }

    /// As [`Census::take`], if nothing stops it on the way.
    pub(crate) fn take_unless<E: Executor>(
        scene: &Scene,
        mesh: &Mesh,
        bvh: &Bvh,
        exchange: Exchange,
        executor: &E,
        stopper: Option<&Stopper>,
    ) -> Option<Self> {
        let stopped = || stopper.is_some_and(|stop| stop());
        let black = needs::black(&mesh.roots);
        let black =
            if black.contains(&true) { black_sides(scene, mesh, &black) } else { Vec::new() };
        let look = Look { scene, mesh, bvh, exchange, black };
        let mut buried = vec![false; mesh.points.len()];
        let mut work: Vec<_> = mesh.points.chunks(RUN).zip(buried.chunks_mut(RUN)).collect();
        executor.for_each(&mut work, |(points, buried)| {
            if stopped() {
                return;
            }
            for (point, slot) in points.iter().zip(buried.iter_mut()) {
                *slot = look.is_buried(point.position, point.normal);
            }
        });
        let mut samples = vec![Sample::default(); mesh.patches.len() * DIRECTIONS as usize];
        let slots = samples.chunks_mut(DIRECTIONS as usize);
        let mut work: Vec<_> = (0u32..).zip(&mesh.patches).zip(slots).collect();
        executor.for_each(&mut work, |((number, patch), slots)| {
            // Patches of one plane must not all look the same way.
            let shift = spread(*number);
            if stopped() {
                return;
            }
            for (i, slot) in (0..).zip(slots.iter_mut()) {
                *slot = look.follow(patch, i, shift);
            }
        });
        (!stopped()).then_some(Self { samples, buried, closed: false })
    }

    /// Whether a receiver point lies inside something, such as a floor's point below a box:
    /// it sees nothing but backs. No one sees such a point either, so pictures must not
    /// spread its darkness to its neighbours.
    #[must_use]
    pub fn buried(&self, point: u32) -> bool {
        self.buried.get(point as usize).is_some_and(|b| *b)
    }

    /// Whether there are no samples: an empty mesh, or no census taken.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty() && !self.closed
    }

    /// The fates, in the order of the mesh's patches.
    pub fn fates(&self) -> impl Iterator<Item = Fate> + '_ {
        self.samples.chunks(DIRECTIONS as usize).map(|samples| {
            let share = |end| {
                let n = samples.iter().filter(|s| s.end == end).count();
                n as f64 / f64::from(DIRECTIONS)
            };
            Fate { escapes: share(End::Nowhere), meets_back: share(End::Back) }
        })
    }

    /// Whether some sampled direction meets a back or leaves the scene.
    pub(crate) fn any_lost(&self) -> bool {
        self.samples.iter().any(|s| matches!(s.end, End::Back | End::Nowhere))
    }

    /// What a shot loses: each sample stands for the light of its own element, so that a
    /// dark corner of a patch behind a wall does not speak for the lit rest.
    pub(crate) fn lost(&self, patch: usize, power: Rgb, unshot: &[Rgb]) -> Lost {
        let first = patch * DIRECTIONS as usize;
        let Some(samples) = self.samples.get(first..first + DIRECTIONS as usize) else {
            return Lost::default();
        };
        let mut all = Rgb::ZERO;
        let mut ends = Lost::default();
        for sample in samples {
            let light = unshot[sample.element as usize];
            if sample.end != End::Inside {
                all += light;
            }
            match sample.end {
                End::Received | End::Inside => {}
                End::Black => ends.black += light,
                End::Back => ends.wrong_side += light,
                End::Nowhere => ends.escaped += light,
            }
        }
        let share = |part: Rgb| {
            Rgb([0, 1, 2].map(|c| if all[c] > 0.0 { power[c] * (part[c] / all[c]) } else { 0.0 }))
        };
        Lost {
            wrong_side: share(ends.wrong_side),
            escaped: share(ends.escaped),
            black: share(ends.black),
        }
    }
}

/// What looks around, and at what.
struct Look<'a> {
    scene: &'a Scene,
    mesh: &'a Mesh,
    bvh: &'a Bvh,
    exchange: Exchange,
    /// Whether the front and the back of each triangle are black; empty if none is.
    black: Vec<[bool; 2]>,
}

impl Look<'_> {
    /// Follows the i-th direction of a patch.
    fn follow(&self, patch: &Patch, i: u32, shift: [f64; 2]) -> Sample {
        let element = element_of(self.mesh, patch, i);
        let start = &self.mesh.elements[element as usize];
        // In the paired rule every other direction leaves from the back.
        let side = if self.exchange == Exchange::Paired && i % 2 == 1 { -1.0 } else { 1.0 };
        let out = self.mesh.root_of(start).normal * side;
        let from = place(self.mesh.corners(start.vertices), i);
        let way = direction(out, i, shift);
        let end = match self.end(from, out, way, side) {
            End::Back if self.is_buried(from, out) => End::Inside,
            End::Back if self.another_there(from, out, way) => End::Received,
            end => end,
        };
        Sample { element, end }
    }

    /// Whether a place on a surface sees nothing but backs.
    fn is_buried(&self, at: DVec3, normal: DVec3) -> bool {
        // Paired surfaces shine and receive on both sides: nothing is inside of anything.
        self.exchange == Exchange::OneSided
            && (0..DIRECTIONS)
                .all(|i| self.end(at, normal, direction(normal, i, [0.0; 2]), 1.0) == End::Back)
    }

    /// Where a ray from a surface ends; `side` is −1 if it leaves from the back.
    fn end(&self, from: DVec3, out: DVec3, way: DVec3, side: f64) -> End {
        let from = from + out * (SEGMENT_LIFT * self.mesh.extent);
        let Some(hit) = self.bvh.nearest(from, way) else { return End::Nowhere };
        let material = self.scene.material_of(TriangleId(hit.triangle));
        let received = material.sides == Sides::Both || hit.front == (side > 0.0);
        let black = || {
            let sides = self.black.get(hit.triangle as usize);
            sides.is_some_and(|sides| sides[usize::from(!hit.front)])
        };
        match received {
            true if black() => End::Black,
            true => End::Received,
            false => End::Back,
        }
    }

    /// Whether a second surface lies where a ray met a back: of two sheets back to back in
    /// one place, the ray may name either, and the other one takes the light.
    fn another_there(&self, from: DVec3, out: DVec3, way: DVec3) -> bool {
        let lift = SEGMENT_LIFT * self.mesh.extent;
        let Some(hit) = self.bvh.nearest(from + out * lift, way) else { return false };
        let place = from + out * lift + way * hit.t;
        let (from, to) = (place - way * lift, place + way * lift);
        self.bvh.occluded(&Segment { from, to, ignore: [hit.triangle, NO_TRIANGLE] })
    }
}

/// Whether the front and the back of each triangle are black.
fn black_sides(scene: &Scene, mesh: &Mesh, black: &[bool]) -> Vec<[bool; 2]> {
    let mut sides = vec![[false; 2]; scene.triangles().len()];
    for (root, black) in mesh.roots.iter().zip(black) {
        sides[root.triangle.index()][usize::from(root.face == Face::Back)] |= black;
    }
    sides
}

/// The element that the i-th direction starts from: shared out by area.
fn element_of(mesh: &Mesh, patch: &Patch, i: u32) -> u32 {
    let area_of = |e: u32| mesh.elements[e as usize].area;
    let total: f64 = patch.elements.clone().map(area_of).sum();
    // Odd steps through the directions, so that neighbours do not start beside each other.
    const STEP: u32 = 13;
    let wanted = total * (f64::from((i * STEP) % DIRECTIONS) + 0.5) / f64::from(DIRECTIONS);
    let mut passed = 0.0;
    for e in patch.elements.clone() {
        passed += area_of(e);
        if passed > wanted {
            return e;
        }
    }
    patch.elements.end - 1
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
