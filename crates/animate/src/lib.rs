//! Animations of recorded simulations, each one HTML file.
mod browser;
mod columns;
mod data;
mod error;
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
    /// How many times their size bodies are drawn; positions, beams and receivers keep theirs.
    pub body_scale: f64,
}

impl Default for Options {
    /// 2000 rows at most (some 0.3 MB per agent), bodies in their size.
    fn default() -> Self {
        Self {
            max_frames: 2000,
            body_scale: 1.0,
        }
    }
}
