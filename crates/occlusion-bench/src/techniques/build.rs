//! The build: a tree of lists, then its cells in the order of a layout.

use glam::{Vec3, Vec3A};

use super::layout::{self, Inner};
use super::overlap::Candidate;
use super::switches::Switches;
use super::triangles::Triangles;

/// Halvings of the root, at most: an array of the finest cells takes 8 MB.
pub(super) const MAX_DEPTH: u32 = 7;

/// Lists of this length are not split.
const LEAF_SIZE: usize = 8;

/// A split may make lists this many times longer, altogether.
const MAX_GROWTH: usize = 2;

/// Half the side of the root, whose centre is the origin; triangles lie within [-1, 1].
pub(super) const HALF: f32 = 1.0 + 1.0 / 64.0;

/// How much cells are grown in the build, so that the walk's rounding misses nothing.
const PADDING: f32 = 1.0 / (1 << 17) as f32;

/// A cell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cell {
    /// Where its eight children are; 0 for a leaf.
    pub(super) children: u32,
    /// Its list: where it starts, and how long it is.
    pub(super) list: (u32, u32),
}

/// A cell of the tree, before it has its place.
struct Grown {
    list: Vec<u32>,
    children: Option<[usize; 8]>,
}

/// Builds cells, the root first, and triangles with lists.
pub(super) fn build(switches: Switches, vertices: &[[Vec3; 3]]) -> (Vec<Cell>, Triangles, u32) {
    let candidates: Vec<Candidate> = vertices.iter().map(Candidate::of).collect();
    let mut grower = Grower { switches, candidates, grown: Vec::new(), depth: 0 };
    let all = (0..vertices.len() as u32).collect();
    grower.grow(all, Vec3A::ZERO, 0);
    let (cells, triangles) = arrange(switches, vertices, &grower.grown);
    (cells, triangles, grower.depth)
}

struct Grower {
    switches: Switches,
    candidates: Vec<Candidate>,
    grown: Vec<Grown>,
    depth: u32,
}

impl Grower {
    /// Adds a cell with all below it; returns its number.
    fn grow(&mut self, list: Vec<u32>, centre: Vec3A, depth: u32) -> usize {
        let number = self.grown.len();
        self.depth = self.depth.max(depth);
        self.grown.push(Grown { list: Vec::new(), children: None });
        let Some((stay, parts)) = self.split(&list, centre, depth) else {
            self.grown[number].list = list;
            return number;
        };
        self.grown[number].list = stay;
        let quarter = HALF / (2 << depth) as f32;
        let mut children = [0; 8];
        for (child, part) in parts.into_iter().enumerate() {
            children[child] = self.grow(part, child_centre(centre, quarter, child), depth + 1);
        }
        self.grown[number].children = Some(children);
        number
    }

    /// What stays in the cell, and the lists of its children; `None` for a leaf.
    fn split(&self, list: &[u32], centre: Vec3A, depth: u32) -> Option<(Vec<u32>, [Vec<u32>; 8])> {
        if depth == MAX_DEPTH || list.len() <= LEAF_SIZE {
            return None;
        }
        let quarter = HALF / (2 << depth) as f32;
        let mut parts: [Vec<u32>; 8] = Default::default();
        let mut stay = Vec::new();
        let (reject, short) = (self.switches.reject, self.switches.axes_short_circuit);
        let half = quarter + PADDING;
        if self.switches.leaf_lists {
            for (child, part) in parts.iter_mut().enumerate() {
                let centre = child_centre(centre, quarter, child);
                let touches =
                    |t: &&u32| self.candidates[**t as usize].touches(reject, short, centre, half);
                part.extend(list.iter().filter(touches));
            }
            let longer: usize = parts.iter().map(Vec::len).sum();
            return (longer <= MAX_GROWTH * list.len()).then_some((stay, parts));
        }
        for &triangle in list {
            let holds = |child: &usize| {
                let centre = child_centre(centre, quarter, *child);
                self.candidates[triangle as usize].within(centre, quarter)
            };
            match (0..8).find(holds) {
                Some(child) => parts[child].push(triangle),
                None => stay.push(triangle),
            }
        }
        (stay.len() < list.len()).then_some((stay, parts))
    }
}

/// Bit 0 of a child's number chooses the half in x, bit 1 in y, bit 2 in z.
fn child_centre(centre: Vec3A, quarter: f32, child: usize) -> Vec3A {
    let sign = |bit: usize| if child >> bit & 1 == 1 { quarter } else { -quarter };
    centre + Vec3A::new(sign(0), sign(1), sign(2))
}

/// Gives every cell and list its place.
fn arrange(switches: Switches, vertices: &[[Vec3; 3]], grown: &[Grown]) -> (Vec<Cell>, Triangles) {
    // Inner cells by a number of their own.
    let inner_cells: Vec<usize> =
        (0..grown.len()).filter(|&cell| grown[cell].children.is_some()).collect();
    let mut number = vec![None; grown.len()];
    for (i, &cell) in inner_cells.iter().enumerate() {
        number[cell] = Some(i);
    }
    let children = |cell: usize| grown[cell].children.unwrap_or_default();
    let inner: Inner = inner_cells
        .iter()
        .map(|&cell| children(cell).into_iter().filter_map(|child| number[child]).collect())
        .collect();
    let order = layout::order(&inner, switches.layout);

    let mut place = vec![0; grown.len()];
    for (i, &family) in order.iter().enumerate() {
        for (child, cell) in children(inner_cells[family]).into_iter().enumerate() {
            place[cell] = 1 + 8 * i + child;
        }
    }
    let mut by_place = vec![0; grown.len()];
    for (cell, &place) in place.iter().enumerate() {
        by_place[place] = cell;
    }
    let mut triangles = Triangles::new(vertices, switches.data);
    let cells = by_place
        .iter()
        .map(|&cell| Cell {
            children: grown[cell].children.map_or(0, |children| place[children[0]] as u32),
            list: triangles.add(&grown[cell].list, switches.data),
        })
        .collect();
    (cells, triangles)
}
