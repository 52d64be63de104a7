//! Files that are replaced atomically, or written by one program at a time.

use crate::apart::followed;
use std::collections::hash_map::RandomState;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Names that are tried before a folder is given up: two equal ones in a row are a matter of 2⁻⁶⁴.
const MOST_NAMES: u32 = 16;

/// A file under a random name, made by nobody else; removed unless it is renamed.
struct Fresh {
    path: PathBuf,
    file: File,
    renamed: bool,
}

impl Fresh {
    /// A file in the folder of another.
    fn beside(path: &Path) -> io::Result<Self> {
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut refused = io::Error::from(io::ErrorKind::AlreadyExists);
        for _ in 0..MOST_NAMES {
            let random = RandomState::new().build_hasher().finish();
            let path = folder.join(format!(".{random:016x}.tmp"));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => {
                    return Ok(Self {
                        path,
                        file,
                        renamed: false,
                    });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => refused = error,
                Err(error) => return Err(error),
            }
        }
        Err(refused)
    }
}

impl Drop for Fresh {
    fn drop(&mut self) {
        if !self.renamed {
            // A leftover does no harm.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Whether something is at this path that is no file: a device or a pipe, which is written to and never replaced.
fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| !metadata.is_file())
}

/// Replaces a file, or makes it: whenever the program or the machine stops, the old or the new one is complete. The content is written to a
/// file of a random name beside it, brought to the disk and renamed. A symbolic link stays and its target is replaced; a device or a
/// pipe is written to.
///
/// # Errors
/// A folder that can't be written to, a full disk; the old file is then as it was.
pub fn replace(path: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    if is_stream(path) {
        let mut stream = OpenOptions::new().write(true).open(path)?;
        stream.write_all(content.as_ref())?;
        return stream.flush();
    }
    let path = followed(path);
    let mut fresh = Fresh::beside(&path)?;
    fresh.file.write_all(content.as_ref())?;
    if let Ok(old) = fs::metadata(&path) {
        fresh.file.set_permissions(old.permissions())?;
    }
    fresh.file.sync_all()?;
    fs::rename(&fresh.path, &path)?;
    fresh.renamed = true;
    Ok(())
}

/// Whether a file can be written, to be asked before a long run and not after it. Nothing is left behind, and no file is touched.
///
/// # Errors
/// As of [`replace`].
pub fn can_be_written(path: &Path) -> io::Result<()> {
    if fs::metadata(path).is_ok_and(|metadata| metadata.is_dir()) {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if is_stream(path) {
        return Ok(());
    }
    Fresh::beside(&followed(path)).map(drop)
}

/// Opens a file that is written as a run proceeds, empty, for this program alone. Until it is closed, every other that opens
/// it in this way is refused, and what it has written stays.
///
/// # Errors
/// A file that another program is writing ([`io::ErrorKind::ResourceBusy`]) or that can't be written.
pub fn open_alone(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new()
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)?;
    if is_stream(path) {
        return Ok(file);
    }
    lock(&file)?;
    file.set_len(0)?;
    Ok(file)
}

/// Opens a file that is read first and then written on, for this program alone; what it holds stays.
///
/// # Errors
/// As of [`open_alone`].
pub fn continue_alone(path: &Path) -> io::Result<File> {
    let file = OpenOptions::new()
        .read(true)
        .append(true)
        .create(true)
        .open(path)?;
    lock(&file)?;
    Ok(file)
}

/// Keeps other programs that ask for it out of a folder until the lock is dropped; nothing where the system locks no folders.
///
/// # Errors
/// A folder that another program has locked: [`io::ErrorKind::ResourceBusy`].
pub fn lock_folder(path: &Path) -> io::Result<Option<File>> {
    let Ok(folder) = File::open(path) else {
        return Ok(None);
    };
    lock(&folder)?;
    Ok(Some(folder))
}

fn lock(file: &File) -> io::Result<()> {
    match file.try_lock() {
        // A file system without locks is no reason to write nothing.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
        Err(TryLockError::WouldBlock) => Err(io::Error::new(
            io::ErrorKind::ResourceBusy,
            "another program is writing it; wait for its end, or give another name",
        )),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A folder that is removed with its test.
    pub(crate) struct Folder(PathBuf);

    impl Folder {
        pub(crate) fn new(test: &str) -> Self {
            let path = std::env::temp_dir().join(format!("output-{}-{test}", std::process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        pub(crate) fn path(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        pub(crate) fn file(&self, name: &str, content: &str) -> PathBuf {
            fs::write(self.path(name), content).unwrap();
            self.path(name)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).unwrap();
            let mut names: Vec<String> = entries
                .map(|entry| entry.unwrap().file_name().into_string().unwrap())
                .collect();
            names.sort();
            names
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn exact_a_replaced_file_has_the_content_and_no_neighbour_is_touched() {
        let folder = Folder::new("replace");
        let path = folder.file("a.toml", "old");
        // The names that programs take for temporary files are somebody's files.
        for taken in ["a.toml.new", "a.toml.tmp", "a.toml.partial", "a.toml~"] {
            folder.file(taken, taken);
        }
        let before = folder.names();
        can_be_written(&path).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        replace(&path, "new").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "new");
        assert_eq!(folder.names(), before);
        for taken in before.iter().filter(|name| *name != "a.toml") {
            assert_eq!(&fs::read_to_string(folder.path(taken)).unwrap(), taken);
        }
        replace(&folder.path("b.toml"), "made").unwrap();
        assert_eq!(fs::read_to_string(folder.path("b.toml")).unwrap(), "made");
    }

    #[cfg(unix)]
    #[test]
    fn exact_a_link_stays_and_its_target_is_replaced_with_its_permissions() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = Folder::new("replace-link");
        let target = folder.file("target", "old");
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("target", folder.path("link")).unwrap();
        replace(&folder.path("link"), "new").unwrap();
        assert_eq!(fs::read_to_string(&target).unwrap(), "new");
        assert_eq!(fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(folder.path("link")).unwrap().is_symlink());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn exact_a_full_device_is_an_error() {
        let full = replace(Path::new("/dev/full"), "text");
        assert_eq!(full.unwrap_err().kind(), io::ErrorKind::StorageFull);
        replace(Path::new("/dev/null"), "text").unwrap();
    }

    #[test]
    fn exact_a_second_writer_is_refused_and_destroys_nothing() {
        let folder = Folder::new("alone");
        let path = folder.path("a.csv");
        let mut first = open_alone(&path).unwrap();
        first.write_all(b"row\n").unwrap();
        let second = open_alone(&path);
        assert_eq!(second.unwrap_err().kind(), io::ErrorKind::ResourceBusy);
        assert_eq!(fs::read_to_string(&path).unwrap(), "row\n");
        assert!(continue_alone(&path).is_err());
        drop(first);
        let third = continue_alone(&path).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "row\n");
        drop(third);
        drop(open_alone(&path).unwrap());
        assert_eq!(fs::read_to_string(&path).unwrap(), "");
    }

    #[test]
    fn exact_what_cannot_be_written_is_known_before() {
        let folder = Folder::new("before");
        assert!(can_be_written(&folder.path("no/such/folder.csv")).is_err());
        let is_a_folder = can_be_written(&folder.path("")).unwrap_err();
        assert_eq!(is_a_folder.kind(), io::ErrorKind::IsADirectory);
        can_be_written(&folder.path("a.csv")).unwrap();
        assert!(!folder.path("a.csv").exists());
    }
}
