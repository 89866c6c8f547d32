//! The ladder as bytes, and the climb from there on.

use std::io::{self, Write};

use super::super::Refined;
use super::super::growth::Growth;
use super::super::level::Level;
use super::super::sample::Sampled;
use super::super::statement::{Measured, Step};
use super::super::surface::Counted;
use super::{Ladder, Rung};
use crate::checkpoint::{Checkpoint, Inconsistent, Loose, Part, Reader, Record, digest, record};
use crate::energy::Ledger;
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::{Observer, Stage, StepReport};
use crate::reconstruct::{self, Light};
use crate::shooting::{MOST_COUNTED, StopReason};

/// What the ladder adds to the state of the present level's shots.
pub(super) struct Climb<'a> {
    pub(super) base: StepReport,
    pub(super) most_elements: usize,
    pub(super) grown: &'a Vec<Growth>,
    pub(super) done: Option<&'a Rung>,
}

/// The same, read again.
#[derive(Debug)]
pub(crate) struct Climbed {
    base: StepReport,
    most_elements: usize,
    grown: Vec<Growth>,
    done: Option<Kept>,
}

/// A finished level, but for what follows from its mesh.
#[derive(Debug)]
struct Kept {
    mesh: u64,
    light: Light,
    ledger: Ledger,
    reason: StopReason,
    work: StepReport,
    corrected: bool,
    closed_rows: Option<[f64; 2]>,
    probes: Vec<scene::Rgb>,
    unseen: bool,
    iteration: Measured,
    sampled: Sampled,
    step: Option<[Step; 3]>,
    mesh_errors: [Measured; 3],
}

record!(Climbed { base, most_elements, grown, done });
record!(Kept {
    mesh,
    light,
    ledger,
    reason,
    work,
    corrected,
    closed_rows,
    probes,
    unseen,
    iteration,
    sampled,
    step,
    mesh_errors,
});
record!(Step { difference, finer });

impl Part for Climb<'_> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.base.write(out)?;
        self.most_elements.write(out)?;
        self.grown.write(out)?;
        self.done.is_some().write(out)?;
        self.done.map_or(Ok(()), |rung| rung.write(out))
    }
}

impl Rung {
    /// The fields of [`Kept`].
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let level = &self.level;
        digest(&level.mesh).write(out)?;
        level.light.write(out)?;
        level.ledger.write(out)?;
        level.reason.write(out)?;
        level.work.write(out)?;
        level.corrected.write(out)?;
        level.closed_rows.write(out)?;
        level.probes.write(out)?;
        level.unseen.write(out)?;
        level.iteration.write(out)?;
        self.sampled.write(out)?;
        self.step.write(out)?;
        self.mesh_errors.write(out)
    }
}

impl Kept {
    /// The finished level on its mesh.
    fn rung(self, mesh: Mesh, probes: usize) -> Result<Rung, Inconsistent> {
        if self.mesh != digest(&mesh) {
            return Err(OTHER_MESH);
        }
        let finished = matches!(self.reason, StopReason::Converged | StopReason::ShotLimit);
        if !self.light.fits(&mesh) || self.probes.len() != probes || !finished {
            return Err(Inconsistent("its last finished level is not of its mesh"));
        }
        let level = Level {
            solution: reconstruct::solution(
                &mesh,
                self.light.irradiance.iter().copied(),
                &self.light.shown,
            ),
            counted: Counted::of(&mesh),
            light: self.light,
            mesh,
            ledger: self.ledger,
            reason: self.reason,
            work: self.work,
            corrected: self.corrected,
            closed_rows: self.closed_rows,
            probes: self.probes,
            unseen: self.unseen,
            iteration: self.iteration,
            sampled: Some(self.sampled),
            estimated: true,
        };
        let Self { step, mesh_errors, sampled, .. } = self;
        Ok(Rung { level, step, mesh_errors, sampled })
    }
}

impl Climbed {
    /// Elements of the last finished level; 0 on the first.
    pub(crate) fn finished_elements(&self) -> usize {
        self.done.as_ref().map_or(0, |kept| kept.light.irradiance.len())
    }
}

/// What a digest says.
const OTHER_MESH: Inconsistent =
    Inconsistent("its mesh is not the one that this build of the program makes here");

impl<E: Executor> Ladder<'_, E> {
    /// Goes on from where a ladder of the same scene and settings was.
    pub(in crate::refine) fn resume(
        &mut self,
        checkpoint: Checkpoint,
        observer: &mut impl Observer,
    ) -> Result<Refined, Inconsistent> {
        let Checkpoint { climbed, progress } = checkpoint;
        let StepReport { shots, rays, form_factors, directions, .. } = climbed.base;
        let counts = [shots, rays, form_factors, directions];
        if counts.into_iter().any(|count| count > MOST_COUNTED) {
            return Err(Inconsistent("it has a count out of range"));
        }
        // Each mesh is at most some times as fine as the one before, which a place in the file for
        // each of its elements justifies; the first one has to be as small as it always is.
        let first = self.first();
        if self.setting.adaptive() && climbed.grown.first().is_some_and(|g| g.elements() > first) {
            return Err(Inconsistent("its meshes do not follow from each other"));
        }
        self.base = climbed.base;
        let most = &mut self.setting.refining.most_elements;
        *most = climbed.most_elements.clamp(1, (*most).max(1));
        observer.stage(Stage::Mesh);
        let (before, mesh) = self.setting.regrown(&climbed.grown)?;
        if progress.mesh() != digest(&mesh) {
            return Err(OTHER_MESH);
        }
        self.grown = climbed.grown;
        self.done = match (climbed.done, before) {
            (Some(kept), Some(mesh)) => Some(kept.rung(mesh, self.setting.probes.len())?),
            (None, None) => None,
            _ => return Err(Inconsistent("its meshes are not those of its levels")),
        };
        progress.check(&mesh, self.setting.receivers().len(), &self.setting.config)?;
        let level = self.light(mesh, Some(progress), observer);
        Ok(self.climb_from(level, observer))
    }
}

/// A statement may say that nothing is known.
impl Record for Measured {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        [self.e1, self.einf].iter().try_for_each(|rgb| rgb.0.map(Loose).write(out))
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        let mut rgb = || <[Loose; 3]>::read(from).map(|c| scene::Rgb(c.map(|c| c.0)));
        Ok(Self { e1: rgb()?, einf: rgb()? })
    }
}

record!(StepReport { shots, rays, form_factors, directions, unshot });

impl Record for Sampled {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.triangles.write(out)?;
        self.points.write(out)?;
        self.rows.map(Loose).write(out)?;
        self.elements.write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(Self {
            triangles: Record::read(from)?,
            points: Record::read(from)?,
            rows: <[Loose; 2]>::read(from)?.map(|row| row.0),
            elements: Record::read(from)?,
        })
    }
}
