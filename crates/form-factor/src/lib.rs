#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod kernel;
mod lambert;
mod rule;

pub use kernel::{centroid_kernel, three_point_kernel};
pub use lambert::{Clipped, lambert};
pub use rule::Rule;
