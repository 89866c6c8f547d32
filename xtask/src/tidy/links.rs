//! Links in Markdown: what they point at is there.

use super::Complaint;

/// Checks every relative link of one file; `exists` says whether a target is there.
pub(super) fn check(file: &str, text: &str, exists: impl Fn(&str) -> bool) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    let mut in_code = false;
    for (number, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code {
            continue;
        }
        for target in targets(line) {
            // Only the path is checked: the part after # is a place inside it.
            let path = target.split('#').next().unwrap_or_default();
            if !path.is_empty() && !exists(path) {
                complaints.push(format!("{file}:{}: nothing is at `{target}`", number + 1));
            }
        }
    }
    complaints
}

/// The relative targets of `[text](target)`, `![text](target)` and `[name]: target` in a line.
fn targets(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    // Every second piece between backquotes is code.
    for prose in line.split('`').step_by(2) {
        for piece in prose.split("](").skip(1) {
            found.extend(piece.split([')', ' ']).next());
        }
        // A link's text may end in code: what follows the last backquote starts with its target.
        if let Some(piece) = prose.strip_prefix("](") {
            found.extend(piece.split([')', ' ']).next());
        }
    }
    if let Some((name, target)) = line.split_once("]: ")
        && name.starts_with('[')
    {
        found.push(target.trim());
    }
    found.dedup();
    let outside = |target: &str| {
        target.contains("://") || target.starts_with("mailto:") || target.contains("::")
    };
    found.retain(|target| !outside(target));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dead_link_is_named_with_its_line() {
        let text = "see [a](a.md) and\n![b](img/b.png \"title\"), [`c`](c.md#top)\n[d]: d.md\n";
        assert_eq!(check("x.md", text, |_| true), Vec::<String>::new());
        let dead = check("x.md", text, |to| to == "a.md");
        let expected = [
            "x.md:2: nothing is at `img/b.png`",
            "x.md:2: nothing is at `c.md#top`",
            "x.md:3: nothing is at `d.md`",
        ];
        assert_eq!(dead, expected);
    }

    #[test]
    fn code_addresses_and_places_in_the_file_are_left_alone() {
        let text = "[w](https://example.org/x) [h](#here) `[c](c)`\n```\n[k](k)\n```\n";
        assert_eq!(check("x.md", text, |_| false), Vec::<String>::new());
    }
}
