//! Killed again and again, at any moment, the work still ends, with the same bytes.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{box_tri, folder_with};
use crate::{outputs, solve};

const FLAGS: &str = "--error 2% --reflect 0.9 --threads 2";

const KILLS: u32 = 20;

fn start(folder: &Path, more: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .current_dir(folder)
        .args(solve(FLAGS, more))
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn work_survives_being_killed_at_any_moment() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let folder = folder.path();
    let clock = Instant::now();
    assert!(start(folder, &[]).wait().unwrap().success());
    let whole = outputs(folder);
    // No time is measured but to know when there is something to kill.
    let duration = clock.elapsed();
    let checkpoint = folder.join("a.ckpt");
    // Knuth's MMIX generator.
    let mut seed = 7u64;
    let mut share = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f64 / (1u64 << 24) as f64
    };
    let keep = ["--checkpoint", "a.ckpt", "--every", "10ms"];
    let resume = [&keep[..], &["--resume", "a.ckpt"]].concat();
    let (mut kills, mut resumed, mut ended) = (0, 0, 0);
    while kills < KILLS || ended == 0 {
        let goes_on = checkpoint.exists();
        resumed += u32::from(goes_on);
        let mut child = start(folder, if goes_on { &resume } else { &keep });
        let moment = Instant::now() + duration.mul_f64(0.5 * share());
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break Some(status);
            }
            if kills < KILLS && Instant::now() >= moment {
                // SIGKILL: nothing in the program hears of it.
                child.kill().unwrap();
                child.wait().unwrap();
                break None;
            }
            std::thread::sleep(Duration::from_millis(1));
        };
        match status {
            None => kills += 1,
            Some(status) => {
                assert!(status.success(), "after {kills} kills: {status}");
                assert!(outputs(folder) == whole, "after {kills} kills");
                std::fs::remove_file(&checkpoint).unwrap();
                ended += 1;
            }
        }
    }
    println!("{kills} kills, {resumed} resumed, {ended} ended");
    assert!(resumed >= KILLS / 2, "{resumed}");
}
