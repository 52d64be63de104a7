//! A picture as SVG, and the few elements this crate draws itself.

use std::fmt::Write;

pub use super::font::FONT_FAMILY;
use super::style::Look;
use super::text;
pub use super::xml::{escape, number};

/// A point of the canvas, px, x to the right and y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Distance from the left edge, px.
    pub x: f64,
    /// Distance from the top edge, px.
    pub y: f64,
}

/// Shorthand for [`Point`].
pub const fn at(x: f64, y: f64) -> Point {
    Point { x, y }
}

impl Point {
    /// The point moved by `(dx, dy)` px.
    pub fn offset(self, dx: f64, dy: f64) -> Self {
        at(self.x + dx, self.y + dy)
    }
}

/// A picture: its size and its elements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Svg {
    /// Width, px.
    pub width: f64,
    /// Height, px.
    pub height: f64,
    /// The elements, as SVG text.
    pub body: String,
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// It starts there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextLook {
    /// Font size, px.
    pub size: f64,
    /// Where it stands relative to its point.
    pub anchor: Anchor,
    /// Colour.
    pub colour: &'static str,
    /// Rotation about its point, degrees, clockwise.
    pub rotation: f64,
    /// Whether it is bold.
    pub bold: bool,
}

impl Default for TextLook {
    fn default() -> Self {
        Self {
            size: 12.0,
            anchor: Anchor::Start,
            colour: super::style::INK,
            rotation: 0.0,
            bold: false,
        }
    }
}

impl Svg {
    /// An empty picture of this size, px.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            body: String::new(),
        }
    }

    /// The picture as a document on white ground.
    pub fn document(&self) -> String {
        let (w, h) = (number(self.width), number(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"{FONT_FAMILY}\" fill=\"{}\">\n<rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            super::style::INK,
            self.body
        )
    }

    /// The picture with another one below it, both centred.
    #[must_use]
    pub fn above(&self, below: &Self) -> Self {
        let width = self.width.max(below.width);
        let mut both = Self::new(width, self.height + below.height);
        for (picture, top) in [(self, 0.0), (below, self.height)] {
            let left = (width - picture.width) / 2.0;
            let (left, top) = (number(left), number(top));
            both.raw(&format!(
                "<g transform=\"translate({left} {top})\">\n{}</g>",
                picture.body
            ));
        }
        both
    }

    /// Adds an element as it is.
    pub fn raw(&mut self, element: &str) {
        self.body += element;
        self.body.push('\n');
    }

    /// Adds another picture with its upper left corner at a point.
    pub fn place(&mut self, picture: &Self, corner: Point) {
        let (x, y) = (number(corner.x), number(corner.y));
        self.raw(&format!(
            "<g transform=\"translate({x} {y})\">\n{}</g>",
            picture.body
        ));
    }

    /// Adds a rich text; `point` is on its base line.
    pub fn text(&mut self, point: Point, content: &str, look: TextLook) {
        let anchor = match look.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y) = (number(point.x), number(point.y));
        let bold = if look.bold { " font-weight=\"bold\"" } else { "" };
        let turn = if look.rotation == 0.0 {
            String::new()
        } else {
            format!(" transform=\"rotate({} {x} {y})\"", number(look.rotation))
        };
        let tspans = text::tspans(content, look.size);
        self.raw(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"{bold}{turn}>{tspans}</text>",
            number(look.size),
            look.colour
        ));
    }

    /// Adds a polyline.
    pub fn polyline(&mut self, points: &[Point], look: &Look) {
        if points.len() < 2 {
            return;
        }
        let path = path_of(points);
        self.raw(&format!("<path d=\"{path}\" fill=\"none\"{}/>", stroke(look)));
    }

    /// Adds a closed polygon, filled, with an outline if a look is given.
    pub fn polygon(&mut self, points: &[Point], fill: &str, outline: Option<&Look>) {
        let edge = outline.map(stroke).unwrap_or_default();
        self.raw(&format!(
            "<path d=\"{}Z\" fill=\"{}\"{edge}/>",
            path_of(points),
            escape(fill)
        ));
    }

    /// Fills what an odd number of these closed curves surround.
    pub fn region(&mut self, curves: &[Vec<Point>], fill: &str, opacity: f64) {
        let curves = curves.iter().filter(|curve| curve.len() > 2);
        let path: String = curves.map(|curve| path_of(curve) + "Z").collect();
        if path.is_empty() {
            return;
        }
        let faint = if opacity < 1.0 {
            format!(" fill-opacity=\"{}\"", number(opacity))
        } else {
            String::new()
        };
        self.raw(&format!(
            "<path d=\"{path}\" fill=\"{}\" fill-rule=\"evenodd\"{faint}/>",
            escape(fill)
        ));
    }

    /// Adds a circle, filled, with an outline if a look is given.
    pub fn circle(&mut self, centre: Point, radius: f64, fill: &str, outline: Option<&Look>) {
        let edge = outline.map(stroke).unwrap_or_default();
        let (x, y, r) = (number(centre.x), number(centre.y), number(radius));
        self.raw(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{}\"{edge}/>",
            escape(fill)
        ));
    }
}

fn path_of(points: &[Point]) -> String {
    let mut path = String::new();
    for (i, point) in points.iter().enumerate() {
        let command = if i == 0 { 'M' } else { 'L' };
        let _ = write!(path, "{command}{} {}", number(point.x), number(point.y));
    }
    path
}

/// The stroke attributes of a look, with a leading space.
pub fn stroke(look: &Look) -> String {
    let mut out = format!(
        " stroke=\"{}\" stroke-width=\"{}\"",
        look.colour,
        number(look.width)
    );
    if !look.dash.is_empty() {
        let _ = write!(out, " stroke-dasharray=\"{}\"", look.dash);
    }
    out += " stroke-linejoin=\"round\"";
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_one_picture_above_another() {
        let mut dot = Svg::new(10.0, 5.0);
        dot.circle(at(1.0, 1.0), 1.0, "#000000", None);
        let both = Svg::new(20.0, 7.0).above(&dot);
        assert_eq!((both.width, both.height), (20.0, 12.0));
        assert!(both.body.contains("translate(5 7)") && both.body.contains("circle"));
    }

    #[test]
    fn prop_text_is_escaped() {
        let mut svg = Svg::new(10.0, 10.0);
        svg.text(at(0.0, 0.0), "a < b & c", TextLook::default());
        assert!(svg.document().contains("a &lt; b &amp; c"));
    }
}
