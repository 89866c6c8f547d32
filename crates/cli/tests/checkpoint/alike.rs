//! For every goal, and any number of threads: the bytes of work that nothing cut off.

use crate::support::{box_tri, folder_with, radiosity};
use crate::{outputs, solve};

#[test]
fn work_that_ran_out_of_time_goes_on_to_the_same_bytes() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let folder = folder.path();
    std::fs::write(folder.join("places.csv"), "triangle,u,v\n0,0.2,0.3\n5,0.1,0.1\n").unwrap();
    for flags in [
        "--error 4%",
        "--error 8% --split centroid",
        "--elements 500 --converge 0.1%",
        "--elements 500 --converge 0.1% --no-statement --schedule single",
        "--error 8% --reflect 0.97",
        "--elements 300 --converge 0.01% --reflect 0.99 --sides both",
        "--error 4% --probe places.csv -o lit.probe.csv",
    ] {
        let run = radiosity(folder, &solve(flags, &["--threads", "1"]));
        assert_eq!(run.code(), 0, "{flags}: {}", run.stderr());
        let whole = outputs(folder);
        let places = std::fs::read(folder.join("lit.probe.csv")).ok();
        // Wherever that ends: a slow machine is not at its first step yet, a fast one is done.
        for (time, again) in [("1ms", false), ("80ms", true)] {
            let keep = ["--checkpoint", "a.ckpt", "--every", "10ms"];
            let limit = [&keep[..], &["--max-time", time]].concat();
            let run = radiosity(folder, &solve(flags, &limit));
            assert_eq!(run.code(), 0, "{flags}: {}", run.stderr());
            if run.stderr().contains("--max-time ended the work") {
                assert!(run.stderr().contains("--resume a.ckpt goes on"), "{}", run.stderr());
            }
            let resume = [&keep[..], &["--resume", "a.ckpt", "--threads", "3"]].concat();
            for _ in 0..1 + u32::from(again) {
                let run = radiosity(folder, &solve(flags, &resume));
                assert_eq!(run.code(), 0, "{flags}: {}", run.stderr());
                assert!(run.stderr().contains("a.ckpt: going on"), "{}", run.stderr());
                assert!(outputs(folder) == whole, "{flags}, cut off after {time}");
                assert_eq!(std::fs::read(folder.join("lit.probe.csv")).ok(), places, "{flags}");
            }
            assert!(folder.join("a.ckpt").is_file(), "a finished run leaves its checkpoint");
        }
    }
}

#[test]
fn outputs_may_be_others_after_resuming() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let folder = folder.path();
    let flags = ["solve", "box.tri", "--elements", "200"];
    let run = radiosity(folder, &[&flags[..], &["-o", "-"]].concat());
    let whole = run.stdout();
    let keep = ["-o", "a.ply", "--checkpoint", "a.ckpt", "--every", "1ms"];
    assert_eq!(radiosity(folder, &[&flags[..], &keep].concat()).code(), 0);
    let run = radiosity(folder, &[&flags[..], &["-o", "-", "--resume", "a.ckpt"]].concat());
    assert!(run.code() == 0 && run.stdout() == whole, "{}", run.stderr());
}
