//! The plot layer: one journal style for charts and sketches, as SVG and PNG.
//!
//! - [`figure::Figure`]: a grid of [`panel::Panel`]s (lines, markers, error bars, bands, bars, contours, coloured cells,
//!   reference lines, logarithmic axes) and [`space::Space`]s (3-D lines), with labels and legends.
//! - [`diagram::Diagram`]: blocks, arrows, arcs and text for block diagrams and sketches.
//! - [`sketch::Sketch`]: things in space on a diagram: lines, boxes and frames given in W.
//! - [`style`]: the looks: [`style::level_style`], [`style::reference_style`], [`style::series_style`].
//! - [`text`]: the rich text of all labels: `*z*` italic, `_{ref}` subscript, `^{2}` superscript.
//! - [`font`]: the embedded fonts, and how wide words are in them; [`raster`]: PNG with them, by resvg.
//!
//! # Example
//!
//! ```rust
//! use quad_plot::{Figure, Panel, level_name, level_style};
//!
//! let rise = (0..=100).map(|k| f64::from(k) / 50.0).map(|t| (t, 1.0 - (-3.0 * t).exp()));
//! let panel = Panel::new("Time *t*, s", "Height *h*, m").line(level_name(3), level_style(3), rise);
//! let svg = Figure::columns(1).panel(panel).draw();
//! let png = quad_plot::raster::png(&svg)?;
//! assert!(svg.document().contains("Height") && png.starts_with(b"\x89PNG"));
//! # Ok::<(), quad_plot::raster::RasterError>(())
//! ```

pub mod axis;
mod chart;
mod clip;
mod contour;
mod data;
pub mod decimate;
pub mod diagram;
pub mod figure;
pub mod font;
mod frame;
mod layer;
pub mod legend;
mod marker;
pub mod panel;
pub mod raster;
mod scene;
pub mod sketch;
pub mod space;
pub mod style;
pub mod svg;
pub mod text;
mod ticks;
mod xml;

pub use diagram::Diagram;
pub use figure::Figure;
pub use panel::Panel;
pub use space::Space;
pub use style::{Look, level_name, level_style, reference_style, series_style};

#[cfg(test)]
mod tests;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
