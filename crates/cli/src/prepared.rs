//! What a solve works with: the plan, what finds the occluders, and who does the work.

use std::num::NonZeroUsize;
use std::time::Instant;

use accel::{Bvh, BvhConfig, Nothing, Occluder, Octree, OctreeConfig, Proven};
use radiosity_core::plan::Structure;
use radiosity_core::{Asked, Correction, Executor, Plan, PlanConfig};
use radiosity_par::{Loop, Pool};
use scene::Scene;

use crate::args::AccelArg;
use crate::failure::Failure;
use crate::settings::{DEFAULT_ERROR, Goal, Read, Work};

/// What finds the occluders, and who does the work.
pub(crate) struct Prepared {
    pub(crate) plan: Plan,
    /// Over all triangles, for directions; empty where none is followed.
    pub(crate) bvh: Bvh,
    /// What answers segments, if not that.
    other: Option<Box<dyn Occluder>>,
    pub(crate) occluder_name: &'static str,
    pub(crate) occluder_bytes: usize,
    pub(crate) pool: Pool,
    pub(crate) plan_seconds: f64,
    pub(crate) occluder_seconds: f64,
}

/// Plans the work, and builds what finds the occluders.
pub(crate) fn prepare(
    scene: &Scene,
    work: &Work,
    read: &Read,
    (goal, correction, timed): (Goal, Correction, bool),
    sharing: Loop,
    mut phase: impl FnMut(&'static str),
) -> Result<Prepared, Failure> {
    phase("planning");
    let clock = Instant::now();
    let plan = Plan::of(scene, &plan_config(work, read, goal, correction, timed, scene));
    let plan_seconds = clock.elapsed().as_secs_f64();
    let pool = Pool::with_loop(plan.threads, sharing)?;
    phase("occluder");
    let clock = Instant::now();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let config = BvhConfig::default();
    let run = |may_block: &dyn Fn(usize) -> bool| {
        Bvh::build_of(&triangles, may_block, &config, |parts, work| pool.for_each(parts, work))
    };
    let all = plan.whole_structure();
    let blocks = |t: usize| plan.in_structure(t);
    let by_bvh = plan.structure == Structure::Bvh;
    // Directions end at all triangles, segments at those that may block.
    let bvh = match plan.needs.census || by_bvh && all {
        true => run(&|_| true),
        false => run(&|_| false),
    };
    let (other, bytes): (Option<Box<dyn Occluder>>, _) = match plan.structure {
        Structure::Octree => {
            let octree = Octree::build_of(&triangles, blocks, &OctreeConfig::default());
            let bytes = octree.bytes();
            (Some(Box::new(octree)), bytes)
        }
        Structure::None => (Some(Box::new(Nothing)), 0),
        Structure::Bvh if all => (None, bvh.bytes()),
        Structure::Bvh => {
            let some = run(&blocks);
            let bytes = some.bytes();
            (Some(Box::new(some)), bytes)
        }
    };
    let occluder_seconds = clock.elapsed().as_secs_f64();
    let occluder_name = plan.structure.name();
    Ok(Prepared {
        plan,
        bvh,
        other,
        occluder_name,
        occluder_bytes: bytes,
        pool,
        plan_seconds,
        occluder_seconds,
    })
}

/// What the plan is made for.
fn plan_config(
    work: &Work,
    read: &Read,
    goal: Goal,
    correction: Correction,
    timed: bool,
    scene: &Scene,
) -> PlanConfig {
    let available = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let (elements, error) = match goal.asked(scene.triangles().len()) {
        Asked::Error(error) => (None, error),
        Asked::Elements(n) | Asked::Unstated(n) => (Some(n), DEFAULT_ERROR),
    };
    PlanConfig {
        elements,
        error,
        unshot: goal.converge(),
        exchange: read.exchange,
        correction,
        structure: match work.accel {
            AccelArg::Auto => None,
            AccelArg::Octree => Some(Structure::Octree),
            AccelArg::Bvh => Some(Structure::Bvh),
            AccelArg::None => Some(Structure::None),
        },
        threads: work.threads.map(|n| if n == 0 { available } else { n }),
        available,
        timed,
        everything: work.everything,
    }
}

impl Prepared {
    /// How many threads take part.
    pub(crate) fn threads(&self) -> usize {
        self.pool.threads()
    }

    /// What answers segments, with what is known beside them.
    pub(crate) fn proven(&self) -> Proven<'_> {
        Proven::new(self.other.as_deref().unwrap_or(&self.bvh), &self.plan.proofs)
    }

    pub(crate) fn occluder<'a>(&'a self, proven: &'a Proven<'a>) -> &'a dyn Occluder {
        let proofs = &self.plan.proofs;
        let known = !proofs.walls.is_empty() || proofs.objects.is_some();
        match known || proofs.spaces.shells() > 0 {
            true => proven,
            false => self.other.as_deref().unwrap_or(&self.bvh),
        }
    }
}
