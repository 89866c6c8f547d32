//! The list of kernels.

use accel::Width;

use crate::{form_factors, light, mesh, occlusion, text};

/// Something small that is done over and over in a solve.
pub(crate) struct Kernel {
    /// The crate it is of, and what is done.
    pub(crate) name: &'static str,
    /// Lanes that it asks for.
    lanes: Width,
    /// Prepares what it needs, does it once through [`count`](crate::count::count), and gives a number that says so.
    pub(crate) run: fn() -> f64,
}

impl Kernel {
    /// On any machine.
    const fn new(name: &'static str, run: fn() -> f64) -> Self {
        Self { name, lanes: Width::Four, run }
    }

    /// Where there is AVX2.
    const fn eight_lanes(name: &'static str, run: fn() -> f64) -> Self {
        Self { name, lanes: Width::Eight, run }
    }

    /// Whether this machine has the lanes.
    pub(crate) fn runs_here(&self) -> bool {
        self.lanes <= Width::widest()
    }
}

/// In the order in which light travels.
pub(crate) const KERNELS: [Kernel; 37] = [
    Kernel::new("tri-io/parse", text::parse),
    Kernel::new("tri-io/parse-long", text::parse_long),
    Kernel::new("tri-io/write", text::write_long),
    Kernel::new("tri-io/float-f32", text::float_f32),
    Kernel::new("tri-io/float-f64", text::float_f64),
    Kernel::new("accel/bvh-build", occlusion::build_bvh),
    Kernel::new("accel/bvh-single", occlusion::single_bvh),
    Kernel::eight_lanes("accel/bvh-single-8", occlusion::single_bvh_8),
    Kernel::new("accel/bvh-batch", occlusion::batch_bvh),
    Kernel::eight_lanes("accel/bvh-batch-8", occlusion::batch_bvh_8),
    Kernel::new("accel/bvh-nearest", occlusion::nearest_bvh),
    Kernel::new("accel/octree-build", occlusion::build_octree),
    Kernel::new("accel/octree-single", occlusion::single_octree),
    Kernel::new("accel/octree-batch", occlusion::batch_octree),
    Kernel::new("form-factor/centroid-far", form_factors::centroid_far),
    Kernel::new("form-factor/centroid-near", form_factors::centroid_near),
    Kernel::new("form-factor/three-points-far", form_factors::three_points_far),
    Kernel::new("form-factor/three-points-near", form_factors::three_points_near),
    Kernel::new("form-factor/lambert-far", form_factors::lambert_far),
    Kernel::new("form-factor/lambert-near", form_factors::lambert_near),
    Kernel::new("form-factor/lambert-cut", form_factors::lambert_cut),
    Kernel::new("form-factor/between-far", form_factors::between_far),
    Kernel::new("form-factor/between-middle", form_factors::between_middle),
    Kernel::new("form-factor/between-near", form_factors::between_near),
    Kernel::new("form-factor/between-touching", form_factors::between_touching),
    Kernel::new("form-factor/between-occluded", form_factors::between_blocked),
    Kernel::new("radiosity-core/mesh-cuts", mesh::cuts),
    Kernel::new("radiosity-core/mesh-growth", mesh::growth),
    Kernel::new("radiosity-core/mesh-grading", mesh::grading),
    Kernel::new("radiosity-core/mesh-refined", mesh::refined),
    Kernel::new("radiosity-core/census", light::census),
    Kernel::new("radiosity-core/step-clear", light::step_clear),
    Kernel::new("radiosity-core/step-clear-4", light::step_clear_4),
    Kernel::new("radiosity-core/step-bvh", light::step_bvh),
    Kernel::new("radiosity-core/step-octree", light::step_octree),
    Kernel::new("radiosity-core/second-estimate", light::second_estimate),
    Kernel::new("radiosity-core/solution", light::solution),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kernel_has_a_name_of_its_own() {
        for (i, one) in KERNELS.iter().enumerate() {
            assert!(KERNELS[..i].iter().all(|other| other.name != one.name), "{}", one.name);
        }
    }

    /// A kernel whose number changes from run to run has no fixed input.
    #[test]
    fn every_kernel_does_the_same_each_time() {
        for kernel in KERNELS.iter().filter(|kernel| kernel.runs_here()) {
            let (once, again) = ((kernel.run)(), (kernel.run)());
            assert!(once > 0.0 && once.to_bits() == again.to_bits(), "{}: {once}", kernel.name);
        }
    }
}
