//! Decisions about who sees whom.

use accel::Proofs;
use accel::proof::{Spaces, Walls};

use super::super::predict::{Shape, Work};
use super::super::{Decision, Effect, Structure, Topic, cost};
use super::Draft;
use crate::config::Exchange;

/// Fewer facing pairs in different spaces than this are not worth telling apart.
const LEAST_APART: f64 = 0.01;

/// Proofs must spare this many times what looking for them takes: both are foreseen, not known.
const WORTH: f64 = 1.5;

/// Triangles that cannot block are left out of what finds occluders if they have this share of the area:
/// the more, the more segments end at them. It is built twice then, with them for directions.
const WORTH_PARTING: f64 = 0.02;

impl Draft<'_> {
    pub(super) fn decide_sight(&mut self, shape: &Shape) {
        let none = Proofs { objects: None, lift: self.proofs.lift, ..Proofs::default() };
        let all = std::mem::replace(&mut self.proofs, none);
        self.blocking(shape);
        self.structure(shape);
        self.planes(shape);
        self.spaces(shape, all.spaces);
        self.walls(shape, all.walls);
        self.ways(shape, all.objects);
        self.census(shape);
    }

    /// Whether the light of a side goes to what it faces alone, and not by an older rule.
    pub(super) fn physical(&self) -> bool {
        self.config.exchange == Exchange::OneSided
    }

    fn blocking(&mut self, shape: &Shape) {
        let facts = self.facts;
        let (triangles, blockers) =
            (facts.blocking.len(), facts.blocking.iter().filter(|b| **b).count());
        let free = self.free() && self.physical();
        let asked = self.config.structure == Some(Structure::None);
        let (choice, why, leaves_out, effect);
        let mut saves = Work::default();
        if asked || free && facts.nothing_blocks() && self.config.structure.is_none() {
            saves = self.spared(shape, |draft| {
                draft.needs.segments = false;
                draft.blockers = 0;
            });
            choice = "no segment is asked for".to_owned();
            why = match facts.nothing_blocks() {
                true => "every triangle has all others on one side: nothing can block".to_owned(),
                false => {
                    format!("asked for, although {blockers} of {triangles} triangles may block")
                }
            };
            effect = if facts.nothing_blocks() { Effect::Exact } else { Effect::Stated };
            leaves_out = true;
        } else if free && blockers < triangles && facts.open_area >= WORTH_PARTING {
            saves = self.spared(shape, |draft| draft.blockers = blockers);
            choice = format!("segments through {blockers} of {triangles} triangles");
            why = format!(
                "{} have all others on one side: they end the view and hide nothing",
                triangles - blockers
            );
            (effect, leaves_out) = (Effect::Exact, true);
        } else {
            choice = format!("segments through all {triangles} triangles");
            why = if self.free() {
                format!("{blockers} may block; the others are too small to matter")
            } else {
                "everything is asked for".into()
            };
            (effect, leaves_out) = (Effect::Exact, false);
        }
        self.put(Topic::Blocking, choice, leaves_out, why, saves, effect);
    }

    fn structure(&mut self, shape: &Shape) {
        let seconds = |structure| cost::segment(structure, self.blockers) * 1e9;
        let (octree, bvh) = (seconds(Structure::Octree), seconds(Structure::Bvh));
        let foreseen =
            format!("a segment is foreseen to take {bvh:.0} ns by bvh, {octree:.0} by octree");
        let best = match (self.needs.segments, self.config.structure) {
            (false, _) => Structure::None,
            (true, Some(structure)) => structure,
            (true, None) if bvh <= octree => Structure::Bvh,
            (true, None) => Structure::Octree,
        };
        let why = match (self.needs.segments, self.config.structure) {
            (false, _) => "no segment is asked for".into(),
            (true, Some(_)) => format!("asked for; {foreseen}"),
            (true, None) => foreseen,
        };
        let saves = self.spared(shape, |draft| draft.structure = best);
        let leaves_out = best == Structure::None;
        self.put(Topic::Structure, best.name().into(), leaves_out, why, saves, Effect::Exact);
    }

    fn planes(&mut self, shape: &Shape) {
        if !self.free() || !self.physical() {
            let why = if self.free() {
                "light goes by the paired rule"
            } else {
                "everything is asked for"
            };
            let choice = "receivers one by one".into();
            self.put(Topic::Planes, choice, false, why.into(), Work::default(), Effect::Exact);
            return;
        }
        let saves = self.spared(shape, |draft| draft.needs.singles = false);
        let why = match &shape.survey {
            Some(s) => format!(
                "{:.0} % of the pairs in a sample lie behind each other's plane, block by block",
                100.0 * s.behind / s.pairs.max(1.0)
            ),
            None => "a look at a block takes less than at its receivers".into(),
        };
        let choice = "blocks behind a plane are left out".into();
        self.put(Topic::Planes, choice, true, why, saves, Effect::Exact);
    }

    fn spaces(&mut self, shape: &Shape, spaces: Spaces) {
        let (shells, triangles) = (spaces.shells(), spaces.triangles());
        let few = shape.survey.as_ref().is_some_and(|s| s.apart < LEAST_APART * s.facing);
        if shells == 0 || few || self.needs.singles || !self.needs.segments {
            let why = match shells {
                0 => "no closed surface parts lit places",
                _ => "closed surfaces part few of those that face each other",
            };
            let choice = "one space".into();
            self.put(Topic::Spaces, choice, false, why.into(), Work::default(), Effect::Exact);
            return;
        }
        let saves = self.spared(shape, |draft| draft.proofs.spaces = spaces);
        let why = format!(
            "closed surfaces of {triangles} triangles part lit places; {:.0} % of the facing pairs of a \
             sample are in different spaces, or where no lamp is",
            100.0 * shape.share(|s| s.apart / s.facing.max(1.0) * s.pairs, 0.0)
        );
        let choice = format!("light stays within {} sealed spaces or more", shells + 1);
        self.put(Topic::Spaces, choice, true, why, saves, Effect::Exact);
    }

    fn walls(&mut self, shape: &Shape, walls: Walls) {
        let count = walls.len();
        let merged = "coplanar triangles were joined first";
        let worth = shape.survey.as_ref().is_some_and(|s| {
            let spared =
                s.hidden * (cost::FORM_FACTOR + cost::segment(self.structure, self.blockers));
            spared > WORTH * s.blocks * cost::WALL * count as f64
        });
        if !worth || self.needs.singles || !self.needs.segments {
            let why = match (count, &shape.survey) {
                (0, _) => format!("no convex wall is a sixteenth of the scene; {merged}"),
                (_, None) => "a short solve".into(),
                (_, Some(s)) => format!(
                    "{count} large walls hide {:.1} % of the facing pairs of a sample: too few",
                    100.0 * s.hidden / s.facing.max(1.0)
                ),
            };
            let choice = "hidden receivers are found by segments".into();
            self.put(Topic::Walls, choice, false, why, Work::default(), Effect::Exact);
            return;
        }
        let why = format!(
            "{:.0} % of the facing pairs of a sample are hidden by {count} convex walls; {merged}",
            100.0 * shape.share(|s| s.hidden / s.facing.max(1.0) * s.pairs, 0.0)
        );
        let saves = self.spared(shape, |draft| draft.proofs.walls = walls);
        let choice = "no form factor for blocks behind a wall".into();
        self.put(Topic::Walls, choice, true, why, saves, Effect::Exact);
    }

    fn ways(&mut self, shape: &Shape, objects: Option<accel::proof::Objects>) {
        let count = objects.as_ref().map_or(0, accel::proof::Objects::len);
        let worth = shape.survey.as_ref().is_some_and(|s| {
            let spared = s.open * cost::segment(self.structure, self.blockers);
            spared > WORTH * s.blocks * cost::THING * 0.5 * count as f64
        });
        if !worth || self.needs.singles || !self.needs.segments {
            let why = match (&objects, &shape.survey) {
                _ if !self.needs.segments => "no segment is asked for".into(),
                (None, _) => "more than 256 separate things may block".into(),
                (_, None) => "a short solve".into(),
                (_, Some(s)) => format!(
                    "{:.0} % of the facing pairs of a sample pass by all of {count} things: too few",
                    100.0 * s.open / s.facing.max(1.0)
                ),
            };
            let choice = match self.needs.segments {
                true => "each pair is asked for".into(),
                false => "all are open".into(),
            };
            self.put(Topic::Ways, choice, false, why, Work::default(), Effect::Exact);
            return;
        }
        let why = format!(
            "{:.0} % of the facing pairs of a sample pass by all of {count} things that may block",
            100.0 * shape.share(|s| s.open / s.facing.max(1.0) * s.pairs, 0.0)
        );
        let saves = self.spared(shape, |draft| draft.proofs.objects = objects);
        let choice = "no segment where nothing rises between".into();
        self.put(Topic::Ways, choice, true, why, saves, Effect::Exact);
    }

    fn census(&mut self, shape: &Shape) {
        let closed = self.free() && self.physical() && self.facts.closed;
        let (mut saves, mut choice, mut why) = (
            Work::default(),
            "directions are followed to where light ends up",
            "light may leave the scene, or meet backs",
        );
        if closed {
            saves = self.spared(shape, |draft| draft.needs.census = false);
            choice = "no direction is followed";
            why = "fronts surround a convex space: all light arrives";
        } else if !self.free() {
            why = "everything is asked for";
        }
        self.put(Topic::Census, choice.into(), closed, why.into(), saves, Effect::Exact);
    }

    pub(super) fn put(
        &mut self,
        topic: Topic,
        choice: String,
        leaves_out: bool,
        why: String,
        saves: Work,
        effect: Effect,
    ) {
        self.decisions.push(Decision { topic, choice, leaves_out, why, saves, effect });
    }
}
