//! Rows as text.

use std::fmt::Write;

use crate::{Kind, Row};

const HEAD: &str = "\
| scene | segments | structure | best, M/s | median, M/s | of accel-bvh-batch | build, µs/triangle \
| bytes/triangle | differ, per million |
|---|---|---|---:|---:|---:|---:|---:|---:|
";

const CSV_HEAD: &str = "scene,triangles,kind,structure,segments,blocked,disagreements,runs,best_s,\
                        median_s,build_s,bytes\n";

/// Writes a Markdown table; the sixth column is the best rate over that of accel's BVH, asked in
/// batches if it was.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = HEAD.to_owned();
    for row in rows {
        let per_triangle = 1.0 / row.triangles.max(1) as f64;
        let rate = |seconds: f64| row.segments as f64 / seconds * 1e-6;
        let reference = yardstick(rows, row);
        let relative = reference
            .map_or_else(|| "–".to_owned(), |yardstick| format!("{:.2}", yardstick / row.best));
        let differ = row.disagreements.map_or_else(
            || "–".to_owned(),
            |count| format!("{:.1}", count as f64 / row.segments.max(1) as f64 * 1e6),
        );
        writeln!(
            text,
            "| {} ({}) | {} | {} | {:.2} | {:.2} | {relative} | {:.2} | {:.0} | {differ} |",
            row.scene,
            row.triangles,
            kind(row.kind),
            row.name,
            rate(row.best),
            rate(row.median),
            row.build * per_triangle * 1e6,
            row.bytes as f64 * per_triangle,
        )
        .expect("a string takes any text");
    }
    text
}

/// Writes comma-separated values with a head line; times in seconds, memory in bytes.
pub fn csv(rows: &[Row]) -> String {
    let mut text = CSV_HEAD.to_owned();
    for row in rows {
        let disagreements = row.disagreements.map(|d| d.to_string()).unwrap_or_default();
        writeln!(
            text,
            "{},{},{},{},{},{},{disagreements},{},{:e},{:e},{:e},{}",
            row.scene,
            row.triangles,
            kind(row.kind),
            row.name,
            row.segments,
            row.blocked,
            row.runs,
            row.best,
            row.median,
            row.build,
            row.bytes,
        )
        .expect("a string takes any text");
    }
    text
}

/// The best time of accel's BVH on the same segments: of batches, else of single segments.
fn yardstick(rows: &[Row], of: &Row) -> Option<f64> {
    let named = |name: &str| {
        rows.iter()
            .find(|row| row.name == name && row.scene == of.scene && row.kind == of.kind)
            .map(|row| row.best)
    };
    named("accel-bvh-batch").or_else(|| named("accel-bvh"))
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Shooting => "shooting",
        Kind::Random => "random",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &'static str, best: f64) -> Row {
        Row {
            scene: "attic".to_owned(),
            kind: Kind::Shooting,
            name,
            triangles: 1000,
            segments: 2_000_000,
            blocked: 500_000,
            disagreements: Some(1),
            runs: 3,
            best,
            median: 2.0 * best,
            build: 1e-3,
            bytes: 64_000,
        }
    }

    #[test]
    fn rates_and_ratios() {
        let rows = [row("accel-bvh-batch", 0.5), row("embree1", 0.25)];
        let text = markdown(&rows);
        let lines: Vec<_> = text.lines().skip(2).collect();
        let expected = [
            "| attic (1000) | shooting | accel-bvh-batch | 4.00 | 2.00 | 1.00 | 1.00 | 64 | 0.5 |",
            "| attic (1000) | shooting | embree1 | 8.00 | 4.00 | 2.00 | 1.00 | 64 | 0.5 |",
        ];
        assert_eq!(lines, expected);
        let text = csv(&rows[..1]);
        let expected = "attic,1000,shooting,accel-bvh-batch,2000000,500000,1,3,5e-1,1e0,1e-3,64000";
        assert_eq!(text.lines().nth(1), Some(expected));
    }
}
