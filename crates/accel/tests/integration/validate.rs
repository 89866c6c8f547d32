//! The structures keep their own promises, and their sizes are what the README says.

use crate::support::all::All;
use crate::support::{Triangle, scenes, shared};

fn check(name: &str, scene: &[Triangle]) {
    let all = All::build(scene);
    all.bvh.validate().expect("a valid hierarchy");
    all.octree.validate().expect("a valid octree");
    let (bvh, octree) = (all.bvh.stats(), all.octree.stats());
    assert_eq!(bvh.triangles, scene.len());
    assert_eq!(octree.triangles, scene.len());
    let per_triangle = |bytes: usize| bytes as f64 / scene.len() as f64;
    println!(
        "{name}: {} triangles; bytes per triangle: brute force {:.0}, BVH {:.0}, octree {:.0}\n  \
         {bvh:?}\n  {octree:?}",
        scene.len(),
        per_triangle(all.brute.bytes()),
        per_triangle(bvh.bytes),
        per_triangle(octree.bytes),
    );
}

#[test]
fn made_scenes() {
    check("room", &scenes::room());
    check("columns", &scenes::columns(8, 12));
    check("soup", &scenes::soup(3000, 1));
    check("sphere", &scenes::sphere(20));
    check("cube", &scenes::cube(8));
}

#[test]
fn shared_scenes() {
    for name in ["box", "room", "blocks", "church"] {
        if let Some(scene) = shared::scene(name) {
            check(name, &scene);
        }
    }
}
