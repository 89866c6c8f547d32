//! Every case through every engine: the right light, the same bits, all power accounted for.

use std::path::Path;

use conformance::{Case, Engine, solve};
use radiosity_core::{ShootingConfig, StopReason};

use crate::BALANCED;

/// One test per case, and one that no file was left out.
macro_rules! cases {
    ($($id:ident),* $(,)?) => {
        $(#[test] fn $id() { run(stringify!($id)); })*

        #[test]
        fn no_case_is_left_out() {
            assert!(Case::ids().eq([$(stringify!($id)),*]));
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
            assert_eq!(folder.read_dir().unwrap().count(), Case::ids().count());
        }
    };
}

cases! {
    concentric_spheres_lamp,
    concentric_spheres_shell,
    dark,
    general_furnace_box,
    general_furnace_furnished,
    integrating_sphere_port,
    two_plates_half,
    two_plates_two,
    white_furnace_cube_bright,
    white_furnace_cube_half,
    white_furnace_furnished_bright,
    white_furnace_furnished_half,
    zero_reflectance,
}

fn run(id: &str) {
    let case = Case::load(id).unwrap();
    let scene = case.scene().unwrap();
    let mut first = None;
    for engine in Engine::all() {
        if let Some(reason) = case.skipped(engine) {
            println!("{id}: {engine} skipped: {reason}");
            continue;
        }
        let config = ShootingConfig::until(case.unshot);
        let solved = solve(&scene, case.elements, config, engine).unwrap();
        let light = solved.ledger.emitted.max_channel() > 0.0;
        let expected = if light { StopReason::Converged } else { StopReason::NoLight };
        assert_eq!(solved.reason, expected, "{id}: {engine}");
        let imbalance = solved.ledger.imbalance();
        assert!(imbalance < BALANCED, "{id}: {engine}: imbalance {imbalance:e}");
        let bits = (solved.shots, solved.bits());
        match &first {
            None => {
                let (error, group) = case.error(&scene, &solved.solution);
                println!(
                    "{id}: error {error:.1e} (at most {:.1e}) in {group:?}, {} elements, {} \
                     shots, imbalance {imbalance:.0e}",
                    case.tolerance,
                    solved.solution.elements.len(),
                    solved.shots
                );
                assert!(error <= case.tolerance, "{id}: {error} in {group}: {}", case.bound);
                first = Some(bits);
            }
            Some(first) => assert!(*first == bits, "{id}: {engine} gives other light"),
        }
    }
    assert!(first.is_some(), "{id}: every engine skips it");
}
