//! Pictures against ray–plane formulas.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use output::picture::{Picture, render};
use output::{ErrorKind, Exposure, Format, Options};
use scene::{Camera, Rgb, Scene, Sides, Solution};

use crate::common::{Lit, bytes, rectangle, square};

const SIDE: u32 = 100;
/// Pixels per unit of tangent at a right angle of view.
const FOCAL: f64 = 50.0;

fn camera(position: DVec3, target: DVec3, up: DVec3) -> Camera {
    Camera { name: "test".into(), position, target, up, vertical_fov: FRAC_PI_2 }
}

/// Above the middle of the rectangle, so near that it fills the picture.
fn close() -> Camera {
    camera(DVec3::new(1.0, 0.5, 0.25), DVec3::new(1.0, 0.5, 0.0), DVec3::Y)
}

fn draw(lit: &(Scene, Solution), camera: &Camera, samples: u32) -> Picture {
    render(&lit.0, &lit.1, camera, (SIDE, SIDE), samples).unwrap()
}

fn decode(bytes: &[u8]) -> (png::OutputInfo, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info, pixels)
}

#[test]
fn a_constant_exitance_has_the_bytes_of_the_formula() {
    let options = Options {
        camera: Some(close()),
        exposure: Exposure::Scale(0.5),
        size: (13, 7),
        ..Options::default()
    };
    let (info, pixels) = decode(&bytes(Format::Png, &square(Rgb::new(0.2, 0.6, 1.8)), &options));
    assert_eq!((info.width, info.height, info.color_type), (13, 7, png::ColorType::Rgb));
    // 0.1, 0.3 and 1 − 0.2/1.5 through the sRGB formula by hand: 89.04, 148.9, 239.4.
    assert_eq!(pixels, [89, 149, 239].repeat(13 * 7));
}

#[test]
fn automatic_exposure_brings_a_constant_picture_to_its_level() {
    let lit = square(Rgb::new(0.5, 4.0, 1.0));
    let picture = draw(&lit, &close(), 2);
    let expected = 0.7 / 4.0;
    assert!((picture.scale(Exposure::Auto) - expected).abs() < 1e-15);
    assert!((picture.scale(Exposure::Stops(-2.0)) - expected / 4.0).abs() < 1e-15);
    assert_eq!(picture.scale(Exposure::Scale(3.0)), 3.0);
}

#[test]
fn the_nearer_rectangle_hides_the_farther_in_either_order() {
    for near_first in [true, false] {
        let mut lit = Lit::default();
        let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
        let mut heights = [(0.1, 2.0), (0.0, 5.0)];
        if !near_first {
            heights.reverse();
        }
        for (z, light) in heights {
            lit.quad(rectangle(z), group, grey, |_| Rgb::splat(light));
        }
        let picture = draw(&lit.finish(), &close(), 1);
        assert!(picture.pixels().iter().all(|p| p.light() == Rgb::splat(2.0)), "{near_first}");
    }
}

#[test]
fn coplanar_rectangles_show_the_first() {
    let mut lit = Lit::default();
    let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
    // The same plane, cut differently, at coordinates that do not round kindly.
    let tilt = |p: DVec3| DVec3::new(p.x, p.y, 0.1 * p.x + 0.3 * p.y - 0.2);
    let [a, b, c, d] = rectangle(0.0).map(tilt);
    lit.quad([a, b, c, d], group, grey, |_| Rgb::splat(1.0));
    lit.quad([b, c, d, a], group, grey, |_| Rgb::splat(9.0));
    let picture = draw(&lit.finish(), &close(), 1);
    assert!(picture.pixels().iter().all(|p| p.light().0[0] <= 1.0 + 1e-6));
}

/// The floor |x| ≤ 0.9, −10 ≤ z ≤ 10, lit as `light` says, seen level from height 1:
/// half of it lies behind the eye.
fn floor(light: impl Fn(DVec3) -> Rgb) -> Picture {
    let mut lit = Lit::default();
    let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
    let corners = [[-0.9, 0., -10.], [-0.9, 0., 10.], [0.9, 0., 10.], [0.9, 0., -10.]];
    lit.quad(corners.map(DVec3::from_array), group, grey, light);
    draw(&lit.finish(), &camera(DVec3::Y, DVec3::new(0.0, 1.0, -1.0), DVec3::Y), 1)
}

/// Where the ray through the middle of a pixel meets the floor: x and −z.
fn meets(pixel: usize) -> Option<(f64, f64)> {
    let (column, row) = (pixel % SIDE as usize, pixel / SIDE as usize);
    let right = (column as f64 + 0.5 - FOCAL) / FOCAL;
    let down = (row as f64 + 0.5 - FOCAL) / FOCAL;
    (down > 0.0).then(|| (right / down, 1.0 / down))
}

#[test]
fn a_floor_cut_by_the_near_plane_covers_what_its_rays_meet() {
    let picture = floor(|_| Rgb::splat(1.0));
    let mut covered = 0;
    for (i, pixel) in picture.pixels().iter().enumerate() {
        let expected = meets(i).is_some_and(|(x, depth)| x.abs() <= 0.9 && depth <= 10.0);
        assert_eq!(pixel.surface.share == 1.0, expected, "pixel {i}");
        covered += u32::from(expected);
    }
    assert!(covered > 1000);
}

#[test]
fn a_gradient_is_right_in_perspective() {
    // Linear in depth; 20 at the far end keeps all corners above zero.
    let picture = floor(|p| Rgb::new(10.0 - p.z, 1.0, p.x + 5.0));
    for (i, pixel) in picture.pixels().iter().enumerate().filter(|(_, p)| p.surface.share > 0.0) {
        let (x, depth) = meets(i).unwrap();
        let [r, g, b] = pixel.surface.light.map(f64::from);
        // Only the narrowing to f32 separates them: 2⁻²⁴ of at most 20.
        assert!((r - (10.0 + depth)).abs() < 1.3e-6, "{r} {depth}");
        assert!((g - 1.0).abs() < 1e-7 && (b - (x + 5.0)).abs() < 1e-6, "{b} {x}");
    }
}

#[test]
fn samples_share_a_pixel_on_an_edge() {
    // From height 1 over the rectangle's left edge the edge runs down the middle of the
    // picture; shifted by half a pixel (1/100 of the height) it halves column 50.
    let eye = DVec3::new(-0.01, 0.5, 1.0);
    let view = camera(eye, eye - DVec3::Z, DVec3::Y);
    let picture = draw(&square(Rgb::splat(8.0)), &view, 4);
    let middle = &picture.pixels()[50 * SIDE as usize..51 * SIDE as usize];
    assert_eq!([49, 50, 51].map(|i| middle[i].surface.share), [0.0, 0.5, 1.0]);
    assert_eq!(middle[50].surface.light, [8.0; 3]);
    assert_eq!(middle[50].light(), Rgb::splat(4.0));
    // Half of 0.8 and half of the background's 0.03, in linear light, is 0.415.
    let shown = &picture.to_srgb(0.1)[3 * (50 * SIDE as usize + 50)..][..3];
    assert_eq!(shown, [output::tone::srgb_byte(0.415); 3]);
}

#[test]
fn backs_are_not_drawn_and_nothing_is_dark_grey() {
    let below = camera(DVec3::new(1.0, 0.5, -0.25), DVec3::new(1.0, 0.5, 0.0), DVec3::Y);
    let picture = draw(&square(Rgb::splat(1.0)), &below, 1);
    assert!(picture.pixels().iter().all(|p| p.surface.share == 0.0));
    // 0.03 through the sRGB formula: 48.4.
    assert_eq!(picture.to_srgb(1.0)[..3], [48, 48, 48]);
}

#[test]
fn lamps_are_kept_apart_and_not_metered() {
    let mut lit = Lit::default();
    let group = lit.builder.group("g");
    let (lamp, grey) =
        (lit.material("lamp", 500.0, Sides::Front), lit.material("grey", 0.0, Sides::Front));
    lit.quad(rectangle(0.0), group, grey, |_| Rgb::splat(2.0));
    let half = rectangle(0.01).map(|p| DVec3::new(0.5 * p.x, p.y, p.z));
    lit.quad(half, group, lamp, |_| Rgb::splat(500.0));
    let picture = draw(&lit.finish(), &close(), 2);
    let [lit, dark] = [10, 90].map(|column| picture.pixels()[50 * SIDE as usize + column]);
    assert_eq!((lit.lamp.share, lit.lamp.light, lit.surface.share), (1.0, [500.0; 3], 0.0));
    assert_eq!((dark.surface.share, dark.surface.light, dark.lamp.share), (1.0, [2.0; 3], 0.0));
    assert_eq!(picture.scale(Exposure::Auto), 0.7 / 2.0);
}

#[test]
fn a_camera_that_looks_nowhere_is_refused() {
    let (scene, solution) = square(Rgb::splat(1.0));
    let good = close();
    let bad = [
        Camera { target: good.position, ..good.clone() },
        Camera { vertical_fov: 0.0, ..good.clone() },
        Camera { vertical_fov: std::f64::consts::PI, ..good.clone() },
        Camera { position: DVec3::NAN, ..good.clone() },
    ];
    for camera in bad {
        let error = render(&scene, &solution, &camera, (4, 4), 1).unwrap_err();
        assert_eq!(error.kind(), &ErrorKind::Camera("test".into()));
    }
    // Straight down along its own up vector still shows something.
    let down = Camera { up: DVec3::Z, ..good };
    let picture = render(&scene, &solution, &down, (4, 4), 1).unwrap();
    assert_eq!(picture.pixels()[5].surface.share, 1.0);
}
