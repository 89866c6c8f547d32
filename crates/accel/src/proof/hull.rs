//! Triangles with everything on one side of them: they end the view and hide nothing.

use glam::DVec3;

use super::{IN_PLANE, Plane, extent};

/// Heights computed at most: a scene of very many triangles round one convex space is looked at in
/// part only, and the rest may block.
const MOST_HEIGHTS: usize = 20_000_000;

/// Normals this much beyond a right angle count as at a right angle: rounding of tilted scenes.
const RIGHT_ANGLE: f64 = 1e-9;

/// A surface this many lifts off a plane is not brought to its other side by a lift.
const FAR: f64 = 4.0;

/// Which triangles can never block a segment between two lit places.
///
/// Lit places lie on the triangles, `lift` in front of them, or behind if `both` says that the back
/// is lit too. A triangle that has all others on one side of its plane (to 1e-9 of the extent) is
/// crossed by no segment between such places, unless a surface meets its plane at an acute angle:
/// there a lift may reach through. Those triangles, and all that were not looked at, count as
/// blocking; so the answer is exact. Triangles without area never block.
///
/// Time: for each triangle, until one is found on either side; in a convex scene, triangles times
/// planes.
#[must_use]
pub fn never_block(triangles: &[[DVec3; 3]], both: impl Fn(usize) -> bool, lift: f64) -> Vec<bool> {
    let planes: Vec<Option<Plane>> = triangles
        .iter()
        .map(|t| if t.iter().all(|p| p.is_finite()) { Plane::of(*t) } else { None })
        .collect();
    let slack = IN_PLANE * extent(triangles);
    let mut look = Look { triangles, planes: &planes, both, lift, slack, left: MOST_HEIGHTS };
    // What was found of one triangle holds for all in its plane.
    let mut known: Vec<(Plane, bool)> = Vec::new();
    let mut never = vec![true; triangles.len()];
    for (i, plane) in planes.iter().enumerate() {
        let Some(plane) = plane else { continue };
        let same = known
            .iter()
            .find(|(other, _)| triangles[i].iter().all(|p| other.height(*p).abs() <= 0.1 * slack));
        never[i] = match same {
            Some((_, answer)) => *answer,
            None => match look.at(i, plane) {
                Found::Through => false,
                found => {
                    known.push((*plane, found == Found::Beside));
                    found == Found::Beside
                }
            },
        };
    }
    never
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Found {
    /// Something lies on either side, or there was no time to look.
    Through,
    /// All lies on one side, but some of it leans over the edge.
    Leaning,
    /// All lies on one side.
    Beside,
}

struct Look<'a, F> {
    triangles: &'a [[DVec3; 3]],
    planes: &'a [Option<Plane>],
    both: F,
    lift: f64,
    slack: f64,
    left: usize,
}

impl<F: Fn(usize) -> bool> Look<'_, F> {
    fn at(&mut self, own: usize, plane: &Plane) -> Found {
        let n = self.triangles.len();
        let (mut front, mut back) = (false, false);
        // Far apart in the file, far apart in the scene: what is on the other side is soon found.
        let stride = stride(n);
        let mut at = own;
        for _ in 0..n {
            at = (at + stride) % n;
            if self.left == 0 {
                return Found::Through;
            }
            self.left -= 1;
            if self.planes[at].is_none() {
                continue;
            }
            for corner in self.triangles[at] {
                let height = plane.height(corner);
                front |= height > self.slack;
                back |= height < -self.slack;
            }
            if front && back {
                return Found::Through;
            }
        }
        let side = if back { -1.0 } else { 1.0 };
        let leans = (0..n).any(|i| self.leans(i, plane, side));
        if leans { Found::Leaning } else { Found::Beside }
    }

    /// Whether a lift off a triangle that meets the plane leads to the plane's empty side.
    fn leans(&self, i: usize, plane: &Plane, side: f64) -> bool {
        let Some(other) = &self.planes[i] else { return false };
        let upright = side * plane.normal.dot(other.normal);
        if upright >= -RIGHT_ANGLE && !((self.both)(i) && upright > RIGHT_ANGLE) {
            return false;
        }
        let heights = self.triangles[i].map(|p| side * plane.height(p));
        let [least, most] = [
            heights[0].min(heights[1]).min(heights[2]),
            heights[0].max(heights[1]).max(heights[2]),
        ];
        // What lies in the plane itself and faces away from all else sees nothing.
        least < FAR * self.lift && most > self.slack
    }
}

/// A step through `n` items that meets each once, about a golden section long.
fn stride(n: usize) -> usize {
    let coprime = |step: &usize| {
        let (mut a, mut b) = (n, *step);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let golden = (n as f64 * 0.618) as usize;
    (golden.max(1)..).find(coprime).unwrap_or(1)
}
