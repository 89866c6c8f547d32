//! Decisions about light, and who works.

use super::super::predict::{Shape, Work};
use super::super::{Effect, Topic, cost};
use super::Draft;
use crate::config::Correction;
use crate::needs::Channels;
use crate::shooting::LOSS_OF_PLAIN;

/// Black surfaces below this share of the area receive like others: then the books are whole.
const MUCH_BLACK: f64 = 0.2;

impl Draft<'_> {
    pub(super) fn decide_light(&mut self, shape: &Shape) {
        self.channels();
        self.black(shape);
        self.splitting();
        self.corrections();
        self.estimates();
        self.precision();
        self.threads(shape);
    }

    fn channels(&mut self) {
        let channels = self.facts.channels;
        let names = |of: &dyn Fn(usize) -> bool| -> String {
            let names = ["red", "green", "blue"].iter().enumerate();
            let names: Vec<&str> = names.filter(|(c, _)| of(*c)).map(|(_, n)| *n).collect();
            names.join(" and ")
        };
        let (choice, why, effect);
        match channels.only.filter(|_| self.free()) {
            None => {
                choice = "three".to_owned();
                why =
                    if self.free() { "they differ" } else { "everything is asked for" }.to_owned();
                effect = Effect::Exact;
            }
            Some(only) => {
                self.needs.channels = channels;
                choice = format!("one: {}", names(&|c| c == only));
                let dark = names(&|c| channels.times[c] == 0.0);
                let like = names(&|c| c != only && channels.times[c] != 0.0);
                let mut facts = Vec::new();
                if !like.is_empty() {
                    facts.push(format!("{like} are multiples of it everywhere"));
                }
                if !dark.is_empty() {
                    facts.push(format!("nothing emits {dark}"));
                }
                why = facts.join("; ");
                let exact = channels.times.iter().all(|k| [0.0, 1.0].contains(k));
                effect = if exact { Effect::Exact } else { Effect::Rounding };
            }
        }
        let leaves_out = self.needs.channels != Channels::ALL;
        self.put(Topic::Channels, choice, leaves_out, why, Work::default(), effect);
    }

    fn black(&mut self, shape: &Shape) {
        let share = self.facts.black;
        let leaves_out = self.free() && self.physical() && share >= MUCH_BLACK;
        let saves = match leaves_out {
            true => self.spared(shape, |draft| draft.needs.black = false),
            false => Work::default(),
        };
        let (choice, effect) = match leaves_out {
            true => ("black surfaces receive nothing and stay unsplit", Effect::Stated),
            false => ("all surfaces receive", Effect::Exact),
        };
        let why = match self.free() {
            true => format!("{:.1} % of the area reflects none of the light", 100.0 * share),
            false => "everything is asked for".into(),
        };
        self.put(Topic::Black, choice.into(), leaves_out, why, saves, effect);
    }

    fn splitting(&mut self) {
        let [least, median, greatest] = self.facts.sizes;
        let mut why = format!(
            "triangles are {} across (least {}, greatest {}) in a scene of {}",
            short(median),
            short(least),
            short(greatest),
            short(self.facts.extent)
        );
        if self.facts.copies > 0 {
            why += &format!("; {} copies of earlier ones have no elements", self.facts.copies);
        }
        let choice = match self.config.elements {
            None => "where light is not what neighbours foretell, longest edges first",
            Some(_) => "everywhere alike, longest edges first",
        };
        self.put(Topic::Splitting, choice.into(), false, why, Work::default(), Effect::Exact);
    }

    fn corrections(&mut self) {
        let most = self.facts.reflectance[1];
        let plain = most <= 1.0 - LOSS_OF_PLAIN;
        let asked = self.config.correction == Correction::Never;
        let leaves_out = asked || plain && self.free();
        let choice = match leaves_out {
            true => "none, and no row of form factors is kept",
            false if self.config.everything => "as the first sweep shows; rows are kept",
            false => "as the first sweep shows",
        };
        let why = match asked {
            true => "asked for".into(),
            false => format!(
                "the most reflective surface sends back {most:.3}; corrections pay from {:.1}",
                1.0 - LOSS_OF_PLAIN
            ),
        };
        if self.config.everything && !asked {
            self.correction = Correction::Always;
        }
        // On a fixed mesh the unshot share ends the shots, whatever the bound on the rest.
        let exact = self.config.elements.is_some() && plain;
        let effect = if exact { Effect::Exact } else { Effect::Stated };
        self.put(Topic::Corrections, choice.into(), leaves_out, why, Work::default(), effect);
    }

    fn estimates(&mut self) {
        let leaves_out = self.free() && !self.config.timed;
        self.needs.early_estimates = !leaves_out;
        let (choice, why) = match leaves_out {
            true => (
                "form factors are estimated again on meshes that may be the last",
                "what smaller ones err by decides nothing, unless the work is stopped",
            ),
            false if self.free() => (
                "form factors are estimated again on each mesh",
                "a time limit may make any the last",
            ),
            false => ("form factors are estimated again on each mesh", "everything is asked for"),
        };
        self.put(
            Topic::Estimates,
            choice.into(),
            leaves_out,
            why.into(),
            Work::default(),
            Effect::Exact,
        );
    }

    fn precision(&mut self) {
        let choice = "f32 boxes with f64 where those cannot tell; light in f64".into();
        let why = "f64 boxes would answer the same (accel's tests); sums of light in f32 drift, 5e-3 at \
                   reflectance .999";
        self.put(Topic::Precision, choice, false, why.into(), Work::default(), Effect::Exact);
    }

    fn threads(&mut self, shape: &Shape) {
        let work = shape.work(self.way());
        let step = shape.step_seconds(&work);
        let pays = step >= cost::STEP_WORTH_SHARING && work.seconds >= 10.0 * cost::POOL;
        let (threads, why) = match self.config.threads {
            Some(n) => (n, "asked for".to_owned()),
            None if !self.free() => (self.config.available, "everything is asked for".into()),
            None if pays => (
                self.config.available,
                format!("a step is foreseen to take {:.1} ms on one", 1e3 * step),
            ),
            None => (
                1,
                format!(
                    "a step is foreseen to take {:.0} µs: less than threads take to meet",
                    1e6 * step
                ),
            ),
        };
        let leaves_out = self.config.threads.is_none() && threads < self.config.available;
        self.threads = threads;
        self.put(
            Topic::Threads,
            threads.to_string(),
            leaves_out,
            why,
            Work::default(),
            Effect::Exact,
        );
    }
}

/// A length with three digits.
fn short(x: f64) -> String {
    match x.abs() {
        a if (1e-2..1e4).contains(&a) => format!("{x:.3}"),
        _ => format!("{x:.2e}"),
    }
}
