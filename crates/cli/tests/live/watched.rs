//! The program with `--live`, until it ends.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};

/// A solve that is served.
pub(crate) struct Watched {
    child: Child,
    stderr: BufReader<ChildStderr>,
    said: String,
    pub(crate) port: u16,
    pub(crate) token: String,
}

impl Watched {
    /// Starts one, and waits until it says where it is.
    pub(crate) fn start(folder: &Path, args: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_radiosity"))
            .current_dir(folder)
            .args(args)
            .arg("--live")
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut said = String::new();
        let url = loop {
            let start = said.len();
            assert!(stderr.read_line(&mut said).unwrap() > 0, "{said}");
            if let Some(url) = said[start..].strip_prefix("live: http://127.0.0.1:") {
                break url.trim_end().to_owned();
            }
        };
        let (port, rest) = url.split_once('/').unwrap();
        let token = rest.strip_suffix('/').unwrap().to_owned();
        Self { child, stderr, said, port: port.parse().unwrap(), token }
    }

    /// Waits for its end: the exit code, and all that it said.
    pub(crate) fn end(mut self) -> (Option<i32>, String) {
        self.stderr.read_to_string(&mut self.said).unwrap();
        (self.child.wait().unwrap().code(), std::mem::take(&mut self.said))
    }
}

impl Drop for Watched {
    /// A test that fails leaves nothing running.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
