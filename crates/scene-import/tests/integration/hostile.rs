//! Damaged and malicious glTF files: an error, never a panic or a full memory.

use scene_import::{ErrorKind, Options, open_bytes};

use crate::glb::{Glb, TRIANGLE, pack};
use crate::{failure, import};

/// A file that uses most of what the reader knows.
fn rich() -> Vec<u8> {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    glb.indices(&[0, 1, 2]);
    let png = glb.png(2, &[[255; 3], [0; 3], [0; 3], [255; 3]]);
    glb.build(&format!(
        r#""images":[{{"bufferView":{png},"mimeType":"image/png"}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}},
        {{"extras":{{"radiosity":{{"reflectance":[0,0,1],"emittance":[0,9,0],"sides":"both"}}}}}}],
        "cameras":[{{"type":"perspective","perspective":{{"yfov":1,"znear":1}},
        "extras":{{"radiosity":{{"yfov":1,"targetDistance":5}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0}},
        {{"attributes":{{"POSITION":0}},"material":1,"extras":{{"radiosity":{{"face":"back"}}}}}}]}}],
        "nodes":[{{"mesh":0,"children":[1]}},
        {{"camera":0,"translation":[1,2,3],"extras":{{"radiosity":{{"translation":[1,2,3]}}}}}}],"scenes":[{{"nodes":[0]}}],"scene":0"#
    ))
}

#[test]
fn truncated_files_are_errors() {
    let whole = rich();
    assert_eq!(import("a.glb", &whole).scene.triangles().len(), 1);
    for end in (0..whole.len()).step_by(16) {
        failure("a.glb", &whole[..end]);
    }
}

#[test]
fn damaged_bytes_never_panic() {
    let whole = rich();
    for position in 0..whole.len() {
        for damage in [0x00, 0x01, 0x20, 0x39, 0x7f, 0xff] {
            let mut bytes = whole.clone();
            bytes[position] = damage;
            // Either way is fine: many damaged files are still files.
            let _ = open_bytes("a.glb", &bytes, &Options::default());
        }
    }
}

#[test]
fn damaged_numbers_in_the_json_never_panic() {
    let whole = rich();
    let length = u32::from_le_bytes(whole[12..16].try_into().unwrap()) as usize;
    let json = std::str::from_utf8(&whole[20..20 + length]).unwrap();
    let bin = &whole[28 + length..];
    let mut tried = 0;
    for (at, _) in json.match_indices(|c: char| c.is_ascii_digit()) {
        for number in
            ["-1", "7", "5120", "5125", "4294967295", "18446744073709551615", "1e300", "null"]
        {
            let damaged = format!("{}{number}{}", &json[..at], &json[at + 1..]);
            let _ = open_bytes("a.glb", &pack(&damaged, bin), &Options::default());
            tried += 1;
        }
    }
    assert!(tried > 500, "{tried}");
}

#[test]
fn nodes_that_are_no_tree_are_refused() {
    for nodes in [
        r#"{"children":[1]},{"children":[0]}"#,
        r#"{"children":[0]}"#,
        r#"{"children":[1,1]},{"children":[2,2]},{}"#,
    ] {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{nodes}],"scenes":[{{"nodes":[0]}}]}}"#
        );
        assert!(failure("a.gltf", json).ends_with("expected at most one parent for each node"));
    }
}

#[test]
fn a_long_chain_of_nodes_is_walked() {
    let chain: Vec<_> = (1..200_000).map(|child| format!(r#"{{"children":[{child}]}}"#)).collect();
    let json = format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{},{{}}]}}"#, chain.join(","));
    assert_eq!(import("a.gltf", json).scene.triangles(), []);
}

#[test]
fn instances_cannot_fill_the_memory() {
    // 500 triangles in a strip, shown 20 000 times by 11 bytes each.
    let mut glb = Glb::default();
    glb.floats(&vec![[0.0; 3]; 502]);
    let nodes = vec![r#"{"mesh":0}"#; 20_000].join(",");
    let file = glb.build(&format!(
        r#""meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":5}}]}}],"nodes":[{nodes}]"#
    ));
    let error = open_bytes("a.glb", &file, &Options::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::TooLarge);
    assert!(
        error
            .to_string()
            .contains("expected a number of triangles that the file's size can justify")
    );
}

#[test]
fn zeros_without_a_buffer_cannot_fill_the_memory() {
    for count in ["18446744073709551615", "100000000", "5000000", "0"] {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"accessors":[{{"componentType":5126,"count":{count},"type":"VEC3","min":[0,0,0],"max":[0,0,0],
            "sparse":{{"count":0,"indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":0}}}}}}],
            "bufferViews":[{{"buffer":0,"byteLength":1}}],"buffers":[{{"byteLength":1,"uri":"data:,a"}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{{"mesh":0}}]}}"#
        );
        let result = open_bytes("a.gltf", json.as_bytes(), &Options::default());
        assert_eq!(result.is_ok(), count == "0", "{count}");
    }
}

#[test]
fn an_accessor_that_leaves_its_buffer_is_refused() {
    let mut glb = Glb::default();
    let view = glb.view(&[0; 40]);
    for fields in [
        r#""count":4,"byteOffset":0"#,
        r#""count":3,"byteOffset":8"#,
        r#""count":3,"byteOffset":18446744073709551615"#,
        r#""count":1537228672809129302,"byteOffset":0"#,
    ] {
        let mut glb = Glb::default();
        glb.view(&[0; 40]);
        glb.accessor(&format!(r#""bufferView":{view},"componentType":5126,"type":"VEC3","min":[0,0,0],"max":[0,0,0],{fields}"#));
        failure(
            "a.glb",
            glb.build(
                r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]"#,
            ),
        );
    }
}

#[test]
fn a_small_png_of_a_huge_picture_is_left_out() {
    // A header alone: 60 000 × 60 000 texels of RGB, in 57 bytes.
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    png.extend([0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60, 8, 2, 0, 0, 0]);
    png.extend(0x5fd5_57e2_u32.to_be_bytes());
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.floats(&[[0.0; 2]; 3]);
    let view = glb.view(&png);
    let imported = import("a.glb", glb.build(&format!(
        r#""images":[{{"bufferView":{view}}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
    )));
    assert!(imported.diagnostics.iter().any(|d| d.to_string().contains("texture")));
}

#[test]
fn transforms_without_a_rotation_or_an_extent_are_read() {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    let imported = import("a.glb", glb.build(
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],
        "nodes":[{"mesh":0,"rotation":[0,0,0,0]},{"mesh":0,"scale":[0,0,0]},{"camera":0,"scale":[0,0,0]}]"#,
    ));
    assert_eq!(imported.scene.triangles().len(), 2);
    assert!(imported.scene.cameras().is_empty());
}
