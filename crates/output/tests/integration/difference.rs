//! Pictures of two solutions and their difference, pixel by pixel.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use output::csv::{Row, rows};
use output::{ErrorKind, Exposure, Options, difference};
use scene::{Camera, Rgb, Scene, Sides};

use crate::common::{Lit, rectangle};

const SIDE: usize = 40;

/// Two rectangles side by side, and a lamp beyond them.
fn scene() -> (Scene, Vec<Row>) {
    let mut lit = Lit::default();
    let group = lit.builder.group("g");
    let grey = lit.material("grey", 0.0, Sides::Front);
    let lamp = lit.material("lamp", 5.0, Sides::Front);
    lit.quad(rectangle(0.0), group, grey, |_| Rgb::splat(2.0));
    lit.quad(rectangle(0.0).map(|p| p + DVec3::Y), group, grey, |_| Rgb::splat(2.0));
    lit.quad(rectangle(0.0).map(|p| p + DVec3::Y * 2.0), group, lamp, |_| Rgb::splat(5.0));
    let (scene, solution) = lit.finish();
    let mut rows = rows(&scene, &solution).unwrap();
    // As in a file that `solve` writes: what emits is known of the scene alone.
    rows.iter_mut().for_each(|row| row.emits = false);
    (scene, rows)
}

/// Above the middle rectangle: the lamp in the upper third of the picture.
fn options() -> Options {
    let position = DVec3::new(1.0, 1.5, 1.5);
    let (target, up) = (position - DVec3::Z, DVec3::Y);
    let camera = Camera { name: "above".into(), position, target, up, vertical_fov: FRAC_PI_2 };
    Options {
        camera: Some(camera),
        exposure: Exposure::Scale(0.2),
        size: (SIDE as u32, SIDE as u32),
        samples: 1,
        ..Options::default()
    }
}

/// A picture as its width and its pixels.
fn drawn(ours: &[Row], range: Option<f64>) -> (f64, usize, Vec<[u8; 3]>) {
    let (scene, reference) = scene();
    let mut bytes = Vec::new();
    let range = difference::write(&mut bytes, &scene, ours, &reference, &options(), range).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let pixels = pixels.as_chunks::<3>().0.to_vec();
    (range, info.width as usize, pixels)
}

/// The middle of each third, from the top: lamp, second and first rectangle; of each panel.
fn middles(width: usize, pixels: &[[u8; 3]]) -> [[[u8; 3]; 3]; 3] {
    // The title: seven dots of a pixel, and four above and below it.
    let title = 15;
    [0, 1, 2].map(|panel| {
        let column = panel * (SIDE + 4) + SIDE / 2;
        [SIDE / 6, SIDE / 2, 5 * SIDE / 6].map(|row| pixels[(title + row) * width + column])
    })
}

#[test]
fn colours_say_by_how_much_and_which_way() {
    let (_, mut ours) = scene();
    ours[0].exitance = Rgb::splat(3.0);
    ours[1].exitance = Rgb::splat(3.0);
    ours[2].exitance = Rgb::splat(1.5);
    ours[3].exitance = Rgb::splat(1.5);
    // One and a half, and three quarters, of the mean, 2.
    let (range, width, pixels) = drawn(&ours, None);
    assert_eq!((range, width), (0.5, 3 * SIDE + 2 * 4));
    let [a, b, apart] = middles(width, &pixels);
    let shown = |light: f64| [output::tone::srgb_byte(output::tone::curve(0.2 * light)); 3];
    assert_eq!(a, [shown(5.0), shown(1.5), shown(3.0)]);
    assert_eq!(b, [shown(5.0), shown(2.0), shown(2.0)]);
    // Grey for the lamp; half of the way from (221, 221, 221) to blue, (59, 76, 192); red, (180, 4, 38).
    assert_eq!(apart, [[128; 3], [140, 149, 207], [180, 4, 38]]);
    // With a range of 1, half of the way to red; with a small one, the end.
    let (_, _, pixels) = drawn(&ours, Some(1.0));
    assert_eq!(middles(width, &pixels)[2][2], [201, 113, 130]);
    let (_, _, pixels) = drawn(&ours, Some(0.01));
    assert_eq!(middles(width, &pixels)[2][1], [59, 76, 192]);
    // What is marked is left out: of the mean, too, which all of the middle then makes alone.
    ours[0].ambiguous = true;
    ours[1].emits = true;
    let (range, _, pixels) = drawn(&ours, None);
    assert_eq!((range, middles(width, &pixels)[2]), (0.5, [[128; 3], [140, 149, 207], [128; 3]]));
}

#[test]
fn no_difference_is_one_colour_and_the_legend_has_its_numbers() {
    let (_, same) = scene();
    let (range, width, pixels) = drawn(&same, None);
    assert_eq!(range, 0.01);
    let [a, b, apart] = middles(width, &pixels);
    assert_eq!(a, b);
    assert_eq!(apart[1..], [[221; 3]; 2]);
    let legend = |pixels: &[[u8; 3]]| pixels[(15 + SIDE) * width..].to_vec();
    let (_, _, other) = drawn(&same, Some(0.2));
    assert_ne!(legend(&pixels), legend(&other), "other numbers");
    // The bar runs from blue to red below the last panel.
    let bar = &legend(&pixels)[6 * width..7 * width];
    let (first, last) = (bar[width - SIDE], bar[width - 1]);
    assert!(first[2] > first[0] + 100 && last[0] > last[2] + 100, "{first:?} {last:?}");
    assert_eq!(bar[0], [255; 3]);
}

#[test]
fn rows_of_another_scene_are_refused() {
    let (scene, reference) = scene();
    let write = |ours: &[Row], reference: &[Row], range| {
        let mut bytes = Vec::new();
        let done = difference::write(&mut bytes, &scene, ours, reference, &options(), range);
        assert!(bytes.is_empty());
        done.unwrap_err().kind().clone()
    };
    let few = &reference[..4];
    assert_eq!(write(few, few, None), ErrorKind::SceneRows { rows: 4, triangles: 6 });
    let mut large = reference.clone();
    large[3].area = 2.0;
    let kind = ErrorKind::SceneArea { row: 3, reference: 2.0, scene: 1.0 };
    assert_eq!(write(&large, &large, None), kind);
    let mut turned = reference.clone();
    turned.reverse();
    assert_eq!(write(&turned, &turned, None), ErrorKind::SceneRows { rows: 6, triangles: 6 });
    assert!(matches!(write(&reference, few, None), ErrorKind::RowCount { .. }));
    assert!(matches!(write(&reference, &reference, Some(0.0)), ErrorKind::Option(_)));
}
