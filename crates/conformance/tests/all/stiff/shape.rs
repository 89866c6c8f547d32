//! Places, units, and triangles that are lines, copies or posters.

use glam::DVec3;
use radiosity_core::{ShootingConfig, StopReason};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides, TriangleId};

use super::model::{Model, light, moved};
use crate::BALANCED;

/// A box with a screen in it, no two of its measures alike, and a lamp on its ceiling.
fn screened() -> Scene {
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    let lamp = model.grey(0.3, 1.0);
    let screen = model.surface(Rgb::splat(0.4), Rgb::ZERO, Sides::Both);
    model.room([0.0; 3], [1.0, 1.375, 0.8125], [wall, lamp, wall, wall, wall, wall].map(Some));
    model.triangle([[0.25, 0.375, 0.125], [0.75, 0.5, 0.25], [0.5, 1.125, 0.5]], screen);
    model.scene()
}

/// Form factors without estimators to choose from, and cells as fine as the mesh: the light is a
/// continuous function of the coordinates, but for rays.
fn smooth() -> ShootingConfig {
    ShootingConfig { tolerance: 0.0, cell_share: 0.0, ..ShootingConfig::until(1e-13) }
}

/// What rounding may change in the light of the same mesh, E1 of the means of the triangles: which
/// of two estimators of 1 % serves a pair at the limit between them, and which of two shadow rays
/// grazes an edge. Vertices rounded to 1e-10 of the scene have more such pairs than exact ones.
const CHOICES: f64 = 1e-6;
const CHOICES_OF_ROUNDED: f64 = 2e-3;

/// What a mesh of fewer elements changes, where a sheet that stays dark has its share of them: the
/// largest of the means of the triangles.
const OTHER_MESH: f64 = 1e-2;

#[test]
fn offset_1e6() {
    let shift = 1_048_576.0;
    for elements in [0, 100] {
        // A power of two keeps these vertices exact; what is left is rounding of 1e-10 in the
        // middles of patches.
        let apart = |config| {
            let far = light(&moved(&screened(), |p| p + shift), elements, config);
            light(&screened(), elements, config).apart(&far)
        };
        let (smooth, usual) = (apart(smooth()), apart(ShootingConfig::until(1e-10)));
        println!("2^20 away, {elements} elements: {smooth:.1e}, by default {usual:.1e}");
        assert!(usual <= 1e-8, "{usual:e}");
        // Form factors that are off by 1e-9 make light that is off by up to 1e-9 / (1 − ρ), and
        // so does each element's share of the visible.
        assert!(smooth <= 1e-8, "{smooth:e}");
    }
    // On the triangles themselves the light is that at the origin, to the catalogue's figure.
    let apart = light(&screened(), 0, smooth()).apart(&light(
        &moved(&screened(), |p| p + shift),
        0,
        smooth(),
    ));
    assert!(apart <= 1e-9, "{apart:e}");
    // These are rounded when they are moved; what they are then is what is solved. Brought
    // back, a subtraction without rounding, they are at the origin.
    let odd = moved(&screened(), |p| (p * 0.9137 + 0.1234) + 1e6);
    let back = moved(&odd, |p| p - 1e6);
    let apart = light(&back, 0, smooth()).apart(&light(&odd, 0, smooth()));
    println!("1e6 away: {apart:.1e}");
    assert!(apart <= 1e-9, "{apart:e}");
    let usual = ShootingConfig::until(1e-10);
    let e1 = light(&back, 100, usual).e1(&light(&odd, 100, usual), &back);
    println!("1e6 away, 100 elements: E1 {e1:.1e}");
    assert!(e1 <= CHOICES_OF_ROUNDED, "{e1:e}");
}

#[test]
fn unit_scale() {
    let light_in = |unit: f64, elements: usize, config: ShootingConfig| {
        light(&moved(&screened(), |p| p * unit), elements, config)
    };
    let usual = ShootingConfig::until(1e-10);
    let [whole, split] = [(0, smooth()), (300, usual)].map(|(n, c)| light_in(1.0, n, c));
    for unit in [1e-6, 1e6] {
        let apart = whole.apart(&light_in(unit, 0, smooth()));
        let e1 = split.e1(&light_in(unit, 300, usual), &screened());
        println!("times {unit:e}: {apart:.1e}; 300 elements: E1 {e1:.1e}");
        assert!(apart <= 1e-13 && e1 <= CHOICES, "{apart:e} {e1:e}");
    }
    // Powers of two scale every number exactly.
    for unit in [2f64.powi(-20), 2f64.powi(20), 2f64.powi(-130), 2f64.powi(130)] {
        assert!(split.bits() == light_in(unit, 300, usual).bits(), "{unit:e}");
    }
    for unit in [1e-60, 1e60] {
        let apart = whole.apart(&light_in(unit, 0, smooth()));
        println!("times {unit:e}: {apart:.1e}");
        assert!(apart <= 1e-10, "{apart:e}");
    }
}

/// Beyond 1e±77 squares of areas leave the range of f64, and scenes are refused or empty.
#[test]
fn a_unit_at_the_ends_of_the_numbers() {
    // Fourth powers of distances stay finite between 1e-75 and 1e75: the light is the same.
    let whole = light(&screened(), 0, smooth());
    for unit in [1e-70, 1e70] {
        let scaled = light(&moved(&screened(), |p| p * unit), 0, smooth());
        assert_eq!(scaled.reason, StopReason::Converged, "{unit:e}");
        assert!(whole.apart(&scaled) <= 1e-10, "{unit:e}");
    }
    // Below, there are no surfaces left; above, the scene is refused. (A form factor alone is
    // right at any unit: see `unit_scale` of the form factors.)
    for unit in [1e-80, 1e-110] {
        let scaled = light(&moved(&screened(), |p| p * unit), 0, smooth());
        assert_eq!(scaled.reason, StopReason::NoLight, "{unit:e}");
        assert!(scaled.triangles.iter().all(|b| b.is_finite()), "{unit:e}");
    }
    for unit in [1e80, 1e110] {
        let mut builder = SceneBuilder::new();
        let group = builder.group("far");
        let material = builder.material(Material {
            name: "grey".into(),
            reflectance: Rgb::splat(0.5),
            emittance: Rgb::ZERO,
            sides: Sides::Front,
        });
        let v = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| builder.vertex(p * unit));
        let refused = builder.triangle(v, material.unwrap(), group).unwrap_err();
        assert!(refused.to_string().contains("use a larger unit of length"), "{refused}");
    }
}

#[test]
fn zero_area() {
    // Rays count, so that the length by which they keep off surfaces shows.
    let scene = |first: &[[[f64; 3]; 3]], last: &[[[f64; 3]; 3]]| {
        let mut model = Model::new();
        let lamp = model.grey(0.5, 1.0);
        let wall = model.grey(0.5, 0.0);
        first.iter().for_each(|t| model.triangle(*t, lamp));
        model.cube([lamp, wall, wall, wall, wall, wall]);
        model.level([0.2, 0.7], [0.1, 0.6], 0.3, true, wall);
        model.level([0.2, 0.7], [0.1, 0.6], 0.3, false, wall);
        last.iter().for_each(|t| model.triangle(*t, lamp));
        model.scene()
    };
    let inside = [[0.25, 0.25, 0.5], [0.5, 0.25, 0.5], [0.75, 0.25, 0.5]];
    let line = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.]];
    let far = [[0., 0., 0.], [1e4, 0., 0.], [2e4, 0., 0.]];
    let point = [[0.5, 0.5, 0.5]; 3];
    for elements in [0, 300] {
        let config = ShootingConfig::until(1e-4);
        let without = light(&scene(&[], &[]), elements, config).bits();
        for (first, last) in [
            (&[line][..], &[][..]),
            (&[], &[line]),
            (&[point], &[inside]),
            (&[], &[point, line]),
            (&[], &[far]),
        ] {
            let with = light(&scene(first, last), elements, config);
            assert!(with.bits() == without, "{first:?} {last:?}, {elements} elements");
        }
    }
}

/// A lit cube, and copies of some of its triangles.
fn with_copies(copies: &[u32], reversed: bool) -> Scene {
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    let lamp = model.grey(0.5, 1.0);
    model.cube([wall, lamp, wall, wall, wall, wall]);
    let mut plain = Model::new();
    let any = plain.grey(0.5, 0.0);
    plain.cube([any; 6]);
    let plain = plain.scene();
    for &copy in copies {
        let [a, b, c] = plain.corners(TriangleId(copy)).map(|p| p.to_array());
        // A copy that starts at another corner is one as well.
        model.triangle(if reversed { [a, c, b] } else { [b, c, a] }, wall);
    }
    model.scene()
}

#[test]
fn coincident_duplicates() {
    let low = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    // A pair alone: nothing passes between the two.
    for other in [low, [low[1], low[2], low[0]], [low[0], low[2], low[1]]] {
        for elements in [2, 64] {
            let mut model = Model::new();
            let lamp = model.grey(0.9, 1.0);
            model.triangle(low, lamp);
            model.triangle(other, lamp);
            let solved = light(&model.scene(), elements, ShootingConfig::until(1e-6));
            assert!(solved.values().all(|b| b == Rgb::splat(1.0)), "{other:?}");
        }
    }
    for elements in [12, 300] {
        let config = ShootingConfig::until(1e-4);
        let without = light(&with_copies(&[], false), elements, config);
        // In a room, a copy changes nothing.
        let with = light(&with_copies(&[0, 5], false), elements, config);
        assert!(with.bits() == without.bits(), "{elements} elements");
        // A sheet back to back with a wall is dark, and takes nothing from the room.
        let backed = light(&with_copies(&[0, 5], true), elements, config);
        let mut sheets = backed.solution.elements.iter().filter(|e| e.triangle.0 >= 12).peekable();
        assert!(sheets.peek().is_some() && sheets.all(|e| e.exitance == Rgb::ZERO));
        let pairs = backed.triangles[..12].iter().zip(&without.triangles);
        let far = pairs.map(|(a, b)| (a[0] / b[0] - 1.0).abs()).fold(0.0, f64::max);
        println!("{elements} elements: walls with a sheet behind them are off by {far:.1e}");
        assert!(far <= OTHER_MESH && backed.ledger.wrong_side == Rgb::ZERO);
    }
}

/// A poster in or above the floor of a cube: what is absorbed of what is emitted.
fn poster(height: f64, elements: usize) -> f64 {
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    let lamp = model.grey(0.5, 1.0);
    let poster = model.grey(0.2, 0.0);
    model.cube([wall, lamp, wall, wall, wall, wall]);
    model.level([0.25, 0.75], [0.25, 0.75], height, true, poster);
    let solved = light(&model.scene(), elements, ShootingConfig::until(1e-6));
    let ledger = solved.ledger;
    println!(
        "poster {height:e} above the floor, {elements} elements: absorbed {:.4}, escaped {:.4}",
        ledger.share(ledger.absorbed),
        ledger.share(ledger.escaped)
    );
    assert!(ledger.imbalance() <= BALANCED && solved.reason == StopReason::Converged);
    ledger.share(ledger.absorbed)
}

/// The rule (docs/design.md): of surfaces that overlap in one plane and face the same way, the
/// first in the file takes part, and what it covers of the others does not.
#[test]
fn coplanar_overlap() {
    for height in [0.0, 1e-6] {
        for elements in [0, 400, 1600] {
            let absorbed = poster(height, elements);
            assert!((absorbed - 1.0).abs() <= 1e-2, "{height:e}, {elements} elements: {absorbed}");
        }
    }
}

/// Above the solver's resolution the floor below is dark; what its elements at the rim cannot
/// tell falls with the mesh.
#[test]
fn a_poster_above_the_resolution_covers_the_floor() {
    for height in [1e-4, 1e-3] {
        let [coarse, fine] = [400, 1600].map(|elements| (poster(height, elements) - 1.0).abs());
        assert!(fine < coarse / 1.5 && fine <= 2e-2, "{coarse} {fine}");
    }
}
