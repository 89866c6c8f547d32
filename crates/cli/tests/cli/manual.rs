//! Completions that shells understand, and manual pages that readers of manuals do.

#![expect(clippy::print_stdout, reason = "tests say that they are skipped")]

use std::process::{Command, Output};

use crate::support::radiosity;

/// Runs another program; `None` with a line where there is none.
fn other(program: &str, args: &[&str]) -> Option<Output> {
    match Command::new(program).args(args).output() {
        Ok(output) => Some(output),
        Err(error) => {
            println!("skipped: {program}: {error}");
            None
        }
    }
}

#[test]
fn bash_completes_commands_flags_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("radiosity.bash");
    let run = radiosity(folder.path(), &["completions", "bash"]);
    assert_eq!((run.code(), run.stderr().as_str()), (0, ""));
    std::fs::write(&script, run.stdout()).unwrap();
    let script = script.to_str().unwrap();
    let Some(checked) = other("bash", &["-n", script]) else { return };
    assert!(checked.status.success() && checked.stderr.is_empty(), "{checked:?}");
    for (typed, expected) in [
        ("so", vec!["solve"]),
        ("solve --elem", vec!["--elements"]),
        ("solve --accel oc", vec!["octree"]),
        ("completions f", vec!["fish"]),
    ] {
        // What a shell does at <TAB>.
        let words: Vec<&str> = typed.split(' ').collect();
        let (last, before) = (words[words.len() - 1], words.len());
        let previous = if before > 1 { words[before - 2] } else { "radiosity" };
        let line = format!(
            "source '{script}'; COMP_WORDS=(radiosity {typed}); COMP_CWORD={before}; \
             _radiosity radiosity '{last}' '{previous}'; echo \"${{COMPREPLY[@]}}\""
        );
        let Some(output) = other("bash", &["-c", &line]) else { return };
        let completed = String::from_utf8(output.stdout).unwrap();
        assert_eq!(completed.split_whitespace().collect::<Vec<_>>(), expected, "{typed}");
    }
}

#[test]
fn every_shell_gets_a_script_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let mut scripts = Vec::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = radiosity(folder.path(), &["completions", shell]);
        assert_eq!(run.code(), 0, "{shell}");
        assert!(run.stdout().contains("max-elements"), "{shell}");
        scripts.push(run.stdout());
    }
    scripts.sort();
    scripts.dedup();
    assert_eq!(scripts.len(), 5);
    let run = radiosity(folder.path(), &["completions", "bsh"]);
    assert_eq!(run.code(), 2);
    assert!(run.stderr().contains("did you mean bash?"), "{}", run.stderr());
}

#[test]
fn a_page_for_the_program_and_each_command() {
    let folder = tempfile::tempdir().unwrap();
    let run = radiosity(folder.path(), &["man", "-o", "."]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let help = radiosity(folder.path(), &["help"]).stdout();
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let commands = commands.take_while(|line| !line.is_empty());
    let names = commands.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: Vec<&str> = names.filter(|name| !name.is_empty() && *name != "help").collect();
    assert!(names.contains(&"solve") && names.contains(&"compare"), "{names:?}");
    let mut pages = vec!["radiosity.1".to_owned()];
    pages.extend(names.iter().map(|name| format!("radiosity-{name}.1")));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), pages.len());
    for page in &pages {
        let path = folder.path().join(page);
        let text = std::fs::read_to_string(&path).unwrap();
        for section in ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS"] {
            assert!(text.contains(&format!(".SH {section}\n")), "{page}: {section}");
        }
        let Some(output) = other("groff", &["-man", "-Tutf8", "-ww", path.to_str().unwrap()])
        else {
            return;
        };
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{page}: {said}");
    }
    let solve = std::fs::read_to_string(folder.path().join("radiosity-solve.1")).unwrap();
    assert!(solve.contains("max\\-elements"), "{solve}");
    // The program's alone goes to stdout.
    let page = radiosity(folder.path(), &["man"]).stdout();
    assert!(page.contains(".SH NAME") && page.contains("radiosity\\-solve(1)"), "{page}");
    let run = radiosity(folder.path(), &["man", "-o", "gone"]);
    assert!(run.code() == 1 && run.stderr().contains("gone: is no folder"), "{}", run.stderr());
}
