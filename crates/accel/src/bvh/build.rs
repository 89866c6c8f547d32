//! Binned SAH build (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies").
//!
//! The root and its large children are divided first; what is below them is built independently,
//! on as many threads as the caller has, and put together in a fixed order. What is independent
//! depends on the triangles alone, so any number of threads builds the same hierarchy.

use std::mem;

use super::BvhConfig;
use super::node::{Node, WIDTH};
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
/// they may be one block without a node.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
    pub(super) depth: usize,
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
        tree.nodes.push(Node::EMPTY);
        builder.node(&mut tree, 0, set, 1);
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
    let mut below = Vec::new();
    for (lane, part) in parts.into_iter().enumerate() {
        below.push(match part.0 {
            State::Built(tree) => tree,
            State::Waiting { .. } | State::Taken => panic!("{LEFT_OUT}"),
            State::Divided { .. } => {
                let mut trees = Vec::new();
                while let Some((_, piece)) = pieces.next_if(|(number, _)| *number == lane) {
                    let State::Built(tree) = piece.0 else { panic!("{LEFT_OUT}") };
                    trees.push(tree);
                }
                let mut tree = Tree { nodes: vec![Node::EMPTY], depth: 1, ..Tree::default() };
                tree.hang(trees);
                tree
            }
        });
    }
    tree.hang(below);
    tree
}

impl Tree {
    fn bounds(&self) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        for triangle in self.blocks.iter().flat_map(Block::triangles) {
            bounds.join(&Aabb::of_triangle(&triangle.vertices));
        }
        bounds
    }

    /// Makes other hierarchies the children of the root: those with nodes first, then single blocks.
    fn hang(&mut self, trees: Vec<Self>) {
        let inner = trees.iter().take_while(|tree| !tree.nodes.is_empty()).count();
        let mut root = Node::new(inner, self.nodes.len(), self.blocks.len());
        trees.iter().for_each(|tree| root.push(&tree.bounds()));
        self.nodes[0] = root;
        self.nodes.reserve_exact(trees.iter().map(|tree| tree.nodes.len()).sum());
        self.blocks.reserve_exact(trees.iter().map(|tree| tree.blocks.len()).sum());
        for tree in &trees[inner..] {
            self.blocks.extend(&tree.blocks);
        }
        let first = self.nodes.len();
        self.nodes.resize(first + inner, Node::EMPTY);
        for (i, mut tree) in trees.into_iter().take(inner).enumerate() {
            // The root takes the place kept for it; the others, numbered from 1, follow.
            let (nodes, blocks) = (self.nodes.len() as u32 - 1, self.blocks.len() as u32);
            tree.nodes.iter_mut().for_each(|node| node.shift(nodes, blocks));
            self.nodes[first + i] = tree.nodes[0];
            self.nodes.extend(&tree.nodes[1..]);
            self.blocks.append(&mut tree.blocks);
            self.depth = self.depth.max(1 + tree.depth);
        }
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
            if set.len() > LANES {
                tree.nodes.push(Node::EMPTY);
                builder.node(&mut tree, 0, set, depth);
                tree.depth -= depth - 1;
            } else {
                tree.blocks.push(builder.block(&set));
            }
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
    /// Fills in the node over a set, and adds what is below it.
    ///
    /// Recursion is as deep as the hierarchy, at most [`MAX_DEPTH`].
    fn node(&self, tree: &mut Tree, number: usize, set: Set, depth: usize) {
        tree.depth = tree.depth.max(depth);
        let parts = self.divide(set, depth);
        let inner = parts.iter().take_while(|part| part.len() > LANES).count();
        let first = tree.nodes.len();
        let mut node = Node::new(inner, first, tree.blocks.len());
        parts.iter().for_each(|part| node.push(&part.bounds));
        tree.nodes[number] = node;
        tree.nodes.resize(first + inner, Node::EMPTY);
        tree.blocks.extend(parts[inner..].iter().map(|part| self.block(part)));
        for (i, part) in parts.into_iter().take(inner).enumerate() {
            self.node(tree, first + i, part, depth + 1);
        }
    }

    fn block(&self, set: &Set) -> Block {
        Block::of(set.order.iter().map(|&i| &self.triangles[i as usize]))
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
