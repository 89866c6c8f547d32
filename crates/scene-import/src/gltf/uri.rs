//! URIs of buffers and images: `data:` and paths beside the file.

use crate::beside::Beside;

/// The bytes behind a URI; the error is half a sentence.
///
/// # References
/// RFC 2397 (`data:`), RFC 3986 section 2.1 (percent encoding), RFC 4648 section 4 (base64).
pub(super) fn fetch(uri: &str, beside: &mut Beside<'_>) -> Result<Vec<u8>, String> {
    match data(uri) {
        Some(data) => data,
        None => beside.read(&path(uri)?),
    }
}

/// The bytes of a data URI; `None` if it is another.
pub(super) fn data(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let (kind, data) = match uri.strip_prefix("data:")?.split_once(',') {
        Some(parts) => parts,
        None => return Some(Err("the data URI has no comma".to_owned())),
    };
    Some(if kind.ends_with(";base64") { base64(data) } else { percent(data) })
}

/// The path that a URI stands for.
pub(super) fn path(uri: &str) -> Result<String, String> {
    if uri.contains(':') {
        return Err(format!("{} is neither data nor a relative path", shortened(uri)));
    }
    String::from_utf8(percent(uri)?).map_err(|_| "its path is not UTF-8".to_owned())
}

/// A URI short enough for a message, in quotes.
pub(super) fn shortened(uri: &str) -> String {
    format!("{:?}", crate::shortened::shortened(uri))
}

fn percent(text: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let mut digit = || rest.next().and_then(|byte| char::from(byte).to_digit(16));
        match (digit(), digit()) {
            (Some(high), Some(low)) => bytes.push((16 * high + low) as u8),
            _ => return Err("a percent sign is not followed by two hexadecimal digits".to_owned()),
        }
    }
    Ok(bytes)
}

fn base64(text: &str) -> Result<Vec<u8>, String> {
    let text = text.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    let (mut bits, mut held) = (0_u32, 0);
    for byte in text.bytes() {
        let six = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return Err(format!("{:?} is no base64 digit", char::from(byte))),
        };
        bits = (bits << 6) | u32::from(six);
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held) as u8);
        }
    }
    // One digit left over carries six bits, too few for a byte.
    if held == 6 { Err("the base64 text is cut short".to_owned()) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn base64_meets_the_test_vectors_of_rfc_4648() {
        for (text, plain) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
            ("Zm9vYmE", "fooba"),
        ] {
            assert_eq!(base64(text).unwrap(), plain.as_bytes());
        }
        assert_eq!(base64("+/+/").unwrap(), [0xfb, 0xff, 0xbf]);
        assert!(base64("Zm9v!").is_err());
        assert!(base64("Zm9vY").is_err());
    }

    #[test]
    fn uris_that_lead_elsewhere_are_refused() {
        let alone = &mut Beside::new(None, false);
        let here = &mut Beside::new(Some(Path::new(".")), false);
        assert_eq!(fetch("data:text/plain,a%20b", alone).unwrap(), b"a b");
        for uri in [
            "data:x",
            "http://a/b",
            "file:///etc/passwd",
            "C:\\a",
            "%zz",
            "%FF",
            "a.bin",
            "data:,%",
        ] {
            assert!(fetch(uri, alone).is_err(), "{uri}");
        }
        for uri in ["/etc/passwd", "..", "%2e%2e/a", "a/%2E./../b", "..%5ca", "%43%3A%5Ca", "//a/b"]
        {
            assert!(fetch(uri, here).unwrap_err().contains("--allow-outside"), "{uri}");
        }
        let anywhere = &mut Beside::new(Some(Path::new(".")), true);
        assert!(fetch("..", anywhere).unwrap_err().contains("plain file"));
        assert!(fetch("src", here).unwrap_err().contains("plain file"));
    }
}
