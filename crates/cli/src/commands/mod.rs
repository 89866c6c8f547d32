//! One file per command.

pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod form_factors;
pub(crate) mod plan;
pub(crate) mod solve;
pub(crate) mod verify;
