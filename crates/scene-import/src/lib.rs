#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod assembler;
#[cfg(any(feature = "obj", feature = "gltf"))]
mod beside;
mod diagnostic;
mod error;
#[cfg(feature = "gltf")]
mod gltf;
mod imported;
mod lint;
mod lit;
#[cfg(feature = "obj")]
mod obj;
mod open;
mod options;
mod range;
mod shortened;
#[cfg(any(feature = "obj", feature = "gltf"))]
mod texture;
mod tri;
mod tri_records;
mod units;
mod vs3;

pub use diagnostic::{Diagnostic, DiagnosticKind};
pub use error::{Error, ErrorKind};
pub use imported::{Format, Imported, Summary};
pub use lit::{Lit, open_lit};
pub use open::{open, open_bytes};
pub use options::{Options, SidesRule};
pub use tri_records::tri_records;
