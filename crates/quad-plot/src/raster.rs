//! PNG from SVG by resvg, with the DejaVu fonts embedded in the program: a fresh machine has none.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::Tree;

use super::font::OPTIONS;
use super::svg::Svg;

/// Pixels of the PNG per px of the SVG: sharp on a page printed at 85 mm width.
const SCALE: f32 = 2.5;

/// Why a picture could not be rasterised.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The SVG is not well-formed.
    #[error("the SVG cannot be read: {0}")]
    Parse(#[from] resvg::usvg::Error),
    /// The picture has no or too large an area.
    #[error("a picture of {width} px x {height} px cannot be rasterised")]
    Size {
        /// Width of the picture, px.
        width: f64,
        /// Height of the picture, px.
        height: f64,
    },
    /// The PNG could not be encoded.
    #[error("the PNG cannot be encoded: {0}")]
    Encode(String),
}

/// More pixels than this, a third of a gigabyte, no page needs.
const MOST_PIXELS: f64 = 8e7;

/// The picture as PNG.
///
/// # Errors
/// A picture without area, or an SVG that is not well-formed.
pub fn png(svg: &Svg) -> Result<Vec<u8>, RasterError> {
    let tree = Tree::from_str(&svg.document(), &OPTIONS)?;
    let pixels = f64::from(tree.size().width()) * f64::from(tree.size().height()) * f64::from(SCALE * SCALE);
    let size = tree.size().to_int_size().scale_by(SCALE);
    let size = size.filter(|_| pixels < MOST_PIXELS);
    let pixmap = size.and_then(|size| Pixmap::new(size.width(), size.height()));
    let mut pixmap = pixmap.ok_or(RasterError::Size {
        width: svg.width,
        height: svg.height,
    })?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixmap.as_mut());
    pixmap
        .encode_png()
        .map_err(|error| RasterError::Encode(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::super::svg::{TextLook, at};
    use super::*;

    fn dark_pixels(content: &str) -> usize {
        let mut svg = Svg::new(100.0, 30.0);
        svg.text(at(5.0, 20.0), content, TextLook::default());
        let bytes = png(&svg).expect("a plain picture");
        let pixmap = Pixmap::decode_png(&bytes).expect("our own PNG");
        pixmap.pixels().iter().filter(|pixel| pixel.red() < 128).count()
    }

    #[test]
    fn prop_text_needs_no_font_of_the_machine() {
        assert_eq!(dark_pixels(""), 0);
        // A letter of 12 px at this scale covers far more than ten pixels; the dot above adds to it.
        let theta = dark_pixels("θ");
        assert!(theta > 10);
        assert!(dark_pixels("θ\u{307}") > theta);
        for symbol in ["ż", "η", "ω", "Φ", "∑", "∫", "−", "⁻¹", "₁", "°", "·", "≥"] {
            assert!(dark_pixels(symbol) > 0, "{symbol}");
        }
    }

    #[test]
    fn prop_an_empty_picture_is_an_error() {
        assert!(png(&Svg::new(0.0, 10.0)).is_err());
        assert!(png(&Svg::new(1e6, 1e6)).is_err());
    }
}
