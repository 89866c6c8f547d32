//! Random scenes, and what solving them gives.

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use proptest::prelude::*;
use radiosity_core::{
    Census, Executor, Ledger, Mesh, MeshConfig, Remaining, Sequential, Shooting, ShootingConfig,
};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides, Solution};

use crate::draw::triangle;

/// A triangle with its surface.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub(crate) corners: [DVec3; 3],
    pub(crate) reflectance: Rgb,
    pub(crate) emittance: Rgb,
    pub(crate) sides: Sides,
}

/// A reflectance that is sometimes 0 and sometimes high.
fn reflectance() -> impl Strategy<Value = Rgb> {
    let one = || prop_oneof![1 => Just(0.0), 4 => 0.0..0.9f64, 1 => 0.9..0.98f64];
    [one(), one(), one()].prop_map(Rgb)
}

/// An emittance that is mostly 0.
fn emittance() -> impl Strategy<Value = Rgb> {
    let one = || 0.0..10.0f64;
    prop_oneof![3 => Just(Rgb::ZERO), 1 => [one(), one(), one()].prop_map(Rgb)]
}

fn sides() -> impl Strategy<Value = Sides> {
    prop_oneof![3 => Just(Sides::Front), 1 => Just(Sides::Both)]
}

fn piece() -> impl Strategy<Value = Piece> {
    (triangle(), reflectance(), emittance(), sides()).prop_map(
        |(corners, reflectance, emittance, sides)| Piece { corners, reflectance, emittance, sides },
    )
}

/// A box around the unit cube, its faces of two triangles each, with up to five triangles in it,
/// wound as it comes; sometimes without some of its walls.
pub(crate) fn room() -> impl Strategy<Value = Vec<Piece>> {
    let walls = prop::collection::vec((reflectance(), emittance(), prop::bool::weighted(0.9)), 6);
    (walls, prop::collection::vec(piece(), 1..6), reflectance()).prop_map(|(walls, inside, rho)| {
        let mut pieces = box_of(&walls);
        pieces.extend(inside);
        // At least one lamp.
        let lamp = pieces.len() - 1;
        pieces[lamp].reflectance = rho;
        pieces[lamp].emittance = Rgb::new(1.0, 2.0, 3.0);
        pieces
    })
}

/// A box a little larger than the unit cube, no two of its measures alike.
fn box_of(walls: &[(Rgb, Rgb, bool)]) -> Vec<Piece> {
    faces(walls, |k, far| if far { 1.1 + 0.1 * k as f64 } else { -0.1 })
}

/// The unit cube.
pub(crate) fn cube_of(walls: &[(Rgb, Rgb, bool)]) -> Vec<Piece> {
    faces(walls, |_, far| f64::from(u8::from(far)))
}

/// The faces of a box seen from inside, each with its reflectance and emittance, if it is there:
/// floor, ceiling and four walls. `at` says where the near and the far ones lie along each axis.
fn faces(walls: &[(Rgb, Rgb, bool)], at: impl Fn(usize, bool) -> f64) -> Vec<Piece> {
    let corner = |i: usize| DVec3::from([0, 1, 2].map(|k| at(k, i >> k & 1 == 1)));
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let mut pieces = Vec::new();
    for (face, &(reflectance, emittance, there)) in faces.iter().zip(walls) {
        let [a, b, c, d] = face.map(corner);
        for corners in [[a, b, c], [a, c, d]].into_iter().filter(|_| there) {
            pieces.push(Piece { corners, reflectance, emittance, sides: Sides::Front });
        }
    }
    pieces
}

pub(crate) fn scene(pieces: &[Piece]) -> Scene {
    let mut builder = SceneBuilder::new();
    let group = builder.group("all");
    for piece in pieces {
        let Piece { corners, reflectance, emittance, sides } = *piece;
        let material = Material { name: "any".into(), reflectance, emittance, sides };
        let material = builder.material(material).unwrap();
        let vertices = corners.map(|c| builder.vertex(c));
        builder.triangle(vertices, material, group).unwrap();
    }
    builder.finish()
}

/// A lit scene.
pub(crate) struct Lit {
    pub(crate) solution: Solution,
    pub(crate) ledger: Ledger,
    pub(crate) remaining: Remaining,
    pub(crate) triangles: Vec<Rgb>,
}

impl Lit {
    /// All exitance, in elements and corners.
    pub(crate) fn values(&self) -> impl Iterator<Item = Rgb> + '_ {
        self.solution.elements.iter().flat_map(|e| {
            let [a, b, c] = e.corner_exitance;
            [e.exitance, a, b, c]
        })
    }

    /// The largest |a − b| per channel, over the largest exitance of that channel.
    pub(crate) fn apart(&self, other: &Self) -> f64 {
        let mut worst = 0.0f64;
        for c in 0..3 {
            let most = self.values().map(|b| b[c]).fold(0.0, f64::max);
            for (a, b) in self.values().zip(other.values()) {
                let far = (a[c] - b[c]).abs();
                worst = worst.max(if far > 0.0 { far / most } else { 0.0 });
            }
        }
        worst
    }
}

pub(crate) fn light(pieces: &[Piece], elements: usize, config: ShootingConfig) -> Lit {
    light_on(pieces, elements, config, &Sequential)
}

/// On a mesh that does not depend on the lamps.
pub(crate) fn light_on_one_mesh(pieces: &[Piece], elements: usize, config: ShootingConfig) -> Lit {
    let mesh = MeshConfig { graded: false, ..MeshConfig::with_elements(elements) };
    light_through(pieces, mesh, config, &Sequential)
}

pub(crate) fn light_on<E: Executor>(
    pieces: &[Piece],
    elements: usize,
    config: ShootingConfig,
    executor: &E,
) -> Lit {
    light_through(pieces, MeshConfig::with_elements(elements), config, executor)
}

fn light_through<E: Executor>(
    pieces: &[Piece],
    mesh: MeshConfig,
    config: ShootingConfig,
    executor: &E,
) -> Lit {
    let scene = scene(pieces);
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let mesh = Mesh::from_scene(&scene, &mesh);
    let census = Census::take(&scene, &mesh, &bvh, config.exchange, executor);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, executor, config);
    shooting.run(&mut ());
    let solution = shooting.solution();
    Lit {
        triangles: solution.triangle_exitance(&scene),
        solution,
        ledger: shooting.ledger(),
        remaining: shooting.remaining(),
    }
}
