//! Texts, the records they hold, and the errors they give.

use std::error::Error as _;
use std::io::{self, Read};

use tri_io::{ErrorKind, Expected, Found, Reader};

use crate::support::{Dribble, read};

/// Nine coordinates, none special.
const NINE: &str = "1 2 3 4 5 6 7 8 9";

/// Reads `text` at once and in small pieces, and compares a summary: each record as its channels,
/// its vertices and `|` its normals, in shortest form, and the error if there is one.
#[track_caller]
fn check(text: impl AsRef<[u8]>, expected: &str) {
    let text = text.as_ref();
    assert_eq!(summary(text), expected);
    for seed in 1..4 {
        assert_eq!(summary(Dribble::new(text, seed)), expected, "in pieces");
    }
}

fn summary(source: impl Read) -> String {
    let (records, error) = read(source);
    let mut lines = Vec::new();
    for record in records {
        let mut words: Vec<String> =
            record.front.iter().chain(&record.back).map(ToString::to_string).collect();
        words.extend(record.vertices.as_flattened().iter().map(ToString::to_string));
        if let Some(normals) = record.normals {
            words.push("|".to_owned());
            words.extend(normals.as_flattened().iter().map(ToString::to_string));
        }
        lines.push(words.join(" "));
    }
    lines.extend(error.map(|error| error.to_string()));
    lines.join("\n")
}

#[test]
fn no_record() {
    check("", "");
    check(" \r\n\t\n", "");
    check("# nothing", "");
    check("# nothing\n\n", "");
}

#[test]
fn layouts_without_normals() {
    let expected = "101 102 103 0 1 255 -500 0.5 0 1 2 3 4 5 6";
    let same = |text: &str| check(text, expected);
    same("Triangle \n101 102 103 0 1 255\n-500.000000 0.500000 0.0\n1 2 3\n4 5 6\n");
    same("Triangle \r\n101 102 103 0 1 255\r\n-500.000000 0.5 0.0\r\n1 2 3\r\n4 5 6\r\n");
    same("Triangle \n101 102 103 0 1 255\n-500 .5 0.\n1 2 3\n4 5 6");
    same("Triangle 101 102 103 0 1 255 -500 0.5 0 1 2 3 4 5 6");
    same(
        "\n\n  Triangle\t101\n102\n103\n0\n1\n255\n-5e2\n5e-1\n-0e9\n1\n2\n3\n4\n5\n6\n\n"
            .replace("-0e9", "0e9")
            .as_str(),
    );
    same("Triangle\x0b101 102 103\x0c0 1 255 -500 0.5 0 1 2 3 4 5 6 \t\r\n");
    same("Triangle 101 102 103 0 1 255 -500 0.5 0\n1 2\n3 4 5 6");
    same("Triangle +101 0102 103 0 1 255 -0500 +0.50 0 1 2 3 4 5 6");
}

#[test]
fn layouts_with_normals() {
    let expected = "9 9 9 0 0 0 1 2 3 4 5 6 7 8 9 | 0 0 1 0 1 0 1 0 0";
    let same = |text: &str| check(text, expected);
    same("Triangle \n9 9 9 0 0 0\n1 2 3 0 0 1\n4 5 6 0 1 0\n7 8 9 1 0 0\n");
    same("Triangle 9 9 9 0 0 0 1 2 3 0 0 1 4 5 6 0 1 0 7 8 9 1 0 0");
    same("Triangle 9 9 9 0 0 0\n1 2 3\n0 0 1\n4 5 6\n0 1 0\n7 8 9\n1 0 0\n");
}

#[test]
fn each_record_decides_about_normals() {
    let plain = format!("Triangle 1 2 3 4 5 6\n{NINE}\n");
    let normal = "Triangle 1 2 3 4 5 6\n1 2 3 0 0 1\n4 5 6 0 0 1\n7 8 9 0 0 1\n";
    let (plain_out, normal_out) =
        ("1 2 3 4 5 6 1 2 3 4 5 6 7 8 9", "1 2 3 4 5 6 1 2 3 4 5 6 7 8 9 | 0 0 1 0 0 1 0 0 1");
    check(
        format!("{plain}{normal}{normal}{plain}"),
        &format!("{plain_out}\n{normal_out}\n{normal_out}\n{plain_out}"),
    );
    check(format!("{plain}{plain}").replace('\n', " "), &format!("{plain_out}\n{plain_out}"));
}

#[test]
fn comments() {
    check(
        format!("# a\nTriangle# b\n1 2 3#Triangle\n4 5 6 # c\n{NINE}#d\n#e"),
        "1 2 3 4 5 6 1 2 3 4 5 6 7 8 9",
    );
    check("# a\n # b\n  x", "3:3: expected `Triangle`, found \"x\"");
    // Longer than the reader's buffer.
    check(format!("#{}\nx", "c".repeat(600_000)), "2:1: expected `Triangle`, found \"x\"");
}

#[test]
fn keyword_errors() {
    check("triangle 1", "1:1: expected `Triangle`, found \"triangle\"");
    check("Triangles 1", "1:1: expected `Triangle`, found \"Triangles\"");
    check("Triangle1 2", "1:1: expected `Triangle`, found \"Triangle1\"");
    check("\n\t 7", "2:3: expected `Triangle`, found \"7\"");
    check("\u{feff}Triangle", "1:1: expected `Triangle`, found \"\\u{feff}Triangle\"");
    let first = format!("Triangle 1 2 3 4 5 6\n{NINE}\n");
    let record = "1 2 3 4 5 6 1 2 3 4 5 6 7 8 9";
    check(format!("{first}Quad 1"), &format!("{record}\n3:1: expected `Triangle`, found \"Quad\""));
}

#[test]
fn channel_errors() {
    let channel = |text: &str, place: &str, found: &str| {
        check(text, &format!("{place}: expected an integer from 0 to 255, found {found}"));
    };
    channel("Triangle", "1:9", "end of file");
    channel("Triangle\n", "2:1", "end of file");
    channel("Triangle 1 2 256", "1:14", "\"256\"");
    channel("Triangle\n\n 1 2 3 -1 5 6", "3:8", "\"-1\"");
    channel("Triangle 1 2 3 1.0", "1:16", "\"1.0\"");
    channel("Triangle 1 2 3 4 5\nTriangle", "2:1", "\"Triangle\"");
    channel("Triangle\r\n1 2 3 0x4", "2:7", "\"0x4\"");
    channel("Triangle 99999999999999999999999", "1:10", "\"99999999999999999999999\"");
}

#[test]
fn number_errors() {
    let number = |word: &str| {
        for index in 0..9 {
            let mut words: Vec<&str> = NINE.split(' ').collect();
            words[index] = word;
            let text = format!("Triangle 1 2 3 4 5 6\n{}\n", words.join(" "));
            let column = 2 * index + 1;
            check(text, &format!("2:{column}: expected a finite number, found {word:?}"));
        }
    };
    for word in [
        "nan", "NaN", "-nan", "inf", "-inf", "+INF", "infinity", "1e999", "-1e309", "1e", "1e+",
        "e1", ".", "-", "+", "-.", "--1", "+-1", "1.2.3", "1,5", "0x10", "1f", "1_0", "1e1.5", "١",
        "x", "NULL", "-x",
    ] {
        number(word);
    }
}

/// 2^1024 - 2^970 lies halfway between the largest f64 and what would follow it.
#[test]
fn the_range_ends_where_rounding_ends_it() {
    let halfway = "17976931348623158079372897140530341507993413271003782693617377898044496829276475\
        09466490179775872070963302864166928879109465555478519404026306574886715058206819\
        08902000708383676273854845817711531764475730270069855571366959622842914819860834\
        936475292719074168444365510704342711559699508093042880177904174497792";
    let text = |number: &str| format!("Triangle 1 2 3 4 5 6 {number} 2 3 4 5 6 7 8 9");
    let quoted = &halfway[..32];
    check(text(halfway), &format!("1:22: expected a finite number, found \"{quoted}…\""));
    let below = halfway.replace("792", "791");
    assert_eq!(read(text(&below).as_bytes()).0[0].vertices[0][0], f64::MAX);
}

#[test]
fn quotes_are_short_and_on_one_line() {
    check(
        b"Triangle \x00\xff\x1b[",
        "1:10: expected an integer from 0 to 255, found \"\\0\u{fffd}\\u{1b}[\"",
    );
    let long = "x".repeat(40);
    let quoted = "x".repeat(32);
    check(&long, &format!("1:1: expected `Triangle`, found \"{quoted}…\""));
    check("\"quoted\"", "1:1: expected `Triangle`, found \"\\\"quoted\\\"\"");
}

#[test]
fn long_words() {
    let with = |word: &str| format!("Triangle 1 2 3 4 5 6 1 2 3 {word} 5 6 7 8 9");
    // 4096 bytes pass, one more does not; nor does a word longer than the buffer.
    let fits = format!("4.{}", "0".repeat(4094));
    check(with(&fits), "1 2 3 4 5 6 1 2 3 4 5 6 7 8 9");
    let error = format!("expected a number of at most 4096 bytes, found \"4.{}…\"", "0".repeat(30));
    check(with(&format!("{fits}0")), &format!("1:28: {error}"));
    check(with(&format!("4.{}", "0".repeat(700_000))), &format!("1:28: {error}"));
    let zeros = "0".repeat(32);
    check(
        format!("Triangle {}", "0".repeat(5000)),
        &format!("1:10: expected an integer from 0 to 255, found \"{zeros}…\""),
    );
    let quoted = "T".repeat(32);
    check("T".repeat(700_000), &format!("1:1: expected `Triangle`, found \"{quoted}…\""));
}

#[test]
fn memory_does_not_grow_with_a_word() {
    // A terabyte of one letter: it is answered at once, or this test never ends.
    let error = Reader::new(io::repeat(b'7').take(1 << 40)).next().unwrap().unwrap_err();
    assert_eq!(error.column(), 1);
}

#[test]
fn too_few_numbers() {
    let head = "Triangle 1 2 3 4 5 6\n";
    for count in 0..9 {
        let place = format!("number {} of 9 (18 with normals)", count + 1);
        let text = format!("{head}{}", "0\n".repeat(count));
        let line = count + 2;
        check(&text, &format!("{line}:1: expected {place}, found end of file"));
        check(
            format!("{text}Triangle 1"),
            &format!("{line}:1: expected {place}, found \"Triangle\""),
        );
    }
}

#[test]
fn a_count_between_is_blamed_by_the_layout() {
    // The first vertex's line goes on, so normals are meant and some are missing.
    for count in 10..18 {
        let error = format!("expected number {} of 18 (vertices with normals), found", count + 1);
        let text = format!("Triangle 1 2 3 4 5 6\n{}\n", "0 ".repeat(count));
        check(&text, &format!("3:1: {error} end of file"));
        check(text + "Triangle", &format!("3:1: {error} \"Triangle\""));
    }
    // Each vertex has its own line, so a `Triangle` is missing before the fourth.
    let text = "Triangle 1 2 3 4 5 6\n1 2 3\n4 5 6\n7 8 9\n";
    check(format!("{text}77 2"), "5:1: expected `Triangle`, found \"77\"");
    check(format!("{text}77 2 3\nTriangle"), "5:1: expected `Triangle`, found \"77\"");
}

#[test]
fn too_many_numbers() {
    let text = "Triangle 1 2 3 4 5 6\n1 2 3 0 0 1\n4 5 6 0 0 1\n7 8 9 0 0 1\n";
    check(format!("{text} 77 2"), "5:2: expected `Triangle`, found \"77\"");
    let missing =
        "Triangle 1 2 3 4 5 6\n1 2 3\n4 5 6\n7 8 9\n11 12 13 0 0 0\n1 2 3\n4 5 6\n7 8 9\n";
    check(missing, "5:1: expected `Triangle`, found \"11\"");
    let line = format!("Triangle 1 2 3 4 5 6 {NINE} {NINE} 10");
    check(line, "1:58: expected `Triangle`, found \"10\"");
}

#[test]
fn a_bad_number_after_nine() {
    let text = format!("Triangle 1 2 3 4 5 6 {NINE}");
    check(format!("{text} nan"), "1:40: expected a finite number, found \"nan\"");
    check(format!("{text} 1 x"), "1:42: expected a finite number, found \"x\"");
}

#[test]
fn error_kinds() {
    let kind_of = |text: &str| match read(text.as_bytes()).1.unwrap().kind() {
        ErrorKind::Unexpected { expected, found } => (*expected, found.clone()),
        other => panic!("{other:?}"),
    };
    let word = |text: &str| Found::Word(text.to_owned());
    assert_eq!(kind_of("x"), (Expected::Keyword, word("x")));
    assert_eq!(kind_of("Triangle x"), (Expected::Channel, word("x")));
    assert_eq!(kind_of("Triangle 1 2 3 4 5 6 x"), (Expected::Number, word("x")));
    assert_eq!(kind_of("Triangle 1 2 3 4 5 6 1"), (Expected::Coordinate(2), Found::EndOfFile));
}

#[test]
fn a_failing_source_is_reported_where_it_failed() {
    struct Failing;
    impl Read for Failing {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("unplugged"))
        }
    }
    let text = format!("Triangle 1 2 3 4 5 6\n{NINE}\nTriangle\n 1 2");
    let mut reader = Reader::new(text.as_bytes().chain(Failing));
    assert!(reader.next().unwrap().is_ok());
    let error = reader.next().unwrap().unwrap_err();
    assert_eq!(error.to_string(), "4:4: cannot read on: unplugged");
    assert!(matches!(error.kind(), ErrorKind::Io(_)));
    assert_eq!(error.source().unwrap().to_string(), "unplugged");
    assert!(reader.next().is_none());
}

#[test]
fn the_iterator_ends_after_an_error() {
    let mut reader = Reader::new("x Triangle 1 2 3 4 5 6 1 2 3 4 5 6 7 8 9".as_bytes());
    assert!(reader.next().unwrap().is_err());
    assert!(reader.next().is_none());
    assert!(reader.next().is_none());
}

#[test]
fn line_is_where_the_record_began() {
    let text = format!("\n# c\nTriangle\n1 2 3 4 5 6 {NINE}\n\n  Triangle\n\n1 2 x");
    let mut reader = Reader::new(text.as_bytes());
    assert!(reader.next().unwrap().is_ok());
    assert_eq!(reader.line(), 3);
    assert_eq!(reader.next().unwrap().unwrap_err().line(), 8);
    assert_eq!(reader.line(), 6);
}

/// The table of errors in `docs/tri-format.md`.
#[test]
fn examples_of_the_format_page() {
    let head = "Triangle\n61 181 181 0 0 0\n";
    let plain = format!("{head}1 2 3\n4 5 6\n7 8 9\n");
    check("triangle 61", "1:1: expected `Triangle`, found \"triangle\"");
    check("Triangle 61 181 300 0 0 0", "1:17: expected an integer from 0 to 255, found \"300\"");
    check(format!("{head}1 2 nan\n"), "3:5: expected a finite number, found \"nan\"");
    check(
        format!("{head}1 2 3\n4 5 6\n"),
        "5:1: expected number 7 of 9 (18 with normals), found end of file",
    );
    check(
        format!("{head}1 2 3 0 0 1\n4 5 6 0 0 1\n7 8 9 0 0\n{plain}"),
        "6:1: expected number 18 of 18 (vertices with normals), found \"Triangle\"",
    );
    check(
        plain.clone() + plain.strip_prefix("Triangle\n").unwrap(),
        "6:1: expected `Triangle`, found \"61\"",
    );
}

/// A file with normals that is cut after nine numbers must not pass as one without.
#[test]
fn six_numbers_on_a_line_of_their_own_are_a_vertex_and_its_normal() {
    let text = "Triangle\n1 2 3 4 5 6\n1 2 3 0 0 1\n4 5 6";
    check(text, "4:6: expected number 10 of 18 (vertices with normals), found end of file");
    check(
        format!("{text}\nTriangle"),
        "5:1: expected number 10 of 18 (vertices with normals), found \"Triangle\"",
    );
    check("Triangle 1 2 3 4 5 6 1 2 3 0 0 1\n4 5 6", "1 2 3 4 5 6 1 2 3 0 0 1 4 5 6");
    check("Triangle\n1 2 3 4 5 6\n1 2 3 0 0\n1 4 5 6", "1 2 3 4 5 6 1 2 3 0 0 1 4 5 6");
}

/// Cut anywhere, a text gives its first records and then an error, unless the cut lies between
/// records, or within the last number of one, where nothing can tell.
#[test]
fn truncation_never_panics_and_hardly_ever_passes() {
    let records = [
        "Triangle \r\n255 0 17 0 0 0\r\n1 2 3\r\n4 5 6\r\n7 8 -9.25",
        "Triangle 1 2 3 4 5 6\n1.5 2e1 3 0 0 1\n4 5 6 0 0 1\n7 8 9 0 0 -1",
        "Triangle 1 2 3 4 5 6\n-1 2 3\n4 5 6\n7 8 99",
    ];
    let text = records.join("\r\n");
    let (whole, error) = read(text.as_bytes());
    assert_eq!((whole.len(), error.is_none()), (3, true));

    for length in 0..text.len() {
        let (read, error) = read(&text.as_bytes()[..length]);
        let mut start = 0;
        for (index, record) in records.iter().enumerate() {
            let end = start + record.len();
            let last_number = start + record.rfind(' ').unwrap() + 1;
            if length >= end {
                assert_eq!(read[index], whole[index], "cut at {length}");
            } else if length > start {
                let number_cut = length > last_number && !text[..length].ends_with(['-', '.']);
                // "-9." is a number, "-" is none.
                let number_cut = number_cut || text[..length].ends_with("-9.");
                assert_eq!(error.is_none(), number_cut, "cut at {length}: {error:?}");
                assert_eq!(read.len(), index + usize::from(number_cut), "cut at {length}");
            }
            start = end + "\r\n".len();
        }
    }
}
