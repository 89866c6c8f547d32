#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod census;
mod checkpoint;
mod config;
mod energy;
mod executor;
pub mod matrix;
pub mod mesh;
mod needs;
mod observer;
pub mod plan;
mod reconstruct;
mod refine;
mod shooting;

pub use census::{Census, Fate};
pub use checkpoint::{Checkpoint, Inconsistent, Kept};
pub use config::{Correction, Exchange, MeshConfig, Schedule, ShootingConfig, Split, StopRule};
pub use energy::{Ledger, RgbSum, Sum};
pub use executor::{Executor, Sequential};
pub use mesh::{Element, Mesh, Node, Patch, ReceiverPoint, Root};
pub use needs::{Channels, Needs};
pub use observer::{Control, LevelReport, Observer, Stage, StepReport, Stopper};
pub use plan::{Plan, PlanConfig};
pub use refine::{
    Asked, Parts, Probe, Reached, RefineConfig, Refined, Stated, Statement, refine, resume,
};
pub use shooting::{DIVERGED, Gathered, Remaining, Shooting, StopReason};
