//! A figure: a grid of panels under one legend.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::render::render_multiple;
use kuva::render::theme::Theme;

use super::axis::{SettledAxis, tick_label};
use super::legend::{Entry, Legend};
use super::panel::Panel;
use super::space::Space;
use super::style::{Look, INK, reference_style};
use super::svg::{Anchor, FONT_FAMILY, Point, Svg, TextLook, at};
use super::text;

/// A grid of panels, filled row by row.
///
/// ```
/// use experiments::plot::{Figure, Panel, level_name, level_style};
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

/// Font size of axis labels and captions, px.
const LABEL: f64 = 12.0;
/// Font size of tick labels, px.
const TICK: u32 = 11;
/// Length of ticks, px.
const TICK_LENGTH: f64 = 4.0;
/// Space around the figure, px.
const MARGIN: f64 = 8.0;
/// Space right of the data, for half a tick label, px.
const RIGHT: f64 = 16.0;
/// Space between rows, px.
const ROW_GAP: f64 = 14.0;
/// Aimed-at distance between ticks, px: along x, along y.
const TICK_PITCH: (f64, f64) = (75.0, 42.0);

/// A panel with settled axes and its place in the figure.
struct Placed<'a> {
    panel: &'a Panel,
    x: SettledAxis,
    y: SettledAxis,
    /// Whether tick labels and axis label stand below it.
    labelled_x: bool,
}

impl Figure {
    /// An empty figure with this many columns (at least one).
    pub fn columns(columns: usize) -> Self {
        let size = match columns {
            0 | 1 => (440.0, 230.0),
            2 => (290.0, 200.0),
            _ => (220.0, 165.0),
        };
        Self { columns: columns.max(1), cells: Vec::new(), share_x: false, size, legends: Legends::Common }
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
        common.draw(&mut svg, lefts[0] + MARGIN + (width - 2.0 * MARGIN - lefts[0] - RIGHT) / 2.0, MARGIN);
        let mut top = MARGIN + common.height();
        for row in 0..self.cells.len().div_ceil(self.columns) {
            let cells = row * self.columns..((row + 1) * self.columns).min(self.cells.len());
            let head = cells.clone().map(|i| self.head(i).1).fold(0.0, f64::max);
            let mut left = MARGIN;
            for (column, i) in cells.clone().enumerate() {
                let area = Area { origin: at(left + lefts[column], top + head), size: self.size };
                self.draw_head(&mut svg, i, area, head);
                match (&self.cells[i], &placed[i]) {
                    (Cell::Panel(_), Some(placed)) => draw_panel(&mut svg, placed, area, i, lefts[column]),
                    (Cell::Space(space), _) => space.draw_in(&mut svg, area),
                    (Cell::Panel(_), None) => {}
                }
                left += cell_width(column);
            }
            let foot = cells.map(|i| placed[i].as_ref().map_or(0.0, foot)).fold(0.0, f64::max);
            top += head + self.size.1 + foot + ROW_GAP;
        }
        svg.height = top - ROW_GAP + MARGIN;
        svg
    }

    /// Settles the axes of all panels.
    fn settle(&self) -> Vec<Option<Placed<'_>>> {
        let rows = self.cells.len().div_ceil(self.columns);
        let settle = |i: usize| {
            let Cell::Panel(panel) = &self.cells[i] else { return None };
            let extent = panel.extent();
            let column = (i % self.columns..self.cells.len()).step_by(self.columns);
            let abscissae: Vec<f64> = if self.share_x {
                column.filter_map(|j| self.panel_at(j)).flat_map(Panel::extent).map(|p| p.0).collect()
            } else {
                extent.iter().map(|p| p.0).collect()
            };
            let mut x = panel.x.settle(abscissae.into_iter(), !panel.runs_along_x(), self.size.0 / TICK_PITCH.0);
            let mut y = panel.y.settle(extent.iter().map(|p| p.1), true, self.size.1 / TICK_PITCH.1);
            if panel.equal_aspect {
                equalise(&mut x, &mut y, self.size);
            }
            let lowest = i / self.columns + 1 == rows || i + self.columns >= self.cells.len();
            Some(Placed { panel, x, y, labelled_x: !self.share_x || lowest })
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
            let widest = labels.map(|label| text::width(&label, f64::from(TICK))).fold(0.0, f64::max);
            let title = if placed.panel.y.label.is_empty() { 0.0 } else { LABEL + 8.0 };
            widest + TICK_LENGTH + 8.0 + title
        };
        let column = |c: usize| placed.iter().skip(c).step_by(self.columns).flatten().map(needed).fold(0.0, f64::max);
        (0..self.columns).map(column).collect()
    }

    /// Caption, with the panel's letter if there are several, and the height above the data area.
    fn head(&self, i: usize) -> (String, f64) {
        let caption = match &self.cells[i] {
            Cell::Panel(panel) => &panel.caption,
            Cell::Space(space) => &space.caption,
        };
        let letter = char::from(b'a' + (i % 26) as u8);
        let words = if self.cells.len() > 1 { format!("({letter}) {caption}") } else { caption.clone() };
        let words = words.trim_end().to_owned();
        let legend = if self.legends == Legends::EachPanel { self.own_legend(i).height() } else { 0.0 };
        let caption_height = if words.is_empty() { 2.0 } else { LABEL + 8.0 };
        (words, caption_height + legend)
    }

    fn own_legend(&self, i: usize) -> Legend {
        Legend::new(entries(&self.cells[i]), self.size.0)
    }

    fn draw_head(&self, svg: &mut Svg, i: usize, area: Area, head: f64) {
        let (words, _) = self.head(i);
        let look = TextLook { size: LABEL, ..TextLook::default() };
        svg.text(at(area.origin.x, area.origin.y - head + LABEL), &words, look);
        if self.legends == Legends::EachPanel {
            let legend = self.own_legend(i);
            legend.draw(svg, area.origin.x + area.size.0 / 2.0, area.origin.y - legend.height());
        }
    }
}

fn entries(cell: &Cell) -> Vec<Entry> {
    match cell {
        Cell::Panel(panel) => panel.entries(),
        Cell::Space(space) => space.entries(),
    }
}

/// A data area: its upper left corner and its size, px.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) origin: Point,
    pub(super) size: (f64, f64),
}

/// Widens one axis so that a unit is as long on both.
fn equalise(x: &mut SettledAxis, y: &mut SettledAxis, size: (f64, f64)) {
    let (unit_x, unit_y) = ((x.max - x.min) / size.0, (y.max - y.min) / size.1);
    let unit = unit_x.max(unit_y);
    for (axis, length) in [(&mut *x, size.0), (&mut *y, size.1)] {
        let surplus = unit * length - (axis.max - axis.min);
        axis.min -= surplus / 2.0;
        axis.max += surplus / 2.0;
    }
    let step = x.step.max(y.step);
    (x.step, y.step) = (step, step);
}

/// Room below the data area of a panel: tick labels and axis label.
fn foot(placed: &Placed<'_>) -> f64 {
    if !placed.labelled_x {
        return TICK_LENGTH;
    }
    let title = if placed.panel.x.label.is_empty() { 0.0 } else { LABEL + 6.0 };
    TICK_LENGTH + f64::from(TICK) + 6.0 + title
}

fn draw_panel(svg: &mut Svg, placed: &Placed<'_>, area: Area, index: usize, left: f64) {
    let (width, height) = area.size;
    let Point { x: x0, y: y0 } = area.origin;
    let inside = |value: f64, axis: &SettledAxis| (-1e-9..=1.0 + 1e-9).contains(&axis.fraction(value));
    for rule in &placed.panel.rules {
        let axis = if rule.vertical { &placed.x } else { &placed.y };
        if inside(rule.value, axis) {
            draw_rule(svg, rule, axis.fraction(rule.value), area);
        }
    }
    svg.raw(&data_layer(placed, area, index));
    for note in &placed.panel.notes {
        let point = at(x0 + width * placed.x.fraction(note.x), y0 + height * (1.0 - placed.y.fraction(note.y)) - 6.0);
        svg.text(point, &note.text, TextLook { size: 11.0, anchor: Anchor::Middle, ..TextLook::default() });
    }
    let centred = TextLook { size: LABEL, anchor: Anchor::Middle, ..TextLook::default() };
    if placed.labelled_x {
        svg.text(at(x0 + width / 2.0, y0 + height + foot(placed) - 3.0), &placed.panel.x.label, centred);
    }
    let turned = TextLook { rotation: -90.0, ..centred };
    svg.text(at(x0 - left + LABEL - 1.0, y0 + height / 2.0), &placed.panel.y.label, turned);
}

fn draw_rule(svg: &mut Svg, rule: &super::panel::Rule, fraction: f64, area: Area) {
    let (width, height) = area.size;
    let look: Look = reference_style();
    let small = TextLook { size: 10.5, ..TextLook::default() };
    if rule.vertical {
        let top = area.origin.offset(width * fraction, 0.0);
        svg.polyline(&[top, top.offset(0.0, height)], &look);
        svg.text(top.offset(4.0, 11.0), &rule.label, small);
    } else {
        let start = area.origin.offset(0.0, height * (1.0 - fraction));
        svg.polyline(&[start, start.offset(width, 0.0)], &look);
        let end = TextLook { anchor: Anchor::End, ..small };
        svg.text(start.offset(width - 4.0, -4.0), &rule.label, end);
    }
}

/// Axes, ticks and data by kuva, as a group placed in the figure.
fn data_layer(placed: &Placed<'_>, area: Area, index: usize) -> String {
    let (width, height) = area.size;
    let plots = placed.panel.plots(&placed.x, &placed.y, width, height);
    // Room for tick labels inside kuva's canvas; the group is shifted back by it.
    let room = 60.0;
    let mut scene = render_multiple(plots, kuva_layout(placed, area.size, room));
    scene.background_color = None;
    let document = SvgBackend::new().render_scene(&scene);
    let inner = document.split_once('>').map_or("", |(_, rest)| rest).trim_end().trim_end_matches("</svg>");
    let comment_free = inner.split_once("-->").map_or(inner, |(_, rest)| rest);
    let (dx, dy) = (area.origin.x - room, area.origin.y - room);
    let group = format!(
        "<g transform=\"translate({} {})\" font-family=\"{FONT_FAMILY}\">{comment_free}</g>",
        super::svg::number(dx),
        super::svg::number(dy)
    );
    renumber_clips(&group, index)
}

/// kuva numbers clip paths over the whole process; pictures must not depend on what was drawn before them.
fn renumber_clips(group: &str, index: usize) -> String {
    const MARK: &str = "kuva-clip-";
    let mut names: Vec<String> = Vec::new();
    let mut parts = group.split(MARK);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.chars().take_while(char::is_ascii_digit).count();
        let (name, rest) = part.split_at(digits);
        let position = names.iter().position(|known| known == name).unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        out += &format!("clip-{index}-{position}{rest}");
    }
    out
}

fn kuva_layout(placed: &Placed<'_>, (width, height): (f64, f64), room: f64) -> Layout {
    let (x, y) = (&placed.x, &placed.y);
    let format = |axis: &SettledAxis, shown: bool| -> TickFormat {
        let (step, scale) = (axis.step, axis.scale);
        TickFormat::Custom(Arc::new(move |v| if shown { tick_label(v, step, scale) } else { String::new() }))
    };
    let ink = || INK.to_owned();
    let theme =
        Theme { axis_color: ink(), tick_color: ink(), text_color: ink(), show_grid: false, ..Theme::light() };
    let mut layout = Layout::new((x.min, x.max), (y.min, y.max))
        .with_width(width + 2.0 * room)
        .with_height(height + 2.0 * room)
        .with_force_margins(room, room)
        .with_force_margins_y(room, room)
        .with_x_axis_min(x.min)
        .with_x_axis_max(x.max)
        .with_y_axis_min(y.min)
        .with_y_axis_max(y.max)
        .with_show_grid(false)
        .with_box_axes()
        .with_tick_size(TICK)
        .with_tick_length(TICK_LENGTH)
        .with_axis_line_width(0.8)
        .with_tick_width(0.8)
        .with_x_tick_format(format(x, placed.labelled_x))
        .with_y_tick_format(format(y, true))
        .with_theme(theme);
    match x.scale {
        super::axis::Scale::Linear => layout = layout.with_x_tick_step(x.step),
        super::axis::Scale::Log => layout = layout.with_log_x(),
    }
    match y.scale {
        super::axis::Scale::Linear => layout = layout.with_y_tick_step(y.step),
        super::axis::Scale::Log => layout = layout.with_log_y(),
    }
    if !placed.panel.x.categories.is_empty() {
        layout = layout.with_x_categories(placed.panel.x.categories.clone());
    }
    layout
}
