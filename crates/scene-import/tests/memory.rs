//! How much memory a file can make the readers take: counted, in a program of its own.
//!
//! One test, as tests beside each other would count each other's memory.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use scene_import::{Options, open_bytes};

/// What any file may take, and what each of its bytes may add: the bound that README.md states.
const FREE: usize = 64 << 20;
const PER_BYTE: usize = 2 << 10;

/// The same for a scene with textures: 1024 texels a byte, of 3 bytes each, and 8 more while a
/// picture of 16-bit RGBA is decoded.
const PER_BYTE_TEXTURED: usize = 12 << 10;

/// Counts bytes that are there, and the most that were.
struct Counting;

static THERE: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

fn add(bytes: usize) {
    let there = THERE.fetch_add(bytes, Relaxed) + bytes;
    MOST.fetch_max(there, Relaxed);
}

#[allow(unsafe_code, reason = "counting needs an allocator of its own")]
// SAFETY: every call goes on to the system's allocator with what it was given.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: as the caller has promised.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        add(layout.size());
        // SAFETY: as the caller has promised.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        THERE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as the caller has promised.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most memory that opening takes beyond what was there before.
fn peak(name: &str, bytes: &[u8]) -> (usize, String) {
    let before = THERE.load(Relaxed);
    MOST.store(before, Relaxed);
    let result = open_bytes(name, bytes, &Options::default());
    let most = MOST.load(Relaxed) - before;
    let outcome = match result {
        Ok(imported) => imported.summary.to_string(),
        Err(error) => error.to_string(),
    };
    (most, outcome)
}

#[test]
fn no_file_takes_more_than_its_size_justifies() {
    let mut worst = 0.0_f64;
    for (what, name, bytes) in files() {
        let (most, outcome) = peak(name, &bytes);
        let textured = bytes.windows(8).any(|part| part == b"\"images\"");
        let per_byte = if textured { PER_BYTE_TEXTURED } else { PER_BYTE };
        let allowed = FREE + per_byte * bytes.len();
        println!("{what}: {} bytes take {most} of {allowed}; {outcome:.120}", bytes.len());
        assert!(most <= allowed, "{what}: {} bytes take {most}: {outcome}", bytes.len());
        worst = worst.max(most as f64 / allowed as f64);
    }
    // The bound says something: something comes near it.
    assert!(worst > 0.2, "{worst}");
}

/// Files that ask for as much as they can, small ones and larger ones.
fn files() -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let mut files = vec![
        (
            ".tri records",
            "a.tri",
            "Triangle 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 ".repeat(5000).into_bytes(),
        ),
        ("one long word", "a.tri", vec![b'7'; 1 << 20]),
        ("no UTF-8", "a.vs3", vec![0xff; 1 << 20]),
        ("left out lines", "a.vs3", "X\n".repeat(100_000).into_bytes()),
        ("strips across strips", "a.vs3", strips(60).into_bytes()),
    ];
    #[cfg(feature = "obj")]
    files.extend(obj());
    #[cfg(feature = "gltf")]
    files.extend(gltf());
    files
}

/// A wall with parts that cut each other: pieces grow with the square of the parts.
fn strips(count: usize) -> String {
    let mut text = "F 3\n".to_owned();
    let mut number = 0;
    let mut vertices = |x: [usize; 2], y: [usize; 2]| {
        let mut lines = String::new();
        for (x, y) in [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])] {
            number += 1;
            lines += &format!("V {number} {x} {y} 0\n");
        }
        (lines, number - 3)
    };
    let most = 2 * count + 1;
    let mut outlines = vec![vertices([0, most], [0, most])];
    for i in 0..count {
        outlines.push(vertices([2 * i + 1, 2 * i + 2], [0, most]));
        outlines.push(vertices([0, most], [2 * i + 1, 2 * i + 2]));
    }
    outlines.iter().for_each(|(lines, _)| text += lines);
    for (i, (_, v)) in outlines.iter().enumerate() {
        let base = usize::from(i > 0);
        text += &format!("S {} {v} {} {} {} {base} 0 0.5 s{i}\n", i + 1, v + 1, v + 2, v + 3);
    }
    text
}

#[cfg(feature = "obj")]
fn obj() -> Vec<(&'static str, &'static str, Vec<u8>)> {
    let name = "n".repeat(50_000);
    let corners = "1 ".repeat(100_000);
    let faces = "f 1 1 1\n".repeat(20_000);
    let ahead = "f 2 2 2\n".repeat(20_000) + "v 0 0 0\nv 0 0 0";
    vec![
        ("a polygon of many corners", "a.obj", format!("v 0 0 0\nf {corners}").into_bytes()),
        ("many faces of a long group", "a.obj", format!("v 0 0 0\ng {name}\n{faces}").into_bytes()),
        ("faces ahead of vertices", "a.obj", ahead.into_bytes()),
        ("faces of no corner", "a.obj", "f\n".repeat(100_000).into_bytes()),
        ("words without end", "a.obj", "x ".repeat(200_000).into_bytes()),
    ]
}

#[cfg(feature = "gltf")]
fn gltf() -> Vec<(&'static str, &'static str, Vec<u8>)> {
    /// A document with these members.
    fn json(members: &str) -> Vec<u8> {
        format!(r#"{{"asset":{{"version":"2.0"}},{members}}}"#).into_bytes()
    }
    /// `count` triangles at the origin that cost no bytes, with more attributes and members.
    fn zeros(count: usize, attributes: &str, members: &str) -> Vec<u8> {
        let accessor = |kind: &str| {
            format!(
                r#"{{"componentType":5126,"count":{count},"type":"{kind}","min":[0,0,0],"max":[0,0,0],
                "sparse":{{"count":0,"indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":0}}}}}}"#
            )
        };
        json(&format!(
            r#""accessors":[{},{}],"bufferViews":[{{"buffer":0,"byteLength":1}}],
            "buffers":[{{"byteLength":1,"uri":"data:,a"}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{attributes}}},"mode":5,"material":0}}]}}],{members}"#,
            accessor("VEC3"),
            accessor("VEC2"),
        ))
    }
    let instances = |count: usize| {
        let nodes = vec![r#"{"mesh":0}"#; count].join(",");
        format!(r#""materials":[{{}}],"nodes":[{nodes}]"#)
    };
    let long = "n".repeat(50_000);
    let named = vec![r#"{"mesh":0}"#; 20_000].join(",");
    let lit = vec![r#"{"extensions":{"KHR_lights_punctual":{"light":0}}}"#; 2000].join(",");
    let points = vec![r#"{"attributes":{"POSITION":0},"mode":0}"#; 3000].join(",");
    let images = vec![r#"{"bufferView":0}"#; 20].join(",");
    let textured = |png: &[u8]| {
        let data: String = png.iter().map(|byte| format!("%{byte:02x}")).collect();
        let materials: Vec<String> = (0..20)
            .map(|i| {
                format!(r#"{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{i}}}}}}}"#)
            })
            .collect();
        let textures: Vec<String> = (0..20).map(|i| format!(r#"{{"source":{i}}}"#)).collect();
        let primitives: Vec<String> = (0..20)
            .map(|i| format!(r#"{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":{i}}}"#))
            .collect();
        json(&format!(
            r#""accessors":[{{"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0],"bufferView":1}},
            {{"componentType":5126,"count":3,"type":"VEC2","bufferView":1}}],
            "bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":1,"byteLength":36}}],
            "buffers":[{{"byteLength":{},"uri":"data:,{data}"}},{{"byteLength":36,"uri":"data:;base64,{}"}}],
            "images":[{images}],"textures":[{}],"materials":[{}],"meshes":[{{"primitives":[{}]}}],"nodes":[{{"mesh":0}}]"#,
            png.len(),
            png.len(),
            "A".repeat(48),
            textures.join(","),
            materials.join(","),
            primitives.join(","),
        ))
    };
    vec![
        ("zeros", "a.gltf", zeros(65_536, r#","TEXCOORD_0":1"#, &instances(1))),
        ("too many zeros", "a.gltf", zeros(4_000_000, "", &instances(1))),
        ("zeros shown again", "a.gltf", zeros(65_536, "", &instances(2))),
        ("a triangle shown often", "a.gltf", zeros(3, "", &instances(20_000))),
        (
            "primitives shown often",
            "a.gltf",
            json(&format!(
                r#""accessors":[{{"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0],
                "sparse":{{"count":0,"indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":0}}}}}}],
                "bufferViews":[{{"buffer":0,"byteLength":1}}],"buffers":[{{"byteLength":1,"uri":"data:,a"}}],
                "meshes":[{{"primitives":[{points}]}}],"nodes":[{named}]"#
            )),
        ),
        (
            "instances of a long name",
            "a.gltf",
            json(&format!(r#""meshes":[{{"name":"{long}","primitives":[]}}],"nodes":[{named}]"#)),
        ),
        (
            "lamps of a long name",
            "a.gltf",
            json(&format!(
                r#""extensionsUsed":["KHR_lights_punctual"],"extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"point","name":"{long}"}}]}}}},"nodes":[{lit}]"#
            )),
        ),
        (
            "materials of nothing",
            "a.gltf",
            json(&format!(r#""materials":[{}]"#, vec!["{}"; 50_000].join(","))),
        ),
        (
            "nodes of nothing",
            "a.gltf",
            json(&format!(r#""nodes":[{}]"#, vec!["{}"; 50_000].join(","))),
        ),
        (
            "deep nesting",
            "a.gltf",
            json(&format!(r#""extras":{}{}"#, "[".repeat(100_000), "]".repeat(100_000))),
        ),
        (
            "deep nesting of ours",
            "a.gltf",
            json(&format!(
                r#""materials":[{{"extras":{{"radiosity":{}{}}}}}]"#,
                "[".repeat(100_000),
                "]".repeat(100_000)
            )),
        ),
        ("a header of 60 000 × 60 000", "a.gltf", textured(&png_header(60_000, 60_000))),
        ("headers of 2100 × 2100", "a.gltf", textured(&png_header(2100, 2100))),
        ("a header of 11 500 × 11 500 in a large file", "a.gltf", {
            let mut header = png_header(11_500, 11_500);
            header.resize(50_000, 0);
            textured(&header)
        }),
        ("headers of 1000 × 1000", "a.gltf", textured(&png_header(1000, 1000))),
        ("a JPEG header of 65 500 × 65 500", "a.gltf", textured(&jpeg(65_500))),
        ("JPEG headers of 2100 × 2100", "a.gltf", textured(&jpeg(2100))),
        ("one colour, 4096 × 4096", "a.gltf", textured(&one_colour(4096))),
    ]
}

/// A PNG that ends after its header: 16-bit RGBA, the widest there is.
#[cfg(feature = "gltf")]
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = b"IHDR".to_vec();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([16, 6, 0, 0, 0]);
    let check = crc(&header);
    png.extend(13_u32.to_be_bytes());
    png.extend(&header);
    png.extend(check.to_be_bytes());
    // The start of a chunk, without which no reader begins with the picture.
    png.extend(1000_u32.to_be_bytes());
    png.extend(b"IDAT");
    png
}

/// # References
/// PNG, annex D: the checksum of a chunk, a bit at a time.
#[cfg(feature = "gltf")]
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 }
        })
    })
}

/// A JPEG of 8 × 8 texels that says it is larger.
#[cfg(feature = "gltf")]
fn jpeg(side: u16) -> Vec<u8> {
    let mut jpeg = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut jpeg);
    image::RgbImage::new(8, 8).write_with_encoder(encoder).expect("a vector takes everything");
    // Start of a baseline frame: marker, length, bits, height, width.
    let frame = jpeg.windows(2).position(|bytes| bytes == [0xff, 0xc0]).expect("it is baseline");
    jpeg[frame + 5..frame + 9].copy_from_slice(&[side.to_be_bytes(); 2].concat());
    jpeg
}

/// A whole PNG of one colour: the most texels a byte can be.
#[cfg(feature = "gltf")]
fn one_colour(side: u32) -> Vec<u8> {
    let mut png = Vec::new();
    let picture = image::GrayImage::new(side, side);
    let encoder = image::codecs::png::PngEncoder::new_with_quality(
        &mut png,
        image::codecs::png::CompressionType::Best,
        image::codecs::png::FilterType::NoFilter,
    );
    picture.write_with_encoder(encoder).expect("a vector takes everything");
    png
}
