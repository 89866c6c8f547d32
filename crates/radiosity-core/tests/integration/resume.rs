//! Work that was cut off goes on as if it had not been: the same bits, from every step on.

use accel::{Bvh, BvhConfig};
use radiosity_core::{
    Asked, Checkpoint, Control, Exchange, Inconsistent, Kept, Observer, Probe, RefineConfig,
    Refined, Schedule, Sequential, ShootingConfig, Split, StepReport, refine, resume,
};
use scene::{Scene, TriangleId};

use crate::models::{Model, until};

/// One solve: a scene and all that is asked of it.
struct Case {
    scene: Scene,
    bvh: Bvh,
    config: ShootingConfig,
    refining: RefineConfig,
    probes: Vec<Probe>,
}

impl Case {
    fn new(scene: Scene, asked: Asked) -> Self {
        let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
        let bvh = Bvh::build(&triangles, &BvhConfig::default());
        let (config, refining) = (until(1e-4), RefineConfig::until(asked));
        Self { scene, bvh, config, refining, probes: Vec::new() }
    }

    fn solve(&self, observer: &mut impl Observer) -> Refined {
        let Self { scene, bvh, config, refining, probes } = self;
        refine(scene, bvh, bvh, &Sequential, *config, *refining, probes, observer)
    }

    fn resume(&self, bytes: &[u8], observer: &mut impl Observer) -> Result<Refined, Inconsistent> {
        let Self { scene, bvh, config, refining, probes } = self;
        let checkpoint = Checkpoint::read(bytes)?;
        let (config, refining) = (*config, *refining);
        resume(checkpoint, scene, bvh, bvh, &Sequential, config, refining, probes, observer)
    }
}

/// Keeps the state of every step.
#[derive(Default)]
struct Keeper {
    steps: usize,
    /// Stops after this one.
    last: Option<usize>,
    kept: Vec<Vec<u8>>,
}

impl Observer for Keeper {
    fn step(&mut self, _: &StepReport) -> Control {
        self.steps += 1;
        if self.last == Some(self.steps) { Control::Stop } else { Control::Continue }
    }

    fn keeps(&mut self) -> bool {
        true
    }

    fn keep(&mut self, kept: &Kept<'_>) {
        let mut bytes = Vec::new();
        kept.write(&mut bytes).unwrap();
        self.kept.push(bytes);
    }
}

/// All of the result but what is not written anywhere, as text: `f64` shows every bit.
fn shown(refined: &Refined) -> String {
    let Refined { mesh, solution, statement, ledger, reason, reached, .. } = refined;
    let Refined { work, total_work, corrected, closed_rows, probes, .. } = refined;
    let mesh = (mesh.elements(), mesh.points(), mesh.patches());
    format!(
        "{mesh:?} {solution:?} {statement:?} {ledger:?} {reason:?} {reached:?} {work:?} \
         {total_work:?} {corrected} {closed_rows:?} {probes:?}"
    )
}

/// Resumes from steps all over the work, and from a state that was kept after resuming.
fn goes_on_alike(name: &str, case: &Case) -> Refined {
    let mut keeper = Keeper::default();
    let whole = case.solve(&mut keeper);
    let steps = keeper.kept.len();
    assert!(steps > 3, "{name}: {steps} steps");
    let every = (steps / 5).max(1);
    for step in (0..steps).step_by(every).chain([steps - 1]) {
        let mut again = Keeper::default();
        let resumed = case.resume(&keeper.kept[step], &mut again).unwrap();
        assert_eq!(shown(&resumed), shown(&whole), "{name}, step {step} of {steps}");
        assert_eq!(again.kept[..], keeper.kept[step + 1..], "{name}, step {step} of {steps}");
    }
    whole
}

/// A box with a lamp in the roof and a board in the air.
fn shadows(reflectance: f64) -> Scene {
    let mut model = Model::new();
    let wall = model.surface(reflectance, 0.0);
    let lamp = model.surface(0.0, 9.0);
    model.cube([wall; 6]);
    model.quad([[0.4, 0.4, 0.99], [0.4, 0.6, 0.99], [0.6, 0.6, 0.99], [0.6, 0.4, 0.99]], lamp);
    model.quad([[0.3, 0.3, 0.5], [0.8, 0.3, 0.5], [0.8, 0.7, 0.5], [0.3, 0.7, 0.5]], wall);
    model.scene()
}

/// A closed box that reflects nearly all.
fn bright_box() -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.98, 0.0);
    let lamp = model.surface(0.9, 1.0);
    model.cube([lamp, wall, wall, wall, wall, wall]);
    model.scene()
}

#[test]
fn meshes_that_follow_the_light_go_on_alike() {
    for (reflectance, target, split) in [
        (0.5, 0.05, Split::LongestEdge),
        (0.7, 0.08, Split::LongestEdge),
        (0.5, 0.2, Split::Centroid),
        (0.5, 0.2, Split::None),
    ] {
        let mut case = Case::new(shadows(reflectance), Asked::Error(target));
        case.refining = RefineConfig { split, most_elements: 1100, ..case.refining };
        let whole = goes_on_alike(&format!("error {target}, {split:?}"), &case);
        // Several levels: else the ladder itself is not tried.
        assert!(whole.mesh.elements().len() > 100 && whole.work.shots < whole.total_work.shots);
    }
}

#[test]
fn fixed_meshes_go_on_alike_with_and_without_a_statement() {
    for asked in [Asked::Elements(1200), Asked::Unstated(600)] {
        goes_on_alike(&format!("{asked:?}"), &Case::new(shadows(0.5), asked));
    }
    for schedule in [Schedule::Single, Schedule::Multi(std::num::NonZeroUsize::new(3).unwrap())] {
        let mut case = Case::new(shadows(0.5), Asked::Unstated(200));
        case.config.schedule = schedule;
        goes_on_alike(&format!("{schedule:?}"), &case);
    }
}

#[test]
fn corrections_and_closed_rows_go_on_alike() {
    for asked in [Asked::Unstated(300), Asked::Elements(500), Asked::Error(0.05)] {
        let mut case = Case::new(bright_box(), asked);
        case.refining.most_elements = 600;
        let whole = goes_on_alike(&format!("bright, {asked:?}"), &case);
        assert!(whole.corrected && whole.closed_rows.is_some());
    }
}

#[test]
fn probes_and_paired_surfaces_go_on_alike() {
    let mut case = Case::new(shadows(0.4), Asked::Elements(500));
    case.probes = [None, Some(0.01)]
        .map(|area| Probe::Surface { triangle: TriangleId(0), uv: [0.3, 0.4], area })
        .to_vec();
    let whole = goes_on_alike("probes", &case);
    assert!(whole.probes.len() == 2 && whole.probes.iter().all(|p| p[0] > 0.0));
    case.config.exchange = Exchange::Paired;
    goes_on_alike("paired", &case);
}

#[test]
fn levels_that_tighten_their_goal_go_on_alike() {
    // Reflectances of 0 and .9: the first bound is loose, so all patches shoot, and less unshot
    // light is asked for, up to four times over.
    let mut case = Case::new(shadows(0.9), Asked::Error(0.03));
    case.refining.most_elements = 400;
    goes_on_alike("tightened", &case);
}

#[test]
fn a_step_that_stops_is_kept_too() {
    let case = Case::new(shadows(0.5), Asked::Elements(500));
    let whole = case.solve(&mut ());
    let mut keeper = Keeper { last: Some(20), ..Keeper::default() };
    case.solve(&mut keeper);
    assert_eq!(keeper.kept.len(), 20);
    let resumed = case.resume(&keeper.kept[19], &mut ()).unwrap();
    assert_eq!(shown(&resumed), shown(&whole));
}

#[test]
fn states_of_other_work_are_refused() {
    let case = Case::new(shadows(0.7), Asked::Error(0.08));
    let mut keeper = Keeper::default();
    case.solve(&mut keeper);
    let kept = &keeper.kept[keeper.kept.len() - 2];
    assert!(case.resume(kept, &mut ()).is_ok());
    let refused = |case: &Case| case.resume(kept, &mut ()).is_err();
    assert!(refused(&Case::new(bright_box(), Asked::Error(0.08))));
    assert!(refused(&Case::new(shadows(0.7), Asked::Elements(500))));
    assert!(refused(&Case::new(shadows(0.7), Asked::Unstated(500))));
    let mut other = Case::new(shadows(0.7), Asked::Error(0.08));
    let probe = |area| Probe::Surface { triangle: TriangleId(0), uv: [0.3, 0.4], area };
    other.probes.push(probe(None));
    assert!(refused(&other));
    other.probes[0] = probe(Some(0.1));
    assert!(refused(&other));
    let mut other = Case::new(shadows(0.7), Asked::Error(0.08));
    other.config.correction = radiosity_core::Correction::Never;
    assert!(refused(&other));
    other = Case::new(shadows(0.7), Asked::Error(0.08));
    other.refining.split = Split::None;
    assert!(refused(&other));
}

#[test]
fn a_state_cannot_ask_for_a_first_mesh_of_any_size() {
    // The default limit on elements, which keeps nobody from 2³⁰ of them.
    let case = Case::new(shadows(0.7), Asked::Error(0.2));
    let mut keeper = Keeper { last: Some(1), ..Keeper::default() };
    case.solve(&mut keeper);
    let mut kept = keeper.kept.remove(0);
    assert!(case.resume(&kept, &mut Brief(0)).is_ok());
    // Work of five numbers, then the limit on elements, the number of meshes and the first one's
    // elements: 8 bytes each, but for the unshot share, which is 8 as well.
    let at = 7 * 8;
    let elements = u64::from_le_bytes(kept[at..at + 8].try_into().unwrap());
    assert!((1..10_000).contains(&elements), "{elements}");
    kept[at..at + 8].copy_from_slice(&200_000_000_u64.to_le_bytes());
    let error = case.resume(&kept, &mut Brief(0)).unwrap_err();
    assert_eq!(error.to_string(), "its meshes do not follow from each other");
}

/// Stops soon, so that states that make no sense do not take long.
struct Brief(u32);

impl Observer for Brief {
    fn step(&mut self, _: &StepReport) -> Control {
        self.0 += 1;
        if self.0 < 3 { Control::Continue } else { Control::Stop }
    }
}

#[test]
fn no_bytes_make_it_panic() {
    // A checksum keeps such bytes away from the program; the library must not hang on that.
    let mut case = Case::new(shadows(0.7), Asked::Error(0.2));
    case.refining.most_elements = 200;
    let mut keeper = Keeper::default();
    case.solve(&mut keeper);
    let (mut read, mut resumed) = (0, 0);
    let mut try_out = |bytes: &[u8]| {
        read += u32::from(Checkpoint::read(bytes).is_ok());
        resumed += u32::from(case.resume(bytes, &mut Brief(0)).is_ok());
    };
    // Knuth's MMIX generator.
    let mut seed = 1u64;
    let mut next = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as usize) % below
    };
    for round in 0..400 {
        let kept = &keeper.kept[next(keeper.kept.len())];
        let mut bytes = kept.clone();
        match round % 4 {
            0 => bytes[next(kept.len())] ^= 1 << next(8),
            1 => {
                // Counts and lengths stand in front, mostly.
                let at = next(600.min(kept.len() - 8));
                bytes[at..at + 8].copy_from_slice(&[[0; 8], [255; 8]][next(2)]);
            }
            2 => bytes.truncate(next(kept.len())),
            _ => {
                let (from, to) = (next(kept.len() - 64), next(kept.len() - 64));
                bytes.copy_within(from..from + 64, to);
            }
        }
        try_out(&bytes);
    }
    println!("{read} of 400 could be read, {resumed} were gone on with");
    assert!(read > 100 && resumed > 50);
}
