//! Checks that an octree is what its build promises.

use glam::DVec3;

use super::build::child_centre;
use super::overlap::Candidate;
use super::{CELL_PADDING, INNER, Octree};
use crate::block::LANES;

impl Octree {
    /// Checks that every cell has one parent, that lists do not share entries and are ascending,
    /// and that each leaf lists exactly the triangles that touch it.
    ///
    /// Each triangle is sorted in again from the root, alone and through every cell it touches, and
    /// what is found is compared with the lists. For tests and debugging: it visits everything.
    ///
    /// # Errors
    /// Says which cell or triangle breaks which promise.
    pub fn validate(&self) -> Result<(), String> {
        let mut parents = vec![0_u32; self.cells.len()];
        parents[0] = 1;
        let (mut listed, mut blocks) = (0, 0);
        for (index, &cell) in self.cells.iter().enumerate() {
            if cell.count == INNER {
                for child in cell.first..cell.first + 8 {
                    parents[child as usize] += 1;
                }
                continue;
            }
            listed += cell.count as usize;
            blocks += (cell.count as usize).div_ceil(LANES);
            if !self.list(cell).is_sorted_by(|a, b| a < b) {
                return Err(format!("the list of cell {index} is not ascending"));
            }
        }
        if let Some(cell) = parents.iter().position(|&count| count != 1) {
            return Err(format!("cell {cell} has {} parents, expected 1", parents[cell]));
        }
        if blocks != self.blocks.len() {
            return Err(format!("leaves have {blocks} blocks, expected {}", self.blocks.len()));
        }
        let mut found = 0;
        for local in &self.triangles {
            let triangle = local.index;
            let candidate = Candidate::of(&local.vertices);
            let entries = self.entries(&candidate, local.index)?;
            if entries == 0 {
                return Err(format!("triangle {triangle} is in no leaf, expected one or more"));
            }
            found += entries;
        }
        if found != listed {
            return Err(format!("{listed} entries, expected {found}: a leaf lists a stranger"));
        }
        Ok(())
    }

    /// Counts the leaves that a triangle touches; an error if one does not list it.
    fn entries(&self, candidate: &Candidate, triangle: u32) -> Result<usize, String> {
        let mut waiting = vec![(0_usize, DVec3::ZERO, f64::from(self.half))];
        let mut entries = 0;
        while let Some((index, centre, half)) = waiting.pop() {
            if !candidate.touches(centre, DVec3::splat(half + CELL_PADDING)) {
                continue;
            }
            let cell = self.cells[index];
            if cell.count == INNER {
                for child in 0..8 {
                    let centre = child_centre(centre, half / 2.0, child);
                    waiting.push((cell.first as usize + child, centre, half / 2.0));
                }
            } else if self.list(cell).any(|listed| listed == triangle) {
                entries += 1;
            } else {
                return Err(format!("leaf {index} does not list triangle {triangle}"));
            }
        }
        Ok(entries)
    }
}
