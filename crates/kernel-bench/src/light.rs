//! Kernels of the shooting: one step, and what is done once a mesh: census, second estimate and
//! solution.

use std::num::NonZero;

use accel::{Nothing, Occluder, Octree, OctreeConfig, Width};
use radiosity_core::{
    Census, Exchange, Mesh, MeshConfig, Schedule, Sequential, Shooting, ShootingConfig,
};
use scene::Scene;

use crate::count::count;
use crate::occlusion::bvh;
use crate::scenes;

/// Elements of a mesh that a step lights.
const ELEMENTS: usize = 4000;

/// Elements whose exitance is worked out, and those that a census looks around from: one takes
/// some 100 instructions an element, the other 30,000.
const MANY: usize = 8000;
const FEW: usize = 1000;

/// Points at which the second estimate is taken, and the steps before.
const POINTS: usize = 8;
const STEPS: usize = 40;

/// Form factors of a step without occluders: estimators, and what arrived taken in.
pub(crate) fn step_clear() -> f64 {
    step(&mesh(ELEMENTS), &Nothing, Schedule::Single)
}

/// The same with four shooters that light together.
pub(crate) fn step_clear_4() -> f64 {
    let four = NonZero::new(4).expect("4 is not 0");
    step(&mesh(ELEMENTS), &Nothing, Schedule::Multi(four))
}

pub(crate) fn step_bvh() -> f64 {
    let bvh = bvh(&scenes::triangles(&scene()), Width::Four);
    step(&mesh(ELEMENTS), &bvh, Schedule::Single)
}

pub(crate) fn step_octree() -> f64 {
    let octree = Octree::build(&scenes::triangles(&scene()), &OctreeConfig::default());
    step(&mesh(ELEMENTS), &octree, Schedule::Single)
}

/// Shares of the patches' sampled light that stay in the room, summed.
pub(crate) fn census() -> f64 {
    let (scene, mesh) = (scene(), mesh(FEW));
    let bvh = bvh(&scenes::triangles(&scene), Width::Four);
    let census = count(|| Census::take(&scene, &mesh, &bvh, Exchange::OneSided, &Sequential));
    census.fates().map(|fate| 1.0 - fate.escapes - fate.meets_back).sum()
}

/// Sums of form factors at some points, estimated a second time: what a statement costs.
pub(crate) fn second_estimate() -> f64 {
    let (mesh, none) = (mesh(ELEMENTS), Census::default());
    let bvh = bvh(&scenes::triangles(&scene()), Width::Four);
    let mut shooting = Shooting::new(&mesh, &bvh, &none, &Sequential, config(Schedule::Single));
    for _ in 0..STEPS {
        shooting.step();
    }
    let all = mesh.points().len();
    let which: Vec<u32> = (0..POINTS).map(|i| (i * all / POINTS) as u32).collect();
    count(|| shooting.gather(&which)).iter().map(|gathered| gathered.row).sum()
}

/// Elements whose irradiance is turned into exitance, of their own and of their corners.
pub(crate) fn solution() -> f64 {
    let (mesh, none) = (mesh(MANY), Census::default());
    let mut shooting = Shooting::new(&mesh, &Nothing, &none, &Sequential, config(Schedule::Single));
    shooting.step();
    count(|| shooting.solution()).elements.len() as f64
}

/// Form factors of the first step, in which a patch of the lamp shoots. No census is taken: a step
/// only looks up what it found.
fn step(mesh: &Mesh, occluder: &dyn Occluder, schedule: Schedule) -> f64 {
    let none = Census::default();
    let mut shooting = Shooting::new(mesh, occluder, &none, &Sequential, config(schedule));
    count(|| shooting.step());
    shooting.report().form_factors as f64
}

fn config(schedule: Schedule) -> ShootingConfig {
    ShootingConfig { schedule, ..ShootingConfig::until(1e-3) }
}

/// Boards enough that a structure has something to find: 114 triangles.
fn scene() -> Scene {
    scenes::room(scenes::WIDE, 7)
}

fn mesh(elements: usize) -> Mesh {
    Mesh::from_scene(&scene(), &MeshConfig::with_elements(elements))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_lights_the_room() {
        let points = mesh(ELEMENTS).points().len() as f64;
        // The boards' points and the lamp's face up or lie in its plane; all others see it.
        assert!(step_clear() > 0.8 * points, "{} of {points}", step_clear());
        assert!(step_clear_4() > 2.0 * step_clear());
        // No structure changes what is asked.
        assert_eq!(step_bvh(), step_octree());
    }

    /// The room is closed: no light leaves it, and some meets the backs of boards.
    #[test]
    fn light_stays_in_the_room() {
        let share = census() / mesh(FEW).patches().len() as f64;
        assert!((0.5..1.0).contains(&share), "{share}");
    }

    /// A point's form factors to fronts sum to 1, less those to backs.
    #[test]
    fn the_second_estimate_sees_the_room() {
        let mean = second_estimate() / POINTS as f64;
        assert!((0.5..1.02).contains(&mean), "{mean}");
        assert_eq!(solution(), mesh(MANY).elements().len() as f64);
    }
}
