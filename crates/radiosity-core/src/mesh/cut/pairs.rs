//! Pairs of boxes that overlap, by a tree over the boxes that is held against itself.

use std::ops::{ControlFlow, Range};

use glam::DVec3;

/// Boxes in a leaf: fewer make the tree larger than the boxes, more make more tests.
const LEAF: usize = 8;

/// A box given by its least and greatest corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    low: DVec3,
    high: DVec3,
}

impl Bounds {
    /// The box around some points, and `margin` more on every side.
    pub(super) fn around(points: &[DVec3], margin: f64) -> Self {
        let [low, high] = [DVec3::min, DVec3::max]
            .map(|least| points.iter().copied().reduce(least).unwrap_or(DVec3::ZERO));
        Self { low: low - margin, high: high + margin }
    }

    fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Calls `visit` once for each two boxes that overlap, until it breaks. The order is fixed by
/// the boxes; it is not that of their numbers.
pub(super) fn overlapping(
    bounds: &[Bounds],
    mut visit: impl FnMut(usize, usize) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut tree = Tree { bounds, order: (0..bounds.len() as u32).collect(), nodes: Vec::new() };
    if bounds.is_empty() {
        return ControlFlow::Continue(());
    }
    tree.build(0..bounds.len());
    tree.within(0, &mut visit)
}

struct Tree<'a> {
    bounds: &'a [Bounds],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

struct Node {
    bounds: Bounds,
    /// Its boxes, as places in `order`.
    boxes: Range<usize>,
    /// The children, of a node that is not a leaf.
    children: Option<[u32; 2]>,
}

impl Tree<'_> {
    /// Halves the boxes by the middle one along the axis on which their centers are furthest
    /// spread; the depth is logarithmic.
    fn build(&mut self, boxes: Range<usize>) -> u32 {
        let of = |&i: &u32| self.bounds[i as usize];
        let around = self.order[boxes.clone()].iter().map(of).reduce(Bounds::join);
        let around = around.expect("a node is never empty");
        let id = self.nodes.len();
        self.nodes.push(Node { bounds: around, boxes: boxes.clone(), children: None });
        if boxes.len() > LEAF {
            let middle = boxes.len() / 2;
            let center = |&i: &u32| self.bounds[i as usize].low + self.bounds[i as usize].high;
            let centers = || self.order[boxes.clone()].iter().map(center);
            let low = centers().fold(DVec3::INFINITY, DVec3::min);
            let high = centers().fold(DVec3::NEG_INFINITY, DVec3::max);
            let axis = (high - low).max_position();
            let center = |i: &u32| center(i)[axis];
            self.order[boxes.clone()].select_nth_unstable_by(middle, |a, b| {
                center(a).total_cmp(&center(b)).then(a.cmp(b))
            });
            let split = boxes.start + middle;
            let children = [self.build(boxes.start..split), self.build(split..boxes.end)];
            self.nodes[id].children = Some(children);
        }
        id as u32
    }

    /// Pairs of boxes of one node.
    fn within(
        &self,
        node: u32,
        visit: &mut impl FnMut(usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Node { boxes, children, .. } = &self.nodes[node as usize];
        if let Some([a, b]) = *children {
            self.within(a, visit)?;
            self.within(b, visit)?;
            return self.between(a, b, visit);
        }
        for i in boxes.clone() {
            for j in i + 1..boxes.end {
                self.pair(i, j, visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Pairs of a box of one node and one of another.
    fn between(
        &self,
        a: u32,
        b: u32,
        visit: &mut impl FnMut(usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (left, right) = (&self.nodes[a as usize], &self.nodes[b as usize]);
        if !left.bounds.overlaps(&right.bounds) {
            return ControlFlow::Continue(());
        }
        match (left.children, right.children) {
            (None, None) => {
                for i in left.boxes.clone() {
                    for j in right.boxes.clone() {
                        self.pair(i, j, visit)?;
                    }
                }
            }
            // The larger one is taken apart.
            (Some([l, r]), _) if left.boxes.len() >= right.boxes.len() => {
                self.between(l, b, visit)?;
                self.between(r, b, visit)?;
            }
            (_, Some([l, r])) => {
                self.between(a, l, visit)?;
                self.between(a, r, visit)?;
            }
            (Some([l, r]), None) => {
                self.between(l, b, visit)?;
                self.between(r, b, visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn pair(
        &self,
        i: usize,
        j: usize,
        visit: &mut impl FnMut(usize, usize) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let [i, j] = [i, j].map(|at| self.order[at] as usize);
        if self.bounds[i].overlaps(&self.bounds[j]) {
            visit(i.min(j), i.max(j))?;
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pairs_are_those_of_trying_all() {
        // Boxes of sizes from .01 to 1 in a unit cube, by a Weyl sequence.
        let n = 300;
        let part = |i: usize, k: f64| (i as f64 * k).fract();
        let bounds: Vec<Bounds> = (0..n)
            .map(|i| {
                let at = DVec3::new(part(i, 0.618), part(i, 0.414), part(i, 0.732));
                let size = 0.03f64.powf(part(i, 0.236));
                Bounds::around(&[at, at + DVec3::new(size, size * 0.5, size)], 0.001)
            })
            .collect();
        let mut found = Vec::new();
        let all = overlapping(&bounds, |i, j| {
            found.push((i, j));
            ControlFlow::Continue(())
        });
        assert_eq!(all, ControlFlow::Continue(()));
        found.sort_unstable();
        let mut expected = Vec::new();
        for i in 0..n {
            expected.extend((i + 1..n).filter(|&j| bounds[i].overlaps(&bounds[j])).map(|j| (i, j)));
        }
        assert!(expected.len() > n);
        assert_eq!(found, expected);
        // A break is the end.
        let mut count = 0;
        let broken = overlapping(&bounds, |_, _| {
            count += 1;
            if count == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!((broken, count), (ControlFlow::Break(()), 5));
    }
}
