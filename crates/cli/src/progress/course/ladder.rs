//! Which meshes a solve will still make: as `radiosity_core::refine` chooses them, as far as that is known.

use radiosity_core::{Asked, LevelReport};

/// Growth from level to level, and the least that is worth one.
const GROWTH: f64 = 4.0;
const LEAST_GROWTH: f64 = 1.5;

/// No mesh with fewer elements ends a refinement.
const LEAST_ELEMENTS: f64 = 1000.0;

/// The next level aims below the asked error by this factor.
const AIM: f64 = 0.8;

/// The powers by which errors of meshes and of form factors fall with the elements: the middle of what
/// docs/precision.md shows.
const MESH_FALL: f64 = 0.9;
const FORM_FACTOR_FALL: f64 = 0.15;

/// Of the asked error, for form factors that nobody judged yet.
const UNJUDGED: f64 = 0.3;

/// An error this many times as large as the asked one is surely too large, and one this many times
/// smaller is surely not; elements likewise.
const SURE_ERROR: f64 = 2.0;
const SURE_ELEMENTS: f64 = 4.0;

/// Levels go in steps, so that the last one has more elements than are needed.
const MORE: f64 = 1.5;

/// No solve has more levels.
const MOST_LEVELS: usize = 16;

/// What the last finished level was found to err by.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Judged {
    elements: f64,
    mesh: Option<f64>,
    form_factor: Option<f64>,
    iteration: f64,
}

impl Judged {
    pub(super) fn of(report: &LevelReport) -> Self {
        let known = |x: f64| x.is_finite().then_some(x);
        let parts = report.statement.map(|s| s.triangles.e1);
        Self {
            elements: report.elements.max(1) as f64,
            mesh: parts.and_then(|parts| known(parts.mesh)),
            form_factor: parts.and_then(|parts| known(parts.form_factor)),
            iteration: parts.and_then(|parts| known(parts.iteration)).unwrap_or(0.0),
        }
    }
}

/// What is known of the meshes ahead.
pub(super) struct Ahead {
    pub(super) asked: Asked,
    /// No mesh has more elements.
    pub(super) most: f64,
    pub(super) judged: Judged,
    /// Elements of the last mesh as the plan has it.
    pub(super) planned: f64,
}

impl Ahead {
    /// Elements of the meshes after one of `have` elements.
    pub(super) fn levels(&self, mut have: f64) -> Vec<f64> {
        let mut levels = Vec::new();
        match self.asked {
            Asked::Unstated(_) => {}
            Asked::Elements(n) => {
                let n = (n as f64).min(self.most);
                while have * LEAST_GROWTH <= n && levels.len() < MOST_LEVELS {
                    let more = (have * GROWTH).ceil();
                    have = if more * LEAST_GROWTH > n { n } else { more };
                    levels.push(have);
                }
            }
            Asked::Error(target) => {
                // As many as more likely than not.
                let mut all = self.goes_on(have, target);
                while all > 0.5 && levels.len() < MOST_LEVELS {
                    let more = have * self.wanted(have, target);
                    have = match more <= self.most {
                        true => more,
                        false if have * LEAST_GROWTH <= self.most => self.most,
                        false => break,
                    };
                    levels.push(have);
                    all *= self.goes_on(have, target);
                }
            }
        }
        levels
    }

    /// What the parts of the error would be with so many elements: mesh, and the rest.
    fn parts(&self, elements: f64, target: f64) -> Option<(f64, f64)> {
        let finer = self.judged.elements / elements;
        let form_factor = self.judged.form_factor.unwrap_or(UNJUDGED * target);
        let rest = form_factor * finer.powf(FORM_FACTOR_FALL) + self.judged.iteration;
        Some((self.judged.mesh? * finer.powf(MESH_FALL), rest))
    }

    /// How likely a mesh of so many elements is not the last, from 0 to 1.
    fn goes_on(&self, elements: f64, target: f64) -> f64 {
        if elements < LEAST_ELEMENTS.min(self.most) {
            return 1.0;
        }
        let (too_much, sure) = match self.parts(elements, target) {
            Some((mesh, rest)) => ((mesh + rest) / target, SURE_ERROR),
            None => (MORE * self.planned / elements, SURE_ELEMENTS),
        };
        (0.5 + too_much.ln() / (2.0 * sure.ln())).clamp(0.0, 1.0)
    }

    /// The growth to the mesh after one of so many elements.
    fn wanted(&self, elements: f64, target: f64) -> f64 {
        match self.parts(elements, target) {
            Some((mesh, rest)) if elements >= LEAST_ELEMENTS && target * AIM > rest => {
                (mesh / (target * AIM - rest)).powi(2).clamp(LEAST_GROWTH, GROWTH)
            }
            _ => GROWTH,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ahead(asked: Asked) -> Ahead {
        Ahead { asked, most: f64::INFINITY, judged: Judged::default(), planned: 15_000.0 }
    }

    #[test]
    fn fixed_meshes_have_coarser_ones_before_them() {
        // The levels of `--elements 20000` on the Cornell box, as its report has them.
        assert_eq!(ahead(Asked::Elements(20_000)).levels(1250.0), [5000.0, 20_000.0]);
        assert_eq!(ahead(Asked::Elements(20_000)).levels(20_000.0), [0.0; 0]);
        assert_eq!(ahead(Asked::Unstated(20_000)).levels(100.0), [0.0; 0]);
    }

    #[test]
    fn refinement_goes_on_until_plan_or_statement_say_that_it_is_enough() {
        let mut ahead = ahead(Asked::Error(0.01));
        assert_eq!(ahead.levels(100.0), [400.0, 1600.0, 6400.0, 25_600.0]);
        // 1.7 % with 1,584 elements: a quarter of the mesh's part is enough, half is not.
        let mesh = Some(0.013);
        ahead.judged = Judged { elements: 1584.0, mesh, form_factor: Some(0.003), iteration: 1e-3 };
        assert_eq!(ahead.levels(1584.0), [1584.0 * 4.0]);
        ahead.judged.mesh = Some(0.05);
        assert_eq!(ahead.levels(1584.0).len(), 2);
        // What is right stays, and limits hold.
        ahead.judged.mesh = Some(0.002);
        assert_eq!(ahead.levels(1584.0), [0.0; 0]);
        ahead.judged.mesh = Some(1.0);
        ahead.most = 5000.0;
        assert_eq!(ahead.levels(1584.0), [5000.0]);
    }
}
