//! The readable part of a damaged recording, after a power cut, on a full disk or after a kill.
//!
//! CSV and JSON lines are complete up to the row that was being written, Parquet up to the last sound row group; a
//! Parquet file without its end has lost its description, and can't be read at all.

use super::{BlackBoxError, Recording};
use std::io::Read;

/// A recording, as far as it could be read.
#[derive(Debug)]
pub struct Recovered {
    /// All rows before the damage.
    pub recording: Recording,
    /// What stopped the reading; `None` if the recording is complete.
    pub damage: Option<BlackBoxError>,
}

impl Recovered {
    /// The rows that a reading put into this recording, and how the reading ended.
    pub(super) fn of(recording: Recording, read: Result<(), BlackBoxError>) -> Self {
        let damage = read.err();
        Self { recording, damage }
    }

    /// The recording if it is complete.
    ///
    /// # Errors
    /// The damage.
    pub fn whole(self) -> Result<Recording, BlackBoxError> {
        match self.damage {
            None => Ok(self.recording),
            Some(damage) => Err(damage),
        }
    }
}

/// A reader that remembers the last byte: a text whose last line has no end was cut off.
#[derive(Debug)]
pub(super) struct LastByte<R> {
    inner: R,
    pub(super) last: Option<u8>,
}

impl<R> LastByte<R> {
    pub(super) fn new(inner: R) -> Self {
        Self { inner, last: None }
    }

    /// Whether the text is empty or ends with the end of a line.
    pub(super) fn ends_with_a_line(&self) -> bool {
        self.last.is_none_or(|byte| byte == b'\n')
    }
}

impl<R: Read> Read for LastByte<R> {
    fn read(&mut self, to: &mut [u8]) -> std::io::Result<usize> {
        let count = self.inner.read(to)?;
        if let Some(&byte) = to[..count].last() {
            self.last = Some(byte);
        }
        Ok(count)
    }
}
