//! What a caller may choose: how finely to split, how light is exchanged, when to stop.

use crate::needs::Needs;

/// Who exchanges light with whom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Exchange {
    /// Light leaves and arrives at the lit side of an element alone: physics.
    #[default]
    OneSided,
    /// Two surfaces exchange light when both see each other's front, or both see each
    /// other's back, and share one exitance for both sides: the rule of an older program,
    /// kept for comparison. A surface re-emits what it reflects on both sides, so a
    /// reflectance above .5 makes light from nothing.
    Paired,
}

/// How a scene becomes elements and patches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshConfig {
    /// Number of elements to split into; the scene's own triangles, in the pieces that
    /// they are cut into, are the least.
    pub elements: usize,
    /// A patch, the unit of shooting, holds at most this many elements.
    pub patch_elements: usize,
    /// Whether triangles are cut where others touch or cross them, so that no element lies on
    /// both sides of a wall.
    pub cut: bool,
    /// Whether elements are smaller round lamps that are small beside them. The mesh then depends
    /// on the lamps' powers, and light is the sum of that of single lamps but for its error.
    pub graded: bool,
    /// An element of this area or less is split only where a neighbour's edge is halved; in the
    /// scene's unit, squared. 0: no element is too small.
    pub least_area: f64,
    /// So is one this many halvings below its input triangle.
    pub most_depth: u32,
    /// How [`crate::Mesh::refined`] splits.
    pub split: Split,
    /// Whether triangles that neither emit nor reflect any of the light there is are split for their
    /// own sake.
    pub split_black: bool,
}

impl MeshConfig {
    /// About `elements` elements, in patches whose number grows with the tenth root of it, so
    /// that a sweep of shots costs `elements`^1.1 rather than its square.
    #[must_use]
    pub fn with_elements(elements: usize) -> Self {
        Self {
            elements,
            patch_elements: patch_size(elements),
            cut: true,
            graded: true,
            least_area: 0.0,
            most_depth: u32::MAX,
            split: Split::LongestEdge,
            split_black: true,
        }
    }
}

/// Patches of at most 12 elements at 4,000 elements, growing with the power .9: the larger, the
/// fewer shots, until they cost more in pieces for near receivers (docs/design.md).
fn patch_size(elements: usize) -> usize {
    let size = 12.0 * (elements as f64 / 4_000.0).powf(0.9);
    (size.round() as usize).clamp(4, 1024)
}

/// How elements are split where the light asks for smaller ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Split {
    /// Longest edges are halved, in all elements that share them: angles stay above half of what
    /// they were, and no vertex lies inside a neighbour's edge.
    #[default]
    LongestEdge,
    /// Elements are cut into three at their centroids, without a word to their neighbours: what the
    /// program did whose rules [`Exchange::Paired`] keeps. Angles shrink with every cut, and edges
    /// stay as long as they are.
    Centroid,
    /// Nowhere: each mesh has elements of one size.
    None,
}

/// When to stop shooting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    /// Stop when unshot power over emitted power is at most this in every channel.
    pub unshot: f64,
    /// Stop after this many shots.
    pub max_shots: Option<u64>,
}

/// How light is shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShootingConfig {
    /// When to stop.
    pub stop: StopRule,
    /// Who exchanges light with whom.
    pub exchange: Exchange,
    /// Relative error asked of one form factor, 95th percentile; 1e-1, 1e-2 or 1e-3 change
    /// which estimator serves which distance.
    pub tolerance: f64,
    /// A shooter's cell is split for one receiver until what it brings, were nothing in
    /// between, is at most this share of the scene's mean irradiance: more rays where the
    /// light is. Smaller gives smoother penumbrae.
    pub cell_share: f64,
    /// An element near a shooter gets receiver points inside when the shooter may bring it
    /// more than this many times the scene's mean irradiance. Infinite: its corners always
    /// stand for it. At 1 and below, rows of form factors no longer sum to 1 (see
    /// docs/design.md).
    pub bright: f64,
    /// Whether a uniform light may be taken out of what is unshot.
    pub correction: Correction,
    /// How many patches shoot together.
    pub schedule: Schedule,
    /// Whether patches shoot in advance what they will still receive: a third fewer shots, and a
    /// stop at the same unshot share that errs by a third of what it would.
    pub overshoot: bool,
    /// Whether the solution shows, beside the light received, what is still to come: all unshot light
    /// spread evenly over all surfaces that got some. Without effect on the shots.
    pub ambient: bool,
    /// What is done, and what is left out.
    pub needs: Needs,
}

/// How many patches shoot in one step.
///
/// Patches that shoot together light each other, too: each shoots what it had before the step, and
/// what it receives in it is unshot afterwards. So the light converges to the same for every
/// schedule, in steps of other bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Schedule {
    /// As many as are about as bright as the brightest, within memory: those would shoot one after
    /// the other anyhow.
    #[default]
    Auto,
    /// One.
    Single,
    /// The so many brightest.
    Multi(std::num::NonZeroUsize),
}

/// When the shooting is helped by an ambient correction: what all patches together still have
/// to shoot is replaced, once every few shots, by the uniform light that it would become.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Correction {
    /// When the first sweep shows that less than two fifths of the light is lost per bounce.
    #[default]
    Auto,
    /// The same, but rows of form factors are kept even where no surface reflects as much.
    Always,
    /// Plain shooting, whatever the reflectance.
    Never,
}

impl ShootingConfig {
    /// Physics, 1 % form factors, and a stop at `unshot` of the emitted power.
    #[must_use]
    pub fn until(unshot: f64) -> Self {
        Self {
            stop: StopRule { unshot, max_shots: None },
            exchange: Exchange::OneSided,
            tolerance: 1e-2,
            cell_share: 0.05,
            bright: 2.0,
            correction: Correction::Auto,
            schedule: Schedule::Auto,
            overshoot: true,
            ambient: false,
            needs: Needs::EVERYTHING,
        }
    }
}
