//! Splitting that follows the light, on any number of threads, with any loop and schedule: the same
//! mesh and the same light, to the last bit.
//!
//! A quick run on one scene always; over all scenes, bundled and shared, with every loop and larger
//! meshes, with `SAME_BITS=all cargo test --release -p radiosity-conformance --test all same_bits -- --nocapture`;
//! of one file with its name instead of `all`, as `room`.

use std::num::NonZeroUsize;
use std::path::Path;

use accel::{Bvh, BvhConfig};
use conformance::shared;
use radiosity_core::{
    Asked, Mesh, MeshConfig, RefineConfig, Refined, Schedule, Sequential, ShootingConfig, refine,
};
use radiosity_par::{Loop, Pool};
use scene::Scene;
use scene_import::Options;

const THREADS: [usize; 6] = [1, 2, 3, 5, 8, 24];
const LOOPS: [&str; 6] = ["static", "dynamic:1", "dynamic:7", "guided:1", "guided:4", "tasks"];

/// Refines from 100 elements on, where the light changes.
fn solve(
    scene: &Scene,
    executor: &impl radiosity_core::Executor,
    schedule: Schedule,
    most_elements: usize,
) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let config = ShootingConfig { schedule, ..ShootingConfig::until(1e-2) };
    // The limit ends the work: no error is small enough.
    let refining = RefineConfig { most_elements, ..RefineConfig::until(Asked::Error(1e-9)) };
    refine(scene, &bvh, &bvh, executor, config, refining, &[], &mut ())
}

/// Every number of a solution that an output could show.
fn same(a: &Refined, b: &Refined) -> bool {
    a.solution == b.solution
        && a.statement == b.statement
        && a.ledger == b.ledger
        && a.total_work == b.total_work
        && a.mesh.vertices() == b.mesh.vertices()
        && a.mesh.elements() == b.mesh.elements()
}

fn multi(shooters: usize) -> Schedule {
    Schedule::Multi(NonZeroUsize::new(shooters).unwrap())
}

/// Solves with every number of threads and every loop, `runs` times, and compares each with one
/// thread.
fn compare(
    name: &str,
    scene: &Scene,
    most_elements: usize,
    schedule: Schedule,
    loops: &[&str],
    runs: usize,
) {
    let expected = solve(scene, &Sequential, schedule, most_elements);
    let elements = expected.mesh.elements().len();
    let even = Mesh::from_scene(scene, &MeshConfig::with_elements(elements));
    println!(
        "{name}, {schedule:?}: {elements} elements, {} shots; the mesh follows the light: {}",
        expected.total_work.shots,
        even.vertices() != expected.mesh.vertices()
    );
    for threads in THREADS {
        for text in loops {
            let pool = Pool::with_loop(threads, text.parse::<Loop>().unwrap()).unwrap();
            for run in 1..=runs {
                let found = solve(scene, &pool, schedule, most_elements);
                assert!(same(&found, &expected), "{name}, {schedule:?}, {pool:?}, run {run}");
            }
        }
    }
}

#[test]
fn a_mesh_that_follows_the_light_has_the_same_bits_on_any_threads() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cornell.obj");
    let scene = scene_import::open(&path, &Options::default()).unwrap().scene;
    let most = 700;
    let single = solve(&scene, &Sequential, Schedule::Single, most);
    let even = Mesh::from_scene(&scene, &MeshConfig::with_elements(single.mesh.elements().len()));
    assert!(even.vertices() != single.mesh.vertices(), "the mesh follows the light");
    let five = solve(&scene, &Sequential, multi(5), most);
    assert!(single.solution != five.solution, "schedules take other steps");
    compare(
        "cornell.obj",
        &scene,
        most,
        multi(5),
        &["static", "dynamic:3", "guided:1", "tasks"],
        1,
    );
}

#[test]
fn all_scenes_have_the_same_bits_on_any_threads() {
    let Ok(wanted) = std::env::var("SAME_BITS") else {
        println!("skipped: all scenes take an hour or two; SAME_BITS=all or a name asks for them");
        return;
    };
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let bundled = ["blocks.tri", "cornell.glb", "gallery.glb", "hall.tri", "room.tri"]
        .map(|name| bundled.join(name));
    let beside = ["blocks.tri", "box.tri", "church.tri", "cornell.obj", "room.tri"];
    let beside = beside.iter().filter_map(|name| shared::find(&format!("scenes/{name}")));
    for path in bundled.into_iter().chain(beside) {
        if wanted != "all" && path.file_stem().is_none_or(|stem| *stem != *wanted) {
            continue;
        }
        let scene = scene_import::open(&path, &Options::default()).unwrap().scene;
        // The first level has nothing to say of the second; the third follows the light.
        let pieces = Mesh::from_scene(&scene, &MeshConfig::with_elements(1)).elements().len();
        let most = (7 * pieces).clamp(2_000, 20_000).max(2 * pieces);
        for schedule in [Schedule::Single, multi(5), Schedule::Auto] {
            compare(&path.display().to_string(), &scene, most, schedule, &LOOPS, 2);
        }
    }
}
