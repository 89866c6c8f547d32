//! One file per command.

pub(crate) mod compare;
#[cfg(feature = "manual")]
pub(crate) mod completions;
pub(crate) mod convert;
#[cfg(feature = "form-factors")]
pub(crate) mod form_factors;
#[cfg(feature = "manual")]
pub(crate) mod man;
pub(crate) mod plan;
pub(crate) mod probe_grid;
pub(crate) mod solve;
#[cfg(feature = "verify")]
pub(crate) mod verify;
#[cfg(feature = "html")]
pub(crate) mod view;
