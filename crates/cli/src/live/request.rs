//! What a reader asks for, and whether it may: the token, the host, the way.

use httparse::{EMPTY_HEADER, Request, Status};

/// Header lines that a browser sends, and some.
const MOST_HEADERS: usize = 64;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    /// The page.
    Page,
    /// A frame newer than this one.
    Light(u64),
    /// The end of the work.
    Stop,
}

/// Why nothing is given: status and its phrase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Refusal(pub(super) u16, pub(super) &'static str);

pub(super) const BAD: Refusal = Refusal(400, "Bad Request");
const FOREIGN: Refusal = Refusal(403, "Forbidden");
const UNKNOWN: Refusal = Refusal(404, "Not Found");
const WRONG_METHOD: Refusal = Refusal(405, "Method Not Allowed");

/// Reads the head of a request; none while it is not whole.
///
/// A page elsewhere can make a browser send requests here, by a name that it lets lead to loopback (DNS
/// rebinding): the host must be ours, and the token is what no other page knows.
pub(super) fn read(head: &[u8], token: &str, port: u16) -> Option<Result<Asked, Refusal>> {
    let mut headers = [EMPTY_HEADER; MOST_HEADERS];
    let mut request = Request::new(&mut headers);
    match request.parse(head) {
        Ok(Status::Partial) => return None,
        Ok(Status::Complete(_)) => {}
        Err(_) => return Some(Err(BAD)),
    }
    let values = |name: &str| {
        let named = request.headers.iter().filter(move |h| h.name.eq_ignore_ascii_case(name));
        named.map(|h| h.value).collect::<Vec<_>>()
    };
    let ours = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    let hosts = values("host");
    if hosts.len() != 1 || !ours.iter().any(|host| host.as_bytes() == hosts[0]) {
        return Some(Err(FOREIGN));
    }
    let from =
        |origin: &&[u8]| ours.iter().any(|h| origin.strip_prefix(b"http://") == Some(h.as_bytes()));
    if !values("origin").iter().all(from) {
        return Some(Err(FOREIGN));
    }
    Some(way(request.method.unwrap_or_default(), request.path.unwrap_or_default(), token))
}

/// What a path stands for.
fn way(method: &str, path: &str, token: &str) -> Result<Asked, Refusal> {
    let rest = path.strip_prefix('/').and_then(|path| path.strip_prefix(token));
    let rest = rest.and_then(|rest| rest.strip_prefix('/')).ok_or(UNKNOWN)?;
    let (asked, expected) = match rest {
        "" => (Asked::Page, "GET"),
        "stop" => (Asked::Stop, "POST"),
        _ => {
            let after = rest.strip_prefix("light?after=").ok_or(UNKNOWN)?;
            (Asked::Light(after.parse().map_err(|_| BAD)?), "GET")
        }
    };
    if method == expected { Ok(asked) } else { Err(WRONG_METHOD) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(head: &str) -> Option<Result<Asked, Refusal>> {
        read(head.as_bytes(), "secret", 4242)
    }

    fn get(path: &str, host: &str) -> Option<Result<Asked, Refusal>> {
        asked(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nAccept: */*\r\n\r\n"))
    }

    #[test]
    fn what_is_known_is_given_to_who_knows_the_token() {
        let ours = "127.0.0.1:4242";
        assert_eq!(get("/secret/", ours), Some(Ok(Asked::Page)));
        assert_eq!(get("/secret/", "localhost:4242"), Some(Ok(Asked::Page)));
        assert_eq!(get("/secret/light?after=7", ours), Some(Ok(Asked::Light(7))));
        let stop = "POST /secret/stop HTTP/1.1\r\nHost: 127.0.0.1:4242\r\n";
        assert_eq!(asked(&format!("{stop}\r\n")), Some(Ok(Asked::Stop)));
        let origin = format!("{stop}Origin: http://127.0.0.1:4242\r\n\r\n");
        assert_eq!(asked(&origin), Some(Ok(Asked::Stop)));
        for unknown in [
            "/",
            "/secret",
            "/secre/",
            "/secrets/",
            "/other/",
            "/favicon.ico",
            "/secret/a",
            "/secret/../",
        ] {
            assert_eq!(get(unknown, ours), Some(Err(UNKNOWN)), "{unknown}");
        }
    }

    #[test]
    fn foreign_hosts_and_origins_are_refused() {
        for host in [
            "evil.example",
            "evil.example:4242",
            "127.0.0.1",
            "127.0.0.1:80",
            "127.0.0.1:42420",
            "",
        ] {
            assert_eq!(get("/secret/", host), Some(Err(FOREIGN)), "{host}");
        }
        assert_eq!(asked("GET /secret/ HTTP/1.1\r\n\r\n"), Some(Err(FOREIGN)));
        let two = "GET /secret/ HTTP/1.1\r\nHost: 127.0.0.1:4242\r\nHost: evil.example\r\n\r\n";
        assert_eq!(asked(two), Some(Err(FOREIGN)));
        for origin in ["http://evil.example", "null", "https://127.0.0.1:4242"] {
            let head = format!(
                "POST /secret/stop HTTP/1.1\r\nHost: 127.0.0.1:4242\r\nOrigin: {origin}\r\n\r\n"
            );
            assert_eq!(asked(&head), Some(Err(FOREIGN)), "{origin}");
        }
    }

    #[test]
    fn what_is_no_request_is_refused_and_what_is_half_one_waited_for() {
        assert_eq!(asked("GET /secret/ HTTP/1.1\r\nHost: 127"), None);
        assert_eq!(asked("\u{0}\r\n\r\n"), Some(Err(BAD)));
        assert_eq!(get("/secret/light?after=-1", "127.0.0.1:4242"), Some(Err(BAD)));
        assert_eq!(get("/secret/stop", "127.0.0.1:4242"), Some(Err(WRONG_METHOD)));
    }
}
