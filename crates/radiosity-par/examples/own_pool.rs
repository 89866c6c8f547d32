//! Solves a room on threads that the caller owns: a rayon pool of his, and plain scoped threads.
//!
//! `cargo run -p radiosity-par --example own_pool [-- ELEMENTS]`
//!
//! How loops run is an argument of the solver, `radiosity_core::Executor`, of two functions. A program
//! that has a pool already writes one of its own in a few lines, as below, in the place of
//! `radiosity_par::Pool`. Whoever runs the loops, the light is the same to the last bit; exit code 1
//! if it is not.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Instant;

use accel::{Bvh, BvhConfig};
use radiosity_core::{
    Census, Exchange, Executor, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig,
};
use radiosity_par::{Loop, Pool};
use rayon::prelude::*;
use scene::{Material, Rgb, Scene, SceneBuilder, Sides, Solution};

/// A rayon pool that also serves the rest of its program.
struct Rayon(rayon::ThreadPool);

impl Executor for Rayon {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        self.0.install(|| items.par_iter_mut().for_each(&f));
    }

    fn threads(&self) -> usize {
        self.0.current_num_threads()
    }
}

/// Threads of the standard library, started for each loop: simple, and dear for short loops.
struct Scoped(NonZeroUsize);

impl Executor for Scoped {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        let share = items.len().div_ceil(self.0.get()).max(1);
        std::thread::scope(|scope| {
            for items in items.chunks_mut(share) {
                scope.spawn(|| items.iter_mut().for_each(&f));
            }
        });
    }

    fn threads(&self) -> usize {
        self.0.get()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let elements = match std::env::args().nth(1) {
        Some(text) => text.parse().map_err(|error| format!("elements {text}: {error}"))?,
        None => 600,
    };
    let scene = room()?;
    let two = NonZeroUsize::MIN.saturating_add(1);
    let rayon = Rayon(rayon::ThreadPoolBuilder::new().num_threads(two.get()).build()?);
    let guided = Pool::with_loop(two.get(), Loop::Guided(NonZeroUsize::MIN))?;

    let (one, _) = timed("one thread", || solve(&scene, elements, &Sequential));
    let mut differ = Vec::new();
    for (name, (light, _)) in [
        ("own rayon", timed("own rayon pool", || solve(&scene, elements, &rayon))),
        ("own threads", timed("own threads", || solve(&scene, elements, &Scoped(two)))),
        ("guided", timed("Pool, guided:1", || guided.run(|| solve(&scene, elements, &guided)))),
    ] {
        // Solutions are equal if every exitance is, bit for bit.
        differ.extend((light != one).then_some(name));
    }
    println!("{} elements, the same light from each: {}", one.elements.len(), differ.is_empty());
    if differ.is_empty() { Ok(()) } else { Err(format!("other light: {differ:?}").into()) }
}

fn timed<T>(name: &str, work: impl FnOnce() -> (T, u64)) -> (T, u64) {
    let start = Instant::now();
    let (light, shots) = work();
    println!("{name:16} {shots} shots in {:.1?}", start.elapsed());
    (light, shots)
}

fn solve<E: Executor>(scene: &Scene, elements: usize, executor: &E) -> (Solution, u64) {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene_with(scene, &MeshConfig::with_elements(elements), executor);
    let census = Census::take(scene, &mesh, &bvh, Exchange::OneSided, executor);
    let config = ShootingConfig::until(1e-3);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, executor, config);
    shooting.run(&mut ());
    (shooting.solution(), shooting.report().shots)
}

/// A box whose ceiling shines, with a block that floats in its middle.
fn room() -> Result<Scene, scene::Error> {
    let mut builder = SceneBuilder::new();
    let group = builder.group("room");
    let mut material = |reflectance, emittance| {
        let (reflectance, emittance) = (Rgb::splat(reflectance), Rgb::splat(emittance));
        let (name, sides) = ("grey".into(), Sides::Front);
        builder.material(Material { name, reflectance, emittance, sides })
    };
    let (grey, shining) = (material(0.6, 0.0)?, material(0.6, 1.0)?);
    // Counter-clockwise seen from inside: below, above, and four sides.
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for (low, high, outside) in [([0.0; 3], [4.0, 4.0, 3.0], false), ([1.5; 3], [2.5; 3], true)] {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
        let vertices = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| builder.vertex(corner(i).into()));
        for (face, corners) in faces.iter().enumerate() {
            let [a, b, c, d] = corners.map(|corner: usize| vertices[corner]);
            let material = if face == 1 && !outside { shining } else { grey };
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                builder.triangle(if outside { [p, r, q] } else { [p, q, r] }, material, group)?;
            }
        }
    }
    Ok(builder.finish())
}
