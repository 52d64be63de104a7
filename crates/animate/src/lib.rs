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
}

impl Default for Options {
    /// 2000 rows at most, some 0.2 MB per agent.
    fn default() -> Self {
        Self { max_frames: 2000 }
    }
}
