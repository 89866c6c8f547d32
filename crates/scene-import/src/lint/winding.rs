//! Triangles that run against their neighbours.
//!
//! Two neighbours of one surface walk their common edge in opposite directions. Where they
//! do not, one of the two is reversed; in a surface that is closed, or nearly, the smaller
//! party is the suspect. Whether a whole closed surface is inside out cannot be told: a
//! room's walls face inwards, a box faces outwards, and both are right.

use scene::{Scene, TriangleId};

/// Smallest share of a surface's edge sides that must have a neighbour before a minority
/// is called wrong: a room without its ceiling has 0.87, a lone square 0.33.
const MOSTLY_CLOSED: f64 = 0.75;

/// A side of a triangle, ordered so that the sides along one edge come together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    low: u32,
    high: u32,
    /// Index into the triangles, times 3, plus the number of the side.
    slot: u64,
    /// From the low vertex to the high one.
    ascending: bool,
}

/// What lies beyond a side.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Beyond {
    /// Nothing: the border of the surface.
    Border,
    /// More than one triangle, so that nothing follows for their winding.
    Junction,
    /// One triangle, wound alike or reversed.
    Neighbour { index: usize, reversed: bool },
}

/// Those of `triangles` that are in the minority of their surface, in the order given.
pub(super) fn reversed(scene: &Scene, triangles: &[TriangleId]) -> Vec<TriangleId> {
    let beyond = neighbours(scene, triangles);
    // Whether each triangle runs against the first of its surface.
    let mut against: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut suspects = Vec::new();
    let mut surface = Vec::new();
    for first in 0..triangles.len() {
        if against[first].is_some() {
            continue;
        }
        surface.clear();
        surface.push(first);
        against[first] = Some(false);
        let (mut borders, mut orientable, mut next) = (0_usize, true, 0);
        while let Some(&index) = surface.get(next) {
            next += 1;
            for side in beyond[index] {
                match side {
                    Beyond::Border => borders += 1,
                    Beyond::Junction => {}
                    Beyond::Neighbour { index: other, reversed } => {
                        let expected = against[index].map(|a| a ^ reversed);
                        if against[other].is_none() {
                            against[other] = expected;
                            surface.push(other);
                        }
                        orientable &= against[other] == expected;
                    }
                }
            }
        }
        let closed = 1.0 - borders as f64 / (3 * surface.len()) as f64;
        let minority = surface.iter().filter(|&&i| against[i] == Some(true)).count();
        let majority = surface.len() - minority;
        // On a tie nobody can tell which party is right.
        if orientable && closed >= MOSTLY_CLOSED && minority != majority {
            let wrong = Some(minority < majority);
            suspects.extend(surface.iter().copied().filter(|&i| against[i] == wrong));
        }
    }
    suspects.sort_unstable();
    suspects.into_iter().map(|i| triangles[i]).collect()
}

/// What lies beyond each side of each triangle.
fn neighbours(scene: &Scene, triangles: &[TriangleId]) -> Vec<[Beyond; 3]> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (index, id) in triangles.iter().enumerate() {
        let v = scene.triangles()[id.index()].vertices.map(|v| v.0);
        for side in 0..3 {
            let (from, to) = (v[side], v[(side + 1) % 3]);
            sides.push(Side {
                low: from.min(to),
                high: from.max(to),
                slot: (3 * index + side) as u64,
                ascending: from < to,
            });
        }
    }
    sides.sort_unstable();
    let mut beyond = vec![[Beyond::Border; 3]; triangles.len()];
    for edge in sides.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high)) {
        let mut set = |side: &Side, what| {
            beyond[(side.slot / 3) as usize][(side.slot % 3) as usize] = what;
        };
        match edge {
            [_] => {}
            [a, b] => {
                let reversed = a.ascending == b.ascending;
                set(a, Beyond::Neighbour { index: (b.slot / 3) as usize, reversed });
                set(b, Beyond::Neighbour { index: (a.slot / 3) as usize, reversed });
            }
            many => many.iter().for_each(|side| set(side, Beyond::Junction)),
        }
    }
    beyond
}
