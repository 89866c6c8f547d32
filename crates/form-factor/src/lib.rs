#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod between;
mod clip;
mod contour;
mod corners;
mod cover;
mod edge_pair;
mod estimate;
mod gauss;
mod kernel;
mod kink;
mod lambert;
mod mean;
mod merge;
mod missed;
mod occluded;
mod occluders;
mod pair;
mod piece;
mod polygon;
mod product;
mod rule;
mod search;
mod shadow;
mod shaft;

pub use between::{REFERENCE, between};
pub use estimate::Estimate;
pub use kernel::{centroid_kernel, three_point_kernel};
pub use lambert::{Clipped, lambert};
pub use occluded::{Ask, FLOOR, MOST_POINTS, between_occluded, between_occluded_within};
pub use occluders::Occluders;
pub use polygon::{FLAT, Polygon};
pub use rule::Rule;
