//! Parts of a page that are written by code, between two comments that name them.

/// The page with the block `name` renewed; what stands around it stays.
///
/// # Errors
/// Where the block's comments are missing, or its end comes first.
pub(crate) fn replace(page: &str, name: &str, text: &str) -> Result<String, String> {
    let (begin, end) = (format!("<!-- begin: {name} -->"), format!("<!-- end: {name} -->"));
    let missing = || format!("the page has no `{begin}` with `{end}` after it");
    let (before, rest) = page.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}\n\n{}\n\n{end}{after}", text.trim()))
}

/// A Markdown table.
pub(crate) fn table(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut lines = vec![format!("| {} |", header.join(" | "))];
    lines.push(format!("|{}", "---|".repeat(header.len())));
    lines.extend(rows.map(|cells| format!("| {} |", cells.join(" | "))));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# A\n<!-- begin: a -->\nold\n<!-- end: a -->\nwords\n";

    #[test]
    fn only_the_block_changes() {
        let new = "# A\n<!-- begin: a -->\n\nnew\n\n<!-- end: a -->\nwords\n";
        assert_eq!(replace(PAGE, "a", "new\n").unwrap(), new);
        assert_eq!(replace(new, "a", "new").unwrap(), new);
    }

    #[test]
    fn a_page_without_the_block_is_refused() {
        let error = replace(PAGE, "b", "").unwrap_err();
        assert_eq!(error, "the page has no `<!-- begin: b -->` with `<!-- end: b -->` after it");
        let reversed = "<!-- end: a --><!-- begin: a -->";
        assert!(replace(reversed, "a", "").is_err());
    }
}
