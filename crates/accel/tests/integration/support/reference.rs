//! An independent answer: signed volumes in f64 on the original coordinates, with error bounds.

use accel::Segment;
use glam::DVec3;

use super::Triangle;

/// What can be said about a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Clear,
    Blocked,
    /// Moving vertices and ends within the band could change the answer.
    Unsure,
}

/// Tests every triangle; answers that a displacement of all points by `band` could change are
/// `Unsure`.
pub(crate) fn occluded(scene: &[Triangle], segment: &Segment, band: f64) -> Verdict {
    let (lo, hi) = (segment.from.min(segment.to), segment.from.max(segment.to));
    let (lo, hi) = (lo - 2.0 * band, hi + 2.0 * band);
    let mut verdict = Verdict::Clear;
    for (index, triangle) in scene.iter().enumerate() {
        let [a, b, c] = *triangle;
        let apart = a.min(b).min(c).cmpgt(hi).any() || a.max(b).max(c).cmplt(lo).any();
        if apart || segment.ignore.contains(&(index as u32)) {
            continue;
        }
        match crosses(triangle, segment.from, segment.to, band) {
            Verdict::Blocked => return Verdict::Blocked,
            Verdict::Unsure => verdict = Verdict::Unsure,
            Verdict::Clear => {}
        }
    }
    verdict
}

/// The segment crosses the triangle if its ends are on different sides of the plane and its line
/// passes all three edges on the same side: five signed volumes.
fn crosses(t: &Triangle, from: DVec3, to: DVec3, band: f64) -> Verdict {
    let ends = [volume(from, t[0], t[1], t[2], band), volume(to, t[0], t[1], t[2], band)];
    if ends[0] * ends[1] > 0 {
        return Verdict::Clear;
    }
    let edges = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| volume(from, to, t[i], t[j], band));
    if edges.contains(&1) && edges.contains(&-1) {
        return Verdict::Clear;
    }
    if ends.contains(&0) || edges.contains(&0) { Verdict::Unsure } else { Verdict::Blocked }
}

/// The sign of the volume spanned by four points; 0 if moving each by `band` could change it.
///
/// Moving one point changes the determinant of u, v, w by at most the distance times twice the area
/// of the face opposite to it. With all four moving, the edge vectors change by 2 · band each,
/// which adds terms of second and third order.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3, band: f64) -> i32 {
    let (u, v, w) = (b - a, c - a, d - a);
    let determinant = u.cross(v).dot(w);
    let faces = [u.cross(v), v.cross(w), w.cross(u), (v - u).cross(w - u)];
    let first: f64 = band * faces.map(DVec3::length).iter().sum::<f64>();
    let second = 4.0 * band * band * (u.length() + v.length() + w.length());
    let third = 8.0 * band * band * band;
    if determinant.abs() <= first + second + third { 0 } else { determinant.signum() as i32 }
}
