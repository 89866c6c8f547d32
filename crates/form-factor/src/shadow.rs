//! What a point sees of a polygon behind others: shadows cut away exactly.
//!
//! All is done in the target's plane, where shadows are convex and their edges lines, in lists
//! that are used again from point to point.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::corners::Corners;
use crate::pair::Part;

/// A convex polygon that stands in between.
#[derive(Clone)]
pub(crate) struct Blocker {
    pub(crate) corners: Corners,
    pub(crate) normal: DVec3,
    pub(crate) area: f64,
    /// The corners and the normal as [`Target`] places them.
    placed: Corners,
    turned: DVec3,
}

impl Blocker {
    pub(crate) fn new(corners: Corners, normal: DVec3, area: f64, target: &Target) -> Self {
        let placed = corners.iter().map(|&corner| target.place(corner)).collect();
        Self { placed, turned: target.turn(normal), corners, normal, area }
    }
}

/// The polygon that is looked at, in a frame in which its plane is z = 0 and its front z > 0.
pub(crate) struct Target {
    corners: Vec<DVec2>,
    axes: [DVec3; 3],
    height: f64,
}

impl Target {
    pub(crate) fn new(part: &Part) -> Self {
        let up = part.normal;
        let across = up.any_orthonormal_vector();
        let axes = [across, up.cross(across), up];
        let mut target = Self { corners: Vec::new(), axes, height: up.dot(part.corners[0]) };
        target.corners = part.corners.iter().map(|&c| target.place(c).truncate()).collect();
        target
    }

    fn turn(&self, direction: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(direction)))
    }

    fn place(&self, at: DVec3) -> DVec3 {
        self.turn(at) - DVec3::Z * self.height
    }
}

/// Form factors from a point to all of a polygon and to what is not in shadow.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sight {
    pub(crate) all: f64,
    pub(crate) visible: f64,
    /// How the shadows' edges cut the polygon: where it changes, `visible` has a kink.
    pub(crate) pattern: u64,
}

/// An odd number that mixes outcomes in their order (Knuth's multiplier of MMIX).
const MIX: u64 = 6_364_136_223_846_793_005;

/// A corner's depth below the point, in the point's height, up to which its shadow counts as
/// endless: rounding would move it by as much as the target's size.
const STEEP: f64 = 1e-6;

/// Shadows on a target, and room to cut them.
pub(crate) struct Shadows<'a> {
    target: &'a Target,
    /// The length that counts as none.
    touches: f64,
    lines: Vec<Line>,
    lit: Fragments,
    rest: Vec<DVec2>,
    inside: Vec<DVec2>,
    outside: Vec<DVec2>,
}

/// The height of (u, v) over it is (u, v, 1) · `Line`, in lengths.
type Line = DVec3;

impl<'a> Shadows<'a> {
    pub(crate) fn new(target: &'a Target, touches: f64) -> Self {
        Self {
            target,
            touches,
            lines: Vec::new(),
            lit: Fragments::default(),
            rest: Vec::new(),
            inside: Vec::new(),
            outside: Vec::new(),
        }
    }

    /// What the point sees of the target behind `blockers`, which lie between the planes of the
    /// two. Marks in `touched` those that take some light.
    pub(crate) fn sight<'b>(
        &mut self,
        point: DVec3,
        normal: DVec3,
        blockers: impl Iterator<Item = &'b Blocker>,
        touched: &mut [bool],
    ) -> Sight {
        let (point, normal) = (self.target.place(point), self.target.turn(normal));
        let all = seen(point, normal, &self.target.corners).max(0.0);
        self.lit.clear();
        self.lit.push(&self.target.corners);
        let mut pattern = 1u64;
        for ((number, blocker), touched) in blockers.enumerate().zip(touched) {
            let shadow = self.shadow_box(point, blocker);
            let meets = |fragment: &Fragment| !fragment.bounds.misses(&shadow, self.touches);
            if !self.lit.list.iter().any(meets) || !self.cone(point, blocker) {
                continue;
            }
            let before = self.lit.list.len();
            for at in 0..before {
                let (outcome, hides) = self.subtract(at, &shadow);
                *touched |= hides;
                if outcome > 0 {
                    let place = (number as u64) << 32 | (at as u64) << 16;
                    pattern = pattern.wrapping_mul(MIX).wrapping_add(place ^ outcome);
                }
            }
            self.lit.list.retain(|fragment| fragment.end > fragment.first);
            if self.lit.list.is_empty() {
                return Sight { all, visible: 0.0, pattern };
            }
        }
        let visible: f64 =
            self.lit.list.iter().map(|f| seen(point, normal, self.lit.points(f))).sum();
        Sight { all, visible: visible.clamp(0.0, all), pattern }
    }

    /// The box around a blocker's shadow on the target's plane; all of the plane where the shadow
    /// has no end.
    fn shadow_box(&self, point: DVec3, blocker: &Blocker) -> Box2 {
        let mut bounds = Box2::NONE;
        for &corner in blocker.placed.iter() {
            let down = point.z - corner.z;
            if down <= STEEP * point.z {
                return Box2::ALL;
            }
            let at = point.truncate() + (corner - point).truncate() * (point.z / down);
            bounds = bounds.with(at);
        }
        bounds
    }

    /// Sets the lines in which the sides of the cone from a point over a blocker meet the target's
    /// plane; none if the point is in the blocker's plane.
    fn cone(&mut self, point: DVec3, blocker: &Blocker) -> bool {
        self.lines.clear();
        let corners = &blocker.placed;
        let side = blocker.turned.dot(point - corners[0]);
        if side.abs() <= self.touches {
            return false;
        }
        let sign = 1f64.copysign(side);
        let mut from = corners[corners.len() - 1] - point;
        for &corner in corners.iter() {
            let to = corner - point;
            let cross = from.cross(to);
            let length = cross.length();
            if length > 0.0 {
                let out = cross * (sign / length);
                self.lines.push(DVec3::new(out.x, out.y, -out.dot(point)));
            }
            from = to;
        }
        !self.lines.is_empty()
    }

    /// Whether a polygon lies outside of one of the lines.
    fn misses(&self, corners: &[DVec2]) -> bool {
        let above = |line: &Line| corners.iter().all(|&c| height(line, c) >= -self.touches);
        self.lines.iter().any(above)
    }

    /// Puts what of a lit fragment lies outside of all the lines' common inside in its place.
    /// Returns a number for how they cut it, 0 if not at all and otherwise a bit for each line, and
    /// whether anything lies inside.
    fn subtract(&mut self, at: usize, shadow: &Box2) -> (u64, bool) {
        let fragment = self.lit.list[at];
        if fragment.bounds.misses(shadow, self.touches)
            || self.lines.iter().any(|line| fragment.bounds.lowest(line) >= -self.touches)
            || self.misses(self.lit.points(&fragment))
        {
            return (0, false);
        }
        self.lit.list[at].end = fragment.first;
        self.rest.clear();
        self.rest.extend_from_slice(self.lit.points(&fragment));
        let mut outcome = 1;
        for line in &self.lines {
            let sides = divide(&self.rest, line, self.touches, &mut self.inside, &mut self.outside);
            outcome = outcome << 1 | u64::from(sides.outside);
            if sides.outside {
                self.lit.push(&self.outside);
            }
            if !sides.inside {
                return (outcome, false);
            }
            std::mem::swap(&mut self.rest, &mut self.inside);
        }
        (outcome, true)
    }
}

/// Convex polygons one after the other.
#[derive(Default)]
struct Fragments {
    points: Vec<DVec2>,
    list: Vec<Fragment>,
}

/// Which points are its corners, and the box around them.
#[derive(Clone, Copy)]
struct Fragment {
    first: usize,
    end: usize,
    bounds: Box2,
}

/// A box in the target's plane.
#[derive(Clone, Copy)]
struct Box2 {
    low: DVec2,
    high: DVec2,
}

impl Box2 {
    const NONE: Self = Self { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY };
    const ALL: Self = Self { low: DVec2::NEG_INFINITY, high: DVec2::INFINITY };

    fn with(self, at: DVec2) -> Self {
        Self { low: self.low.min(at), high: self.high.max(at) }
    }

    /// Whether the two overlap by no more than `touches`.
    fn misses(&self, other: &Self, touches: f64) -> bool {
        let touches = DVec2::splat(touches);
        self.low.cmpge(other.high - touches).any() || other.low.cmpge(self.high - touches).any()
    }

    /// A bound of the heights in it from below.
    fn lowest(&self, line: &Line) -> f64 {
        height(line, DVec2::select(line.truncate().cmplt(DVec2::ZERO), self.high, self.low))
    }
}

impl Fragments {
    fn clear(&mut self) {
        self.points.clear();
        self.list.clear();
    }

    fn points(&self, fragment: &Fragment) -> &[DVec2] {
        &self.points[fragment.first..fragment.end]
    }

    fn push(&mut self, corners: &[DVec2]) {
        let bounds = corners.iter().fold(Box2::NONE, |bounds, &corner| bounds.with(corner));
        let first = self.points.len();
        self.points.extend_from_slice(corners);
        self.list.push(Fragment { first, end: self.points.len(), bounds });
    }
}

fn height(line: &Line, at: DVec2) -> f64 {
    line.x * at.x + line.y * at.y + line.z
}

/// Whether anything lies below a line, and whether above.
struct Sides {
    inside: bool,
    outside: bool,
}

/// Divides a convex polygon at a line. Corners within `touches` count as on it.
fn divide(
    corners: &[DVec2],
    line: &Line,
    touches: f64,
    inside: &mut Vec<DVec2>,
    outside: &mut Vec<DVec2>,
) -> Sides {
    inside.clear();
    outside.clear();
    let snapped = |corner: DVec2| {
        let h = height(line, corner);
        if h.abs() <= touches { 0.0 } else { h }
    };
    let mut before = corners[corners.len() - 1];
    let mut before_height = snapped(before);
    let (mut above, mut below) = (false, false);
    for &corner in corners {
        let h = snapped(corner);
        above |= h > 0.0;
        below |= h < 0.0;
        if h * before_height < 0.0 {
            let crossing = before + (corner - before) * (before_height / (before_height - h));
            inside.push(crossing);
            outside.push(crossing);
        }
        if h <= 0.0 {
            inside.push(corner);
        }
        if h >= 0.0 {
            outside.push(corner);
        }
        (before, before_height) = (corner, h);
    }
    Sides { inside: below && inside.len() >= 3, outside: above && outside.len() >= 3 }
}

/// Lambert's form factor from a point to a polygon in the plane z = 0.
fn seen(point: DVec3, normal: DVec3, corners: &[DVec2]) -> f64 {
    let mut sum = 0.0;
    let mut before = corners[corners.len() - 1].extend(0.0) - point;
    for &corner in corners {
        let after = corner.extend(0.0) - point;
        let cross = before.cross(after);
        let sine = cross.length();
        if sine > 0.0 {
            sum += sine.atan2(before.dot(after)) * normal.dot(cross) / sine;
        }
        before = after;
    }
    // Corners run counter-clockwise seen from the front.
    -sum / TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Polygon;
    use crate::mean;

    fn square(low: f64, high: f64, z: f64) -> Corners {
        [[low, low, z], [low, high, z], [high, high, z], [high, low, z]]
            .into_iter()
            .map(DVec3::from)
            .collect()
    }

    #[test]
    fn a_shadow_is_what_the_blocker_hides() {
        let part = Part::of(square(-2.0, 2.0, 2.0), DVec3::NEG_Z);
        let target = Target::new(&part);
        let blocker = |corners: Corners| {
            let polygon = Polygon::new(&corners).expect("convex");
            Blocker::new(corners, polygon.normal(), polygon.area(), &target)
        };
        let mut shadows = Shadows::new(&target, 1e-14);
        let point = DVec3::new(0.1, -0.2, 0.0);
        let mut sight = |blockers: &[&Blocker]| {
            let mut touched = vec![false; blockers.len()];
            let sight = shadows.sight(point, DVec3::Z, blockers.iter().copied(), &mut touched);
            (sight, touched)
        };
        let near = blocker(square(-0.5, 0.5, 1.0));
        // The same blocker as two triangles, and turned over.
        let c = near.corners.to_vec();
        let halves =
            [[c[0], c[1], c[2]], [c[0], c[3], c[2]]].map(|t| blocker(t.into_iter().collect()));
        // All of the blocker is seen, so what it hides is its own form factor.
        let hidden = mean::seen(point, DVec3::Z, &near.corners).0;
        let (whole, touched) = sight(&[&near]);
        assert!((whole.all - mean::seen(point, DVec3::Z, &part.corners).0).abs() < 1e-15);
        assert!((whole.all - whole.visible - hidden).abs() < 1e-15 && touched[0]);
        let (two, _) = sight(&[&halves[0], &halves[1], &near]);
        assert!((two.visible - whole.visible).abs() < 1e-14);
        let screen = blocker(square(-5.0, 5.0, 1.5));
        assert_eq!(sight(&[&near, &screen]).0.visible, 0.0);
        let aside = blocker(square(3.0, 4.0, 1.0));
        let (clear, touched) = sight(&[&aside]);
        assert!(clear.visible == clear.all && !touched[0]);
    }
}
