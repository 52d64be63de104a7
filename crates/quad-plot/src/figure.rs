//! A figure: a grid of panels under one legend.

use super::chart::{Area, LABEL, Placed, RIGHT, TICK, TICK_LENGTH, draw_panel, equalise, foot};
use super::legend::{Entry, Legend};
use super::panel::Panel;
use super::space::Space;
use super::svg::{Svg, TextLook, at};
use super::text;

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
        let lefts = self.column_margins(&placed);
        let cell_width = |column: usize| lefts[column] + self.size.0 + RIGHT;
        let width = 2.0 * MARGIN + (0..self.columns).map(cell_width).sum::<f64>();
        let common = match self.legends {
            Legends::Common => Legend::new(self.cells.iter().flat_map(entries), width - 2.0 * MARGIN),
            _ => Legend::new([], width),
        };
        let mut svg = Svg::new(width, 0.0);
        common.draw(
            &mut svg,
            lefts[0] + MARGIN + (width - 2.0 * MARGIN - lefts[0] - RIGHT) / 2.0,
            MARGIN,
        );
        let mut top = MARGIN + common.height();
        for row in 0..self.cells.len().div_ceil(self.columns) {
            let cells = row * self.columns..((row + 1) * self.columns).min(self.cells.len());
            let head = cells.clone().map(|i| self.head(i).1).fold(0.0, f64::max);
            let below = cells
                .clone()
                .map(|i| placed[i].as_ref().map_or(0.0, foot))
                .fold(0.0, f64::max);
            let mut left = MARGIN;
            for (column, i) in cells.clone().enumerate() {
                let area = Area {
                    origin: at(left + lefts[column], top + head),
                    size: self.size,
                };
                self.draw_head(&mut svg, i, area, head);
                match (&self.cells[i], &placed[i]) {
                    (Cell::Panel(_), Some(placed)) => draw_panel(&mut svg, placed, area, i, lefts[column]),
                    (Cell::Space(space), _) => {
                        // A space has its labels inside, so it takes the room of margins and axis labels too.
                        let size = (cell_width(column), self.size.1 + below);
                        space.draw_in(
                            &mut svg,
                            Area {
                                origin: at(left, top + head),
                                size,
                            },
                        );
                    }
                    (Cell::Panel(_), None) => {}
                }
                left += cell_width(column);
            }
            top += head + self.size.1 + below + ROW_GAP;
        }
        svg.height = top - ROW_GAP + MARGIN;
        svg
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
                !panel.runs_along_x(),
                self.size.0 / TICK_PITCH.0,
            );
            let mut y = panel
                .y
                .settle(extent.iter().map(|p| p.1), true, self.size.1 / TICK_PITCH.1);
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
        (0..self.cells.len()).map(settle).collect()
    }

    fn panel_at(&self, i: usize) -> Option<&Panel> {
        match &self.cells[i] {
            Cell::Panel(panel) => Some(panel),
            Cell::Space(_) => None,
        }
    }

    /// Room left of the data area for each column: tick labels and axis label.
    fn column_margins(&self, placed: &[Option<Placed<'_>>]) -> Vec<f64> {
        let needed = |placed: &Placed<'_>| {
            let labels = placed.y.ticks().into_iter().map(|tick| placed.y.tick_label(tick));
            let widest = labels
                .map(|label| text::width(&label, f64::from(TICK)))
                .fold(0.0, f64::max);
            let title = if placed.panel.y.label.is_empty() {
                0.0
            } else {
                LABEL + 8.0
            };
            widest + TICK_LENGTH + 8.0 + title
        };
        let column = |c: usize| {
            placed
                .iter()
                .skip(c)
                .step_by(self.columns)
                .flatten()
                .map(needed)
                .fold(0.0, f64::max)
        };
        (0..self.columns).map(column).collect()
    }

    /// Caption, with the panel's letter if there are several, and the height above the data area.
    fn head(&self, i: usize) -> (String, f64) {
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
        let words = words.trim_end().to_owned();
        let legend = if self.legends == Legends::EachPanel {
            self.own_legend(i).height()
        } else {
            0.0
        };
        let caption_height = if words.is_empty() { 2.0 } else { LABEL + 8.0 };
        (words, caption_height + legend)
    }

    fn own_legend(&self, i: usize) -> Legend {
        Legend::new(entries(&self.cells[i]), self.size.0)
    }

    fn draw_head(&self, svg: &mut Svg, i: usize, area: Area, head: f64) {
        let (words, _) = self.head(i);
        let look = TextLook {
            size: LABEL,
            ..TextLook::default()
        };
        svg.text(at(area.origin.x, area.origin.y - head + LABEL), &words, look);
        if self.legends == Legends::EachPanel {
            let legend = self.own_legend(i);
            legend.draw(
                svg,
                area.origin.x + area.size.0 / 2.0,
                area.origin.y - legend.height(),
            );
        }
    }
}

fn entries(cell: &Cell) -> Vec<Entry> {
    match cell {
        Cell::Panel(panel) => panel.entries(),
        Cell::Space(space) => space.entries(),
    }
}
