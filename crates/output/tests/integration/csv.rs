//! Rows out and rows in.

use output::csv::Places;
use output::csv::{self, Row, read, rows};
use output::{ErrorKind, Format, Options};
use scene::Rgb;

use crate::common::{bytes, shared, square};

#[test]
fn two_triangles_are_written_to_the_letter() {
    let lit = square(Rgb::new(0.1, 2.0, 1e-9));
    let text = String::from_utf8(bytes(Format::Csv, &lit, &Options::default())).unwrap();
    assert_eq!(text, "triangle,area,B_r,B_g,B_b\n0,1,0.1,2,1e-9\n1,1,0.1,2,1e-9\n");
}

#[test]
fn every_number_reads_back_to_the_same_bits() {
    for light in [Rgb::new(0.1 + 0.2, 1.0 / 3.0, 1e300), Rgb::new(5e-324, 0.0, 254.999)] {
        let lit = square(light);
        let back = read(bytes(Format::Csv, &lit, &Options::default()).as_slice()).unwrap();
        assert_eq!(back, rows(&lit.0, &lit.1).unwrap());
        // Area 1 and equal elements: the mean is the value itself.
        assert_eq!(back[1].exitance.0.map(f64::to_bits), light.0.map(f64::to_bits));
    }
}

#[test]
fn columns_go_by_name_in_any_order() {
    let text = "ambiguous,B_b,note,B_g,B_r,se_b,se_g,se_r,area,triangle,emits\r\n\
                0,3,x,2,1,0.3,0.2,0.1,4.5,7,1\r\n";
    let expected = Row {
        uv: None,
        triangle: 7,
        area: 4.5,
        exitance: Rgb::new(1.0, 2.0, 3.0),
        se: Some(Rgb::new(0.1, 0.2, 0.3)),
        emits: true,
        ambiguous: false,
    };
    assert_eq!(read(text.as_bytes()).unwrap(), [expected]);
}

#[test]
fn errors_name_line_and_column() {
    let header = "triangle,area,B_r,B_g,B_b,emits";
    let cases: [(String, &str); 12] = [
        (String::new(), "1:1: expected a first line that names the columns"),
        ("triangle,area,B_r,B_g".into(), "1:22: expected a column named B_b"),
        (format!("{header},area"), "1:33: a second column named area"),
        (format!("{header},se_r"), "1:37: expected a column named se_g beside the others"),
        (format!("{header}\n0,1,x,4,5,0"), "2:5: B_r: expected a finite number, found \"x\""),
        (format!("{header}\n0,1,2,inf,5,0"), "2:7: B_g: expected a finite number, found \"inf\""),
        (
            format!("{header}\n0,-1,2,3,5,0"),
            "2:3: area: expected a number of at least 0, found \"-1\"",
        ),
        (format!("{header}\n0,1,2,3,4,yes"), "2:11: emits: expected 0 or 1, found \"yes\""),
        (
            format!("{header}\n0,1,2,3,4,0\n-1,1,2,3,4,0"),
            "3:1: triangle: expected a triangle's number, found \"-1\"",
        ),
        (format!("{header}\n0,1,2,3,4"), "2:10: 5 values for 6 columns"),
        (format!("{header}\n0,1,2,3,4,0,ä,7"), "2:13: 8 values for 6 columns"),
        (format!("é,{header}\né,0,1,2,,4,0"), "2:9: B_g: expected a finite number, found \"\""),
    ];
    for (text, message) in cases {
        assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), message, "{text}");
    }
    let error = read(&b"triangle,area,B_r,B_g,B_b\n0,\xff"[..]).unwrap_err();
    assert_eq!(error.to_string(), "2:3: expected UTF-8 text");
    assert!(matches!(error.kind(), ErrorKind::Text { line: 2, column: 3, .. }));
    assert_eq!(error.at("a.csv").to_string(), "a.csv:2:3: expected UTF-8 text");
}

#[test]
fn reads_the_references() {
    let counts = [("cornell", 32, 30), ("room_onesided", 156, 116), ("blocks_onesided", 464, 456)];
    for (name, all, used) in counts {
        let Some(path) = shared(&format!("reference/{name}.csv")) else { return };
        let rows = read(std::fs::File::open(path).unwrap()).unwrap();
        assert_eq!(rows.len(), all);
        let error = output::compare(&rows, &rows).unwrap();
        // The counts are those of rows without either mark, by another tool.
        assert_eq!((error.worst_e1(), error.rows_used), (0.0, used), "{name}");
    }
}

#[test]
fn places_are_read_carried_and_compared() {
    let text = "u,v,B_r,triangle,area\n0.25,0.5,9,3,2\n0,1,9,0,1\n";
    let places = csv::read_places(text.as_bytes()).unwrap();
    let expected = [
        csv::Place { triangle: 3, uv: [0.25, 0.5], area: Some(2.0) },
        csv::Place { triangle: 0, uv: [0.0, 1.0], area: Some(1.0) },
    ];
    assert_eq!(places, Places::Surface(expected.to_vec()));
    let (leaves, arrives) = ([Rgb::new(1.0, 2.0, 0.1), Rgb::ZERO], [Rgb::splat(4.0), Rgb::ZERO]);
    let mut out = Vec::new();
    csv::write_probes(&mut out, &places, &leaves, &arrives).unwrap();
    let written = String::from_utf8(out.clone()).unwrap();
    assert_eq!(
        written,
        "triangle,u,v,area,B_r,B_g,B_b,E_r,E_g,E_b\n\
         3,0.25,0.5,2,1,2,0.1,4,4,4\n0,0,1,1,0,0,0,0,0,0\n"
    );
    let rows = read(out.as_slice()).unwrap();
    assert_eq!(rows[1].uv, Some([0.0, 1.0]));
    let mut elsewhere = rows.clone();
    elsewhere[0].uv = Some([0.25, 0.4]);
    let message = output::compare(&rows, &elsewhere).unwrap_err().to_string();
    assert_eq!(message, "row 0: u, v [0.25, 0.5] against [0.25, 0.4] in the reference");
}

#[test]
fn a_line_without_end_is_refused() {
    // Memory would end before such a source does.
    let head = "triangle,area,B_r,B_g,B_b\n".as_bytes();
    let endless = || std::io::Read::chain(head, std::io::repeat(b','));
    let error = read(endless()).unwrap_err();
    assert_eq!(error.to_string(), "2:1: expected a line of less than 1048576 bytes");
    assert!(csv::read_places(endless()).is_err());
    let long = format!("triangle,area,B_r,B_g,B_b,{}\n", "x".repeat(1_000_000));
    assert_eq!(read(long.as_bytes()).unwrap(), []);
}

#[test]
fn places_outside_their_triangle_are_refused() {
    for (text, expected) in [
        ("triangle,u,v\n0,0.6,0.6\n", "2:7: v: expected u + v of at most 1, found \"0.6\""),
        ("triangle,u,v\n0,-1,0\n", "2:3: u: expected a number of at least 0, found \"-1\""),
        ("triangle,u\n", "1:11: expected a column named v"),
        ("", "1:1: expected a first line that names the columns"),
        ("x,y,z,nx,ny\n", "1:12: expected a column named nz"),
        (
            "x,y,z,nx,ny,nz\n1,2,3,0,-0,0\n",
            "2:12: nz: expected a normal of some length, found \"0\"",
        ),
        ("x,y,z,nx,ny,nz\n1,2,3,0,0\n", "2:10: 5 values for 6 columns"),
        ("x,y,z,nx,ny,nz,x\n", "1:16: a second column named x"),
    ] {
        let error = csv::read_places(text.as_bytes()).unwrap_err();
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn places_in_the_open_have_a_direction_and_no_exitance() {
    let text = "nz,x,y,z,nx,ny,name\n3e200,0.1,-2,1e3,0,4e200,desk\n";
    let places = csv::read_places(text.as_bytes()).unwrap();
    let Places::Free(free) = &places else { panic!("{places:?}") };
    assert_eq!(free[0].position, [0.1, -2.0, 1e3]);
    // 3, 4, 5.
    let off =
        free[0].normal.into_iter().zip([0.0, 0.8, 0.6]).map(|(a, b): (f64, f64)| (a - b).abs());
    assert!(off.into_iter().all(|d| d <= f64::EPSILON), "{free:?}");
    let mut out = Vec::new();
    csv::write_places(&mut out, &places).unwrap();
    assert_eq!(csv::read_places(out.as_slice()).unwrap(), places);
    let mut out = Vec::new();
    csv::write_probes(&mut out, &places, &[Rgb::ZERO], &[Rgb::new(7.0, 8.0, 9.5)]).unwrap();
    let written = String::from_utf8(out).unwrap();
    let [first, row] = written.lines().collect::<Vec<_>>()[..] else { panic!("{written}") };
    assert_eq!(first, "x,y,z,nx,ny,nz,E_r,E_g,E_b");
    assert!(row.starts_with("0.1,-2,1000,0,") && row.ends_with(",7,8,9.5"), "{row}");
    // With a triangle they would be places on surfaces, whose columns must all be there.
    let error = csv::read_places("triangle,x,y,z,nx,ny,nz\n".as_bytes()).unwrap_err();
    assert_eq!(error.to_string(), "1:24: expected a column named u");
}
