//! Each knob of a configuration changes the structure, and none changes an answer.

use accel::{Bvh, BvhConfig, Occluder, Octree, OctreeConfig};

use crate::support::rng::Rng;
use crate::support::{scenes, segments};

#[test]
fn bins_change_the_hierarchy() {
    let scene = scenes::soup(2000, 5);
    let coarse = Bvh::build(&scene, &BvhConfig { bins: 2 });
    let fine = Bvh::build(&scene, &BvhConfig { bins: 32 });
    assert_ne!(coarse.stats(), fine.stats());
    // Outside 2..=32 the number is clamped.
    assert_eq!(Bvh::build(&scene, &BvhConfig { bins: 0 }).stats(), coarse.stats());
    assert_eq!(Bvh::build(&scene, &BvhConfig { bins: 1000 }).stats(), fine.stats());
}

#[test]
fn octree_limits_hold() {
    let scene = scenes::soup(2000, 5);
    let default = OctreeConfig::default();
    let build = |config| Octree::build(&scene, &config).stats();
    assert!(build(default).depth > 3);
    assert_eq!(build(OctreeConfig { max_depth: 3, ..default }).depth, 3);
    assert_eq!(build(OctreeConfig { max_depth: 0, ..default }).leaves, 1);
    assert!(build(OctreeConfig { max_depth: 99, ..default }).depth <= 16);
    let short = build(OctreeConfig { leaf_size: 1, ..default });
    let long = build(OctreeConfig { leaf_size: 100, ..default });
    assert!(short.leaves > long.leaves);
    for max_references in [1, 2, 5] {
        let stats = build(OctreeConfig { max_references, ..default });
        assert!(stats.references <= max_references * scene.len(), "{stats:?}");
    }
}

#[test]
fn no_knob_changes_an_answer() {
    let scene = scenes::soup(300, 6);
    let (lo, hi) = scenes::bounds(&scene);
    let mut occluders: Vec<Box<dyn Occluder>> = Vec::new();
    for bins in [2, 3, 8, 32] {
        occluders.push(Box::new(Bvh::build(&scene, &BvhConfig { bins })));
    }
    for (max_depth, leaf_size, max_references) in
        [(0, 4, 24), (1, 1, 24), (5, 1, 1000), (16, 1, 1000), (16, 0, 24), (10, 20, 2)]
    {
        let config = OctreeConfig { max_depth, leaf_size, max_references };
        let octree = Octree::build(&scene, &config);
        octree.validate().expect("every configuration builds a valid octree");
        occluders.push(Box::new(octree));
    }
    let mut rng = Rng(12);
    for _ in 0..20_000 {
        let segment = segments::random(lo, hi, &mut rng);
        let answers: Vec<bool> = occluders.iter().map(|o| o.occluded(&segment)).collect();
        assert!(answers.iter().all(|a| *a == answers[0]), "{segment:?}: {answers:?}");
    }
}

#[test]
fn builds_are_repeatable() {
    let scene = scenes::soup(1000, 8);
    let bvh = || format!("{:?}", Bvh::build(&scene, &BvhConfig::default()));
    let octree = || format!("{:?}", Octree::build(&scene, &OctreeConfig::default()));
    assert!(bvh() == bvh() && octree() == octree());
}
