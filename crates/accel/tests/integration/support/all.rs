//! All structures over one scene.

use accel::{
    BruteForce, BruteForceConfig, Bvh, BvhConfig, Occluder, Octree, OctreeConfig, Segment,
};

use super::Triangle;

/// The three structures that must give the same answers.
pub(crate) struct All {
    pub(crate) brute: BruteForce,
    pub(crate) bvh: Bvh,
    pub(crate) octree: Octree,
}

impl All {
    pub(crate) fn build(triangles: &[Triangle]) -> Self {
        Self {
            brute: BruteForce::build(triangles, &BruteForceConfig::default()),
            bvh: Bvh::build(triangles, &BvhConfig::default()),
            octree: Octree::build(triangles, &OctreeConfig::default()),
        }
    }

    /// The common answer; panics if the structures differ.
    pub(crate) fn occluded(&self, segment: &Segment) -> bool {
        let brute = self.brute.occluded(segment);
        assert_eq!(self.bvh.occluded(segment), brute, "BVH, {segment:?}");
        assert_eq!(self.octree.occluded(segment), brute, "octree, {segment:?}");
        brute
    }
}
