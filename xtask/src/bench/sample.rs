//! A small measurement for tests: made up, round, and with every case in it.

use super::measurement::{Copies, Measurement, Mode, Series, Solved, Timed};
use super::scene::Scene;
use crate::precision::Machine;

/// Two cores, two modes; three rounds of 1, 2 and (without a core for each) 4 threads.
pub(super) fn measurement() -> Measurement {
    let timed = |threads, seconds: [f64; 3]| Timed { threads, seconds: seconds.to_vec() };
    let points =
        vec![timed(1, [8.0, 16.0, 8.0]), timed(2, [5.0, 10.0, 4.0]), timed(4, [5.0, 10.0, 5.0])];
    let mode = Mode { sharing: Some("static".into()), schedule: None };
    let alone = Series { mode, points: points[..1].to_vec() };
    let series = vec![Series { mode: Mode::default(), points }, alone];
    let file = "scenes/room.tri".into();
    Measurement {
        machine: Machine { cpu: "Some CPU @ 2.60GHz".into(), cores: 2 },
        elements: 8000,
        scenes: vec![Solved {
            scene: Scene::Room,
            file,
            elements: 7999,
            others: Some(0.25),
            series,
            copies: Some(Copies { programs: 2, seconds: vec![10.0, 20.0, 8.0] }),
        }],
    }
}
