//! A report as one file that needs nothing else: charts are drawn within, tables can be copied.

use super::section::{Section, Table};

/// The looks of the page, on screens and in print.
const STYLE: &str = "\
body { font: 16px/1.5 system-ui, sans-serif; max-width: 1080px; margin: 2em auto; padding: 0 1em; \
color: #111; background: #fff }
nav ul { columns: 2 }
figure { margin: 1em 0 }
svg { max-width: 100%; height: auto }
.scroll { overflow-x: auto }
table { border-collapse: collapse; font-variant-numeric: tabular-nums }
th, td { border: 1px solid #bbb; padding: .2em .6em; text-align: left }
th { background: #eee }
button { margin: .5em .5em .5em 0 }
@media print { button, nav { display: none } section { break-inside: avoid } }
";

/// Copies a table as comma-separated values or as Markdown. Pages opened from a file may not write
/// to the clipboard: then the text is shown, selected.
const SCRIPT: &str = "\
document.querySelectorAll('button').forEach(button => button.addEventListener('click', () => {
  const table = button.parentElement.querySelector('table');
  const rows = [...table.rows].map(row => [...row.cells].map(cell => cell.textContent));
  const quoted = text => /[\",]/.test(text) ? '\"' + text.replaceAll('\"', '\"\"') + '\"' : text;
  const line = cells => '| ' + cells.join(' | ') + ' |';
  const text = button.dataset.form === 'csv'
    ? rows.map(row => row.map(quoted).join(',')).join('\\n') + '\\n'
    : [line(rows[0]), '|' + '---|'.repeat(rows[0].length), ...rows.slice(1).map(line)].join('\\n') + '\\n';
  const done = () => { const name = button.textContent; button.textContent = 'copied';
    setTimeout(() => { button.textContent = name; }, 1000); };
  const show = () => { let area = button.parentElement.querySelector('textarea');
    if (!area) { area = document.createElement('textarea'); area.rows = 8; area.cols = 80;
      button.parentElement.append(area); }
    area.value = text; area.select(); };
  navigator.clipboard ? navigator.clipboard.writeText(text).then(done, show) : show();
}));
";

/// The page.
pub(super) fn page(title: &str, head: &[String], sections: &[Section]) -> String {
    let title = escaped(title);
    let head: String = head.iter().map(|line| format!("<p>{}</p>\n", escaped(line))).collect();
    let entry = |(number, section): (usize, &Section)| {
        format!("<li><a href=\"#s{number}\">{}</a></li>\n", escaped(&section.title))
    };
    let contents: String = sections.iter().enumerate().map(entry).collect();
    let body: String = sections.iter().enumerate().map(section).collect();
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{head}\
         <nav><ul>\n{contents}</ul></nav>\n{body}<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    )
}

fn section((number, section): (usize, &Section)) -> String {
    let Section { title, words, charts, table } = section;
    let words: String = words.iter().map(|line| format!("<li>{}</li>\n", escaped(line))).collect();
    let words = if words.is_empty() { words } else { format!("<ul>\n{words}</ul>\n") };
    let charts: String = charts
        .iter()
        .map(|chart| {
            let label = escaped(&chart.title);
            format!("<figure role=\"img\" aria-label=\"{label}\">\n{}</figure>\n", chart.svg)
        })
        .collect();
    let table = table.as_ref().map(rows).unwrap_or_default();
    let title = escaped(title);
    format!("<section id=\"s{number}\">\n<h2>{title}</h2>\n{words}{charts}{table}</section>\n")
}

fn rows(Table { header, rows }: &Table) -> String {
    let cells = |tag: &str, texts: &mut dyn Iterator<Item = &str>| {
        let cells: String = texts.map(|t| format!("<{tag}>{}</{tag}>", escaped(t))).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let head = cells("th", &mut header.iter().copied());
    let body: String =
        rows.iter().map(|row| cells("td", &mut row.iter().map(String::as_str))).collect();
    format!(
        "<div class=\"scroll\">\n<button data-form=\"csv\">copy as CSV</button>\
         <button data-form=\"markdown\">copy as Markdown</button>\n\
         <table>\n<thead>\n{head}</thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )
}

/// Text that holds no markup.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::chart::Chart;

    #[test]
    fn the_page_is_whole_and_asks_for_nothing() {
        let svg = "<svg><text>x</text></svg>\n".to_owned();
        let chart = Chart { file: "a.svg".into(), title: "A \"chart\"".into(), svg };
        let rows = vec![vec!["<1>".into(), "2".into()]];
        let section = Section {
            title: "B & C".into(),
            words: vec!["One < two.".into()],
            charts: vec![chart],
            table: Some(Table { header: vec!["x", "y"], rows }),
        };
        let page = page("A", &["Head.".into()], &[section]);
        for words in [
            "<h2>B &amp; C</h2>",
            "One &lt; two.",
            "aria-label=\"A &quot;chart&quot;\"",
            "<svg><text>x</text></svg>",
            "<tr><th>x</th><th>y</th></tr>",
            "<tr><td>&lt;1&gt;</td><td>2</td></tr>",
        ] {
            assert!(page.contains(words), "{words}: {page}");
        }
        for outside in ["http", "src=", "url(", "@import"] {
            assert!(!page.contains(outside), "{outside}: {page}");
        }
    }
}
