//! What a point sees of a polygon behind others: shadows cut away exactly.

use glam::DVec3;

use crate::clip::cut;
use crate::corners::Corners;
use crate::mean::seen;
use crate::pair::Part;

/// A convex polygon that stands in between.
#[derive(Clone)]
pub(crate) struct Blocker {
    pub(crate) corners: Corners,
    pub(crate) normal: DVec3,
}

/// Form factors from a point to all of a polygon and to what is not in shadow.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sight {
    pub(crate) all: f64,
    pub(crate) visible: f64,
    /// How the shadows' edges cut the polygon: where it changes, `visible` has a kink.
    pub(crate) pattern: u64,
}

/// What the point sees of `target` behind `blockers`, which lie between the planes of the two.
/// `touches` is the length that counts as none.
pub(crate) fn sight(
    point: DVec3,
    normal: DVec3,
    target: &Part,
    blockers: &[&Blocker],
    touches: f64,
) -> Sight {
    let all = seen(point, normal, &target.corners).0.max(0.0);
    let mut lit = vec![target.corners.clone()];
    let mut next = Vec::new();
    let mut pattern = 1u64;
    for blocker in blockers {
        let planes = cone(point, blocker, touches);
        if planes.is_empty() {
            continue;
        }
        for fragment in lit.drain(..) {
            let outcome = subtract(fragment, &planes, touches, &mut next);
            pattern = pattern.wrapping_mul(MIX).wrapping_add(outcome);
        }
        std::mem::swap(&mut lit, &mut next);
        if lit.is_empty() {
            return Sight { all, visible: 0.0, pattern };
        }
    }
    let visible: f64 = lit.iter().map(|fragment| seen(point, normal, fragment).0).sum();
    Sight { all, visible: visible.clamp(0.0, all), pattern }
}

/// An odd number that mixes outcomes in their order (Knuth's multiplier of MMIX).
const MIX: u64 = 6_364_136_223_846_793_005;

/// A place on a plane and the plane's outward normal.
pub(crate) type Plane = (DVec3, DVec3);

/// The sides of the cone from a point over a blocker; none if the point is in its plane.
fn cone(point: DVec3, blocker: &Blocker, touches: f64) -> Vec<Plane> {
    let corners = &blocker.corners;
    let side = blocker.normal.dot(point - corners[0]);
    if side.abs() <= touches {
        return Vec::new();
    }
    let plane = |i: usize| {
        let (from, to) = (corners[i] - point, corners[(i + 1) % corners.len()] - point);
        (point, from.cross(to).normalize_or_zero() * side.signum())
    };
    (0..corners.len()).map(plane).filter(|plane| plane.1 != DVec3::ZERO).collect()
}

/// Adds to `out` what of a convex polygon lies outside of all the planes' common inside. Returns a
/// number for how they cut it: 0 if not at all, and otherwise a bit for each plane.
pub(crate) fn subtract(
    fragment: Corners,
    planes: &[Plane],
    touches: f64,
    out: &mut Vec<Corners>,
) -> u64 {
    let misses = planes
        .iter()
        .any(|&(on, normal)| fragment.iter().all(|&corner| normal.dot(corner - on) >= -touches));
    if misses {
        out.push(fragment);
        return 0;
    }
    let mut rest = fragment;
    let mut outcome = 1;
    for &(on, normal) in planes {
        let outside = cut(&rest, normal, on, touches);
        outcome = outcome << 1 | u64::from(outside.is_some());
        out.extend(outside);
        match cut(&rest, -normal, on, touches) {
            Some(inside) => rest = inside,
            None => return outcome,
        }
    }
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Polygon;

    fn square(low: f64, high: f64, z: f64) -> Corners {
        [[low, low, z], [low, high, z], [high, high, z], [high, low, z]]
            .into_iter()
            .map(DVec3::from)
            .collect()
    }

    fn blocker(corners: Corners) -> Blocker {
        let normal = Polygon::new(&corners).expect("a square").normal();
        Blocker { corners, normal }
    }

    #[test]
    fn a_shadow_is_what_the_blocker_hides() {
        let target = Part::of(square(-2.0, 2.0, 2.0), DVec3::NEG_Z);
        let point = DVec3::new(0.1, -0.2, 0.0);
        let near = blocker(square(-0.5, 0.5, 1.0));
        // The same blocker as two triangles, and turned over.
        let c = near.corners.to_vec();
        let halves =
            [[c[0], c[1], c[2]], [c[0], c[3], c[2]]].map(|t| blocker(t.into_iter().collect()));
        // All of the blocker is seen, so what it hides is its own form factor.
        let hidden = seen(point, DVec3::Z, &near.corners).0;
        let whole = sight(point, DVec3::Z, &target, &[&near], 1e-14);
        assert!((whole.all - whole.visible - hidden).abs() < 1e-15);
        let two = sight(point, DVec3::Z, &target, &[&halves[0], &halves[1], &near], 1e-14);
        assert!((two.visible - whole.visible).abs() < 1e-14);
        let screen = blocker(square(-5.0, 5.0, 1.5));
        assert_eq!(sight(point, DVec3::Z, &target, &[&near, &screen], 1e-14).visible, 0.0);
        let aside = blocker(square(3.0, 4.0, 1.0));
        let clear = sight(point, DVec3::Z, &target, &[&aside], 1e-14);
        assert_eq!(clear.visible, clear.all);
    }
}
