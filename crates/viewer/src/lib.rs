#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod frame;
mod page;
mod shown;

pub use error::Error;
pub use frame::frame;
pub use page::{Page, write_live};
pub use shown::{Means, Shown};
