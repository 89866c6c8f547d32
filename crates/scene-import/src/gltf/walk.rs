//! The nodes of the scene, each with its place in the world.

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::scene::Transform;
use gltf::{Document, Node};

use super::stated::Stated;
use crate::{Error, ErrorKind};

/// A node and its transform to world coordinates.
pub(super) struct Placed<'d> {
    pub(super) node: Node<'d>,
    pub(super) world: DMat4,
}

/// The scene that is read: the default one, or the first.
pub(super) fn scene(document: &Document) -> Option<gltf::Scene<'_>> {
    document.default_scene().or_else(|| document.scenes().next())
}

/// The nodes of the scene that is read, parents before children, siblings in order. A file
/// without scenes shows every node.
pub(super) fn walk<'d>(
    document: &'d Document,
    stated: &Stated,
    file: &str,
) -> Result<Vec<Placed<'d>>, Error> {
    let mut roots: Vec<Node<'d>> = match scene(document) {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut is_child = vec![false; document.nodes().len()];
            document
                .nodes()
                .flat_map(|node| node.children())
                .for_each(|c| is_child[c.index()] = true);
            document.nodes().filter(|node| !is_child[node.index()]).collect()
        }
    };
    // A stack of its own, as a chain of nodes may be longer than the call stack is deep.
    roots.reverse();
    let mut stack: Vec<_> = roots.into_iter().map(|node| (node, DMat4::IDENTITY)).collect();
    let mut seen = vec![false; document.nodes().len()];
    let mut placed = Vec::new();
    while let Some((node, parent)) = stack.pop() {
        // glTF allows trees alone; cycles would never end, and shared nodes would multiply.
        if std::mem::replace(&mut seen[node.index()], true) {
            let message =
                format!("nodes[{}]: expected at most one parent for each node", node.index());
            return Err(Error::new(ErrorKind::Invalid, file, message));
        }
        let world = parent * local(&node, stated);
        let children = stack.len();
        stack.extend(node.children().map(|child| (child, world)));
        stack[children..].reverse();
        placed.push(Placed { node, world });
    }
    Ok(placed)
}

/// The node's own transform, in f64 from the file's numbers on.
fn local(node: &Node<'_>, stated: &Stated) -> DMat4 {
    match node.transform() {
        Transform::Matrix { matrix } => DMat4::from_cols_array_2d(
            &matrix.map(|column| DVec4::from(column.map(f64::from)).to_array()),
        ),
        Transform::Decomposed { translation, rotation, scale } => {
            DMat4::from_scale_rotation_translation(
                DVec3::from(scale.map(f64::from)),
                // f32 leaves the quaternion's length 1e-7 off, which would scale the mesh.
                DQuat::from_array(stated.rotation(node.index(), rotation)).normalize(),
                DVec3::from(stated.translation(node.index(), translation)),
            )
        }
    }
}
