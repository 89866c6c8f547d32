//! The server: loopback alone, one request a connection, a thread for each.

use std::fmt::Write as _;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::exchange::Exchange;
use super::request::{self, Asked, BAD, Refusal};

/// A browser sends less than this before what it has to say is whole, bytes.
const MOST_HEAD: usize = 16 * 1024;
/// More at once are turned away: a page makes two.
const MOST_CONNECTIONS: usize = 16;
/// Who says or takes nothing for this long is gone.
const PATIENCE: Duration = Duration::from_secs(30);
/// A question for light waits this long for a frame.
const FRAME_WAIT: Duration = Duration::from_secs(1);
/// Random bytes in the token: more than can be guessed.
const TOKEN_BYTES: usize = 16;

/// A server that runs until it is dropped.
pub(super) struct Server {
    address: SocketAddr,
    pub(super) token: String,
    closing: Arc<AtomicBool>,
    accepting: Option<JoinHandle<()>>,
}

/// What every connection works with.
struct Shared {
    page: Vec<u8>,
    token: String,
    port: u16,
    exchange: Arc<Exchange>,
    connections: AtomicUsize,
}

impl Server {
    /// Opens the port, 0 for any that is free.
    pub(super) fn open(port: u16, page: Vec<u8>, exchange: Arc<Exchange>) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let address = listener.local_addr()?;
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}");
        }
        let shared = Arc::new(Shared {
            page,
            token: token.clone(),
            port: address.port(),
            exchange,
            connections: AtomicUsize::new(0),
        });
        let closing = Arc::new(AtomicBool::new(false));
        let heard = Arc::clone(&closing);
        let accepting = thread::Builder::new()
            .name("live".into())
            .spawn(move || accept(&listener, &shared, &heard))?;
        Ok(Self { address, token, closing, accepting: Some(accepting) })
    }

    /// Where the page is.
    pub(super) fn url(&self) -> String {
        format!("http://{}/{}/", self.address, self.token)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.closing.store(true, Ordering::Relaxed);
        // It looks once more when someone comes.
        if TcpStream::connect_timeout(&self.address, PATIENCE).is_ok()
            && let Some(accepting) = self.accepting.take()
        {
            let _ = accepting.join();
        }
    }
}

fn accept(listener: &TcpListener, shared: &Arc<Shared>, closing: &AtomicBool) {
    for stream in listener.incoming() {
        if closing.load(Ordering::Relaxed) {
            return;
        }
        let Ok(stream) = stream else {
            // Out of descriptors, perhaps: not again at once.
            thread::sleep(Duration::from_millis(10));
            continue;
        };
        if shared.connections.fetch_add(1, Ordering::Relaxed) >= MOST_CONNECTIONS {
            shared.connections.fetch_sub(1, Ordering::Relaxed);
            continue;
        }
        let own = Arc::clone(shared);
        let serving = thread::Builder::new().name("live reader".into()).spawn(move || {
            // A reader that went away is no reason to say anything.
            let _ = serve(stream, &own);
            own.connections.fetch_sub(1, Ordering::Relaxed);
        });
        if serving.is_err() {
            shared.connections.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

fn serve(mut stream: TcpStream, shared: &Shared) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let asked = hear(&mut stream, shared)?;
    let _answering = shared.exchange.answering();
    match asked {
        Ok(Asked::Page) => {
            answer(&mut stream, (200, "OK"), "text/html; charset=utf-8", &shared.page)
        }
        Ok(Asked::Light(after)) => match shared.exchange.newer(after, FRAME_WAIT) {
            Some(frame) => answer(&mut stream, (200, "OK"), "application/octet-stream", &frame),
            None => answer(&mut stream, (204, "No Content"), "", b""),
        },
        Ok(Asked::Stop) => {
            shared.exchange.stop();
            answer(&mut stream, (204, "No Content"), "", b"")
        }
        Err(Refusal(code, phrase)) => {
            answer(&mut stream, (code, phrase), "text/plain", phrase.as_bytes())
        }
    }
}

/// Reads until the head of a request is whole.
fn hear(stream: &mut TcpStream, shared: &Shared) -> io::Result<Result<Asked, Refusal>> {
    let mut head = Vec::new();
    let mut piece = [0; 4096];
    loop {
        let read = stream.read(&mut piece)?;
        head.extend_from_slice(&piece[..read]);
        if let Some(asked) = request::read(&head, &shared.token, shared.port) {
            return Ok(asked);
        }
        if read == 0 || head.len() > MOST_HEAD {
            return Ok(Err(BAD));
        }
    }
}

fn answer(
    stream: &mut TcpStream,
    (code, phrase): (u16, &str),
    kind: &str,
    body: &[u8],
) -> io::Result<()> {
    let mut head = format!("HTTP/1.1 {code} {phrase}\r\nConnection: close\r\n");
    // 204 has neither type nor length.
    if !kind.is_empty() {
        let _ = write!(head, "Content-Type: {kind}\r\nContent-Length: {}\r\n", body.len());
    }
    // Nothing is kept, framed by another page, or told to where a link leads.
    head += "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
             Referrer-Policy: no-referrer\r\nContent-Security-Policy: frame-ancestors 'none'\r\n\r\n";
    stream.write_all(head.as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}
