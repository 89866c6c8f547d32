//! What a checkpoint belongs to: all that changes the bits of the light, as lines of text.

use std::fmt::Debug;

use radiosity_core::{Asked, Needs, Probe, RefineConfig, ShootingConfig};
use scene::{Rgb, Scene, Sides};

/// What the state of some work belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Identity {
    lines: Vec<(&'static str, String)>,
}

impl Identity {
    /// Of this work: program, scene and settings; not threads, nor limits of time.
    pub(crate) fn of(
        scene: &Scene,
        occluder: &str,
        config: &ShootingConfig,
        refining: &RefineConfig,
        probes: &[Probe],
    ) -> Self {
        let unshot = config.stop.unshot;
        let goal = match refining.asked {
            Asked::Error(error) => format!("--error {error}"),
            Asked::Elements(n) => format!("--elements {n} --converge {unshot}"),
            Asked::Unstated(n) => format!("--elements {n} --converge {unshot} --no-statement"),
        };
        // Second estimates before the last mesh change nothing that is kept.
        let needs = Needs { early_estimates: true, ..config.needs };
        let config = ShootingConfig { needs, ..*config };
        let triangles = scene.triangles().len();
        let lines = vec![
            ("program", concat!("radiosity ", env!("CARGO_PKG_VERSION")).to_owned()),
            ("geometry", format!("{triangles} triangles, CRC-32 {:08x}", geometry(scene))),
            ("materials", format!("CRC-32 {:08x}", materials(scene))),
            ("probes", format!("{}, CRC-32 {:08x}", probes.len(), places(probes))),
            ("goal", goal),
            ("occluders", occluder.to_owned()),
            ("shooting", text(&config)),
            ("refining", text(refining)),
        ];
        Self { lines }
    }

    /// As the file has it: a line each.
    pub(super) fn text(&self) -> String {
        self.lines.iter().map(|(name, value)| format!("{name}: {value}\n")).collect()
    }

    /// Whether a file is of the same work; if not, how it differs.
    pub(super) fn check(&self, there: &str) -> Result<(), String> {
        let mut there = there.lines();
        for (name, here) in &self.lines {
            let line = there.next().unwrap_or_default();
            let value = line.strip_prefix(name).and_then(|rest| rest.strip_prefix(": "));
            match value {
                Some(value) if value == here => {}
                Some(value) => {
                    let (value, here) = difference(value, here);
                    return Err(format!(
                        "is a checkpoint of other work: {name}: {value}, expected {here}"
                    ));
                }
                None => return Err(format!("is a checkpoint of other work: it has no {name}")),
            }
        }
        there.next().map_or(Ok(()), |line| {
            Err(format!("is a checkpoint of other work: this program knows no {line:?}"))
        })
    }
}

/// A configuration with all of its fields, each to the bit.
fn text(config: &impl Debug) -> String {
    format!("{config:?}")
}

/// The first fields of two configurations that differ; all of a text that is none.
fn difference<'a>(a: &'a str, b: &'a str) -> (&'a str, &'a str) {
    let fields = a.split(", ").zip(b.split(", "));
    let alike = a.split(", ").count() == b.split(", ").count() && a.contains('{');
    fields.into_iter().find(|(a, b)| alike && a != b).unwrap_or((a, b))
}

/// A checksum of numbers.
#[derive(Default)]
struct Sum(crc32fast::Hasher);

impl Sum {
    fn add(&mut self, number: u32) {
        self.0.update(&number.to_le_bytes());
    }

    fn reals(&mut self, numbers: impl IntoIterator<Item = f64>) {
        numbers.into_iter().for_each(|x| self.0.update(&x.to_le_bytes()));
    }
}

/// Of the corners of all triangles, in their order.
fn geometry(scene: &Scene) -> u32 {
    let mut sum = Sum::default();
    for corner in scene.ids().flat_map(|id| scene.corners(id)) {
        sum.reals(corner.to_array());
    }
    sum.0.finalize()
}

/// Of what each triangle reflects and emits, on which sides.
fn materials(scene: &Scene) -> u32 {
    let mut sum = Sum::default();
    for id in scene.ids() {
        let material = scene.material_of(id);
        let (Rgb(reflectance), Rgb(emittance)) = (material.reflectance, material.emittance);
        sum.reals(reflectance.into_iter().chain(emittance));
        sum.add(u32::from(material.sides == Sides::Both));
    }
    sum.0.finalize()
}

fn places(probes: &[Probe]) -> u32 {
    let mut sum = Sum::default();
    for probe in probes {
        match *probe {
            Probe::Surface { triangle, uv, area } => {
                sum.add(triangle.0);
                sum.reals(uv.into_iter().chain([area.unwrap_or(-1.0)]));
            }
            Probe::Free { position, normal } => {
                sum.reals(position.to_array().into_iter().chain(normal.to_array()));
            }
        }
    }
    sum.0.finalize()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use scene::{Material, SceneBuilder, TriangleId};

    use super::*;

    fn scene(height: f64, reflectance: f64, sides: Sides) -> Scene {
        let mut builder = SceneBuilder::new();
        let group = builder.group("all");
        let (reflectance, emittance) = (Rgb::splat(reflectance), Rgb::ZERO);
        let material = Material { name: "a".into(), reflectance, emittance, sides };
        let material = builder.material(material).unwrap();
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, height, 0.0)];
        let corners = corners.map(|p| builder.vertex(p));
        builder.triangle(corners, material, group).unwrap();
        builder.finish()
    }

    #[test]
    fn whatever_changes_the_light_is_told() {
        let config = ShootingConfig::until(1e-3);
        let refining = RefineConfig::until(Asked::Elements(100));
        let at = |area| Probe::Surface { triangle: TriangleId(0), uv: [0.1, 0.2], area };
        let probe = at(None);
        let plain = scene(1.0, 0.5, Sides::Front);
        let own = Identity::of(&plain, "bvh", &config, &refining, &[probe]);
        assert_eq!(own.check(&own.text()), Ok(()));
        let differs = |other: Identity, part: &str| {
            let message = own.check(&other.text()).unwrap_err();
            assert!(message.contains(part), "{message}");
        };
        let of = |scene: &Scene| Identity::of(scene, "bvh", &config, &refining, &[probe]);
        differs(of(&scene(2.0, 0.5, Sides::Front)), "work: geometry: 1 triangles");
        differs(of(&scene(1.0, 0.6, Sides::Front)), "materials");
        differs(of(&scene(1.0, 0.5, Sides::Both)), "materials");
        differs(
            Identity::of(&plain, "octree", &config, &refining, &[probe]),
            "octree, expected bvh",
        );
        differs(Identity::of(&plain, "bvh", &config, &refining, &[]), "probes: 0");
        let free = Probe::Free { position: DVec3::X, normal: DVec3::Z };
        for moved in [at(Some(0.1)), free] {
            differs(Identity::of(&plain, "bvh", &config, &refining, &[moved]), "probes: 1");
        }
        let other = ShootingConfig { tolerance: 0.1, ..config };
        let message = "shooting: tolerance: 0.1, expected tolerance: 0.01";
        differs(Identity::of(&plain, "bvh", &other, &refining, &[probe]), message);
        let other = RefineConfig { most_depth: 7, ..refining };
        differs(Identity::of(&plain, "bvh", &config, &other, &[probe]), "most_depth: 7");
        let other = RefineConfig { asked: Asked::Error(0.01), ..refining };
        let message = "goal: --error 0.01, expected --elements 100 --converge 0.001";
        differs(Identity::of(&plain, "bvh", &config, &other, &[probe]), message);
        assert!(own.check("").is_err() && own.check(&(own.text() + "more: 1\n")).is_err());
    }
}
