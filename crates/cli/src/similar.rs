//! What somebody probably meant who misspelt it.

/// A name is taken for a misspelt one if they are this similar (Jaro-Winkler), as clap has it.
const SIMILAR: f64 = 0.7;

/// The end of a message: `; did you mean that?`, or nothing where nothing is similar.
pub(crate) fn meant<'a>(typed: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let all = known.into_iter().map(|name| (strsim::jaro_winkler(typed, name), name));
    let best = all.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(similar, _)| *similar > SIMILAR);
    best.map(|(_, name)| format!("; did you mean {name}?")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_similar_is_meant() {
        let known = ["room.tri", "hall.tri", "room.obj"];
        assert_eq!(meant("rom.tri", known), "; did you mean room.tri?");
        assert_eq!(meant("zzz", known), "");
        assert_eq!(meant("room.tri", []), "");
    }
}
