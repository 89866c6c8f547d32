//! Triangles over the same three points, facing the same way.

use std::collections::HashMap;

use scene::{Scene, TriangleId, VertexId};

/// For each triangle the first one with the same corners in the same sense of rotation,
/// most often itself.
pub(super) fn firsts(scene: &Scene, triangles: &[TriangleId]) -> Vec<TriangleId> {
    let mut seen = HashMap::with_capacity(triangles.len());
    let corners = |id: TriangleId| turned(scene.triangles()[id.index()].vertices);
    triangles.iter().map(|&id| *seen.entry(corners(id)).or_insert(id)).collect()
}

/// The corners, turned so that the smallest id comes first.
fn turned([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_keeps_the_sense_of_rotation() {
        let key = |ids: [u32; 3]| turned(ids.map(VertexId)).map(|v| v.0);
        assert_eq!(key([1, 2, 3]), [1, 2, 3]);
        assert_eq!(key([2, 3, 1]), [1, 2, 3]);
        assert_eq!(key([3, 1, 2]), [1, 2, 3]);
        assert_eq!(key([3, 2, 1]), [1, 3, 2]);
    }
}
