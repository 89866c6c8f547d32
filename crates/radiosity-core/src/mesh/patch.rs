//! Numbers the leaves as elements, and picks the nodes that shoot.

use glam::DVec3;

use super::{Element, Mesh, Patch, triangle_area};

/// Numbers the leaves depth first, so that the elements below a node follow each other.
pub(super) fn number_elements(mesh: &mut Mesh) {
    for root in 0..mesh.roots.len() as u32 {
        number(mesh, root);
    }
}

fn number(mesh: &mut Mesh, node: u32) {
    let first = mesh.elements.len() as u32;
    let node_ref = &mesh.nodes[node as usize];
    if !node_ref.is_leaf() {
        // Depth is at most twice the binary logarithm of the edge ratio: no deep recursion.
        node_ref.children.clone().for_each(|child| number(mesh, child));
    } else {
        let (vertices, root) = (node_ref.vertices, node_ref.root);
        let area = triangle_area(mesh.corners(vertices));
        mesh.elements.push(Element { vertices, points: [0; 3], root, area });
    }
    mesh.nodes[node as usize].elements = first..mesh.elements.len() as u32;
}

/// A patch is at most this many times as large as a mean one: where elements are large because the
/// light is even, patches of as many of them as elsewhere would be too coarse for visibility.
const MOST_OF_MEAN: f64 = 2.0;

/// The highest nodes with at most `most` elements that are not much larger than such nodes are on
/// average.
pub(super) fn choose(mesh: &mut Mesh, most: usize) {
    let whole: f64 = mesh.elements.iter().map(|e| e.area).sum();
    let large = MOST_OF_MEAN * whole * most as f64 / mesh.elements.len().max(1) as f64;
    let mut stack: Vec<u32> = (0..mesh.roots.len() as u32).rev().collect();
    while let Some(id) = stack.pop() {
        let node = &mesh.nodes[id as usize];
        let corners = mesh.corners(node.vertices);
        if !node.is_leaf() && (node.elements.len() > most || triangle_area(corners) > large) {
            stack.extend(node.children.clone().rev());
            continue;
        }
        let (centroid, radius) = bounding(corners);
        let elements = node.elements.clone();
        mesh.patches.push(Patch { node: id, elements, centroid, radius });
    }
}

/// Centroid, and the largest distance of a corner from it.
pub(crate) fn bounding(corners: [DVec3; 3]) -> (DVec3, f64) {
    let centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
    let radius = corners.iter().map(|c| c.distance_squared(centroid)).fold(0.0, f64::max).sqrt();
    (centroid, radius)
}
