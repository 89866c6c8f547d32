//! The page: what was bundled, with the light and the report of one solve in it.

use std::io::{self, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use serde_json::{Value, json};

use crate::{Error, Shown, frame};

/// What `web/` is built into.
const BUILT: &str = include_str!("../assets/page.html");

/// The longest text that a browser holds in one piece: 2²⁹ − 24 characters in V8, which is the tightest.
const MOST_TEXT: usize = (1 << 29) - 24;

/// What a page that stands in a file may connect to, and one that is served.
const NOTHING: &str = "'none'";
const ITS_SERVER: &str = "'self'";

/// One offline page, ready to be written.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    facts: Value,
    light: Vec<u8>,
}

impl Page {
    /// A page of a lit scene; `report` is what `radiosity solve --report` writes, or null.
    ///
    /// # Errors
    /// As [`frame`]; more light than a browser holds in one piece (about 5 million elements).
    pub fn new(title: &str, shown: &Shown<'_>, report: &Value) -> Result<Self, Error> {
        let light = frame(shown, &Value::Null)?;
        if light.len().div_ceil(3) > MOST_TEXT / 4 {
            return Err(Error::new(format!(
                "{} elements make a page that browsers cannot hold; solve with fewer, as with \
                 --max-elements 4000000",
                shown.solution.elements.len()
            )));
        }
        let facts = json!({ "title": title, "live": false, "report": report });
        Ok(Self { title: title.to_owned(), facts, light })
    }

    /// Writes the page.
    ///
    /// # Errors
    /// What `out` answers.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        fill(out, NOTHING, &self.title, &self.facts, |out| {
            let mut encoder = EncoderWriter::new(out, &STANDARD);
            encoder.write_all(&self.light)?;
            encoder.finish().map(drop)
        })
    }
}

/// Writes the page that asks the server it came from for its light: `light?after=N` answers with a
/// [`frame`] whose progress says `frame`, above N, or without content; `stop` ends the work.
///
/// # Errors
/// What `out` answers.
pub fn write_live(out: &mut dyn Write, title: &str) -> io::Result<()> {
    let facts = json!({ "title": title, "live": true, "report": null });
    fill(out, ITS_SERVER, title, &facts, |_| Ok(()))
}

/// Writes what was bundled, with its four gaps filled in their order.
fn fill(
    out: &mut dyn Write,
    connect: &str,
    title: &str,
    facts: &Value,
    light: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut rest = BUILT;
    let mut until = |gap: &str| {
        let (before, after) = rest.split_once(gap).expect("the page that was built has all gaps");
        rest = after;
        before
    };
    out.write_all(until("{{connect}}").as_bytes())?;
    out.write_all(connect.as_bytes())?;
    out.write_all(until("{{title}}").as_bytes())?;
    out.write_all(as_text(title).as_bytes())?;
    out.write_all(until("{{facts}}").as_bytes())?;
    out.write_all(as_data(facts).as_bytes())?;
    out.write_all(until("{{light}}").as_bytes())?;
    light(out)?;
    out.write_all(rest.as_bytes())
}

/// Text that a page shows as it stands.
fn as_text(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// JSON that cannot end the element it stands in: in JSON these stand only in strings, where their escapes
/// mean the same.
fn as_data(value: &Value) -> String {
    value
        .to_string()
        .replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every gap is there, once and in order, before the script that follows them.
    #[test]
    fn the_gaps_are_where_they_are_filled() {
        let gaps = ["{{connect}}", "{{title}}", "{{facts}}", "{{light}}"];
        let places: Vec<_> = gaps.iter().map(|gap| BUILT.find(gap)).collect();
        assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
        assert!(gaps.iter().all(|gap| BUILT.matches(gap).count() == 1));
    }

    #[test]
    fn nothing_ends_its_element() {
        let hostile = "</script><script>alert(1)</script><!-- & \u{2028}\"";
        let data = as_data(&json!({ hostile: [hostile] }));
        assert!(!data.contains(['<', '>', '&', '\u{2028}']), "{data}");
        let back: Value = serde_json::from_str(&data).unwrap();
        assert_eq!(back, json!({ hostile: [hostile] }));
        assert_eq!(as_text("<a href=\"&\">"), "&lt;a href=&quot;&amp;&quot;&gt;");
    }
}
