//! OpenEXR, read back by a small decoder of its own.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;
use std::io::Read;

use flate2::read::ZlibDecoder;
use glam::DVec3;
use output::picture::render;
use output::{Exposure, Format, Options};
use scene::{Camera, Rgb, Scene, Sides, Solution};

use crate::common::{Lit, bytes, rectangle, square};

struct Exr {
    attributes: HashMap<String, (String, Vec<u8>)>,
    size: (usize, usize),
    /// Red, green, blue, alpha.
    pixels: Vec<[f32; 4]>,
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> &'a [u8] {
    let (taken, rest) = bytes.split_at(count);
    *bytes = rest;
    taken
}

fn word(bytes: &mut &[u8]) -> i32 {
    i32::from_le_bytes(take(bytes, 4).try_into().unwrap())
}

fn text(bytes: &mut &[u8]) -> String {
    let end = bytes.iter().position(|b| *b == 0).unwrap();
    let text = take(bytes, end).to_vec();
    take(bytes, 1);
    String::from_utf8(text).unwrap()
}

fn parse(file: &[u8]) -> Exr {
    let mut bytes = file;
    assert_eq!(take(&mut bytes, 8), [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]);
    let mut attributes = HashMap::new();
    loop {
        let name = text(&mut bytes);
        if name.is_empty() {
            break;
        }
        let kind = text(&mut bytes);
        let length = word(&mut bytes) as usize;
        attributes.insert(name, (kind, take(&mut bytes, length).to_vec()));
    }
    let window = &attributes["dataWindow"].1;
    let side = |at: usize| 1 + i32::from_le_bytes(window[at..at + 4].try_into().unwrap()) as usize;
    let (width, height) = (side(8), side(12));
    let mut channels = &attributes["channels"].1[..];
    for name in ["A", "B", "G", "R"] {
        assert_eq!(text(&mut channels), name);
        assert_eq!([0; 4].map(|_| word(&mut channels)), [2, 0, 1, 1]);
    }
    assert_eq!(channels, [0]);
    assert_eq!(attributes["compression"].1, [3]);
    let offsets: Vec<u64> = (0..height.div_ceil(16))
        .map(|_| u64::from_le_bytes(take(&mut bytes, 8).try_into().unwrap()))
        .collect();
    let mut pixels = Vec::new();
    for (block, offset) in offsets.into_iter().enumerate() {
        assert_eq!(offset as usize, file.len() - bytes.len());
        assert_eq!(word(&mut bytes) as usize, 16 * block);
        let length = word(&mut bytes) as usize;
        let lines = (height - 16 * block).min(16);
        let plain = inflate(take(&mut bytes, length), lines * width * 16);
        for line in plain.chunks_exact(16 * width) {
            let float = |at: usize| f32::from_le_bytes(line[at..at + 4].try_into().unwrap());
            let value = |channel: usize, x: usize| float(4 * (channel * width + x));
            pixels.extend((0..width).map(|x| [3, 2, 1, 0].map(|channel| value(channel, x))));
        }
    }
    assert!(bytes.is_empty());
    Exr { attributes, size: (width, height), pixels }
}

/// Undoes what a block went through: the order of the OpenEXR library's decoder.
fn inflate(stored: &[u8], length: usize) -> Vec<u8> {
    if stored.len() == length {
        return stored.to_vec();
    }
    let mut bytes = Vec::new();
    ZlibDecoder::new(stored).read_to_end(&mut bytes).unwrap();
    assert_eq!(bytes.len(), length);
    for i in 1..length {
        bytes[i] = bytes[i - 1].wrapping_add(bytes[i]).wrapping_sub(128);
    }
    let half = length.div_ceil(2);
    (0..length).map(|i| if i % 2 == 0 { bytes[i / 2] } else { bytes[half + i / 2] }).collect()
}

fn camera(position: DVec3) -> Camera {
    let (target, up) = (position - DVec3::Z, DVec3::Y);
    Camera { name: "test".into(), position, target, up, vertical_fov: FRAC_PI_2 }
}

fn options(position: DVec3, size: (u32, u32), samples: u32) -> Options {
    Options { camera: Some(camera(position)), size, samples, ..Options::default() }
}

#[test]
fn a_constant_exitance_is_itself_however_bright() {
    let close = DVec3::new(1.0, 0.5, 0.25);
    // Two blocks and a part of a third.
    let options = options(close, (7, 37), 2);
    for light in [Rgb::new(0.2, 0.6, 1.8), Rgb::new(1e-6, 500.0, 3e30)] {
        let exr = parse(&bytes(Format::Exr, &square(light), &options));
        assert_eq!(exr.size, (7, 37));
        let [r, g, b] = light.0.map(|c| c as f32);
        assert!(exr.pixels.iter().all(|p| *p == [r, g, b, 1.0]), "{:?}", exr.pixels[0]);
        let exposed = Options { exposure: Exposure::Stops(3.0), ..options.clone() };
        assert_eq!(parse(&bytes(Format::Exr, &square(light), &exposed)).pixels, exr.pixels);
        let (kind, comment) = &exr.attributes["comments"];
        assert_eq!((kind.as_str(), &comment[..8]), ("string", &b"exitance"[..]));
    }
}

#[test]
fn a_pixel_on_an_edge_holds_the_mean_and_its_share() {
    // As in the test of pictures: the left edge of the rectangle halves column 50.
    let options = options(DVec3::new(-0.01, 0.5, 1.0), (100, 100), 4);
    let exr = parse(&bytes(Format::Exr, &square(Rgb::splat(8.0)), &options));
    let row = &exr.pixels[50 * 100..51 * 100];
    assert_eq!([row[49], row[50], row[51]], [[0.0; 4], [4.0, 4.0, 4.0, 0.5], [8.0, 8.0, 8.0, 1.0]]);
}

/// A gradient under a lamp that covers its left half.
fn lamp_and_gradient() -> (Scene, Solution) {
    let mut lit = Lit::default();
    let group = lit.builder.group("g");
    let lamp = lit.material("lamp", 500.0, Sides::Front);
    let grey = lit.material("grey", 0.0, Sides::Front);
    lit.quad(rectangle(0.0), group, grey, |p| Rgb::new(p.x, p.y, p.x + p.y));
    let half = rectangle(0.01).map(|p| DVec3::new(0.5 * p.x, p.y, p.z));
    lit.quad(half, group, lamp, |_| Rgb::splat(500.0));
    lit.finish()
}

#[test]
fn pixels_are_those_of_the_picture_in_linear_light() {
    let lit = lamp_and_gradient();
    let options = options(DVec3::new(1.0, 0.5, 0.6), (33, 31), 3);
    let picture = render(&lit.0, &lit.1, options.camera.as_ref().unwrap(), (33, 31), 3).unwrap();
    let exr = parse(&bytes(Format::Exr, &lit, &options));
    assert_eq!(exr.pixels.len(), picture.pixels().len());
    let mut mixed = 0;
    for (read, drawn) in exr.pixels.iter().zip(picture.pixels()) {
        let [r, g, b] = drawn.light().0.map(|c| c as f32);
        assert_eq!(*read, [r, g, b, drawn.surface.share + drawn.lamp.share]);
        mixed += u32::from(drawn.surface.share > 0.0 && drawn.lamp.share > 0.0);
    }
    assert!(mixed > 0, "no pixel shows both the lamp and what it covers");
}
