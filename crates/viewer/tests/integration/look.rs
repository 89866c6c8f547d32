//! What the canvas shows: each side its own light, through the same curve as pictures, and by key and control.

use std::time::Instant;

use glam::DVec3;
use scene::Face;
use serde_json::Value;
use viewer::Page;

use crate::browser::{Browser, PATIENCE};
use crate::common::{EXPOSURE, FOV, exitance, scene, shown};

const WIDTH: u32 = 1000;
const HEIGHT: u32 = 600;
/// Rounding to bytes, of the browser and of ours.
const BYTES: i32 = 2;

fn page(folder: &tempfile::TempDir) -> std::path::PathBuf {
    let (scene, solution) = scene();
    let page = Page::new("wall", &shown(&scene, &solution), &Value::Null).unwrap();
    let path = folder.path().join("wall.html");
    page.write(&mut std::fs::File::create(&path).unwrap()).unwrap();
    path
}

/// Where a place of the wall is seen from the first camera (`side` 1) or the second (-1).
fn pixel(browser: &mut Browser, place: DVec3, side: f64) -> (usize, usize) {
    let size = browser.value("[canvas.clientWidth, canvas.clientHeight]");
    let [width, height] = [0, 1].map(|i| size[i].as_f64().unwrap());
    // Five units away; what is on the right from the front is on the left from the back.
    let focal = height / 2.0 / (FOV / 2.0).tan() / 5.0;
    ((width / 2.0 + side * focal * place.x) as usize, (height / 2.0 - focal * place.y) as usize)
}

/// By the formulas of `output::tone`, which has tests of its own.
fn colour(place: DVec3, face: Face) -> [i32; 3] {
    output::tone::screen(exitance(place, face), EXPOSURE).map(i32::from)
}

fn near(found: [u8; 3], expected: [i32; 3]) -> bool {
    (0..3).all(|c| (i32::from(found[c]) - expected[c]).abs() <= BYTES)
}

#[test]
fn each_side_shows_its_own_light() {
    let Some(mut browser) = Browser::start(WIDTH, HEIGHT) else { return };
    let folder = tempfile::tempdir().unwrap();
    browser.open(&page(&folder));
    let places = [(0.5, 0.25), (-1.2, 0.4), (1.3, -0.6), (-0.4, -0.7)];
    let picture = browser.picture();
    for (x, y) in places {
        let place = DVec3::new(x, y, 0.0);
        let (px, py) = pixel(&mut browser, place, 1.0);
        let (found, expected) = (picture.at(px, py), colour(place, Face::Front));
        assert!(near(found, expected), "front at {place}: {found:?}, expected {expected:?}");
    }
    browser.value("camera.value = 1, camera.dispatchEvent(new Event('change'))");
    let picture = browser.picture();
    for (x, y) in places {
        let place = DVec3::new(x, y, 0.0);
        let (px, py) = pixel(&mut browser, place, -1.0);
        let (found, expected) = (picture.at(px, py), colour(place, Face::Back));
        assert!(near(found, expected), "back at {place}: {found:?}, expected {expected:?}");
    }
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn controls_change_what_is_seen() {
    let Some(mut browser) = Browser::start(WIDTH, HEIGHT) else { return };
    let folder = tempfile::tempdir().unwrap();
    browser.open(&page(&folder));
    let place = DVec3::new(1.2, -0.4, 0.0);
    let (x, y) = pixel(&mut browser, place, 1.0);
    let mut shows = |script: &str, expected: [i32; 3], what: &str| {
        browser.value(script);
        let found = browser.picture().at(x, y);
        assert!(near(found, expected), "{what}: {found:?}, expected {expected:?}");
    };
    let light = exitance(place, Face::Front);
    let screen =
        |light, stops: f64| output::tone::screen(light, EXPOSURE * stops.exp2()).map(i32::from);
    let stops = "exposure.value = -1.5, exposure.dispatchEvent(new Event('input'))";
    shows(stops, screen(light, -1.5), "one and a half stops less");
    let red = "exposure.value = 0, channel.value = 'r', channel.dispatchEvent(new Event('change'))";
    shows(red, screen(scene::Rgb::splat(light.0[0]), 0.0), "red alone");
    let mean = "channel.value = 'mean', channel.dispatchEvent(new Event('change'))";
    shows(mean, screen(scene::Rgb::splat(light.sum() / 3.0), 0.0), "the mean");
    // The element (0, -1), (2, -1), (2, 1) holds the place; its middle is at (4, -1) / 3.
    let elements = "channel.value = 'rgb', channel.dispatchEvent(new Event('change')), \
                    shading.value = 'elements', shading.dispatchEvent(new Event('change'))";
    let element = exitance(DVec3::new(4.0 / 3.0, -1.0 / 3.0, 0.0), Face::Front);
    shows(elements, screen(element, 0.0), "one value per element");
    shows(
        "shading.value = 'corners', shading.dispatchEvent(new Event('change'))",
        screen(light, 0.0),
        "smooth",
    );
    // Ends of viridis: matplotlib's first and last colours, #440154 and #fde725.
    let false_colour = |low: f64, high: f64| {
        format!(
            "(on => {{ on.checked = true; on.dispatchEvent(new Event('change')); \
             low.value = {low}; high.value = {high}; low.dispatchEvent(new Event('input')) }})\
             (document.getElementById('false-colour'))"
        )
    };
    shows(&false_colour(1000.0, 2000.0), [0x44, 0x01, 0x54], "far below the range");
    shows(&false_colour(0.0, 1.0), [0xfd, 0xe7, 0x25], "far above the range");
    // The middle between colours 127 and 128 of 255, both #21918c to a byte's rounding.
    let middle = light.sum() / 3.0;
    shows(&false_colour(0.0, 2.0 * middle), [0x21, 0x91, 0x8c], "in its middle");
    assert!(browser.text("#legend-title").contains("W/m²"));
    // Each element is more than a hundredth of the area, so the range that fits ends at the
    // darkest and the brightest; it is shown in three digits.
    browser.value("document.querySelector('[value=log]').click()");
    let (_, solution) = scene();
    let means: Vec<f64> = solution.elements.iter().map(|e| e.exitance.sum() / 3.0).collect();
    let [least, most] = [f64::min, f64::max].map(|of| means.iter().copied().reduce(of).unwrap());
    for (id, expected) in [("#low", least), ("#high", most)] {
        let shown = browser.number(id);
        assert!((shown - expected).abs() <= 5e-3 * expected, "{id}: {shown}, expected {expected}");
    }
    assert!(browser.text("#legend-title").ends_with("logarithmic"));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn walking_comes_nearer() {
    let Some(mut browser) = Browser::start(WIDTH, HEIGHT) else { return };
    let folder = tempfile::tempdir().unwrap();
    browser.open(&page(&folder));
    // The background above the wall, until one stands in front of it.
    let (x, y) = pixel(&mut browser, DVec3::new(0.0, 1.2, 0.0), 1.0);
    let before = browser.picture().at(x, y);
    assert!(before.iter().all(|c| *c == before[0]), "{before:?}");
    browser.value(
        "(walk => { walk.checked = true; walk.dispatchEvent(new Event('change')) })\
         (document.querySelector('[value=walk]'))",
    );
    browser.hold("w", "KeyW", |browser| {
        let clock = Instant::now();
        loop {
            let after = browser.picture().at(x, y);
            if after[0] > after[1] {
                break; // the wall is red
            }
            assert!(clock.elapsed() < PATIENCE, "{after:?}");
        }
    });
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

/// The page fits a phone and a large screen: nothing is wider than the window.
#[test]
fn it_fits_narrow_and_wide_windows() {
    let Some(mut browser) = Browser::start(360, 740) else { return };
    let folder = tempfile::tempdir().unwrap();
    browser.open(&page(&folder));
    for (width, height) in [(360, 740), (1920, 1080)] {
        browser.size(width, height);
        browser.settle();
        let wide = browser.value("document.documentElement.scrollWidth").as_u64().unwrap();
        assert!(wide <= u64::from(width), "{wide} at {width}");
        let canvas = browser.value("canvas.clientWidth / canvas.clientHeight").as_f64().unwrap();
        assert!((0.3..4.0).contains(&canvas), "{canvas} at {width}");
    }
}

#[test]
fn every_control_has_a_name_and_is_reached_by_keys() {
    let Some(mut browser) = Browser::start(WIDTH, HEIGHT) else { return };
    let folder = tempfile::tempdir().unwrap();
    browser.open(&page(&folder));
    let nameless = browser.value(
        "[...document.querySelectorAll('input, select, button, canvas')].filter(e => \
         !(e.labels?.length || e.textContent.trim() || e.getAttribute('aria-label'))).map(e => e.outerHTML)",
    );
    assert_eq!(nameless, serde_json::json!([]));
    let mut reached = std::collections::BTreeSet::new();
    for _ in 0..20 {
        browser.hold("Tab", "Tab", |_| {});
        let focus = browser.value(
            "document.activeElement.id || document.activeElement.name || document.activeElement.tagName",
        );
        reached.insert(focus.as_str().unwrap().to_owned());
        let outline = browser.value("getComputedStyle(document.activeElement).outlineStyle");
        if focus != "BODY" {
            assert_eq!(outline, "solid", "{focus}");
        }
    }
    for id in
        ["canvas", "mode", "camera", "exposure", "channel", "shading", "wireframe", "false-colour"]
    {
        assert!(reached.contains(id), "{id}: {reached:?}");
    }
}
