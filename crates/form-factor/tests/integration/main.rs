//! Form factors of polygon pairs against closed forms, laws and independent integrals.

mod closed_forms;
mod degenerate;
mod laws;
mod occluded;

use form_factor::Polygon;
use glam::DVec3;

/// A polygon from coordinates.
fn polygon<const N: usize>(corners: [[f64; 3]; N]) -> Polygon {
    Polygon::new(&corners.map(DVec3::from)).expect("a convex polygon")
}

/// The rectangle of `x` by `y` at height `z`, its front upwards.
fn floor(x: [f64; 2], y: [f64; 2], z: f64) -> Polygon {
    polygon([[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]])
}

/// The same, its front downwards.
fn ceiling(x: [f64; 2], y: [f64; 2], z: f64) -> Polygon {
    polygon([[x[0], y[0], z], [x[0], y[1], z], [x[1], y[1], z], [x[1], y[0], z]])
}

/// The polygon with each corner moved.
fn moved(polygon: &Polygon, to: impl Fn(DVec3) -> DVec3) -> Polygon {
    let corners: Vec<_> = polygon.corners().iter().map(|&corner| to(corner)).collect();
    Polygon::new(&corners).expect("moving keeps a polygon convex")
}

/// Numbers in 0..1 that look random (xorshift, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number() - 0.5, self.number() - 0.5, self.number() - 0.5)
    }

    /// A triangle of size 1 around a place.
    fn triangle(&mut self, at: DVec3) -> Polygon {
        loop {
            let corners = [(); 3].map(|()| at + self.vector());
            if let Some(triangle) = Polygon::triangle(corners) {
                return triangle;
            }
        }
    }
}
