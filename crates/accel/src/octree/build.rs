//! Breadth-first subdivision of a cube.

use glam::DVec3;

use super::boxes::Boxes;
use super::overlap::Candidate;
use super::{CELL_PADDING, Cell, DEPTH_LIMIT, INNER, Octree, OctreeConfig};
use crate::aabb::Aabb;
use crate::block::LANES;
use crate::frame::{CLIP_MARGIN, Frame, LocalTriangle};

/// The work of stepping through a leaf, in tests of four triangles: found with the binary
/// `occlusion-bench`; 1 costs memory, 4 is a little slower.
///
/// A ray that crosses a cube crosses each of its eight children with chance 1/4, two on average.
/// With s for the step and b, b₁ … b₈ for the blocks of four triangles in the cell and its
/// children, the children are expected to cost 2 s + Σ bᵢ / 4 and the cell costs s + b: a split
/// pays if Σ bᵢ + 4 s < 4 b. It ends by itself where triangles cannot be parted.
const STEP_COST: usize = 2;

/// The reciprocal of the chance that a ray crosses a given child; see [`STEP_COST`].
const CHILD_ODDS: usize = 4;

/// A cell waiting to be split: its place in `cells`, centre and list.
struct Pending {
    cell: usize,
    centre: DVec3,
    list: Vec<u32>,
}

pub(super) fn build(frame: Frame, kept: Vec<LocalTriangle>, config: &OctreeConfig) -> Octree {
    // Rounded up to a multiple of 1/64, so that faces are exact, and with the clip margin inside,
    // so that every prepared segment starts in the root cell.
    let half = ((frame.half_extent() + CLIP_MARGIN) / CLIP_MARGIN).ceil() * CLIP_MARGIN;
    let candidates: Vec<Candidate> = kept.iter().map(|t| Candidate::of(&t.vertices)).collect();
    let count = kept.len();
    let mut octree = Octree {
        frame,
        half: half as f32,
        depth: 0,
        cells: vec![Cell { first: 0, count: 0 }],
        boxes: Vec::new(),
        groups: Vec::new(),
        blocks: Vec::new(),
        triangles: kept,
    };
    // Breadth first, so that the budget is spent on large cells before small ones.
    let mut budget = count.saturating_mul(config.max_references.max(1));
    let list = (0..count as u32).collect();
    let mut level = vec![Pending { cell: 0, centre: DVec3::ZERO, list }];
    budget -= count;
    for depth in 0..=config.max_depth.min(DEPTH_LIMIT) {
        let last = depth == config.max_depth.min(DEPTH_LIMIT);
        let quarter = half / f64::from(2_u32 << depth);
        let mut next = Vec::new();
        for pending in level {
            let parts = (!last && pending.list.len() > config.leaf_size)
                .then(|| split(&candidates, &pending, quarter))
                .filter(|parts| pays(pending.list.len(), parts, budget));
            let Some(parts) = parts else {
                octree.set_leaf(&pending, half / f64::from(1_u32 << depth));
                continue;
            };
            let total: usize = parts.iter().map(Vec::len).sum();
            budget -= total - pending.list.len(); // each triangle is in one child at least
            let first = octree.cells.len();
            octree.cells[pending.cell] = Cell { first: first as u32, count: INNER };
            octree.cells.extend([Cell { first: 0, count: 0 }; 8]);
            octree.depth = depth + 1;
            for (child, list) in parts.into_iter().enumerate().filter(|(_, l)| !l.is_empty()) {
                let centre = child_centre(pending.centre, quarter, child);
                next.push(Pending { cell: first + child, centre, list });
            }
        }
        level = next;
    }
    assert!(octree.cells.len() < INNER as usize && octree.blocks.len() < INNER as usize);
    octree.set_boxes();
    octree.cells.shrink_to_fit();
    octree.groups.shrink_to_fit();
    octree.blocks.shrink_to_fit();
    octree
}

impl Octree {
    fn set_leaf(&mut self, pending: &Pending, half: f64) {
        // Faces are exact in f32.
        let [lo, hi] = [-half, half].map(|h| (pending.centre + h).as_vec3a());
        self.cells[pending.cell] = self.pack(&pending.list, &Aabb { lo, hi });
    }

    /// Bounds what each cell holds.
    fn set_boxes(&mut self) {
        let mut bounds = vec![Aabb::EMPTY; self.cells.len()];
        // Children come after their parents.
        for index in (0..self.cells.len()).rev() {
            let cell = self.cells[index];
            let mut joined = Aabb::EMPTY;
            if cell.count == INNER {
                bounds[cell.first as usize..][..8].iter().for_each(|child| joined.join(child));
            } else {
                self.groups(cell).iter().for_each(|group| joined.join(&group.boxes.hull()));
            }
            bounds[index] = joined;
        }
        let families = bounds[1..].chunks_exact(8);
        self.boxes = families.map(|family| [&family[..4], &family[4..]].map(Boxes::of)).collect();
    }
}

/// The centre of child `child`: bit 0 of the number chooses the half in x, bit 1 in y, bit 2 in z.
pub(super) fn child_centre(centre: DVec3, quarter: f64, child: usize) -> DVec3 {
    let sign = |bit: usize| if child >> bit & 1 == 1 { quarter } else { -quarter };
    centre + DVec3::new(sign(0), sign(1), sign(2))
}

/// The triangles of `pending` by child; `quarter` is half the side of a child.
fn split(candidates: &[Candidate], pending: &Pending, quarter: f64) -> [Vec<u32>; 8] {
    let half = DVec3::splat(quarter + CELL_PADDING);
    let mut parts = [(); 8].map(|()| Vec::new());
    for (child, part) in parts.iter_mut().enumerate() {
        let centre = child_centre(pending.centre, quarter, child);
        part.extend(
            pending.list.iter().filter(|&&t| candidates[t as usize].touches(centre, half)).copied(),
        );
    }
    parts
}

/// Whether a split lessens the expected work and the longer lists stay within the budget.
fn pays(parent: usize, parts: &[Vec<u32>; 8], budget: usize) -> bool {
    let references: usize = parts.iter().map(Vec::len).sum();
    let blocks: usize = parts.iter().map(|part| part.len().div_ceil(LANES)).sum();
    blocks + CHILD_ODDS * STEP_COST < CHILD_ODDS * parent.div_ceil(LANES)
        && references <= parent + budget
}
