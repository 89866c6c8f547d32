//! What a terminal shows: a bar below whole lines, and colours where they are wanted.

use std::fs::File;
use std::io::Read;
use std::os::fd::FromRawFd;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::support::{box_tri, folder_with, radiosity};

/// A terminal of its own: the end that the program writes to, and the end that shows it.
fn terminal() -> (File, File) {
    let (mut shown, mut written) = (-1, -1);
    let mut size = libc::winsize { ws_row: 40, ws_col: 160, ws_xpixel: 0, ws_ypixel: 0 };
    // SAFETY: the numbers and the size live longer than the call, and null asks for no name and no modes.
    #[expect(unsafe_code, reason = "std makes no terminals")]
    let made = unsafe {
        libc::openpty(
            &raw mut shown,
            &raw mut written,
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            &raw mut size,
        )
    };
    assert_eq!(made, 0, "{}", std::io::Error::last_os_error());
    // SAFETY: both are open, and nobody else has them.
    #[expect(unsafe_code, reason = "std takes no numbers but so")]
    unsafe {
        (File::from_raw_fd(shown), File::from_raw_fd(written))
    }
}

/// All that a terminal gets as stderr of the program.
fn on_terminal(folder: &Path, args: &[&str], variables: &[(&str, &str)]) -> String {
    let (code, text) = run_on_terminal(folder, args, variables);
    assert_eq!(code, 0, "{text}");
    text
}

/// The exit code, and all that a terminal gets as stderr of the program.
fn run_on_terminal(folder: &Path, args: &[&str], variables: &[(&str, &str)]) -> (i32, String) {
    let (mut shown, written) = terminal();
    let mut command = Command::new(env!("CARGO_BIN_EXE_radiosity"));
    command.current_dir(folder).args(args).stdin(Stdio::null()).stdout(Stdio::null());
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(name);
    }
    command.env("TERM", "xterm").envs(variables.iter().copied()).stderr(written);
    let mut child = command.spawn().unwrap();
    drop(command);
    let mut bytes = Vec::new();
    let mut some = [0; 4096];
    // A terminal whose program is gone is an error to read, on Linux.
    while let Ok(n) = shown.read(&mut some)
        && n > 0
    {
        bytes.extend(&some[..n]);
    }
    (child.wait().unwrap().code().unwrap(), String::from_utf8(bytes).unwrap())
}

/// What a terminal shows in the end of what it got, as far as bars and colours need.
fn shown(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let (mut row, mut column) = (0, 0);
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '\r' => column = 0,
            '\n' => {
                row += 1;
                if row == lines.len() {
                    lines.push(String::new());
                }
            }
            '\u{1b}' => {
                assert_eq!(rest.next(), Some('['), "{text:?}");
                let mut number = String::new();
                while let Some(digit) = rest.next_if(|c| c.is_ascii_digit() || ";?".contains(*c)) {
                    number.push(digit);
                }
                let count = number.parse().unwrap_or(1);
                match rest.next() {
                    Some('A') => row -= count.min(row),
                    Some('B') => row += count,
                    Some('K') if number == "2" => lines[row].clear(),
                    Some('K') => lines[row] = lines[row].chars().take(column).collect(),
                    Some('J') => lines.truncate(row + 1),
                    Some('m' | 'h' | 'l') => {}
                    other => panic!("{number} {other:?} in {text:?}"),
                }
            }
            c => {
                let mut line: Vec<char> = lines[row].chars().collect();
                line.resize(line.len().max(column + 1), ' ');
                line[column] = c;
                lines[row] = line.into_iter().collect();
                column += 1;
            }
        }
    }
    lines
        .into_iter()
        .map(|line| line.trim_end().to_owned())
        .filter(|line| !line.is_empty())
        .collect()
}

/// A line without what differs from run to run: the times at its end.
fn timeless(line: &str) -> String {
    match line {
        line if line.starts_with("time: ") => "time:".into(),
        line if line.contains(" elements: ") => line.rsplit_once(", ").unwrap().0.to_owned(),
        line => line.to_owned(),
    }
}

const SOLVE: [&str; 8] =
    ["solve", "box.tri", "--error", "2%", "--need", "everything", "-o", "a.csv"];

#[test]
fn a_bar_stands_below_whole_lines_and_goes_away() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let light = || std::fs::read(folder.path().join("a.csv")).unwrap();
    let plain = radiosity(folder.path(), &SOLVE).stderr();
    let expected = light();
    let got = on_terminal(folder.path(), &SOLVE, &[]);
    assert!(light() == expected, "a bar changes no byte");
    for part in ["level 2, ", ": shooting, unshot ", " segments/s", "about "] {
        assert_eq!(got.contains(part), cfg!(feature = "progress"), "{part}: {got:?}");
    }
    let lines: Vec<String> = shown(&got).iter().map(|line| timeless(line)).collect();
    assert_eq!(lines, plain.lines().map(timeless).collect::<Vec<_>>(), "{got:?}");
    // A failure takes it away, too.
    std::fs::write(folder.path().join("cut.tri"), "Triangle\n").unwrap();
    let (code, got) = run_on_terminal(folder.path(), &["solve", "cut.tri", "-o", "b.csv"], &[]);
    let lines = shown(&got);
    assert!(code == 1 && lines.len() == 1, "{got:?}");
    assert!(lines[0].starts_with("radiosity: error: cut.tri:"), "{got:?}");
    // Quiet, as objects and on a terminal that cannot move: no bar.
    let quiet = on_terminal(folder.path(), &[&SOLVE[..], &["-q"]].concat(), &[]);
    assert_eq!(quiet, "");
    for (flags, variables) in
        [(&["--log", "json"][..], &[][..]), (&["--color", "never"], &[("TERM", "dumb")])]
    {
        let got = on_terminal(folder.path(), &[&SOLVE[..], flags].concat(), variables);
        assert!(!got.contains('\u{1b}') && !got.contains("segments/s,"), "{flags:?}: {got:?}");
    }
}

#[test]
fn colours_are_for_terminals_unless_asked_otherwise() {
    let dark = box_tri().replace("255 255 255", "0 0 0");
    let (folder, _) = folder_with("dark.tri", dark.as_bytes());
    std::fs::write(folder.path().join("box.tri"), box_tri()).unwrap();
    let dark = ["solve", "dark.tri", "-o", "a.csv", "--color"];
    let with = |args: &[&'static str], when: &'static str| [args, &[when]].concat();
    let (yellow, bold) = ("\u{1b}[33m", "\u{1b}[1m");
    let warned = on_terminal(folder.path(), &with(&dark, "auto"), &[]);
    assert!(warned.contains(yellow), "{warned:?}");
    let none = on_terminal(folder.path(), &with(&dark, "auto"), &[("NO_COLOR", "1")]);
    assert!(!none.contains(yellow) && none.contains("warning: nothing emits"), "{none:?}");
    let never = on_terminal(folder.path(), &with(&dark, "never"), &[]);
    assert!(!never.contains(yellow), "{never:?}");
    let key = on_terminal(folder.path(), &SOLVE, &[]);
    assert!(key.contains(bold) && !key.contains(yellow), "{key:?}");
    // Not on a terminal.
    let piped = |args: &[&str]| radiosity(folder.path(), args).stderr();
    assert!(!piped(&with(&dark, "auto")).contains('\u{1b}'));
    assert!(piped(&with(&dark, "always")).contains(yellow));
    let red = "\u{1b}[31m";
    assert!(piped(&["--color", "always", "solv"]).contains(red));
    assert!(!piped(&["solv"]).contains('\u{1b}'));
    assert!(!piped(&["--color", "always", "--log", "json", "solv"]).contains('\u{1b}'));
    // Help, too.
    let help = |when| radiosity(folder.path(), &["--color", when, "help", "solve"]).stdout();
    assert!(help("always").contains(bold) && !help("auto").contains('\u{1b}'));
}
