//! The z-buffer: what each sample shows, a band of rows at a time.

use scene::{Scene, Solution};

use super::{Layer, Pixel, ScreenTriangle, View};

/// Rows of pixels drawn together: the samples of a band stay in the cache, and memory
/// does not grow with the picture's height.
const BAND: usize = 16;
/// A later element must be nearer by this share of the depth to cover an earlier one:
/// coplanar surfaces then show the first of them, and not a pattern of rounding errors.
const DEPTH_TIE: f64 = 1e-9;

/// What a sample shows so far.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    /// Zero where nothing has been drawn.
    inverse_depth: f64,
    light: [f64; 3],
    emits: bool,
}

struct Piece {
    triangle: ScreenTriangle,
    emits: bool,
}

/// Draws every element that faces the eye; the view's grid has `samples` × `samples`
/// cells a pixel.
pub(super) fn draw(scene: &Scene, solution: &Solution, view: &View, samples: u32) -> Vec<Pixel> {
    let samples = samples as usize;
    let (across, down) = (view.width as usize, view.height as usize);
    let pieces = pieces(scene, solution, view);
    let mut pixels = Vec::with_capacity(across / samples * (down / samples));
    let mut band = vec![Sample::default(); across * samples * BAND];
    for first in (0..down).step_by(samples * BAND) {
        let rows = first..down.min(first + samples * BAND);
        band.fill(Sample::default());
        for piece in &pieces {
            draw_piece(piece, view, rows.clone(), &mut band);
        }
        for top in rows.clone().step_by(samples) {
            let start = (top - first) * across;
            let cells = &band[start..start + samples * across];
            pixels.extend((0..across / samples).map(|i| pixel(cells, across, i, samples)));
        }
    }
    pixels
}

/// The visible sides of all elements, cut and projected once for all bands.
fn pieces(scene: &Scene, solution: &Solution, view: &View) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for element in &solution.elements {
        let emits = scene.material_of(element.triangle).emits();
        let light = element.corner_exitance.map(|l| l.0);
        ScreenTriangle::project(view, solution.corners(element), light, |triangle| {
            if triangle.faces_the_eye() {
                pieces.push(Piece { triangle, emits });
            }
        });
    }
    pieces
}

fn draw_piece(piece: &Piece, view: &View, rows: std::ops::Range<usize>, band: &mut [Sample]) {
    let first = rows.start;
    let [a, b, c] = piece.triangle.light;
    piece.triangle.cover(view, rows, |hit| {
        let sample = &mut band[(hit.row - first) * view.width as usize + hit.column];
        if hit.inverse_depth > sample.inverse_depth * (1.0 + DEPTH_TIE) {
            let [wa, wb, wc] = hit.weights;
            sample.inverse_depth = hit.inverse_depth;
            sample.light = [0, 1, 2].map(|i| wa * a[i] + wb * b[i] + wc * c[i]);
            sample.emits = piece.emits;
        }
    });
}

/// Averages the samples of a pixel, lamps apart from the rest.
fn pixel(cells: &[Sample], across: usize, index: usize, samples: usize) -> Pixel {
    // Sums and counts: of surfaces, of lamps.
    let mut sums = [([0.0; 3], 0u32); 2];
    for row in cells.chunks_exact(across) {
        for sample in &row[index * samples..(index + 1) * samples] {
            if sample.inverse_depth > 0.0 {
                let (sum, count) = &mut sums[usize::from(sample.emits)];
                *count += 1;
                for (channel, light) in sum.iter_mut().zip(sample.light) {
                    *channel += light;
                }
            }
        }
    }
    let layer = |(sum, count): ([f64; 3], u32)| {
        let mean = |c: f64| if count > 0 { (c / f64::from(count)) as f32 } else { 0.0 };
        let share = f64::from(count) / (samples * samples) as f64;
        Layer { light: sum.map(mean), share: share as f32 }
    };
    Pixel { surface: layer(sums[0]), lamp: layer(sums[1]) }
}
