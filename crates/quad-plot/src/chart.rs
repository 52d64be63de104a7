//! A panel with settled axes, drawn: axes, ticks and data by kuva, labels and reference lines by this layer.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::render::render_multiple;
use kuva::render::theme::Theme;

use super::axis::{Scale, SettledAxis};
use super::layer::Rule;
use super::panel::Panel;
use super::style::{INK, reference_style};
use super::svg::{Anchor, FONT_FAMILY, Point, Svg, TextLook, at, number};

/// Font size of axis labels and captions, px.
pub(super) const LABEL: f64 = 12.0;
/// Font size of tick labels, px.
pub(super) const TICK: u32 = 11;
/// Length of ticks, px.
pub(super) const TICK_LENGTH: f64 = 4.0;
/// Space right of the data, for half a tick label, px.
pub(super) const RIGHT: f64 = 16.0;
/// A panel with settled axes and its place in the figure.
pub(super) struct Placed<'a> {
    pub(super) panel: &'a Panel,
    pub(super) x: SettledAxis,
    pub(super) y: SettledAxis,
    /// Whether tick labels and axis label stand below it.
    pub(super) labelled_x: bool,
}

/// A data area: its upper left corner and its size, px.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) origin: Point,
    pub(super) size: (f64, f64),
}

/// Widens one axis so that a unit is as long on both.
pub(super) fn equalise(x: &mut SettledAxis, y: &mut SettledAxis, size: (f64, f64)) {
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
pub(super) fn foot(placed: &Placed<'_>) -> f64 {
    if !placed.labelled_x {
        return TICK_LENGTH;
    }
    let title = if placed.panel.x.label.is_empty() {
        0.0
    } else {
        LABEL + 6.0
    };
    TICK_LENGTH + f64::from(TICK) + 3.0 + title
}

/// Draws a panel in its area; `left` is the room left of it, px.
pub(super) fn draw_panel(svg: &mut Svg, placed: &Placed<'_>, area: Area, index: usize, left: f64) {
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
        let point = at(
            x0 + width * placed.x.fraction(note.x),
            y0 + height * (1.0 - placed.y.fraction(note.y)) - 6.0,
        );
        svg.text(
            point,
            &note.text,
            TextLook {
                size: 11.0,
                anchor: Anchor::Middle,
                ..TextLook::default()
            },
        );
    }
    let centred = TextLook {
        size: LABEL,
        anchor: Anchor::Middle,
        ..TextLook::default()
    };
    if placed.labelled_x {
        svg.text(
            at(x0 + width / 2.0, y0 + height + foot(placed) - 3.0),
            &placed.panel.x.label,
            centred,
        );
    }
    draw_exponents(svg, placed, area);
    let turned = TextLook {
        rotation: -90.0,
        ..centred
    };
    svg.text(
        at(x0 - left + LABEL - 1.0, y0 + height / 2.0),
        &placed.panel.y.label,
        turned,
    );
}

/// The powers of ten that tick labels leave out: above the vertical axis, and right below the horizontal one.
fn draw_exponents(svg: &mut Svg, placed: &Placed<'_>, area: Area) {
    let look = TextLook {
        size: f64::from(TICK),
        anchor: Anchor::End,
        ..TextLook::default()
    };
    svg.text(
        area.origin.offset(-TICK_LENGTH, -7.0),
        &placed.y.exponent_label(),
        look,
    );
    if placed.labelled_x {
        let corner = area
            .origin
            .offset(area.size.0 + RIGHT - 4.0, area.size.1 + foot(placed) - 3.0);
        svg.text(corner, &placed.x.exponent_label(), look);
    }
}

fn draw_rule(svg: &mut Svg, rule: &Rule, fraction: f64, area: Area) {
    let (width, height) = area.size;
    let (from, to) = if rule.vertical {
        let top = area.origin.offset(width * fraction, 0.0);
        (top, top.offset(0.0, height))
    } else {
        let start = area.origin.offset(0.0, height * (1.0 - fraction));
        (start, start.offset(width, 0.0))
    };
    svg.polyline(&[from, to], &reference_style());
}

/// Axes, ticks and data by kuva, as a group placed in the figure.
fn data_layer(placed: &Placed<'_>, area: Area, index: usize) -> String {
    let plots = placed.panel.plots((&placed.x, &placed.y), area.size);
    // Room for tick labels inside kuva's canvas; the group is shifted back by it.
    let room = 60.0;
    let mut scene = render_multiple(plots, kuva_layout(placed, area.size, room));
    scene.background_color = None;
    let document = SvgBackend::new().render_scene(&scene);
    let inner = document
        .split_once('>')
        .map_or("", |(_, rest)| rest)
        .trim_end()
        .trim_end_matches("</svg>");
    let comment_free = inner.split_once("-->").map_or(inner, |(_, rest)| rest);
    let (dx, dy) = (area.origin.x - room, area.origin.y - room);
    let group = format!(
        "<g transform=\"translate({} {})\" font-family=\"{FONT_FAMILY}\">{comment_free}</g>",
        number(dx),
        number(dy)
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
        let axis = axis.clone();
        TickFormat::Custom(Arc::new(
            move |v| if shown { axis.tick_label(v) } else { String::new() },
        ))
    };
    let ink = || INK.to_owned();
    let theme = Theme {
        axis_color: ink(),
        tick_color: ink(),
        text_color: ink(),
        show_grid: false,
        ..Theme::light()
    };
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
        Scale::Linear => layout = layout.with_x_tick_step(x.step),
        Scale::Log => layout = layout.with_log_x(),
    }
    match y.scale {
        Scale::Linear => layout = layout.with_y_tick_step(y.step),
        Scale::Log => layout = layout.with_log_y(),
    }
    if !placed.panel.x.categories.is_empty() {
        layout = layout.with_x_categories(placed.panel.x.categories.clone());
    }
    layout
}
