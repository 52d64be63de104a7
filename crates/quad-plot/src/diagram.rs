//! Block diagrams and sketches: blocks, arrows, arcs and rich text at given places, px.

use super::style::{FAINT, GREY, INK, Look};
use super::svg::{Anchor, Point, Svg, TextLook, at};

/// A diagram under construction; draw in the order from back to front.
///
/// ```
/// use quad_plot::diagram::{ARROW, Block, Diagram, PLAIN};
/// use quad_plot::svg::at;
///
/// let mut diagram = Diagram::new(300.0, 100.0);
/// let plant = diagram.block(Block { centre: at(150.0, 50.0), size: (90.0, 44.0), fill: PLAIN }, "plant\n*ẋ* = *f*(*x*, *u*)");
/// diagram.arrow(&[at(40.0, 50.0), plant.left()], ARROW);
/// diagram.text(at(70.0, 42.0), "*u*");
/// let svg = diagram.finish();
/// ```
#[derive(Clone, Debug)]
pub struct Diagram {
    svg: Svg,
}

/// A rectangle with words in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Its centre, px.
    pub centre: Point,
    /// Its width and height, px.
    pub size: (f64, f64),
    /// Its colour.
    pub fill: &'static str,
}

/// Fill of ordinary blocks.
pub const PLAIN: &str = "#ffffff";
/// Fill of blocks that stand back.
pub const QUIET: &str = "#f1f1f1";
/// Fill of blocks that matter: a light blue.
pub const BLUE_TINT: &str = "#dcebf5";
/// Fill of blocks that matter in another way: a light orange.
pub const ORANGE_TINT: &str = "#fbeedd";
/// Fill of blocks that matter in a third way: a light green.
pub const GREEN_TINT: &str = "#ddf1ea";

/// Look of signal lines.
pub const ARROW: Look = Look::solid(INK, 1.2);
/// Look of construction lines.
pub const CONSTRUCTION: Look = Look::solid(GREY, 0.9).dashed("4 3");

/// Outline of blocks.
const OUTLINE: Look = Look::solid(INK, 1.0);
/// Font size of words, px.
const SIZE: f64 = 12.0;
/// Distance of lines of words, px.
const LEADING: f64 = 16.0;
/// Length and half-width of arrow heads, px, at a line width of 1.2 px.
const HEAD: (f64, f64) = (8.5, 3.2);

impl Block {
    /// The middle of its left edge.
    pub fn left(self) -> Point {
        self.centre.offset(-self.size.0 / 2.0, 0.0)
    }

    /// The middle of its right edge.
    pub fn right(self) -> Point {
        self.centre.offset(self.size.0 / 2.0, 0.0)
    }

    /// The middle of its upper edge.
    pub fn top(self) -> Point {
        self.centre.offset(0.0, -self.size.1 / 2.0)
    }

    /// The middle of its lower edge.
    pub fn bottom(self) -> Point {
        self.centre.offset(0.0, self.size.1 / 2.0)
    }

    fn corners(self) -> [Point; 4] {
        let (w, h) = (self.size.0 / 2.0, self.size.1 / 2.0);
        [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(dx, dy)| self.centre.offset(dx, dy))
    }
}

impl Diagram {
    /// An empty diagram of this size, px. At most 760 px wide, so that its words keep their size on a page.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            svg: Svg::new(width, height),
        }
    }

    /// The finished picture.
    pub fn finish(self) -> Svg {
        self.svg
    }

    /// Draws a block with words in it (lines separated by `\n`) and returns it for its edges.
    pub fn block(&mut self, block: Block, words: &str) -> Block {
        self.svg.polygon(&block.corners(), block.fill, Some(&OUTLINE));
        self.centred(block.centre, words);
        block
    }

    /// Draws a dashed frame around a group.
    pub fn frame(&mut self, block: Block) {
        self.svg
            .polygon(&block.corners(), block.fill, Some(&CONSTRUCTION));
    }

    /// Writes small grey words that start at a point, to name a frame.
    pub fn caption(&mut self, point: Point, words: &str) {
        self.svg.text(
            point,
            words,
            TextLook {
                size: 11.0,
                colour: GREY,
                ..TextLook::default()
            },
        );
    }

    /// Draws a summing point; the signs stand in the text around it.
    pub fn sum(&mut self, centre: Point) -> Block {
        let radius = 8.0;
        self.svg.circle(centre, radius, PLAIN, Some(&OUTLINE));
        Block {
            centre,
            size: (2.0 * radius, 2.0 * radius),
            fill: PLAIN,
        }
    }

    /// Draws a dot where a signal branches.
    pub fn branch(&mut self, point: Point) {
        self.svg.circle(point, 2.4, INK, None);
    }

    /// Draws a polyline that ends in an arrow head.
    pub fn arrow(&mut self, points: &[Point], look: Look) {
        let &[.., from, tip] = points else { return };
        let (dx, dy) = (tip.x - from.x, tip.y - from.y);
        let length = dx.hypot(dy).max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        let grow = (look.width / ARROW.width).sqrt();
        let (long, half) = (HEAD.0 * grow, HEAD.1 * grow);
        let base = tip.offset(-long * ux, -long * uy);
        let mut shaft = points.to_vec();
        if let Some(last) = shaft.last_mut() {
            // The shaft ends inside the head, so that no thick line blunts the tip.
            *last = tip.offset(-0.7 * long * ux, -0.7 * long * uy);
        }
        self.svg.polyline(&shaft, &look);
        let wings = [
            tip,
            base.offset(-half * uy, half * ux),
            base.offset(half * uy, -half * ux),
        ];
        self.svg
            .polygon(&[wings[0], wings[1], wings[2]], look.colour, None);
    }

    /// Draws a line.
    pub fn line(&mut self, points: &[Point], look: Look) {
        self.svg.polyline(points, &look);
    }

    /// Draws a filled polygon with an outline.
    pub fn polygon(&mut self, points: &[Point], fill: &'static str) {
        self.svg.polygon(points, fill, Some(&OUTLINE));
    }

    /// Draws a circle with an outline.
    pub fn circle(&mut self, centre: Point, radius: f64, fill: &'static str) {
        self.svg.circle(centre, radius, fill, Some(&OUTLINE));
    }

    /// Points of an arc, for [`Diagram::line`] or, with a head at its end, [`Diagram::arrow`]. Angles in degrees,
    /// from the right, counter-clockwise as seen; radii along x and y in px (equal for a circle).
    pub fn arc(centre: Point, radii: (f64, f64), from_deg: f64, to_deg: f64) -> Vec<Point> {
        const STEPS: u32 = 48;
        let angle = |i: u32| (from_deg + (to_deg - from_deg) * f64::from(i) / f64::from(STEPS)).to_radians();
        let point = |a: f64| centre.offset(radii.0 * a.cos(), -radii.1 * a.sin());
        (0..=STEPS).map(|i| point(angle(i))).collect()
    }

    /// Writes words centred at a point, lines separated by `\n`.
    pub fn centred(&mut self, centre: Point, words: &str) {
        let lines: Vec<&str> = words.split('\n').collect();
        let look = TextLook {
            size: SIZE,
            anchor: Anchor::Middle,
            ..TextLook::default()
        };
        let first = centre.y + 0.36 * SIZE - LEADING * (lines.len() - 1) as f64 / 2.0;
        for (i, line) in lines.iter().enumerate() {
            self.svg
                .text(at(centre.x, first + LEADING * i as f64), line, look);
        }
    }

    /// Writes words whose base line is centred at a point.
    pub fn text(&mut self, point: Point, words: &str) {
        self.svg.text(
            point,
            words,
            TextLook {
                size: SIZE,
                anchor: Anchor::Middle,
                ..TextLook::default()
            },
        );
    }

    /// Writes words with a look of their own.
    pub fn styled_text(&mut self, point: Point, words: &str, look: TextLook) {
        self.svg.text(point, words, look);
    }

    /// Fills a rectangle without outline, for grounds and shadows.
    pub fn ground(&mut self, block: Block) {
        self.svg.polygon(&block.corners(), block.fill, None);
    }

    /// Draws a hatched line: ground, wall. The hatches lie to the right of the way from `from` to `to`.
    pub fn hatched(&mut self, from: Point, to: Point) {
        self.svg.polyline(&[from, to], &OUTLINE);
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let length = dx.hypot(dy).max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        const PITCH: f64 = 9.0;
        let count = (length / PITCH) as u32;
        for i in 1..=count {
            let root = from.offset(ux * PITCH * f64::from(i), uy * PITCH * f64::from(i));
            let end = root.offset(-7.0 * ux - 7.0 * uy, -7.0 * uy + 7.0 * ux);
            self.svg.polyline(&[root, end], &Look::solid(FAINT, 1.0));
        }
    }
}
