//! The guide does what it says: every command of docs/guide.md runs, and prints what stands below it.
//!
//! Blocks of `sh` run one after the other in one folder, with the program first on the path; each must
//! succeed, or end with the code of `exit=N` behind `sh`. Of a block of `text` that follows, each line
//! must be among what was printed, in that order and without lines between; `…` stands for any text of
//! a line, or, alone, for any lines. Lines that begin with `cargo` run elsewhere (xtask's test of the
//! examples): here, they must name a program that is there.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use std::path::{Path, PathBuf};
use std::process::Command;

/// Stands for whatever varies.
const ANY: &str = "…";

/// A block between fences.
struct Block {
    /// What stands behind the first fence.
    kind: String,
    /// The line of the first fence, from 1.
    line: usize,
    text: Vec<String>,
}

#[test]
fn every_command_of_the_guide_runs_and_says_what_stands_there() {
    let root = root();
    let blocks = blocks(&std::fs::read_to_string(root.join("docs/guide.md")).unwrap());
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(root.join("scenes"), folder.path().join("scenes")).unwrap();
    let mut ran = 0;
    for (i, block) in blocks.iter().enumerate() {
        let place = format!("docs/guide.md:{}", block.line);
        let Some(expected) = exit_code(&block.kind) else { continue };
        if block.text.iter().all(|line| line.starts_with("cargo ")) {
            block.text.iter().for_each(|line| check_example(&root, &place, line));
            continue;
        }
        let (code, printed) = run(folder.path(), &block.text.join("\n"));
        assert_eq!(code, expected, "{place}: exit code\n{printed}");
        if let Some(text) = blocks.get(i + 1).filter(|next| next.kind == "text") {
            let printed: Vec<&str> = printed.lines().collect();
            let wanted: Vec<&str> = text.text.iter().map(String::as_str).collect();
            assert!(
                lines_match(&wanted, &printed),
                "docs/guide.md:{}: printed was\n{}",
                text.line,
                printed.join("\n")
            );
        }
        ran += 1;
    }
    assert!(ran >= 3, "only {ran} blocks of commands in docs/guide.md");
}

/// Runs a block with the program first on the path; what it says on either stream, in order.
fn run(folder: &Path, script: &str) -> (i32, String) {
    let program = Path::new(env!("CARGO_BIN_EXE_radiosity")).parent().unwrap();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let first = std::iter::once(program.to_owned());
    let path = std::env::join_paths(first.chain(std::env::split_paths(&path))).unwrap();
    let output = Command::new("sh")
        .args(["-e", "-c", &format!("exec 2>&1\n{script}")])
        .current_dir(folder)
        .env("PATH", path)
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stdout).unwrap())
}

/// The exit code that a block of commands should end with; `None` for other blocks.
fn exit_code(kind: &str) -> Option<i32> {
    match kind.split_once(' ') {
        None => (kind == "sh").then_some(0),
        Some(("sh", code)) => Some(code.strip_prefix("exit=").unwrap().parse().unwrap()),
        Some(_) => None,
    }
}

/// `cargo run -p CRATE --example NAME` names a program that is there.
fn check_example(root: &Path, place: &str, line: &str) {
    let words: Vec<&str> = line.split(' ').collect();
    let ["cargo", "run", "-p", package, "--example", name] = words[..] else {
        panic!("{place}: expected `cargo run -p CRATE --example NAME`, found `{line}`");
    };
    // A folder has its crate's name, but for the prefix of most.
    let folders = [Some(package), package.strip_prefix("radiosity-")].into_iter().flatten();
    let mut files = folders.map(|folder| root.join(format!("crates/{folder}/examples/{name}.rs")));
    let file = files.clone().find(|file| file.is_file()).or_else(|| files.next()).unwrap();
    assert!(file.is_file(), "{place}: {} is not there", file.display());
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The fenced blocks of a page.
fn blocks(page: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut inside = false;
    for (number, line) in page.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if inside => inside = false,
            Some(kind) => {
                inside = true;
                blocks.push(Block { kind: kind.to_owned(), line: number + 1, text: Vec::new() });
            }
            None if inside => blocks.last_mut().unwrap().text.push(line.to_owned()),
            None => {}
        }
    }
    assert!(!inside, "a block has no end");
    blocks
}

/// Whether all printed lines are as wanted.
fn lines_match(wanted: &[&str], printed: &[&str]) -> bool {
    match wanted.split_first() {
        None => printed.is_empty(),
        Some((&ANY, rest)) => (0..=printed.len()).any(|skip| lines_match(rest, &printed[skip..])),
        Some((first, rest)) => printed
            .split_first()
            .is_some_and(|(line, others)| matches(first, line) && lines_match(rest, others)),
    }
}

/// Whether a line is as wanted.
fn matches(wanted: &str, line: &str) -> bool {
    match wanted.split_once(ANY) {
        None => wanted == line,
        Some((before, after)) => line.strip_prefix(before).is_some_and(|rest| {
            (0..=rest.len())
                .filter(|skip| rest.is_char_boundary(*skip))
                .any(|skip| matches(after, &rest[skip..]))
        }),
    }
}

#[test]
fn dots_stand_for_any_text_and_nothing_else_does() {
    assert!(matches("a … c …", "a b c d e"));
    assert!(matches("E1 0.…", "E1 0.25"));
    assert!(!matches("E1 0.…", "E1 1.25"));
    assert!(!matches("a … c", "a b c d"));
    assert!(lines_match(&["a", "…", "c"], &["a", "c"]));
    assert!(lines_match(&["…", "c"], &["a", "b", "c"]));
    assert!(!lines_match(&["a", "c"], &["a", "b", "c"]));
    assert!(!lines_match(&["a"], &["a", "b"]));
    assert!(!lines_match(&["a", "…", "d"], &["a", "b", "c"]));
}

#[test]
fn blocks_are_found_with_their_kinds() {
    let page = "text\n```sh exit=1\na\n```\n\n```text\nb\nc\n```\n```python\nd\n```\n";
    let found = blocks(page);
    let kinds: Vec<_> = found.iter().map(|block| exit_code(&block.kind)).collect();
    assert_eq!(kinds, [Some(1), None, None]);
    assert_eq!((found[1].line, found[1].text.concat()), (6, "bc".to_owned()));
}
