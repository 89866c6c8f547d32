//! Wrong command lines: one line each that says what is wrong and what to type instead.

use crate::support::{box_tri, folder_with, radiosity};

/// A command line, its exit code, and what its message must have, in this order.
type Case = (&'static str, i32, &'static [&'static str]);

const CASES: &[Case] = &[
    // Commands.
    ("solv box.tri", 2, &["solv: is no command", "did you mean solve?", "`radiosity help`"]),
    ("box.tri", 2, &["box.tri: expected a command before it", "`radiosity solve box.tri`"]),
    ("frobnicate", 2, &["frobnicate: is no command", "`radiosity help` lists the commands"]),
    // Flags.
    ("solve box.tri --elemnts 9", 2, &["--elemnts: is no flag", "did you mean --elements?"]),
    ("solve box.tri --rays 9", 2, &["--rays: is no flag", "`radiosity help solve`"]),
    (
        "plan box.tri --output a.csv",
        2,
        &["--output: is a flag of", "solve", "`radiosity help plan`"],
    ),
    ("--colour always", 2, &["--colour: is no flag", "did you mean --color?"]),
    // Values.
    ("solve box.tri --elements many", 2, &["--elements many: expected a whole number", "100"]),
    ("solve box.tri --light bright", 2, &["--light bright: expected a number"]),
    ("solve box.tri --error 7", 2, &["--error 7: expected a share from 0 to 1", "0.1%"]),
    ("solve box.tri --max-time soon", 2, &["--max-time soon: expected a time such as", "60s"]),
    ("solve box.tri --max-memory 4TB", 2, &["--max-memory 4TB: expected a size such as", "4GiB"]),
    (
        "solve box.tri --accel octre",
        2,
        &["--accel octre: expected auto, octree, bvh or none", "did you mean octree?"],
    ),
    ("solve box.tri --schedule multi", 2, &["--schedule multi: expected auto, single or multi:K"]),
    ("solve box.tri --loop spiral", 2, &["--loop spiral: ", "expected static, dynamic:N"]),
    ("solve box.tri --snapshot 5", 2, &["--snapshot 5: expected every:N, N shots, or a time"]),
    ("solve box.tri --elements -3", 2, &["-3: is taken for a flag", "below 0"]),
    ("solve box.tri -o", 2, &["--output: expected OUT after it"]),
    ("solve box.tri --log xml", 2, &["--log xml: expected text or json"]),
    // What goes together.
    (
        "solve box.tri -o a.csv --error 1% --elements 9",
        2,
        &["--e", "does not go with --e", "leave one out"],
    ),
    ("solve box.tri --light 1 --light 2", 2, &["--light: is given twice; leave one out"]),
    (
        "solve box.tri -o a.csv --max-elements 9 --elements 9",
        2,
        &["elements", "does not go with --"],
    ),
    ("compare a.csv", 2, &["compare: needs <B>", "`radiosity help compare`"]),
    ("compare a.csv b.csv c.csv", 2, &["c.csv: is one argument too many"]),
    ("solve box.tri", 2, &["nothing to write", "-o lit.glb"]),
    ("solve box.tri -o a.csv --no-statement", 2, &["--no-statement: ", "--elements"]),
    ("solve box.tri -o a.probe.csv", 2, &["-o NAME.probe.csv: name the places with --probe"]),
    ("solve box.tri -o a.csv --error 0", 2, &["--error: expected more than 0, such as 1%"]),
    // Files.
    ("solve box.tri -o a.txt", 2, &["-o a.txt: ", ".csv"]),
    ("solve box.tri -o box.tri", 2, &["box.tri: is what is read; name another file"]),
    ("solve box.tri -o no/a.csv", 1, &["no/a.csv: there is no folder no; make it first"]),
    ("solve bx.tri -o a.csv", 1, &["bx.tri: there is no such file; did you mean box.tri?"]),
    ("solve . -o a.csv", 1, &[".: is a folder, expected a file"]),
    ("compare gone.csv gone.csv", 1, &["gone.csv: there is no such file"]),
    ("solve gone.tri -o a.csv", 1, &["gone.tri: there is no such file"]),
    ("solve box.tri -o a.probe.csv --probe gone.csv", 1, &["gone.csv: there is no such file"]),
];

#[test]
fn each_mistake_is_one_line_with_a_remedy() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for (line, code, parts) in CASES {
        let run = radiosity(folder.path(), &line.split(' ').collect::<Vec<_>>());
        let said = run.stderr();
        assert_eq!(run.code(), *code, "{line}: {said}");
        let last = said.lines().last().unwrap_or_default();
        let mut rest =
            last.strip_prefix("radiosity: error: ").unwrap_or_else(|| panic!("{line}: {said}"));
        if *code == 2 {
            assert_eq!(said.lines().count(), 1, "{line}: {said}");
        }
        for part in *parts {
            let at = rest.find(part).unwrap_or_else(|| panic!("{line}: {part:?} in {said}"));
            rest = &rest[at + part.len()..];
        }
        assert_eq!(run.stdout(), "", "{line}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
}

#[test]
fn help_and_version_are_no_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    for (line, expected) in [
        ("help", "Usage: radiosity"),
        ("help solve", "--max-elements"),
        ("solve --help", "--max-elements"),
        ("--version", concat!("radiosity ", env!("CARGO_PKG_VERSION"))),
    ] {
        let run = radiosity(folder.path(), &line.split(' ').collect::<Vec<_>>());
        assert_eq!((run.code(), run.stderr().as_str()), (0, ""), "{line}");
        assert!(run.stdout().contains(expected), "{line}: {}", run.stdout());
    }
}
