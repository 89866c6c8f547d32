//! Binned SAH build (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies").
//!
//! The root and its large children are divided first; what is below them is built independently,
//! on as many threads as the caller has, and put together in a fixed order. What is independent
//! depends on the triangles alone, so any number of threads builds the same hierarchy.

use std::mem;

use super::BvhConfig;
use super::node::{LEAF, NO_CHILD, Node, WIDTH};
use super::split::{MAX_BINS, Set};
use crate::aabb::Aabb;
use crate::block::{Block, LANES};
use crate::frame::LocalTriangle;

/// A bound on the depth of any hierarchy, and so on the stack of a traversal.
///
/// Halving alone needs 29 levels for 2³¹ triangles; what a smaller scene leaves unused is room for
/// SAH to be uneven. Sensible scenes stay below 16.
pub(super) const MAX_DEPTH: usize = 36;

/// Sets with fewer triangles are not shared out further: they take milliseconds at most.
const GRAIN: usize = 4096;

/// Whether a set that is halved from here on stays within [`MAX_DEPTH`] with a level to spare.
fn may_be_uneven(len: usize, depth: usize) -> bool {
    depth + 1 + (len.ilog2() as usize) < MAX_DEPTH
}

/// Nodes (root first), leaf blocks and the depth. The parts of a hierarchy have the same form;
/// `root` may then be a leaf.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
    pub(super) depth: usize,
    root: u32,
}

/// Says which promise of the caller of [`super::Bvh::build_with`] is broken.
const LEFT_OUT: &str = "`run` calls the function once for each part";

/// A part of a hierarchy under construction: see [`super::Bvh::build_with`].
#[derive(Debug)]
pub struct Part<'a>(State<'a>);

#[derive(Debug)]
enum State<'a> {
    Waiting {
        builder: Builder<'a>,
        set: Set<'a>,
        depth: usize,
    },
    /// Divided further, because it is large.
    Divided {
        sets: Vec<Set<'a>>,
        depth: usize,
    },
    Built(Tree),
    /// While it is worked on.
    Taken,
}

/// Builds the hierarchy; `run` calls a function once for each of some parts.
pub(super) fn build(
    triangles: &[LocalTriangle],
    config: &BvhConfig,
    run: impl Fn(&mut [Part<'_>], &(dyn Fn(&mut Part<'_>) + Sync)),
) -> Tree {
    let mut boxes: Vec<Aabb> = triangles.iter().map(|t| Aabb::of_triangle(&t.vertices)).collect();
    let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
    let mut tree = Tree::default();
    if triangles.is_empty() {
        return tree;
    }
    let builder = Builder { triangles, bins: config.bins.clamp(2, MAX_BINS) };
    let set = Set::of(&mut order, &mut boxes);
    if set.len() <= GRAIN {
        builder.node(&mut tree, set, 1);
    } else {
        let waiting = |set, depth| Part(State::Waiting { builder, set, depth });
        let mut parts: Vec<Part> =
            builder.divide(set, 1).into_iter().map(|set| waiting(set, 2)).collect();
        run(&mut parts, &|part| part.work(GRAIN));
        // The large ones now wait in pieces, each with the number of the part it is from.
        let mut pieces = Vec::new();
        for (number, part) in parts.iter_mut().enumerate() {
            if let State::Divided { sets, depth, .. } = &mut part.0 {
                let depth = *depth + 1;
                pieces.extend(mem::take(sets).into_iter().map(|set| (number, waiting(set, depth))));
            }
        }
        let (numbers, mut pieces): (Vec<usize>, Vec<Part>) = pieces.into_iter().unzip();
        run(&mut pieces, &|piece| piece.work(usize::MAX));
        tree = assemble(parts, numbers.into_iter().zip(pieces));
    }
    tree.nodes.shrink_to_fit();
    tree.blocks.shrink_to_fit();
    tree
}

/// Puts the parts below the root, and below divided parts their pieces.
fn assemble<'a>(parts: Vec<Part>, pieces: impl Iterator<Item = (usize, Part<'a>)>) -> Tree {
    let mut pieces = pieces.peekable();
    let mut tree = Tree { nodes: vec![Node::EMPTY], depth: 1, ..Tree::default() };
    for (lane, part) in parts.into_iter().enumerate() {
        let (child, bounds) = match part.0 {
            State::Built(below) => tree.append(below, 1),
            State::Waiting { .. } | State::Taken => panic!("{LEFT_OUT}"),
            State::Divided { .. } => {
                let index = tree.nodes.len();
                tree.nodes.push(Node::EMPTY);
                let mut bounds = Aabb::EMPTY;
                let mut inner = 0;
                while let Some((_, piece)) = pieces.next_if(|(number, _)| *number == lane) {
                    let State::Built(below) = piece.0 else { panic!("{LEFT_OUT}") };
                    let (child, piece_bounds) = tree.append(below, 2);
                    tree.nodes[index].set_child(inner, child, &piece_bounds);
                    bounds.join(&piece_bounds);
                    inner += 1;
                }
                (index as u32, bounds)
            }
        };
        tree.nodes[0].set_child(lane, child, &bounds);
    }
    tree
}

impl Tree {
    /// Takes in a part that hangs `depth` nodes below the root; returns its root, and its bounds.
    fn append(&mut self, mut part: Self, depth: usize) -> (u32, Aabb) {
        let (nodes, blocks) = (self.nodes.len() as u32, self.blocks.len() as u32);
        let moved = |child: u32| match child {
            NO_CHILD => NO_CHILD,
            leaf if leaf & LEAF != 0 => leaf + blocks,
            node => node + nodes,
        };
        for node in &mut part.nodes {
            node.children = node.children.map(moved);
        }
        let mut bounds = Aabb::EMPTY;
        for triangle in part.blocks.iter().flat_map(Block::triangles) {
            bounds.join(&Aabb::of_triangle(&triangle.vertices));
        }
        self.nodes.append(&mut part.nodes);
        self.blocks.append(&mut part.blocks);
        self.depth = self.depth.max(depth + part.depth);
        (moved(part.root), bounds)
    }
}

impl Part<'_> {
    /// Builds the part, or divides it if it has more triangles than `grain`.
    fn work(&mut self, grain: usize) {
        if !matches!(self.0, State::Waiting { .. }) {
            return; // a second call
        }
        let State::Waiting { builder, set, depth } = mem::replace(&mut self.0, State::Taken) else {
            return;
        };
        self.0 = if set.len() > grain {
            State::Divided { sets: builder.divide(set, depth), depth }
        } else {
            let mut tree = Tree::default();
            tree.root = builder.child(&mut tree, set, depth);
            tree.depth = tree.depth.saturating_sub(depth - 1);
            State::Built(tree)
        };
    }
}

#[derive(Clone, Copy, Debug)]
struct Builder<'a> {
    triangles: &'a [LocalTriangle],
    bins: usize,
}

impl Builder<'_> {
    /// Adds the node over a set; returns its index.
    ///
    /// Recursion is as deep as the hierarchy, at most [`MAX_DEPTH`].
    fn node(&self, tree: &mut Tree, set: Set, depth: usize) -> u32 {
        tree.depth = tree.depth.max(depth);
        let index = tree.nodes.len();
        tree.nodes.push(Node::EMPTY);
        for (lane, part) in self.divide(set, depth).into_iter().enumerate() {
            let bounds = part.bounds;
            let child = self.child(tree, part, depth + 1);
            tree.nodes[index].set_child(lane, child, &bounds);
        }
        index as u32
    }

    /// Adds a leaf or a node.
    fn child(&self, tree: &mut Tree, set: Set, depth: usize) -> u32 {
        if set.len() > LANES {
            return self.node(tree, set, depth);
        }
        tree.blocks.push(Block::of(set.order.iter().map(|&i| &self.triangles[i as usize])));
        LEAF | (tree.blocks.len() - 1) as u32
    }

    /// Divides a set into the children of a node at a depth.
    fn divide<'s>(&self, set: Set<'s>, depth: usize) -> Vec<Set<'s>> {
        let mut parts = Vec::with_capacity(WIDTH);
        parts.push(set);
        while parts.len() < WIDTH {
            // Split the part that most rays meet.
            let area = |i: usize| -> f32 { parts[i].bounds.half_area() };
            let widest = (0..parts.len())
                .filter(|&i| parts[i].len() > LANES)
                .reduce(|a, b| if area(b) > area(a) { b } else { a });
            let Some(widest) = widest else { break };
            let part = parts.swap_remove(widest);
            let halves = if may_be_uneven(part.len(), depth) {
                part.by_area(self.bins).unwrap_or_else(Set::at_median)
            } else {
                part.at_median()
            };
            parts.extend(halves);
        }
        // Children are visited in this order: what hides most comes first, single blocks last
        // (example `mrays`: 1.0 to 1.17 times the segments, columns most).
        let inner = |set: &Set| set.len() > LANES;
        let area = |set: &Set| set.bounds.half_area();
        parts.sort_by(|a, b| inner(b).cmp(&inner(a)).then(area(b).total_cmp(&area(a))));
        parts
    }
}
