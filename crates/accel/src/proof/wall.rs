//! Coplanar triangles as one occluder: large convex polygons that hide whole surfaces at once.

use glam::DVec3;

use super::weld::{Edge, Sets, Welded};
use super::{IN_PLANE, Plane, extent};

/// Cosine of the angle between normals of one plane.
const PARALLEL: f64 = 1.0 - 1e-12;

/// A corner turns the right way if the sine of its turn is above this: corners on a straight edge.
const STRAIGHT: f64 = -1e-12;

/// Convex polygons that triangles of one plane make up.
#[derive(Clone, Debug, Default)]
pub struct Walls(pub(super) Vec<Wall>);

/// One convex polygon.
#[derive(Clone, Debug)]
pub(super) struct Wall {
    pub(super) plane: Plane,
    /// Its edges as planes through them, their normals to its inside.
    sides: Vec<Plane>,
    pub(super) area: f64,
}

impl Walls {
    /// Joins neighbouring triangles of one plane, as long as what they make up is convex, and keeps
    /// the `most` largest with at least this share of the square of the extent.
    ///
    /// Polygons are grown edge by edge in a fixed order, so one that is not convex, such as a wall
    /// with a door, is left in a few convex pieces (Hertel & Mehlhorn 1983). Time N·log N.
    #[must_use]
    pub fn of(
        triangles: &[[DVec3; 3]],
        takes_part: impl Fn(usize) -> bool,
        least: f64,
        most: usize,
    ) -> Self {
        let size = extent(triangles);
        let planes: Vec<Option<Plane>> = triangles
            .iter()
            .enumerate()
            .map(|(i, t)| Plane::of(*t).filter(|p| p.normal.is_finite() && takes_part(i)))
            .collect();
        let welded = Welded::of(triangles);
        let mut joiner = Joiner {
            planes: &planes,
            welded: &welded,
            in_plane: IN_PLANE * size,
            sets: Sets::new(triangles.len()),
            loops: welded.corners.iter().map(|c| c.to_vec()).collect(),
        };
        let edges = welded.edges(|t| planes[t].is_some());
        let pairs = edges.chunk_by(|a, b| a.ends == b.ends);
        let mut pairs: Vec<&[Edge]> = pairs.filter(|pair| pair.len() == 2).collect();
        // What is not convex yet may be once its neighbours have grown.
        let mut before = usize::MAX;
        while pairs.len() < before {
            before = pairs.len();
            pairs.retain(|pair| !joiner.join(&pair[0], &pair[1]));
        }
        let mut walls = joiner.walls();
        walls.retain(|wall| wall.area >= least * size * size);
        // The stable sort keeps the order of equals.
        walls.sort_by(|a, b| b.area.total_cmp(&a.area));
        walls.truncate(most);
        Self(walls)
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Wall {
    /// Whether it cuts each segment from one of `from` to one of `to`, at least `slack` off its rim,
    /// given that all of `from` lie in front of it and all of `to` behind, or the other way round.
    ///
    /// Crossings of segments between two convex sets lie in the hull of those between their corners,
    /// and a convex polygon that holds these holds all.
    pub(super) fn cuts(&self, from: &[DVec3], to: &[DVec3], slack: f64) -> bool {
        from.iter().all(|p| {
            let height = self.plane.height(*p);
            to.iter().all(|q| {
                let crossing = p.lerp(*q, height / (height - self.plane.height(*q)));
                self.sides.iter().all(|side| side.height(crossing) > slack)
            })
        })
    }
}

/// Polygons on their way from triangles to walls.
struct Joiner<'a> {
    planes: &'a [Option<Plane>],
    welded: &'a Welded,
    in_plane: f64,
    /// The polygon that each triangle is part of: its first triangle.
    sets: Sets,
    /// The corners of each polygon, in the order of its first triangle; empty once it is joined.
    loops: Vec<Vec<u32>>,
}

impl Joiner<'_> {
    /// Joins the polygons on the two sides of an edge, if that makes a convex one; whether there is
    /// nothing left to do at this edge.
    fn join(&mut self, a: &Edge, b: &Edge) -> bool {
        let (first, second) = (self.sets.leader(a.triangle), self.sets.leader(b.triangle));
        if first == second {
            return true;
        }
        let (Some(plane), Some(other)) =
            (&self.planes[first as usize], &self.planes[second as usize])
        else {
            return true;
        };
        let cosine = plane.normal.dot(other.normal);
        let flat = |p: &u32| plane.height(self.place(*p)).abs() <= self.in_plane;
        if cosine.abs() < PARALLEL || !self.loops[second as usize].iter().all(flat) {
            return true;
        }
        let mut second_loop = self.loops[second as usize].clone();
        if cosine < 0.0 {
            second_loop.reverse();
        }
        let joined = merged(&self.loops[first as usize], &second_loop, a.ends);
        let Some(joined) = joined.filter(|joined| self.is_convex(joined, plane.normal)) else {
            return false;
        };
        let kept = self.sets.join(first, second);
        let turned = kept == second && cosine < 0.0;
        self.loops[(first + second - kept) as usize] = Vec::new();
        self.loops[kept as usize] =
            if turned { joined.into_iter().rev().collect() } else { joined };
        true
    }

    fn place(&self, number: u32) -> DVec3 {
        self.welded.places[number as usize]
    }

    /// Whether no corner turns back: to the wrong side, or to where it came from.
    fn is_convex(&self, corners: &[u32], normal: DVec3) -> bool {
        let n = corners.len();
        (0..n).all(|i| {
            let [p, q, r] = [0, 1, 2].map(|k| self.place(corners[(i + k) % n]));
            let (u, v) = ((q - p).normalize_or_zero(), (r - q).normalize_or_zero());
            let sine = normal.dot(u.cross(v));
            sine > STRAIGHT && (u.dot(v) > 0.0 || sine > -STRAIGHT)
        })
    }

    fn walls(self) -> Vec<Wall> {
        let polygons = self.loops.iter().zip(self.planes);
        polygons
            .filter_map(|(corners, plane)| Some((corners, (*plane)?)))
            .filter(|(corners, _)| corners.len() >= 3)
            .map(|(corners, plane)| {
                let places: Vec<DVec3> = corners.iter().map(|p| self.place(*p)).collect();
                let next = |i: usize| places[(i + 1) % places.len()];
                let side = |i: usize| {
                    let normal = plane.normal.cross(next(i) - places[i]).normalize_or_zero();
                    Plane::through(places[i], normal)
                };
                let sides = (0..places.len()).map(side).collect();
                let fan = |i: usize| (places[i] - places[0]).cross(next(i) - places[0]);
                let area = (0..places.len()).map(fan).sum::<DVec3>().length() / 2.0;
                Wall { plane, sides, area }
            })
            .collect()
    }
}

/// Two loops as one without the edge that they share, in the order of the first; `None` if they do not
/// run along it in opposite directions.
fn merged(first: &[u32], second: &[u32], edge: [u32; 2]) -> Option<Vec<u32>> {
    let at = |of: &[u32], [u, v]: [u32; 2]| {
        (0..of.len()).find(|i| of[*i] == u && of[(i + 1) % of.len()] == v)
    };
    let ([u, v], i) = match at(first, edge) {
        Some(i) => (edge, i),
        None => ([edge[1], edge[0]], at(first, [edge[1], edge[0]])?),
    };
    let j = at(second, [v, u])?;
    // From v round the first to u, then round the second from behind u to before v.
    let (n, m) = (first.len(), second.len());
    let mut joined: Vec<u32> = (1..=n).map(|k| first[(i + k) % n]).collect();
    joined.extend((2..m).map(|k| second[(j + k) % m]));
    // More edges in common leave a way there and back.
    while joined.len() > 2 {
        let n = joined.len();
        let Some(k) = (0..n).find(|k| joined[*k] == joined[(k + 2) % n]) else { break };
        let (tip, back) = ((k + 1) % n, (k + 2) % n);
        joined.remove(tip.max(back));
        joined.remove(tip.min(back));
    }
    (joined.len() > 2).then_some(joined)
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    /// A wall of n × m squares in the plane x = 2 with some of them left out.
    fn grid(n: usize, m: usize, hole: impl Fn(usize, usize) -> bool) -> Vec<[DVec3; 3]> {
        let at = |i: usize, j: usize| dvec3(2.0, i as f64, j as f64);
        let squares = (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
        let squares = squares.filter(|(i, j)| !hole(*i, *j));
        squares
            .flat_map(|(i, j)| {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    #[test]
    fn a_wall_of_many_triangles_is_one() {
        let walls = Walls::of(&grid(5, 4, |_, _| false), |_| true, 0.0, 9);
        assert_eq!(walls.len(), 1, "{walls:?}");
        assert!((walls.0[0].area - 20.0).abs() < 1e-12);
        let behind = |x: f64| [dvec3(x, 1.0, 1.0), dvec3(x, 3.0, 1.0), dvec3(x, 2.0, 3.0)];
        assert!(walls.0[0].cuts(&behind(0.0), &behind(4.0), 1e-3));
        // One of the crossings, (2, 5.5, 1), is beside the wall.
        assert!(!walls.0[0].cuts(&behind(0.0), &[dvec3(4.0, 10.0, 1.0)], 1e-3));
    }

    #[test]
    fn a_wall_with_a_door_is_left_in_convex_pieces_of_the_same_area() {
        let walls = Walls::of(&grid(5, 4, |i, j| i == 2 && j < 2), |_| true, 0.0, 99);
        let area: f64 = walls.0.iter().map(|w| w.area).sum();
        assert!(walls.len() > 1 && (area - 18.0).abs() < 1e-12, "{walls:?}");
        let at = |x| [dvec3(x, 2.5, 1.0)];
        assert!(!walls.0.iter().any(|w| w.cuts(&at(0.0), &at(4.0), 0.0)), "through the door");
    }

    #[test]
    fn windings_that_differ_are_joined_all_the_same() {
        let mut wall = grid(3, 3, |_, _| false);
        wall.iter_mut().step_by(3).for_each(|t| t.swap(1, 2));
        let walls = Walls::of(&wall, |_| true, 0.0, 99);
        let area: f64 = walls.0.iter().map(|w| w.area).sum();
        assert!(walls.len() < 4 && (area - 9.0).abs() < 1e-12, "{walls:?}");
    }
}
