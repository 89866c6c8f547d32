//! References that lead out of the scene's folder: not followed unless the caller says so.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use std::fs;
use std::path::{Path, PathBuf};

use scene_import::{Error, Imported, Options, open};
use tempfile::TempDir;

use crate::glb::{Glb, TRIANGLE};
use crate::warnings;

const ANYWHERE: Options = Options {
    tri_light: 1.0,
    tri_reflect: 0.5,
    sides: SCENE,
    keep_document: false,
    allow_outside: true,
};
const SCENE: scene_import::SidesRule = scene_import::SidesRule::Scene;

const SAYS: &str = "it lies outside the scene's folder, and only --allow-outside reads it";

/// A folder `scene` beside a folder `secret`, in which lie a buffer, a library and a picture; the
/// same lie in `scene/parts`.
struct Folders {
    all: TempDir,
    json: String,
}

impl Folders {
    fn new() -> Self {
        let mut glb = Glb::default();
        glb.floats(&TRIANGLE);
        let all = tempfile::tempdir().unwrap();
        for folder in ["secret", "scene/parts"] {
            let folder = all.path().join(folder);
            fs::create_dir_all(&folder).unwrap();
            fs::write(folder.join("a.bin"), glb.bin()).unwrap();
            fs::write(folder.join("a.mtl"), "newmtl wall\nKd 0.25 0.25 0.25\n").unwrap();
            image::RgbImage::from_pixel(2, 2, image::Rgb([0; 3]))
                .save(folder.join("a.png"))
                .unwrap();
        }
        let json = glb.json(
            r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]"#,
        );
        Self { all, json }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.all.path().join(name)
    }

    /// The spellings of a file in `secret`, seen from `scene`.
    fn ways_out(&self, name: &str) -> Vec<String> {
        let absolute = self.path("secret").join(name).to_str().unwrap().to_owned();
        vec![
            format!("../secret/{name}"),
            format!("parts/../../secret/{name}"),
            // Back in by the folder's own name: who writes this knows what is around it.
            format!("../scene/parts/{name}"),
            absolute,
        ]
    }

    fn gltf(&self, uri: &str, options: &Options) -> Result<Imported, Error> {
        let path = self.path("scene/a.gltf");
        let with = format!(r#""buffers":[{{"uri":"{uri}","#);
        fs::write(&path, self.json.replace(r#""buffers":[{"#, &with)).unwrap();
        open(&path, options)
    }

    /// An OBJ triangle, its library and the library's texture.
    fn obj(&self, library: &str, texture: &str, options: &Options) -> Imported {
        let path = self.path("scene/a.obj");
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wall\nf 1/1 2/1 3/1\n";
        fs::write(&path, format!("mtllib {library}\n{triangle}")).unwrap();
        fs::write(self.path("scene/own.mtl"), format!("newmtl wall\nmap_Kd {texture}\n")).unwrap();
        open(&path, options).unwrap()
    }
}

fn reflectance(imported: &Imported) -> f64 {
    imported.scene.materials()[0].reflectance[0]
}

#[test]
fn buffers_stay_in_the_folder() {
    let folders = Folders::new();
    for uri in ["parts/a.bin", "./parts/../parts/a.bin", "parts%2Fa.bin"] {
        assert!(folders.gltf(uri, &Options::default()).is_ok(), "{uri}");
    }
    let mut ways = folders.ways_out("a.bin");
    ways.extend(["%2e%2e/secret/a.bin", "..%5Csecret%5Ca.bin"].map(str::to_owned));
    for uri in ways {
        let error = folders.gltf(&uri, &Options::default()).unwrap_err().to_string();
        let cut: String = uri.chars().take(60).collect();
        assert!(error.starts_with(&format!("a.gltf: buffers[0]: \"{cut}")), "{error}");
        assert!(error.ends_with(SAYS), "{error}");
        assert_eq!(folders.gltf(&uri, &ANYWHERE).unwrap().scene.triangles().len(), 1);
    }
    // Places that are not there under any options, on this system.
    for uri in ["C%3A/a.bin", "C%3A%5Ca.bin", "//server/share/a.bin", "%5C%5Cserver%5Ca.bin"] {
        let error = folders.gltf(uri, &Options::default()).unwrap_err().to_string();
        assert!(error.ends_with(SAYS), "{error}");
    }
}

#[test]
fn libraries_and_textures_stay_in_the_folder() {
    let folders = Folders::new();
    assert_eq!(reflectance(&folders.obj("parts/a.mtl", "-", &Options::default())), 0.25);
    assert_eq!(reflectance(&folders.obj("own.mtl", "parts\\a.png", &Options::default())), 0.0);
    for way in folders.ways_out("a.mtl") {
        let imported = folders.obj(&way, "-", &Options::default());
        assert_eq!(reflectance(&imported), 0.5, "grey, as where it is missing");
        let expected = format!("a.obj:1: material library {way:?} ({SAYS}) is missing");
        assert!(warnings(&imported)[0].starts_with(&expected), "{:?}", warnings(&imported));
        assert_eq!(reflectance(&folders.obj(&way, "-", &ANYWHERE)), 0.25);
    }
    for way in folders.ways_out("a.png") {
        let imported = folders.obj("own.mtl", &way, &Options::default());
        let expected = format!("own.mtl:1: texture {way} is left out, white is used: {SAYS}");
        assert!(warnings(&imported).contains(&expected), "{:?}", warnings(&imported));
        assert_eq!(reflectance(&folders.obj("own.mtl", &way, &ANYWHERE)), 0.0, "{way}");
    }
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out() {
    let folders = Folders::new();
    let link = |to: &str, name: &str| {
        std::os::unix::fs::symlink(Path::new(to), folders.path(name)).unwrap();
    };
    link("../secret", "scene/folder");
    link("../secret/a.bin", "scene/file.bin");
    link("parts/a.bin", "scene/inside.bin");
    for uri in ["folder/a.bin", "file.bin"] {
        let error = folders.gltf(uri, &Options::default()).unwrap_err().to_string();
        assert_eq!(error, format!("a.gltf: buffers[0]: {uri:?} cannot be read: {SAYS}"));
        assert!(folders.gltf(uri, &ANYWHERE).is_ok());
    }
    assert!(folders.gltf("inside.bin", &Options::default()).is_ok());
    // The folder itself may be reached by a link.
    link("scene", "elsewhere");
    assert!(open(&folders.path("elsewhere/a.gltf"), &Options::default()).is_ok());
}

#[test]
fn a_library_that_is_named_again_is_read_once() {
    let folders = Folders::new();
    let text = "newmtl wall\nKd 0.25\nd 0.5\n";
    fs::write(folders.path("scene/glass.mtl"), text).unwrap();
    let once = warnings(&folders.obj("glass.mtl", "-", &Options::default()));
    let names = "glass.mtl ./glass.mtl parts/../glass.mtl\nmtllib glass.mtl";
    assert_eq!(warnings(&folders.obj(names, "-", &Options::default())), once);
    assert_eq!(once, ["glass.mtl:3: left out: transparency"]);
}
