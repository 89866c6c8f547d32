//! Targets made ready for packets: narrowed, and ordered by direction where their order is poor.
//!
//! A packet is as good as its segments are alike. Meshes usually list neighbours together, and then
//! their order is kept; otherwise targets are sorted into cells on a cube around the origin, which
//! follow each other along a Morton curve (one pass of a counting sort).

use glam::Vec3A;

use super::packet::PACKET;
use crate::frame::Frame;
use crate::lanes::{Lanes, Simd};
use crate::{NO_TRIANGLE, Target};

/// Targets treated at once.
pub(super) const CHUNK: usize = 4096;

/// Directions shorter than this, in local units, are left to the test of single segments, because
/// their reciprocals may not be finite.
const LEAST_LENGTH: f32 = 1.0 / (1_u64 << 60) as f32;

/// Targets are sorted if more than one in this many is not in the neighbourhood of the one before
/// it: farther off than a packet is wide when packets share out the cube evenly (example `mrays`).
const JUMPS: usize = 16;

/// Up to [`CHUNK`] segments from one origin.
pub(super) struct Chunk {
    /// Differences of the narrowed ends, by axis.
    directions: [Vec<f32>; 3],
    ignore: Vec<u32>,
    /// Which target each is.
    places: Vec<u16>,
    keys: Vec<u32>,
    order: Vec<u16>,
}

/// Sixteen segments of a chunk. Where there are fewer, the last is repeated.
pub(super) struct Sixteen {
    pub(super) directions: [[f32; PACKET]; 3],
    pub(super) ignore: [u32; PACKET],
    pub(super) places: [u16; PACKET],
    pub(super) len: usize,
}

impl Sixteen {
    pub(super) const EMPTY: Self = Self {
        directions: [[0.0; PACKET]; 3],
        ignore: [NO_TRIANGLE; PACKET],
        places: [0; PACKET],
        len: 0,
    };

    #[inline(always)]
    pub(super) fn direction(&self, lane: usize) -> Vec3A {
        let [x, y, z] = &self.directions;
        Vec3A::new(x[lane], y[lane], z[lane])
    }
}

impl Chunk {
    /// Makes room for as many as a batch of `targets` needs.
    pub(super) fn new(targets: usize) -> Self {
        let room = targets.min(CHUNK);
        Self {
            directions: [(); 3].map(|()| Vec::with_capacity(room)),
            ignore: Vec::with_capacity(room),
            places: Vec::with_capacity(room),
            keys: Vec::with_capacity(room),
            order: Vec::with_capacity(room),
        }
    }

    /// Takes in up to [`CHUNK`] targets; calls `alone` for those that no packet can take.
    #[inline(always)]
    pub(super) fn fill<S: Simd>(
        &mut self,
        simd: S,
        frame: &Frame,
        origin: [f32; 3],
        targets: &[Target],
        mut alone: impl FnMut(usize),
    ) {
        self.directions.iter_mut().for_each(Vec::clear);
        self.ignore.clear();
        self.places.clear();
        for (i, targets) in targets.chunks(PACKET).enumerate() {
            let mut points = [&targets[0].point; PACKET];
            for (point, target) in points.iter_mut().zip(targets) {
                *point = &target.point;
            }
            let mut rows = [[0.0; PACKET]; 3];
            let mut regular = frame.narrow(points, &mut rows);
            let mut size = S::F16::splat(simd, 0.0);
            let mut axis = 0;
            while axis < 3 {
                let origin = S::F16::splat(simd, origin[axis]);
                let direction = S::F16::load(simd, &rows[axis]).sub(origin);
                direction.store(&mut rows[axis]);
                size = size.max(direction.abs());
                axis += 1;
            }
            regular &= S::F16::splat(simd, LEAST_LENGTH).le(size);
            let all = 0xffff >> (PACKET - targets.len());
            if regular & all == all {
                for (all, row) in self.directions.iter_mut().zip(&rows) {
                    all.extend_from_slice(&row[..targets.len()]);
                }
                self.ignore.extend(targets.iter().map(|target| target.ignore));
                let first = (i * PACKET) as u16;
                self.places.extend(first..first + targets.len() as u16);
                continue;
            }
            for (lane, target) in targets.iter().enumerate() {
                let place = i * PACKET + lane;
                if regular >> lane & 1 == 0 {
                    alone(place);
                    continue;
                }
                for (all, row) in self.directions.iter_mut().zip(&rows) {
                    all.push(row[lane]);
                }
                self.ignore.push(target.ignore);
                self.places.push(place as u16);
            }
        }
        self.sort();
    }

    /// How many packets there are.
    #[inline(always)]
    pub(super) fn packets(&self) -> usize {
        self.places.len().div_ceil(PACKET)
    }

    /// Gathers a packet.
    #[inline(always)]
    pub(super) fn packet(&self, index: usize, packet: &mut Sixteen) {
        let first = index * PACKET;
        let len = self.places.len();
        packet.len = PACKET.min(len - first);
        if self.order.is_empty() && packet.len == PACKET {
            for axis in 0..3 {
                packet.directions[axis].copy_from_slice(&self.directions[axis][first..][..PACKET]);
            }
            packet.ignore.copy_from_slice(&self.ignore[first..][..PACKET]);
            packet.places.copy_from_slice(&self.places[first..][..PACKET]);
            return;
        }
        for lane in 0..PACKET {
            let at = (first + lane).min(len - 1);
            let from = self.order.get(at).map_or(at, |&from| from as usize);
            for axis in 0..3 {
                packet.directions[axis][lane] = self.directions[axis][from];
            }
            packet.ignore[lane] = self.ignore[from];
            packet.places[lane] = self.places[from];
        }
    }

    /// Finds the order in which packets are taken; leaves it empty if that of the targets will do.
    #[inline(always)]
    fn sort(&mut self) {
        let len = self.places.len();
        self.order.clear();
        if len <= PACKET || !self.is_scattered() {
            return;
        }
        // About as many cells on the cube, 6 · 4ᵇ for b bits, as there are packets.
        let bits = if len < 256 {
            2
        } else if len < 1024 {
            3
        } else {
            4
        };
        let [x, y, z] = &self.directions;
        self.keys.clear();
        self.keys.resize(len, 0);
        for (((key, x), y), z) in self.keys.iter_mut().zip(x).zip(y).zip(z) {
            *key = place_on_cube(bits, *x, *y, *z);
        }
        let mut starts = [0_u16; 1 << 12];
        let starts = &mut starts[..1 << (3 * bits)];
        for &key in &self.keys {
            starts[key as usize] += 1;
        }
        let mut sum = 0;
        for start in starts.iter_mut() {
            sum += std::mem::replace(start, sum);
        }
        self.order.resize(len, 0);
        for (i, &key) in self.keys.iter().enumerate() {
            let start = &mut starts[key as usize];
            self.order[*start as usize] = i as u16;
            *start += 1;
        }
    }

    /// Whether the order of the targets is poor.
    #[inline(always)]
    fn is_scattered(&self) -> bool {
        // The cube has an area of 24.
        let wide = (24.0 / self.packets() as f32).sqrt();
        let [x, y, z] = &self.directions;
        let now = x.iter().zip(y).zip(z);
        let next = x[1..].iter().zip(&y[1..]).zip(&z[1..]);
        let mut jumps = 0_u32;
        for (((x, y), z), ((u, v), w)) in now.zip(next) {
            let apart = (x - u).abs().max((y - v).abs()).max((z - w).abs());
            let size = x.abs().max(y.abs()).max(z.abs());
            jumps += u32::from(apart > wide * size);
        }
        jumps as usize * JUMPS > self.places.len()
    }
}

/// The cell in which a direction meets a cube around the origin, in Morton order (Morton 1966).
#[inline(always)]
fn place_on_cube(bits: u32, x: f32, y: f32, z: f32) -> u32 {
    let half = ((1 << bits) / 2) as f32;
    let scale = 0.999 * half / x.abs().max(y.abs()).max(z.abs());
    let at = |d: f32| spread((d * scale + half) as i32 as u32);
    at(x) | at(y) << 1 | at(z) << 2
}

/// Puts two zeros before each of four bits.
#[inline(always)]
fn spread(bits: u32) -> u32 {
    let bits = (bits | bits << 4) & 0x0c3;
    (bits | bits << 2) & 0x249
}
