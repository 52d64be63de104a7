//! Stills and checks by a Chromium without a window, where there is one.
//!
//! WebGL is drawn in software (SwiftShader), so that a still is the same on any machine without a graphics card.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Environment variable that names the browser to use.
pub const CHROMIUM: &str = "CHROMIUM";

/// Names under which the browser is looked for.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// How long a browser may take, s: it takes about three on an idle machine.
const PATIENCE_S: u64 = 120;

/// Time that passes inside the page before it is looked at, ms; waiting for nothing, it passes at once.
const PAGE_TIME_MS: u32 = 4000;

/// A Chromium on this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Browser {
    program: PathBuf,
}

/// Size of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Width, px of the page.
    pub width: u32,
    /// Height, px of the page.
    pub height: u32,
    /// Pixels of the picture per px of the page.
    pub scale: f64,
}

/// What a page has become after its scripts have run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visit {
    /// The document, as HTML.
    pub document: String,
    /// What it wrote to the console, errors among them, a line each.
    pub console: Vec<String>,
}

/// Why the browser gave nothing.
#[derive(Debug, thiserror::Error)]
pub enum BrowserError {
    /// It can't be started, or its files can't be written or read.
    #[error("{program}: {source}")]
    Io {
        /// The browser.
        program: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// It ended with an error.
    #[error("{program} ended with {status}: {message}")]
    Failed {
        /// The browser.
        program: PathBuf,
        /// How it ended.
        status: std::process::ExitStatus,
        /// The end of what it said.
        message: String,
    },
    /// It didn't end.
    #[error("{program} was still busy after {seconds} s and was stopped")]
    TooSlow {
        /// The browser.
        program: PathBuf,
        /// How long it was given, s.
        seconds: u64,
    },
}

impl Browser {
    /// The browser that the variable `CHROMIUM` names, or the first Chromium of the path.
    pub fn find() -> Option<Self> {
        if let Some(named) = std::env::var_os(CHROMIUM).filter(|name| !name.is_empty()) {
            return Some(Self { program: named.into() });
        }
        let path = std::env::var_os("PATH")?;
        let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
        let places = NAMES
            .iter()
            .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
        places
            .into_iter()
            .find(|place| place.is_file())
            .map(|program| Self { program })
    }

    /// A picture of a page as PNG. `hash` is what follows `#` in its address, as in `t=3.2&view=ets&still=1`.
    ///
    /// # Errors
    /// A browser that can't be started, fails or doesn't end.
    pub fn screenshot(&self, page: &str, hash: &str, size: Size) -> Result<Vec<u8>, BrowserError> {
        let folder = Folder::new().map_err(|source| self.io(source))?;
        let picture = folder.0.join("picture.png");
        let mut shot = std::ffi::OsString::from("--screenshot=");
        shot.push(&picture);
        self.run(page, hash, size, &folder.0, shot.as_os_str())?;
        std::fs::read(&picture).map_err(|source| self.io(source))
    }

    /// Loads a page, lets its scripts run and tells what came of it.
    ///
    /// # Errors
    /// A browser that can't be started, fails or doesn't end.
    pub fn visit(&self, page: &str, hash: &str, size: Size) -> Result<Visit, BrowserError> {
        let folder = Folder::new().map_err(|source| self.io(source))?;
        self.run(page, hash, size, &folder.0, "--dump-dom".as_ref())
    }

    fn io(&self, source: io::Error) -> BrowserError {
        let program = self.program.clone();
        BrowserError::Io { program, source }
    }

    fn run(
        &self,
        page: &str,
        hash: &str,
        size: Size,
        folder: &Path,
        task: &std::ffi::OsStr,
    ) -> Result<Visit, BrowserError> {
        let file = folder.join("page.html");
        let [out, log] = ["out", "log"].map(|name| folder.join(name));
        let open = |path: &Path| std::fs::File::create(path);
        let start = || -> io::Result<Child> {
            std::fs::write(&file, page)?;
            let mut address = std::ffi::OsString::from("file://");
            address.push(&file);
            address.push(format!("#{hash}"));
            let mut profile = std::ffi::OsString::from("--user-data-dir=");
            profile.push(folder.join("profile"));
            Command::new(&self.program)
                .args(FLAGS)
                .arg(profile)
                .arg(format!("--window-size={},{}", size.width, size.height))
                .arg(format!("--force-device-scale-factor={}", size.scale))
                .arg(format!("--virtual-time-budget={PAGE_TIME_MS}"))
                .arg(task)
                .arg(address)
                .stdin(Stdio::null())
                .stdout(open(&out)?)
                .stderr(open(&log)?)
                .spawn()
        };
        let mut child = start().map_err(|source| self.io(source))?;
        let status = self.wait(&mut child)?;
        let text = |path: &Path| std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let (document, log) = (
            text(&out).map_err(|source| self.io(source))?,
            text(&log).map_err(|source| self.io(source))?,
        );
        if !status.success() {
            let last: Vec<&str> = log.lines().rev().take(3).collect();
            return Err(BrowserError::Failed {
                program: self.program.clone(),
                status,
                message: last.join("; "),
            });
        }
        let console = log.lines().filter(|line| line.contains(":CONSOLE"));
        Ok(Visit {
            document,
            console: console.map(str::to_owned).collect(),
        })
    }

    fn wait(&self, child: &mut Child) -> Result<std::process::ExitStatus, BrowserError> {
        let start = Instant::now();
        loop {
            if let Some(status) = child.try_wait().map_err(|source| self.io(source))? {
                return Ok(status);
            }
            if start.elapsed() > Duration::from_secs(PATIENCE_S) {
                // It may have ended in between: nothing is lost then.
                let _ = child.kill().and_then(|()| child.wait());
                return Err(BrowserError::TooSlow {
                    program: self.program.clone(),
                    seconds: PATIENCE_S,
                });
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// No window, no network, no state from before; WebGL in software; the console to the log.
const FLAGS: [&str; 13] = [
    "--headless",
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
    "--enable-logging=stderr",
    "--run-all-compositor-stages-before-draw",
];

/// A folder of its own for one run, gone afterwards.
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
        // Left behind at worst, in the folder for temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
