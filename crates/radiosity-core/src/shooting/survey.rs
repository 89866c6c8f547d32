//! What a sample of shots would meet: who faces whom, and what proofs say of it.

use accel::Occluder;
use glam::DVec3;
use scene::Rgb;

use super::SEGMENT_LIFT;
use super::blocks::{self, Blocks};
use super::detail::Detail;
use super::reach::Reach;
use super::transfer::{IN_PLANE, Shot};
use crate::config::{Exchange, ShootingConfig};
use crate::mesh::{Mesh, Patch, ReceiverPoint};
use crate::needs::Needs;

/// Patches in the sample.
const PATCHES: usize = 24;

/// Receivers in a block, at most: a mesh that is solved is finer than this one, and so are its blocks.
const MOST: usize = 8;

/// The step from one sampled patch to the next, as a share of all: neighbours are alike.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Pairs of a sampled patch and a receiver point, by what becomes of them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Survey {
    /// All of them.
    pub(crate) pairs: f64,
    /// Those that face each other.
    pub(crate) facing: f64,
    /// Those that are left out with their block: behind a plane.
    pub(crate) behind: f64,
    /// Facing, in different sealed spaces or in one without a lamp.
    pub(crate) apart: f64,
    /// Facing, behind a wall.
    pub(crate) hidden: f64,
    /// Facing, with nothing in between.
    pub(crate) open: f64,
    /// Blocks that a finer mesh would have looked at.
    pub(crate) blocks: f64,
}

/// Looks from some patches to all points of a mesh; `occluder` knows the proofs, and is asked for no
/// segment. Time: patches of the sample × points.
pub(crate) fn survey(mesh: &Mesh, occluder: &dyn Occluder) -> Survey {
    let needs = Needs { singles: false, ..Needs::EVERYTHING };
    let lift = SEGMENT_LIFT * mesh.extent;
    let sorted = Blocks::of(MOST, mesh, &mesh.points, occluder, &needs, lift);
    let detail = Detail::of(&ShootingConfig::until(1.0));
    let mut survey = Survey::default();
    for patch in sample(mesh) {
        let mut facing = 0.0;
        let shot =
            Shot::new(occluder, &[], mesh, patch, Exchange::OneSided, &needs, &detail, Rgb::ZERO);
        let shot = Shot { space: sorted.space_of(mesh, &patch.elements), ..shot };
        survey.pairs += mesh.points.len() as f64;
        for block in sorted.all() {
            let range = block.receivers.start as usize..block.receivers.end as usize;
            let own = mesh.points[range.clone()].iter().filter(|r| shot.faces(r)).count() as f64;
            survey.blocks += MOST as f64 / blocks::MOST as f64;
            facing += own;
            match shot.reach(block) {
                Reach::Behind => survey.behind += range.len() as f64,
                Reach::Apart => survey.apart += own,
                Reach::Hidden => survey.hidden += own,
                Reach::Open => survey.open += own,
                Reach::Asked => {}
            }
        }
        // Receivers in a space without a lamp are in no block.
        let left_out = sorted.left_out as f64;
        let own: f64 = facing / (mesh.points.len() as f64 - left_out).max(1.0);
        survey.facing += facing + left_out * own;
        survey.apart += left_out * own;
    }
    survey
}

/// Lamps, whose light is most of what is shot, and as many patches of any kind.
fn sample(mesh: &Mesh) -> Vec<&Patch> {
    let emits = |patch: &&Patch| {
        let root = mesh.nodes[patch.node as usize].root as usize;
        mesh.roots[root].emittance != Rgb::ZERO
    };
    let lamps: Vec<&Patch> = mesh.patches.iter().filter(emits).collect();
    let all: Vec<&Patch> = mesh.patches.iter().collect();
    let some = |of: &[&'_ Patch]| -> Vec<usize> {
        let place = |i: usize| ((i as f64 * GOLDEN).fract() * of.len() as f64) as usize;
        (0..(PATCHES / 2).min(of.len())).map(place).collect()
    };
    let (lit, any) = (some(&lamps), some(&all));
    lit.into_iter().map(|i| lamps[i]).chain(any.into_iter().map(|i| all[i])).collect()
}

impl Shot<'_> {
    /// Whether a receiver and a part of the shooter lie in front of each other.
    fn faces(&self, receiver: &ReceiverPoint) -> bool {
        let in_plane = IN_PLANE * self.extent;
        let rises = |c: &DVec3| receiver.normal.dot(*c - receiver.position) > in_plane;
        self.normal.dot(receiver.position - self.corners[0]) > in_plane
            && self.corners.iter().any(rises)
    }
}
