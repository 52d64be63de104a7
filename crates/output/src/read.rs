//! Reads that end, whatever they are given: a device is endless and a file can be larger than memory.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Most bytes of a text that people write (a scenario, a vehicle, a room): a thousand times the largest so far.
pub const TEXT_LIMIT: u64 = 16 << 20;

/// What is read when a limit is exceeded.
fn too_long(limit: u64) -> io::Error {
    let size = if limit >= 1 << 20 {
        format!("{} MiB", limit >> 20)
    } else {
        format!("{limit} bytes")
    };
    io::Error::new(
        io::ErrorKind::FileTooLarge,
        format!("longer than {size}, the limit for such a file"),
    )
}

/// A reader that fails behind so many bytes instead of reading on.
#[derive(Debug)]
pub struct Bounded<R> {
    inner: R,
    left: u64,
    limit: u64,
}

impl<R: Read> Bounded<R> {
    /// At most `limit` bytes of a reader; one more is [`io::ErrorKind::FileTooLarge`].
    pub fn new(inner: R, limit: u64) -> Self {
        Self {
            inner,
            left: limit,
            limit,
        }
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 {
            // Only the end may follow.
            let mut one = [0];
            return match to.is_empty() || self.inner.read(&mut one)? == 0 {
                true => Ok(0),
                false => Err(too_long(self.limit)),
            };
        }
        let most = usize::try_from(self.left).map_or(to.len(), |left| left.min(to.len()));
        let count = self.inner.read(&mut to[..most])?;
        self.left -= count as u64;
        Ok(count)
    }
}

/// The bytes of a file.
///
/// # Errors
/// A file that can't be read, or that is longer than `limit`, bytes: [`io::ErrorKind::FileTooLarge`].
pub fn read_bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    // A file that says its size is refused at once; a device or a pipe where the limit is reached.
    if file.metadata().is_ok_and(|metadata| metadata.len() > limit) {
        return Err(too_long(limit));
    }
    let mut bytes = Vec::new();
    Bounded::new(file, limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a file.
///
/// # Errors
/// As of [`read_bytes`]; text that is not UTF-8.
pub fn read_text(path: &Path, limit: u64) -> io::Result<String> {
    let bytes = read_bytes(path, limit)?;
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..place].iter().filter(|b| **b == b'\n').count();
        io::Error::new(
            io::ErrorKind::InvalidData,
            format!("line {line} is not UTF-8 text"),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replace::tests::Folder;
    use proptest::prelude::*;

    #[cfg(unix)]
    #[test]
    fn exact_an_endless_device_ends_at_the_limit() {
        let zeros = read_bytes(Path::new("/dev/zero"), 1000);
        assert_eq!(zeros.unwrap_err().kind(), io::ErrorKind::FileTooLarge);
    }

    #[test]
    fn exact_a_text_that_is_none_is_told_with_its_line() {
        let folder = Folder::new("read");
        let path = folder.path("a.toml");
        std::fs::write(&path, b"a = 1\nb = \xff\n").unwrap();
        assert_eq!(
            read_text(&path, 100).unwrap_err().to_string(),
            "line 2 is not UTF-8 text"
        );
        assert!(
            read_text(&path, 3)
                .unwrap_err()
                .to_string()
                .contains("longer than 3 bytes")
        );
    }

    proptest! {
        #[test]
        fn prop_all_bytes_up_to_the_limit_and_none_beyond(bytes in prop::collection::vec(any::<u8>(), 0..200), limit in 0..200_u64) {
            let mut read = Vec::new();
            let result = Bounded::new(bytes.as_slice(), limit).read_to_end(&mut read);
            prop_assert_eq!(result.is_ok(), bytes.len() as u64 <= limit);
            prop_assert_eq!(&read[..], &bytes[..bytes.len().min(limit as usize)]);
        }
    }
}
