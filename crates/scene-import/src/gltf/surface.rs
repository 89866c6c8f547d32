//! From a glTF material to the material of each triangle.

use std::collections::{BTreeSet, HashMap};

use gltf::material::AlphaMode;
use gltf::mesh::Semantic;
use scene::{Material, MaterialId, Rgb, Sides};

use super::accessor;
use super::budget::Budget;
use super::document::Parsed;
use super::layer::{Images, Layer};
use super::stated::Stated;
use crate::assembler::Assembler;
use crate::texture::SampleGrid;
use crate::units::{self, Decoding};
use crate::{DiagnosticKind, Error};

/// The materials and images of a document.
pub(super) struct Surfaces<'p> {
    parsed: &'p Parsed,
    stated: &'p Stated,
    images: Images<'p>,
    colour: Decoding,
    data: Decoding,
    /// By mesh and primitive: instances look alike.
    known: HashMap<(usize, usize), Vec<MaterialId>>,
    /// Materials whose oddities have been warned about.
    warned: BTreeSet<Option<usize>>,
}

/// A material as one primitive uses it: factors, and what multiplies them.
struct Appearance {
    base: Rgb,
    metallic: f64,
    emittance: Rgb,
    base_layer: Option<Layer>,
    metallic_layer: Option<Layer>,
    emission_layer: Option<Layer>,
    /// Linear, by vertex.
    colours: Option<Vec<[f64; 3]>>,
}

impl<'p> Surfaces<'p> {
    pub(super) fn new(images: Images<'p>, parsed: &'p Parsed, stated: &'p Stated) -> Self {
        Self {
            parsed,
            stated,
            images,
            colour: Decoding::srgb(),
            data: Decoding::linear(),
            known: HashMap::new(),
            warned: BTreeSet::new(),
        }
    }

    /// The material of each of a primitive's triangles, which are given by their vertices.
    pub(super) fn materials(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        mesh: usize,
        path: &str,
        triangles: &[[usize; 3]],
        budget: &mut Budget<'_>,
        assembler: &mut Assembler<'_>,
    ) -> Result<Vec<MaterialId>, Error> {
        let key = (mesh, primitive.index());
        if let Some(known) = self.known.get(&key) {
            return Ok(known.clone());
        }
        let material = primitive.material();
        let stated = material.index().and_then(|index| self.stated.surface(index));
        let materials = if let Some(surface) = stated {
            let stated = Material {
                name: name(&material),
                reflectance: surface.reflectance(),
                emittance: surface.emittance(),
                sides: surface.sides(),
            };
            let id = assembler.material(stated, place(&material))?;
            vec![id; triangles.len()]
        } else {
            self.warn_about(&material, path, assembler);
            if material.index().is_some() {
                self.by_appearance(primitive, triangles, budget, assembler)?
            } else {
                vec![assembler.missing_material("default")?; triangles.len()]
            }
        };
        self.known.insert(key, materials.clone());
        Ok(materials)
    }

    /// The material of each triangle by glTF's own rule.
    fn by_appearance(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        triangles: &[[usize; 3]],
        budget: &mut Budget<'_>,
        assembler: &mut Assembler<'_>,
    ) -> Result<Vec<MaterialId>, Error> {
        let material = primitive.material();
        let appearance = self.appearance(primitive, &material, budget, assembler)?;
        let sides = if material.double_sided() { Sides::Both } else { Sides::Front };
        let (name, place) = (name(&material), place(&material));
        let grid = SampleGrid::for_triangles(triangles.len());
        let mut materials = Vec::with_capacity(triangles.len());
        for &corners in triangles {
            let [reflectance, emittance] = self.values(&appearance, corners, grid);
            let name = name.clone();
            let stated = Material { name, reflectance, emittance, sides };
            materials.push(assembler.material(stated, &place)?);
        }
        Ok(materials)
    }

    fn warn_about(
        &mut self,
        material: &gltf::Material<'_>,
        path: &str,
        assembler: &mut Assembler<'_>,
    ) {
        if !self.warned.insert(material.index()) {
            return;
        }
        let Some(index) = material.index() else {
            let name = "the primitive's material".to_owned();
            return assembler.warn(DiagnosticKind::MissingMaterial { name }, None, path);
        };
        let mut ignore = |what: &str| {
            let place = format!("materials[{index}]");
            assembler.warn(DiagnosticKind::Ignored { what: what.to_owned() }, None, place);
        };
        if material.alpha_mode() != AlphaMode::Opaque {
            ignore("alpha: the surface is opaque");
        }
        let pbr = material.pbr_metallic_roughness();
        if pbr.metallic_factor() > 0.0 && pbr.metallic_roughness_texture().is_none() {
            ignore(&format!(
                "the mirror-like share of the reflectance (metallic {})",
                pbr.metallic_factor()
            ));
        }
    }

    fn appearance(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        material: &gltf::Material<'_>,
        budget: &mut Budget<'_>,
        assembler: &mut Assembler<'_>,
    ) -> Result<Appearance, Error> {
        let pbr = material.pbr_metallic_roughness();
        let [r, g, b, _] = pbr.base_color_factor().map(f64::from);
        let strength = f64::from(material.emissive_strength().unwrap_or(1.0));
        let radiance = Rgb(material.emissive_factor().map(f64::from)) * strength;
        let colours = match primitive.get(&Semantic::Colors(0)) {
            Some(colours) => {
                let mut values = accessor::read(&colours, self.parsed, budget)?;
                if clamp(&mut values) {
                    let what = "what COLOR_0 has beyond [0, 1], as glTF demands".to_owned();
                    let place = format!("accessors[{}]", colours.index());
                    assembler.warn(DiagnosticKind::Ignored { what }, None, place);
                }
                Some(values)
            }
            None => None,
        };
        let mut layer = |info: Option<gltf::texture::Info<'_>>| match info {
            Some(info) => self.images.layer(primitive, &info, budget, assembler),
            None => Ok(None),
        };
        Ok(Appearance {
            base: Rgb::new(r, g, b),
            metallic: f64::from(pbr.metallic_factor()),
            emittance: units::emittance_of_radiance(radiance),
            base_layer: layer(pbr.base_color_texture())?,
            metallic_layer: layer(pbr.metallic_roughness_texture())?,
            emission_layer: layer(material.emissive_texture())?,
            colours,
        })
    }

    /// Mean reflectance and emittance of a triangle. The product of base colour and
    /// 1 − metallic is averaged as a whole: where both vary, the product of means differs.
    fn values(&self, look: &Appearance, corners: [usize; 3], grid: SampleGrid) -> [Rgb; 2] {
        let white = Rgb::splat(1.0);
        let tints = look.colours.as_ref().map(|colours| {
            // A vertex without a colour, as in a list that is too short, is white.
            corners.map(|i| colours.get(i).map_or(white, |&colour| Rgb(colour)))
        });
        let extent = |layers: [&Option<Layer>; 2]| {
            layers.into_iter().flatten().map(|layer| layer.extent(corners)).fold(0.0, f64::max)
        };
        let reflectance = if look.base_layer.is_none() && look.metallic_layer.is_none() {
            let tint = tints.map_or(white, |[a, b, c]| (a + b + c) / 3.0);
            look.base * tint * (1.0 - look.metallic)
        } else {
            look.base
                * grid.mean(extent([&look.base_layer, &look.metallic_layer]), |at| {
                    let tint = tints.map_or(white, |[a, b, c]| a * at[0] + b * at[1] + c * at[2]);
                    let base = look.base_layer.as_ref();
                    let base = base.map_or(white, |layer| layer.at(at, corners, &self.colour));
                    // The metallic share is in the blue channel.
                    let metal = look.metallic_layer.as_ref();
                    let metal = metal.map_or(1.0, |layer| layer.at(at, corners, &self.data)[2]);
                    tint * base * (1.0 - look.metallic * metal)
                })
        };
        let emittance = match &look.emission_layer {
            None => look.emittance,
            // Most surfaces do not emit, and need no look at their texture.
            Some(_) if look.emittance == Rgb::ZERO => Rgb::ZERO,
            Some(layer) => {
                look.emittance
                    * grid.mean(layer.extent(corners), |at| layer.at(at, corners, &self.colour))
            }
        };
        [reflectance, emittance]
    }
}

/// Brings colours into [0, 1]; tells whether some were not.
///
/// # References
/// glTF 2.0, section 3.7.2.1: `COLOR_0` is to be clamped.
fn clamp(colours: &mut [[f64; 3]]) -> bool {
    let mut changed = false;
    for channel in colours.as_flattened_mut() {
        let clamped = channel.clamp(0.0, 1.0);
        changed |= clamped != *channel;
        *channel = clamped;
    }
    changed
}

/// A material's place in the file.
fn place(material: &gltf::Material<'_>) -> String {
    format!("materials[{}]", material.index().unwrap_or_default())
}

/// A material's name, or its number where it has none.
fn name(material: &gltf::Material<'_>) -> String {
    let number = || format!("material {}", material.index().unwrap_or_default());
    material.name().map_or_else(number, str::to_owned)
}
