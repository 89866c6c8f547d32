#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(any(feature = "exr", feature = "glb", feature = "png"))]
mod basis;
#[cfg(any(feature = "exr", feature = "png"))]
pub mod camera;
mod check;
pub mod compare;
pub mod csv;
mod error;
mod file;
mod format;
#[cfg(feature = "glb")]
mod glb;
#[cfg(feature = "matrix")]
pub mod matrix;
mod options;
#[cfg(any(feature = "exr", feature = "png"))]
pub mod picture;
mod ply;
pub mod tone;
mod tri;
mod unlit;
mod vtu;
mod weld;

pub use compare::{Comparison, compare};
pub use error::{Error, ErrorKind};
pub use file::{Written, replace_file, write, write_file};
pub use format::Format;
#[cfg(feature = "glb")]
pub use glb::lit::check as check_document;
pub use options::Options;
pub use tone::Exposure;
pub use unlit::unlit;
