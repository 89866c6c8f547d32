//! A small measurement for tests: made up, round, and with every case in it.

use super::measurement::{Errors, Machine, Measurement, Method, Series, Solve, Stated, Work};
use super::subject::Subject;

/// Two refinements (of which one ran into its limit), a mesh with two shares, an octree.
pub(crate) fn measurement() -> Measurement {
    let mut coarse =
        solve(0.08, &[0.2, 0.4, 0.3], [4000, 1651, 4_791_978, 4_000_000], [0.03, 0.13]);
    coarse.stated = Some(Stated { e1: Some(0.06), einf: None });
    let mut fine = solve(0.01, &[1.5], [8000, 3302, 9_583_956, 8_000_000], [0.008, 0.05]);
    fine.stated = Some(Stated { e1: None, einf: None });
    fine.work.limit = Some("--max-time".into());
    let dim = solve(0.1, &[0.1], [1000, 300, 700_000, 700_000], [0.1, 0.3]);
    let lit = solve(0.01, &[0.2], [1000, 600, 1_400_000, 1_400_000], [0.021, 0.2]);
    let slow = Solve { seconds: vec![0.4], ..lit.clone() };
    Measurement {
        subject: Subject::Room,
        machine: Machine { cpu: "Some CPU @ 2.60GHz".into(), cores: 2 },
        threads: 2,
        reference_error: 0.000119,
        series: vec![
            Series { method: Method::Refinement, solves: vec![coarse, fine] },
            Series { method: Method::Mesh { elements: 1000 }, solves: vec![dim, lit] },
            Series { method: Method::Octree { elements: 1000 }, solves: vec![slow] },
        ],
    }
}

/// A solve without a statement; `work` counts elements, shots, segments and form factors.
fn solve(goal: f64, seconds: &[f64], work: [u64; 4], [e1, einf]: [f64; 2]) -> Solve {
    let [elements, shots, segments, form_factors] = work;
    Solve {
        goal,
        seconds: seconds.to_vec(),
        work: Work { elements, shots, segments, form_factors, unshot: goal / 2.0, limit: None },
        stated: None,
        measured: Errors { e1, einf },
    }
}
