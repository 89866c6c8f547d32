//! Keeping the state of the work and going on from it: a file, or nothing without the feature
//! `checkpoint`.

#[cfg(not(feature = "checkpoint"))]
mod absent;
#[cfg(feature = "checkpoint")]
mod container;
#[cfg(feature = "checkpoint")]
mod file;
#[cfg(feature = "checkpoint")]
mod identity;

#[cfg(not(feature = "checkpoint"))]
pub(crate) use absent::{Identity, Keeper, inconsistent, read};
#[cfg(feature = "checkpoint")]
pub(crate) use file::{Keeper, inconsistent, read};
#[cfg(feature = "checkpoint")]
pub(crate) use identity::Identity;
