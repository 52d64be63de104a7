//! Animations of recorded simulations: one HTML file that plays in any browser, from disk, without a network.
//!
//! | part | where |
//! | --- | --- |
//! | what the agents of a recording look like | [`Scene`], [`Scene::from_recording`] |
//! | the page: agents, trails, beam, the camera's field of view and picture, plots | [`html`] |
//! | stills, and the page under test, by a Chromium on this machine | [`Browser`] |
//! | the recording as an MCAP file, for Foxglove and rerun | `foxglove::write_mcap`, with the feature `mcap` |
//!
//! # Example
//!
//! ```
//! use animate::{Options, Scene, html};
//! use sifre::black_box::MemoryBox;
//! use sifre::{GimballedEts, EtsSetup, Member, Engine, Target, steps};
//!
//! // A station that finds a target, for a second.
//! let mut simulation = Engine::new(vec![
//!     Member::new(Target::fixed("mark", [4.0, 0.5, -1.0].into()), steps::TARGET.step),
//!     Member::new(GimballedEts::new(EtsSetup::nominal("station", "mark")), steps::ETS.step),
//! ])?;
//! let id = simulation.attach(steps::BLACK_BOX.step, MemoryBox::default())?;
//! simulation.run(1.0, &mut ())?;
//! let recording = simulation.detach::<MemoryBox>(id).ok_or("no recording")??.recording;
//!
//! let scene = Scene::from_recording(&recording);
//! let page = html(&recording, &scene, &Options::default())?;
//! assert!(page.starts_with("<!DOCTYPE html>"));
//! // std::fs::write("flight.html", page)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Frames
//!
//! Positions are in W, north-east-down. The viewer draws north, east and down as x, z and −y of its own axes (x right, y up, z
//! towards the reader): a rotation, no mirror. A station's camera is drawn with its own focal length and principal point, so its
//! picture is what the engine's camera sees.
//!
//! # The page
//!
//! Drag to turn, wheel to zoom; space plays and pauses, the arrow keys move by 0.1 s (with shift 1 s), `v` changes the view. What
//! follows `#` in the address chooses a picture: `#t=3.2&view=ets&station=name`, `follow=name`, `az`, `el` (from where it is
//! seen, degrees), `zoom`, and `still=1` hides the controls. Scripts find everything in `window.viewer`.
//!
//! # What it does not do
//!
//! No terrain, no other vehicles than quadrotors; the rotors' turning is decoration. The recording is thinned to
//! [`Options::max_frames`] rows, which the page says; between rows positions are interpolated, levels and modes are held. A quadrotor's
//! receiver, a camera's lens and the limits in the plots are not recorded: they come from the [`Scene`].

mod browser;
mod columns;
mod data;
mod error;
#[cfg(feature = "mcap")]
pub mod foxglove;
mod guess;
mod page;
mod scene;
mod view;

pub use browser::{Browser, BrowserError, CHROMIUM, Page, Size};
pub use error::AnimateError;
pub use page::html;
pub use scene::{Kind, LEVEL_COLOURS, NOMINAL_ARM_M, Scene, SceneAgent};

/// Settings of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Rows kept at most, equally apart in number, the first and the last among them.
    pub max_frames: usize,
}

impl Default for Options {
    /// 2000 rows at most, some 0.2 MB per agent.
    fn default() -> Self {
        Self { max_frames: 2000 }
    }
}

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
