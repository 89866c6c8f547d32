//! `--config`: a file of flags, which typed ones win over.

use std::path::Path;

use serde_json::Value;

use crate::support::{box_tri, folder_with, radiosity};

fn report(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn files_are_those_beside_the_config_and_flags_win() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let conf = folder.path().join("conf");
    std::fs::create_dir(&conf).unwrap();
    let text = "scene = \"../box.tri\"\nelements = 300\nno-statement = true\n\
                output = [\"a.csv\", \"b.ply\"]\nreport = \"r.json\"\n";
    std::fs::write(conf.join("a.toml"), text).unwrap();
    let run = |more: &[&str]| {
        let run = radiosity(folder.path(), &[&["solve", "--config", "conf/a.toml"], more].concat());
        assert_eq!(run.code(), 0, "{}", run.stderr());
        run
    };
    run(&[]);
    assert!(conf.join("b.ply").is_file());
    let typed = ["solve", "box.tri", "--elements", "300", "--no-statement", "-o", "-"];
    let typed = radiosity(folder.path(), &typed).stdout();
    assert_eq!(std::fs::read_to_string(conf.join("a.csv")).unwrap(), typed);
    assert_eq!(report(&conf.join("r.json"))["settings"]["elements"], 300);
    // One flag is typed, the others stay; a typed error leaves the fixed mesh out.
    assert!(run(&["-o", "-", "--elements", "100"]).stdout() != typed);
    assert_eq!(report(&conf.join("r.json"))["settings"]["elements"], 100);
    run(&["-o", "c.csv", "--error", "5%"]);
    assert!(folder.path().join("c.csv").is_file(), "typed names are those of the working folder");
    assert_eq!(report(&conf.join("r.json"))["settings"]["error"], 0.05);
}

#[test]
fn terminal_flags_may_stand_in_the_file_too() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let text = "scene = \"box.tri\"\nelements = 50\noutput = \"a.csv\"\nlog = \"json\"\n";
    std::fs::write(folder.path().join("a.toml"), text).unwrap();
    let said = |more: &[&str]| {
        radiosity(folder.path(), &[&["solve", "--config", "a.toml"], more].concat()).stderr()
    };
    assert!(said(&[]).starts_with("{\"kind\":\"start\""));
    assert_eq!(said(&["--log", "text", "-q"]), "");
}

#[test]
fn wrong_files_are_refused_with_place_and_expectation() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for (text, code, expected) in [
        ("elements = \"many\"\n", 2, "a.toml:1:12: elements: many: expected a whole number"),
        (
            "output = \"a.csv\"\nelemnts = 5\n",
            2,
            "a.toml:2:1: elemnts: is no key; did you mean elements?",
        ),
        (
            "output = \"a.csv\"\nambient = 1\n",
            2,
            "a.toml:2:11: ambient: expected true or false, found a number",
        ),
        ("output = \"a.csv\"\nerror = 0.0\n", 2, "a.toml:2:1: --error: expected more than 0"),
        ("output = \"a.txt\"\n", 2, "a.toml:1:1: -o a.txt: "),
        ("output = [\n", 2, "a.toml:"),
        ("scene = \"gone.tri\"\noutput = \"a.csv\"\n", 1, "gone.tri: "),
    ] {
        std::fs::write(folder.path().join("a.toml"), text).unwrap();
        let run = radiosity(folder.path(), &["solve", "--config", "a.toml"]);
        let said = run.stderr();
        assert_eq!((run.code(), said.lines().count()), (code, 1), "{text}: {said}");
        assert!(said.contains(&format!("radiosity: error: {expected}")), "{text}: {said}");
    }
    let run = radiosity(folder.path(), &["solve", "--config", "gone.toml"]);
    assert!(
        run.code() == 1 && run.stderr().contains("gone.toml: there is no such file"),
        "{}",
        run.stderr()
    );
    assert!(!folder.path().join("a.csv").exists());
}

#[cfg(all(feature = "gltf", feature = "png"))]
#[test]
fn the_example_works() {
    /// The file that docs/config.md names.
    const EXAMPLE: &str = include_str!("../../../../docs/solve.toml");
    let folder = tempfile::tempdir().unwrap();
    for name in ["docs", "scenes", "out"] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
    }
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let scene = folder.path().join("scenes/cornell.glb");
    std::fs::copy(scenes.join("cornell.glb"), scene).unwrap();
    std::fs::write(folder.path().join("docs/solve.toml"), EXAMPLE).unwrap();
    let args = ["solve", "--config", "docs/solve.toml", "--error", "10%"];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    for name in ["lit.glb", "lit.png", "lit.json"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
    assert_eq!(report(&folder.path().join("out/lit.json"))["settings"]["max_seconds"], 60.0);
}
