//! The materials that faces name, resolved through the libraries.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use scene::{Material, MaterialId, Rgb, Sides};

use super::mtl::{self, MtlMaterial};
use super::survey::{Face, Survey};
use crate::assembler::{Assembler, MISSING_REFLECTANCE};
use crate::beside::Beside;
use crate::open::Source;
use crate::texture::{SampleGrid, TexelBudget, Texture, Wrap, interpolate};
use crate::units::{self, Decoding};
use crate::{DiagnosticKind, Error};

/// What each material number of a survey stands for.
pub(super) struct Materials<'a> {
    file: &'a str,
    entries: Vec<Entry>,
    textures: Vec<Texture>,
    decoding: Decoding,
    grid: SampleGrid,
}

enum Entry {
    Plain(MaterialId),
    Textured(Textured),
}

/// A material whose values differ from triangle to triangle.
struct Textured {
    name: String,
    /// Its place in the library.
    place: String,
    reflectance: Rgb,
    emittance: Rgb,
    /// Into the textures.
    reflectance_map: Option<usize>,
    emittance_map: Option<usize>,
    /// Whether a face without texture coordinates has been warned about.
    warned: bool,
}

impl<'a> Materials<'a> {
    /// Reads the libraries and textures; what is missing is warned about.
    pub(super) fn load(
        source: &Source<'a>,
        mut beside: Beside<'_>,
        survey: &Survey,
        assembler: &mut Assembler<'_>,
    ) -> Result<Self, Error> {
        let library = libraries(source, &mut beside, survey, assembler)?;
        let mut textures = Textures::new(source.bytes.len(), beside);
        let mut entries = Vec::with_capacity(survey.materials.len());
        for (name, line) in &survey.materials {
            let place = format!("{}:{line}", source.name);
            let named = name.as_ref().and_then(|name| library.get(name.as_str()));
            entries.push(match (named, name) {
                (Some(material), _) => entry(material, &mut textures, assembler)?,
                (None, Some(name)) => {
                    let kind = DiagnosticKind::MissingMaterial { name: format!("material {name}") };
                    assembler.warn(kind, None, place);
                    Entry::Plain(assembler.missing_material(name)?)
                }
                (None, None) => {
                    let name = "a usemtl before this face".to_owned();
                    assembler.warn(DiagnosticKind::MissingMaterial { name }, None, place);
                    Entry::Plain(assembler.missing_material("default")?)
                }
            });
        }
        let grid = SampleGrid::for_triangles(survey.faces.len());
        let (textures, decoding) = (textures.decoded, Decoding::srgb());
        Ok(Self { file: source.name, entries, textures, decoding, grid })
    }

    /// The material of a triangle of a face, with its texture coordinates.
    pub(super) fn of(
        &mut self,
        face: &Face,
        uv: Option<[[f64; 2]; 3]>,
        assembler: &mut Assembler<'_>,
    ) -> Result<MaterialId, Error> {
        let textured = match &mut self.entries[face.material as usize] {
            Entry::Plain(id) => return Ok(*id),
            Entry::Textured(textured) => textured,
        };
        if uv.is_none() && !std::mem::replace(&mut textured.warned, true) {
            let name = format!("of material {}", textured.name);
            let reason = "a face has no texture coordinates".to_owned();
            let place = format!("{}:{}", self.file, face.line);
            assembler.warn(DiagnosticKind::MissingTexture { name, reason }, None, place);
        }
        // OBJ counts v upwards from the bottom.
        let uv = uv.map(|uv| uv.map(|[u, v]| [u, 1.0 - v]));
        let mean = |map: Option<usize>| match (map.map(|index| &self.textures[index]), uv) {
            (Some(texture), Some(uv)) => self.grid.mean(texture.extent(uv), |at| {
                texture.at(interpolate(at, uv), [Wrap::Repeat; 2], &self.decoding)
            }),
            _ => Rgb::splat(1.0),
        };
        let material = Material {
            name: textured.name.clone(),
            reflectance: textured.reflectance * mean(textured.reflectance_map),
            emittance: textured.emittance * mean(textured.emittance_map),
            sides: Sides::Front,
        };
        assembler.material(material, &textured.place)
    }
}

/// All materials of all libraries; of two with one name the later counts.
fn libraries(
    source: &Source<'_>,
    beside: &mut Beside<'_>,
    survey: &Survey,
    assembler: &mut Assembler<'_>,
) -> Result<HashMap<String, MtlMaterial>, Error> {
    let mut all = HashMap::new();
    // A library that is named again says nothing new, but its warnings would be there again.
    let mut read = HashSet::new();
    for (line, names) in &survey.libraries {
        // A statement may name several files, and a file's name may hold blanks.
        let files: Vec<&str> = match beside.find(names) {
            Ok(_) => vec![names],
            Err(_) => names.split(' ').collect(),
        };
        for name in files {
            let found = beside.find(name);
            if found.as_ref().is_ok_and(|path| !read.insert(path.clone())) {
                continue;
            }
            match found.and_then(|path| beside.read_found(&path)) {
                Ok(bytes) => {
                    let file = Path::new(name).file_name().unwrap_or_default().to_string_lossy();
                    let (materials, warnings) =
                        mtl::parse(&file, &String::from_utf8_lossy(&bytes))?;
                    for (line, kind) in warnings {
                        assembler.warn(kind, None, format!("{file}:{line}"));
                    }
                    all.extend(materials.into_iter().map(|m| (m.name.clone(), m)));
                }
                Err(reason) => {
                    let name = format!("material library {name:?} ({reason})");
                    let place = format!("{}:{line}", source.name);
                    assembler.warn(DiagnosticKind::MissingMaterial { name }, None, place);
                }
            }
        }
    }
    Ok(all)
}

fn entry(
    material: &MtlMaterial,
    textures: &mut Textures<'_>,
    assembler: &mut Assembler<'_>,
) -> Result<Entry, Error> {
    let MtlMaterial { name, place, reflectance, radiance, reflectance_map, radiance_map } =
        material;
    let mut load =
        |map: &Option<String>| map.as_ref().and_then(|file| textures.load(file, place, assembler));
    let maps = [load(reflectance_map), load(radiance_map)];
    // A map that could be read stands for itself where there is no factor.
    let reflectance = match (reflectance, maps[0]) {
        (Some(stated), _) => Rgb(*stated),
        (None, Some(_)) => Rgb::splat(1.0),
        (None, None) => {
            let name = format!("Kd of material {name}");
            assembler.warn(DiagnosticKind::MissingMaterial { name }, None, place.as_str());
            MISSING_REFLECTANCE
        }
    };
    let radiance = match (radiance, maps[1]) {
        (Some(stated), _) => Rgb(*stated),
        (None, Some(_)) => Rgb::splat(1.0),
        (None, None) => Rgb::ZERO,
    };
    let emittance = units::emittance_of_radiance(radiance);
    let name = name.clone();
    if maps == [None; 2] {
        let sides = Sides::Front;
        let material = Material { name, reflectance, emittance, sides };
        return Ok(Entry::Plain(assembler.material(material, place)?));
    }
    let [reflectance_map, emittance_map] = maps;
    let warned = false;
    Ok(Entry::Textured(Textured {
        name,
        place: place.clone(),
        reflectance,
        emittance,
        reflectance_map,
        emittance_map,
        warned,
    }))
}

/// Textures by file, each decoded once.
struct Textures<'a> {
    /// Bytes of the OBJ file.
    length: usize,
    beside: Beside<'a>,
    budget: TexelBudget,
    by_name: HashMap<String, Option<usize>>,
    decoded: Vec<Texture>,
}

impl<'a> Textures<'a> {
    fn new(length: usize, beside: Beside<'a>) -> Self {
        let (by_name, decoded) = (HashMap::new(), Vec::new());
        Self { length, beside, budget: TexelBudget::new(), by_name, decoded }
    }

    /// The number of a texture; a missing one is warned about once.
    fn load(&mut self, file: &str, place: &str, assembler: &mut Assembler<'_>) -> Option<usize> {
        if let Some(&known) = self.by_name.get(file) {
            return known;
        }
        let texture = self.beside.read(file).and_then(|bytes| {
            let behind = self.length.saturating_add(self.beside.bytes());
            Texture::decode(&bytes, behind, &mut self.budget)
        });
        let number = match texture {
            Ok(texture) => {
                self.decoded.push(texture);
                Some(self.decoded.len() - 1)
            }
            Err(reason) => {
                let kind = DiagnosticKind::MissingTexture { name: file.to_owned(), reason };
                assembler.warn(kind, None, place);
                None
            }
        };
        self.by_name.insert(file.to_owned(), number);
        number
    }
}
