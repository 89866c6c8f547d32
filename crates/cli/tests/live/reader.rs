//! A reader of the live viewer: plain sockets, and frames as `viewer::frame` packs them.

use std::io::{Read, Write};
use std::net::TcpStream;

use serde_json::Value;

/// An answer: its status, its head and what follows.
pub(crate) struct Answer {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

/// Sends one request with this host.
pub(crate) fn ask_as(port: u16, host: &str, method: &str, path: &str) -> Answer {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    write!(stream, "{method} {path} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).unwrap();
    let end = bytes.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
    let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
    let status = head.split(' ').nth(1).unwrap().parse().unwrap();
    Answer { status, head, body: bytes.split_off(end + 4) }
}

/// The same with the right host.
pub(crate) fn ask(port: u16, method: &str, path: &str) -> Answer {
    ask_as(port, &format!("127.0.0.1:{port}"), method, path)
}

/// A frame: its progress, and the power that leaves its elements, in any unit, all channels.
pub(crate) struct Frame {
    pub(crate) progress: Value,
    pub(crate) power: f64,
}

impl Frame {
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let (rest, length) = bytes.split_last_chunk::<4>().unwrap();
        let length = u32::from_le_bytes(*length) as usize;
        let (arrays, header) = rest.split_at(rest.len() - length);
        let mut header: Value = serde_json::from_slice(header).unwrap();
        let numbers = |name: &str| -> Vec<f64> {
            let all = header["arrays"].as_array().unwrap();
            let array = all.iter().find(|array| array["name"] == name).unwrap();
            let [offset, count] =
                ["offset", "count"].map(|key| array[key].as_u64().unwrap() as usize);
            let (numbers, _) = arrays[offset..offset + 4 * count].as_chunks::<4>();
            numbers.iter().map(|n| f64::from(f32::from_le_bytes(*n))).collect()
        };
        let (areas, exitance) = (numbers("areas"), numbers("exitance"));
        assert_eq!(3 * areas.len(), exitance.len());
        let power = exitance.iter().enumerate().map(|(i, b)| b * areas[i / 3]).sum();
        Self { progress: header["progress"].take(), power }
    }

    pub(crate) fn number(&self) -> u64 {
        self.progress["frame"].as_u64().unwrap()
    }
}

/// The next frame after one, however long it takes.
pub(crate) fn next(port: u16, token: &str, after: u64) -> Frame {
    loop {
        let answer = ask(port, "GET", &format!("/{token}/light?after={after}"));
        match answer.status {
            200 => return Frame::of(&answer.body),
            status => assert_eq!(status, 204),
        }
    }
}
