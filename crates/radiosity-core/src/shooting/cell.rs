//! A piece of the shooter, as fine as one receiver needs it.

use std::ops::Range;

use glam::DVec3;
use scene::Rgb;

use crate::census::Census;
use crate::mesh::{Element, Mesh, Patch, bounding};

/// Places on a cell of several elements that segments start from. Each receiver takes one of
/// them, its neighbours others: what is hidden of the cell is then hidden from that share of the
/// receivers. A cell of one element, or of elements that shine alike, has its middle alone:
/// where a lamp is hidden in part it is split instead, and its shadows stay smooth.
///
/// From the middle alone, a strip along a lamp's foot, where the light is, was seen by nearly all
/// that should not see it: .4 % too much light in a room.
pub(super) const ORIGINS: usize = 8;

/// A flat piece of the shooter with one unshot exitance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) corners: [DVec3; 3],
    /// Where its light starts, as seen from afar.
    pub(super) centroid: DVec3,
    /// The middle of its corners: how near it is must not depend on its light.
    pub(super) middle: DVec3,
    /// Where segments start, each for as much of the light as the others.
    pub(super) origins: [DVec3; ORIGINS],
    /// How many of the origins differ: the first, or all.
    pub(super) places: usize,
    pub(super) area: f64,
    /// Largest distance of a corner from the centroid.
    pub(super) radius: f64,
    pub(super) longest: f64,
    /// Mean unshot exitance.
    pub(super) unshot: Rgb,
    /// Share of it that lies in the open; below 1 for an element that reaches under
    /// something.
    pub(super) open: f64,
    /// What may replace it.
    pub(super) parts: Parts,
}

/// How a cell can be split.
#[derive(Clone, Copy, Debug)]
pub(super) enum Parts {
    /// Cells of the mesh, with unshot exitances of their own: the first, and the one after the last.
    Mesh(u32, u32),
    /// Four geometric quarters, alike, this many times more.
    Quarters(u8),
}

impl Cell {
    fn new(corners: [DVec3; 3], area: f64, unshot: Rgb, parts: Parts) -> Self {
        let (centroid, radius) = bounding(corners);
        let [a, b, c] = corners;
        let longest =
            (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        let origins = [centroid; ORIGINS];
        let longest = longest.sqrt();
        let middle = centroid;
        let (places, open) = (1, 1.0);
        Self {
            corners,
            centroid,
            middle,
            origins,
            places,
            area,
            radius,
            longest,
            unshot,
            open,
            parts,
        }
    }

    /// The four similar quarters of a cell that the mesh does not split. What is covered
    /// of it blocks the light of the quarters there, so all shine like the open part.
    pub(super) fn quarters(&self, left: u8) -> [Self; 4] {
        let [a, b, c] = self.corners;
        let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]].map(|corners| {
            Self::new(corners, self.area / 4.0, self.unshot / self.open, Parts::Quarters(left - 1))
        })
    }
}

/// Lays the cells of a patch out in `cells`, the whole patch first. A cell that the mesh does
/// not split may be quartered `quarterings` times.
pub(super) fn cells_of(
    mesh: &Mesh,
    census: &Census,
    patch: &Patch,
    unshot: &[Rgb],
    quarterings: u8,
    cells: &mut Vec<Cell>,
) {
    let cell_of = |node| cell_of(mesh, census, node, unshot, quarterings);
    cells.clear();
    cells.push(cell_of(patch.node));
    let mut nodes = vec![patch.node];
    let mut i = 0;
    while i < cells.len() {
        let children = mesh.nodes[nodes[i] as usize].children.clone();
        if !children.is_empty() {
            let first = cells.len() as u32;
            cells[i].parts = Parts::Mesh(first, first + children.len() as u32);
            for node in children {
                nodes.push(node);
                cells.push(cell_of(node));
            }
        }
        i += 1;
    }
}

/// A node with its mean unshot exitance; its light starts where most of it leaves.
fn cell_of(mesh: &Mesh, census: &Census, node: u32, unshot: &[Rgb], quarterings: u8) -> Cell {
    let node = &mesh.nodes[node as usize];
    let range = node.elements.start as usize..node.elements.end as usize;
    if let [element] = &mesh.elements[range.clone()] {
        return element_cell(mesh, census, element, unshot[range.start], quarterings);
    }
    let mut power = Rgb::ZERO;
    let mut area = 0.0;
    let (mut weighted, mut weight) = (DVec3::ZERO, 0.0);
    for (element, u) in mesh.elements[range.clone()].iter().zip(&unshot[range.clone()]) {
        power += *u * element.area;
        area += element.area;
        let (centroid, _) = open_part(mesh, census, element);
        let share = u.abs().sum() * element.area;
        weighted += centroid * share;
        weight += share;
    }
    let parts = Parts::Quarters(quarterings);
    let mut cell = Cell::new(mesh.corners(node.vertices), area, power / area, parts);
    if weight > 0.0 {
        cell.centroid = weighted / weight;
        cell.origins = [cell.centroid; ORIGINS];
        let uneven = unshot[range.clone()].windows(2).any(|pair| pair[0] != pair[1]);
        if uneven {
            spread_origins(mesh, census, range, unshot, weight, &mut cell.origins);
            cell.places = ORIGINS;
        }
    }
    cell
}

/// Places on the elements, each at an equal step of the power.
fn spread_origins(
    mesh: &Mesh,
    census: &Census,
    range: Range<usize>,
    unshot: &[Rgb],
    power: f64,
    origins: &mut [DVec3; ORIGINS],
) {
    let mut passed = 0.0;
    let mut i = 0;
    for (element, u) in mesh.elements[range.clone()].iter().zip(&unshot[range.clone()]) {
        passed += u.abs().sum() * element.area;
        while i < ORIGINS && passed * ORIGINS as f64 > power * (i as f64 + 0.5) {
            let (centroid, open) = open_part(mesh, census, element);
            let corners = mesh.corners(element.vertices);
            origins[i] = if open < 1.0 { centroid } else { place(corners, i) };
            i += 1;
        }
    }
}

/// The i-th of [`ORIGINS`] places spread over a triangle (Roberts 2018).
fn place([a, b, c]: [DVec3; 3], i: usize) -> DVec3 {
    let [u, v] = [0.754_877_666_246_693, 0.569_840_290_998_053]
        .map(|step| (0.5 + step * (i as f64 + 0.5)).fract());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    a + (b - a) * u + (c - a) * v
}

/// An element as a cell: seen from afar, its light starts in its open part.
///
/// The element's mean irradiance counts what is covered as dark. Were its light to start
/// from under the cover, the cover would take its toll a second time.
fn element_cell(
    mesh: &Mesh,
    census: &Census,
    element: &Element,
    unshot: Rgb,
    quarterings: u8,
) -> Cell {
    let parts = Parts::Quarters(quarterings);
    let mut cell = Cell::new(mesh.corners(element.vertices), element.area, unshot, parts);
    (cell.centroid, cell.open) = open_part(mesh, census, element);
    cell.origins = [cell.centroid; ORIGINS];
    cell
}

/// The middle of the part of an element that does not reach under something, and its share
/// as the mean of the corners sees it.
fn open_part(mesh: &Mesh, census: &Census, element: &Element) -> (DVec3, f64) {
    let corners = mesh.corners(element.vertices);
    let (centroid, _) = bounding(corners);
    let in_the_open = |i: &usize| !census.buried(element.points[*i]);
    let open = (0..3).filter(in_the_open).count();
    if open == 0 || open == 3 {
        return (centroid, 1.0);
    }
    let middle: DVec3 = (0..3).filter(in_the_open).map(|i| corners[i]).sum::<DVec3>() / open as f64;
    // Half of the way to the open corners: the cover ends anywhere in between.
    (centroid.midpoint(middle), open as f64 / 3.0)
}
