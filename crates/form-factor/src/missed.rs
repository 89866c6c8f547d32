//! Small things near a piece, whose shadow falls between the probes.

use std::f64::consts::PI;

use glam::DVec3;

use crate::clip::{area_vector, cut};
use crate::corners::Corners;
use crate::gauss::Node;
use crate::mean;
use crate::pair::Part;
use crate::shadow::Blocker;
use crate::shaft::Shaft;

/// What is hidden counts so many times against what a blocker by itself should hide: one point in
/// its middle says no more than that.
const RESOLVED: f64 = 1.5;

/// Size, in the piece's, up to which the part of a blocker counts as small: one point stands for
/// it, and larger ones are not missed.
const SMALL: f64 = 0.25;

/// What blockers hide that probes do not see, as an exchange area.
///
/// Seen from its own middle a blocker hides more than all blockers do seen from the probes, and
/// the probes are too few to see its middle as the middle sees them. `hidden` is what is hidden
/// by the rule's nodes.
pub(crate) fn missed(
    piece: &[DVec3; 3],
    normal: DVec3,
    rule: &[Node],
    target: &Part,
    blockers: &[&Blocker],
    shaft: &Shaft,
    hidden: f64,
) -> f64 {
    let size = area_vector(piece).dot(normal);
    let missed = |blocker: &&Blocker| {
        let part = shaft.part(&blocker.corners)?;
        let area = area_vector(&part).length();
        if area <= RESOLVED * hidden || area > SMALL * size {
            return None;
        }
        let middle = part.iter().sum::<DVec3>() / part.len() as f64;
        let outward = sides(middle, target);
        // Of the piece only what lies on lines through there to the target.
        let mut behind: Corners = piece.iter().copied().collect();
        for &out in outward.iter() {
            behind = cut(&behind, out, middle, 0.0)?;
        }
        let exact = mean::seen(middle, blocker.normal, &behind).0.abs();
        if area * exact <= RESOLVED * hidden {
            return None;
        }
        let kernel = |&(weight, w): &Node| {
            let to = middle - (piece[0] * w[0] + piece[1] * w[1] + piece[2] * w[2]);
            let r2 = to.length_squared();
            let sees = outward.iter().all(|out| out.dot(to) < 0.0);
            let cosines = normal.dot(to) * blocker.normal.dot(to).abs();
            if sees { weight * size * cosines / (PI * r2 * r2) } else { 0.0 }
        };
        let probed: f64 = rule.iter().map(kernel).sum();
        Some(area * (exact - RESOLVED * probed))
    };
    blockers.iter().filter_map(missed).fold(0.0, f64::max)
}

/// The outward normals of the cone from a point over the target.
fn sides(point: DVec3, target: &Part) -> Corners {
    let n = target.corners.len();
    let edge = |i: usize| [i, (i + 1) % n].map(|i| target.corners[i] - point);
    (0..n).map(edge).map(|[p, q]| p.cross(q).normalize_or_zero()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gauss::TRIANGLE;
    use crate::shadow::Target;

    #[test]
    fn a_speck_is_missed_near_the_piece_and_not_far_from_it() {
        let far = [[-1.0, -1.0], [-1.0, 3.0], [3.0, 3.0], [3.0, -1.0]];
        let corners = far.iter().map(|&[x, y]| DVec3::new(x, y, 2.0)).collect();
        let target = Part::of(corners, DVec3::NEG_Z);
        let placed = Target::new(&target);
        let piece = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let shaft = Shaft::new(&piece, &target.corners, 1e-14);
        let of_speck = |height: f64| {
            let at = DVec3::new(0.33, 0.33, height);
            let speck = [at, at + DVec3::X * 0.02, at + DVec3::Y * 0.02];
            let corners = speck.into_iter().collect();
            let blocker = Blocker::new(corners, DVec3::Z, 2e-4, &placed);
            missed(&piece, DVec3::Z, TRIANGLE[2], &target, &[&blocker], &shaft, 0.0)
        };
        // So near, all light from the speck's own area below goes through it.
        let near = of_speck(0.01);
        assert!(near > 0.5 * 2e-4 && near <= 2e-4, "{near}");
        assert_eq!(of_speck(1.0), 0.0);
    }
}
