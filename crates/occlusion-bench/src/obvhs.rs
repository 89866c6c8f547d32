//! The crate `obvhs` behind [`Occluder`].

use std::time::Duration;

use ::obvhs::BvhBuildParams;
use ::obvhs::bvh2::builder::build_bvh2_from_tris;
use ::obvhs::bvh2::{Bvh2, node::Bvh2Node};
use ::obvhs::cwbvh::CwBvh;
use ::obvhs::cwbvh::builder::build_cwbvh_from_tris;
use ::obvhs::cwbvh::node::CwBvhNode;
use ::obvhs::ray::Ray;
use ::obvhs::rt_triangle::RtTriangle;
use accel::{Occluder, Segment};
use glam::{DVec3, Vec3A};

use crate::{INSIDE, Triangle, bounds};

/// Which of the crate's presets builds the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObvhsPreset {
    /// `medium_build`, meant to take about as long as Embree's build.
    Medium,
    /// `very_slow_build`, the preset for the fastest questions.
    VerySlow,
}

/// The shape of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObvhsShape {
    /// Eight compressed boxes to a node (Ylitie, Karras & Laine 2017).
    CwBvh,
    /// Two boxes to a node.
    Bvh2,
}

/// A tree of `obvhs` over triangles in the order of its leaves, as its examples recommend.
///
/// Positions are recentred before they become f32. What a segment ignores is not supported:
/// questions that ignore a triangle are answered as if they did not.
pub struct Obvhs {
    tree: Tree,
    triangles: Vec<RtTriangle>,
    centre: DVec3,
}

enum Tree {
    CwBvh(CwBvh),
    Bvh2(Bvh2),
}

impl Obvhs {
    /// Builds the tree on the calling thread.
    pub fn build(triangles: &[Triangle], shape: ObvhsShape, preset: ObvhsPreset) -> Self {
        let centre = bounds(triangles).map_or(DVec3::ZERO, |(lo, hi)| lo * 0.5 + hi * 0.5);
        let local: Vec<_> = triangles
            .iter()
            .map(|t| {
                let [v0, v1, v2] = t.map(|v| (v - centre).as_vec3a());
                ::obvhs::triangle::Triangle { v0, v1, v2 }
            })
            .collect();
        let parameters = match preset {
            ObvhsPreset::Medium => BvhBuildParams::medium_build(),
            ObvhsPreset::VerySlow => BvhBuildParams::very_slow_build(),
        };
        let mut unread = Duration::ZERO;
        let (tree, order) = match shape {
            ObvhsShape::CwBvh => {
                let mut tree = build_cwbvh_from_tris(&local, parameters, &mut unread);
                let order = std::mem::take(&mut tree.primitive_indices);
                (Tree::CwBvh(tree), order)
            }
            ObvhsShape::Bvh2 => {
                let mut tree = build_bvh2_from_tris(&local, parameters, &mut unread);
                let order = std::mem::take(&mut tree.primitive_indices);
                (Tree::Bvh2(tree), order)
            }
        };
        let triangles = order.iter().map(|i| RtTriangle::from(&local[*i as usize])).collect();
        Self { tree, triangles, centre }
    }

    /// Returns the heap memory of nodes and triangles, in bytes.
    pub fn bytes(&self) -> usize {
        let nodes = match &self.tree {
            Tree::CwBvh(tree) => tree.nodes.capacity() * size_of::<CwBvhNode>(),
            Tree::Bvh2(tree) => tree.nodes.capacity() * size_of::<Bvh2Node>(),
        };
        nodes + self.triangles.capacity() * size_of::<RtTriangle>()
    }
}

impl Occluder for Obvhs {
    fn occluded(&self, segment: &Segment) -> bool {
        let origin: Vec3A = (segment.from - self.centre).as_vec3a();
        let direction: Vec3A = (segment.to - segment.from).as_vec3a();
        if !(origin.is_finite() && direction.is_finite()) || direction == Vec3A::ZERO {
            return false;
        }
        let ray = Ray::new(origin, direction, INSIDE.0, INSIDE.1);
        let test = |ray: &Ray, i: usize| self.triangles[i].intersect(ray);
        // Either stops at the first triangle met.
        !match &self.tree {
            Tree::CwBvh(tree) => tree.ray_traverse_miss(ray, test),
            Tree::Bvh2(tree) => tree.ray_traverse_miss(ray, test),
        }
    }
}
