#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod case;
pub mod cie171;
mod error;
pub mod howell;
pub mod shapes;
pub mod shared;
pub mod solve;
pub mod verify;

pub use case::Case;
pub use error::Error;
pub use shapes::Geometry;
pub use solve::{Engine, Solved, solve};
