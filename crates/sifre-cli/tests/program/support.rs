//! Running the program in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A folder that is removed with the test.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// A new folder for the test of this name.
    pub(crate) fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("sifre-{}-{test}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder for temporary files");
        Self(path)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Writes a file in it.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, content).expect("the folder can be written to");
        path
    }

    /// The program with these arguments, to be run in the folder.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sifre"));
        command.current_dir(&self.0).args(arguments);
        command
    }

    /// Runs the program in it.
    pub(crate) fn run(&self, arguments: &[&str]) -> Ran {
        Ran(self.command(arguments).output().expect("the program starts"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// What the program did.
pub(crate) struct Ran(pub(crate) Output);

impl Ran {
    /// Checks the exit code.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Self {
        assert_eq!(
            self.0.status.code(),
            Some(code),
            "{}\n{}",
            self.text(),
            self.errors()
        );
        self
    }

    /// Checks what stands among the errors.
    #[track_caller]
    pub(crate) fn says(self, parts: &[&str]) -> Self {
        let errors = self.errors();
        for part in parts {
            assert!(errors.contains(part), "`{part}` is missing in: {errors}");
        }
        self
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.0.stdout).into_owned()
    }

    pub(crate) fn errors(&self) -> String {
        String::from_utf8_lossy(&self.0.stderr).into_owned()
    }

    /// Standard output as JSON.
    #[track_caller]
    pub(crate) fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.text()).unwrap_or_else(|error| panic!("{error} in: {}", self.text()))
    }
}

/// A ready scenario.
pub(crate) fn ready(name: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ready");
    fs::create_dir_all(&folder).expect("a folder of the tests' own");
    let path = folder.join(format!("{name}.toml"));
    let text = scenario::ready(name).expect("a ready scenario");
    // Renamed into place: tests beside this one may be reading the same file.
    let own = tempfile_beside(&path);
    fs::write(&own, text).expect("a file of this test's own");
    fs::rename(&own, &path).expect("within one folder");
    path.display().to_string()
}

/// A name beside `path` that no other test uses.
fn tempfile_beside(path: &Path) -> PathBuf {
    static USED: AtomicUsize = AtomicUsize::new(0);
    let number = USED.fetch_add(1, Ordering::Relaxed);
    path.with_extension(format!("{}-{number}", std::process::id()))
}
