//! Every variant, built.

use accel::Occluder;

use super::switches::VARIANTS;
use super::walk::Specimen;
use crate::Triangle;

type Build = fn(&[Triangle]) -> Box<dyn Occluder>;

fn specimen<const V: usize>(triangles: &[Triangle]) -> Box<dyn Occluder> {
    Box::new(Specimen::<V>::build(triangles))
}

/// By the numbers of [`VARIANTS`].
const BUILDS: [Build; VARIANTS.len()] = [
    specimen::<0>,
    specimen::<1>,
    specimen::<2>,
    specimen::<3>,
    specimen::<4>,
    specimen::<5>,
    specimen::<6>,
    specimen::<7>,
    specimen::<8>,
    specimen::<9>,
    specimen::<10>,
    specimen::<11>,
    specimen::<12>,
    specimen::<13>,
    specimen::<14>,
    specimen::<15>,
    specimen::<16>,
    specimen::<17>,
    specimen::<18>,
    specimen::<19>,
    specimen::<20>,
    specimen::<21>,
    specimen::<22>,
];

/// Builds a variant by its number.
pub(super) fn build(variant: usize, triangles: &[Triangle]) -> Box<dyn Occluder> {
    BUILDS[variant](triangles)
}

/// The number of a variant.
pub(super) fn number(name: &str) -> Option<usize> {
    VARIANTS.iter().position(|variant| variant.name == name)
}
