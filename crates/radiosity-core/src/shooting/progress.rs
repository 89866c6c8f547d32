//! The state of the shots as bytes, and back.

use std::io::{self, Write};

use scene::Rgb;

use super::account::Account;
use super::ambient::Ambient;
use super::stop::StopReason;
use super::transfer::Counts;
use super::{Shooting, stiff};
use crate::checkpoint::{Inconsistent, Loose, Part, Reader, Record, digest, record, tags};
use crate::config::ShootingConfig;
use crate::executor::Executor;
use crate::mesh::Mesh;

/// More shots, rays or form factors than this were never counted: sums of two stay in range.
pub(crate) const MOST_COUNTED: u64 = 1 << 60;

/// All that shots leave behind: the rest of [`Shooting`] follows from the mesh and the settings.
#[derive(Debug)]
pub(crate) struct Progress {
    /// Digest of the mesh.
    mesh: u64,
    course: Course,
    at_points: Vec<Rgb>,
    irradiance: Vec<Rgb>,
    unshot: Vec<Rgb>,
    account: Account,
    shots: u64,
    counts: Counts,
    lowest: (f64, u64),
    ambient: Option<Ambient>,
    /// Whether rows are closed.
    closed: bool,
    raw_rows: Option<[f64; 2]>,
}

/// What shots are on the way to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    /// The unshot share that is asked for.
    pub(crate) unshot: f64,
    /// How often it was lowered to that.
    pub(crate) tightened: u32,
    /// Whether [`Shooting::complete`] has begun since.
    pub(crate) completing: bool,
}

record!(Course { unshot, tightened, completing });
record!(Account { escaped, sampled_escape, wrong_side, received, black });
record!(Counts { rays, form_factors });
tags!(StopReason { Converged, NoLight, ShotLimit, Stopped, Stalled, Diverged, Singular });

impl<E: Executor> Part for Shooting<'_, E> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        digest(self.mesh).write(out)?;
        self.course().write(out)?;
        self.state.at_points.write(out)?;
        self.state.irradiance.write(out)?;
        self.state.unshot.write(out)?;
        self.account.write(out)?;
        self.shots.write(out)?;
        self.counts.write(out)?;
        // Infinite before the first shot.
        Loose(self.lowest.0).write(out)?;
        self.lowest.1.write(out)?;
        self.ambient.write(out)?;
        self.closure.is_some().write(out)?;
        self.raw_rows.write(out)
    }
}

impl Progress {
    pub(crate) fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(Self {
            mesh: Record::read(from)?,
            course: Record::read(from)?,
            at_points: Record::read(from)?,
            irradiance: Record::read(from)?,
            unshot: Record::read(from)?,
            account: Record::read(from)?,
            shots: Record::read(from)?,
            counts: Record::read(from)?,
            lowest: (Loose::read(from)?.0, Record::read(from)?),
            ambient: Record::read(from)?,
            closed: Record::read(from)?,
            raw_rows: Record::read(from)?,
        })
    }

    /// The digest of its mesh.
    pub(crate) fn mesh(&self) -> u64 {
        self.mesh
    }

    /// Makes sure that it is the state of shots on this mesh, with so many probes.
    pub(crate) fn check(
        &self,
        mesh: &Mesh,
        probes: usize,
        config: &ShootingConfig,
    ) -> Result<(), Inconsistent> {
        let receivers = mesh.points.len() + probes;
        let counted = [self.shots, self.counts.rays, self.counts.form_factors, self.lowest.1];
        let fits = self.at_points.len() == receivers
            && self.irradiance.len() == mesh.elements.len()
            && self.unshot.len() == mesh.elements.len()
            && (!self.closed || self.ambient.as_ref().is_some_and(Ambient::whole))
            && self.ambient.is_some() == stiff(mesh, config)
            && self.ambient.as_ref().is_none_or(|ambient| ambient.fits(mesh, receivers))
            && (self.course.tightened > 0 || self.course.unshot == config.stop.unshot)
            && (0.0..=1.0).contains(&self.course.unshot)
            && counted.into_iter().all(|count| count <= MOST_COUNTED);
        if fits { Ok(()) } else { Err(Inconsistent("its light is not of its mesh")) }
    }
}

impl<E: Executor> Shooting<'_, E> {
    /// Goes on from a state that was checked against the same mesh, probes and settings.
    pub(crate) fn restore(&mut self, progress: Progress) {
        let Course { unshot, tightened, completing } = progress.course;
        self.config.stop.unshot = unshot;
        self.tightened = tightened;
        self.completing = completing;
        self.state.at_points = progress.at_points;
        self.state.irradiance = progress.irradiance;
        self.state.unshot = progress.unshot;
        self.state.sum_patches(self.mesh);
        self.account = progress.account;
        self.shots = progress.shots;
        self.counts = progress.counts;
        self.lowest = progress.lowest;
        self.ambient = progress.ambient.map(|ambient| ambient.on(self.mesh));
        // Rows stay as they are once they are whole, and so do the factors that close them.
        self.closure = self.ambient.as_ref().filter(|_| progress.closed).map(Ambient::closing);
        self.raw_rows = progress.raw_rows;
    }
}
