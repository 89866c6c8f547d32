//! Where to cut a set of boxes in two.

use glam::Vec3A;

use crate::aabb::Aabb;
use crate::block::LANES;

/// The most bins a split search uses; more would not fit the stack frame comfortably.
pub(super) const MAX_BINS: usize = 32;

/// Cuts where the surface area heuristic is least; returns the size of the first part, or `None`
/// if all centroids are in one place. Neither part is empty.
pub(super) fn by_area(order: &mut [u32], boxes: &[Aabb], bins: usize) -> Option<usize> {
    let grid = Grid::over(order, boxes, bins);
    let mut best = (f32::INFINITY, 0, 0);
    for axis in 0..3 {
        if grid.scale[axis] == 0.0 {
            continue;
        }
        let mut contents = [(0_usize, Aabb::EMPTY); MAX_BINS];
        for &i in &*order {
            let bounds = &boxes[i as usize];
            let bin = &mut contents[grid.bin(bounds, axis)];
            bin.0 += 1;
            bin.1.join(bounds);
        }
        // Cost of everything at or after each bin, then of everything before it.
        let mut after = [0.0; MAX_BINS];
        let mut sum = (0, Aabb::EMPTY);
        for bin in (1..bins).rev() {
            add(&mut sum, &contents[bin]);
            after[bin] = cost(&sum);
        }
        sum = (0, Aabb::EMPTY);
        for bin in 1..bins {
            add(&mut sum, &contents[bin - 1]);
            if sum.0 == 0 || sum.0 == order.len() {
                continue;
            }
            let total = cost(&sum) + after[bin];
            if total < best.0 {
                best = (total, axis, bin);
            }
        }
    }
    let (total, axis, bin) = best;
    total.is_finite().then(|| partition(order, |i| grid.bin(&boxes[i as usize], axis) < bin))
}

/// Cuts into halves along the axis on which centroids spread most; returns the first half's size.
pub(super) fn at_median(order: &mut [u32], boxes: &[Aabb]) -> usize {
    let (lo, hi) = centroid_bounds(order, boxes);
    let spread = hi - lo;
    let axis = (1..3).fold(0, |a, b| if spread[b] > spread[a] { b } else { a });
    let middle = order.len() / 2;
    let key = |i: u32| centroid(&boxes[i as usize])[axis];
    // Ties by index, so that the result does not depend on the selection's inner order.
    order.select_nth_unstable_by(middle, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
    middle
}

/// Proportional to the expected work behind a box: the chance to meet it times its blocks.
fn cost((count, bounds): &(usize, Aabb)) -> f32 {
    if *count == 0 { 0.0 } else { bounds.half_area() * count.div_ceil(LANES) as f32 }
}

fn add(sum: &mut (usize, Aabb), bin: &(usize, Aabb)) {
    sum.0 += bin.0;
    sum.1.join(&bin.1);
}

/// Equal bins between the extreme centroids, on each axis.
struct Grid {
    lo: Vec3A,
    /// Bins per unit of twice the length; 0 on an axis without spread.
    scale: [f32; 3],
    bins: usize,
}

impl Grid {
    fn over(order: &[u32], boxes: &[Aabb], bins: usize) -> Self {
        let (lo, hi) = centroid_bounds(order, boxes);
        // A spread that f32 cannot divide by counts as none.
        let scale = (hi - lo).to_array().map(|spread| {
            let scale = bins as f32 / spread;
            if scale.is_finite() { scale } else { 0.0 }
        });
        Self { lo, scale, bins }
    }

    fn bin(&self, bounds: &Aabb, axis: usize) -> usize {
        let place = (centroid(bounds)[axis] - self.lo[axis]) * self.scale[axis];
        (place as usize).min(self.bins - 1)
    }
}

/// Twice the centre of a box: the factor is the same everywhere and saves a rounding.
fn centroid(bounds: &Aabb) -> Vec3A {
    bounds.lo + bounds.hi
}

fn centroid_bounds(order: &[u32], boxes: &[Aabb]) -> (Vec3A, Vec3A) {
    let mut bounds = Aabb::EMPTY;
    for &i in order {
        bounds.include(centroid(&boxes[i as usize]));
    }
    (bounds.lo, bounds.hi)
}

/// Moves the indices that satisfy `first` to the front; returns how many do.
fn partition(order: &mut [u32], first: impl Fn(u32) -> bool) -> usize {
    let mut count = 0;
    for i in 0..order.len() {
        if first(order[i]) {
            order.swap(count, i);
            count += 1;
        }
    }
    count
}
