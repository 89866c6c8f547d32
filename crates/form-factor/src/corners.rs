//! The corners of a convex polygon: few in place, many on the heap.

use std::ops::Deref;

use glam::DVec3;

/// Corners kept in place: a triangle or a quadrilateral cut by two planes.
const IN_PLACE: usize = 6;

/// A list of corners that allocates only beyond [`IN_PLACE`].
#[derive(Clone, Debug)]
pub(crate) struct Corners {
    few: [DVec3; IN_PLACE],
    many: Vec<DVec3>,
    len: usize,
}

impl Corners {
    pub(crate) fn new() -> Self {
        Self { few: [DVec3::ZERO; IN_PLACE], many: Vec::new(), len: 0 }
    }

    pub(crate) fn push(&mut self, corner: DVec3) {
        if self.len < IN_PLACE {
            self.few[self.len] = corner;
        } else {
            if self.len == IN_PLACE {
                self.many.extend_from_slice(&self.few);
            }
            self.many.push(corner);
        }
        self.len += 1;
    }
}

impl FromIterator<DVec3> for Corners {
    fn from_iter<I: IntoIterator<Item = DVec3>>(corners: I) -> Self {
        let mut out = Self::new();
        for corner in corners {
            out.push(corner);
        }
        out
    }
}

impl Deref for Corners {
    type Target = [DVec3];

    fn deref(&self) -> &[DVec3] {
        if self.len <= IN_PLACE { &self.few[..self.len] } else { &self.many }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_number_of_corners_comes_back_in_order() {
        for count in [0, 1, IN_PLACE, IN_PLACE + 1, 20] {
            let expected: Vec<_> = (0..count).map(|i| DVec3::splat(i as f64)).collect();
            let corners: Corners = expected.iter().copied().collect();
            assert_eq!(&corners[..], &expected[..]);
        }
    }
}
