#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod camera;
mod check;
pub mod compare;
pub mod csv;
mod error;
mod file;
mod format;
mod glb;
pub mod matrix;
mod options;
pub mod picture;
mod ply;
pub mod tone;
mod tri;
mod unlit;
mod weld;

pub use compare::{Comparison, compare};
pub use error::{Error, ErrorKind};
pub use file::{Written, replace_file, write, write_file};
pub use format::Format;
pub use options::Options;
pub use tone::Exposure;
pub use unlit::unlit;
