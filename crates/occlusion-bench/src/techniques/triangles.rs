//! Triangles in memory, and whether a segment crosses one, with both as switches.

use glam::{Vec3, Vec4};

use super::switches::{Data, Switches};

/// Numbers of a triangle: three vertices, a normal and the plane's constant, and bounds.
const FIELDS: usize = 19;
const NORMAL: usize = 9;
const CONSTANT: usize = 12;
const LO: usize = 13;
const HI: usize = 16;

/// Triangles per block.
const LANES: usize = 4;

/// A segment in the octree's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    pub(super) origin: Vec3,
    pub(super) direction: Vec3,
    pub(super) inverse: Vec3,
    end: Vec3,
    lo: Vec3,
    hi: Vec3,
}

impl Path {
    pub(super) fn new(origin: Vec3, end: Vec3) -> Self {
        let direction = end - origin;
        // No reciprocal is infinite.
        let slope =
            Vec3::select(direction.abs().cmplt(LEAST), LEAST.copysign(direction), direction);
        let inverse = slope.recip();
        Self { origin, direction, inverse, end, lo: origin.min(end), hi: origin.max(end) }
    }
}

const LEAST: Vec3 = Vec3::splat(1e-20);

/// The triangles of an octree, and what its lists point at.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    structs: Vec<[f32; FIELDS]>,
    arrays: [Vec<f32>; FIELDS],
    blocks: Vec<[Vec4; FIELDS]>,
    /// Positions of triangles, by list.
    listed: Vec<u32>,
}

impl Triangles {
    pub(super) fn new(vertices: &[[Vec3; 3]], data: Data) -> Self {
        let structs: Vec<_> = vertices.iter().map(fields).collect();
        let mut triangles = Self::default();
        if data == Data::Arrays {
            triangles.arrays =
                std::array::from_fn(|field| structs.iter().map(|t| t[field]).collect());
        } else {
            triangles.structs = structs;
        }
        triangles
    }

    /// Adds a list; returns where it starts and how long it is.
    pub(super) fn add(&mut self, list: &[u32], data: Data) -> (u32, u32) {
        if data != Data::Blocks {
            let first = self.listed.len();
            self.listed.extend_from_slice(list);
            return (first as u32, list.len() as u32);
        }
        let first = self.blocks.len();
        for four in list.chunks(LANES) {
            // The first fills the gaps.
            let at = |lane: usize| self.structs[*four.get(lane).unwrap_or(&four[0]) as usize];
            let [a, b, c, d] = [at(0), at(1), at(2), at(3)];
            let block =
                std::array::from_fn(|field| Vec4::new(a[field], b[field], c[field], d[field]));
            self.blocks.push(block);
        }
        (first as u32, (self.blocks.len() - first) as u32)
    }

    /// The least parameter at which a triangle of a list crosses the segment, or any if the first
    /// will do.
    #[inline(always)]
    pub(super) fn crossing(
        &self,
        switches: Switches,
        (first, count): (u32, u32),
        path: &Path,
        any: bool,
    ) -> Option<f32> {
        let run = first as usize..(first + count) as usize;
        let mut nearest = None;
        match switches.data {
            Data::Structs => {
                for &position in &self.listed[run] {
                    let triangle = &self.structs[position as usize];
                    if let Some(t) = crossing(switches, path, |field| triangle[field]) {
                        keep(&mut nearest, t);
                        if any {
                            break;
                        }
                    }
                }
            }
            Data::Arrays => {
                for &position in &self.listed[run] {
                    let at = position as usize;
                    if let Some(t) = crossing(switches, path, |field| self.arrays[field][at]) {
                        keep(&mut nearest, t);
                        if any {
                            break;
                        }
                    }
                }
            }
            Data::Blocks => {
                for block in &self.blocks[run] {
                    if let Some(t) = crossing_of_four(switches.boxes, path, block) {
                        keep(&mut nearest, t);
                        if any {
                            break;
                        }
                    }
                }
            }
        }
        nearest
    }
}

#[inline(always)]
fn keep(nearest: &mut Option<f32>, t: f32) {
    *nearest = Some(nearest.map_or(t, |old| old.min(t)));
}

fn fields([a, b, c]: &[Vec3; 3]) -> [f32; FIELDS] {
    let normal = (b - a).cross(c - a);
    let (lo, hi) = (a.min(*b).min(*c), a.max(*b).max(*c));
    let mut fields = [0.0; FIELDS];
    let parts = [(0, *a), (3, *b), (6, *c), (NORMAL, normal), (LO, lo), (HI, hi)];
    for (first, part) in parts {
        fields[first..first + 3].copy_from_slice(&part.to_array());
    }
    fields[CONSTANT] = normal.dot(*a);
    fields
}

#[inline(always)]
fn vector(get: &impl Fn(usize) -> f32, first: usize) -> Vec3 {
    Vec3::new(get(first), get(first + 1), get(first + 2))
}

/// Where the segment crosses a triangle: its bounds must meet, its ends lie on two sides of the
/// plane, and the volumes it spans with the three edges have one sign.
#[inline(always)]
fn crossing(switches: Switches, path: &Path, get: impl Fn(usize) -> f32) -> Option<f32> {
    let apart = || {
        let far = |axis: usize| (path.lo[axis] > get(HI + axis)) | (path.hi[axis] < get(LO + axis));
        if switches.short_circuit { far(0) || far(1) || far(2) } else { far(0) | far(1) | far(2) }
    };
    if switches.short_circuit && switches.boxes && apart() {
        return None;
    }
    let normal = vector(&get, NORMAL);
    let (a, b) = (normal.dot(path.origin) - get(CONSTANT), normal.dot(path.end) - get(CONSTANT));
    if switches.short_circuit {
        if alike(switches.signs, a, b) {
            return None;
        }
        let inside = if switches.cold {
            cold_inside(switches.signs, path, &get)
        } else {
            inside(switches, path, &get)
        };
        inside.then(|| a / (a - b))
    } else {
        let out = switches.boxes & apart();
        let inside = inside(switches, path, &get);
        (!out & !alike(switches.signs, a, b) & inside).then(|| a / (a - b))
    }
}

/// Whether two numbers have one sign.
#[inline(always)]
fn alike(signs: bool, a: f32, b: f32) -> bool {
    if signs { (a.to_bits() ^ b.to_bits()) >> 31 == 0 } else { a * b >= 0.0 }
}

/// Whether the segment's line passes within the edges.
#[inline(always)]
fn inside(switches: Switches, path: &Path, get: &impl Fn(usize) -> f32) -> bool {
    let [a, b, c] = [0, 3, 6].map(|first| vector(get, first) - path.origin);
    let u = path.direction.dot(c.cross(b));
    let v = path.direction.dot(a.cross(c));
    let w = |()| path.direction.dot(b.cross(a));
    if switches.short_circuit {
        alike(switches.signs, u, v) && alike(switches.signs, v, w(()))
    } else {
        alike(switches.signs, u, v) & alike(switches.signs, v, w(()))
    }
}

#[cold]
#[inline(never)]
fn cold_inside(signs: bool, path: &Path, get: &impl Fn(usize) -> f32) -> bool {
    let [a, b, c] = [0, 3, 6].map(|first| vector(get, first) - path.origin);
    let u = path.direction.dot(c.cross(b));
    let v = path.direction.dot(a.cross(c));
    alike(signs, u, v) && alike(signs, v, path.direction.dot(b.cross(a)))
}

/// [`crossing`] of four triangles at once, signs compared; the least parameter.
#[inline(always)]
fn crossing_of_four(boxes: bool, path: &Path, block: &[Vec4; FIELDS]) -> Option<f32> {
    let splat = |v: Vec3| v.to_array().map(Vec4::splat);
    if boxes {
        let far = |axis: usize| {
            block[LO + axis].cmpgt(Vec4::splat(path.hi[axis]))
                | block[HI + axis].cmplt(Vec4::splat(path.lo[axis]))
        };
        if (far(0) | far(1) | far(2)).all() {
            return None;
        }
    }
    let dot = |a: &[Vec4], b: &[Vec4; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let normal = &block[NORMAL..CONSTANT];
    let a = dot(normal, &splat(path.origin)) - block[CONSTANT];
    let b = dot(normal, &splat(path.end)) - block[CONSTANT];
    let sides = a.is_negative_bitmask() ^ b.is_negative_bitmask();
    if sides == 0 {
        return None;
    }
    let origin = splat(path.origin);
    let direction = splat(path.direction);
    let relative = |first: usize| [0, 1, 2].map(|axis| block[first + axis] - origin[axis]);
    let (p, q, r) = (relative(0), relative(3), relative(6));
    let volume = |a: &[Vec4; 3], b: &[Vec4; 3]| {
        let cross =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        dot(&cross, &direction).is_negative_bitmask()
    };
    let (u, v, w) = (volume(&r, &q), volume(&p, &r), volume(&q, &p));
    let mut hits = sides & !(u ^ v) & !(v ^ w) & 0b1111;
    let mut nearest = None;
    while hits != 0 {
        let lane = hits.trailing_zeros() as usize;
        hits &= hits - 1;
        keep(&mut nearest, a[lane] / (a[lane] - b[lane]));
    }
    nearest
}
