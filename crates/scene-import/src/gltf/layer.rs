//! Textures as a primitive's material uses them.

use std::collections::HashMap;
use std::rc::Rc;

use gltf::mesh::Semantic;
use gltf::texture::WrappingMode;
use scene::Rgb;

use super::accessor::{self, view_bytes};
use super::budget::Budget;
use super::document::Parsed;
use super::uri;
use crate::assembler::Assembler;
use crate::beside::Beside;
use crate::texture::{TexelBudget, Texture, Wrap, interpolate};
use crate::units::Decoding;
use crate::{DiagnosticKind, Error};

/// The images of a document, each decoded when it is first used.
pub(super) struct Images<'p> {
    parsed: &'p Parsed,
    /// Bytes of the file itself.
    length: usize,
    beside: Beside<'p>,
    budget: TexelBudget,
    /// By number; `None` for one that cannot be used.
    decoded: HashMap<usize, Option<Rc<Texture>>>,
}

/// A texture with the texture coordinates of a primitive.
pub(super) struct Layer {
    texture: Rc<Texture>,
    wrap: [Wrap; 2],
    /// By vertex.
    uv: Vec<[f64; 2]>,
}

impl<'p> Images<'p> {
    pub(super) fn new(parsed: &'p Parsed, length: usize, beside: Beside<'p>) -> Self {
        let decoded = HashMap::new();
        Self { parsed, length, beside, budget: TexelBudget::new(), decoded }
    }

    /// The layer that a material's texture makes on a primitive; `None`, after a warning,
    /// where its image cannot be used.
    pub(super) fn layer(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        info: &gltf::texture::Info<'_>,
        budget: &mut Budget<'_>,
        assembler: &mut Assembler<'_>,
    ) -> Result<Option<Layer>, Error> {
        let texture = info.texture();
        let Some(image) = self.image(texture.source().index(), assembler) else { return Ok(None) };
        let transform = info.texture_transform();
        let set = transform.as_ref().and_then(|t| t.tex_coord()).unwrap_or(info.tex_coord());
        let mut uv: Vec<[f64; 2]> = match primitive.get(&Semantic::TexCoords(set)) {
            Some(coordinates) => accessor::read(&coordinates, self.parsed, budget)?,
            None => {
                let name = format!("images[{}]", texture.source().index());
                let reason = format!("the primitive has no TEXCOORD_{set}");
                let place = format!("primitives[{}]", primitive.index());
                assembler.warn(DiagnosticKind::MissingTexture { name, reason }, None, place);
                return Ok(None);
            }
        };
        if let Some(transform) = transform {
            let [scale, offset] = [transform.scale(), transform.offset()].map(|v| v.map(f64::from));
            let (sin, cos) = f64::from(transform.rotation()).sin_cos();
            for [u, v] in &mut uv {
                // KHR_texture_transform: scale, then rotate, then shift.
                let [x, y] = [*u * scale[0], *v * scale[1]];
                [*u, *v] = [cos * x + sin * y + offset[0], cos * y - sin * x + offset[1]];
            }
        }
        let sampler = texture.sampler();
        let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(|mode| match mode {
            WrappingMode::Repeat => Wrap::Repeat,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
            WrappingMode::ClampToEdge => Wrap::Clamp,
        });
        Ok(Some(Layer { texture: image, wrap, uv }))
    }

    fn image(&mut self, index: usize, assembler: &mut Assembler<'_>) -> Option<Rc<Texture>> {
        if let Some(known) = self.decoded.get(&index) {
            return known.clone();
        }
        let texture = self.bytes(index).and_then(|bytes| {
            let behind = self.length.saturating_add(self.beside.bytes());
            Texture::decode(&bytes, behind, &mut self.budget)
        });
        let decoded = match texture {
            Ok(texture) => Some(Rc::new(texture)),
            Err(reason) => {
                let image = &self.parsed.document.as_json().images[index];
                let name = image.uri.as_deref().or(image.name.as_deref());
                let name = name.map_or_else(|| "without a name".to_owned(), uri::shortened);
                let kind = DiagnosticKind::MissingTexture { name, reason };
                assembler.warn(kind, None, format!("images[{index}]"));
                None
            }
        };
        self.decoded.insert(index, decoded.clone());
        decoded
    }

    /// The encoded image. The JSON is asked, as the gltf crate's `Image::source` panics
    /// where it is incomplete.
    fn bytes(&mut self, index: usize) -> Result<Vec<u8>, String> {
        let document = &self.parsed.document;
        let image = &document.as_json().images[index];
        match (image.buffer_view, &image.uri) {
            (Some(view), _) => {
                let view =
                    document.views().nth(view.value()).ok_or("its buffer view is missing")?;
                Ok(view_bytes(self.parsed, &view)?.to_vec())
            }
            (None, Some(uri)) => uri::fetch(uri, &mut self.beside),
            (None, None) => Err("it has neither a buffer view nor a URI".to_owned()),
        }
    }
}

impl Layer {
    /// The texture's linear colour at a barycentric point of a triangle.
    pub(super) fn at(&self, at: [f64; 3], corners: [usize; 3], decoding: &Decoding) -> Rgb {
        self.texture.at(interpolate(at, self.footprint(corners)), self.wrap, decoding)
    }

    /// The longest edge of a triangle's footprint, in texels.
    pub(super) fn extent(&self, corners: [usize; 3]) -> f64 {
        self.texture.extent(self.footprint(corners))
    }

    /// A vertex without a coordinate, as in a list that is too short, is at the origin.
    fn footprint(&self, corners: [usize; 3]) -> [[f64; 2]; 3] {
        corners.map(|i| self.uv.get(i).copied().unwrap_or_default())
    }
}
