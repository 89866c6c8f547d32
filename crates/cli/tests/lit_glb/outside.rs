//! What other programs make of the lit file: the Khronos validator, three.js and Blender.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::file::Glb;
use crate::model;

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/lit_glb/outside")
}

/// The npm packages, where somebody has installed them.
fn modules() -> Option<PathBuf> {
    let modules = here().join("node_modules");
    modules.is_dir().then_some(modules)
}

fn lit(folder: &Path) -> PathBuf {
    let scene = model::write(folder);
    let [glb, _] = model::solve(&scene, folder, &["--elements", "2000"]);
    glb
}

/// What a command prints, if it is there and does not fail.
fn printed(command: &mut Command) -> Option<String> {
    let done = command.output().ok()?;
    done.status.success().then(|| String::from_utf8_lossy(&done.stdout).into_owned())
}

#[test]
fn the_khronos_validator_finds_no_error() {
    if modules().is_none() {
        return println!("skipped: gltf-validator is not installed");
    }
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let cornell = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cornell.glb");
    let [bundled, _] = model::solve(&cornell, folders[1].path(), &["--elements", "500"]);
    for file in [lit(folders[0].path()), bundled] {
        let mut node = Command::new("node");
        let said = printed(node.arg(here().join("validate.mjs")).arg(file));
        let Some(said) = said else { return println!("skipped: node does not run") };
        let issues: Value = serde_json::from_str(&said).unwrap();
        assert_eq!(issues["numErrors"], 0, "{said}");
    }
}

#[test]
fn three_js_draws_the_light() {
    let Some(modules) = modules() else { return println!("skipped: three is not installed") };
    let folder = tempfile::tempdir().unwrap();
    let glb = std::fs::read(lit(folder.path())).unwrap();
    let page = std::fs::read_to_string(here().join("three.html")).unwrap();
    let page = page.replace("BASE64", &base64(&glb));
    let page = page.replace("MODULES", &format!("file://{}", modules.display()));
    let path = folder.path().join("three.html");
    std::fs::write(&path, page).unwrap();
    let mut chromium = Command::new("chromium");
    chromium.args([
        "--headless=new",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--allow-file-access-from-files",
        "--virtual-time-budget=60000",
        "--dump-dom",
    ]);
    let Some(dom) = printed(chromium.arg(&path)) else {
        return println!("skipped: chromium does not run");
    };
    let text = dom.split_once("<pre id=\"out\">").unwrap().1.split_once("</pre>").unwrap().0;
    let found: Value = serde_json::from_str(text).unwrap();
    let samples = found["samples"].as_array().expect(text);
    assert!(samples.len() > 80, "{}", samples.len());
    let number = |value: &Value, k: usize| value[k].as_f64().unwrap();
    let near = |sample: &&Value| {
        // Pixels on an edge may show its other side; one step of 255 is rounding.
        (0..3).all(|k| (number(&sample["expected"], k) - number(&sample["pixel"], k)).abs() < 1.5)
    };
    let wrong: Vec<&Value> = samples.iter().filter(|sample| !near(sample)).collect();
    assert!(wrong.len() * 30 <= samples.len(), "{wrong:#?}");
    assert!(samples.iter().any(|sample| number(&sample["pixel"], 0) > 100.0));
    let meshes = found["meshes"].as_array().unwrap();
    assert!(meshes.iter().all(|mesh| mesh["light"] == true), "{meshes:?}");
}

#[test]
fn blender_opens_it_with_its_light() {
    let folder = tempfile::tempdir().unwrap();
    // Blender 5.0 mixes up the values where a mesh has two attributes that are not glTF's own.
    let scene = model::write(folder.path());
    let text = std::fs::read_to_string(&scene).unwrap();
    let mut document: Value = serde_json::from_str(&text).unwrap();
    let attributes = &mut document["meshes"][0]["primitives"][0]["attributes"];
    attributes.as_object_mut().unwrap().remove("_ID").unwrap();
    std::fs::write(&scene, document.to_string()).unwrap();
    let [glb, _] = model::solve(&scene, folder.path(), &["--elements", "2000"]);
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    if printed(Command::new(&python).args(["-c", "import bpy"])).is_none() {
        return println!("skipped: python3 has no bpy");
    }
    let done = Command::new(python).arg(here().join("blender.py")).arg(&glb).output().unwrap();
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{said}{}", String::from_utf8_lossy(&done.stderr));
    let result = said.lines().find_map(|line| line.strip_prefix("RESULT ")).expect(&said);
    let result: Value = serde_json::from_str(result).unwrap();
    let lit = Glb::read(&glb);
    for node in ["floor", "lamp", "rising"] {
        let primitive = &lit.primitives(node)[0];
        let mine = lit.attribute(primitive, "_RADIOSITY");
        let theirs = &result["objects"][node]["light"];
        let sum = |light: &dyn Fn(usize) -> f64, count| (0..count).map(light).sum::<f64>();
        let count = theirs.as_array().expect(node).len();
        assert_eq!(count, mine.len(), "{node}");
        let theirs = sum(&|i| theirs[i][0].as_f64().unwrap(), count);
        let mine = sum(&|i| mine[i][0], count);
        assert!((theirs - mine).abs() <= 1e-5 * mine, "{node}: {theirs} {mine}");
    }
    assert_eq!(result["objects"]["floor"]["materials"][0], "checker");
    assert!(result["mean"].as_f64().unwrap() > 0.05, "{}", result["mean"]);
}

/// # References
/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len() / 3 * 4 + 4);
    for three in bytes.chunks(3) {
        let byte = |i: usize| u32::from(*three.get(i).unwrap_or(&0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let six = (bits >> (18 - 6 * digit)) as usize & 63;
            text.push(if digit <= three.len() { char::from(DIGITS[six]) } else { '=' });
        }
    }
    text
}
