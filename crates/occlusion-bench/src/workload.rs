//! What is asked: the segments of a radiosity solver, and random ones.

use accel::{NO_TRIANGLE, Segment, Target};
use glam::DVec3;

use crate::rng::Rng;
use crate::{Triangle, bounds};

/// How far ends are lifted off their surfaces, as a part of the extent of the occluders: five
/// times what [`accel::rounding_band`] leaves open, so that no structure need be told what to
/// ignore.
pub const LIFT: f64 = 5e-6;

/// Fewest sources that share the segments of a scene: one source alone would measure one view.
const FEWEST_SOURCES: usize = 16;

/// Golden section: its multiples fill [0, 1) evenly whatever their number (Weyl).
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Segments from one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// The end that all segments share.
    pub from: DVec3,
    /// The other ends, in the order of the receivers.
    pub targets: Vec<Target>,
}

/// The triangles that block, and the segments to ask about.
#[derive(Clone, Debug, PartialEq)]
pub struct Workload {
    /// What may block.
    pub occluders: Vec<Triangle>,
    /// From sources to the vertices of the triangles that face them.
    pub shooting: Vec<Batch>,
    /// Between random points in the bounds of the occluders.
    pub random: Vec<Segment>,
}

impl Workload {
    /// Makes `count` segments of each kind, between `receivers` and through `occluders`.
    ///
    /// Sources are centroids of receivers, spread evenly over the list (further points of the same
    /// triangles once all had their turn). A source shoots to the vertices, lifted off the surface
    /// and as far towards the centroid, of the triangles that face it, in the order of the list,
    /// up to a sixteenth of all segments. A list so long that not all of it is reached is entered
    /// at another place by each source. No segment ignores anything.
    pub fn new(occluders: Vec<Triangle>, receivers: &[Triangle], count: usize) -> Self {
        let (lo, hi) = bounds(&occluders).unwrap_or_default();
        let lift = LIFT * (hi - lo).max_element();
        let shooting = shooting(receivers, lift, count);
        let mut rng = Rng(2);
        let random = (0..if occluders.is_empty() { 0 } else { count })
            .map(|_| Segment::new(rng.point(lo, hi), rng.point(lo, hi)))
            .collect();
        Self { occluders, shooting, random }
    }
}

fn shooting(receivers: &[Triangle], lift: f64, count: usize) -> Vec<Batch> {
    let facets: Vec<Facet> = receivers.iter().filter_map(|t| Facet::of(t, lift)).collect();
    let most = count.div_ceil(FEWEST_SOURCES);
    let mut rng = Rng(3);
    let mut batches = Vec::new();
    let mut left = count;
    // A scene in which nothing faces anything ends after one turn of all sources.
    let mut idle = 0;
    for k in 0.. {
        if left == 0 || idle >= facets.len() {
            break;
        }
        let source = (fraction(k as f64 * GOLDEN) * facets.len() as f64) as usize;
        let facet = &facets[source];
        let on_surface = if k < facets.len() { facet.centroid } else { rng.on(&facet.corners) };
        // Another multiple, so that where a source stands says nothing about whom it addresses.
        let first = (fraction(k as f64 * GOLDEN * GOLDEN) * facets.len() as f64) as usize;
        let batch = facet.shoot(on_surface, &facets, first, lift, most.min(left));
        idle = if batch.targets.is_empty() { idle + 1 } else { 0 };
        left -= batch.targets.len();
        if !batch.targets.is_empty() {
            batches.push(batch);
        }
    }
    batches
}

/// A receiver with what the choice of segments needs.
struct Facet {
    corners: Triangle,
    centroid: DVec3,
    normal: DVec3,
    targets: [DVec3; 3],
}

impl Facet {
    /// `None` for a triangle without area.
    fn of(corners: &Triangle, lift: f64) -> Option<Self> {
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a).try_normalize()?;
        let centroid = (a + b + c) / 3.0;
        // Off the triangle's own plane, and off those of the neighbours that meet it at the corner.
        let lifted = |p: DVec3| {
            let inward = centroid - p;
            p + lift * normal + inward * (lift / inward.length()).min(0.5)
        };
        Some(Self { corners: *corners, centroid, normal, targets: corners.map(lifted) })
    }

    /// The segments from a point of this facet to those it faces, from `first` on and around.
    fn shoot(&self, at: DVec3, all: &[Self], first: usize, lift: f64, most: usize) -> Batch {
        let rows = if 3 * all.len() <= most { (0, all.len()) } else { (first, all.len()) };
        let order = (rows.0..rows.1).chain(0..rows.0);
        let mut targets = Vec::new();
        for other in order.map(|i| &all[i]) {
            if targets.len() >= most {
                break;
            }
            if (at - other.centroid).dot(other.normal) <= lift {
                continue;
            }
            for point in other.targets {
                if (point - at).dot(self.normal) > 2.0 * lift && targets.len() < most {
                    targets.push(Target { point, ignore: NO_TRIANGLE });
                }
            }
        }
        Batch { from: at + lift * self.normal, targets }
    }
}

fn fraction(x: f64) -> f64 {
    x - x.floor()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;
    use glam::dvec3;

    fn segments(workload: &Workload) -> usize {
        workload.shooting.iter().map(|batch| batch.targets.len()).sum()
    }

    #[test]
    fn the_same_scene_gives_the_same_segments() {
        let make = || {
            let terrain = synthetic::terrain(2000);
            Workload::new(terrain.clone(), &terrain, 5000)
        };
        assert_eq!(make(), make());
        assert_eq!((segments(&make()), make().random.len()), (5000, 5000));
        assert!(make().shooting.len() >= FEWEST_SOURCES);
        let soup = || Workload::new(synthetic::soup(500), &synthetic::soup(500), 800);
        assert_eq!(soup(), soup());
    }

    /// Two squares face to face: each vertex is reached, lifted, and none of the source's own.
    #[test]
    fn facing_triangles_are_addressed() {
        let p = |x: f64, z: f64| dvec3(x, if x == 0.0 { 0.0 } else { 0.5 }, z);
        let up = [p(0.0, 0.0), p(1.0, 0.0), dvec3(0.0, 1.0, 0.0)];
        let down = [p(0.0, 1.0), dvec3(0.0, 1.0, 1.0), p(1.0, 1.0)];
        let workload = Workload::new(vec![up, down], &[up, down], 6);
        assert_eq!(segments(&workload), 6);
        for batch in &workload.shooting {
            for target in &batch.targets {
                // The planes are a unit apart, and both ends are lifted by 5e-6 of the extent, 1.
                let rise = (target.point.z - batch.from.z).abs();
                assert!((rise - (1.0 - 2.0 * LIFT)).abs() < 1e-12, "{rise}");
            }
        }
    }

    #[test]
    fn what_faces_nothing_asks_nothing() {
        let alone = [dvec3(0.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)];
        assert_eq!(segments(&Workload::new(vec![alone], &[alone], 10)), 0);
        assert!(Workload::new(Vec::new(), &[], 10).random.is_empty());
    }
}
