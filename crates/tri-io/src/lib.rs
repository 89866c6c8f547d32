#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod decimal;
mod error;
mod float;
mod lexer;
mod reader;
mod record;
mod writer;

pub use error::{Error, ErrorKind, Expected, Found};
pub use float::{FloatBuffer, write_f32, write_f64};
pub use reader::Reader;
pub use record::TriRecord;
pub use writer::Writer;
