//! The scene's triangles as a forest of bisected triangles: roots are input triangles, cut where
//! others touch or cross them, less what earlier ones cover; patches shoot, leaves (elements) receive.

mod bisect;
mod centroid;
mod cut;
mod edges;
mod grade;
mod patch;
mod points;
mod weld;

use std::ops::Range;

use glam::DVec3;
use rustc_hash::FxHashSet;
use scene::{Face, Rgb, Scene, TriangleId, VertexId};

use crate::config::{MeshConfig, Split};
use crate::executor::{Executor, Sequential};
use crate::needs;
use bisect::{Forest, Plan};
use cut::Edge;
use grade::Grade;
pub(crate) use patch::bounding;
pub use points::ReceiverPoint;
use weld::Roots;
pub(crate) use weld::extent as scene_extent;

/// A root: one lit side of an input triangle, or of a piece of one that contacts cut, with what
/// its elements have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// The input triangle.
    pub triangle: TriangleId,
    /// Which side of it.
    pub face: Face,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// Reflectance.
    pub reflectance: Rgb,
    /// Emittance, W·m⁻².
    pub emittance: Rgb,
}

/// A triangle of the forest.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Corners, counter-clockwise seen from the lit side.
    pub vertices: [VertexId; 3],
    /// The two or three nodes that it is split into; empty for a leaf.
    pub children: Range<u32>,
    /// Which root it is part of.
    pub root: u32,
    /// The elements below it, or the one it is.
    pub elements: Range<u32>,
}

impl Node {
    fn leaf(vertices: [VertexId; 3], root: u32) -> Self {
        Self { vertices, children: 0..0, root, elements: 0..0 }
    }

    /// Whether it is an element.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.children.is_empty()
    }
}

/// A leaf of the forest: the unit of receiving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Corners, counter-clockwise seen from the lit side.
    pub vertices: [VertexId; 3],
    /// Receiver points at the corners; coplanar neighbours share them.
    pub points: [u32; 3],
    /// Which root it is part of.
    pub root: u32,
    /// Area.
    pub area: f64,
}

/// The unit of shooting: a node of the forest with few elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The node.
    pub node: u32,
    /// Its elements; all patches together cover all elements, in order.
    pub elements: Range<u32>,
    /// Mean of its corners.
    pub centroid: DVec3,
    /// Largest distance of a corner from the centroid.
    pub radius: f64,
}

/// The forest with its elements, patches and receiver points; built once, then read only.
///
/// About 190 bytes per element.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) roots: Vec<Root>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) elements: Vec<Element>,
    pub(crate) patches: Vec<Patch>,
    pub(crate) points: Vec<ReceiverPoint>,
    pub(crate) extent: f64,
    pub(crate) covered: usize,
    /// Edges along contacts, which part receiver points.
    barriers: FxHashSet<Edge>,
}

impl Mesh {
    /// Splits a scene's triangles into about `config.elements` elements.
    ///
    /// First, where `config.cut` says so, triangles are cut along the segments in which others
    /// touch or cross them before a lit side, so that no element lies on both sides of a wall,
    /// or partly under a box. Triangles that nothing touches stay as they are.
    ///
    /// Where triangles overlap in one plane (to a millionth of [`Mesh::extent`]) and face the same
    /// way, the first in the scene's order takes part, and what it covers of the others does not:
    /// a poster in a floor's plane shows if it comes before the floor. Fronts and backs each
    /// follow this rule. What is covered has no elements; a scene of very many overlaps is
    /// left as it is.
    ///
    /// The longest edge of the whole mesh is halved, in all triangles that share it, until
    /// there are enough elements: so no split leaves a T-vertex, and the smallest angle
    /// stays at least half of what it was (Rosenberg & Stenger 1975). Where `config.graded` says so, round a lamp that is small
    /// beside the elements, edges count for longer than they are, until they are about as short as
    /// the lamp is wide or far. Triangles without
    /// area, exact duplicates of earlier ones, and those wholly covered have no elements. Time
    /// N·log N.
    #[must_use]
    pub fn from_scene(scene: &Scene, config: &MeshConfig) -> Self {
        Self::from_scene_with(scene, config, &Sequential)
    }

    /// The same mesh, made with an executor: it places the receiver points, a third of the work.
    #[must_use]
    pub fn from_scene_with<E: Executor>(scene: &Scene, config: &MeshConfig, executor: &E) -> Self {
        let extent = weld::extent(scene);
        let Roots { vertices, roots, corners, barriers, covered } =
            weld::roots(scene, config.cut, extent);
        let grade = match config.graded {
            true => Grade::of(&vertices, &roots, &corners),
            false => Grade::default(),
        };
        let forest = Forest::of_roots(vertices, corners, barriers);
        Self::grown(forest, roots, extent, covered, &grade, None, config, executor)
    }

    /// Splits this mesh further, to about `config.elements` elements, more of them where
    /// `density` is high: how many elements the place of each present element deserves per area,
    /// beside the others. What is here stays: elements become inner nodes, vertices and nodes keep
    /// their numbers. As [`Mesh::from_scene`] in all else; `config.cut` is without effect.
    ///
    /// # Panics
    /// If there are fewer densities than elements.
    #[must_use]
    pub fn refined(&self, density: &[f64], config: &MeshConfig) -> Self {
        self.refined_with(density, config, &Sequential)
    }

    /// The same mesh, made with an executor; see [`Mesh::from_scene_with`].
    ///
    /// # Panics
    /// If there are fewer densities than elements.
    #[must_use]
    pub fn refined_with<E: Executor>(
        &self,
        density: &[f64],
        config: &MeshConfig,
        executor: &E,
    ) -> Self {
        let corners: Vec<_> = self.nodes[..self.roots.len()].iter().map(|n| n.vertices).collect();
        let grade = match config.graded {
            true => Grade::of(&self.vertices, &self.roots, &corners),
            false => Grade::default(),
        };
        let forest = Forest {
            vertices: self.vertices.clone(),
            nodes: self.nodes.clone(),
            barriers: self.barriers.clone(),
        };
        let (roots, extent, covered) = (self.roots.clone(), self.extent, self.covered);
        Self::grown(forest, roots, extent, covered, &grade, Some(density), config, executor)
    }

    #[expect(clippy::too_many_arguments, reason = "each is a part of the mesh, or how it is made")]
    fn grown<E: Executor>(
        forest: Forest,
        roots: Vec<Root>,
        extent: f64,
        covered: usize,
        grade: &Grade,
        density: Option<&[f64]>,
        config: &MeshConfig,
        executor: &E,
    ) -> Self {
        let MeshConfig { least_area, most_depth, .. } = *config;
        let whole = match config.split_black {
            true => Vec::new(),
            false => unlit(&roots),
        };
        let plan = Plan { grade, density, least_area, most_depth, whole: &whole };
        let Forest { vertices, nodes, barriers } = match (density, config.split) {
            (Some(_), Split::Centroid) => forest.cut_at_centroids(&plan, config.elements),
            _ => forest.grow(&plan, config.elements),
        };
        let mut mesh = Self { vertices, roots, nodes, extent, covered, ..Self::default() };
        patch::number_elements(&mut mesh);
        patch::choose(&mut mesh, config.patch_elements.max(1));
        points::place(&mut mesh, &barriers, executor);
        mesh.barriers = barriers;
        mesh
    }

    /// Vertex positions.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The lit sides of the input triangles, in their order, the front before the back; each in
    /// one piece or several.
    #[must_use]
    pub fn roots(&self) -> &[Root] {
        &self.roots
    }

    /// The elements, in the order of their roots.
    #[must_use]
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The patches, in the order of their elements.
    #[must_use]
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The receiver points.
    #[must_use]
    pub fn points(&self) -> &[ReceiverPoint] {
        &self.points
    }

    /// The diagonal of the bounds of all triangles with area: the length that tolerances are
    /// relative to.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.extent
    }

    /// The length by which segments keep off the surfaces they join: what is nearer to a
    /// surface than this is not seen from it. One far-away triangle makes it grow for all.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        crate::shooting::SEGMENT_LIFT * self.extent
    }

    /// How many input triangles are covered by earlier ones, wholly or in part, on a lit side:
    /// those that overlap in one plane, and exact duplicates.
    #[must_use]
    pub fn covered(&self) -> usize {
        self.covered
    }

    /// The root that an element is part of.
    ///
    /// # Panics
    /// If the element is not of this mesh.
    #[must_use]
    pub fn root_of(&self, element: &Element) -> &Root {
        &self.roots[element.root as usize]
    }

    pub(crate) fn corners(&self, vertices: [VertexId; 3]) -> [DVec3; 3] {
        vertices.map(|v| self.vertices[v.index()])
    }
}

/// Which roots neither emit nor reflect any of the light there is.
fn unlit(roots: &[Root]) -> Vec<bool> {
    let black = needs::black(roots);
    roots.iter().zip(black).map(|(root, black)| black && root.emittance == Rgb::ZERO).collect()
}

pub(crate) fn triangle_area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}
