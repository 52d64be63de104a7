//! What is fuzzed: a reader, its seeds, and what must hold of what it reads.

mod program;
mod reader;

/// A reader and files that it accepts.
pub(crate) struct Target {
    /// Its name on the command line.
    pub(crate) name: &'static str,
    /// Files to be mutated.
    pub(crate) seeds: Vec<Vec<u8>>,
    /// Reads a file.
    ///
    /// # Errors
    /// What does not hold of it, in words. A file that is refused is no error.
    pub(crate) read: fn(&[u8]) -> Result<(), String>,
    /// Whether it starts a program for each case, which must be built before.
    pub(crate) is_program: bool,
}

/// All of them.
pub(crate) fn all() -> Vec<Target> {
    let mut all = reader::all();
    all.extend(program::all());
    all
}
