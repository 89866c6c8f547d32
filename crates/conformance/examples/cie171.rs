//! Rooms whose light has a published formula: the table of docs/cie171.md.
//!
//! `cargo run --release -p radiosity-conformance --example cie171`: what the formula says, what the solver says,
//! how far they are apart and how far they may be.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use conformance::{Error, cie171};

fn main() -> Result<(), Error> {
    print(&cie171::comparisons()?);
    println!("\n## Weak: one rectangle for a sky, cells of the solver's own choice");
    print(&cie171::weak()?);
    Ok(())
}

fn print(rows: &[cie171::Comparison]) {
    let mut last = "";
    for row in rows {
        if row.case != last {
            println!("\n### {}\n", row.case);
            println!("| where | expected | got | difference | tolerance | formula |");
            println!("|---|---|---|---|---|---|");
            last = row.case;
        }
        println!(
            "| {} | {:.4} | {:.4} | {:.3} % | {:.1} % | {} |",
            row.place,
            row.expected,
            row.got,
            100.0 * row.error(),
            100.0 * row.tolerance,
            row.source
        );
    }
}
