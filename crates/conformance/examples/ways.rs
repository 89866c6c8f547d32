//! The report's way to shoot, and ours one change at a time: a table of docs/performance/schedules.md.
//!
//! `cargo run --release -p radiosity-conformance --example ways`, with the reference data beside the checkout.
//! One thread; a mesh of 50,000 elements of the room, shot until 13 % of the light is unshot, where
//! the report's program stopped. Its way: every element shoots alone, in order of what it has left,
//! one segment and one form factor for every receiver, segments one by one through an octree.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::error::Error;
use std::time::Instant;

use accel::{Bvh, BvhConfig, Occluder, Octree, OctreeConfig, Segment};
use conformance::shared;
use output::csv;
use radiosity_core::{
    Census, Correction, Exchange, Mesh, MeshConfig, Schedule, Sequential, Shooting, ShootingConfig,
};
use scene::Scene;

const ELEMENTS: usize = 50_000;

/// Of the emitted power, worst channel.
const UNSHOT: f64 = 0.13;

/// Rounds; the least time of a way counts.
const ROUNDS: usize = 3;

/// Answers segment by segment, whatever it is asked.
struct OneByOne<'a>(&'a dyn Occluder);

impl Occluder for OneByOne<'_> {
    fn occluded(&self, segment: &Segment) -> bool {
        self.0.occluded(segment)
    }
}

/// A way to shoot.
struct Way<'a> {
    name: &'static str,
    occluder: &'a dyn Occluder,
    patch_elements: usize,
    config: ShootingConfig,
    rounds: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = shared::find("scenes/room.tri");
    let reference = shared::find("reference/room_onesided.csv");
    let (Some(file), Some(reference)) = (file, reference) else {
        println!("skipped: no reference data beside the checkout");
        return Ok(());
    };
    let scene = scene_import::open(&file, &scene_import::Options::default())?.scene;
    let reference = csv::read(std::fs::File::open(reference)?)?;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let octree = Octree::build(&triangles, &OctreeConfig::default());
    let (octree_singles, bvh_singles) = (OneByOne(&octree), OneByOne(&bvh));
    let plain = ShootingConfig {
        tolerance: 0.1,
        cell_share: f64::INFINITY,
        bright: f64::INFINITY,
        schedule: Schedule::Single,
        correction: Correction::Never,
        overshoot: false,
        ..ShootingConfig::until(UNSHOT)
    };
    let careful = ShootingConfig {
        schedule: Schedule::Single,
        overshoot: false,
        ..ShootingConfig::until(UNSHOT)
    };
    let way = |name, occluder, patch_elements, config| Way {
        name,
        occluder,
        patch_elements,
        config,
        rounds: ROUNDS,
    };
    let patches = MeshConfig::with_elements(ELEMENTS).patch_elements;
    let ways = [
        Way { rounds: 1, ..way("as the report", &octree_singles, 1, plain) },
        Way { rounds: 1, ..way("BVH, segments one by one", &bvh_singles, 1, plain) },
        Way { rounds: 1, ..way("BVH, packets", &bvh, 1, plain) },
        way("patches shoot, by their elements from near", &bvh, patches, plain),
        way("form factors of 1 %, lamps in pieces, points inside", &bvh, patches, careful),
        way(
            "patches that are alike shoot together",
            &bvh,
            patches,
            ShootingConfig { schedule: Schedule::Auto, ..careful },
        ),
        way(
            "shooting in advance: the default",
            &bvh,
            patches,
            ShootingConfig { schedule: Schedule::Auto, overshoot: true, ..careful },
        ),
        way(
            "unshot light shown as ambient light",
            &bvh,
            patches,
            ShootingConfig { schedule: Schedule::Auto, overshoot: true, ambient: true, ..careful },
        ),
    ];
    println!("| way | patches | shots | segments | form factors | seconds | E1 |");
    println!("|---|---|---|---|---|---|---|");
    let mut first = None;
    for way in &ways {
        let (row, seconds) = way.measure(&scene, &bvh, &reference)?;
        let first = *first.get_or_insert(seconds);
        println!("{row} | {:.2} ({:.0}×) | {:.1} % |", seconds.0, first.0 / seconds.0, seconds.1);
    }
    Ok(())
}

impl Way<'_> {
    /// The row's first cells; seconds, and E1 in per cent.
    fn measure(
        &self,
        scene: &Scene,
        bvh: &Bvh,
        reference: &[csv::Row],
    ) -> Result<(String, (f64, f64)), Box<dyn Error>> {
        let mut least = f64::INFINITY;
        let mut row = String::new();
        let mut e1 = 0.0;
        for _ in 0..self.rounds {
            let clock = Instant::now();
            let config = MeshConfig {
                patch_elements: self.patch_elements,
                ..MeshConfig::with_elements(ELEMENTS)
            };
            let mesh = Mesh::from_scene(scene, &config);
            let census = Census::take(scene, &mesh, bvh, Exchange::OneSided, &Sequential);
            let mut shooting =
                Shooting::new(&mesh, self.occluder, &census, &Sequential, self.config);
            shooting.run(&mut ());
            least = least.min(clock.elapsed().as_secs_f64());
            let work = shooting.report();
            let ours = csv::rows(scene, &shooting.solution())?;
            e1 = output::compare(&ours, reference)?.worst_e1() * 100.0;
            row = format!(
                "| {} | {} | {} | {:.1} M | {:.1} M",
                self.name,
                mesh.patches().len(),
                work.shots,
                work.rays as f64 / 1e6,
                work.form_factors as f64 / 1e6
            );
        }
        Ok((row, (least, e1)))
    }
}
