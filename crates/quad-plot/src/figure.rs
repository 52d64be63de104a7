//! A figure: a grid of panels under one legend.

use std::ops::Range;

use super::axis::{Scale, power_of_thousand};
use super::chart::{EXPONENT_ROW, LABEL, Placed, RIGHT, TICK, TICK_LENGTH, draw_panel, equalise, foot};
use super::font;
use super::frame::Area;
use super::legend::{Entry, Legend};
use super::panel::Panel;
use super::space::Space;
use super::style::INK;
use super::svg::{Anchor, Svg, TextLook, at};

/// A grid of panels, filled row by row.
///
/// ```
/// use quad_plot::{Figure, Panel, level_name, level_style};
///
/// let wave = |phase: f64| (0..200).map(move |i| f64::from(i) * 0.01).map(move |t| (t, (t + phase).sin()));
/// let mut height = Panel::new("Time *t*, s", "Height *z*, m").horizontal(1.0, "");
/// for level in 1..=5 {
///     height = height.line(level_name(level), level_style(level), wave(0.1 * f64::from(level)));
/// }
/// let svg = Figure::columns(1).panel(height).draw();
/// assert!(svg.document().contains("Time"));
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    columns: usize,
    cells: Vec<Cell>,
    share_x: bool,
    size: (f64, f64),
    legends: Legends,
}

/// Where the legends of a [`Figure`] stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Legends {
    /// One legend above the whole figure.
    #[default]
    Common,
    /// A legend above each panel.
    EachPanel,
    /// No legend.
    None,
}

/// A cell of the grid.
#[derive(Clone, Debug)]
pub enum Cell {
    /// A pair of axes.
    Panel(Box<Panel>),
    /// A space with three axes.
    Space(Box<Space>),
}

impl From<Panel> for Cell {
    fn from(panel: Panel) -> Self {
        Self::Panel(Box::new(panel))
    }
}

impl From<Space> for Cell {
    fn from(space: Space) -> Self {
        Self::Space(Box::new(space))
    }
}

/// Space around the figure, px.
const MARGIN: f64 = 8.0;
/// Space between rows, px.
const ROW_GAP: f64 = 14.0;
/// Aimed-at distance between ticks, px: along x, along y.
const TICK_PITCH: (f64, f64) = (75.0, 42.0);

impl Figure {
    /// An empty figure with this many columns (at least one).
    pub fn columns(columns: usize) -> Self {
        let size = match columns {
            0 | 1 => (440.0, 230.0),
            2 => (290.0, 200.0),
            _ => (220.0, 165.0),
        };
        Self {
            columns: columns.max(1),
            cells: Vec::new(),
            share_x: false,
            size,
            legends: Legends::Common,
        }
    }

    /// Adds a [`Panel`] or a [`Space`] in the next cell.
    pub fn panel(mut self, cell: impl Into<Cell>) -> Self {
        self.cells.push(cell.into());
        self
    }

    /// Gives the panels of each column one horizontal range, and labels to the lowest alone.
    pub fn share_x(mut self) -> Self {
        self.share_x = true;
        self
    }

    /// Sets the size of each panel's data area, px. A page column of 85 mm is about 320 px at this font size.
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        self.size = (width, height);
        self
    }

    /// Sets where the legends stand.
    pub fn legends(mut self, legends: Legends) -> Self {
        self.legends = legends;
        self
    }

    /// Draws the figure.
    pub fn draw(&self) -> Svg {
        let placed = self.settle();
        let layout = self.layout(&placed);
        let inner: f64 = (0..self.columns).map(|column| layout.cell_width(column)).sum();
        let common = match self.legends {
            Legends::Common => Legend::new(self.cells.iter().flat_map(entries), inner),
            _ => Legend::new([], inner),
        };
        let width = inner.max(common.width());
        let mut svg = Svg::new(2.0 * MARGIN + width, 0.0);
        let centre = MARGIN + (inner + layout.lefts[0] - RIGHT) / 2.0;
        common.draw(&mut svg, centre, MARGIN, (MARGIN, MARGIN + width));
        let mut top = MARGIN + common.height();
        for first in (0..self.cells.len()).step_by(self.columns) {
            let row = first..(first + self.columns).min(self.cells.len());
            top += self.draw_row(&mut svg, row, &placed, &layout, top) + ROW_GAP;
        }
        svg.height = top - ROW_GAP + MARGIN;
        svg
    }

    /// Draws a row of cells and returns its height.
    fn draw_row(
        &self,
        svg: &mut Svg,
        row: Range<usize>,
        placed: &[Option<Placed<'_>>],
        layout: &Layout,
        top: f64,
    ) -> f64 {
        let tallest = |height: &dyn Fn(usize) -> f64| row.clone().map(height).fold(0.0, f64::max);
        let has_exponent = |i: usize| placed[i].as_ref().is_some_and(|p| p.y.exponent != 0);
        let exponents = if row.clone().any(has_exponent) {
            EXPONENT_ROW
        } else {
            0.0
        };
        let head = exponents + tallest(&|i| self.caption_height(i) + self.own_legend(i, layout).height());
        let below = tallest(&|i| placed[i].as_ref().map_or(0.0, |placed| foot(placed, self.size.0)));
        let mut left = MARGIN;
        for i in row.clone() {
            let column = i % self.columns;
            let width = layout.cell_width(column);
            let area = Area {
                origin: at(left + layout.lefts[column], top + head),
                size: self.size,
            };
            svg.text(at(area.origin.x, top + LABEL), &self.caption(i), CAPTION);
            let legend = self.own_legend(i, layout);
            let legend_top = area.origin.y - exponents - legend.height();
            legend.draw(
                svg,
                area.origin.x + self.size.0 / 2.0,
                legend_top,
                (left, left + width),
            );
            match (&self.cells[i], &placed[i]) {
                (Cell::Panel(_), Some(placed)) => draw_panel(svg, placed, area, layout.lefts[column]),
                // A space has its labels inside, so it takes the room of margins and axis labels too.
                (Cell::Space(space), _) => space.draw_in(
                    svg,
                    Area {
                        origin: at(left, top + head),
                        size: (width, self.size.1 + below),
                    },
                ),
                (Cell::Panel(_), None) => {}
            }
            left += width;
        }
        head + self.size.1 + below
    }

    /// Settles the axes of all panels.
    fn settle(&self) -> Vec<Option<Placed<'_>>> {
        let rows = self.cells.len().div_ceil(self.columns);
        let settle = |i: usize| {
            let Cell::Panel(panel) = &self.cells[i] else {
                return None;
            };
            let extent = panel.extent();
            let column = (i % self.columns..self.cells.len()).step_by(self.columns);
            let abscissae: Vec<f64> = if self.share_x {
                column
                    .filter_map(|j| self.panel_at(j))
                    .flat_map(Panel::extent)
                    .map(|p| p.0)
                    .collect()
            } else {
                extent.iter().map(|p| p.0).collect()
            };
            let mut x = panel.x.settle(
                abscissae.into_iter(),
                !panel.runs_along_x() && !panel.is_filled(),
                self.size.0 / TICK_PITCH.0,
            );
            let heights = extent.iter().map(|p| p.1);
            let mut y = panel
                .y
                .settle(heights, !panel.is_filled(), self.size.1 / TICK_PITCH.1);
            if panel.equal_aspect {
                equalise(&mut x, &mut y, self.size);
            }
            let lowest = i / self.columns + 1 == rows || i + self.columns >= self.cells.len();
            Some(Placed {
                panel,
                x,
                y,
                labelled_x: !self.share_x || lowest,
            })
        };
        let mut placed: Vec<_> = (0..self.cells.len()).map(settle).collect();
        share_exponents(&mut placed);
        placed
    }

    fn panel_at(&self, i: usize) -> Option<&Panel> {
        match &self.cells[i] {
            Cell::Panel(panel) => Some(panel),
            Cell::Space(_) => None,
        }
    }

    /// Room beside the data area of each column: for tick labels and axis label, and for what is wider than it.
    fn layout(&self, placed: &[Option<Placed<'_>>]) -> Layout {
        let needed = |placed: &Placed<'_>| {
            let labels = placed.y_labels(self.size.1);
            let widths = labels.iter().map(|(_, label)| font::width(label, TICK));
            let title = if placed.panel.y.label.is_empty() {
                0.0
            } else {
                LABEL + 8.0
            };
            widths.fold(0.0, f64::max) + TICK_LENGTH + 8.0 + title
        };
        let column = |c: usize| {
            let column = placed.iter().skip(c).step_by(self.columns);
            column.flatten().map(needed).fold(0.0, f64::max)
        };
        let mut layout = Layout {
            lefts: (0..self.columns).map(column).collect(),
            rights: vec![RIGHT; self.columns],
            width: self.size.0,
        };
        // A legend that no number of rows makes narrow enough widens its column.
        for i in 0..self.cells.len() {
            let column = i % self.columns;
            let surplus = self.own_legend(i, &layout).width() - layout.cell_width(column);
            layout.rights[column] += surplus.max(0.0);
        }
        layout
    }

    /// Caption, with the panel's letter if there are several.
    fn caption(&self, i: usize) -> String {
        let caption = match &self.cells[i] {
            Cell::Panel(panel) => &panel.caption,
            Cell::Space(space) => &space.caption,
        };
        let letter = char::from(b'a' + (i % 26) as u8);
        let words = if self.cells.len() > 1 {
            format!("({letter}) {caption}")
        } else {
            caption.clone()
        };
        words.trim_end().to_owned()
    }

    fn caption_height(&self, i: usize) -> f64 {
        if self.caption(i).is_empty() {
            2.0
        } else {
            LABEL + 8.0
        }
    }

    /// The legend above a panel of its own; empty if there is none.
    fn own_legend(&self, i: usize, layout: &Layout) -> Legend {
        let width = layout.cell_width(i % self.columns);
        match self.legends {
            Legends::EachPanel => Legend::new(entries(&self.cells[i]), width),
            _ => Legend::new([], width),
        }
    }
}

/// Room left and right of the data areas of each column, and the width of a data area, px.
struct Layout {
    lefts: Vec<f64>,
    rights: Vec<f64>,
    width: f64,
}

impl Layout {
    fn cell_width(&self, column: usize) -> f64 {
        self.lefts[column] + self.width + self.rights[column]
    }
}

/// Look of captions.
const CAPTION: TextLook = TextLook {
    size: LABEL,
    anchor: Anchor::Start,
    colour: INK,
    rotation: 0.0,
    bold: false,
};
/// Panels of one quantity share a power of ten if the smallest is at least this share of the largest: their labels keep few decimals.
const COMPARABLE: f64 = 1e-3;

/// Gives panels with the same vertical label one power of ten, so that their heights can be compared.
fn share_exponents(placed: &mut [Option<Placed<'_>>]) {
    let magnitude = |p: &Placed<'_>| p.y.min.abs().max(p.y.max.abs());
    for i in 0..placed.len() {
        let Some(label) = placed[i].as_ref().map(|p| p.panel.y.label.clone()) else {
            continue;
        };
        let alike = |p: &&mut Placed<'_>| p.panel.y.label == label && p.y.scale == Scale::Linear;
        let group: Vec<&mut Placed<'_>> = placed.iter_mut().flatten().filter(alike).collect();
        let magnitudes = || group.iter().map(|p| magnitude(p));
        let (least, most) = (
            magnitudes().fold(f64::INFINITY, f64::min),
            magnitudes().fold(0.0, f64::max),
        );
        if group.iter().any(|p| p.y.exponent != 0) && least >= COMPARABLE * most {
            let exponent = power_of_thousand(most);
            group.into_iter().for_each(|p| p.y.exponent = exponent);
        }
    }
}

fn entries(cell: &Cell) -> Vec<Entry> {
    match cell {
        Cell::Panel(panel) => panel.entries(),
        Cell::Space(space) => space.entries(),
    }
}
