//! Small scenes built in code, and all that solving one of them tells.

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::mesh::ReceiverPoint;
use radiosity_core::{
    Census, Ledger, Mesh, MeshConfig, Remaining, Sequential, Shooting, ShootingConfig, StopReason,
};
use scene::{GroupId, Material, MaterialId, Rgb, Scene, SceneBuilder, Sides, Solution};

/// A scene in the making, without groups.
pub(crate) struct Model {
    builder: SceneBuilder,
    group: GroupId,
}

/// The faces of a box by their corners, counter-clockwise seen from inside: floor, ceiling,
/// y0, y1, x0, x1. Bit k of a corner tells whether it is far along axis k.
const FACES: [[usize; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

impl Model {
    pub(crate) fn new() -> Self {
        let mut builder = SceneBuilder::new();
        let group = builder.group("all");
        Self { builder, group }
    }

    /// A grey surface that shines to its front.
    pub(crate) fn grey(&mut self, reflectance: f64, emittance: f64) -> MaterialId {
        self.surface(Rgb::splat(reflectance), Rgb::splat(emittance), Sides::Front)
    }

    pub(crate) fn surface(&mut self, reflectance: Rgb, emittance: Rgb, sides: Sides) -> MaterialId {
        let material = Material { name: "surface".into(), reflectance, emittance, sides };
        self.builder.material(material).unwrap()
    }

    pub(crate) fn triangle(&mut self, corners: [[f64; 3]; 3], material: MaterialId) {
        let corners = corners.map(|c| self.builder.vertex(DVec3::from(c)));
        self.builder.triangle(corners, material, self.group).unwrap();
    }

    /// A quadrilateral a b c d, counter-clockwise seen from its front.
    pub(crate) fn quad(&mut self, [a, b, c, d]: [[f64; 3]; 4], material: MaterialId) {
        self.triangle([a, b, c], material);
        self.triangle([a, c, d], material);
    }

    /// A horizontal rectangle that faces upwards, or downwards.
    pub(crate) fn level(&mut self, x: [f64; 2], y: [f64; 2], z: f64, up: bool, of: MaterialId) {
        let corners = [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]];
        let [a, b, c, d] = corners;
        self.quad(if up { corners } else { [a, d, c, b] }, of);
    }

    /// The inside of a box: floor, ceiling, y0, y1, x0 and x1, each with a material; a face of
    /// `None` is left out.
    pub(crate) fn room(&mut self, low: [f64; 3], high: [f64; 3], faces: [Option<MaterialId>; 6]) {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
        for (face, material) in FACES.into_iter().zip(faces) {
            if let Some(material) = material {
                self.quad(face.map(corner), material);
            }
        }
    }

    /// The inside of the unit cube.
    pub(crate) fn cube(&mut self, faces: [MaterialId; 6]) {
        self.room([0.0; 3], [1.0; 3], faces.map(Some));
    }

    pub(crate) fn scene(self) -> Scene {
        self.builder.finish()
    }
}

/// A scene whose vertices are moved.
pub(crate) fn moved(scene: &Scene, to: impl Fn(DVec3) -> DVec3) -> Scene {
    let mut model = Model::new();
    for id in scene.ids() {
        let Material { reflectance, emittance, sides, .. } = *scene.material_of(id);
        let material = model.surface(reflectance, emittance, sides);
        model.triangle(scene.corners(id).map(|p| to(p).to_array()), material);
    }
    model.scene()
}

/// A lit scene.
pub(crate) struct Lit {
    pub(crate) solution: Solution,
    pub(crate) ledger: Ledger,
    pub(crate) reason: StopReason,
    pub(crate) shots: u64,
    pub(crate) form_factors: u64,
    pub(crate) unshot: f64,
    pub(crate) patches: usize,
    pub(crate) remaining: Remaining,
    pub(crate) closed_rows: Option<[f64; 2]>,
    /// Exitance of the input triangles.
    pub(crate) triangles: Vec<Rgb>,
    /// Some of the mesh's points.
    pub(crate) points: Vec<ReceiverPoint>,
    /// The sums of the form factors to all they see, by the finer estimate.
    pub(crate) rows: Vec<f64>,
}

impl Lit {
    pub(crate) fn sweeps(&self) -> f64 {
        self.shots as f64 / self.patches.max(1) as f64
    }

    /// All exitance, in elements and corners.
    pub(crate) fn values(&self) -> impl Iterator<Item = Rgb> + '_ {
        self.solution.elements.iter().flat_map(|e| {
            let [a, b, c] = e.corner_exitance;
            [e.exitance, a, b, c]
        })
    }

    /// All exitance, bit by bit.
    pub(crate) fn bits(&self) -> Vec<[u64; 3]> {
        self.values().map(|b| b.0.map(f64::to_bits)).collect()
    }

    /// The largest |a − b| of two solutions over one mesh, over the largest exitance.
    pub(crate) fn apart(&self, other: &Self) -> f64 {
        assert_eq!(self.solution.elements.len(), other.solution.elements.len());
        let most = self.values().map(Rgb::max_channel).fold(0.0, f64::max);
        let far = |(a, b): (Rgb, Rgb)| (a - b).abs().max_channel();
        self.values().zip(other.values()).map(far).fold(0.0, f64::max) / most
    }

    /// The relative difference of the input triangles' means: ΣA·|a − b| / ΣA·a.
    pub(crate) fn e1(&self, other: &Self, scene: &Scene) -> f64 {
        let (mut difference, mut total) = (0.0, 0.0);
        for id in scene.ids() {
            let (a, b) = (self.triangles[id.index()], other.triangles[id.index()]);
            difference += scene.area(id) * (a - b).abs().sum();
            total += scene.area(id) * a.sum();
        }
        difference / total
    }
}

/// Lights a scene.
pub(crate) fn light(scene: &Scene, elements: usize, config: ShootingConfig) -> Lit {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(elements));
    let census = Census::take(scene, &mesh, &bvh, config.exchange, &Sequential);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, &Sequential, config);
    let reason = shooting.run(&mut ());
    let solution = shooting.solution();
    // Some hundred points say as much of the rows as all of them.
    let stride = mesh.points().len() / 200 + 1;
    let points: Vec<u32> = (0..mesh.points().len() as u32).step_by(stride).collect();
    Lit {
        triangles: solution.triangle_exitance(scene),
        solution,
        ledger: shooting.ledger(),
        reason,
        shots: shooting.report().shots,
        form_factors: shooting.report().form_factors,
        unshot: shooting.report().unshot,
        patches: mesh.patches().len(),
        remaining: shooting.remaining(),
        closed_rows: shooting.closed_rows(),
        points: points.iter().map(|&p| mesh.points()[p as usize]).collect(),
        rows: shooting.gather(&points).into_iter().map(|g| g.row).collect(),
    }
}
