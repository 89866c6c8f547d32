//! The surfaces that errors are said of: lit sides that do not emit.

use scene::{Rgb, Scene, Solution, SolutionElement};

use crate::mesh::{Element, Mesh};

/// Which sides count, and what of their exitance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Counted {
    /// Sides that do not emit.
    Dark,
    /// All sides emit: what they reflect.
    Reflected,
}

impl Counted {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let dark = mesh.roots().iter().any(|root| root.emittance == Rgb::ZERO);
        if dark { Self::Dark } else { Self::Reflected }
    }

    /// Whether an element takes part.
    pub(super) fn counts(self, mesh: &Mesh, element: &Element) -> bool {
        self == Self::Reflected || mesh.root_of(element).emittance == Rgb::ZERO
    }

    /// The part of an element's exitance that counts.
    pub(super) fn part(self, mesh: &Mesh, element: &Element, exitance: Rgb) -> Rgb {
        match self {
            Self::Dark => exitance,
            Self::Reflected => exitance - mesh.root_of(element).emittance,
        }
    }
}

/// Area and power of the counted part of each input triangle's sides.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// Two per input triangle, front first.
    pub(super) sides: Vec<(f64, Rgb)>,
    pub(super) area: f64,
    pub(super) power: Rgb,
}

impl Sides {
    pub(super) fn of(scene: &Scene, mesh: &Mesh, solution: &Solution, counted: Counted) -> Self {
        let mut sides = vec![(0.0, Rgb::ZERO); 2 * scene.triangles().len()];
        let (mut area, mut power) = (0.0, Rgb::ZERO);
        for (element, lit) in counted_elements(mesh, solution, counted) {
            let part = counted.part(mesh, element, lit.exitance) * element.area;
            let side = &mut sides[side_of(lit)];
            side.0 += element.area;
            side.1 += part;
            area += element.area;
            power += part;
        }
        Self { sides, area, power }
    }

    /// Area mean of what counts.
    pub(super) fn mean(&self) -> Rgb {
        if self.area > 0.0 { self.power / self.area } else { Rgb::ZERO }
    }
}

/// The slot of an element's side of its input triangle.
pub(super) fn side_of(element: &SolutionElement) -> usize {
    2 * element.triangle.index() + usize::from(element.face == scene::Face::Back)
}

/// The elements that count, with their light.
pub(super) fn counted_elements<'a>(
    mesh: &'a Mesh,
    solution: &'a Solution,
    counted: Counted,
) -> impl Iterator<Item = (&'a Element, &'a SolutionElement)> {
    let all = mesh.elements().iter().zip(&solution.elements);
    all.filter(move |(element, _)| counted.counts(mesh, element))
}
