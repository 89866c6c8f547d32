//! Where elements must be smaller than elsewhere: round lamps that are small beside them.
//!
//! A lamp lights a spot about as wide as the lamp and its distance. While the elements there
//! are wider, what the spot reflects starts from the wrong places, and finer meshes that still do
//! not resolve the spot agree on the wrong answer: their difference says nothing of it. So the
//! mesh looks at the lamps before any light is shot. An edge wider than the spot around it counts
//! as longer than it is, by the square root of the light there over that of a place far from
//! all lamps.

use std::f64::consts::PI;

use glam::DVec3;
use rustc_hash::FxHashMap;
use scene::VertexId;

use super::{Root, triangle_area};

/// Only so many lamps are looked at, those of the most power first: time is edges times lamps.
const MOST_LAMPS: usize = 64;

/// The lamps that elements may have to be small around.
#[derive(Debug, Default)]
pub(super) struct Grade {
    lamps: Vec<Lamp>,
}

/// Cosine of the angle between normals of one plane: half a degree.
const ONE_PLANE: f64 = 0.99996;

/// Emitting roots that hang together by their vertices.
#[derive(Clone, Copy, Debug)]
struct Lamp {
    centre: DVec3,
    /// Largest distance of a corner from the centre.
    radius: f64,
    /// Half the side of a square of its area: how narrow its light can be.
    half_side: f64,
    /// The normal of its plane, if it lies in one and shines to one side: nothing behind it is lit.
    normal: Option<DVec3>,
    /// Its power over that of all lamps, times the area of the whole scene over π: the
    /// irradiance at a unit distance over the mean.
    light: f64,
}

impl Grade {
    /// Finds the lamps among the roots.
    pub(super) fn of(vertices: &[DVec3], roots: &[Root], corners: &[[VertexId; 3]]) -> Self {
        let place = |c: &[VertexId; 3]| c.map(|v| vertices[v.index()]);
        let emitting: Vec<usize> =
            (0..roots.len()).filter(|&r| roots[r].emittance.max_channel() > 0.0).collect();
        let parts = connected(&emitting, corners);
        let mut sums: Vec<Sum> = Vec::new();
        for (&root, part) in emitting.iter().zip(parts) {
            let normal = roots[root].normal;
            if part == sums.len() {
                sums.push(Sum { normal: Some(normal), ..Sum::default() });
            }
            let sum = &mut sums[part];
            let area = triangle_area(place(&corners[root]));
            sum.power += area * roots[root].emittance.max_channel();
            sum.area += area;
            sum.points.extend(place(&corners[root]));
            sum.normal = sum.normal.filter(|n| n.dot(normal) > ONE_PLANE);
        }
        let power: f64 = sums.iter().map(|sum| sum.power).sum();
        let area: f64 = corners.iter().map(|c| triangle_area(place(c))).sum();
        // The stable sort keeps the order of the scene among lamps alike.
        sums.sort_by(|a, b| b.power.total_cmp(&a.power));
        let of_unit_power = area / (PI * power);
        let lamps = sums.iter().take(MOST_LAMPS).map(|sum| sum.lamp(of_unit_power));
        Self { lamps: lamps.collect() }
    }

    /// The squared length that the edge between two places counts for.
    pub(super) fn squared_length(&self, p: DVec3, q: DVec3) -> f64 {
        let squared = (q - p).length_squared();
        let length = squared.sqrt();
        let mut light = 1.0;
        for lamp in &self.lamps {
            // The nearest of three places of the edge: the light may be at either end.
            let nearest = [p, q, p.midpoint(q)]
                .into_iter()
                .filter(|x| lamp.normal.is_none_or(|n| n.dot(*x - lamp.centre) > 0.0))
                .map(|x| x.distance_squared(lamp.centre))
                .reduce(f64::min);
            let Some(nearest) = nearest else { continue };
            let spot = (nearest.sqrt() - lamp.radius).max(lamp.half_side);
            let unresolved = (length / (4.0 * spot)).min(1.0).powi(2);
            light += unresolved * lamp.light / (spot * spot);
        }
        squared * light
    }
}

/// What becomes a lamp.
#[derive(Default)]
struct Sum {
    power: f64,
    area: f64,
    points: Vec<DVec3>,
    normal: Option<DVec3>,
}

impl Sum {
    fn lamp(&self, of_unit_power: f64) -> Lamp {
        let centre = self.points.iter().sum::<DVec3>() / self.points.len() as f64;
        let radius = self.points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
        let (half_side, light) = (0.5 * self.area.sqrt(), self.power * of_unit_power);
        Lamp { centre, radius, half_side, normal: self.normal, light }
    }
}

/// Numbers the parts of `roots` that hang together by vertices, in the order of their first root.
fn connected(roots: &[usize], corners: &[[VertexId; 3]]) -> Vec<usize> {
    let mut first_at: FxHashMap<VertexId, usize> = FxHashMap::default();
    let mut leader: Vec<usize> = (0..roots.len()).collect();
    fn find(leader: &mut [usize], mut i: usize) -> usize {
        while leader[i] != i {
            leader[i] = leader[leader[i]];
            i = leader[i];
        }
        i
    }
    for (i, &root) in roots.iter().enumerate() {
        for vertex in corners[root] {
            let other = *first_at.entry(vertex).or_insert(i);
            let (a, b) = (find(&mut leader, other), find(&mut leader, i));
            leader[a.max(b)] = a.min(b);
        }
    }
    let mut number: FxHashMap<usize, usize> = FxHashMap::default();
    (0..roots.len())
        .map(|i| {
            let next = number.len();
            *number.entry(find(&mut leader, i)).or_insert(next)
        })
        .collect()
}
