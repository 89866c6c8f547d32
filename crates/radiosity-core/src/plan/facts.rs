//! What can be read off a scene before any light is shot.

use accel::proof::{Objects, Spaces, Walls, never_block, solid_angle};
use glam::DVec3;
use scene::{Material, Rgb, Scene, Sides, TriangleId};

use crate::mesh::scene_extent;
use crate::needs::Channels;
use crate::shooting::SEGMENT_LIFT;

/// Walls are looked for among polygons of this share of the square of the extent: a sixteenth of it
/// on either side.
const LEAST_WALL: f64 = 1.0 / 256.0;

/// Walls that each shot looks at, at most.
const MOST_WALLS: usize = 16;

/// A scene has few things if it has no more than this: each is looked at for each block.
const MOST_OBJECTS: usize = 256;

/// Surfaces seen from inside sum to a whole sphere if they do to this share of it.
const WHOLE_SPHERE: f64 = 1e-9;

/// Facts about a scene.
#[derive(Clone, Debug)]
pub struct Facts {
    /// Triangles with area.
    pub triangles: usize,
    /// Exact copies of earlier ones.
    pub copies: usize,
    /// Diagonal of the bounds.
    pub extent: f64,
    /// Area of all lit sides.
    pub area: f64,
    /// Side lengths of squares of the least, the median and the greatest triangle.
    pub sizes: [f64; 3],
    /// Emitting triangles.
    pub emitters: usize,
    /// Channels in which anything emits.
    pub lit: [bool; 3],
    /// Least and greatest reflectance of any surface and channel.
    pub reflectance: [f64; 2],
    /// Area mean of the reflectance, the channel in which it is greatest.
    pub mean_reflectance: f64,
    /// Share of the area that reflects none of the light there is.
    pub black: f64,
    /// Which channels differ.
    pub channels: Channels,
    /// Whether any triangle has two lit sides.
    pub two_sided: bool,
    /// Which triangles may block a segment; the others need not be in what finds occluders.
    pub blocking: Vec<bool>,
    /// Share of the area of all triangles that those have which may not block.
    pub open_area: f64,
    /// Nothing blocks, and all light that leaves a surface meets another.
    pub closed: bool,
    /// Large convex polygons among those that may block.
    pub walls: Walls,
    /// Separate things among them, if they are few.
    pub objects: Option<Objects>,
    /// Sealed spaces.
    pub spaces: Spaces,
}

impl Facts {
    /// Reads them off a scene. Time N·log N; bytes: some 300 a triangle while it looks.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let triangles: Vec<[DVec3; 3]> = scene.ids().map(|id| scene.corners(id)).collect();
        let both = |t: usize| scene.material_of(TriangleId(t as u32)).sides == Sides::Both;
        let extent = scene_extent(scene);
        let lift = SEGMENT_LIFT * extent;
        let blocking: Vec<bool> =
            never_block(&triangles, both, lift).into_iter().map(|never| !never).collect();
        let may_block = |t: usize| blocking[t];
        let any = blocking.contains(&true);
        let objects = if any { Objects::of(&triangles, may_block) } else { Objects::default() };
        let surfaces = Surfaces::of(scene);
        let area = |blocks: bool| -> f64 {
            let some = scene.ids().zip(&blocking).filter(|(_, b)| **b == blocks);
            some.map(|(id, _)| scene.area(id)).sum()
        };
        let (open, closed) = (area(false), area(true));
        Self {
            triangles: surfaces.areas.len(),
            copies: copies(&triangles),
            extent,
            area: surfaces.area,
            sizes: surfaces.sizes(),
            emitters: surfaces.emitters,
            lit: surfaces.lit,
            reflectance: surfaces.reflectance,
            mean_reflectance: surfaces.mean.max_channel(),
            black: surfaces.black(scene),
            channels: channels(&surfaces.materials),
            two_sided: surfaces.two_sided,
            open_area: if open > 0.0 { open / (open + closed) } else { 0.0 },
            closed: !any && !surfaces.two_sided && surround(&triangles),
            walls: match any {
                true => Walls::of(&triangles, may_block, LEAST_WALL, MOST_WALLS),
                false => Walls::default(),
            },
            objects: (objects.len() <= MOST_OBJECTS).then_some(objects),
            spaces: if any { Spaces::of(&triangles, both, lift) } else { Spaces::default() },
            blocking,
        }
    }

    /// Whether no triangle can block any segment.
    #[must_use]
    pub fn nothing_blocks(&self) -> bool {
        !self.blocking.contains(&true)
    }
}

/// What the surfaces are made of.
struct Surfaces<'a> {
    materials: Vec<&'a Material>,
    areas: Vec<f64>,
    area: f64,
    emitters: usize,
    lit: [bool; 3],
    reflectance: [f64; 2],
    mean: Rgb,
    two_sided: bool,
}

impl<'a> Surfaces<'a> {
    fn of(scene: &'a Scene) -> Self {
        let mut used = vec![false; scene.materials().len()];
        let mut areas = Vec::new();
        let (mut area, mut reflecting, mut emitters) = (0.0, Rgb::ZERO, 0);
        for (id, triangle) in scene.ids().zip(scene.triangles()) {
            let (material, own) = (scene.material_of(id), scene.area(id));
            if own > 0.0 {
                used[triangle.material.index()] = true;
                areas.push(own);
                let sides = if material.sides == Sides::Both { 2.0 } else { 1.0 };
                area += own * sides;
                reflecting += material.reflectance * (own * sides);
                emitters += usize::from(material.emits());
            }
        }
        let all = scene.materials().iter().zip(used);
        let materials: Vec<&Material> = all.filter(|(_, used)| *used).map(|(m, _)| m).collect();
        let low = materials.iter().map(|m| m.reflectance.min_channel()).fold(1.0, f64::min);
        let high = materials.iter().map(|m| m.reflectance.max_channel()).fold(0.0, f64::max);
        Self {
            lit: [0, 1, 2].map(|c| materials.iter().any(|m| m.emittance[c] > 0.0)),
            two_sided: materials.iter().any(|m| m.sides == Sides::Both),
            reflectance: [low.min(high), high],
            mean: reflecting.share_of(Rgb::splat(area)),
            materials,
            areas,
            area,
            emitters,
        }
    }

    fn sizes(&self) -> [f64; 3] {
        let mut areas = self.areas.clone();
        areas.sort_unstable_by(f64::total_cmp);
        let at = |i: usize| areas.get(i).map_or(0.0, |a| a.sqrt());
        [at(0), at(areas.len() / 2), at(areas.len().saturating_sub(1))]
    }

    /// The share of the area that reflects none of the light there is.
    fn black(&self, scene: &Scene) -> f64 {
        let is_black = |m: &Material| (0..3).all(|c| !self.lit[c] || m.reflectance[c] == 0.0);
        let side = |id| {
            let material: &Material = scene.material_of(id);
            let sides = if material.sides == Sides::Both { 2.0 } else { 1.0 };
            if is_black(material) { scene.area(id) * sides } else { 0.0 }
        };
        if self.area > 0.0 { scene.ids().map(side).sum::<f64>() / self.area } else { 0.0 }
    }
}

/// Which channels differ: none but one, if each of the others is dark, or is lit by a multiple of its
/// emittance everywhere and reflects like it.
fn channels(materials: &[&Material]) -> Channels {
    let most = |c: usize| materials.iter().map(|m| m.emittance[c]).fold(0.0, f64::max);
    let only = (0..3).fold(0, |best, c| if most(c) > most(best) { c } else { best });
    let mut times = [0.0; 3];
    for c in (0..3).filter(|c| most(*c) > 0.0) {
        times[c] = most(c) / most(only);
        let alike = |m: &&Material| {
            m.reflectance[c] == m.reflectance[only]
                && m.emittance[c] == m.emittance[only] * times[c]
        };
        if !materials.iter().all(alike) {
            return Channels::ALL;
        }
    }
    Channels { only: Some(only), times }
}

/// How many triangles have the corners of an earlier one.
fn copies(triangles: &[[DVec3; 3]]) -> usize {
    let mut keys: Vec<[[u64; 3]; 3]> = triangles
        .iter()
        .map(|t| {
            let mut key = t.map(|p| (p + DVec3::ZERO).to_array().map(f64::to_bits));
            key.sort_unstable();
            key
        })
        .collect();
    keys.sort_unstable();
    keys.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

/// Whether the fronts of the triangles fill the whole view from their middle. Triangles that block
/// nothing lie side by side on a convex surface; then they leave no gap.
fn surround(triangles: &[[DVec3; 3]]) -> bool {
    let middle = triangles.iter().flatten().sum::<DVec3>() / (3 * triangles.len()).max(1) as f64;
    let angles: f64 = triangles.iter().map(|t| solid_angle(*t, middle)).sum();
    (angles / (4.0 * std::f64::consts::PI) - 1.0).abs() < WHOLE_SPHERE
}
