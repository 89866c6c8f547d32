//! What is served, to whom, and that stop and slow readers leave the work as it is.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use crate::reader::{ask, ask_as, next};
use crate::support::{box_tri, folder_with, radiosity};
use crate::watched::Watched;

/// Hours of work on one mesh; a frame has 15 MB, more than sockets hold while nobody reads.
const LONG: [&str; 8] = [
    "solve",
    "box.tri",
    "--elements",
    "200000",
    "--no-statement",
    "--converge",
    "1e-9",
    "--schedule=single",
];

#[test]
fn only_who_knows_the_token_sees_light_and_it_grows_until_stop() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = [&LONG[..], &["-o", "a.csv", "-o", "a.html"]].concat();
    let watched = Watched::start(folder.path(), &args);
    let (port, token) = (watched.port, watched.token.clone());
    assert_eq!(token.len(), 32);
    let other = Watched::start(folder.path(), &[&LONG[..], &["-o", "b.csv"]].concat());
    assert_ne!(other.token, token, "a new one for each run");
    drop(other);

    for path in ["/", "/favicon.ico", "/light?after=0", "/00000000000000000000000000000000/"] {
        assert_eq!(ask(port, "GET", path).status, 404, "{path}");
    }
    assert_eq!(ask(port, "POST", "/stop").status, 404);
    let page = format!("/{token}/");
    assert_eq!(ask_as(port, "evil.example", "GET", &page).status, 403);
    assert_eq!(ask_as(port, "evil.example", "POST", &format!("/{token}/stop")).status, 403);
    assert_eq!(ask(port, "GET", &format!("/{token}/stop")).status, 405);
    let answer = ask(port, "GET", &page);
    assert_eq!(answer.status, 200);
    assert!(answer.head.contains("Referrer-Policy: no-referrer"), "{}", answer.head);
    let text = String::from_utf8(answer.body).unwrap();
    assert!(text.starts_with("<!doctype html>") && text.contains("connect-src 'self'"));

    // Who asks and reads nothing has more in its way than a socket holds.
    let mut slow = TcpStream::connect(("127.0.0.1", port)).unwrap();
    write!(slow, "GET /{token}/light?after=0 HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n").unwrap();

    let first = next(port, &token, 0);
    let mut last = next(port, &token, first.number());
    for _ in 0..3 {
        let frame = next(port, &token, last.number());
        assert!(frame.number() > last.number());
        assert_eq!(frame.progress["elements"], first.progress["elements"]);
        assert!(frame.power > last.power, "{} {}", frame.power, last.power);
        let unshot = |f: &crate::reader::Frame| f.progress["unshot"].as_f64().unwrap();
        assert!(unshot(&frame) < unshot(&last));
        last = frame;
    }

    assert_eq!(ask(port, "POST", &format!("/{token}/stop")).status, 204);
    let clock = Instant::now();
    let (code, said) = watched.end();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("interrupted") && said.contains("written: a.csv, a.html"), "{said}");
    // Its end waits for readers, the slow one among them, but not for long.
    assert!(clock.elapsed() < Duration::from_secs(30), "{:?}", clock.elapsed());
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert_eq!(table.lines().count(), 13);
    // What the slow reader was given was cut short: it was still in its way.
    let mut given = Vec::new();
    let _ = slow.read_to_end(&mut given);
    // Eighteen numbers of four bytes an element, at least.
    let whole = 72 * first.progress["elements"].as_u64().unwrap();
    assert!((given.len() as u64) < whole, "{} of {whole}", given.len());
    // It closes with the run.
    assert!(TcpStream::connect(("127.0.0.1", port)).is_err());
}

#[test]
fn being_watched_changes_no_byte_and_the_last_frame_is_the_light() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--error", "3%", "-o"];
    let run = radiosity(folder.path(), &[&args[..], &["plain.csv"]].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let watched = Watched::start(folder.path(), &[&args[..], &["watched.csv"]].concat());
    let mut frames = 0;
    let mut frame = next(watched.port, &watched.token, 0);
    while frame.progress["done"] == false {
        frames += 1;
        frame = next(watched.port, &watched.token, frame.number());
    }
    let (code, said) = watched.end();
    assert_eq!(code, Some(0), "{said}");
    assert!(frames > 2, "{frames}");
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("plain.csv") == bytes("watched.csv"));
    // Power is area times exitance, in the table as in the frame, there in another unit of length:
    // the cube of side 2 has radius √3, and 2 is the power of two above it.
    let table = String::from_utf8(bytes("plain.csv")).unwrap();
    let rows = table
        .lines()
        .skip(1)
        .map(|row| -> Vec<f64> { row.split(',').map(|cell| cell.parse().unwrap()).collect() });
    let power: f64 = rows.map(|row| row[1] * (row[2] + row[3] + row[4])).sum::<f64>() / 4.0;
    // Single precision.
    assert!((frame.power - power).abs() < 1e-5 * power, "{} {power}", frame.power);
}

#[test]
fn a_port_that_is_taken_is_said_before_the_work() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let args = ["solve", "box.tri", "-o", "a.csv", "--live", "--live-port", &port];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 1, "{}", run.stderr());
    let said = run.stderr();
    assert!(
        said.lines().last().unwrap().contains(&format!("--live: 127.0.0.1:{port}: ")),
        "{said}"
    );
    assert!(!folder.path().join("a.csv").exists());
}
