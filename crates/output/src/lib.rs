//! Files and text of the programs: inputs never overwritten, files replaced atomically, bounded reads, safe output.
//!
//! | you want to | use |
//! | --- | --- |
//! | refuse an output that is an input, or another output, under any name or link | [`keep_apart`] |
//! | replace a file so that the old or the new one is complete at any time | [`replace`] |
//! | write a file as a run proceeds, alone | [`open_alone`], [`continue_alone`], [`lock_folder`] |
//! | know before a long run that a file can be written | [`can_be_written`] |
//! | read a file that may be larger than memory, or endless | [`read_text`], [`Bounded`] |
//! | print to a stream that may be closed or full | [`print()`] |
//! | print text that came from a file | [`escaped`], [`message`], [`is_printable`] |
//! | notice that a line or a file was changed | [`checksum`] |
//!
//! Assumptions: files are distinguished by device and inode where the system has them, by their canonical path elsewhere. Locks are
//! advisory: they keep programs that use [`open_alone`] apart, no others.
//!
//! ```
//! let folder = std::env::temp_dir().join(format!("output-doc-{}", std::process::id()));
//! std::fs::create_dir_all(&folder)?;
//! let scenario = folder.join("hover.toml");
//! output::replace(&scenario, "name = \"hover\"\n")?;
//! let clash = output::keep_apart(&[scenario.clone()], &[folder.join("./hover.toml")]).unwrap_err();
//! assert!(clash.to_string().contains("give the output another name"));
//! assert_eq!(output::read_text(&scenario, output::TEXT_LIMIT)?, "name = \"hover\"\n");
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok::<(), std::io::Error>(())
//! ```

mod apart;
mod checksum;
mod read;
mod replace;
mod stream;
mod text;

pub use apart::{Clash, STANDARD_INPUT, keep_apart};
pub use checksum::checksum;
pub use read::{Bounded, TEXT_LIMIT, read_bytes, read_text};
pub use replace::{can_be_written, continue_alone, lock_folder, open_alone, replace};
pub use stream::print;
pub use text::{escaped, is_printable, message, shortened};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
