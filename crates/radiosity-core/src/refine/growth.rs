//! How the mesh of each level came to be, so that it can come to be again.

use std::io::{self, Write};

use super::level::{Level, Setting};
use super::mark;
use super::surface::Sides;
use super::{Asked, RefineConfig};
use crate::checkpoint::{Inconsistent, Reader, Record, record};
use crate::config::{MeshConfig, Split};
use crate::executor::Executor;
use crate::mesh::Mesh;

/// From one level's mesh to the next.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// How many elements were asked for.
    elements: usize,
    /// What each place of the mesh before deserved; nothing where it does not matter.
    density: Option<Density>,
}

/// A density for each element of a mesh.
#[derive(Clone, Debug)]
struct Density(Vec<f64>);

record!(Growth { elements, density });

impl Growth {
    /// How many elements were asked for.
    pub(super) fn elements(&self) -> usize {
        self.elements
    }
}

/// As a palette and a byte per element: densities go in a dozen steps.
impl Record for Density {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let palette = self.palette();
        palette.write(out)?;
        let Some(palette) = palette else { return self.0.write(out) };
        self.0.len().write(out)?;
        self.0.iter().try_for_each(|density| {
            let place = palette.binary_search_by(|known| known.total_cmp(density));
            (place.unwrap_or_default() as u8).write(out)
        })
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        let Some(palette) = Option::<Vec<f64>>::read(from)? else {
            return Vec::read(from).map(Self);
        };
        let places = Vec::<u8>::read(from)?;
        let densities = places.into_iter().map(|place| palette.get(usize::from(place)).copied());
        let unknown = Inconsistent("it has a density that is not in its palette");
        densities.collect::<Option<_>>().map(Self).ok_or(unknown)
    }
}

impl Density {
    /// All values, sorted; `None` if they are too many for a byte.
    fn palette(&self) -> Option<Vec<f64>> {
        let mut palette: Vec<f64> = Vec::new();
        for density in &self.0 {
            if let Err(place) = palette.binary_search_by(|known| known.total_cmp(density)) {
                palette.insert(place, *density);
            }
            if palette.len() > 256 {
                return None;
            }
        }
        Some(palette)
    }
}

/// A level asks for at most this many times the elements of the one before: four, but that the
/// last one may be half as many again.
const MOST_GROWTH: usize = 8;

impl<E: Executor> Setting<'_, E> {
    /// The way to a mesh of about so many elements: of elements of one size, or finer than the one
    /// before where its light says so.
    pub(super) fn growth(&self, elements: usize, before: Option<&Level>) -> Growth {
        let before = before.filter(|_| self.adaptive());
        let density = before.map(|level| {
            let Level { mesh, solution, counted, .. } = level;
            let mean = Sides::of(self.scene, mesh, solution, *counted).mean();
            Density(mark::densities(level.lit(), mean, *counted, self.executor))
        });
        Growth { elements, density }
    }

    /// The mesh at the end of that way.
    pub(super) fn mesh(&self, growth: &Growth, before: Option<&Mesh>) -> Mesh {
        let RefineConfig { least_area, most_depth, split, .. } = self.refining;
        let config = MeshConfig {
            least_area,
            most_depth,
            split,
            split_black: self.splits_black(),
            ..MeshConfig::with_elements(growth.elements)
        };
        match (&growth.density, before) {
            (Some(Density(density)), Some(mesh)) => {
                mesh.refined_with(density, &config, self.executor)
            }
            _ => Mesh::from_scene_with(self.scene, &config, self.executor),
        }
    }

    /// The mesh of the fewest elements that there is.
    pub(super) fn least(&self) -> MeshConfig {
        let split_black = self.splits_black();
        MeshConfig { split_black, ..MeshConfig::with_elements(1) }
    }

    /// Whether surfaces that reflect nothing are split: where a number of elements is asked for, they
    /// have their share of it.
    fn splits_black(&self) -> bool {
        self.config.needs.black || !matches!(self.refining.asked, Asked::Error(_))
    }

    /// Whether levels follow the light.
    pub(super) fn adaptive(&self) -> bool {
        matches!(self.refining.asked, Asked::Error(_)) && self.refining.split != Split::None
    }

    /// The last mesh of a way that was gone before, and the one before it, if any.
    pub(super) fn regrown(&self, grown: &[Growth]) -> Result<(Option<Mesh>, Mesh), Inconsistent> {
        let most = match self.refining.asked {
            Asked::Error(_) => self.refining.most_elements,
            Asked::Elements(n) | Asked::Unstated(n) => n,
        };
        // Meshes that do not follow the light need none before them.
        let first = if self.adaptive() { 0 } else { grown.len().saturating_sub(2) };
        let (mut before, mut last): (Option<Mesh>, Option<Mesh>) = (None, None);
        for (level, growth) in grown.iter().enumerate().skip(first) {
            before = last.take();
            let have = before.as_ref().map_or(usize::MAX / MOST_GROWTH, |m| m.elements().len());
            let expected = self.adaptive() && level > 0;
            let fits = growth.density.is_some() == expected
                && growth.elements <= most.min(MOST_GROWTH * have.max(1))
                && growth
                    .density
                    .iter()
                    .all(|Density(d)| d.len() == have && d.iter().all(|d| *d > 0.0));
            if !fits {
                return Err(Inconsistent("its meshes do not follow from each other"));
            }
            last = Some(self.mesh(growth, before.as_ref()));
        }
        last.map(|last| (before, last)).ok_or(Inconsistent("it has no mesh"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_come_back_to_the_bit_few_or_many() {
        for many in [3, 256, 257, 1000] {
            let density = Density((0..2000).map(|i| 1.0 / (1 + i % many) as f64).collect());
            let mut bytes = Vec::new();
            density.write(&mut bytes).unwrap();
            let expected =
                if many <= 256 { 8 + 8 * many as usize + 8 + 2000 } else { 8 + 8 * 2000 };
            assert_eq!(bytes.len(), 1 + expected);
            let read = Density::read(&mut Reader::new(&bytes)).unwrap();
            assert!(read.0.iter().zip(&density.0).all(|(a, b)| a.to_bits() == b.to_bits()));
            assert_eq!(read.0.len(), 2000);
        }
    }
}
