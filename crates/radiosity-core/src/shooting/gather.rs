//! The light shot so far, gathered once more at a few points with more care.

use scene::Rgb;

use super::cell::{self, Cell};
use super::detail::Detail;
use super::transfer::{Receivers, Scratch, Shot};
use super::{Shooting, sides};
use crate::executor::Executor;
use crate::mesh::{Patch, ReceiverPoint};
use crate::observer::Stopper;

/// Points per run of an executor: few, since there are few points; the corners of an element together,
/// and eight start from different places of a cell.
const RUN: usize = 24;

/// What a point receives of all light shot so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gathered {
    /// Irradiance, by the second, finer estimate.
    pub irradiance: Rgb,
    /// Irradiance as the shots left it.
    pub shot: Rgb,
    /// Sum of the form factors to all that is visible, by the finer estimate.
    pub row: f64,
}

/// Points with their slots.
struct Run<'a> {
    points: &'a [u32],
    slots: &'a mut [Gathered],
    done: bool,
}

impl<E: Executor> Shooting<'_, E> {
    /// Estimates what arrived at the mesh's points `which` a second time: exact form factors,
    /// many more segments. The shots' own estimate was made while light came in portions.
    ///
    /// Time: points × patches × cells, about that of a shot per 1,000 points and patch.
    #[must_use]
    pub fn gather(&self, which: &[u32]) -> Vec<Gathered> {
        self.gather_unless(which, None).unwrap_or_default()
    }

    /// As [`Shooting::gather`], if nothing stops it on the way.
    pub(crate) fn gather_unless(
        &self,
        which: &[u32],
        stopper: Option<&Stopper>,
    ) -> Option<Vec<Gathered>> {
        let mut slots = vec![Gathered::default(); which.len()];
        let shone = self.shone();
        let detail = Detail::second_estimate(&self.config);
        let mut runs: Vec<Run> = which
            .chunks(RUN)
            .zip(slots.chunks_mut(RUN))
            .map(|(points, slots)| Run { points, slots, done: false })
            .collect();
        self.executor.for_each(&mut runs, |run| match self.config.needs.channels.count() {
            1 => self.gather_run::<1>(run, &shone, &detail, stopper),
            _ => self.gather_run::<3>(run, &shone, &detail, stopper),
        });
        let done = runs.iter().all(|run| run.done);
        done.then_some(slots)
    }

    /// What each element has shot so far: exitance less what is unshot.
    fn shone(&self) -> Vec<Rgb> {
        let elements = self.mesh.elements.iter().zip(&self.state.irradiance);
        elements
            .zip(&self.state.unshot)
            .map(|((element, h), u)| {
                let root = self.mesh.root_of(element);
                root.emittance + root.reflectance * *h - *u
            })
            .collect()
    }

    /// Whether a second estimate of a patch's light says anything: where black surfaces are left out, of
    /// patches that have shone none their share of the view is enough.
    fn is_asked_of(&self, patch: &Patch, shone: &[Rgb]) -> bool {
        let elements = patch.elements.start as usize..patch.elements.end as usize;
        self.config.needs.black
            || self.closure.is_some()
            || shone[elements].iter().any(|light| *light != Rgb::ZERO)
    }

    fn gather_run<const N: usize>(
        &self,
        run: &mut Run,
        shone: &[Rgb],
        detail: &Detail,
        stopper: Option<&Stopper>,
    ) {
        let (mesh, exchange) = (self.mesh, self.config.exchange);
        let receivers: Vec<ReceiverPoint> =
            run.points.iter().map(|&p| mesh.points[p as usize]).collect();
        let mut arriving = vec![[0.0; N]; receivers.len()];
        let mut seen = vec![0.0; receivers.len()];
        let needs = self.config.needs;
        let blocks = self.blocks.around(mesh, &receivers, run.points);
        let blocks = (!needs.singles).then_some((0, blocks.as_slice()));
        let (mut scratch, mut cells): (Scratch, Vec<Cell>) = Default::default();
        let mut totals = vec![Rgb::ZERO; receivers.len()];
        let shots = Detail::of(&self.config);
        for patch in &mesh.patches {
            if stopper.is_some_and(|stop| stop()) {
                return;
            }
            cell::cells_of(mesh, self.census, patch, shone, detail.quarterings, &mut cells);
            let (occluder, mean) = (self.occluder, self.mean);
            let detail = if self.is_asked_of(patch, shone) { detail } else { &shots };
            let shot = Shot::new(occluder, &cells, mesh, patch, exchange, &needs, detail, mean);
            let shot = Shot { space: self.blocks.space_of(mesh, &patch.elements), ..shot };
            let points = Receivers { points: &receivers, shares: None, blocks };
            arriving.fill([0.0; N]);
            shot.light(points, &mut arriving, Some(&mut seen), &mut scratch);
            totals.iter_mut().zip(&arriving).for_each(|(t, a)| *t += needs.channels.spread(*a));
        }
        for (i, (slot, &p)) in run.slots.iter_mut().zip(run.points).enumerate() {
            let closed = self.closure.is_some() && seen[i] > 0.0;
            let irradiance = if closed { totals[i] / seen[i] } else { totals[i] };
            let shot = self.state.at_points[p as usize];
            *slot = Gathered { irradiance, shot, row: seen[i] / sides(exchange) };
        }
        run.done = true;
    }
}
