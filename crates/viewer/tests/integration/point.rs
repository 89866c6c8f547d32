//! A clicked point says what is known of it, and the page talks to nobody.

use glam::DVec3;
use scene::Face;
use serde_json::Value;
use viewer::{Page, Shown};

use crate::browser::Browser;
use crate::common::{EMITTANCE, FOV, ORIGIN, REFLECTANCE, exitance, scene, shown};

/// Single precision, on the way from place to light.
const SINGLE: f64 = 2e-6;

#[test]
fn a_click_tells_the_light_of_the_point_under_it() {
    let Some(mut browser) = Browser::start(1000, 600) else { return };
    let (scene, solution) = scene();
    let folder = tempfile::tempdir().unwrap();
    for (camera, face, side) in [(0, Face::Front, 1.0), (1, Face::Back, -1.0)] {
        let shown = Shown { view: Some(&scene.cameras()[camera]), ..shown(&scene, &solution) };
        let page = Page::new("wall", &shown, &Value::Null).unwrap();
        let path = folder.path().join("wall.html");
        page.write(&mut std::fs::File::create(&path).unwrap()).unwrap();
        browser.open(&path);
        let size = browser.value("[canvas.clientWidth, canvas.clientHeight]");
        let [width, height] = [0, 1].map(|i| size[i].as_f64().unwrap());
        for (x, y) in [(310.0, 250.0), (200.0, 380.0), (430.0, 220.0)] {
            browser.click(x, y);
            // The ray through the pixel meets z = 0 five units away.
            let unit = 5.0 * (FOV / 2.0).tan() / (height / 2.0);
            let place = DVec3::new(side * (x - width / 2.0) * unit, (height / 2.0 - y) * unit, 0.0);
            let light = exitance(place, face);
            for (c, name) in ["r", "g", "b"].into_iter().enumerate() {
                let selector = |of: &str| format!("[data-of={of}][data-channel={name}]");
                let here = browser.number(&selector("exitance-here"));
                let expected = light.0[c];
                assert!(
                    (here - expected).abs() <= SINGLE * 80.0,
                    "{face:?} {name}: {here}, {expected}"
                );
                if REFLECTANCE.0[c] > 0.0 {
                    let irradiance = browser.number(&selector("irradiance-here"));
                    let expected = (expected - EMITTANCE.0[c]) / REFLECTANCE.0[c];
                    assert!(
                        (irradiance - expected).abs() <= SINGLE * 400.0,
                        "{irradiance}, {expected}"
                    );
                } else {
                    assert_eq!(browser.text(&selector("irradiance-here")), "–");
                }
                assert_eq!(browser.number(&selector("reflectance")), REFLECTANCE.0[c]);
                assert_eq!(browser.number(&selector("emittance")), EMITTANCE.0[c]);
            }
            let element: usize = browser.text("[data-of=element]").parse().unwrap();
            let of = &solution.elements[element];
            assert_eq!(of.face, face);
            let mean = browser.number("[data-of=exitance-mean][data-channel=r]");
            assert!((mean - of.exitance.0[0]).abs() <= SINGLE * 80.0);
            let area = browser.text("[data-of=area]");
            let expected = solution.area(of);
            let area: f64 = area.split(' ').next().unwrap().parse().unwrap();
            assert!((area - expected).abs() <= 1e-5 * expected, "{area}, {expected}");
            for axis in 0..3 {
                let shown = browser.value(&format!("Number(point.dataset.place{axis})"));
                let apart = shown.as_f64().unwrap() - (ORIGIN + place)[axis];
                // Doubles at 4e6 are 1e-9 apart.
                assert!(apart.abs() < 1e-5, "{axis}: {apart}");
            }
            // Names are shown as they are, and are no markup.
            assert_eq!(browser.text("[data-of=group]"), "wall </script><b>&amp;");
            assert_eq!(browser.text("[data-of=material]"), "paint <!--");
        }
        browser.click(10.0, 10.0);
        assert!(browser.text("#point").starts_with("No surface"));
        let asked = browser.requests();
        let foreign: Vec<_> = asked.iter().filter(|a| !a.starts_with("data:")).collect();
        assert_eq!(foreign, [&format!("file://{}", path.display())]);
        assert_eq!(browser.complaints(), Vec::<String>::new());
    }
}
