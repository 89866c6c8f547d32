#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod case;
mod error;
pub mod shapes;
pub mod shared;
pub mod solve;

pub use case::Case;
pub use error::Error;
pub use shapes::Geometry;
pub use solve::{Engine, Solved, solve};
