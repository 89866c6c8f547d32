//! The octree, and the walk from leaf to leaf with its techniques as switches.

use accel::{Occluder, Segment};
use glam::{DVec3, Vec3};

use super::build::{Cell, HALF, MAX_DEPTH, build};
use super::lookup::Tables;
use super::switches::{Lookup, Stop, Switches, VARIANTS};
use super::triangles::{Path, Triangles};
use crate::{Triangle, bounds};

/// An octree whose techniques are those of the variant numbered `V`: the compiler sees which.
///
/// Positions are moved to the centre of the bounds, scaled into [-1, 1] and narrowed to f32.
#[derive(Clone, Debug)]
pub(super) struct Specimen<const V: usize> {
    centre: DVec3,
    scale: f64,
    depth: u32,
    cells: Vec<Cell>,
    triangles: Triangles,
    tables: Tables,
}

impl<const V: usize> Specimen<V> {
    const SWITCHES: Switches = VARIANTS[V].switches;

    /// Builds the octree.
    pub(super) fn build(triangles: &[Triangle]) -> Self {
        let (lo, hi) = bounds(triangles).unwrap_or_default();
        let centre = 0.5 * (lo + hi);
        let half = (0.5 * (hi - lo)).max_element();
        let scale = if half > 0.0 { half.recip() } else { 1.0 };
        let vertices: Vec<[Vec3; 3]> =
            triangles.iter().map(|t| t.map(|v| ((v - centre) * scale).as_vec3())).collect();
        let (cells, triangles, depth) = build(Self::SWITCHES, &vertices);
        let tables = Tables::new(Self::SWITCHES.lookup, &cells, depth);
        Self { centre, scale, depth, cells, triangles, tables }
    }

    /// The part of a segment that lies in the root.
    fn clipped(&self, segment: &Segment) -> Option<Path> {
        let from = (segment.from - self.centre) * self.scale;
        let to = (segment.to - self.centre) * self.scale;
        let d = to - from;
        let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
        let half = f64::from(HALF);
        if from.abs().max(to.abs()).max_element() > half {
            for axis in 0..3 {
                if d[axis] != 0.0 {
                    let (a, b) = ((-half - from[axis]) / d[axis], (half - from[axis]) / d[axis]);
                    (t0, t1) = (t0.max(a.min(b)), t1.min(a.max(b)));
                } else if from[axis].abs() > half {
                    return None;
                }
            }
        }
        let (a, b) = ((from + t0 * d).as_vec3(), (from + t1 * d).as_vec3());
        (t0 < t1 && a != b).then(|| Path::new(a, b))
    }

    /// Whether a triangle crosses the path: 3D-DDA (Amanatides & Woo 1987) on leaves of any size.
    fn walk(&self, path: &Path) -> bool {
        let switches = const { Self::SWITCHES };
        let depth = self.depth;
        let side = 1_i32 << depth;
        let (size, per_size) = (2.0 * HALF / side as f32, side as f32 / (2.0 * HALF));
        let place = |axis: usize, t: f32| {
            ((path.origin[axis] + t * path.direction[axis] + HALF) * per_size) as i32
        };
        let forward = path.inverse.cmpgt(Vec3::ZERO);
        let any = switches.stop == Stop::FirstHit;

        let mut at = [0, 1, 2].map(|axis| place(axis, 0.0).clamp(0, side - 1));
        let mut t = 0.0_f32;
        let mut nearest = f32::INFINITY;
        let mut parents = [0_u32; MAX_DEPTH as usize + 1];
        let mut level = 0;
        let mut visit = |cell: Cell| {
            if cell.list.1 != 0
                && let Some(hit) = self.triangles.crossing(switches, cell.list, path, any)
            {
                nearest = nearest.min(hit);
            }
            nearest
        };
        if !switches.leaf_lists && visit(self.cells[0]) <= 1.0 && any {
            return true;
        }
        loop {
            // The leaf that holds `at`.
            let leaf = match switches.lookup {
                Lookup::Array => {
                    let (cell, found) = self.tables.in_array(at.map(|a| a as u32));
                    level = found;
                    self.cells[cell as usize]
                }
                Lookup::Hash => {
                    let (cell, found) =
                        self.tables.in_hash(&self.cells, at.map(|a| a as u32), level);
                    level = found;
                    self.cells[cell as usize]
                }
                Lookup::Ancestor | Lookup::Root => {
                    if switches.lookup == Lookup::Root {
                        level = 0;
                    }
                    let mut cell = self.cells[parents[level as usize] as usize];
                    while cell.children != 0 {
                        let shift = depth - 1 - level;
                        let bit = |axis: usize| (at[axis] >> shift & 1) as u32;
                        let child = cell.children + (bit(0) | bit(1) << 1 | bit(2) << 2);
                        level += 1;
                        parents[level as usize] = child;
                        cell = self.cells[child as usize];
                        // A leaf's list is visited below.
                        if !switches.leaf_lists && cell.children != 0 && visit(cell) <= 1.0 && any {
                            return true;
                        }
                    }
                    cell
                }
            };
            let hit = visit(leaf);
            if any && hit <= 1.0 {
                return true;
            }

            // Where the segment leaves it.
            let span = 1_i32 << (depth - level);
            let low = at.map(|a| a & !(span - 1));
            let exit = |axis: usize| {
                let face = low[axis] + if forward.test(axis) { span } else { 0 };
                (face as f32 * size - HALF - path.origin[axis]) * path.inverse[axis]
            };
            let exits = [exit(0), exit(1), exit(2)];
            t = t.max(exits[0].min(exits[1]).min(exits[2]));
            if (switches.end && t >= 1.0) || (switches.stop == Stop::Nearest && t >= hit) {
                return hit <= 1.0;
            }

            // Into the next, over every face that is reached by then.
            let old = at;
            at = [0, 1, 2].map(|axis| {
                if exits[axis] > t {
                    place(axis, t).clamp(low[axis], low[axis] + span - 1)
                } else if forward.test(axis) {
                    low[axis] + span
                } else {
                    low[axis] - 1
                }
            });
            // A place below 0 has the highest bit, one beyond the side has that of the side.
            if (at[0] | at[1] | at[2]) as u32 >= side as u32 {
                return hit <= 1.0;
            }
            if switches.lookup == Lookup::Ancestor {
                let differ = (old[0] ^ at[0]) | (old[1] ^ at[1]) | (old[2] ^ at[2]);
                level = depth - (i32::BITS - differ.leading_zeros());
            }
        }
    }
}

impl<const V: usize> Occluder for Specimen<V> {
    fn occluded(&self, segment: &Segment) -> bool {
        self.clipped(segment).is_some_and(|path| self.walk(&path))
    }
}
