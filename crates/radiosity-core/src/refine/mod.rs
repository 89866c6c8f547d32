//! From coarse meshes to fine ones, until the light is as right as was asked.
//!
//! Each level is solved from nothing, on a mesh that has more elements than the one before where its
//! light was not what neighbours foretold. What the levels differ by says how wrong the finest is.

mod difference;
mod growth;
mod ladder;
mod level;
mod mark;
mod place;
mod sample;
mod statement;
mod surface;

use accel::{Bvh, Occluder};
use scene::{Rgb, Scene, Solution};

use crate::checkpoint::{Checkpoint, Inconsistent};
use crate::config::{ShootingConfig, Split};
use crate::energy::Ledger;
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::{Observer, StepReport};
use crate::shooting::StopReason;
pub(crate) use ladder::Climbed;
use ladder::Ladder;
use level::Setting;
pub use place::Probe;
pub use statement::{Parts, Stated, Statement};

/// What is asked of a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// Refine until the stated total error (E1 of the triangles' means) is at most this.
    Error(f64),
    /// This many elements; the config's stop rule; coarser levels for the statement alone.
    Elements(usize),
    /// This many elements; the config's stop rule; no statement.
    Unstated(usize),
}

impl Asked {
    fn stated(self) -> bool {
        !matches!(self, Self::Unstated(_))
    }
}

/// How far and where meshes are refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefineConfig {
    /// What ends the work.
    pub asked: Asked,
    /// Never exceeded, except by the scene's own triangles.
    pub most_elements: usize,
    /// How elements are split where the light changes; without effect but for [`Asked::Error`].
    pub split: Split,
    /// See [`crate::MeshConfig::least_area`].
    pub least_area: f64,
    /// See [`crate::MeshConfig::most_depth`].
    pub most_depth: u32,
}

impl RefineConfig {
    /// Longest edges where the light asks for it, without limits.
    #[must_use]
    pub fn until(asked: Asked) -> Self {
        let split = Split::default();
        Self { asked, most_elements: 1 << 30, split, least_area: 0.0, most_depth: u32::MAX }
    }
}

/// Why refinement ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The stated error is at or below the asked one.
    Error,
    /// The asked number of elements is solved.
    Elements,
    /// The next level would have more elements than allowed.
    ElementLimit,
    /// No element may be split any more: all are as small as allowed.
    SizeLimit,
    /// Light is shot, and no surface but lamps was seen to receive any.
    Unseen,
    /// The observer said stop.
    Stopped,
    /// The shooting ended for a reason of its own: no light, or no end of it.
    Shooting,
}

/// A scene's light, how it came about and how wrong it may be.
#[derive(Clone, Debug)]
pub struct Refined {
    /// The mesh of the solution.
    pub mesh: Mesh,
    /// The light.
    pub solution: Solution,
    /// How wrong it may be; `None` if not asked for.
    pub statement: Option<Statement>,
    /// Where the emitted power went, in this mesh.
    pub ledger: Ledger,
    /// Why its shooting ended.
    pub reason: StopReason,
    /// Why refinement ended.
    pub reached: Reached,
    /// The work on this mesh.
    pub work: StepReport,
    /// The work on all meshes.
    pub total_work: StepReport,
    /// Whether ambient corrections took part.
    pub corrected: bool,
    /// Row sums before they were closed; see [`crate::Shooting::closed_rows`].
    pub closed_rows: Option<[f64; 2]>,
    /// Exitance at the probes; 0 at those in the open.
    pub probes: Vec<Rgb>,
    /// Irradiance at the probes: the power that arrives per area, whatever is reflected.
    pub probe_irradiance: Vec<Rgb>,
}

/// Solves a scene on finer and finer meshes until what is asked is met or the observer says stop.
///
/// `bvh` and `occluder` hold the scene's input triangles in order; they may be the same. Same bits
/// for every executor.
#[expect(clippy::too_many_arguments, reason = "each is a choice of its own")]
pub fn refine<E: Executor>(
    scene: &Scene,
    bvh: &Bvh,
    occluder: &dyn Occluder,
    executor: &E,
    config: ShootingConfig,
    refining: RefineConfig,
    probes: &[Probe],
    observer: &mut impl Observer,
) -> Refined {
    let config = ShootingConfig { needs: place::needs(config.needs, scene, probes), ..config };
    let setting = Setting { scene, bvh, occluder, executor, config, refining, probes };
    Ladder::new(setting).climb(observer)
}

/// As [`refine`], from where the same work was kept: the result is the same to the bit.
///
/// Its meshes are grown anew, which takes the time that it took, but no rays.
///
/// # Errors
/// If the checkpoint contradicts itself, or was not kept by work on the same scene with the same
/// settings and probes. Not every other scene is found out: who keeps checkpoints of several had
/// better know which is which.
#[expect(clippy::too_many_arguments, reason = "each is a choice of its own")]
pub fn resume<E: Executor>(
    checkpoint: Checkpoint,
    scene: &Scene,
    bvh: &Bvh,
    occluder: &dyn Occluder,
    executor: &E,
    config: ShootingConfig,
    refining: RefineConfig,
    probes: &[Probe],
    observer: &mut impl Observer,
) -> Result<Refined, Inconsistent> {
    let config = ShootingConfig { needs: place::needs(config.needs, scene, probes), ..config };
    let setting = Setting { scene, bvh, occluder, executor, config, refining, probes };
    Ladder::new(setting).resume(checkpoint, observer)
}
