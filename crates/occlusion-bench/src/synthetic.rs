//! Scenes made in code, of any size and the same on every machine.

use glam::{DVec3, dvec3};

use crate::Triangle;
use crate::rng::Rng;

/// Half the side of the cube in which a soup triangle's corners lie, for a soup of a million: a
/// segment as long as the unit cube then has a chance of about one half to pass.
const SOUP_HALF: f64 = 0.0025;

/// The hills' greatest height over the terrain's width, shared out over the octaves by halves.
const HILLS: f64 = 0.15;

/// The terrain lies in a bowl that rises by this times the square of the distance from its middle:
/// without it hardly any slope sees another.
const BOWL: f64 = 1.0;

/// Octaves of noise: the finest has a period of 2⁻⁷ of the width, a few quads of a million.
const OCTAVES: u32 = 6;

/// Small triangles of random place and shape in a unit cube, in random order: no two neighbours in
/// the list are neighbours in space.
///
/// Their size shrinks with their number so that a segment is blocked about as often.
pub fn soup(count: usize) -> Vec<Triangle> {
    let mut rng = Rng(1);
    let half = SOUP_HALF * (1e6 / count.max(1) as f64).sqrt();
    (0..count)
        .map(|_| {
            let centre = rng.point(DVec3::ZERO, DVec3::ONE);
            [(); 3].map(|()| centre + half * rng.point(DVec3::NEG_ONE, DVec3::ONE))
        })
        .collect()
}

/// Hills in a bowl: a square grid of about `count` triangles, row by row, over value noise of six
/// octaves.
pub fn terrain(count: usize) -> Vec<Triangle> {
    let n = ((count as f64 / 2.0).sqrt().round() as usize).max(1);
    let at = |i: usize, j: usize| {
        let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
        dvec3(x, y, height(x, y))
    };
    let mut triangles = Vec::with_capacity(2 * n * n);
    for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles
}

fn height(x: f64, y: f64) -> f64 {
    let hills: f64 = (0..OCTAVES)
        .map(|octave| {
            let scale = f64::from(4_u32 << octave);
            HILLS * 0.5_f64.powi(octave as i32 + 1) * noise(x * scale, y * scale, octave)
        })
        .sum();
    hills + BOWL * ((x - 0.5).powi(2) + (y - 0.5).powi(2))
}

/// Value noise: random heights in [0, 1) at whole numbers, smoothly joined.
fn noise(x: f64, y: f64, octave: u32) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (smooth(x - i), smooth(y - j));
    let corner = |di: f64, dj: f64| {
        let key = (u64::from(octave) << 40) | (((j + dj) as u64) << 20) | (i + di) as u64;
        Rng(key).unit()
    };
    let along = |dj: f64| corner(0.0, dj) * (1.0 - u) + corner(1.0, dj) * u;
    along(0.0) * (1.0 - v) + along(1.0) * v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_quads_share_their_corners() {
        let terrain = terrain(2 * 16 * 16);
        assert_eq!(terrain.len(), 512);
        // The right edge of the first quad is the left edge of the second.
        assert_eq!((terrain[0][1], terrain[0][2]), (terrain[2][0], terrain[3][2]));
        assert!(terrain.iter().all(|t| (t[1] - t[0]).cross(t[2] - t[0]).z > 0.0));
    }

    #[test]
    fn the_soup_stays_in_its_cube() {
        let half = SOUP_HALF * 1e3; // of a thousandth as many triangles squared
        assert_eq!(soup(1).len(), 1);
        assert!(soup(1)[0].iter().all(|p| p.min_element() > -half && p.max_element() < 1.0 + half));
    }
}
