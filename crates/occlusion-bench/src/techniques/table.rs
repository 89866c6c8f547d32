//! The techniques' table.

use std::fmt::Write;

use super::compare::Comparison;
use super::instructions::Counted;
use super::switches::{TECHNIQUES, VARIANTS};

/// Writes two Markdown tables: each technique with its gain on each scene, in speed and, where
/// counted, in instructions (both times those without it), and each variant's figures.
pub fn techniques_markdown(scenes: &[(Comparison, Vec<Counted>)]) -> String {
    let mut text = "| technique | on / off |".to_owned();
    for (comparison, counted) in scenes {
        let name = &comparison.scene;
        write!(text, " {name}, speed |").expect(STRING);
        if !counted.is_empty() {
            write!(text, " {name}, instructions |").expect(STRING);
        }
    }
    let columns = scenes.iter().map(|(_, counted)| 1 + usize::from(!counted.is_empty())).sum();
    writeln!(text, "\n|---|---|{}", "---:|".repeat(columns)).expect(STRING);
    for technique in TECHNIQUES {
        write!(text, "| {} | {} / {} |", technique.name, technique.on, technique.off)
            .expect(STRING);
        for (comparison, counted) in scenes {
            write!(text, " × {:.2} |", comparison.gain(&technique)).expect(STRING);
            if !counted.is_empty() {
                write!(text, " ÷ {:.2} |", Counted::gain(counted, &technique)).expect(STRING);
            }
        }
        text.push('\n');
    }
    text.push('\n');
    text += "| scene | variant | M/s | instructions/segment | build, ms | build, instructions/triangle |\n";
    text += "|---|---|---:|---:|---:|---:|\n";
    for (comparison, counted) in scenes {
        for (variant, measured) in VARIANTS.iter().zip(&comparison.measured) {
            let found = counted.iter().find(|counted| counted.name == variant.name);
            let number = |number: Option<f64>| {
                number.map_or_else(|| "–".to_owned(), |number| format!("{number:.0}"))
            };
            writeln!(
                text,
                "| {} | {} | {:.2} | {} | {:.3} | {} |",
                comparison.scene,
                variant.name,
                comparison.segments as f64 / measured.seconds * 1e-6,
                number(found.map(|counted| counted.question)),
                measured.build * 1e3,
                number(found.map(|counted| counted.build)),
            )
            .expect(STRING);
        }
    }
    text
}

const STRING: &str = "a string takes any text";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::techniques::Measured;

    #[test]
    fn gains_are_of_time_and_of_instructions() {
        // Every variant takes a second for a million segments but one, which takes two.
        let seconds = |name| if name == "eager" { 2.0 } else { 1.0 };
        let measured =
            VARIANTS.map(|v| Measured { name: v.name, seconds: seconds(v.name), build: 0.5 });
        let comparison = Comparison {
            scene: "attic".to_owned(),
            segments: 1_000_000,
            rounds: 1,
            measured: measured.to_vec(),
        };
        let counted = VARIANTS.map(|v| Counted {
            name: v.name,
            question: 300.0 * seconds(v.name).powi(2),
            build: 7.0,
        });
        let text = techniques_markdown(&[(comparison, counted.to_vec())]);
        let row = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap();
        let expected = "| short circuit in the triangle test | base / eager | × 2.00 | ÷ 4.00 |";
        assert_eq!(row("| short circuit in"), expected);
        assert_eq!(row("| attic | eager"), "| attic | eager | 0.50 | 1200 | 500.000 | 7 |");
    }
}
