//! What is left out is printed, honoured, and changes no byte where it says so.

use serde_json::Value;

use crate::support::{box_tri, folder_with, radiosity};

fn report(folder: &std::path::Path, args: &[&str]) -> Value {
    let run = radiosity(folder, &[args, &["--report", "r.json"]].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
    serde_json::from_str(&std::fs::read_to_string(folder.join("r.json")).unwrap()).unwrap()
}

fn decision<'a>(report: &'a Value, topic: &str) -> &'a Value {
    let all = report["plan"]["decisions"].as_array().unwrap();
    all.iter().find(|d| d["topic"] == topic).unwrap()
}

#[test]
fn a_plan_says_what_was_read_and_what_is_decided() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let run = radiosity(folder.path(), &["plan", "box.tri"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    for expected in [
        "12 triangles",
        "area 24",
        "2 emitting triangles",
        "warnings  0",
        "no segment is asked for",
        "every triangle has all others on one side",
        "no direction is followed",
        "none: the same bits",
        "foreseen",
    ] {
        assert!(run.stdout().contains(expected), "{expected}: {}", run.stdout());
    }
    let plan = report(folder.path(), &["plan", "box.tri"]);
    assert_eq!(decision(&plan, "structure")["choice"], "none");
    assert_eq!(decision(&plan, "blocking")["leaves_out"], true);
    assert_eq!(plan["plan"]["actual"], Value::Null);
    let segments = &plan["plan"]["foreseen"]["segments"];
    assert!(segments == 0.0 && plan["plan"]["everything"]["segments"].as_f64() > Some(1e3));
}

#[test]
fn a_convex_box_casts_no_ray() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for flags in ["--elements 1500 --no-statement", "--elements 600", "--error 5%"] {
        let mut args = vec!["solve", "box.tri", "-o", "a.csv"];
        args.extend(flags.split(' '));
        let solved = report(folder.path(), &args);
        assert_eq!(
            (&solved["solve"]["rays"], &solved["solve"]["directions"]),
            (&0.into(), &0.into())
        );
        let actual = &solved["plan"]["actual"];
        assert_eq!(actual["form_factors"].as_f64(), solved["solve"]["form_factors"].as_f64());
        let light = std::fs::read(folder.path().join("a.csv")).unwrap();
        args.extend(["--need", "everything"]);
        let all = report(folder.path(), &args);
        assert!(all["solve"]["rays"].as_u64() > Some(10_000), "{flags}");
        assert!(all["solve"]["directions"].as_u64() > Some(1000), "{flags}");
        let left_out = all["plan"]["decisions"].as_array().unwrap();
        assert!(left_out.iter().all(|d| d["leaves_out"] == false), "{left_out:?}");
        if flags.contains("--elements") {
            assert!(light == std::fs::read(folder.path().join("a.csv")).unwrap(), "{flags}");
        }
    }
}

#[test]
fn small_meshes_say_what_is_known_of_them() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let said = |more: &[&str]| {
        let args = [&["solve", "box.tri", "--error", "5%", "-o", "a.csv"], more].concat();
        radiosity(folder.path(), &args).stderr()
    };
    let needed = said(&[]);
    assert!(needed.contains("no statement from one mesh"), "{needed}");
    assert!(needed.contains("form factors not judged yet"), "{needed}");
    // A limit of time may make any mesh the last.
    for flags in [&["--need", "everything"][..], &["--max-time", "1h"]] {
        let all = said(flags);
        assert!(!all.contains("not judged") && all.matches(": error ").count() > 1, "{all}");
    }
}

#[test]
fn wrong_flags_are_refused() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for (flags, part) in [
        ("plan box.tri --need nothing", "auto"),
        ("plan box.tri --error 0", "--error"),
        ("plan box.tri --error 1% --elements 5", "--error"),
        ("plan box.tri --report plan.txt", ".json"),
        ("plan box.tri --report box.tri", ".json"),
    ] {
        let run = radiosity(folder.path(), &flags.split(' ').collect::<Vec<_>>());
        assert!(run.code() == 2 && run.stderr().contains(part), "{flags}: {}", run.stderr());
    }
}
