//! What is damaged, foreign or from the future is refused in one line; nothing panics.

use std::path::Path;

use crate::support::{Run, box_tri, folder_with, radiosity};

const FLAGS: [&str; 5] = ["solve", "box.tri", "-o", "a.csv", "--elements=200"];

/// A folder with the box and a checkpoint of it.
fn kept() -> (tempfile::TempDir, Vec<u8>) {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let keep = ["--checkpoint", "a.ckpt", "--every", "1ms"];
    let run = radiosity(folder.path(), &[&FLAGS[..], &keep].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let bytes = std::fs::read(folder.path().join("a.ckpt")).unwrap();
    (folder, bytes)
}

/// Why the run failed: the one line that says so.
fn refusal(run: &Run, code: i32) -> String {
    let text = run.stderr();
    assert_eq!(run.code(), code, "{text}");
    let errors: Vec<_> = text.lines().filter(|l| l.contains("radiosity: error: ")).collect();
    assert!(errors.len() == 1 && text.ends_with(&format!("{}\n", errors[0])), "{text}");
    assert!(!text.contains("panicked"), "{text}");
    errors[0].replace("radiosity: error: ", "")
}

fn resume(folder: &Path, more: &[&str]) -> Run {
    radiosity(folder, &[&FLAGS[..], &["--resume", "a.ckpt"], more].concat())
}

#[test]
fn damage_is_found() {
    let (folder, whole) = kept();
    let folder = folder.path();
    let message = |bytes: &[u8]| {
        std::fs::write(folder.join("a.ckpt"), bytes).unwrap();
        let message = refusal(&resume(folder, &[]), 1);
        assert!(message.starts_with("a.ckpt: is "), "{message}");
        message
    };
    let step = whole.len() / 12;
    for at in (0..20).chain((20..whole.len()).step_by(step)).chain([whole.len() - 1]) {
        let mut bytes = whole.clone();
        bytes[at] ^= 1 << (at % 8);
        message(&bytes);
    }
    for length in [0, 1, 8, 11, 12, 16, 100, whole.len() / 2, whole.len() - 1] {
        message(&whole[..length]);
    }
    assert!(message(&[&whole[..], b"\n"].concat()).contains("damaged"));
    assert!(message(&[&whole[..], &whole].concat()).contains("damaged"));
    assert!(message(b"\xff\xd8\xff\xe0\0\x10JFIF").contains("is no checkpoint"));
    assert!(message(box_tri().as_bytes()).contains("is no checkpoint"));
    // Right sums, wrong contents.
    let summed = |bytes: &mut Vec<u8>| {
        let end = bytes.len() - 4;
        let sum = crc32fast::hash(&bytes[..end]).to_le_bytes();
        bytes[end..].copy_from_slice(&sum);
    };
    let mut newer = whole.clone();
    newer[8] = 3;
    summed(&mut newer);
    assert!(message(&newer).contains("format 3, expected 2: a newer program wrote it"));
    let mut shorter = whole[..whole.len() - 8].to_vec();
    summed(&mut shorter);
    assert!(message(&shorter).contains("is damaged, or of other work"));
    for at in (whole.len() - 3000..whole.len() - 8).step_by(600) {
        let mut infinite = whole.clone();
        infinite[at..at + 16].fill(255);
        summed(&mut infinite);
        message(&infinite);
    }
    // And the whole file is none of that.
    std::fs::write(folder.join("a.ckpt"), &whole).unwrap();
    assert_eq!(resume(folder, &[]).code(), 0);
}

#[test]
fn other_work_is_told_apart() {
    let (folder, whole) = kept();
    let folder = folder.path();
    std::fs::write(folder.join("places.csv"), "triangle,u,v\n0,0.2,0.3\n").unwrap();
    for (flags, part) in [
        ("--reflect=0.6", "materials: CRC-32 "),
        ("--light=2", "materials: CRC-32 "),
        ("--sides=both", "materials: CRC-32 "),
        ("--converge=1%", "goal: --elements 200 --converge 0.001, expected --elements 200 "),
        ("--no-statement", "goal: --elements 200 --converge 0.001, expected "),
        ("--accel=octree", "occluders: none, expected octree"),
        ("--schedule=single", "shooting: schedule: Auto, expected schedule: Single"),
        ("--max-depth=30", "refining: most_depth: "),
        ("--probe=places.csv -o at.probe.csv", "probes: 0, "),
    ] {
        let message = refusal(&resume(folder, &flags.split(' ').collect::<Vec<_>>()), 1);
        let expected = format!("a.ckpt: is a checkpoint of other work: {part}");
        assert!(message.starts_with(&expected), "{flags}: {message}");
    }
    // Another scene in the same file; and another program.
    std::fs::write(folder.join("box.tri"), box_tri().replace("2 2 2", "2 2 3")).unwrap();
    let message = refusal(&resume(folder, &[]), 1);
    assert!(message.contains("other work: geometry: 12 triangles, CRC-32 "), "{message}");
    std::fs::write(folder.join("box.tri"), box_tri()).unwrap();
    let mut other = whole.clone();
    let name = b"program: radiosity ";
    let at = whole.windows(name.len()).position(|w| w == name).unwrap() + name.len();
    other[at] = b'9';
    let end = other.len() - 4;
    let sum = crc32fast::hash(&other[..end]).to_le_bytes();
    other[end..].copy_from_slice(&sum);
    std::fs::write(folder.join("a.ckpt"), &other).unwrap();
    let message = refusal(&resume(folder, &[]), 1);
    assert!(message.contains("other work: program: radiosity 9."), "{message}");
}

#[test]
fn contradictions_are_refused_before_any_work() {
    let (folder, whole) = kept();
    let folder = folder.path();
    for flags in [
        "--checkpoint a.csv",
        "--checkpoint box.tri",
        "--checkpoint -",
        "--resume -",
        "--resume a.ckpt -o ./a.ckpt",
        "--checkpoint b.json --report b.json",
    ] {
        let flags: Vec<_> = flags.split(' ').collect();
        refusal(&radiosity(folder, &[&FLAGS[..], &flags].concat()), 2);
    }
    for flags in ["--every 1s", "--every 1s --resume a.ckpt", "--checkpoint b.ckpt --every soon"] {
        let flags: Vec<_> = flags.split(' ').collect();
        assert_eq!(radiosity(folder, &[&FLAGS[..], &flags].concat()).code(), 2);
    }
    for flags in ["--resume none.ckpt", "--resume .", "--checkpoint none/b.ckpt", "--checkpoint ."]
    {
        let flags: Vec<_> = flags.split(' ').collect();
        let message = refusal(&radiosity(folder, &[&FLAGS[..], &flags].concat()), 1);
        assert!(message.starts_with(flags[1]), "{message}");
    }
    assert_eq!(std::fs::read(folder.join("a.ckpt")).unwrap(), whole);
}
