//! What ends the work early: Ctrl-C, time and memory; and the light on its way.

use std::path::Path;

use serde_json::Value;

use crate::support::{box_tri, folder_with, radiosity};

/// The report in a folder.
fn report(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("a.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Rows of a table of triangles, B_r of each.
fn exitance(path: &Path) -> Vec<f64> {
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.ends_with('\n'), "the file is whole");
    text.lines().skip(1).map(|line| line.split(',').nth(2).unwrap().parse().unwrap()).collect()
}

/// An hour's work, sent a signal once it has said that some of it is done.
#[cfg(unix)]
mod signals {
    use std::io::{BufRead, BufReader};
    use std::os::unix::process::{CommandExt, ExitStatusExt};
    use std::process::{Child, ChildStderr, Command, Stdio};

    use super::*;

    fn long_solve(folder: &Path) -> (Child, BufReader<ChildStderr>) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_radiosity"));
        command
            .current_dir(folder)
            .args(["solve", "box.tri", "--error", "1e-6", "--max-time", "1h"])
            .args(["-o", "a.csv", "-o", "a.ply", "--report", "a.json"])
            .stderr(Stdio::piped());
        // Tests may run under nohup, which the program would take as a word to itself.
        let heed_hangup = || {
            // SAFETY: signal may be called between fork and exec.
            #[expect(unsafe_code, reason = "std does not set how signals are handled")]
            unsafe {
                libc::signal(libc::SIGHUP, libc::SIG_DFL);
            }
            Ok(())
        };
        // SAFETY: what is called between fork and exec neither allocates nor locks.
        #[expect(unsafe_code, reason = "std does not set how signals are handled")]
        unsafe {
            command.pre_exec(heed_hangup);
        }
        let mut child = command.spawn().unwrap();
        let stderr = BufReader::new(child.stderr.take().unwrap());
        (child, stderr)
    }

    fn send(child: &Child, signal: i32) {
        let id = i32::try_from(child.id()).unwrap();
        // SAFETY: kill takes any two numbers; the child is not yet waited for, so the id is its own.
        #[expect(unsafe_code, reason = "std sends no signal but SIGKILL")]
        let sent = unsafe { libc::kill(id, signal) };
        assert_eq!(sent, 0);
    }

    #[test]
    fn a_signal_ends_the_work_and_keeps_its_light() {
        for signal in [libc::SIGINT, libc::SIGTERM] {
            let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
            let (mut child, mut stderr) = long_solve(folder.path());
            let mut said = String::new();
            // Two levels are done: there is something to state.
            while !said.contains("error ") {
                assert!(stderr.read_line(&mut said).unwrap() > 0, "{said}");
            }
            send(&child, signal);
            std::io::Read::read_to_string(&mut stderr, &mut said).unwrap();
            assert_eq!(child.wait().unwrap().code(), Some(0), "{said}");
            for expected in ["interrupted", "emitted power unshot", "error: at most", "written:"] {
                assert!(said.contains(expected), "{expected}: {said}");
            }
            let report = report(folder.path());
            assert_eq!(report["solve"]["limit"], "interrupt");
            assert_eq!(report["solve"]["reached"], "limit");
            assert!(report["error"]["total"].as_f64().unwrap() > 1e-6);
            // Walls shine by what they reflect.
            let lit = exitance(&folder.path().join("a.csv"));
            assert!(lit.len() == 12 && lit.iter().all(|b| *b > 0.0), "{lit:?}");
            assert_eq!(&std::fs::read(folder.path().join("a.ply")).unwrap()[..4], b"ply\n");
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4, "nothing beside");
        }
    }

    #[test]
    fn a_second_signal_ends_the_program() {
        // The outputs go into a pipe that nobody reads: the first signal leads there and waits.
        let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
        let name = std::ffi::CString::new(folder.path().join("a.csv").to_str().unwrap()).unwrap();
        // SAFETY: the name is a string that ends in 0.
        #[expect(unsafe_code, reason = "std makes no pipes with names")]
        let made = unsafe { libc::mkfifo(name.as_ptr(), 0o600) };
        assert_eq!(made, 0);
        let (mut child, mut stderr) = long_solve(folder.path());
        let mut said = String::new();
        while !said.contains("error ") {
            assert!(stderr.read_line(&mut said).unwrap() > 0, "{said}");
        }
        send(&child, libc::SIGINT);
        while !said.contains("interrupted") {
            assert!(stderr.read_line(&mut said).unwrap() > 0, "{said}");
        }
        assert_eq!(child.try_wait().unwrap(), None, "it waits for a reader");
        send(&child, libc::SIGINT);
        let status = child.wait().unwrap();
        assert!(status.code() == Some(130) || status.signal() == Some(libc::SIGINT), "{status}");
        assert!(!folder.path().join("a.ply").exists());
    }
}

#[test]
fn time_may_end_the_work_before_its_first_step() {
    // The mesh alone takes longer.
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--elements", "300000", "--no-statement", "--max-time", "1ms"];
    let args = [&args[..], &["-o", "a.csv", "--report", "a.json"]].concat();
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let expected = "--max-time ended the work before the first step was done: what is written is \
                    the emittance alone";
    assert!(run.stderr().contains(expected), "{}", run.stderr());
    let report = report(folder.path());
    assert_eq!(report["solve"]["limit"], "--max-time");
    assert_eq!(report["solve"]["shots"], 0);
    // 100·255 on the two triangles that shine.
    let mut emittance = [0.0; 12];
    emittance[2..4].fill(25_500.0);
    for (lit, emitted) in exitance(&folder.path().join("a.csv")).iter().zip(emittance) {
        assert!((lit - emitted).abs() < 1e-9 * 25_500.0, "{lit} {emitted}");
    }
}

/// The largest resident size of the children waited for so far, bytes.
#[cfg(target_os = "linux")]
fn largest_child() -> u64 {
    let mut usage = std::mem::MaybeUninit::<libc::rusage>::zeroed();
    // SAFETY: the place is large enough for what is written, and all its bits are valid before.
    #[expect(unsafe_code, reason = "std does not tell what children took")]
    let usage = unsafe {
        assert_eq!(libc::getrusage(libc::RUSAGE_CHILDREN, usage.as_mut_ptr()), 0);
        usage.assume_init()
    };
    usage.ru_maxrss as u64 * 1024
}

#[test]
fn memory_makes_a_fixed_mesh_coarser() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--elements", "2000000", "--no-statement", "--converge", "60%"];
    let args =
        [&args[..], &["--max-memory", "150MB", "-o", "a.csv", "--report", "a.json"]].concat();
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let said = run.stderr();
    assert!(said.contains("elements instead of 2,000,000, which may take"), "{said}");
    assert!(said.contains("--max-memory ended the work with"), "{said}");
    let report = report(folder.path());
    assert_eq!(report["solve"]["limit"], "--max-memory");
    assert_eq!(report["solve"]["reached"], "limit");
    let elements = report["mesh"]["elements"].as_u64().unwrap();
    assert!((1000..2_000_000).contains(&elements), "{elements}");
    // The other tests' programs are children, too, and smaller.
    #[cfg(target_os = "linux")]
    assert!(largest_child() <= 150_000_000, "{}", largest_child());
}

#[test]
fn memory_for_less_than_the_scene_is_refused_with_what_it_needs() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for goal in [["--error", "1%"], ["--elements", "100"]] {
        let args = ["solve", "box.tri", "--max-memory", "1MB", "-o", "a.csv", goal[0], goal[1]];
        let run = radiosity(folder.path(), &args);
        assert_eq!(run.code(), 1, "{}", run.stderr());
        let said = run.stderr();
        let last = said.lines().last().unwrap();
        let expected = "--max-memory: 1.0 MB is too little: the scene's own triangles need about";
        assert!(last.contains(expected), "{said}");
        assert!(!folder.path().join("a.csv").exists());
    }
}

#[test]
fn snapshots_are_light_on_its_way_and_change_nothing() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let solve = |out: &str, extra: &[&str]| {
        let args = ["solve", "box.tri", "--elements", "1500", "--no-statement", "-o", out];
        let run = radiosity(folder.path(), &[&args[..], extra].concat());
        assert_eq!(run.code(), 0, "{}", run.stderr());
        run.stderr()
    };
    solve("plain.csv", &[]);
    solve("a.csv", &["-o", "a.ply", "--snapshot", "every:40", "--report", "a.json"]);
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.csv") == bytes("plain.csv"));
    let report = report(folder.path());
    let snapshots = report["snapshots"].as_array().unwrap();
    assert!(snapshots.len() > 2, "{snapshots:?}");
    let last = exitance(&folder.path().join("a.csv"));
    let distance = |name: &str| -> f64 {
        let lit = exitance(&folder.path().join(name));
        lit.iter().zip(&last).map(|(a, b)| (a - b).abs()).sum()
    };
    let mut distances = Vec::new();
    for (i, snapshot) in (1..).zip(snapshots) {
        let files = [format!("a.{i:05}.csv"), format!("a.{i:05}.ply")];
        assert_eq!(snapshot["files"], serde_json::json!(files));
        assert!(snapshot["shots"].as_u64().unwrap() >= 40 * i);
        assert_eq!(&bytes(&files[1])[..4], b"ply\n");
        distances.push(distance(&files[0]));
        let run = radiosity(folder.path(), &["compare", &files[0], "a.csv"]);
        assert_eq!(run.code(), 0, "{}", run.stderr());
    }
    assert!(distances.windows(2).all(|pair| pair[0] != pair[1]), "{distances:?}");
    assert!(distances[0] > 3.0 * distances[distances.len() - 1], "{distances:?}");
}

#[test]
fn snapshots_that_cannot_be_written_are_warned_of() {
    let (folder, _) = folder_with("a.00001.tri", box_tri().as_bytes());
    std::fs::create_dir(folder.path().join("b.00001.csv")).unwrap();
    let args = ["solve", "a.00001.tri", "--elements", "300", "--no-statement"];
    let more = ["-o", "a.tri", "-o", "b.csv", "--snapshot", "every:10"];
    let run = radiosity(folder.path(), &[&args[..], &more].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
    assert!(run.stderr().contains("warning: snapshot: "), "{}", run.stderr());
    let scene = std::fs::read(folder.path().join("a.00001.tri")).unwrap();
    assert!(scene == box_tri().as_bytes(), "the scene is never written over");
    assert!(folder.path().join("b.csv").is_file());
}

/// Finer meshes that are the same mesh would agree with each other for ever.
#[test]
fn meshes_that_may_not_be_split_end_the_work() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let solve = |flags: &[&str]| {
        let run = radiosity(folder.path(), &[&["solve", "box.tri", "-o", "a.csv"], flags].concat());
        assert_eq!(run.code(), 0, "{}", run.stderr());
        run.stderr()
    };
    for flags in [
        ["--error", "0.1%", "--max-depth", "3"],
        ["--error", "0.1%", "--min-area", "0.2"],
        ["--elements", "2000", "--max-depth", "4"],
    ] {
        let said = solve(&flags);
        assert!(said.contains("--min-area or --max-depth ended the work"), "{flags:?}: {said}");
    }
    let said = solve(&["--max-depth", "0"]);
    assert!(said.contains("allow no other") && said.contains("mesh unknown"), "{said}");
}

#[test]
fn light_that_no_surface_receives_ends_the_work() {
    let lamp = "Triangle 255 255 255 255 255 255 0 0 0 1 0 0 0 1 0\n";
    let (folder, _) = folder_with("lamp.tri", lamp.as_bytes());
    let run = radiosity(folder.path(), &["solve", "lamp.tri", "-o", "a.csv"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    assert!(run.stderr().contains("how much is missed is unknown"), "{}", run.stderr());
}
