//! Standard output that may be closed or full.

use std::io::{self, Write};

/// Prints a text on standard output at once. A pipe that its reader has closed (`| head`) is no error: nobody wants the rest.
///
/// # Errors
/// A stream that can't be written, as a full disk.
pub fn print(text: &str) -> io::Result<()> {
    let mut stream = io::stdout().lock();
    let written = stream.write_all(text.as_bytes()).and_then(|()| stream.flush());
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}
