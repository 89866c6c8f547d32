//! A report as a page for repositories.

use super::section::{Section, Table};
use crate::precision::blocks::table;

/// The page; charts are files beside it.
pub(super) fn page(title: &str, head: &[String], sections: &[Section]) -> String {
    let mut parts = vec![format!("# {title}")];
    parts.extend(head.iter().cloned());
    parts.push(
        "Made by `cargo xtask bench`; [report.html](report.html) is the same in one file, \
         [records.jsonl](records.jsonl) holds every run, [host.json](host.json) the machine."
            .into(),
    );
    for Section { title, words, charts, table: rows } in sections {
        parts.push(format!("## {title}"));
        let lines: Vec<_> = words.iter().map(|line| format!("- {line}")).collect();
        parts.extend((!lines.is_empty()).then(|| lines.join("\n")));
        parts.extend(charts.iter().map(|chart| format!("![{}]({})", chart.title, chart.file)));
        if let Some(Table { header, rows }) = rows {
            parts.push(table(header, rows.iter().cloned()));
        }
    }
    parts.join("\n\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::chart::Chart;

    #[test]
    fn everything_has_its_place() {
        let chart = Chart { file: "a.svg".into(), title: "A chart".into(), svg: "<svg/>".into() };
        let rows = vec![vec!["1".into(), "2".into()]];
        let section = Section {
            title: "B".into(),
            words: vec!["One.".into(), "Two.".into()],
            charts: vec![chart],
            table: Some(Table { header: vec!["x", "y"], rows }),
        };
        let page = page("A", &["Head.".into()], &[section]);
        assert!(page.starts_with("# A\n\nHead.\n\nMade by"), "{page}");
        let end =
            "## B\n\n- One.\n- Two.\n\n![A chart](a.svg)\n\n| x | y |\n|---|---|\n| 1 | 2 |\n";
        assert!(page.ends_with(end), "{page}");
    }
}
