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

/// One packet in this many shows whether the order is poor.
const SAMPLE: usize = 4;

/// Up to [`CHUNK`] segments from one origin, in packets.
pub(super) struct Chunk {
    /// All but the last are full.
    packets: Vec<Sixteen>,
    /// The segments in their places before they are sorted.
    unsorted: Vec<Sixteen>,
    /// Where each segment belongs.
    keys: Vec<[u32; PACKET]>,
}

/// Sixteen segments. Where there are fewer, the last is repeated.
#[derive(Clone, Copy)]
pub(super) struct Sixteen {
    /// Differences of the narrowed ends, by axis.
    pub(super) directions: [[f32; PACKET]; 3],
    pub(super) ignore: [u32; PACKET],
    /// Which target of the chunk each is.
    pub(super) places: [u16; PACKET],
    pub(super) len: usize,
}

impl Sixteen {
    const EMPTY: Self = Self {
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

    /// The segments that ignore a triangle, one bit each.
    #[inline(always)]
    pub(super) fn ignoring(&self, triangle: u32) -> u32 {
        let mut bits = [0_u32; PACKET];
        for (lane, bit) in bits.iter_mut().enumerate() {
            *bit = u32::from(self.ignore[lane] == triangle) << lane;
        }
        bits.into_iter().fold(0, |all, bit| all | bit)
    }

    #[inline(always)]
    fn copy(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for axis in 0..3 {
            self.directions[axis][lane] = from.directions[axis][from_lane];
        }
        self.ignore[lane] = from.ignore[from_lane];
        self.places[lane] = from.places[from_lane];
    }

    /// Repeats the last segment in the lanes that are left.
    fn fill_up(&mut self) {
        let last = *self;
        for lane in self.len..PACKET {
            self.copy(lane, &last, self.len - 1);
        }
    }
}

impl Chunk {
    /// Makes room for as many as a batch of `targets` needs.
    pub(super) fn new(targets: usize) -> Self {
        let room = targets.min(CHUNK).div_ceil(PACKET);
        Self { packets: Vec::with_capacity(room), unsorted: Vec::new(), keys: Vec::new() }
    }

    /// The segments taken in last.
    #[inline(always)]
    pub(super) fn packets(&self) -> &[Sixteen] {
        &self.packets
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
        self.packets.resize(targets.len().div_ceil(PACKET), Sixteen::EMPTY);
        // Packets are filled in their places until a target is left out.
        let mut in_place = true;
        for (i, some) in targets.chunks(PACKET).enumerate() {
            let mut padded = [some[some.len() - 1]; PACKET];
            let targets: &[Target; PACKET] = some.try_into().unwrap_or_else(|_| {
                padded[..some.len()].copy_from_slice(some);
                &padded
            });
            let mut apart = Sixteen::EMPTY;
            let sixteen = if in_place { &mut self.packets[i] } else { &mut apart };
            sixteen.len = some.len();
            let (ends, mut regular) = frame.narrow(simd, targets);
            let mut size = S::F16::splat(simd, 0.0);
            let mut axis = 0;
            while axis < 3 {
                let direction = ends[axis].sub(S::F16::splat(simd, origin[axis]));
                direction.store(&mut sixteen.directions[axis]);
                size = size.max(direction.abs());
                axis += 1;
            }
            regular &= S::F16::splat(simd, LEAST_LENGTH).le(size);
            let first = (i * PACKET) as u16;
            for (lane, target) in targets.iter().enumerate() {
                sixteen.ignore[lane] = target.ignore;
                sixteen.places[lane] = first + lane as u16;
            }
            if in_place && regular == 0xffff {
                continue;
            }
            if in_place {
                apart = *sixteen;
                self.packets.truncate(i);
                in_place = false;
            }
            for lane in 0..some.len() {
                if regular >> lane & 1 == 1 {
                    self.push(&apart, lane);
                } else {
                    alone(i * PACKET + lane);
                }
            }
        }
        if let Some(last) = self.packets.last_mut() {
            last.fill_up();
        }
        self.sort();
    }

    /// Adds a segment to the last packet.
    fn push(&mut self, from: &Sixteen, from_lane: usize) {
        if self.packets.last().is_none_or(|last| last.len == PACKET) {
            self.packets.push(Sixteen::EMPTY);
        }
        if let Some(last) = self.packets.last_mut() {
            last.copy(last.len, from, from_lane);
            last.len += 1;
        }
    }

    /// Sorts the segments by direction if their order is poor.
    #[inline(always)]
    fn sort(&mut self) {
        let count = self.packets.len();
        if count < 2 || !self.is_scattered() {
            return;
        }
        // Several cells on the cube, 6 · 4ᵇ for b bits, to a packet.
        let bits = if count < 16 {
            2
        } else if count < 64 {
            3
        } else {
            4
        };
        self.keys.clear();
        let mut starts = [0_u16; 1 << 12];
        for packet in &self.packets {
            let [x, y, z] = &packet.directions;
            let mut keys = [0; PACKET];
            for (lane, key) in keys.iter_mut().enumerate() {
                *key = place_on_cube(bits, x[lane], y[lane], z[lane]);
            }
            for &key in &keys[..packet.len] {
                starts[key as usize] += 1;
            }
            self.keys.push(keys);
        }
        let mut sum = 0;
        for start in &mut starts[..1 << (3 * bits)] {
            sum += std::mem::replace(start, sum);
        }
        self.unsorted.clone_from(&self.packets);
        for (from, keys) in self.unsorted.iter().zip(&self.keys) {
            for (lane, &key) in keys[..from.len].iter().enumerate() {
                let start = &mut starts[key as usize];
                let to = *start as usize;
                *start += 1;
                self.packets[to / PACKET].copy(to % PACKET, from, lane);
            }
        }
        if let Some(last) = self.packets.last_mut() {
            last.fill_up();
        }
    }

    /// Whether the order of the targets is poor.
    #[inline(always)]
    fn is_scattered(&self) -> bool {
        // The cube has an area of 24.
        let wide = (24.0 / self.packets.len() as f32).sqrt();
        let (mut jumps, mut looked_at) = (0_u32, 0);
        for packet in self.packets.iter().step_by(SAMPLE) {
            looked_at += PACKET;
            let [x, y, z] = &packet.directions;
            for i in 1..PACKET {
                let apart = (x[i] - x[i - 1]).abs().max((y[i] - y[i - 1]).abs());
                let apart = apart.max((z[i] - z[i - 1]).abs());
                let size = x[i].abs().max(y[i].abs()).max(z[i].abs());
                jumps += u32::from(apart > wide * size);
            }
        }
        jumps as usize * JUMPS > looked_at
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
