//! A headless Chromium, driven through the pipes of its protocol: it clicks, reads and takes pictures.
//!
//! The browser reads commands from descriptor 3 and answers on 4, each message ended by a zero byte; a
//! shell gives it the child's standard input and output as these. Protocol:
//! <https://chromedevtools.github.io/devtools-protocol/>.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Names that Chromium goes by.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A page of software rendering on a busy machine comes up within this.
pub(crate) const PATIENCE: Duration = Duration::from_secs(90);

const START: &str = "exec \"$0\" --headless=new --no-sandbox --no-first-run --disable-extensions \
    --disable-background-networking --disable-component-update --disable-sync \
    --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars \
    --user-data-dir=\"$1\" --remote-debugging-pipe about:blank 3<&0 4>&1 0</dev/null 1>/dev/null 2>&1";

/// One browser with one page.
pub(crate) struct Browser {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    session: Option<String>,
    next: u64,
    /// What the page did without being asked: requests, messages, exceptions.
    events: Vec<Value>,
    _profile: tempfile::TempDir,
}

impl Browser {
    /// Starts one with a window of this size, or says that there is none.
    pub(crate) fn start(width: u32, height: u32) -> Option<Self> {
        let found = |name: &&&str| {
            let version = Command::new(name).arg("--version").stdin(Stdio::null()).output();
            version.is_ok_and(|output| output.status.success())
        };
        let Some(name) = NAMES.iter().find(found) else {
            println!("skipped: there is none of {}", NAMES.join(", "));
            return None;
        };
        let profile = tempfile::tempdir().unwrap();
        let mut child = Command::new("sh")
            .args(["-c", START, name])
            .arg(profile.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut browser = Self {
            child,
            to,
            from: BufReader::new(from),
            session: None,
            next: 0,
            events: Vec::new(),
            _profile: profile,
        };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.call("Target.attachToTarget", attach);
        browser.session = Some(session["sessionId"].as_str().unwrap().to_owned());
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        browser.call("Emulation.setFocusEmulationEnabled", json!({ "enabled": true }));
        browser.size(width, height);
        Some(browser)
    }

    /// Gives the window another size.
    pub(crate) fn size(&mut self, width: u32, height: u32) {
        let size =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", size);
    }

    /// Opens a page of the disk and waits until it shows its scene.
    pub(crate) fn open(&mut self, path: &Path) {
        self.go(&format!("file://{}", path.display()));
        self.until("document.getElementById('camera')?.options.length > 0");
        self.settle();
    }

    /// Opens an address.
    pub(crate) fn go(&mut self, address: &str) {
        self.events.clear();
        self.call("Page.navigate", json!({ "url": address }));
    }

    /// Waits until an expression holds.
    pub(crate) fn until(&mut self, expression: &str) {
        let clock = Instant::now();
        while self.value(expression) != Value::Bool(true) {
            assert!(clock.elapsed() < PATIENCE, "never: {expression}\n{:?}", self.complaints());
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits until what was changed is drawn.
    pub(crate) fn settle(&mut self) {
        self.value(
            "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))",
        );
    }

    /// The value of an expression in the page; null for what is thrown.
    pub(crate) fn value(&mut self, expression: &str) -> Value {
        let how = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        self.call("Runtime.evaluate", how)["result"]["value"].take()
    }

    /// The number in an attribute `value`, of the first element that a selector finds.
    pub(crate) fn number(&mut self, selector: &str) -> f64 {
        let value = self.value(&format!("document.querySelector({}).value", json!(selector)));
        value
            .as_str()
            .and_then(|text| text.parse().ok())
            .unwrap_or_else(|| panic!("{selector}: {value}"))
    }

    /// The text of the first element that a selector finds.
    pub(crate) fn text(&mut self, selector: &str) -> String {
        let text = self.value(&format!("document.querySelector({}).textContent", json!(selector)));
        text.as_str().unwrap_or_else(|| panic!("nothing is {selector}")).to_owned()
    }

    /// Presses the mouse and lets it go.
    pub(crate) fn click(&mut self, x: f64, y: f64) {
        for kind in ["mousePressed", "mouseReleased"] {
            let mouse = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", mouse);
        }
    }

    /// Presses a key, does something, and lets it go.
    pub(crate) fn hold(&mut self, key: &str, code: &str, meanwhile: impl FnOnce(&mut Self)) {
        let send = |browser: &mut Self, kind: &str| {
            browser
                .call("Input.dispatchKeyEvent", json!({ "type": kind, "key": key, "code": code }));
        };
        send(self, "keyDown");
        meanwhile(self);
        send(self, "keyUp");
    }

    /// The window as rows of red, green and blue.
    pub(crate) fn picture(&mut self) -> Picture {
        self.settle();
        let data = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        let bytes = decode(data["data"].as_str().unwrap());
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let samples = info.color_type.samples();
        Picture { width: info.width as usize, samples, pixels }
    }

    /// Addresses that were asked for, that of the page itself among them.
    pub(crate) fn requests(&mut self) -> Vec<String> {
        // What is on its way arrives before the answer to a question.
        self.value("0");
        let asked = self.events.iter().filter(|e| e["method"] == "Network.requestWillBeSent");
        asked
            .map(|e| e["params"]["request"]["url"].as_str().unwrap_or_default().to_owned())
            .collect()
    }

    /// Errors and warnings that the page logged, and exceptions.
    pub(crate) fn complaints(&mut self) -> Vec<String> {
        self.value("0");
        let bad = |e: &&Value| {
            let (method, params) = (e["method"].as_str().unwrap_or_default(), &e["params"]);
            let level = params["entry"]["level"].as_str().or(params["type"].as_str());
            match method {
                "Runtime.exceptionThrown" => true,
                "Log.entryAdded" | "Runtime.consoleAPICalled" => {
                    // Software rendering is what was asked for.
                    matches!(level, Some("error" | "warning" | "assert"))
                        && !e.to_string().contains("GPU stall due to ReadPixels")
                        && !e.to_string().contains("software WebGL")
                }
                _ => false,
            }
        };
        self.events.iter().filter(bad).map(ToString::to_string).collect()
    }

    /// Sends a command and waits for its answer.
    fn call(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let mut message = json!({ "id": self.next, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.to.write_all(format!("{message}\0").as_bytes()).unwrap();
        loop {
            let mut bytes = Vec::new();
            let length = self.from.read_until(0, &mut bytes).unwrap();
            assert!(length > 1, "{method}: the browser is gone");
            bytes.pop();
            let mut answer: Value = serde_json::from_slice(&bytes).unwrap();
            if answer["id"] == self.next {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].take();
            }
            self.events.push(answer);
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It ends where nobody listens; what is left of it is ended.
        let _ = self.to.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        let clock = Instant::now();
        while clock.elapsed() < Duration::from_secs(5) {
            if matches!(self.child.try_wait(), Ok(Some(_))) {
                return;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What a window showed.
pub(crate) struct Picture {
    pub(crate) width: usize,
    samples: usize,
    pixels: Vec<u8>,
}

impl Picture {
    /// Red, green and blue of a pixel.
    pub(crate) fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let start = (y * self.width + x) * self.samples;
        [0, 1, 2].map(|c| self.pixels[start + c])
    }
}

/// Bytes of base64 text, by the table of RFC 4648.
fn decode(text: &str) -> Vec<u8> {
    let value = |c: u8| match c {
        b'A'..=b'Z' => u32::from(c - b'A'),
        b'a'..=b'z' => u32::from(c - b'a') + 26,
        b'0'..=b'9' => u32::from(c - b'0') + 52,
        b'+' => 62,
        _ => 63,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for four in text.as_bytes().chunks(4) {
        let bits =
            four.iter().fold(0, |bits, c| bits << 6 | if *c == b'=' { 0 } else { value(*c) });
        bytes.extend_from_slice(&bits.to_be_bytes()[1..]);
    }
    let padding = text.bytes().rev().take_while(|c| *c == b'=').count();
    bytes.truncate(bytes.len() - padding);
    bytes
}
