//! How much an eye sees, judged on a small picture of the input triangles.

use scene::Camera;

use super::Facet;
use crate::picture::{ScreenTriangle, View};

/// Enough to see furniture, cheap enough for a dozen eyes.
const SIZE: (u32, u32) = (96, 72);
/// Surfaces nearer than this share of the scene's diagonal stand in the way.
const NEAR_SHARE: f64 = 0.06;
/// One triangle over more than this share of the picture leaves little to see.
const DOMINANT_SHARE: f64 = 0.4;
/// What seeing every triangle is worth, against a picture full of fronts.
const VARIETY: f64 = 0.5;
/// What a lamp in the picture is worth.
const LAMP: f64 = 0.1;
/// What a picture full of backs costs an eye inside the bounds: they are not drawn, so
/// it stands in or behind something that then looks cut open.
const BACK_COST: f64 = 2.0;
/// What standing outside the bounds of a room costs.
const OUTSIDE_COST: f64 = 0.1;

const NOTHING: usize = usize::MAX;

#[derive(Clone, Copy)]
struct Cell {
    /// Of the nearest front.
    inverse_depth: f64,
    facet: usize,
    /// Of the nearest back.
    back: f64,
}

/// Larger is better: fronts seen and triangles told apart, less backs, what is too near
/// and what fills the picture.
pub(super) fn score(camera: &Camera, facets: &[Facet], diagonal: f64, inside: bool) -> f64 {
    let Ok(view) = View::new(camera, SIZE) else {
        return f64::NEG_INFINITY;
    };
    let cells = draw(&view, facets);
    let whole = cells.len() as f64;
    let share =
        |good: &dyn Fn(&Cell) -> bool| cells.iter().filter(|c| good(c)).count() as f64 / whole;
    let near = 1.0 / (NEAR_SHARE * diagonal);
    let mut seen: Vec<usize> = cells.iter().map(|c| c.facet).filter(|f| *f != NOTHING).collect();
    seen.sort_unstable();
    let lamp = seen.iter().any(|f| facets[*f].power > 0.0);
    let runs = seen.chunk_by(|a, b| a == b);
    let (distinct, largest) =
        runs.fold((0, 0), |(count, largest), run| (count + 1, largest.max(run.len())));
    let variety = f64::from(1 + distinct).ln() / (1.0 + facets.len() as f64).ln().max(1.0);
    let place_cost =
        if inside { BACK_COST * share(&|c| c.back > c.inverse_depth) } else { OUTSIDE_COST };
    share(&|c| c.facet != NOTHING) + VARIETY * variety + if lamp { LAMP } else { 0.0 }
        - place_cost
        - share(&|c| c.inverse_depth > near)
        - (largest as f64 / whole - DOMINANT_SHARE).max(0.0)
}

/// The nearest front of each cell, and the nearest back.
fn draw(view: &View, facets: &[Facet]) -> Vec<Cell> {
    let empty = Cell { inverse_depth: 0.0, facet: NOTHING, back: 0.0 };
    let mut cells = vec![empty; (SIZE.0 * SIZE.1) as usize];
    for (facet, f) in facets.iter().enumerate() {
        ScreenTriangle::project(view, f.corners, [[0.0; 3]; 3], |triangle| {
            let front = f.both_sides || triangle.faces_the_eye();
            triangle.cover(view, 0..SIZE.1 as usize, |hit| {
                let cell = &mut cells[hit.row * SIZE.0 as usize + hit.column];
                if !front {
                    cell.back = cell.back.max(hit.inverse_depth);
                } else if hit.inverse_depth > cell.inverse_depth {
                    (cell.inverse_depth, cell.facet) = (hit.inverse_depth, facet);
                }
            });
        });
    }
    cells
}
