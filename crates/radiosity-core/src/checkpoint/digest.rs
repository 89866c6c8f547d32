//! A number that tells a mesh from others.

use glam::DVec3;

use crate::mesh::Mesh;

/// A digest of all that the light on a mesh hangs on, its roots' materials apart.
///
/// The same mesh is grown from the same scene by the same program; another build, or another
/// machine's mathematics library, may round a length the other way.
pub(crate) fn digest(mesh: &Mesh) -> u64 {
    let mut sum = Sum(0);
    for count in [mesh.vertices.len(), mesh.elements.len(), mesh.patches.len(), mesh.points.len()] {
        sum.add(count as u64);
    }
    mesh.vertices.iter().for_each(|v| sum.place(*v));
    mesh.points.iter().for_each(|p| sum.place(p.position));
    for element in &mesh.elements {
        let [a, b, c] = element.vertices.map(|v| u64::from(v.0));
        sum.add(a | b << 32);
        sum.add(c | u64::from(element.root) << 32);
    }
    mesh.patches.iter().for_each(|p| sum.add(u64::from(p.elements.end)));
    sum.0
}

/// Fowler, Noll & Vo's hash, a word at a time, with a turn so that high bits come down.
struct Sum(u64);

impl Sum {
    fn add(&mut self, word: u64) {
        const PRIME: u64 = 0x0000_0100_0000_01b3;
        self.0 = (self.0 ^ word).wrapping_mul(PRIME).rotate_left(23);
    }

    fn place(&mut self, place: DVec3) {
        place.to_array().into_iter().for_each(|x| self.add(x.to_bits()));
    }
}
