//! The tables of docs/performance/dependencies.md.

use super::tree::Counts;
use crate::precision::blocks::{self, table};

/// The block of the page with a row for each crate.
const CRATES: &str = "crates";
/// The block with a row for each feature.
const FEATURES: &str = "features";

/// The page with its tables renewed.
pub(super) fn renewed(page: &str, counts: &[Counts]) -> Result<String, String> {
    let row = |c: &Counts| {
        let added = c.features.iter().map(|(name, added)| format!("`{name}` {}", added.len()));
        let added: Vec<_> = added.collect();
        vec![format!("`{}`", c.name), c.plain.to_string(), c.default.to_string(), added.join(", ")]
    };
    let header = ["crate", "plain", "default", "each feature alone adds"];
    let page = blocks::replace(page, CRATES, &table(&header, counts.iter().map(row)))?;
    let rows = counts.iter().flat_map(|c| {
        c.features.iter().map(|(feature, added)| {
            // Without versions, the table changes only with what is needed.
            let mut names: Vec<_> = added.iter().filter_map(|a| a.split(' ').next()).collect();
            names.dedup();
            vec![format!("`{}/{feature}`", c.name), names.join(", ")]
        })
    });
    blocks::replace(&page, FEATURES, &table(&["feature", "adds"], rows))
}

/// How the page differs from what it should be, a line of each.
pub(super) fn differences(found: &str, expected: &str) -> String {
    let mut lines = vec!["the crates from outside are others than docs/performance says:".into()];
    let only = |a: &str, b: &str, mark: &str| -> Vec<String> {
        let missing = a.lines().filter(|line| !b.lines().any(|other| other == *line));
        missing.map(|line| format!("{mark} {line}")).collect()
    };
    lines.extend(only(found, expected, "-"));
    lines.extend(only(expected, found, "+"));
    lines.push("where that is meant: cargo xtask dependencies --write".into());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_and_every_feature_has_a_row() {
        let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        let counts = [
            Counts { name: "a".into(), plain: 1, default: 1, features: Vec::new() },
            Counts {
                name: "b".into(),
                plain: 2,
                default: 5,
                features: vec![
                    ("one".into(), set(&[])),
                    ("two".into(), set(&["x v1", "x v2", "y v1"])),
                ],
            },
        ];
        let block = |name: &str| format!("<!-- begin: {name} -->\n<!-- end: {name} -->\n");
        let page = block(CRATES) + &block(FEATURES);
        let page = renewed(&page, &counts).unwrap();
        for row in [
            "| `a` | 1 | 1 |  |",
            "| `b` | 2 | 5 | `one` 0, `two` 3 |",
            "| `b/one` |  |",
            "| `b/two` | x, y |",
        ] {
            assert!(page.lines().any(|line| line == row), "{row}: {page}");
        }
        assert_eq!(renewed(&page, &counts).unwrap(), page);
        let less = renewed(&page, &counts[1..]).unwrap();
        let said = differences(&less, &page);
        assert_eq!(said.lines().nth(1), Some("+ | `a` | 1 | 1 |  |"), "{said}");
        assert_eq!(said.lines().count(), 3, "{said}");
        assert!(renewed("# A\n", &counts).is_err());
    }
}
