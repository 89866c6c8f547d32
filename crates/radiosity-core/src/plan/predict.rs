//! Work foreseen: from the shape of the mesh, who faces whom, and how much light comes back.

use std::ops::Sub;

use super::cost;
use super::facts::Facts;
use super::{PlanConfig, Structure};
use crate::config::MeshConfig;
use crate::needs::Needs;
use crate::shooting::Survey;

/// Amounts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Elements of the last mesh.
    pub elements: f64,
    /// Patches that shoot, over all meshes.
    pub shots: f64,
    /// Form factors.
    pub form_factors: f64,
    /// Segments asked for.
    pub segments: f64,
    /// Directions followed.
    pub directions: f64,
    /// Seconds on one thread.
    pub seconds: f64,
}

impl Sub for Work {
    type Output = Self;

    fn sub(self, o: Self) -> Self {
        let less = |a: f64, b: f64| (a - b).max(0.0);
        Self {
            elements: less(self.elements, o.elements),
            shots: less(self.shots, o.shots),
            form_factors: less(self.form_factors, o.form_factors),
            segments: less(self.segments, o.segments),
            directions: less(self.directions, o.directions),
            seconds: less(self.seconds, o.seconds),
        }
    }
}

/// Elements that an error of 1 % takes, and how they grow where less is asked: the middle of the scenes
/// of docs/precision.md, which lie within a factor of three.
const ELEMENTS_OF_ONE_PERCENT: f64 = 15_000.0;
const GROWTH_BY_ERROR: f64 = 1.3;

/// The last mesh is finer than the scene's own pieces by this factor at least.
const LEAST_FINER: f64 = 4.0;

/// Receiver points per element and per piece of a triangle, about.
const POINTS_PER_ELEMENT: f64 = 0.55;
const POINTS_PER_PIECE: f64 = 1.3;

/// Pairs that face each other, where nobody looked: all but neighbours in one plane of a convex
/// scene, half of the others.
const FACING: [f64; 2] = [0.8, 0.55];

/// What the shape of a scene's meshes is taken to be.
pub(super) struct Shape<'a> {
    pub(super) facts: &'a Facts,
    pub(super) config: &'a PlanConfig,
    /// Pieces that the triangles are cut into.
    pub(super) pieces: f64,
    pub(super) survey: Option<Survey>,
}

/// A way to work: what is done, with what.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) needs: &'a Needs,
    pub(super) structure: Structure,
    pub(super) blockers: usize,
    pub(super) walls: usize,
    pub(super) things: usize,
    pub(super) spaces: bool,
}

impl Shape<'_> {
    /// The share of all pairs that face each other.
    pub(super) fn facing(&self) -> f64 {
        let guess = FACING[usize::from(!self.facts.nothing_blocks())];
        self.share(|s| s.facing, guess)
    }

    /// What share of the pairs of the survey this is.
    pub(super) fn share(&self, of: impl Fn(&Survey) -> f64, guess: f64) -> f64 {
        self.survey.as_ref().map_or(guess, |s| of(s) / s.pairs.max(1.0))
    }

    /// Elements of the last mesh.
    fn elements(&self) -> f64 {
        match self.config.elements {
            Some(n) => (n as f64).max(self.pieces),
            None => {
                let finer = (0.01 / self.config.error).powf(GROWTH_BY_ERROR);
                // No error is stated of fewer meshes than two.
                (ELEMENTS_OF_ONE_PERCENT * finer).max(LEAST_FINER * self.pieces)
            }
        }
    }

    /// Sweeps until the unshot share is reached: fewer than half of what plain shooting takes, thanks to
    /// overshooting; with corrections some five.
    fn sweeps(&self) -> f64 {
        let back = self.facts.mean_reflectance.min(1.0 - 1e-6);
        let plain = 0.13 * -self.config.unshot.max(1e-12).ln() / (1.0 - back);
        plain.clamp(0.1, 6.0)
    }

    /// The work of all meshes.
    pub(super) fn work(&self, way: Way) -> Work {
        let last = self.elements();
        // A mesh of a quarter of the elements before each, as long as that makes a difference.
        let mut levels = vec![last];
        while self.config.elements.is_none()
            && levels[levels.len() - 1] > 4.0 * self.pieces.max(100.0)
        {
            levels.push(levels[levels.len() - 1] / 4.0);
        }
        let mut sum = Work { elements: last, ..Work::default() };
        for elements in levels {
            self.add(&mut sum, elements, way);
        }
        sum.seconds += match way.structure {
            Structure::None => 0.0,
            _ => cost::BUILD * self.facts.triangles as f64,
        };
        sum
    }

    /// Adds the work of a mesh of so many elements.
    fn add(&self, sum: &mut Work, elements: f64, way: Way) {
        let of_patch = MeshConfig::with_elements(elements as usize).patch_elements as f64;
        let patches = self.pieces.max(1.4 * elements / of_patch);
        let lit = if way.needs.black { 1.0 } else { 1.0 - self.facts.black };
        let points = (POINTS_PER_ELEMENT * elements + POINTS_PER_PIECE * self.pieces) * lit;
        let shots = patches * lit.max(1.0 / patches) * self.sweeps();
        let pairs = shots * points;
        let share = |of: fn(&Survey) -> f64| self.share(of, 0.0);
        let hidden = share(|s| s.hidden) * f64::from(u8::from(way.walls > 0))
            + share(|s| s.apart) * f64::from(u8::from(way.spaces));
        let served = pairs * (self.facing() - hidden).max(0.0);
        let open = if way.things > 0 { pairs * share(|s| s.open) } else { 0.0 };
        let segments = if way.needs.segments { (served - open).max(0.0) } else { 0.0 };
        let directions = if way.needs.census { 32.0 * (patches + 0.1 * points) } else { 0.0 };
        let looked = match way.needs.singles {
            true => pairs * cost::LOOK,
            false => {
                let blocks = shots * points / self.block();
                let each = cost::BLOCK
                    + cost::WALL * way.walls as f64
                    + cost::THING * 0.5 * way.things as f64;
                blocks * each + (pairs - pairs * share(|s| s.behind)).max(0.0) * cost::LOOK
            }
        };
        sum.shots += shots;
        sum.form_factors += served;
        sum.segments += segments;
        sum.directions += directions;
        sum.seconds += served * cost::FORM_FACTOR
            + segments * cost::segment(way.structure, way.blockers)
            + directions * cost::DIRECTION
            + shots * elements * lit * cost::COMMIT
            + elements * cost::ELEMENT
            + looked;
    }

    /// Receivers in a block.
    fn block(&self) -> f64 {
        self.survey.as_ref().map_or(32.0, |s| (s.pairs / s.blocks.max(1.0)).max(1.0))
    }

    /// What one step takes on one thread.
    pub(super) fn step_seconds(&self, work: &Work) -> f64 {
        work.seconds / work.shots.max(1.0)
    }
}
