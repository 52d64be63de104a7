//! The embedded fonts, and how wide words are in them.

use std::sync::{Arc, LazyLock};

use resvg::usvg::{Options, Tree, fontdb};

use super::text;
use super::xml::number;

/// Fonts of every picture: the embedded one first, then what viewers have.
pub const FONT_FAMILY: &str = "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif";

/// How SVGs are read: with the embedded fonts and no others, so that every machine draws the same.
pub(super) static OPTIONS: LazyLock<Options<'static>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for face in [
        dejavu::sans::regular(),
        dejavu::sans::bold(),
        dejavu::sans::oblique(),
    ] {
        fonts.load_font_data(face.to_vec());
    }
    Options {
        font_family: "DejaVu Sans".into(),
        fontdb: Arc::new(fonts),
        ..Options::default()
    }
});

/// Width of a rich text in the embedded font at this size, px; zero if it draws nothing.
pub fn width(source: &str, size: f64) -> f64 {
    let content = text::tspans(source, size);
    // Spaces at the ends have no box, so the text is measured between two bars, less the bars alone.
    measure(&format!("|{content}|"), size) - measure("||", size)
}

fn measure(content: &str, size: f64) -> f64 {
    let document = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\" font-family=\"{FONT_FAMILY}\">\
         <text xml:space=\"preserve\" font-size=\"{}\">{content}</text></svg>",
        number(size)
    );
    match Tree::from_str(&document, &OPTIONS) {
        Ok(tree) => f64::from(tree.root().bounding_box().width()),
        Err(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_width_grows_with_the_text_and_scales_with_the_size() {
        let narrow = width("iii", 10.0);
        assert!(narrow > 0.0 && width("mmm", 10.0) > narrow);
        // Glyph advances are proportional to the size; the box is known to well below a hundredth of a pixel.
        assert!((width("mmm", 20.0) - 2.0 * width("mmm", 10.0)).abs() < 0.05);
    }
}
