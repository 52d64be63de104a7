//! A Chromium without a window, where there is one: stills of an animation, and the page as a reader would use it.
//!
//! It is driven by the DevTools protocol over a pipe: JSON messages, each ended by a zero byte, on the file descriptors 3 and 4
//! of the browser, which a shell puts there (so on Unix only). WebGL is drawn in software (SwiftShader), so that a still is
//! the same on any machine without a graphics card.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// Environment variable that names the browser to use.
pub const CHROMIUM: &str = "CHROMIUM";

/// Names under which the browser is looked for.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// How long the browser may be silent, s: it answers within one or two on an idle machine.
const PATIENCE_S: u64 = 120;

/// Puts the pipes from and to us where the browser looks for them.
const SHELL: &str = "exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >/dev/null";

/// No window, no network, no state from before; WebGL in software.
const FLAGS: [&str; 13] = [
    "--headless",
    "--remote-debugging-pipe",
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
    "--force-color-profile=srgb",
];

/// A Chromium on this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Browser {
    program: PathBuf,
}

/// Size of a page and of its picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Width, px of the page.
    pub width: u32,
    /// Height, px of the page.
    pub height: u32,
    /// Pixels of the picture per px of the page.
    pub scale: f64,
}

/// A page open in a browser of its own, which ends with it.
#[derive(Debug)]
pub struct Page {
    program: PathBuf,
    child: Child,
    /// `None` once the browser has been asked to end.
    to_browser: Option<ChildStdin>,
    from_browser: Receiver<Value>,
    session: Option<String>,
    sent: u64,
    console: Vec<String>,
    folder: Folder,
}

/// Why the browser gave nothing.
#[derive(Debug, thiserror::Error)]
pub enum BrowserError {
    /// It can't be started, or its files can't be written.
    #[error("{program}: {source}")]
    Io {
        /// The browser.
        program: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// It ended.
    #[error("{program} ended during {method}")]
    Ended {
        /// The browser.
        program: PathBuf,
        /// What it was asked.
        method: String,
    },
    /// It doesn't answer.
    #[error("{program} did not complete {method} within {seconds} s")]
    TooSlow {
        /// The browser.
        program: PathBuf,
        /// What it was asked.
        method: String,
        /// How long it was given, s.
        seconds: u64,
    },
    /// It refused.
    #[error("{program} failed in {method}: {message}")]
    Refused {
        /// The browser.
        program: PathBuf,
        /// What it was asked.
        method: String,
        /// Its answer.
        message: String,
    },
}

impl Browser {
    /// The browser that the variable `CHROMIUM` names, or the first Chromium of the path; none where there is no Unix shell.
    pub fn find() -> Option<Self> {
        if !cfg!(unix) {
            return None;
        }
        if let Some(named) = std::env::var_os(CHROMIUM).filter(|name| !name.is_empty()) {
            return Some(Self {
                program: named.into(),
            });
        }
        let path = std::env::var_os("PATH")?;
        let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
        let mut places = NAMES
            .iter()
            .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
        places
            .find(|place| place.is_file())
            .map(|program| Self { program })
    }

    /// A picture of a page as PNG. `hash` is what follows `#` in its address, as in `t=3.2&view=ets&still=1`.
    ///
    /// # Errors
    /// A browser that can't be started, ends or doesn't answer.
    pub fn screenshot(&self, html: &str, hash: &str, size: Size) -> Result<Vec<u8>, BrowserError> {
        self.open(html, hash, size)?.screenshot()
    }

    /// Opens a page; returns when its scripts have run and it has been drawn.
    ///
    /// # Errors
    /// A browser that can't be started, ends or doesn't answer.
    pub fn open(&self, html: &str, hash: &str, size: Size) -> Result<Page, BrowserError> {
        let mut page = self.start(html).map_err(|source| BrowserError::Io {
            program: self.program.clone(),
            source,
        })?;
        let target = page.ask("Target.createTarget", &json!({ "url": "about:blank" }))?;
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let session = page.ask("Target.attachToTarget", &attach)?;
        page.session = session["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log"] {
            page.ask(&format!("{domain}.enable"), &json!({}))?;
        }
        let (width, height, scale) = (size.width, size.height, size.scale);
        page.ask(
            "Emulation.setDeviceMetricsOverride",
            &json!({ "width": width, "height": height, "deviceScaleFactor": scale, "mobile": false }),
        )?;
        let address = format!("file://{}#{hash}", page.folder.0.join("page.html").display());
        page.ask("Page.navigate", &json!({ "url": address }))?;
        page.wait("Page.loadEventFired")?;
        page.drawn()?;
        Ok(page)
    }

    fn start(&self, html: &str) -> io::Result<Page> {
        let folder = Folder::new()?;
        std::fs::write(folder.0.join("page.html"), html)?;
        let mut profile = OsString::from("--user-data-dir=");
        profile.push(folder.0.join("profile"));
        let mut child = Command::new("sh")
            .args(["-c", SHELL])
            .arg(&self.program)
            .args(FLAGS)
            .arg(profile)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let (answers, from_browser) = channel();
        if let Some(stdout) = child.stdout.take() {
            std::thread::spawn(move || listen(stdout, &answers));
        }
        Ok(Page {
            program: self.program.clone(),
            to_browser: child.stdin.take(),
            child,
            from_browser,
            session: None,
            sent: 0,
            console: Vec::new(),
            folder,
        })
    }
}

/// Hands on the browser's messages until it ends.
fn listen(stdout: ChildStdout, answers: &std::sync::mpsc::Sender<Value>) {
    let messages = BufReader::new(stdout).split(0).map_while(Result::ok);
    for message in messages {
        let Ok(message) = serde_json::from_slice(&message) else {
            continue;
        };
        if answers.send(message).is_err() {
            return;
        }
    }
}

impl Page {
    /// What a script gives: an expression, or a promise of one.
    ///
    /// # Errors
    /// A script that throws; a browser that ends or doesn't answer.
    pub fn evaluate(&mut self, script: &str) -> Result<Value, BrowserError> {
        let method = "Runtime.evaluate";
        let asked = json!({ "expression": script, "awaitPromise": true, "returnByValue": true });
        let answer = self.ask(method, &asked)?;
        if let Some(exception) = answer.get("exceptionDetails") {
            return Err(BrowserError::Refused {
                program: self.program.clone(),
                method: method.to_owned(),
                message: exception.to_string(),
            });
        }
        Ok(answer["result"]["value"].clone())
    }

    /// A picture of the page as PNG.
    ///
    /// # Errors
    /// A browser that ends or doesn't answer.
    pub fn screenshot(&mut self) -> Result<Vec<u8>, BrowserError> {
        let method = "Page.captureScreenshot";
        let answer = self.ask(method, &json!({ "format": "png" }))?;
        let text = answer["data"].as_str().unwrap_or_default();
        STANDARD.decode(text).map_err(|error| BrowserError::Refused {
            program: self.program.clone(),
            method: method.to_owned(),
            message: error.to_string(),
        })
    }

    /// What has been written to the console so far, exceptions among it.
    pub fn console(&self) -> &[String] {
        &self.console
    }

    /// Waits until what has changed is on the screen.
    fn drawn(&mut self) -> Result<(), BrowserError> {
        let two_frames =
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))";
        self.evaluate(two_frames).map(|_| ())
    }

    /// Asks the browser, or the page once there is one.
    fn ask(&mut self, method: &str, parameters: &Value) -> Result<Value, BrowserError> {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let ended = || BrowserError::Ended {
            program: self.program.clone(),
            method: method.to_owned(),
        };
        let pipe = self.to_browser.as_mut().ok_or_else(ended)?;
        let mut text = message.to_string().into_bytes();
        text.push(0);
        pipe.write_all(&text)
            .and_then(|()| pipe.flush())
            .map_err(|_| ended())?;
        let id = json!(self.sent);
        let answer = self.receive(method, |message| message["id"] == id)?;
        if let Some(error) = answer.get("error") {
            return Err(BrowserError::Refused {
                program: self.program.clone(),
                method: method.to_owned(),
                message: error["message"].as_str().unwrap_or("no reason given").to_owned(),
            });
        }
        Ok(answer["result"].clone())
    }

    /// Waits for an event.
    fn wait(&mut self, event: &str) -> Result<(), BrowserError> {
        self.receive(event, |message| message["method"] == event)
            .map(|_| ())
    }

    /// The next message that is the one wanted; what is written to the console meanwhile is kept.
    fn receive(&mut self, method: &str, wanted: impl Fn(&Value) -> bool) -> Result<Value, BrowserError> {
        loop {
            let program = self.program.clone();
            let method = method.to_owned();
            let message = self
                .from_browser
                .recv_timeout(Duration::from_secs(PATIENCE_S))
                .map_err(|error| match error {
                    RecvTimeoutError::Disconnected => BrowserError::Ended { program, method },
                    RecvTimeoutError::Timeout => BrowserError::TooSlow {
                        program,
                        method,
                        seconds: PATIENCE_S,
                    },
                })?;
            if let "Runtime.consoleAPICalled" | "Runtime.exceptionThrown" | "Log.entryAdded" =
                message["method"].as_str().unwrap_or_default()
            {
                self.console.push(message["params"].to_string());
            }
            if wanted(&message) {
                return Ok(message);
            }
        }
    }
}

impl Drop for Page {
    /// Ends the browser; an error leaves nothing to be done.
    fn drop(&mut self) {
        self.to_browser = None;
        let _ = self.child.kill().and_then(|()| self.child.wait().map(|_| ()));
    }
}

/// A folder of its own for one run, gone afterwards.
#[derive(Debug)]
struct Folder(PathBuf);

impl Folder {
    fn new() -> io::Result<Self> {
        use std::sync::atomic::{AtomicU32, Ordering};
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("animate-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        Ok(Self(folder))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Processes of the browser may still be writing as they end; what is left stays in the folder for temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
