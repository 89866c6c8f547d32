//! The stiff and extreme cases of `shared/cases`, each a test by its id: small letters, and `_` for
//! what no name may hold. Of the 31, those that a form factor or a matrix alone can answer are
//! `form_factors` beside this folder and `radiosity-core/tests/integration/matrix`; `catalogue`
//! finds the one that is missing.

mod catalogue;
mod files;
mod light;
pub(crate) mod model;
mod reflectance;
mod shape;
mod walls;
