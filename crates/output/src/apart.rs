//! Which files are the same, whatever they are called.

use std::fmt;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

/// The path of standard input: what a shell redirects to it is an input like any other.
pub const STANDARD_INPUT: &str = "/dev/stdin";

/// The path of standard output: a file that a shell redirects it to is an output like any other.
const STANDARD_OUTPUT: &str = "/dev/stdout";

/// Symbolic links that are followed before a name is taken as it is: as many as Linux follows.
const MOST_LINKS: u32 = 40;

/// An output that is another file of the same run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Clash {
    /// An output is an input.
    Input {
        /// The output, as it was given.
        output: PathBuf,
        /// The input, as it was given.
        input: PathBuf,
    },
    /// Two outputs are one file.
    Output {
        /// The first, as it was given.
        output: PathBuf,
        /// The second, as it was given.
        other: PathBuf,
    },
}

impl fmt::Display for Clash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input { output, input } if output == input => {
                write!(f, "{} is an input and would be overwritten", output.display())
            }
            Self::Input { output, input } => write!(
                f,
                "{} is the input {} under another name and would be overwritten",
                output.display(),
                input.display()
            ),
            Self::Output { output, other } => {
                write!(
                    f,
                    "{} and {} are the same file",
                    output.display(),
                    other.display()
                )
            }
        }?;
        write!(f, ": give the output another name")
    }
}

impl std::error::Error for Clash {}

/// What a file is, whatever it is called.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Identity {
    /// A file that exists.
    #[cfg(unix)]
    Node { device: u64, inode: u64 },
    /// A file that does not exist yet, or a system without inodes.
    Name(PathBuf),
}

impl Identity {
    /// The identity of what a path leads to; nothing for what is no file on a disk (a device, a pipe, a folder), which can't be overwritten.
    fn of(path: &Path) -> Option<Self> {
        match fs::metadata(path) {
            Ok(metadata) if metadata.is_file() => Some(Self::of_existing(path, &metadata)),
            Ok(_) => None,
            Err(_) => Some(Self::Name(canonical(&followed(path)))),
        }
    }

    #[cfg(unix)]
    fn of_existing(_: &Path, metadata: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self::Node {
            device: metadata.dev(),
            inode: metadata.ino(),
        }
    }

    #[cfg(not(unix))]
    fn of_existing(path: &Path, _: &Metadata) -> Self {
        Self::Name(canonical(path))
    }
}

/// Where a path leads to after its symbolic links, the last of which may lead to nothing.
pub(crate) fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(target) = fs::read_link(&path) else {
            break;
        };
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    path
}

/// The absolute path of a file that may not exist: its folder without links, and its name.
fn canonical(path: &Path) -> PathBuf {
    let whole = || std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    if let Ok(path) = path.canonicalize() {
        return path;
    }
    let whole = whole();
    let folder = whole.parent().and_then(|folder| folder.canonicalize().ok());
    match (folder, whole.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => whole,
    }
}

/// Refuses outputs that are inputs, and outputs that are each other, under any name: other spellings of a path, symbolic and hard links,
/// files that a shell has redirected standard output to. To be called before any of them is opened.
///
/// Devices and pipes are never refused: nothing in them can be overwritten.
///
/// # Errors
/// The first clash.
pub fn keep_apart(inputs: &[PathBuf], outputs: &[PathBuf]) -> Result<(), Clash> {
    let identified = |path: &PathBuf| Identity::of(path).map(|identity| (path.clone(), identity));
    let inputs: Vec<_> = inputs.iter().filter_map(identified).collect();
    let standard = Path::new(STANDARD_OUTPUT).to_owned();
    let mut written: Vec<_> = Some(standard)
        .filter(|path| fs::metadata(path).is_ok_and(|to| to.is_file()))
        .iter()
        .filter_map(identified)
        .collect();
    for (output, identity) in outputs.iter().filter_map(identified) {
        if let Some((input, _)) = inputs.iter().find(|(_, other)| *other == identity) {
            let input = input.clone();
            return Err(Clash::Input { output, input });
        }
        if let Some((other, _)) = written.iter().find(|(_, other)| *other == identity) {
            let other = other.clone();
            return Err(Clash::Output { output, other });
        }
        written.push((output, identity));
    }
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::replace::tests::Folder;
    use std::os::unix::fs::symlink;

    #[test]
    fn exact_no_name_and_no_link_hides_an_input() {
        let folder = Folder::new("apart");
        let input = folder.file("scenario.toml", "x");
        fs::create_dir(folder.path("in")).unwrap();
        let names = ["hard", "soft", "soft-to-soft", "in/up"].map(|name| folder.path(name));
        fs::hard_link(&input, &names[0]).unwrap();
        symlink("scenario.toml", &names[1]).unwrap();
        symlink("soft", &names[2]).unwrap();
        symlink("../scenario.toml", &names[3]).unwrap();
        let spelled = [
            input.clone(),
            folder.path("./scenario.toml"),
            folder.path("in/../scenario.toml"),
        ];
        for output in names.into_iter().chain(spelled) {
            let clash = keep_apart(std::slice::from_ref(&input), std::slice::from_ref(&output));
            let input = input.clone();
            assert_eq!(clash, Err(Clash::Input { output, input }));
        }
        keep_apart(&[input], &[folder.path("other.toml")]).unwrap();
    }

    #[test]
    fn exact_two_outputs_are_told_apart_before_they_exist() {
        let folder = Folder::new("apart-outputs");
        symlink("later.csv", folder.path("link.csv")).unwrap();
        let later = folder.path("later.csv");
        for other in ["later.csv", "./later.csv", "link.csv"] {
            let other = folder.path(other);
            let clash = keep_apart(&[], &[later.clone(), other.clone()]);
            assert_eq!(
                clash,
                Err(Clash::Output {
                    output: other,
                    other: later.clone()
                })
            );
        }
        keep_apart(&[], &[later, folder.path("now.csv")]).unwrap();
    }

    #[test]
    fn exact_devices_are_read_and_written_at_once() {
        let null = PathBuf::from("/dev/null");
        keep_apart(std::slice::from_ref(&null), &[null.clone(), null.clone()]).unwrap();
    }

    #[test]
    fn exact_a_ring_of_links_ends() {
        let folder = Folder::new("apart-ring");
        symlink("b", folder.path("a")).unwrap();
        symlink("a", folder.path("b")).unwrap();
        keep_apart(&[folder.path("a")], &[folder.path("c")]).unwrap();
    }
}
