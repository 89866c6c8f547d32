#![doc = include_str!("../README.md")]
#![deny(unsafe_code)]

mod aabb;
mod batch;
mod block;
mod brute_force;
pub mod bvh;
mod frame;
mod hit;
mod lanes;
mod local;
#[cfg(test)]
mod near_miss;
mod nothing;
mod occluder;
pub mod octree;
pub mod proof;
mod segment;
mod simd;
mod triangle;

pub use brute_force::{BruteForce, BruteForceConfig};
pub use bvh::{Bvh, BvhConfig};
pub use frame::{ROUNDING_BAND_ULPS, rounding_band};
pub use hit::Hit;
pub use nothing::Nothing;
pub use occluder::Occluder;
pub use octree::{Octree, OctreeConfig};
pub use proof::{Outlook, Proofs, Proven, Sight};
pub use segment::{NO_TRIANGLE, Segment, Target};
pub use simd::Width;
