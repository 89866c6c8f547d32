//! Spaces that are sealed off from each other: rooms without a door, what is inside of things.
//!
//! Each triangle has two sides. Round an edge, the sides of neighbouring triangles that look into the
//! same wedge bound one space; sides that hang together so make up a shell. A shell has no rim, so
//! how often it winds round a place is a whole number, the same for all places that some way
//! without a crossing joins (the solid angle under which it is seen, over 4π; van Oosterom & Strackee
//! 1983). Places for which it differs do not see each other, however crooked the shell.

use std::f64::consts::PI;

use glam::DVec3;

use super::Plane;
use super::weld::{Edge, Sets, Welded};

/// Solid angles computed at most while shells are looked for that part lit places.
const MOST_ANGLES: usize = 1_000_000;

/// Places that are looked up in a shell's bounds in the time of a solid angle.
const LOOKS: usize = 16;

/// Shells that are told from each other: two bits each.
const MOST_SHELLS: usize = 32;

/// A place within this share of a lift of a triangle is on it, and on neither side for occluders that work
/// in f32; lit places are a lift off their own.
const NEAR: f64 = 0.25;

/// A triangle that fills less of the view than this, in its own plane, is elsewhere.
const WIDE: f64 = 0.05;

/// Windings farther than this from a whole number are of places too near a triangle to tell.
const WHOLE: f64 = 0.1;

/// The shells that part lit places from each other.
#[derive(Clone, Debug, Default)]
pub struct Spaces {
    shells: Vec<Shell>,
}

/// A closed surface.
#[derive(Clone, Debug)]
struct Shell {
    /// Triangles with their planes, and 1, or −1 for those turned round.
    faces: Vec<([DVec3; 3], Plane, f64)>,
    low: DVec3,
    high: DVec3,
    /// Places nearer than this to a triangle are on it.
    near: f64,
}

impl Spaces {
    /// Finds the shells that part some lit places from others: those `lift` in front of the
    /// triangles, and behind where `both` says that the back is lit too.
    ///
    /// Time N·log N and, for scenes in which shells lie within shells, up to a million solid angles.
    #[must_use]
    pub fn of(triangles: &[[DVec3; 3]], both: impl Fn(usize) -> bool, lift: f64) -> Self {
        let planes: Vec<Option<Plane>> =
            triangles.iter().map(|t| Plane::of(*t).filter(|p| p.normal.is_finite())).collect();
        let welded = Welded::of(triangles);
        let mut sides = Sets::new(2 * triangles.len());
        let edges = welded.edges(|t| planes[t].is_some());
        for around in edges.chunk_by(|a, b| a.ends == b.ends) {
            join_around(around, &welded, &planes, &mut sides);
        }
        let by_shell = group(&mut sides, &planes);
        // A lit place of each shell: if a shell winds round all alike, it parts none.
        let lit: Vec<DVec3> = by_shell
            .iter()
            .filter_map(|members| {
                let largest = members
                    .iter()
                    .filter(|side| *side % 2 == 0 || both(**side as usize / 2))
                    .map(|side| (area(triangles[*side as usize / 2]), *side))
                    .reduce(|a, b| if b.0 > a.0 { b } else { a })?;
                let plane = planes[largest.1 as usize / 2]?;
                let [a, b, c] = triangles[largest.1 as usize / 2];
                let out = if largest.1 % 2 == 0 { plane.normal } else { -plane.normal };
                Some((a + b + c) / 3.0 + out * lift)
            })
            .collect();
        let mut left = MOST_ANGLES;
        let mut known: Vec<Vec<u32>> = Vec::new();
        let mut shells = Vec::new();
        for members in &by_shell {
            let (shell, own) = Shell::of(members, triangles, &planes, NEAR * lift);
            // The inside of a thing and its outside are the same shell.
            if shell.faces.is_empty() || shells.len() == MOST_SHELLS || known.contains(&own) {
                continue;
            }
            let looks = lit.len() / LOOKS;
            let near = lit.iter().filter(|p| left > looks && shell.holds(**p)).count();
            left = left.saturating_sub(looks);
            if near == 0 || near * shell.faces.len() > left {
                continue;
            }
            left -= near * shell.faces.len();
            let mut windings = lit.iter().filter_map(|p| shell.winding(*p));
            let first = windings.next();
            if windings.any(|w| Some(w) != first) {
                known.push(own);
                shells.push(shell);
            }
        }
        Self { shells }
    }

    /// In which space a place lies; `None` if it is too near a triangle to tell. Of two places in
    /// different spaces, neither sees the other.
    ///
    /// Time: the triangles of the shells that have the place within their bounds.
    #[must_use]
    pub fn space(&self, place: DVec3) -> Option<u64> {
        self.shells.iter().try_fold(0, |space, shell| {
            Some(space << 2 | (shell.winding(place)?.rem_euclid(4)) as u64)
        })
    }

    /// How many shells part lit places.
    #[must_use]
    pub fn shells(&self) -> usize {
        self.shells.len()
    }

    /// How many triangles they have together.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.shells.iter().map(|shell| shell.faces.len()).sum()
    }
}

impl Shell {
    /// The surface that sides make up, and the numbers of its triangles: a triangle with both of its
    /// sides there is a flap, and no part of it.
    fn of(
        members: &[u32],
        triangles: &[[DVec3; 3]],
        planes: &[Option<Plane>],
        near: f64,
    ) -> (Self, Vec<u32>) {
        let single: Vec<u32> = members
            .chunk_by(|a, b| a / 2 == b / 2)
            .filter(|sides| sides.len() == 1)
            .map(|sides| sides[0])
            .collect();
        let face = |side: &u32| {
            let triangle = *side as usize / 2;
            let sign = if side.is_multiple_of(2) { 1.0 } else { -1.0 };
            Some((triangles[triangle], planes[triangle]?, sign))
        };
        let faces: Vec<_> = single.iter().filter_map(face).collect();
        let corners = || faces.iter().flat_map(|(t, ..)| t).copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let own = single.iter().map(|side| side / 2).collect();
        (Self { faces, low, high, near }, own)
    }

    fn holds(&self, place: DVec3) -> bool {
        place.cmpge(self.low - self.near).all() && place.cmple(self.high + self.near).all()
    }

    /// How often it winds round a place.
    fn winding(&self, place: DVec3) -> Option<i64> {
        if !self.holds(place) {
            return Some(0);
        }
        let mut sum = 0.0;
        for (triangle, plane, sign) in &self.faces {
            let angle = solid_angle(*triangle, place);
            if angle.abs() > WIDE && plane.height(place).abs() < self.near {
                return None;
            }
            sum += sign * angle;
        }
        let windings = sum / (4.0 * PI);
        let whole = windings.round();
        ((windings - whole).abs() < WHOLE).then_some(whole as i64)
    }
}

/// The solid angle under which a triangle is seen from a place, above 0 from its front (van Oosterom &
/// Strackee 1983, eq. 8).
#[must_use]
pub fn solid_angle(triangle: [DVec3; 3], from: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p - from);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let above = -a.dot(b.cross(c));
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * above.atan2(below)
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length() / 2.0
}

/// The sides of each shell, in order.
fn group(sides: &mut Sets, planes: &[Option<Plane>]) -> Vec<Vec<u32>> {
    let mut members: Vec<(u32, u32)> = (0..2 * planes.len() as u32)
        .filter(|side| planes[*side as usize / 2].is_some())
        .map(|side| (sides.leader(side), side))
        .collect();
    members.sort_unstable();
    members
        .chunk_by(|a, b| a.0 == b.0)
        .map(|shell| shell.iter().map(|(_, side)| *side).collect())
        .collect()
}

/// Joins the sides that look into the same wedge round an edge.
fn join_around(around: &[Edge], welded: &Welded, planes: &[Option<Plane>], sides: &mut Sets) {
    let [u, v] = around[0].ends.map(|p| welded.places[p as usize]);
    let axis = (v - u).normalize_or_zero();
    let (x, y) = axis.any_orthonormal_pair();
    // By the angle at which they stand out, as seen along the edge. Of two in one place, the one whose
    // front looks backwards is first: rooms back to back have their backs between them.
    let mut spokes: Vec<(f64, bool, u32)> = around
        .iter()
        .filter_map(|edge| {
            let plane = planes[edge.triangle as usize]?;
            let far = welded.corners[edge.triangle as usize][edge.opposite as usize];
            let out = welded.places[far as usize] - u;
            let (cosine, sine) = (x.dot(out), y.dot(out));
            let forwards = plane.normal.dot(axis.cross(x * cosine + y * sine)) > 0.0;
            Some((sine.atan2(cosine), forwards, edge.triangle))
        })
        .collect();
    spokes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    for (i, (_, forwards, triangle)) in spokes.iter().enumerate() {
        let (_, next_forwards, next) = spokes[(i + 1) % spokes.len()];
        // The side that looks on round the edge, and the one of the next that looks back.
        sides.join(2 * triangle + u32::from(!forwards), 2 * next + u32::from(next_forwards));
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    /// A box seen from inside.
    fn room(low: DVec3, high: DVec3) -> Vec<[DVec3; 3]> {
        let p = |i: u8| {
            let pick = |bit: u8, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
            dvec3(pick(1, 0), pick(2, 1), pick(4, 2))
        };
        let quads = [
            [0, 2, 6, 4], // low x, its front to +x
            [1, 5, 7, 3],
            [0, 4, 5, 1],
            [2, 3, 7, 6],
            [0, 1, 3, 2],
            [4, 6, 7, 5],
        ];
        let halves = |[a, b, c, d]: [u8; 4]| [[a, b, c].map(p), [a, c, d].map(p)];
        quads.into_iter().flat_map(halves).collect()
    }

    fn spaces(triangles: &[[DVec3; 3]]) -> Spaces {
        Spaces::of(triangles, |_| false, 1e-6)
    }

    #[test]
    fn walls_of_a_room_face_inwards() {
        let centre = DVec3::splat(0.5);
        for t in room(DVec3::ZERO, DVec3::ONE) {
            assert!(Plane::of(t).is_some_and(|p| p.height(centre) > 0.0), "{t:?}");
        }
    }

    #[test]
    fn one_room_with_things_in_it_is_one_space() {
        let mut scene = room(DVec3::ZERO, DVec3::splat(4.0));
        let mut cupboard = room(DVec3::splat(1.0), DVec3::splat(2.0));
        cupboard.iter_mut().for_each(|t| t.swap(1, 2));
        scene.extend(cupboard);
        assert_eq!(spaces(&scene).shells(), 0);
    }

    #[test]
    fn rooms_wall_to_wall_are_apart() {
        // The walls between them coincide; apart from that, x = 0 to 2 and x = 2 to 5.
        let mut scene = room(DVec3::ZERO, DVec3::splat(2.0));
        scene.extend(room(dvec3(2.0, 0.0, 0.0), dvec3(5.0, 2.0, 2.0)));
        let spaces = spaces(&scene);
        assert!(spaces.shells() > 0);
        let at = |x| spaces.space(dvec3(x, 1.0, 1.2)).unwrap();
        assert_eq!(at(0.5), at(1.9));
        assert_eq!(at(2.1), at(4.0));
        assert_ne!(at(1.9), at(2.1));
        assert_ne!(at(4.0), at(6.0), "outside");
    }

    #[test]
    fn a_room_with_a_hole_is_not_sealed() {
        let mut scene = room(DVec3::ZERO, DVec3::splat(2.0));
        scene.extend(room(dvec3(3.0, 0.0, 0.0), dvec3(5.0, 2.0, 2.0)));
        scene.remove(5);
        scene.remove(13);
        let spaces = spaces(&scene);
        assert_eq!(spaces.shells(), 0);
        assert_eq!(spaces.space(DVec3::ONE), spaces.space(dvec3(4.0, 1.0, 1.0)));
    }

    #[test]
    fn one_sheet_between_two_rooms_parts_them() {
        // A room with a wall across, whose rim is the edges of the walls: three at an edge.
        let mut scene = room(DVec3::ZERO, dvec3(2.0, 2.0, 2.0));
        scene.retain(|t| t.iter().any(|p| p.x == 0.0));
        let half = |t: &[DVec3; 3]| t.iter().any(|p| p.x != 2.0);
        scene = scene.into_iter().filter(half).collect();
        let mut other = room(dvec3(2.0, 0.0, 0.0), dvec3(5.0, 2.0, 2.0));
        other.retain(half);
        scene.extend(other);
        let at = |y, z| dvec3(2.0, y, z);
        scene.push([at(0.0, 0.0), at(2.0, 0.0), at(2.0, 2.0)]);
        scene.push([at(0.0, 0.0), at(2.0, 2.0), at(0.0, 2.0)]);
        let spaces = Spaces::of(&scene, |t| t + 2 >= scene.len(), 1e-6);
        let of = |x| spaces.space(dvec3(x, 1.0, 1.1));
        assert_ne!(of(1.0), of(3.0));
    }
}
