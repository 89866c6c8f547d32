#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod census;
mod config;
mod energy;
mod executor;
pub mod mesh;
mod observer;
mod reconstruct;
mod shooting;

pub use census::{Census, Fate};
pub use config::{Correction, Exchange, MeshConfig, ShootingConfig, StopRule};
pub use energy::{Ledger, RgbSum, Sum};
pub use executor::{Executor, Sequential};
pub use mesh::Mesh;
pub use observer::{Control, Observer, StepReport};
pub use shooting::{DIVERGED, Gathered, Remaining, Shooting, StopReason};
