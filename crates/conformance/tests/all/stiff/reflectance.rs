//! Reflectances of 1, near 1, of 0, and all of them in one room.

use radiosity_core::{Correction, ShootingConfig, StopReason, StopRule};
use scene::{ErrorKind, Material, MaterialId, Rgb, SceneBuilder, Sides};

use super::model::{Lit, Model, light};
use crate::BALANCED;

/// Work allowed at any reflectance, in sweeps; plain shooting needs 6.9 / (1 − ρ).
const SWEEPS: f64 = 20.0;

/// Reflectances up to where plain shooting would need 6.9 million sweeps.
const REFLECTANCES: [f64; 6] = [0.5, 0.9, 0.99, 0.999, 0.9999, 0.999_999];

/// The relative error that the catalogue allows a furnace whose form factors are exact.
const FURNACE: f64 = 1e-9;

/// How well the columns of the second-order rule at the corners sum to 1, on coarse meshes.
const COLUMNS: f64 = 1e-2;

/// Lambert's form at every distance, and cells as fine as the mesh: rows sum to 1.
fn exact(unshot: f64) -> ShootingConfig {
    ShootingConfig { tolerance: 0.0, cell_share: 0.0, ..ShootingConfig::until(unshot) }
}

/// A cube of one reflectance with `lamp` on its floor and `wall` elsewhere.
fn cube(reflectance: f64, lamp: f64, wall: f64, elements: usize, config: ShootingConfig) -> Lit {
    let mut model = Model::new();
    let lamp = model.grey(reflectance, lamp);
    let wall = model.grey(reflectance, wall);
    model.cube([lamp, wall, wall, wall, wall, wall]);
    light(&model.scene(), elements, config)
}

/// The largest relative distance of any exitance from `expected`.
fn furthest(solved: &Lit, expected: f64) -> f64 {
    solved.values().map(|b| (b[0] / expected - 1.0).abs()).fold(0.0, f64::max)
}

fn said(name: &str, rho: f64, solved: &Lit, error: f64) {
    let elements = solved.solution.elements.len();
    let bound = solved.remaining.power[0] / solved.ledger.emitted[0] * (1.0 - rho);
    println!(
        "{name}, ρ {rho}, {elements} elements: {:.1} sweeps, unshot {:.1e}, at most {bound:.1e} \
         missing, error {error:.1e}, rows {:?}",
        solved.sweeps(),
        solved.unshot,
        solved.closed_rows
    );
}

#[test]
fn rho_to_1() {
    for (rho, elements) in REFLECTANCES.into_iter().flat_map(|rho| [(rho, 12), (rho, 96)]) {
        let bright = 1.0 / (1.0 - rho);
        let solved = cube(rho, 1.0, 1.0, elements, exact(1e-10));
        let error = furthest(&solved, bright);
        said("furnace", rho, &solved, error);
        assert_eq!(solved.reason, StopReason::Converged);
        assert!(error <= FURNACE && solved.sweeps() <= SWEEPS, "{rho} {elements}: {error:e}");
        // As users have it: form factors of 1 %, which the walls repeat 1 / (1 − ρ) times.
        let config = ShootingConfig::until(1e-10);
        let error = furthest(&cube(rho, 1.0, 1.0, elements, config), bright);
        println!("furnace with form factors of 1 %: error {error:.1e}");
        assert!(error <= 10.0 * config.tolerance * bright, "{rho} {elements}: {error:e}");
        // One face shines: what it gives is absorbed, so ΣA·B = ΣA·E·(1 + ρ/(1 − ρ)).
        let solved = cube(rho, 1.0, 0.0, elements, config);
        let power = solved.triangles.iter().map(|b| b[0] / 2.0).sum::<f64>();
        let error = (power / bright - 1.0).abs();
        said("one face", rho, &solved, error);
        assert!(solved.reason == StopReason::Converged && solved.sweeps() <= SWEEPS);
        // Columns are those of a second-order rule at the corners.
        assert!(error <= COLUMNS, "{rho} {elements}: {error:e}");
    }
    // A budget that is spent is said to be.
    let plain = ShootingConfig { correction: Correction::Never, ..ShootingConfig::until(1e-6) };
    let stop = StopRule { unshot: 1e-6, max_shots: Some(100) };
    let solved = cube(0.999_999, 1.0, 0.0, 12, ShootingConfig { stop, ..plain });
    assert_eq!((solved.reason, solved.shots), (StopReason::ShotLimit, 100));
    assert!(solved.unshot > 0.9 && solved.ledger.imbalance() < BALANCED);
    assert_eq!(cube(0.999_999, 1.0, 0.0, 12, plain).reason, StopReason::Stalled);
}

#[test]
fn rho_exactly_1() {
    let scene = |rest: f64| {
        let mut model = Model::new();
        let wall = model.grey(1.0, 0.0);
        let lamp = model.grey(1.0, 1.0);
        let last = model.grey(rest, 0.0);
        model.room(
            [0.0; 3],
            [1.0; 3],
            [None, Some(wall), Some(wall), Some(wall), Some(wall), Some(wall)],
        );
        model.triangle([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.]], lamp);
        model.triangle([[0., 0., 0.], [1., 1., 0.], [0., 1., 0.]], last);
        model.scene()
    };
    for elements in [12, 192] {
        let white = light(&scene(1.0), elements, ShootingConfig::until(1e-9));
        assert_eq!((white.reason, white.shots), (StopReason::Singular, 0));
        let one_black = light(&scene(0.0), elements, exact(1e-10));
        let absorbed = one_black.ledger.absorbed[0] / one_black.ledger.emitted[0];
        println!(
            "all white but one triangle, {elements} elements: {:.1} sweeps, absorbed 1 + {:.1e}",
            one_black.sweeps(),
            absorbed - 1.0
        );
        assert_eq!(one_black.reason, StopReason::Converged);
        assert!(one_black.values().all(Rgb::is_finite));
        assert!((absorbed - 1.0).abs() <= COLUMNS, "{absorbed}");
        // Nothing else absorbs, so all of it is what the black triangle takes.
        let (absorbed, unshot) = (one_black.ledger.absorbed[0], one_black.ledger.unshot[0]);
        assert!(unshot.abs() <= 1e-9 * absorbed, "{unshot:e} of {absorbed}");
    }
}

#[test]
fn rho_gt_1_or_negative() {
    // A scene holds no such surface, so no solver ever meets one.
    for rho in [1.2, -0.1, f64::NAN] {
        let material = Material {
            name: "wall 7".into(),
            reflectance: Rgb::new(0.5, rho, 0.5),
            emittance: Rgb::ZERO,
            sides: Sides::Front,
        };
        let error = SceneBuilder::new().material(material).unwrap_err();
        assert!(matches!(error.kind(), ErrorKind::Reflectance(_)), "{error}");
        assert_eq!(error.place(), "wall 7");
    }
}

#[test]
fn zero_rho() {
    let mut model = Model::new();
    let wall = model.grey(0.0, 0.0);
    let lamp = model.grey(0.0, 3.0);
    model.cube([lamp, wall, wall, wall, wall, wall]);
    let scene = model.scene();
    for elements in [12, 384] {
        let solved = light(&scene, elements, ShootingConfig::until(0.0));
        let emitting = solved.patches as u64 / 6;
        assert_eq!((solved.reason, solved.shots), (StopReason::Converged, emitting));
        for element in &solved.solution.elements {
            let emittance = scene.material_of(element.triangle).emittance;
            assert_eq!(element.exitance.0.map(f64::to_bits), emittance.0.map(f64::to_bits));
        }
        // H = F·E, and the rows of all five other faces sum to 1.
        let absorbed = solved.ledger.absorbed[0] / solved.ledger.emitted[0];
        println!("black cube, {elements} elements: {} shots, absorbed {absorbed}", solved.shots);
        assert!((absorbed - 1.0).abs() <= COLUMNS, "{absorbed}");
    }
}

/// A cube of 384 elements: `of` says which surface each of the 192 triangles has.
fn mixed(model: &mut Model, of: impl Fn(usize) -> MaterialId) {
    for axis in 0..3 {
        for far in [false, true] {
            for cell in 0..16 {
                let at = |i: usize, j: usize| {
                    let (u, v) = ((cell / 4 + i) as f64 / 4.0, (cell % 4 + j) as f64 / 4.0);
                    let mut p = [0.0; 3];
                    p[axis] = f64::from(u8::from(far));
                    p[(axis + 1) % 3] = u;
                    p[(axis + 2) % 3] = v;
                    p
                };
                let mut corners = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                if far {
                    corners.reverse();
                }
                let first = ((axis * 2 + usize::from(far)) * 16 + cell) * 2;
                let [a, b, c, d] = corners;
                model.triangle([a, b, c], of(first));
                model.triangle([a, c, d], of(first + 1));
            }
        }
    }
}

#[test]
fn mixed_reflectance() {
    // A coin per triangle: bits of multiples of the golden ratio.
    let coin = |i: usize| (i as f64 * 0.618_033_988_749_895).fract() < 0.5;
    for (name, plain_sweeps) in [("half .999, half .1", 12.5), ("one black in .999", 1915.0)] {
        let mut model = Model::new();
        let lamp = model.grey(0.999, 1.0);
        let white = model.grey(0.999, 0.0);
        let other = model.grey(if plain_sweeps < 100.0 { 0.1 } else { 0.0 }, 0.0);
        mixed(&mut model, |i| match i {
            0 => lamp,
            _ if plain_sweeps > 100.0 => {
                if i == 100 {
                    other
                } else {
                    white
                }
            }
            _ => {
                if coin(i) {
                    white
                } else {
                    other
                }
            }
        });
        let scene = model.scene();
        for correction in [Correction::Auto, Correction::Never] {
            if correction == Correction::Never && plain_sweeps > 100.0 {
                continue;
            }
            let solved =
                light(&scene, 384, ShootingConfig { correction, ..ShootingConfig::until(1e-6) });
            println!(
                "{name}, {correction:?}: {:.1} sweeps (plain on exact form factors {plain_sweeps}), unshot {:.1e}, at most {:.1e} of the emitted power missing",
                solved.sweeps(),
                solved.unshot,
                solved.remaining.power[0] / solved.ledger.emitted[0]
            );
            assert_eq!(solved.reason, StopReason::Converged);
            assert!(solved.sweeps() <= SWEEPS, "{name}: {}", solved.sweeps());
        }
    }
}

#[test]
fn cancel_after_overshoot() {
    // A shaft with a lamp at one end: the first correction gives its far end what its near end
    // has, and all of that must be taken back.
    let mut model = Model::new();
    let wall = model.grey(0.9, 0.0);
    let lamp = model.grey(0.9, 1.0);
    model.room([0.0; 3], [1.0, 1.0, 20.0], [lamp, wall, wall, wall, wall, wall].map(Some));
    // And a black wall beside a white one, where uniform light is most wrong.
    let mut other = Model::new();
    let [white, black, lamp] =
        [(0.999, 0.0), (0.0, 0.0), (0.999, 1.0)].map(|(r, e)| other.grey(r, e));
    other.cube([lamp, black, white, white, white, white]);
    for (name, model) in [("shaft", model), ("black ceiling", other)] {
        let scene = model.scene();
        for elements in [12, 384] {
            let solved = light(&scene, elements, ShootingConfig::until(1e-9));
            let most = solved.values().map(|b| b[0]).fold(0.0, f64::max);
            let least = solved.values().map(|b| b[0]).fold(f64::INFINITY, f64::min);
            println!(
                "{name}, {elements} elements: {:.1} sweeps, B from {least:.2e} to {most:.2e}",
                solved.sweeps()
            );
            assert_eq!(solved.reason, StopReason::Converged);
            assert!(least >= -1e-14 * most, "{name} {elements}: {least:e}");
        }
    }
}
