//! The plot layer: one journal style over kuva for charts, and small SVG builders for what kuva lacks.
//!
//! - [`figure::Figure`]: a grid of [`panel::Panel`]s (lines, markers, error bars, bands, reference lines, log axes)
//!   and [`space::Space`]s (3-D lines); kuva draws axes, ticks and data, this layer the labels and legends.
//! - [`diagram::Diagram`]: blocks, arrows, arcs and text for block diagrams and sketches.
//! - [`sketch::Sketch`]: things in space on a diagram: lines, boxes and frames given in W.
//! - [`style`]: the looks: [`style::level_style`], [`style::reference_style`], [`style::controller_style`].
//! - [`text`]: the rich text of all labels: `*z*` italic, `_{ref}` subscript, `^{2}` superscript.
//! - [`raster`]: PNG by resvg with embedded fonts, so that a machine without fonts draws the same pictures.

pub mod axis;
mod chart;
pub mod decimate;
pub mod diagram;
pub mod figure;
mod layer;
pub mod legend;
pub mod panel;
pub mod raster;
mod scene;
pub mod sketch;
pub mod space;
pub mod style;
pub mod svg;
pub mod text;

pub use diagram::Diagram;
pub use figure::Figure;
pub use panel::Panel;
pub use space::Space;
pub use style::{Controller, Look, controller_style, level_name, level_style, reference_style, series_style};

#[cfg(test)]
mod tests;
