//! Reads a `.tri` file from disk and says how fast.
//!
//! `cargo run --release -p radiosity-tri-io --example read_rate -- FILE.tri`, or without a file to make one
//! of about 100 MB in the folder for temporary files and read that, five times.

#![allow(clippy::print_stdout)] // a program, unlike the crate

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{env, process};

use tri_io::Reader;

/// Triangles of the file made, 130 bytes each.
const TRIANGLES: u32 = 770_000;

fn main() -> Result<(), Box<dyn Error>> {
    match env::args_os().nth(1) {
        Some(path) => measure(Path::new(&path)),
        None => {
            let path = env::temp_dir().join(format!("read_rate-{}.tri", process::id()));
            let result = make(&path).and_then(|()| (0..5).try_for_each(|_| measure(&path)));
            fs::remove_file(&path)?;
            result
        }
    }
}

fn measure(path: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = fs::metadata(path)?.len();
    let start = Instant::now();
    let mut count = 0_u64;
    for record in Reader::new(File::open(path)?) {
        record.map_err(|error| format!("{}:{error}", path.display()))?;
        count += 1;
    }
    let seconds = start.elapsed().as_secs_f64();
    let rate = bytes as f64 / 1e6 / seconds;
    println!("{count} records, {bytes} bytes in {seconds:.3} s: {rate:.0} MB/s");
    Ok(())
}

/// Writes triangles with six decimals a number, as C's `%f` makes them.
fn make(path: &PathBuf) -> Result<(), Box<dyn Error>> {
    let mut file = BufWriter::new(File::create(path)?);
    let mut state = 1_u32;
    let mut number = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) * 1000.0 - 500.0
    };
    for _ in 0..TRIANGLES {
        writeln!(file, "Triangle \n61 181 181 0 0 0")?;
        for _ in 0..3 {
            writeln!(file, "{:.6} {:.6} {:.6}", number(), number(), number())?;
        }
    }
    file.flush()?;
    Ok(())
}
