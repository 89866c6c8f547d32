//! Everything the program says: messages on stderr, results of commands on stdout.

mod event;
mod terminal;

use std::io::Write;

use radiosity_core::{LevelReport, Parts, Reached, Statement};

use crate::failure::Failure;
pub(crate) use event::{Event, StepFacts, WorkFacts};
pub(crate) use terminal::open;
use terminal::{ERROR, KEY, WARNING, terminal};

/// Says something on stderr.
pub(crate) fn say(line: &str) {
    let text = || anstream::adapter::strip_str(line).to_string();
    tell(|| Event::Message { text: text() }, line);
}

/// Says the same as a line of text, or as an object with `--log json`.
pub(crate) fn tell<'a>(event: impl FnOnce() -> Event<'a>, line: &str) {
    if !terminal().json && !terminal().quiet {
        terminal().line(line);
    }
    log(event);
}

/// Says what only `--log json` has a line for.
pub(crate) fn log<'a>(event: impl FnOnce() -> Event<'a>) {
    if logs() {
        terminal().object(&event());
    }
}

/// Whether objects are said.
pub(crate) fn logs() -> bool {
    terminal().json && !terminal().quiet
}

/// Says why the program fails.
pub(crate) fn error(message: &str, exit_code: u8) {
    match terminal().json {
        true => terminal().object(&Event::Error { text: message, exit_code }),
        false => {
            let label = terminal().styled(ERROR, "error:");
            terminal().line(&format!("radiosity: {label} {message}"));
        }
    }
}

/// Says what should be looked at.
pub(crate) fn warning(message: &str) {
    match terminal().json {
        true => terminal().object(&Event::Warning { text: message }),
        false => {
            let label = terminal().styled(WARNING, "warning:");
            terminal().line(&format!("radiosity: {label} {message}"));
        }
    }
}

/// Says what ended the work before its goal.
pub(crate) fn limit(limit: &str, text: &str) {
    match logs() {
        true => log(|| Event::Limit { limit, text }),
        false => warning(text),
    }
}

/// A number that matters most, in bold where there are colours.
pub(crate) fn key(number: &str) -> String {
    terminal().styled(KEY, number)
}

/// Where bars are drawn.
pub(crate) fn bars() -> &'static crate::progress::Bars {
    &terminal().bars
}

/// Says what a level of refinement reached.
pub(crate) fn level(number: u32, report: &LevelReport, elapsed: f64) {
    let known = match report.statement.map(|s| s.triangles.e1) {
        Some(parts) if parts.total().is_finite() => {
            format!("error {}", key(&percent(parts.total())))
        }
        Some(parts) if parts.mesh.is_finite() => {
            format!("mesh error {}, form factors not judged yet", percent(parts.mesh))
        }
        _ => "no statement from one mesh".into(),
    };
    let elements = count(report.elements as u64);
    let line = format!("{elements} elements: {known}, {}", seconds(elapsed));
    tell(|| Event::level(number, report), &line);
}

/// Says how wrong the light may be, and if nothing is known of that, why.
pub(crate) fn statement(statement: Option<&Statement>, reached: Reached) {
    let Some(statement) = statement else { return };
    let parts = |p: &Parts| {
        format!(
            "{} = iteration {} + form factors {} + mesh {}",
            key(&share(p.total())),
            share(p.iteration),
            share(p.form_factor),
            share(p.mesh)
        )
    };
    let (triangles, points) = (&statement.triangles, &statement.points);
    let mut lines = vec![
        format!("error: at most {} of the triangles' exitance (E1)", parts(&triangles.e1)),
        format!(
            "       largest {} of the mean on one triangle; at single places {}, largest {}",
            share(triangles.einf.total()),
            share(points.e1.total()),
            share(points.einf.total())
        ),
    ];
    let [least, most] = statement.rows;
    if statement.sample > 0 {
        lines.push(format!(
            "       form factors sum to {least:.6} to {most:.6} in {} sampled elements; 1 if closed",
            statement.sample
        ));
    }
    if let Some(probes) = &statement.probes {
        lines.push(format!("       at the probes {}", parts(&probes.e1)));
    }
    tell(|| Event::statement(statement), &lines.join("\n"));
    if triangles.e1.mesh.is_infinite() {
        warning(match reached {
            Reached::Unseen => {
                "no mesh saw any surface but lamps receive light: how much is missed is unknown"
            }
            Reached::SizeLimit => {
                "one mesh says nothing of its own error, and --min-area or --max-depth allow no other"
            }
            _ => {
                "one mesh says nothing of its own error: ask for more --elements, at least one and \
                 a half times as many as the scene's own triangles make, or for --error"
            }
        });
    }
}

/// A share that may be unknown.
fn share(value: f64) -> String {
    if value.is_finite() { percent(value) } else { "unknown".into() }
}

/// Prints a line of a command's result on stdout. A reader that went away has had enough;
/// any other error is a failure.
pub(crate) fn result(line: &str) -> Result<(), Failure> {
    match writeln!(std::io::stdout().lock(), "{line}") {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Failed(format!("stdout: {e}")))
        }
        _ => Ok(()),
    }
}

/// Warnings of one kind shown before the rest are only counted.
const SHOWN: usize = 5;

/// Says the warnings of an import, a few of each kind, and how many more there are.
pub(crate) fn diagnostics(diagnostics: &[scene_import::Diagnostic]) {
    let mut kinds: Vec<(std::mem::Discriminant<_>, usize)> = Vec::new();
    for diagnostic in diagnostics {
        let kind = std::mem::discriminant(&diagnostic.kind);
        let at = kinds.iter().position(|k| k.0 == kind).unwrap_or_else(|| {
            kinds.push((kind, 0));
            kinds.len() - 1
        });
        kinds[at].1 += 1;
        if kinds[at].1 <= SHOWN {
            warning(&diagnostic.to_string());
        }
    }
    let hidden: usize = kinds.iter().map(|k| k.1.saturating_sub(SHOWN)).sum();
    if hidden > 0 {
        warning(&format!("and {hidden} more like these; `radiosity plan` lists all"));
    }
}

/// A count with thousands set apart: 1,234,567.
pub(crate) fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// An amount that was foreseen, in two digits: nobody knows more.
pub(crate) fn rough(amount: f64) -> String {
    if amount < 1.0 {
        return "0".into();
    }
    let unit = 10f64.powf((amount.log10().floor() - 1.0).max(0.0));
    count(((amount / unit).round() * unit) as u64)
}

/// A share as a percentage with three digits.
pub(crate) fn percent(share: f64) -> String {
    let percent = share * 100.0;
    match percent.abs() {
        0.0 => "0 %".into(),
        p if p < 0.001 => format!("{percent:.1e} %"),
        p if p < 1.0 => format!("{percent:.3} %"),
        _ => format!("{percent:.1} %"),
    }
}

/// Seconds, as long as they matter.
pub(crate) fn seconds(s: f64) -> String {
    match s {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.1} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(count(0), "0");
        assert_eq!(count(999), "999");
        assert_eq!(count(1000), "1,000");
        assert_eq!(count(12_345_678), "12,345,678");
        assert_eq!(percent(0.25), "25.0 %");
        assert_eq!(percent(-0.0012), "-0.120 %");
        assert_eq!(seconds(0.0123), "12.3 ms");
    }
}
