//! How wrong the light is: the statement, and how its mesh part follows from several meshes.

use scene::Rgb;

use crate::energy::Ledger;

/// The parts of one relative error; they add up to [`Parts::total`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// Light that is still unshot: a bound.
    pub iteration: f64,
    /// Form factors and visibility: a second estimate on a sample.
    pub form_factor: f64,
    /// Elements of finite size: differences between meshes. Infinite if there is but one.
    pub mesh: f64,
}

impl Parts {
    /// The sum of the parts.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.iteration + self.form_factor + self.mesh
    }
}

/// One kind of error in two measures, each of the channel in which its total is largest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stated {
    /// ΣA|B − B*| / ΣA·B*.
    pub e1: Parts,
    /// max|B − B*| over the area mean of B*.
    pub einf: Parts,
}

/// How far the light is from that of the scene, by the solver's own account.
///
/// B* is the exact exitance; sums and means run over all lit sides that do not emit (where
/// all emit, over all, and B is what they reflect), so that lamps do not hide the error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statement {
    /// Of the input triangles' means: what a table of triangles holds.
    pub triangles: Stated,
    /// Of single places on the surfaces: what vertex colours show.
    pub points: Stated,
    /// Of the probes, each counting alike; `None` without probes.
    pub probes: Option<Stated>,
    /// Least and largest sum of form factors at the sampled points: 1 in a closed scene.
    pub rows: [f64; 2],
    /// Elements sampled for the form factors.
    pub sample: usize,
}

/// A relative error in both measures, per channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Measured {
    pub(super) e1: Rgb,
    pub(super) einf: Rgb,
}

impl Measured {
    pub(super) const UNKNOWN: Self =
        Self { e1: Rgb::splat(f64::INFINITY), einf: Rgb::splat(f64::INFINITY) };

    fn both(self, f: impl Fn(Rgb) -> Rgb) -> Self {
        Self { e1: f(self.e1), einf: f(self.einf) }
    }

    pub(super) fn at_least(self, least: Rgb) -> Self {
        self.both(|e| larger(e, least))
    }

    /// The larger of each.
    pub(super) fn max(self, other: Self) -> Self {
        Self { e1: larger(self.e1, other.e1), einf: larger(self.einf, other.einf) }
    }
}

fn larger(a: Rgb, b: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| a[c].max(b[c])))
}

/// The difference between two meshes, and how many times as many elements the finer one has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Step {
    pub(super) difference: Measured,
    /// See [`difference::finer`](super::difference::finer).
    pub(super) finer: f64,
}

/// The factor on the estimate of the mesh's error from two steps: differences scatter, and the
/// order they show with them.
///
/// Chosen on the scenes and goals of docs/precision.md, whose table shows what is left of it.
const SAFETY: f64 = 1.25;

/// The orders of the elements' edge h that the error of the means may fall with.
///
/// Constant elements err in the first order of h under any light, and in the second where it is
/// smooth and their means are right; shadow edges and contacts keep scenes between. No order
/// above the middle is believed, however fast the last difference fell: it may have been luck.
const ORDERS: [f64; 2] = [1.0, 1.5];

/// The error of the last mesh, from one or two steps up to it (Richardson 1911).
///
/// Where the error falls with the order p of h, the difference to a mesh of k times as many elements
/// is (√k^p − 1) errors of that mesh. One step says nothing of p: the least is taken, and
/// is caution enough. Two show p, and give two such estimates; their geometric mean scatters less
/// than either.
pub(super) fn mesh_error(before: Option<Step>, last: Step) -> Measured {
    let Some(before) = before else {
        return last.difference.both(|d| d / errors_between(last, ORDERS[0]));
    };
    let mean = |early: Rgb, late: Rgb| {
        Rgb([0, 1, 2].map(|c| {
            let order = order(early[c] / late[c], before, last);
            let earlier = early[c] / errors_between(before, order) / ratio(last).powf(order);
            (earlier * late[c] / errors_between(last, order)).sqrt() * SAFETY
        }))
    };
    let (early, late) = (before.difference, last.difference);
    Measured { e1: mean(early.e1, late.e1), einf: mean(early.einf, late.einf) }
}

/// The order that the fall of the difference between two steps shows; between those at the ends
/// of [`ORDERS`], by the straight line.
fn order(fall: f64, before: Step, last: Step) -> f64 {
    let [least, most] = ORDERS;
    let expected = |p| errors_between(before, p) * ratio(last).powf(p) / errors_between(last, p);
    let [low, high] = ORDERS.map(expected);
    let share = (fall - low) / (high - low);
    // No fall at all, or no difference: nothing is known.
    if share.is_finite() { least + (most - least) * share.clamp(0.0, 1.0) } else { least }
}

/// What the error of `last`'s coarser mesh says of a finer one that was not finished.
pub(super) fn foreseen(coarser: Measured, from: usize, to: usize) -> Measured {
    let finer = (to as f64 / from.max(1) as f64).sqrt();
    coarser.both(|e| e / finer)
}

fn ratio(step: Step) -> f64 {
    step.finer.sqrt()
}

/// How many errors of the finer mesh lie between the two; 0 if neither is finer.
fn errors_between(step: Step, order: f64) -> f64 {
    (ratio(step).powf(order) - 1.0).max(0.0)
}

/// Where the census saw no way out, at most this share of the power escapes.
const CLOSED: f64 = 1e-9;

/// The error over what the balance shows of it, which is only the net of what is too much in one
/// place and too little in another: 1.0 to 1.7 in corridors with lamps just below the ceiling.
const GROSS: f64 = 2.0;

/// The least that the mesh's error can be where light has no way out: what a mesh receives more or
/// less than was shot is wrong, whatever other meshes say. Meshes that are all too coarse for what
/// lamps light close by agree on a wrong answer, but not with the balance.
pub(super) fn unbalanced(ledger: &Ledger) -> Rgb {
    Rgb([0, 1, 2].map(|c| {
        let (emitted, defect) = (ledger.emitted[c], ledger.form_factor_defect[c]);
        let closed = (ledger.escaped[c] - defect).abs() <= CLOSED * emitted;
        if closed && emitted > 0.0 { GROSS * (defect / emitted).abs() } else { 0.0 }
    }))
}

/// Puts three parts together, each measure in its worst channel.
pub(super) fn stated(iteration: Measured, form_factor: Measured, mesh: Measured) -> Stated {
    let worst = |i: Rgb, f: Rgb, m: Rgb| {
        let parts = [0, 1, 2].map(|c| Parts { iteration: i[c], form_factor: f[c], mesh: m[c] });
        parts.into_iter().fold(Parts::default(), |worst, parts| {
            if parts.total() > worst.total() { parts } else { worst }
        })
    };
    Stated {
        e1: worst(iteration.e1, form_factor.e1, mesh.e1),
        einf: worst(iteration.einf, form_factor.einf, mesh.einf),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(e1: f64, from: u32, to: u32) -> Step {
        let difference = Measured { e1: Rgb::splat(e1), einf: Rgb::splat(2.0 * e1) };
        Step { difference, finer: f64::from(to) / f64::from(from) }
    }

    #[test]
    fn first_order_errors_are_found_from_one_step_or_two() {
        // e(n) = 8/√n: .8 at 100, .4 at 400, .2 at 1600; differences .4 and .2.
        let one = mesh_error(None, step(0.2, 400, 1600));
        let two = mesh_error(Some(step(0.4, 100, 400)), step(0.2, 400, 1600));
        for (found, safety) in [(one, 1.0), (two, SAFETY)] {
            assert!((found.e1[0] / safety - 0.2).abs() < 1e-15, "{found:?}");
            assert!((found.einf[0] / safety - 0.4).abs() < 1e-15, "{found:?}");
        }
        assert!((foreseen(one, 1600, 6400).e1[0] - 0.1).abs() < 1e-15);
    }

    #[test]
    fn no_finer_mesh_no_estimate() {
        assert_eq!(mesh_error(None, step(0.2, 400, 400)), Measured::UNKNOWN);
    }

    #[test]
    fn errors_of_a_higher_order_are_found_from_two_steps() {
        // e(n) = 64/n^(3/4), order 3/2: 2.02 at 100, .716 at 400, .253 at 1600.
        let e = |n: f64| 64.0 / n.powf(0.75);
        let (early, late) =
            (step(e(100.) - e(400.), 100, 400), step(e(400.) - e(1600.), 400, 1600));
        let found = mesh_error(Some(early), late);
        assert!((found.e1[0] / SAFETY / e(1600.) - 1.0).abs() < 1e-12, "{found:?}");
        // Faster falls are not believed: order 2 shows as 3/2.
        let e = |n: f64| 64.0 / n;
        let (early, late) =
            (step(e(100.) - e(400.), 100, 400), step(e(400.) - e(1600.), 400, 1600));
        let found = mesh_error(Some(early), late);
        assert!(found.e1[0] / SAFETY > 1.5 * e(1600.), "{found:?}");
    }

    #[test]
    fn a_closed_scene_out_of_balance_is_at_least_that_wrong() {
        let defect = Rgb::new(-0.04, 0.02, 0.0);
        let closed = Ledger {
            emitted: Rgb::new(1.0, 2.0, 0.0),
            escaped: defect,
            form_factor_defect: defect,
            ..Ledger::default()
        };
        assert_eq!(unbalanced(&closed), Rgb::new(0.04 * GROSS, 0.01 * GROSS, 0.0));
        let open = Ledger { escaped: Rgb::new(0.3, 0.7, 0.0), ..closed };
        assert_eq!(unbalanced(&open), Rgb::ZERO);
    }

    #[test]
    fn the_worst_channel_is_that_of_the_sum() {
        let of = |r, g| Measured { e1: Rgb::new(r, g, 0.0), einf: Rgb::ZERO };
        let stated = stated(of(0.1, 0.0), of(0.0, 0.02), of(0.1, 0.19));
        assert_eq!(stated.e1, Parts { iteration: 0.0, form_factor: 0.02, mesh: 0.19 });
        assert_eq!(stated.einf.total(), 0.0);
    }
}
