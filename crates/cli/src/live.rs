//! The viewer while the work goes on: served on loopback, or nothing without the feature `live`.

#[cfg(not(feature = "live"))]
mod absent;
#[cfg(feature = "live")]
mod exchange;
#[cfg(feature = "live")]
mod request;
#[cfg(feature = "live")]
mod server;
#[cfg(feature = "live")]
mod watched;

#[cfg(not(feature = "live"))]
pub(crate) use absent::Live;
#[cfg(feature = "live")]
pub(crate) use watched::Live;
