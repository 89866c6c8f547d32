#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod hand_out;
mod pool;
mod schedule;

pub use error::{Error, ParseLoopError};
pub use pool::Pool;
pub use schedule::Loop;
