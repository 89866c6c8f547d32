//! The numbers in the case files against the formulas they name.

use std::f64::consts::PI;

use conformance::case::{Law, OTHERS};
use conformance::{Case, Geometry};

/// Digits of the numbers in the files.
const PRINTED: f64 = 1e-14;

#[test]
fn expected_numbers_follow_from_the_law() {
    for id in Case::ids() {
        let case = Case::load(id).unwrap();
        assert_eq!(case.id, id);
        assert!(!case.source.is_empty() && !case.bound.is_empty(), "{id}");
        let mut groups = 0;
        for (group, _) in case.geometry.groups().unwrap() {
            let expected = case.expected.iter().find(|e| e.group == group || e.group == OTHERS);
            let expected = expected.unwrap_or_else(|| panic!("{id} says nothing of {group}"));
            for channel in 0..3 {
                let exact = law(&case, group, channel);
                let stated = expected.exitance[channel];
                assert!((stated - exact).abs() <= PRINTED * exact, "{id} {group} {stated} {exact}");
                groups += 1;
            }
        }
        assert!(groups > 0, "{id}");
    }
}

/// The exitance that a case's law gives a group.
fn law(case: &Case, group: &str, channel: usize) -> f64 {
    let surface = |name: &str| {
        let s = case.surface(name).unwrap();
        (s.reflectance[channel], s.emittance[channel])
    };
    let (rho, e) = surface(group);
    match (case.law, &case.geometry) {
        (Law::WhiteFurnace, _) => {
            assert_eq!(case.surfaces.len(), 1, "{}: every surface alike", case.id);
            e / (1.0 - rho)
        }
        (Law::GeneralFurnace, _) => {
            assert!((e - (1.0 - rho)).abs() < PRINTED, "{}: E = 1 − ρ", case.id);
            1.0
        }
        (Law::TwoPlates, Geometry::TwoPlates { side, gap }) => {
            let (lamp_rho, lamp) = surface("lower");
            assert_eq!(lamp_rho, 0.0, "{}: the lamp is black", case.id);
            e + rho * opposed_squares(side / gap) * if group == "upper" { lamp } else { 0.0 }
        }
        (Law::ConcentricSpheres, Geometry::ConcentricSpheres { inner, outer, .. }) => {
            let ((rho1, e1), (rho2, e2)) = (surface("inner"), surface("outer"));
            // Repeated substitution, so that the solved form in the file has a second witness.
            let f21 = (inner / outer).powi(2);
            let (mut b1, mut b2) = (0.0, 0.0);
            for _ in 0..1000 {
                (b1, b2) = (e1 + rho1 * b2, e2 + rho2 * (f21 * b1 + (1.0 - f21) * b2));
            }
            if group == "inner" { b1 } else { b2 }
        }
        (Law::IntegratingSphere, Geometry::IntegratingSphere { port_faces, .. }) => {
            assert_eq!(surface("port"), (0.0, 0.0), "{}: the port is black", case.id);
            let f = *port_faces as f64 / 20.0;
            if group == "port" { 0.0 } else { e / (1.0 - rho * (1.0 - f)) }
        }
        (Law::EmittanceAlone, _) => {
            let dark = case.surfaces.values().all(|s| s.emittance == [0.0; 3]);
            assert!(rho == 0.0 || dark, "{}: nothing reflects or nothing emits", case.id);
            e
        }
        (law, geometry) => panic!("{}: {law:?} says nothing of {geometry:?}", case.id),
    }
}

/// Form factor between opposed squares, x = side over distance (Howell, catalogue, C-11 with
/// X = Y).
fn opposed_squares(x: f64) -> f64 {
    let root = (1.0 + x * x).sqrt();
    let log = (root * root / (1.0 + 2.0 * x * x).sqrt()).ln();
    2.0 / (PI * x * x) * (log + 2.0 * x * root * (x / root).atan() - 2.0 * x * x.atan())
}
