//! Separate things: what stands alone can be passed by alone.

use glam::DVec3;

use super::weld::{Sets, Welded};

/// Things in which blocking triangles hang together by their corners.
#[derive(Clone, Debug, Default)]
pub struct Objects(pub(super) Vec<Object>);

#[derive(Clone, Debug)]
pub(super) struct Object {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    /// Its corners, each once.
    pub(super) places: Vec<DVec3>,
}

impl Objects {
    /// Sorts the triangles that `may_block` into objects, the largest first.
    #[must_use]
    pub fn of(triangles: &[[DVec3; 3]], may_block: impl Fn(usize) -> bool) -> Self {
        let welded = Welded::of(triangles);
        let mut sets = Sets::new(welded.places.len());
        let mut used = vec![false; welded.places.len()];
        for (_, [a, b, c]) in welded.corners.iter().enumerate().filter(|(t, _)| may_block(*t)) {
            sets.join(*a, *b);
            sets.join(*b, *c);
            [a, b, c].iter().for_each(|p| used[**p as usize] = true);
        }
        let mut places: Vec<(u32, u32)> = (0..used.len() as u32)
            .filter(|p| used[*p as usize])
            .map(|p| (sets.leader(p), p))
            .collect();
        places.sort_unstable();
        let mut objects: Vec<Object> = places
            .chunk_by(|a, b| a.0 == b.0)
            .map(|of_one| {
                let places: Vec<DVec3> =
                    of_one.iter().map(|(_, p)| welded.places[*p as usize]).collect();
                let low = places.iter().copied().fold(DVec3::INFINITY, DVec3::min);
                let high = places.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
                Object { low, high, places }
            })
            .collect();
        // The largest are in the way most often; the stable sort keeps the order of equals.
        let size = |o: &Object| (o.high - o.low).length_squared();
        objects.sort_by(|a, b| size(b).total_cmp(&size(a)));
        Self(objects)
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none: nothing can block.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
