//! Coverage of a flight volume by motion-capture cameras on the walls of a room.
//!
//! A camera at `p` with axis `a`, right `b` and up `c` (unit vectors in W) sees a point `q`, with `d = q − p`, if
//!
//! - `d·a > 0`, `|d·b| ≤ d·a tan(h/2)`, `|d·c| ≤ d·a tan(v/2)`: inside the pyramid of its fields of view h and v;
//! - `near ≤ |d| ≤ far`: where a marker is neither blurred nor smaller than the camera resolves.
//!
//! A marker is located by the cameras that see it; the coverage of a volume is the part of it that enough of them see.
//! It is counted on a grid of the middles of equal cells, so its error falls with the cells' size.
//!
//! Assumptions: nothing obstructs the view; lenses don't distort; every camera is equal. Two cameras side by side count
//! as two, although their rays hardly cross.
//!
//! Frames: W with its origin on the floor in the middle of the room, x along its length, y along its width, z
//! down. Source: geometry; figure C.1 of the thesis shows such a simulation.
//!
//! | you have | use |
//! | --- | --- |
//! | a room, a volume, a lens | [`Task`]: [`Task::coverage`] counts what cameras see |
//! | cameras to place | [`WallRig`]: the variables, a first guess and the cost of a search by any optimiser of [`optim`] |
//! | all of it in a TOML file | [`RoomFile`], with [`RoomFile::TEMPLATE`] to start from |
//!
//! ```
//! use coverage::RoomFile;
//! use optim::{Evolution, EvolutionSettings, Limits, minimise};
//!
//! let file = RoomFile::from_toml_str(RoomFile::TEMPLATE, "template")?;
//! let (task, rig) = (file.task()?, file.wall_rig()?);
//! let guess = task.coverage(&rig.cameras(&rig.first_guess()))?;
//!
//! let mut search = Evolution::new(rig.variables(), EvolutionSettings::default())?;
//! let found = minimise(&mut search, |x| rig.cost(&task, x), Limits::evaluations(500))?;
//! let placed = task.coverage(&rig.cameras(&found.best.candidate.values))?;
//! assert!(placed.fraction > guess.fraction);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod geometry;
mod rig;
mod room_file;
mod task;
#[cfg(test)]
mod tests;

pub use error::CoverageError;
pub use geometry::{Camera, Lens, Mount, Room, Volume};
pub use rig::WallRig;
pub use room_file::{RigFile, RoomFile, SearchFile};
pub use task::{Coverage, Task};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
