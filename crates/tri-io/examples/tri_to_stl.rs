//! Turns a .tri file of any length into ASCII STL, one record at a time.
//!
//! `cargo run -p radiosity-tri-io --example tri_to_stl [-- SCENE.tri [OUT.stl]]`
//!
//! Without arguments: the bundled hall, into the folder for temporary files. No more than one record
//! is held at a time, so memory does not grow with the file. STL keeps neither colours nor lamps, and
//! asks for a normal, which the winding gives. Numbers are the shortest text of their f64, so what was
//! written is read back and compared bit for bit; exit code 1 if a bit is missing.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

use tri_io::{FloatBuffer, Reader, write_f64};

type Triple = [f64; 3];
type Corners = Result<[Triple; 3], Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/hall.tri");
    let source = arguments.next().unwrap_or(bundled);
    let target = arguments.next().unwrap_or_else(|| std::env::temp_dir().join("tri_to_stl.stl"));

    // Beside its place first: an error in the last record must not leave half a file.
    let beside = target.with_extension("stl.part");
    let written = convert(&source, &beside).and_then(|facets| {
        compare(&source, &beside)?;
        fs::rename(&beside, &target)?;
        Ok(facets)
    });
    if written.is_err() {
        // It may not be there; what went wrong is said already.
        let _ = fs::remove_file(&beside);
    }
    println!("{} facets in {}: every coordinate kept its bits", written?, target.display());
    Ok(())
}

/// The corners of each record of a file, or an error that names the file.
fn records(path: &Path) -> Result<impl Iterator<Item = Corners>, Box<dyn Error>> {
    let name = path.display().to_string();
    let file = File::open(path).map_err(|error| format!("{name}: {error}"))?;
    let located = move |error: tri_io::Error| format!("{name}:{error}").into();
    Ok(Reader::new(file).map(move |record| record.map(|r| r.vertices).map_err(&located)))
}

fn convert(source: &Path, target: &Path) -> Result<u64, Box<dyn Error>> {
    let mut out = BufWriter::new(File::create(target)?);
    let mut facets = 0;
    writeln!(out, "solid tri")?;
    for corners in records(source)? {
        let corners = corners?;
        writeln!(out, "facet normal {}\nouter loop", text(normal(corners)))?;
        for corner in corners {
            writeln!(out, "vertex {}", text(corner))?;
        }
        writeln!(out, "endloop\nendfacet")?;
        facets += 1;
    }
    writeln!(out, "endsolid tri")?;
    out.flush()?;
    Ok(facets)
}

fn text(triple: Triple) -> String {
    let mut buffer = FloatBuffer::new();
    triple.map(|number| write_f64(number, &mut buffer).to_owned()).join(" ")
}

/// The unit normal by the winding; zero, as STL has it, where there is none.
fn normal([a, b, c]: [Triple; 3]) -> Triple {
    let [u, v] = [b, c].map(|end| [0, 1, 2].map(|i| end[i] - a[i]));
    let n = [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { n.map(|x| x / length) } else { [0.0; 3] }
}

/// Reads both files side by side, one corner at a time.
fn compare(source: &Path, stl: &Path) -> Result<(), Box<dyn Error>> {
    let mut lines = BufReader::new(File::open(stl)?).lines().enumerate();
    for corners in records(source)? {
        for corner in corners? {
            let (number, line) = lines
                .find(|(_, line)| line.as_ref().map_or(true, |line| line.starts_with("vertex ")))
                .ok_or("the STL file has fewer corners than the .tri file")?;
            let line = line?;
            let words = line.split(' ').skip(1).map(str::parse);
            let back: Vec<f64> = words.collect::<Result<_, _>>()?;
            if !back.iter().map(|x| x.to_bits()).eq(corner.iter().map(|x| x.to_bits())) {
                return Err(format!("line {}: {back:?}, expected {corner:?}", number + 1).into());
            }
        }
    }
    match lines.any(|(_, line)| line.is_ok_and(|line| line.starts_with("vertex "))) {
        true => Err("the STL file has more corners than the .tri file".into()),
        false => Ok(()),
    }
}
