//! The tables of docs/plan.md.

use std::fmt::Write as _;

use super::measure::{Amounts, Record};

/// All records as Markdown.
pub(super) fn markdown(records: &[Record]) -> String {
    let mut text = String::from(
        "| scene | solved with | left out | form factors | segments | directions | time | light |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for record in records {
        let (needed, everything) = (&record.needed.work, &record.everything.work);
        let of = |part: fn(&Amounts) -> f64| {
            let (a, b) = (part(needed), part(everything));
            if a == b { amount(a) } else { format!("{} of {}", amount(a), amount(b)) }
        };
        let _ = writeln!(
            text,
            "| {} | `{}` | {} | {} | {} | {} | **{:.2}** | {} |",
            record.name,
            record.flags,
            record.left_out.join(", "),
            of(|w| w.form_factors),
            of(|w| w.segments),
            of(|w| w.directions),
            record.ratio(),
            light(record),
        );
    }
    text
}

/// What was foreseen beside what was done.
pub(super) fn foreseen(records: &[Record]) -> String {
    let mut text = String::from(
        "| scene | solved with | elements | form factors | segments | directions |\n\
         |---|---|---|---|---|---|\n",
    );
    for Record { name, flags, foreseen, needed, .. } in records {
        let of = |part: fn(&Amounts) -> f64| {
            format!("{} / {}", amount(part(foreseen)), amount(part(&needed.work)))
        };
        let _ = writeln!(
            text,
            "| {name} | `{flags}` | {} | {} | {} | {} |",
            of(|w| w.elements),
            of(|w| w.form_factors),
            of(|w| w.segments),
            of(|w| w.directions),
        );
    }
    text
}

/// How the light of the two ways differs.
fn light(record: &Record) -> String {
    match (record.same_bytes, record.stated) {
        (true, _) => "same bytes".into(),
        (false, Some(stated)) => {
            format!("E1 {} apart, {} stated", percent(record.apart), percent(stated))
        }
        (false, None) => format!("E1 {} apart", percent(record.apart)),
    }
}

fn percent(share: f64) -> String {
    format!("{:.3} %", 100.0 * share)
}

/// Three digits.
fn amount(n: f64) -> String {
    match n {
        n if n >= 9.995e5 => format!("{:.2} M", n / 1e6),
        n if n >= 999.5 => format!("{:.1} k", n / 1e3),
        n => format!("{n:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_have_three_digits() {
        assert_eq!(
            [0.0, 999.0, 1234.0, 9.99e5, 1.5e6].map(amount),
            ["0", "999", "1.2 k", "999.0 k", "1.50 M"]
        );
    }
}
