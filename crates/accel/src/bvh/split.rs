//! Where to cut a set of boxes in two.

use glam::Vec3A;

use crate::aabb::Aabb;
use crate::block::LANES;

/// The most bins a split search uses; more would not fit the stack frame comfortably.
pub(super) const MAX_BINS: usize = 32;

/// Triangles that belong together: their numbers and, in the same order, their boxes.
#[derive(Debug)]
pub(super) struct Set<'a> {
    pub(super) order: &'a mut [u32],
    pub(super) boxes: &'a mut [Aabb],
    pub(super) bounds: Aabb,
}

impl<'a> Set<'a> {
    pub(super) fn of(order: &'a mut [u32], boxes: &'a mut [Aabb]) -> Self {
        let mut bounds = Aabb::EMPTY;
        for each in &*boxes {
            bounds.join(each);
        }
        Self { order, boxes, bounds }
    }

    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    /// Cuts where the surface area heuristic is least, neither part empty; gives the set back if
    /// all centroids are in one place.
    pub(super) fn by_area(self, bins: usize) -> Result<[Self; 2], Self> {
        // A few triangles do not fill many bins.
        let grid = Grid::over(self.boxes, bins.min(self.len().max(2)));
        // Most sets are small, and bins cost even where they stay empty.
        let cut = match grid.bins {
            ..=8 => grid.cheapest::<8>(self.boxes),
            9..=16 => grid.cheapest::<16>(self.boxes),
            _ => grid.cheapest::<MAX_BINS>(self.boxes),
        };
        let Some(cut) = cut else { return Err(self) };
        let mut middle = 0;
        for i in 0..self.len() {
            if grid.bin(&self.boxes[i])[cut.axis] < cut.bin {
                self.order.swap(middle, i);
                self.boxes.swap(middle, i);
                middle += 1;
            }
        }
        let (first, second) = self.order.split_at_mut(middle);
        let boxes = self.boxes.split_at_mut(middle);
        Ok([
            Self { order: first, boxes: boxes.0, bounds: cut.bounds[0] },
            Self { order: second, boxes: boxes.1, bounds: cut.bounds[1] },
        ])
    }

    /// Cuts into halves along the axis on which centroids spread most.
    pub(super) fn at_median(self) -> [Self; 2] {
        let (lo, hi) = centroid_bounds(self.boxes);
        let spread = hi - lo;
        let axis = (1..3).fold(0, |a, b| if spread[b] > spread[a] { b } else { a });
        let middle = self.len() / 2;
        let mut pairs: Vec<(u32, Aabb)> =
            self.order.iter().copied().zip(self.boxes.iter().copied()).collect();
        let key = |pair: &(u32, Aabb)| centroid(&pair.1)[axis];
        // Ties by number, so that the result does not depend on the selection's inner order.
        pairs.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.0.cmp(&b.0)));
        for (i, (number, bounds)) in pairs.into_iter().enumerate() {
            self.order[i] = number;
            self.boxes[i] = bounds;
        }
        let (first, second) = self.order.split_at_mut(middle);
        let boxes = self.boxes.split_at_mut(middle);
        [Self::of(first, boxes.0), Self::of(second, boxes.1)]
    }
}

/// A plane between two bins, and the bounds of what is on either side.
struct Cut {
    axis: usize,
    /// The first bin beyond the plane.
    bin: usize,
    bounds: [Aabb; 2],
}

/// What is in a bin, or in several.
#[derive(Clone, Copy)]
struct Content {
    bounds: Aabb,
    count: usize,
}

impl Content {
    const EMPTY: Self = Self { bounds: Aabb::EMPTY, count: 0 };

    fn join(&mut self, other: &Self) {
        self.bounds.join(&other.bounds);
        self.count += other.count;
    }

    /// Proportional to the expected work: the chance to meet the bounds times the blocks inside.
    fn cost(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        self.bounds.half_area() * self.count.div_ceil(LANES) as f32
    }
}

/// Equal bins between the extreme centroids, on each axis.
struct Grid {
    lo: Vec3A,
    /// Bins per unit of twice the length; 0 on an axis without spread.
    scale: Vec3A,
    bins: usize,
}

impl Grid {
    fn over(boxes: &[Aabb], bins: usize) -> Self {
        let (lo, hi) = centroid_bounds(boxes);
        // A spread that f32 cannot divide by counts as none.
        let scale = (hi - lo).to_array().map(|spread| {
            let scale = bins as f32 / spread;
            if scale.is_finite() { scale } else { 0.0 }
        });
        Self { lo, scale: scale.into(), bins }
    }

    /// The bin of a box on each axis.
    #[inline]
    fn bin(&self, bounds: &Aabb) -> [usize; 3] {
        let place = (centroid(bounds) - self.lo) * self.scale;
        place.to_array().map(|place| (place as i32 as usize).min(self.bins - 1))
    }

    /// The cut of least cost; `N` is a power of two and no less than the number of bins.
    fn cheapest<const N: usize>(&self, boxes: &[Aabb]) -> Option<Cut> {
        let mut contents = [[Content::EMPTY; N]; 3];
        for bounds in boxes {
            for (axis, bin) in self.bin(bounds).into_iter().enumerate() {
                let bin = &mut contents[axis][bin & (N - 1)];
                bin.bounds.join(bounds);
                bin.count += 1;
            }
        }
        let mut best = (f32::INFINITY, None);
        for (axis, contents) in contents.iter().enumerate() {
            if self.scale[axis] == 0.0 {
                continue;
            }
            // Everything at or after each bin, then everything before it.
            let mut after = [Content::EMPTY; N];
            let mut sum = Content::EMPTY;
            for bin in (1..self.bins).rev() {
                sum.join(&contents[bin]);
                after[bin] = sum;
            }
            sum = Content::EMPTY;
            for bin in 1..self.bins {
                sum.join(&contents[bin - 1]);
                if sum.count == 0 || after[bin].count == 0 {
                    continue;
                }
                let total = sum.cost() + after[bin].cost();
                if total < best.0 {
                    let bounds = [sum.bounds, after[bin].bounds];
                    best = (total, Some(Cut { axis, bin, bounds }));
                }
            }
        }
        best.1
    }
}

/// Twice the centre of a box: the factor is the same everywhere and saves a rounding.
fn centroid(bounds: &Aabb) -> Vec3A {
    bounds.lo + bounds.hi
}

fn centroid_bounds(boxes: &[Aabb]) -> (Vec3A, Vec3A) {
    let mut bounds = Aabb::EMPTY;
    for each in boxes {
        bounds.include(centroid(each));
    }
    (bounds.lo, bounds.hi)
}
