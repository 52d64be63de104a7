//! Lines of bounded length from any reader, and the recognition of files that are no tables.

use super::{FileKind, ReadError};
use std::io::{BufRead, BufReader, Read};

/// Longest line, bytes. The widest of the known data sets has lines of 700.
const LONGEST_LINE: usize = 64 * 1024;

/// A reader by lines that holds one line at a time.
pub(super) struct Lines<R> {
    input: BufReader<R>,
    buffer: Vec<u8>,
    line: u64,
    seen_content: bool,
}

impl<R: Read> Lines<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input: BufReader::new(input),
            buffer: Vec::new(),
            line: 0,
            seen_content: false,
        }
    }

    /// The next line that is neither empty nor a comment, with its number; `None` at the end.
    pub(super) fn next_content(&mut self) -> Result<Option<(u64, &str)>, ReadError> {
        loop {
            if !self.fill()? {
                return Ok(None);
            }
            let line = self.line;
            let bytes = self.buffer.trim_ascii();
            if bytes.is_empty() || bytes[0] == b'#' {
                continue;
            }
            let kind = |kind| ReadError::OtherKind { line, kind };
            if bytes.contains(&0) || std::str::from_utf8(bytes).is_err() {
                return Err(kind(FileKind::Binary));
            }
            break;
        }
        let line = self.line;
        // Checked to be text in the loop; borrowed anew, since the borrow there would outlive the next reading.
        let text = std::str::from_utf8(self.buffer.trim_ascii()).unwrap_or_default();
        if !self.seen_content {
            self.seen_content = true;
            if let Some(kind) = other_kind(text) {
                return Err(ReadError::OtherKind { line, kind });
            }
        }
        Ok(Some((line, text)))
    }

    /// Reads the next line into the buffer; whether there was one.
    fn fill(&mut self) -> Result<bool, ReadError> {
        self.buffer.clear();
        self.line += 1;
        let line = self.line;
        let mut bounded = self.input.by_ref().take(LONGEST_LINE as u64 + 1);
        let count = bounded
            .read_until(b'\n', &mut self.buffer)
            .map_err(|source| ReadError::Io { line, source })?;
        if count > LONGEST_LINE && self.buffer.last() != Some(&b'\n') {
            return Err(self.too_long());
        }
        if self.line == 1 && self.buffer.starts_with(BYTE_ORDER_MARK) {
            self.buffer.drain(..BYTE_ORDER_MARK.len());
        }
        Ok(count > 0)
    }

    /// A line without end is a table's in no case; bytes that are no text say better what it is.
    fn too_long(&self) -> ReadError {
        if self.buffer.contains(&0) {
            ReadError::OtherKind {
                line: self.line,
                kind: FileKind::Binary,
            }
        } else {
            ReadError::LineTooLong {
                line: self.line,
                limit: LONGEST_LINE,
            }
        }
    }
}

/// What some programs write at the start of UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// What the first line with content shows about a file that is not a CSV table.
fn other_kind(first: &str) -> Option<FileKind> {
    if first.starts_with('<') {
        return Some(FileKind::Markup);
    }
    if first.starts_with('{') {
        return Some(FileKind::Json);
    }
    if first.contains(',') {
        // A section or an array of TOML has its bracket first; a key its sign of equality.
        let toml = first.starts_with("[[") || first.split_once('=').is_some_and(|(key, _)| is_key(key));
        return toml.then_some(FileKind::KeysAndValues);
    }
    if first.contains('\t') || first.contains(';') {
        return Some(FileKind::OtherSeparator);
    }
    let pair = first.split_once(['=', ':']).is_some_and(|(key, _)| is_key(key));
    (pair || (first.starts_with('[') && first.ends_with(']'))).then_some(FileKind::KeysAndValues)
}

fn is_key(text: &str) -> bool {
    let text = text.trim();
    !text.is_empty()
        && text
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c))
}
