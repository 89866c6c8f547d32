//! What may stand in between: triangles, put together to walls, in a tree of boxes.

use glam::DVec3;

use crate::corners::Corners;
use crate::merge::merge;
use crate::pair::TOUCHES;

/// Polygons in a leaf of the tree.
const LEAF: usize = 4;

/// Triangles that block light from both sides.
///
/// # Examples
/// ```
/// use form_factor::{Occluders, Polygon, between_occluded};
/// use glam::DVec3;
///
/// let square = |z: f64| [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| DVec3::new(x, y, z));
/// let mut above = square(1.0);
/// above.reverse();
/// let [a, b] = [square(0.0), above].map(|corners| Polygon::new(&corners).unwrap());
/// // A screen that leaves nothing to see.
/// let [p, q, r] = [(-1., -1.), (4., -1.), (-1., 4.)].map(|(x, y)| DVec3::new(x, y, 0.5));
/// let screen = Occluders::build(&[[p, q, r]]);
/// assert_eq!(between_occluded(&a, &b, &screen, 1e-3).value, 0.0);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Occluders {
    triangles: usize,
    /// Convex polygons in the order of the leaves: the triangles, or several of one plane.
    walls: Vec<Corners>,
    nodes: Vec<Node>,
}

/// A box and what is in it: walls `first..first + count`, or, where `count` is 0, the nodes
/// after this one and `first`.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    first: u32,
    count: u32,
}

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Bounds {
    pub(crate) fn of(corners: impl IntoIterator<Item = DVec3>) -> Self {
        let none = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        corners
            .into_iter()
            .fold(none, |b, corner| Self { low: b.low.min(corner), high: b.high.max(corner) })
    }
}

impl Occluders {
    /// Builds the tree over `triangles`; those with a corner that is not finite block nothing.
    #[must_use]
    pub fn build(triangles: &[[DVec3; 3]]) -> Self {
        let finite = |t: &&[DVec3; 3]| t.iter().all(|corner| corner.is_finite());
        let mut walls: Vec<Corners> =
            triangles.iter().filter(finite).map(|t| t.iter().copied().collect()).collect();
        let triangles = walls.len();
        let mut nodes = Vec::new();
        if triangles > 0 {
            let bounds = Bounds::of(walls.iter().flat_map(|wall| wall.iter().copied()));
            merge(&mut walls, TOUCHES * (bounds.high - bounds.low).max_element());
            split(&mut walls, 0, &mut nodes);
        }
        Self { triangles, walls, nodes }
    }

    /// Number of triangles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.triangles
    }

    /// Whether there is nothing that blocks.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangles == 0
    }

    /// Calls `found` with each wall whose box and whose parents' boxes `meets` accepts, always
    /// in the same order.
    pub(crate) fn visit(&self, meets: impl Fn(&Bounds) -> bool, mut found: impl FnMut(&[DVec3])) {
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            let Some(node) = self.nodes.get(at) else { continue };
            if !meets(&node.bounds) {
                continue;
            }
            if node.count > 0 {
                let first = node.first as usize;
                let walls = &self.walls[first..first + node.count as usize];
                walls.iter().for_each(|wall| found(wall));
            } else {
                open.push(node.first as usize);
                open.push(at + 1);
            }
        }
    }
}

/// Adds the node over `walls`, the first of which has the index `first`, and those below it:
/// halves by the middle of the centres along the longest side.
fn split(walls: &mut [Corners], first: usize, nodes: &mut Vec<Node>) {
    let bounds = Bounds::of(walls.iter().flat_map(|wall| wall.iter().copied()));
    let at = nodes.len();
    nodes.push(Node { bounds, first: first as u32, count: walls.len() as u32 });
    if walls.len() <= LEAF {
        return;
    }
    let centre = |wall: &Corners| wall.iter().sum::<DVec3>() / wall.len() as f64;
    let centres = Bounds::of(walls.iter().map(centre));
    let size = (centres.high - centres.low).to_array();
    let axis = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
    let half = walls.len() / 2;
    walls.select_nth_unstable_by(half, |a, b| centre(a)[axis].total_cmp(&centre(b)[axis]));
    let (left, right) = walls.split_at_mut(half);
    split(left, first, nodes);
    (nodes[at].first, nodes[at].count) = (nodes.len() as u32, 0);
    split(right, first + half, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_triangle_is_found_once_and_far_ones_are_not_asked_for() {
        let triangle = |i: usize| {
            let at = DVec3::new((i * 7 % 100) as f64, (i * 13 % 17) as f64, i as f64);
            [at, at + DVec3::X, at + DVec3::Y]
        };
        let triangles: Vec<_> = (0..100).map(triangle).collect();
        let tree = Occluders::build(&triangles);
        let mut found = Vec::new();
        tree.visit(|_| true, |t| found.push(t[0].z as usize));
        found.sort_unstable();
        assert_eq!(found, (0..100).collect::<Vec<_>>());
        found.clear();
        tree.visit(|bounds| bounds.low.z <= 10.0, |t| found.push(t[0].z as usize));
        assert!((0..=10).all(|i| found.contains(&i)) && found.len() < 40, "{found:?}");
        Occluders::build(&[]).visit(|_| true, |_| panic!("nothing is in it"));
        let nan = Occluders::build(&[[DVec3::NAN; 3]]);
        assert!(nan.is_empty() && tree.len() == 100);
    }
}
