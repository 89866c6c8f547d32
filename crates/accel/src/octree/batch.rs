//! Segments that share an origin, answered in packets, with the last blocker retried first.

use glam::{DVec3, Vec3A};

use super::Octree;
use super::packet::PACKET;
use crate::Target;
use crate::batch::with_last_blocker;
use crate::local::LocalSegment;

/// Answers a batch. What is left of an earlier segment saves work and changes no answer, since a
/// block tells only of what truly crosses.
pub(super) fn answer(
    octree: &Octree,
    (from, ignore): (DVec3, u32),
    targets: &[Target],
    blocked: &mut [bool],
) {
    assert_eq!(targets.len(), blocked.len(), "one answer per target");
    let frame = &octree.frame;
    let retry = |segment: &LocalSegment, last: u32| octree.crosses(last, segment);
    let origin = frame.local(from);
    if !frame.holds(origin) {
        // Each segment enters the scene at a place of its own.
        let search = |segment: &LocalSegment| octree.blocking(segment);
        with_last_blocker(frame, (from, ignore), targets, blocked, retry, search);
        return;
    }
    // Neighbouring targets tend to hide behind the same triangles.
    let mut last = None;
    let spread = octree.spread();
    let mut places = [0; PACKET];
    let mut segments = Vec::with_capacity(PACKET);
    let mut order = Vec::with_capacity(CHUNK.min(targets.len()));
    for (targets, blocked) in targets.chunks(CHUNK).zip(blocked.chunks_mut(CHUNK)) {
        sort(from, targets, &mut order);
        for (turn, &place) in order.iter().enumerate() {
            let i = (place & PLACE) as usize;
            let to = frame.local(targets[i].point);
            let segment = LocalSegment::from_local(frame, origin, to, [ignore, targets[i].ignore]);
            blocked[i] = segment.is_some_and(|s| last.is_some_and(|last| retry(&s, last)));
            if let (Some(segment), false) = (segment, blocked[i]) {
                places[segments.len()] = i;
                segments.push(segment);
            }
            if segments.len() == PACKET || turn + 1 == order.len() {
                octree.blocking_packet(&segments, spread, |lane, block| {
                    blocked[places[lane]] = true;
                    last = Some(block);
                });
                segments.clear();
            }
        }
    }
}

/// Targets that are sorted by direction together.
const CHUNK: usize = 1024;

/// The bits of a place in a chunk; a key is above them.
const PLACE: u32 = CHUNK as u32 - 1;

/// Puts the places of targets in an order in which those in like directions are together.
fn sort(from: DVec3, targets: &[Target], order: &mut Vec<u32>) {
    order.clear();
    order.extend(targets.iter().enumerate().map(|(i, target)| {
        place_on_cube((target.point - from).as_vec3a()) << CHUNK.ilog2() | i as u32
    }));
    order.sort_unstable();
}

/// The cell in which a direction meets a cube around the origin, in Morton order (Morton 1966).
fn place_on_cube(direction: Vec3A) -> u32 {
    // Half the cube's side in cells; a NaN is cast to 0.
    const HALF: f32 = 8.0;
    let scale = 0.999 * HALF / direction.abs().max_element();
    let place = direction * scale + HALF;
    spread(place.x as u32) | spread(place.y as u32) << 1 | spread(place.z as u32) << 2
}

/// Puts two zeros before each of four bits.
fn spread(bits: u32) -> u32 {
    let bits = (bits | bits << 4) & 0x0c3;
    (bits | bits << 2) & 0x249
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BruteForce, BruteForceConfig, Occluder, OctreeConfig, Segment};

    /// Packets, sorting and retries change no answer: brute force, asked one by one, tells it.
    #[test]
    fn batches_give_the_answers_of_single_segments() {
        // Weyl's sequence: coordinates in [-1, 1] that repeat from run to run.
        let mut k = 0_u32;
        let mut next = || {
            k = k.wrapping_add(0x9e37_79b9);
            f64::from(k >> 8) / f64::from(1 << 23) - 1.0
        };
        let mut point = || DVec3::new(next(), next(), next());
        let triangles: Vec<[DVec3; 3]> = (0..600)
            .map(|_| {
                let at = point();
                [(); 3].map(|()| at + 0.15 * point())
            })
            .collect();
        let brute = BruteForce::build(&triangles, &BruteForceConfig::default());
        // Small leaves make a deep tree.
        for config in
            [OctreeConfig::DEFAULT, OctreeConfig { leaf_size: 4, ..OctreeConfig::DEFAULT }]
        {
            let octree = Octree::build(&triangles, &config);
            let mut seen = [0; 2];
            // Within the scene, and outside, where each segment enters at a place of its own.
            for (from, spread) in [
                (point(), 1.0),
                (point(), 0.05),
                (DVec3::new(3.0, 0.1, 0.2), 1.0),
                (DVec3::ZERO, 5.0),
            ] {
                let middle = point();
                // More than a chunk and not a multiple of a packet, in no order.
                let mut targets: Vec<Target> = (0..2 * CHUNK + 5)
                    .map(|i| Target { point: middle + spread * point(), ignore: i as u32 % 600 })
                    .collect();
                targets[7].point = from;
                targets[8].point = DVec3::NAN;
                targets[9].point = from + DVec3::X; // along an axis
                let mut blocked = vec![true; targets.len()];
                octree.occluded_batch(from, 3, &targets, &mut blocked);
                for (target, blocked) in targets.iter().zip(blocked) {
                    let segment = Segment { from, to: target.point, ignore: [3, target.ignore] };
                    assert_eq!(blocked, brute.occluded(&segment), "{segment:?}");
                    assert_eq!(blocked, octree.occluded(&segment), "{segment:?}");
                    seen[usize::from(blocked)] += 1;
                }
            }
            assert!(seen.iter().all(|&count| count > 500), "{seen:?}");
        }
    }
}
