//! The looks of lines and markers: colours of Okabe and Ito (safe for colour-blind readers), and for each series a
//! dash and a width of its own, so that a grey print reads as well.

/// Colour of text, axes and reference curves.
pub const INK: &str = "#1a1a1a";
/// Colour of what stands back: grid lines, shadows.
pub const FAINT: &str = "#d4d4d4";
/// Colour of secondary text and construction lines.
pub const GREY: &str = "#767676";
/// Okabe and Ito's blue.
pub const BLUE: &str = "#0072b2";
/// Okabe and Ito's vermilion.
pub const VERMILION: &str = "#d55e00";
/// Okabe and Ito's bluish green.
pub const GREEN: &str = "#009e73";
/// Okabe and Ito's reddish purple.
pub const PURPLE: &str = "#cc79a7";
/// Okabe and Ito's orange.
pub const ORANGE: &str = "#e69f00";
/// Okabe and Ito's sky blue.
pub const SKY: &str = "#56b4e9";

/// How a line or a set of markers is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour, `#rrggbb`.
    pub colour: &'static str,
    /// Dash pattern, px on and off; empty for a solid line.
    pub dash: &'static str,
    /// Width of the line, px.
    pub width: f64,
    /// Shape of markers.
    pub marker: Marker,
}

/// Shape of markers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Marker {
    /// Disc.
    #[default]
    Circle,
    /// Square.
    Square,
    /// Triangle, point up.
    Triangle,
    /// Diamond.
    Diamond,
    /// Triangle, point down.
    TriangleDown,
    /// Diagonal cross.
    Cross,
    /// Small disc, for clouds of points.
    Dot,
}

impl Look {
    /// A solid line of this colour and width.
    pub const fn solid(colour: &'static str, width: f64) -> Self {
        Self {
            colour,
            dash: "",
            width,
            marker: Marker::Circle,
        }
    }

    /// The same with another dash pattern.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }

    /// The same with another marker.
    pub const fn marked(self, marker: Marker) -> Self {
        Self { marker, ..self }
    }
}

/// The series of looks in their order. Widths fall, so that coinciding curves drawn in order all stay visible.
const SERIES: [Look; 6] = [
    Look::solid(BLUE, 2.4),
    Look::solid(VERMILION, 2.0).dashed("9 4").marked(Marker::Square),
    Look::solid(GREEN, 1.8).dashed("9 3 2 3").marked(Marker::Triangle),
    Look::solid(PURPLE, 1.8).dashed("2 2.5").marked(Marker::Diamond),
    Look::solid(ORANGE, 1.6)
        .dashed("9 2.5 2 2.5 2 2.5")
        .marked(Marker::TriangleDown),
    Look::solid(SKY, 1.4).dashed("4 2").marked(Marker::Cross),
];

/// The look of one level of the model family, counted from 1, the same in every figure; repeats after six.
///
/// Draw the levels in rising order: their widths fall, so that coinciding curves all stay visible.
pub const fn level_style(level: u8) -> Look {
    let index = if level == 0 { 0 } else { level as usize - 1 };
    series_style(index)
}

/// The name of one level in legends.
pub fn level_name(level: u8) -> String {
    format!("level {level}")
}

/// The look of the `index`-th of several series that are neither levels nor controllers; repeats after six.
pub const fn series_style(index: usize) -> Look {
    SERIES[index % SERIES.len()]
}

/// The look of references, set points, limits and other given curves: thin, black, dashed.
pub const fn reference_style() -> Look {
    Look::solid(INK, 1.0).dashed("4 3")
}

/// A colour between two, `#rrggbb`: the first at `share` 0, the second at 1. What is no colour counts as black.
pub fn mix(from: &str, to: &str, share: f64) -> String {
    let share = share.clamp(0.0, 1.0);
    let channel = |colour: &str, first: usize| -> f64 {
        let figures = colour.get(first..first + 2).map(|c| u8::from_str_radix(c, 16));
        f64::from(figures.and_then(Result::ok).unwrap_or(0))
    };
    let mixed = [1, 3, 5].map(|k| {
        let (a, b) = (channel(from, k), channel(to, k));
        // A share that is not finite becomes 0 here.
        (a + (b - a) * share).round() as u8
    });
    format!("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_mixed_colours() {
        assert_eq!(mix("#000000", "#ff8040", 0.0), "#000000");
        assert_eq!(mix("#000000", "#ff8040", 0.5), "#804020");
        assert_eq!(mix("#ffffff", ORANGE, 7.0), ORANGE);
        assert_eq!(mix("", "ä", f64::NAN), "#000000");
    }

    #[test]
    fn prop_levels_differ_in_colour_and_in_dash() {
        for a in 1..=5 {
            for b in 1..a {
                let (first, second) = (level_style(a), level_style(b));
                assert!(
                    first.colour != second.colour && first.dash != second.dash,
                    "levels {a} and {b}"
                );
            }
        }
    }
}
