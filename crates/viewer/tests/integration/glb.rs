//! A lit .glb comes back with its light, and a broken one with a message.

use glam::DVec3;
use scene::Face;
use viewer::read_glb;

use crate::common::{EMITTANCE, ORIGIN, REFLECTANCE, exitance, scene};

fn glb() -> Vec<u8> {
    let (scene, solution) = scene();
    let options = output::Options { exposure: output::Exposure::Scale(0.5), ..Default::default() };
    let mut bytes = Vec::new();
    output::write(output::Format::Glb, &mut bytes, &scene, &solution, &options).unwrap();
    bytes
}

#[test]
fn the_light_of_a_file_comes_back() {
    let (scene, solution) = scene();
    let lit = read_glb(&glb()).unwrap();
    assert_eq!(lit.exposure, 0.5);
    assert_eq!(lit.scene.cameras().len(), 2);
    for (read, written) in lit.scene.cameras().iter().zip(scene.cameras()) {
        assert_eq!((&read.name, read.vertical_fov), (&written.name, written.vertical_fov));
        // Doubles at 4e6 are 1e-9 apart.
        assert!((read.target - written.target).length() < 1e-8, "{read:?}");
        assert!((read.position - written.position).length() < 1e-8, "{read:?}");
    }
    assert_eq!(lit.solution.elements.len(), solution.elements.len());
    assert_eq!(lit.scene.groups(), scene.groups());
    let backs = lit.solution.elements.iter().filter(|e| e.face == Face::Back).count();
    assert_eq!(backs, 2);
    for element in &lit.solution.elements {
        let material = lit.scene.material_of(element.triangle);
        assert_eq!((material.reflectance, material.emittance), (REFLECTANCE, EMITTANCE));
        let mut middle = DVec3::ZERO;
        for (place, light) in lit.solution.corners(element).iter().zip(element.corner_exitance) {
            let place = *place - ORIGIN;
            middle += place / 3.0;
            let expected = exitance(place, element.face);
            for c in 0..3 {
                // Single precision.
                assert!((light.0[c] - expected.0[c]).abs() <= 1e-6 * expected.0[c], "{light:?}");
            }
        }
        // The mean of corners is the value in the middle, as exitance is linear here.
        let expected = exitance(middle, element.face);
        assert!((element.exitance.0[0] - expected.0[0]).abs() <= 1e-6 * expected.0[0]);
    }
}

#[test]
fn a_file_cut_short_at_every_byte_is_refused() {
    let bytes = glb();
    for end in 0..bytes.len() {
        assert!(read_glb(&bytes[..end]).is_err(), "{end}");
    }
}

/// Any byte may be wrong: there is an answer, whatever it is.
#[test]
fn no_byte_makes_it_panic() {
    let bytes = glb();
    for at in 0..bytes.len() {
        for other in [0, 0x7f, 0xff, b'9', b'"'] {
            let mut broken = bytes.clone();
            broken[at] = other;
            let _ = read_glb(&broken);
        }
    }
}

#[test]
fn what_was_not_lit_is_refused() {
    let text = String::from_utf8_lossy(&glb()).into_owned();
    let start = text.find("_RADIOSITY").unwrap();
    let mut bytes = glb();
    // The text before it is the same in bytes.
    let at = bytes.windows(10).position(|w| w == b"_RADIOSITY").unwrap();
    assert!(at <= start);
    while let Some(at) = bytes.windows(10).position(|w| w == b"_RADIOSITY") {
        bytes[at..at + 10].copy_from_slice(b"_SOMETHING");
    }
    let message = read_glb(&bytes).unwrap_err().to_string();
    assert_eq!(
        message,
        "meshes[0].primitives[0] has no _RADIOSITY: expected a .glb that `radiosity solve` wrote"
    );
    let message = read_glb(b"Triangle\n1 2 3 4 5 6").unwrap_err().to_string();
    assert_eq!(message, "expected a GLB, version 2, which begins with glTF");
}
