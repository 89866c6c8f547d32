//! The light at places that a caller names.
//!
//! At a single place it is computed there: the place receives every shot, as a mesh's own
//! points do. Over a small area it is the mean of the mesh's light over that area.

use accel::NO_TRIANGLE;
use glam::DVec3;
use scene::{Face, Material, Rgb, Scene, TriangleId};

use crate::mesh::{Mesh, ReceiverPoint};
use crate::needs::Needs;
use crate::reconstruct::Light;

/// A place where a caller wants to know the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Probe {
    /// On the front of an input triangle a b c: a + u (b − a) + v (c − a).
    Surface {
        /// The input triangle.
        triangle: TriangleId,
        /// Barycentric coordinates of b and c; at least 0, and at most 1 in sum.
        uv: [f64; 2],
        /// With an area, the mean is asked for over the part of the triangle of that area around
        /// the place: the one that halving the longest edge leads to.
        area: Option<f64>,
    },
    /// In the open, as a meter is held: nothing is there that blocks or reflects. For such places
    /// nothing that a plan leaves out may be left out, since it knows surfaces alone.
    Free {
        /// Where.
        position: DVec3,
        /// Where it looks, of unit length.
        normal: DVec3,
    },
}

/// Quarterings of a part for its mean: 64 samples.
const QUARTERINGS: u32 = 3;

/// Two edges count as equally long, and an area as reached, within this relative difference:
/// files often give six digits.
const SAME: f64 = 1e-4;

/// A part of a triangle is never halved more often than this: its area is then 2⁻⁶⁴ of it.
const MOST_HALVINGS: u32 = 64;

impl Probe {
    /// The surface that a place is on.
    pub(super) fn material<'a>(&self, scene: &'a Scene) -> Option<&'a Material> {
        match self {
            Self::Surface { triangle, .. } => Some(scene.material_of(*triangle)),
            Self::Free { .. } => None,
        }
    }

    /// The area that the place stands for, if it was given.
    pub(super) fn area(&self) -> Option<f64> {
        match self {
            Self::Surface { area, .. } => *area,
            Self::Free { .. } => None,
        }
    }

    /// Where the shots have to reach, for a single place.
    pub(super) fn receiver(&self, scene: &Scene) -> Option<ReceiverPoint> {
        match *self {
            Self::Surface { area: Some(_), .. } => None,
            Self::Surface { triangle, uv, area: None } => {
                let [a, b, c] = scene.corners(triangle);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                let position = position([a, b, c], uv);
                Some(ReceiverPoint { position, normal, triangle: triangle.0 })
            }
            Self::Free { position, normal } => {
                Some(ReceiverPoint { position, normal, triangle: NO_TRIANGLE })
            }
        }
    }
}

fn position([a, b, c]: [DVec3; 3], [u, v]: [f64; 2]) -> DVec3 {
    a + (b - a) * u + (c - a) * v
}

/// The needs of a scene with probes: means over a surface that reflects nothing in some channel
/// want light there that no other surface does, and what is known of surfaces does not hold in the
/// open.
pub(super) fn needs(needs: Needs, scene: &Scene, probes: &[Probe]) -> Needs {
    let dark = |material: &Material| material.reflectance.min_channel() == 0.0;
    let wants = |p: &Probe| p.area().is_some() && p.material(scene).is_some_and(dark);
    let free = probes.iter().any(|p| matches!(p, Probe::Free { .. }));
    Needs {
        black: needs.black || probes.iter().any(wants),
        segments: needs.segments || free,
        singles: needs.singles || free,
        ..needs
    }
}

/// The irradiance at each probe; `received` is what the receivers among them got, in order.
pub(super) fn irradiance(
    scene: &Scene,
    mesh: &Mesh,
    light: &Light,
    probes: &[Probe],
    received: &[Rgb],
) -> Vec<Rgb> {
    let roots = fronts(mesh, scene.triangles().len());
    let mut received = received.iter();
    let at = |probe: &Probe| {
        let &Probe::Surface { triangle, uv, area: Some(area) } = probe else {
            return received.next().copied().unwrap_or_default();
        };
        let corners = scene.corners(triangle);
        let roots = &roots[triangle.index()];
        let part = part_around(corners, position(corners, uv), area);
        let (mut sum, mut n) = (Rgb::ZERO, 0u32);
        samples(part, QUARTERINGS, &mut |place| {
            if let Some(h) = light_at(mesh, light, roots, place) {
                sum += h;
                n += 1;
            }
        });
        if n > 0 { sum / f64::from(n) } else { Rgb::ZERO }
    };
    probes.iter().map(at).collect()
}

/// The exitance at each probe that a surface is at, of the irradiance there; 0 in the open.
pub(super) fn exitance(scene: &Scene, probes: &[Probe], irradiance: &[Rgb]) -> Vec<Rgb> {
    let leaves = |(probe, h): (&Probe, &Rgb)| match probe.material(scene) {
        Some(material) => material.emittance + material.reflectance * *h,
        None => Rgb::ZERO,
    };
    probes.iter().zip(irradiance).map(leaves).collect()
}

/// The roots of each input triangle's front.
fn fronts(mesh: &Mesh, triangles: usize) -> Vec<Vec<u32>> {
    let mut fronts = vec![Vec::new(); triangles];
    for (i, root) in mesh.roots.iter().enumerate().filter(|(_, r)| r.face == Face::Front) {
        fronts[root.triangle.index()].push(i as u32);
    }
    fronts
}

/// Halves the longest edge of a triangle and goes on with the half around `place`, down to
/// `area`.
fn part_around(mut part: [DVec3; 3], place: DVec3, area: f64) -> [DVec3; 3] {
    let size = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
    for _ in 0..MOST_HALVINGS {
        if size(part) <= area * (1.0 + SAME) {
            break;
        }
        let length = |k: usize| part[k].distance(part[(k + 1) % 3]);
        let longest = (0..3).map(length).fold(0.0, f64::max);
        // The first of edges that are equally long.
        let k = (0..3).find(|&k| length(k) >= longest * (1.0 - SAME)).unwrap_or(0);
        let [p, q, r] = [0, 1, 2].map(|i| part[(k + i) % 3]);
        let middle = p.midpoint(q);
        let normal = (q - p).cross(r - p);
        let beside = (middle - r).cross(place - r).dot(normal);
        let beside_p = (middle - r).cross(p - r).dot(normal);
        part = if beside * beside_p > 0.0 { [p, middle, r] } else { [middle, q, r] };
    }
    part
}

/// The middles of the quarters of quarters of a triangle.
fn samples([a, b, c]: [DVec3; 3], times: u32, at: &mut impl FnMut(DVec3)) {
    if times == 0 {
        return at((a + b + c) / 3.0);
    }
    let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
    for part in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]] {
        samples(part, times - 1, at);
    }
}

/// The mesh's irradiance at a place: linear between the corners, shifted to the element's mean.
fn light_at(mesh: &Mesh, light: &Light, roots: &[u32], place: DVec3) -> Option<Rgb> {
    let inside = |node: u32| {
        let weights = weights(mesh.corners(mesh.nodes[node as usize].vertices), place);
        weights.into_iter().fold(f64::INFINITY, f64::min)
    };
    // Of pieces that share an edge, the one that the place lies deepest in.
    let deepest = |a: u32, b: u32| if inside(b) > inside(a) { b } else { a };
    let mut node = roots.iter().copied().reduce(deepest)?;
    if inside(node) < -SAME {
        // What an earlier surface covers has no light of its own.
        return None;
    }
    while let Some(child) = mesh.nodes[node as usize].children.clone().reduce(deepest) {
        node = child;
    }
    let node = &mesh.nodes[node as usize];
    let element = node.elements.start as usize;
    let weights = weights(mesh.corners(node.vertices), place);
    let corners = mesh.elements[element].points.map(|p| light.shown[p as usize]);
    let linear: Rgb = corners.iter().zip(weights).map(|(h, w)| *h * w).sum();
    let of_corners = corners.into_iter().sum::<Rgb>() / 3.0;
    Some(linear + light.irradiance[element] - of_corners)
}

/// The weights of the corners at a place in their plane.
pub(super) fn weights([a, b, c]: [DVec3; 3], place: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let whole = normal.length_squared();
    let part = |p: DVec3, q: DVec3| (p - place).cross(q - place).dot(normal) / whole;
    [part(b, c), part(c, a), part(a, b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_find_the_place_again() {
        let corners = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 1.0, 0.0), DVec3::Y];
        let place = corners[0] * 0.2 + corners[1] * 0.5 + corners[2] * 0.3;
        let [u, v, w] = weights(corners, place);
        assert!((u - 0.2).abs() + (v - 0.5).abs() + (w - 0.3).abs() < 1e-14);
    }

    #[test]
    fn a_part_is_found_by_halving() {
        // A right isosceles triangle halves into two of its kind: by hand, the half at b.
        let whole = [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0];
        let part = part_around(whole, DVec3::new(1.6, 0.2, 0.0), 1.0);
        assert!(part.contains(&(DVec3::X * 2.0)) && part.contains(&DVec3::new(1.0, 1.0, 0.0)));
        assert_eq!(part_around(whole, DVec3::ZERO, 2.0), whole);
        let mut n = 0;
        let mut sum = DVec3::ZERO;
        samples(whole, QUARTERINGS, &mut |p| (n, sum) = (n + 1, sum + p));
        assert!(n == 64 && (sum / 64.0).distance(DVec3::new(2.0, 2.0, 0.0) / 3.0) < 1e-14);
    }
}
