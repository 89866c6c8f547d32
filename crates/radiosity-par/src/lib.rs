#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod pool;

pub use error::Error;
pub use pool::Pool;
