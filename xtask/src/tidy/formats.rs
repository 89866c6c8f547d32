//! File formats: each extension that the code knows has a heading in the documentation.

use std::fs;
use std::path::Path;

use super::Complaint;

/// The page that describes them.
const PAGE: &str = "docs/formats.md";

/// Where extensions become formats, and what is in such a file's heading besides the extension.
const SOURCES: [(&str, &str); 3] = [
    ("crates/scene-import/src/open.rs", " in"),
    ("crates/output/src/format.rs", " out"),
    ("crates/output/src/matrix/mod.rs", "Form factors"),
];

/// Complains about each format that has no heading, and about sources in which none is found.
pub(super) fn check(root: &Path) -> Vec<Complaint> {
    let read = |file: &str| {
        fs::read_to_string(root.join(file)).map_err(|e| format!("{file}: cannot be read: {e}"))
    };
    let page = match read(PAGE) {
        Ok(page) => page,
        Err(complaint) => return vec![complaint],
    };
    let check = |(file, kind)| match read(file) {
        Ok(source) => missing(&page, file, &source, kind),
        Err(complaint) => vec![complaint],
    };
    SOURCES.into_iter().flat_map(check).collect()
}

/// Complains about the extensions of one source.
fn missing(page: &str, file: &str, source: &str, kind: &str) -> Vec<Complaint> {
    let extensions = extensions(source);
    if extensions.is_empty() {
        return vec![format!("{file}: expected lines such as `\"tri\" => Ok(Format::Tri)`")];
    }
    let headings: Vec<&str> = page.lines().filter(|line| line.starts_with("## ")).collect();
    let described = |extension: &str| {
        let mut of_kind = headings.iter().filter(|heading| heading.contains(kind));
        let is_it = |word: &str| word.trim_matches(',').strip_prefix('.') == Some(extension);
        of_kind.any(|heading| heading.split(' ').any(is_it))
    };
    let absent = extensions.into_iter().filter(|extension| !described(extension));
    let heading = |extension: &str| match kind {
        " in" | " out" => format!("## .{extension}{kind}"),
        _ => format!("## {kind} as .{extension}"),
    };
    absent.map(|e| format!("{PAGE}: expected a heading `{}` ({file})", heading(e))).collect()
}

/// The extensions that a source maps to formats, or formats to: quoted text on one side of `=>`, and
/// a format on the other.
fn extensions(source: &str) -> Vec<&str> {
    let is_format = |text: &str| {
        ["Self::", "Ok(Self::", "Ok(Format::"].iter().any(|kind| text.trim().starts_with(kind))
    };
    let mut found = Vec::new();
    for (left, right) in source.lines().filter_map(|line| line.split_once("=> ")) {
        let quoted = if is_format(right) { left } else { right };
        if is_format(left) || is_format(right) {
            // Every second piece between quotes is inside of them.
            found.extend(quoted.split('"').skip(1).step_by(2));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "
        Some(\"csv\" | \"tsv\") => Self::Csv,
        \"tri\" => Ok(Format::Tri),
        \"ok\" => Ok(true),
        Self::Csv => \"csv\",
    ";

    #[test]
    fn extensions_are_those_that_become_formats() {
        assert_eq!(extensions(SOURCE), ["csv", "tri", "tsv"]);
    }

    #[test]
    fn a_format_without_a_heading_is_named() {
        let page = "## .csv and .tsv out\n.tri\n## .tri in\n";
        assert_eq!(
            missing(page, "f.rs", SOURCE, " out"),
            ["docs/formats.md: expected a heading `## .tri out` (f.rs)"]
        );
        let page = "## .csv out\n## .tsv, .tri out\n";
        assert_eq!(missing(page, "f.rs", SOURCE, " out"), Vec::<String>::new());
        assert_eq!(missing(page, "f.rs", "fn f() {}", " out").len(), 1);
    }

    #[test]
    fn the_formats_of_this_workspace_are_found() {
        let root = crate::root();
        let counts = SOURCES.map(|(file, _)| {
            extensions(&fs::read_to_string(root.join(file)).expect("the source is there")).len()
        });
        // At least those that there were when this was written.
        assert!(counts.iter().zip([5, 7, 3]).all(|(found, least)| *found >= least), "{counts:?}");
    }
}
