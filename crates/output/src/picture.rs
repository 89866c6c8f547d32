//! A picture of the lit scene: z-buffered elements, exitance interpolated between their
//! corners in perspective, still linear until it is shown.
//!
//! What is seen is the front of each element; a two-sided surface has elements on both
//! sides. A surface seen from behind is left out, so that a camera outside a room of
//! one-sided walls sees into it.

mod draw;
#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "png")]
mod png;
mod raster;
mod view;

use scene::{Camera, Rgb, Scene, Solution};

use crate::check::{Width, check};
use crate::options::check_picture;
use crate::tone::{BACKGROUND, Exposure, Reading, curve, srgb_byte};
use crate::{Error, Options, camera};

#[cfg(feature = "exr")]
pub(crate) use exr::write as write_exr;
#[cfg(feature = "png")]
pub(crate) use png::write as write_png;
pub(crate) use raster::ScreenTriangle;
pub(crate) use view::View;

/// A picture in linear exitance.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<Pixel>,
}

/// What a pixel shows. Lamps are kept apart from the surfaces they light, because they
/// are often a thousand times brighter: averaged together, one sample of a lamp would
/// turn its whole pixel white, and every lamp would have jagged edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Surfaces that do not emit.
    pub surface: Layer,
    /// Surfaces that emit, with all of their exitance.
    pub lamp: Layer,
}

/// The samples of a pixel that show one kind of surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Layer {
    /// Mean exitance of those samples; zero without any.
    pub light: [f32; 3],
    /// Their share of the pixel's samples.
    pub share: f32,
}

/// Draws the solution as the camera sees it, with `samples` × `samples` samples a pixel,
/// on a regular grid.
///
/// # Errors
/// A solution that does not belong to the scene or is not finite, a camera that looks
/// nowhere, or a size or sampling outside the range that [`Options`] states.
///
/// # Examples
/// ```
/// # use scene::{Scene, Solution};
/// use output::picture::render;
///
/// # let (scene, solution) = (Scene::default(), Solution::default());
/// let camera = output::camera::automatic(&scene);
/// let picture = render(&scene, &solution, &camera, (64, 48), 3)?;
/// assert_eq!(picture.pixels().len(), 64 * 48);
/// # Ok::<(), output::Error>(())
/// ```
pub fn render(
    scene: &Scene,
    solution: &Solution,
    camera: &Camera,
    size: (u32, u32),
    samples: u32,
) -> Result<Picture, Error> {
    check_picture(size, samples)?;
    check(scene, solution, Width::Single)?;
    let view = View::new(camera, (size.0 * samples, size.1 * samples))?;
    let pixels = draw::draw(scene, solution, &view, samples);
    Ok(Picture { width: size.0, height: size.1, pixels })
}

impl Picture {
    /// Pixels along a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    /// Display light per unit of exitance, automatic exposure being metered on what the
    /// picture shows.
    #[must_use]
    pub fn scale(&self, exposure: Exposure) -> f64 {
        let reading = |layer: Layer, emits| Reading {
            light: layer.light.map(f64::from).into_iter().fold(0.0, f64::max),
            weight: f64::from(layer.share),
            emits,
        };
        let both = |p: &Pixel| [reading(p.surface, false), reading(p.lamp, true)];
        let shown = |r: &Reading| r.weight > 0.0;
        exposure.scale(|| self.pixels.iter().flat_map(both).filter(shown).collect())
    }

    /// The picture as sRGB bytes, three a pixel. Each layer goes through [`curve`], and
    /// they and [`BACKGROUND`] are then mixed by their shares, in linear display light.
    #[must_use]
    pub fn to_srgb(&self, scale: f64) -> Vec<u8> {
        self.pixels.iter().flat_map(|pixel| pixel.to_srgb(scale)).collect()
    }
}

impl Pixel {
    /// Mean exitance over the whole pixel, nothing counting as black.
    #[must_use]
    pub fn light(&self) -> Rgb {
        let whole = |l: Layer| Rgb(l.light.map(f64::from)) * f64::from(l.share);
        whole(self.surface) + whole(self.lamp)
    }

    fn to_srgb(self, scale: f64) -> [u8; 3] {
        let (surface, lamp) = (f64::from(self.surface.share), f64::from(self.lamp.share));
        [0, 1, 2].map(|c| {
            let shown = |layer: Layer| curve(f64::from(layer.light[c]) * scale);
            let nothing = BACKGROUND * (1.0 - surface - lamp).max(0.0);
            srgb_byte(surface * shown(self.surface) + lamp * shown(self.lamp) + nothing)
        })
    }
}

/// Draws through the camera of the options, or the scene's first, or one found for it.
fn draw_with(scene: &Scene, solution: &Solution, options: &Options) -> Result<Picture, Error> {
    let chosen = options.camera.as_ref().or(scene.cameras().first());
    let camera = chosen.cloned().unwrap_or_else(|| camera::automatic(scene));
    render(scene, solution, &camera, options.size, options.samples)
}
