//! What schedules are worth: the tables of docs/performance/schedules.md.
//!
//! `cargo run --release -p radiosity-conformance --example schedules`. Rooms with 1, 4 and 40 lamps, one of
//! them with lamps that see each other; shots, segments and seconds until the light is within 1 %
//! of what it converges to, which is what a schedule is for: unshot power alone says less.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Instant;

use accel::{Bvh, BvhConfig};
use radiosity_core::{
    Census, Control, Exchange, Mesh, MeshConfig, Schedule, Shooting, ShootingConfig, StepReport,
};
use radiosity_par::Pool;
use scene::{GroupId, Material, MaterialId, Rgb, Scene, SceneBuilder, Sides, Solution};

const ELEMENTS: usize = 10_000;

/// Unshot share of the light that others are compared with.
const CONVERGED: f64 = 1e-6;

/// E1 to be within of it.
const WITHIN: f64 = 0.01;

/// Rounds; the least time of a configuration counts.
const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let pools = [Pool::new(1)?, Pool::new(2)?];
    let multi = |k: usize| (format!("multi:{k}"), NonZeroUsize::new(k).map(Schedule::Multi));
    let mut schedules = vec![("single".to_owned(), Some(Schedule::Single))];
    schedules.extend([2, 4, 8, 16, 32, 64].map(multi));
    schedules.push(("auto".to_owned(), Some(Schedule::Auto)));
    for (name, lamps, facing) in [
        ("1 lamp", 1, false),
        ("4 lamps", 4, false),
        ("40 lamps", 40, false),
        ("40 lamps that see each other", 40, true),
    ] {
        let scene = room(lamps, facing)?;
        println!(
            "\n{name}, {ELEMENTS} elements, to {:.0} % of the converged light:\n",
            WITHIN * 1e2
        );
        println!("| schedule | overshooting | shots | segments | seconds, 1 thread | 2 threads |");
        println!("|---|---|---|---|---|---|");
        let subject = Subject::of(&scene);
        let converged = subject.converged(&pools[1]);
        for overshoot in [false, true] {
            for (name, schedule) in &schedules {
                let Some(schedule) = *schedule else { continue };
                let config = ShootingConfig { schedule, overshoot, ..ShootingConfig::until(0.0) };
                let shots = subject.shots_within(config, &converged, &pools[1]);
                let config = ShootingConfig {
                    stop: radiosity_core::StopRule { unshot: 0.0, max_shots: Some(shots) },
                    ..config
                };
                let mut seconds = [f64::INFINITY; 2];
                let mut work = StepReport::default();
                for _ in 0..ROUNDS {
                    for (pool, least) in pools.iter().zip(&mut seconds) {
                        let clock = Instant::now();
                        work = subject.shoot(config, pool).0;
                        *least = least.min(clock.elapsed().as_secs_f64());
                    }
                }
                println!(
                    "| {name} | {} | {shots} | {:.2} M | {:.3} | {:.3} |",
                    if overshoot { "yes" } else { "no" },
                    work.rays as f64 / 1e6,
                    seconds[0],
                    seconds[1],
                );
            }
        }
    }
    Ok(())
}

/// A scene with what every run of it needs.
struct Subject<'a> {
    scene: &'a Scene,
    bvh: Bvh,
    mesh: Mesh,
}

impl<'a> Subject<'a> {
    fn of(scene: &'a Scene) -> Self {
        let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
        let bvh = Bvh::build(&triangles, &BvhConfig::default());
        let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(ELEMENTS));
        Self { scene, bvh, mesh }
    }

    fn census(&self, pool: &Pool) -> Census {
        Census::take(self.scene, &self.mesh, &self.bvh, Exchange::OneSided, pool)
    }

    fn converged(&self, pool: &Pool) -> Solution {
        self.shoot(ShootingConfig::until(CONVERGED), pool).1
    }

    fn shoot(&self, config: ShootingConfig, pool: &Pool) -> (StepReport, Solution) {
        let census = self.census(pool);
        let mut shooting = Shooting::new(&self.mesh, &self.bvh, &census, pool, config);
        shooting.run(&mut ());
        (shooting.report(), shooting.solution())
    }

    /// Shots until the light is near the converged one.
    fn shots_within(&self, config: ShootingConfig, converged: &Solution, pool: &Pool) -> u64 {
        let census = self.census(pool);
        let mut shooting = Shooting::new(&self.mesh, &self.bvh, &census, pool, config);
        let mut most = 50;
        loop {
            // Small steps at first, a fiftieth of the shots so far later.
            shooting.run(&mut |report: &StepReport| {
                if report.shots >= most { Control::Stop } else { Control::Continue }
            });
            if self.error(&shooting.solution(), converged) <= WITHIN {
                return shooting.report().shots;
            }
            let shots = shooting.report().shots;
            most = shots + 1 + shots / 50;
        }
    }

    /// E1 of the elements' exitance, worst channel.
    fn error(&self, ours: &Solution, converged: &Solution) -> f64 {
        let (mut off, mut all) = (Rgb::ZERO, Rgb::ZERO);
        for ((element, a), b) in
            self.mesh.elements().iter().zip(&ours.elements).zip(&converged.elements)
        {
            if self.mesh.root_of(element).emittance == Rgb::ZERO {
                off += (a.exitance - b.exitance).abs() * element.area;
                all += b.exitance * element.area;
            }
        }
        off.share_of(all).max_channel()
    }
}

/// A closed room of 4 × 3 × 2.5 with three boxes, and lamps in rows below the ceiling; or, facing
/// each other, in rows on two walls.
fn room(lamps: usize, facing: bool) -> Result<Scene, Box<dyn Error>> {
    let mut room = Room { builder: SceneBuilder::new() };
    room.builder.group("room");
    let wall = room.surface(0.5, 0.0)?;
    let red = room.surface(0.7, 0.0)?;
    let lamp = room.surface(0.3, 10.0)?;
    room.block([0.0, 0.0, 0.0], [4.0, 3.0, 2.5], wall, true)?;
    room.block([0.5, 0.5, 0.0], [1.3, 1.2, 0.8], red, false)?;
    room.block([2.4, 1.6, 0.0], [3.4, 2.2, 1.2], red, false)?;
    room.block([2.6, 0.4, 0.0], [2.9, 0.7, 1.9], wall, false)?;
    let columns = (lamps as f64).sqrt().ceil() as usize;
    let rows = lamps.div_ceil(columns);
    for i in 0..lamps {
        let at = |n: usize, of: usize| (n as f64 + 0.5) / of as f64;
        let (u, v) = (at(i % columns, columns), at(i / columns, rows));
        let side = 0.25 / columns as f64;
        if facing {
            let near = i % 2 == 0;
            let x = if near { 0.01 } else { 3.99 };
            let (y, z) = (0.3 + 2.4 * u, 1.3 + v);
            let a = [[x, y - side, z - side], [x, y + side, z - side]];
            let b = [[x, y + side, z + side], [x, y - side, z + side]];
            let quad = if near { [a[0], a[1], b[0], b[1]] } else { [a[1], a[0], b[1], b[0]] };
            room.quad(quad, lamp)?;
        } else {
            let (x, y, z) = (0.5 + 3.0 * u, 0.4 + 2.2 * v, 2.45);
            let low = [[x - side, y - side, z], [x - side, y + side, z]];
            let high = [[x + side, y + side, z], [x + side, y - side, z]];
            room.quad([low[0], low[1], high[0], high[1]], lamp)?;
        }
    }
    Ok(room.builder.finish())
}

struct Room {
    builder: SceneBuilder,
}

impl Room {
    fn surface(&mut self, reflectance: f64, emittance: f64) -> Result<MaterialId, Box<dyn Error>> {
        Ok(self.builder.material(Material {
            name: "surface".into(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(emittance),
            sides: Sides::Front,
        })?)
    }

    fn quad(&mut self, corners: [[f64; 3]; 4], material: MaterialId) -> Result<(), Box<dyn Error>> {
        let [a, b, c, d] = corners.map(|p| self.builder.vertex(p.into()));
        self.builder.triangle([a, b, c], material, GroupId(0))?;
        self.builder.triangle([a, c, d], material, GroupId(0))?;
        Ok(())
    }

    /// A block seen from outside, or a room seen from inside.
    fn block(
        &mut self,
        low: [f64; 3],
        high: [f64; 3],
        material: MaterialId,
        inside: bool,
    ) -> Result<(), Box<dyn Error>> {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
        for face in
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        {
            let mut corners = face.map(corner);
            if !inside {
                corners.reverse();
            }
            self.quad(corners, material)?;
        }
        Ok(())
    }
}
