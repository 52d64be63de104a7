//! A panel with settled axes, drawn: reference lines, data, axes, ticks, labels and notes.

use super::axis::{Scale, SettledAxis};
use super::data;
use super::font;
use super::frame::{Area, Frame};
use super::layer::{Note, Rule};
use super::panel::Panel;
use super::style::{INK, Look, reference_style};
use super::svg::{Anchor, Svg, TextLook, at};

/// Font size of axis labels and captions, px.
pub(super) const LABEL: f64 = 12.0;
/// Font size of tick labels, px.
pub(super) const TICK: f64 = 11.0;
/// Length of ticks, px.
pub(super) const TICK_LENGTH: f64 = 4.0;
/// Length of ticks without labels, px.
const MINOR_TICK_LENGTH: f64 = 2.2;
/// Space right of the data, for half a tick label, px.
pub(super) const RIGHT: f64 = 16.0;
/// Least space between neighbouring tick labels, px.
const LABEL_GAP: f64 = 5.0;
/// Distance of the lines of a category's name, px.
const LEADING: f64 = 13.0;
/// Height of the power of ten above the vertical axis, px.
const EXPONENT_LIFT: f64 = 6.0;
/// Height of the row that it takes, px.
pub(super) const EXPONENT_ROW: f64 = TICK + EXPONENT_LIFT;
/// Font size of notes, px.
const NOTE: f64 = 11.0;
/// Look of axes and ticks.
const EDGE: Look = Look::solid(INK, 0.8);

/// A panel with settled axes and its place in the figure.
pub(super) struct Placed<'a> {
    pub(super) panel: &'a Panel,
    pub(super) x: SettledAxis,
    pub(super) y: SettledAxis,
    /// Whether tick labels and axis label stand below it.
    pub(super) labelled_x: bool,
}

/// Widens one axis so that a unit is as long on both. A logarithmic axis has no unit: it stays as it is.
pub(super) fn equalise(x: &mut SettledAxis, y: &mut SettledAxis, size: (f64, f64)) {
    let (unit_x, unit_y) = ((x.max - x.min) / size.0, (y.max - y.min) / size.1);
    let unit = unit_x.max(unit_y);
    let linear = x.scale == Scale::Linear && y.scale == Scale::Linear;
    if !linear || !(unit * size.0.max(size.1)).is_finite() {
        return;
    }
    for (axis, length) in [(&mut *x, size.0), (&mut *y, size.1)] {
        let surplus = unit * length - (axis.max - axis.min);
        axis.min -= surplus / 2.0;
        axis.max += surplus / 2.0;
    }
    let step = x.step.max(y.step);
    (x.step, y.step) = (step, step);
}

impl Placed<'_> {
    /// Tick labels of the horizontal axis with their places; lines of a category's name are apart.
    fn x_labels(&self, width: f64) -> Vec<(f64, Vec<String>)> {
        let names = &self.panel.x.categories;
        let pitch = width / (self.x.max - self.x.min).max(f64::MIN_POSITIVE);
        let label = |value: f64, lines: Vec<String>| Some((self.x.place(value)?, lines));
        if names.is_empty() {
            let ticks = self.x.ticks().into_iter();
            let all: Vec<_> = ticks
                .filter_map(|t| label(t, vec![self.x.tick_label(t)]))
                .collect();
            return apart(all, |(f, lines)| (width * f, font::width(&lines[0], TICK)));
        }
        let named = names
            .iter()
            .zip(1..)
            .map(|(name, k)| (f64::from(k), wrapped(name, pitch - LABEL_GAP)));
        named
            .filter_map(|(k, lines)| label(k, lines))
            .filter(|(f, _)| (0.0..=1.0).contains(f))
            .collect()
    }

    /// Places of the ticks of the horizontal axis: all numbers, or the categories.
    fn x_ticks(&self, width: f64) -> Vec<f64> {
        if self.panel.x.categories.is_empty() {
            places(&self.x, self.x.ticks())
        } else {
            self.x_labels(width).into_iter().map(|(f, _)| f).collect()
        }
    }

    /// Tick labels of the vertical axis with their places.
    pub(super) fn y_labels(&self, height: f64) -> Vec<(f64, String)> {
        let ticks = self.y.ticks().into_iter();
        let all = ticks
            .filter_map(|t| Some((self.y.place(t)?, self.y.tick_label(t))))
            .collect();
        apart(all, |(f, _)| (height * f, TICK - LABEL_GAP + 2.0))
    }
}

/// The labels, or every second, third, … so that none touches the next; `extent` gives centre and size.
fn apart<T>(labels: Vec<T>, extent: impl Fn(&T) -> (f64, f64)) -> Vec<T> {
    let extents: Vec<(f64, f64)> = labels.iter().map(extent).collect();
    let free = |every: &usize| {
        let kept: Vec<_> = extents.iter().step_by(*every).collect();
        kept.windows(2)
            .all(|pair| (pair[1].0 - pair[0].0).abs() >= (pair[0].1 + pair[1].1) / 2.0 + LABEL_GAP)
    };
    let every = (1..labels.len()).find(free).unwrap_or(labels.len().max(1));
    labels.into_iter().step_by(every).collect()
}

/// A name broken into lines of at most this width, px, where it has spaces.
fn wrapped(name: &str, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in name.split(' ') {
        match lines.last_mut() {
            Some(line) if font::width(&format!("{line} {word}"), TICK) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Room below the data area of a panel of this width, px: tick labels and axis label.
pub(super) fn foot(placed: &Placed<'_>, width: f64) -> f64 {
    if !placed.labelled_x {
        return TICK_LENGTH;
    }
    let title = if placed.panel.x.label.is_empty() {
        0.0
    } else {
        LABEL + 6.0
    };
    let lines = placed
        .x_labels(width)
        .iter()
        .map(|(_, lines)| lines.len())
        .max()
        .unwrap_or(1);
    TICK_LENGTH + TICK + 3.0 + LEADING * (lines as f64 - 1.0) + title
}

/// Draws a panel in its area; `left` is the room left of it, px.
pub(super) fn draw_panel(svg: &mut Svg, placed: &Placed<'_>, area: Area, left: f64) {
    let frame = Frame {
        x: &placed.x,
        y: &placed.y,
        area,
    };
    for rule in &placed.panel.rules {
        draw_rule(svg, rule, &frame);
    }
    for layer in &placed.panel.layers {
        data::draw(svg, layer, &frame);
    }
    draw_axes(svg, placed, &frame);
    for note in &placed.panel.notes {
        draw_note(svg, note, &frame);
    }
    draw_labels(svg, placed, area, left);
    draw_exponents(svg, placed, area);
}

/// Words just above a point; near an edge they are moved so that they stay inside the area.
fn draw_note(svg: &mut Svg, note: &Note, frame: &Frame<'_>) {
    const ABOVE: f64 = 6.0;
    const INSIDE: f64 = 3.0;
    let Some(point) = frame.place((note.x, note.y)) else {
        return;
    };
    let rect = frame.rect();
    let half = font::width(&note.text, NOTE) / 2.0 + INSIDE;
    let within = |value: f64, low: f64, high: f64| {
        if low < high {
            value.clamp(low, high)
        } else {
            (low + high) / 2.0
        }
    };
    let x = within(point.x, rect.low.x + half, rect.high.x - half);
    let y = within(point.y - ABOVE, rect.low.y + NOTE, rect.high.y - INSIDE);
    let look = TextLook {
        size: NOTE,
        anchor: Anchor::Middle,
        ..TextLook::default()
    };
    svg.text(at(x, y), &note.text, look);
}

/// A box around the data, with ticks outside and their labels.
fn draw_axes(svg: &mut Svg, placed: &Placed<'_>, frame: &Frame<'_>) {
    let rect = frame.rect();
    let corners = [
        rect.low,
        at(rect.high.x, rect.low.y),
        rect.high,
        at(rect.low.x, rect.high.y),
    ];
    svg.polyline(
        &[corners[0], corners[1], corners[2], corners[3], corners[0]],
        &EDGE,
    );
    let mut below = |fractions: Vec<f64>, length: f64| {
        for x in fractions.into_iter().map(|f| frame.across(f)) {
            svg.polyline(&[at(x, rect.high.y), at(x, rect.high.y + length)], &EDGE);
        }
    };
    below(placed.x_ticks(frame.area.size.0), TICK_LENGTH);
    below(places(&placed.x, placed.x.minor_ticks()), MINOR_TICK_LENGTH);
    let mut beside = |fractions: Vec<f64>, length: f64| {
        for y in fractions.into_iter().map(|f| frame.up(f)) {
            svg.polyline(&[at(rect.low.x, y), at(rect.low.x - length, y)], &EDGE);
        }
    };
    beside(places(&placed.y, placed.y.ticks()), TICK_LENGTH);
    beside(places(&placed.y, placed.y.minor_ticks()), MINOR_TICK_LENGTH);
    draw_tick_labels(svg, placed, frame);
}

/// Positions along an axis.
fn places(axis: &SettledAxis, values: Vec<f64>) -> Vec<f64> {
    values.into_iter().filter_map(|value| axis.place(value)).collect()
}

fn draw_tick_labels(svg: &mut Svg, placed: &Placed<'_>, frame: &Frame<'_>) {
    let rect = frame.rect();
    let look = |anchor| TextLook {
        size: TICK,
        anchor,
        ..TextLook::default()
    };
    if placed.labelled_x {
        for (f, lines) in placed.x_labels(frame.area.size.0) {
            for (line, k) in lines.iter().zip(0..) {
                let base = rect.high.y + TICK_LENGTH + TICK + 1.0 + LEADING * f64::from(k);
                svg.text(at(frame.across(f), base), line, look(Anchor::Middle));
            }
        }
    }
    for (f, label) in placed.y_labels(frame.area.size.1) {
        let base = at(rect.low.x - TICK_LENGTH - 3.0, frame.up(f) + 0.36 * TICK);
        svg.text(base, &label, look(Anchor::End));
    }
}

/// The axes' labels: below, and left, read upwards.
fn draw_labels(svg: &mut Svg, placed: &Placed<'_>, area: Area, left: f64) {
    let (width, height) = area.size;
    let centred = TextLook {
        size: LABEL,
        anchor: Anchor::Middle,
        ..TextLook::default()
    };
    if placed.labelled_x {
        let below = area
            .origin
            .offset(width / 2.0, height + foot(placed, width) - 3.0);
        svg.text(below, &placed.panel.x.label, centred);
    }
    let turned = TextLook {
        rotation: -90.0,
        ..centred
    };
    let beside = area.origin.offset(LABEL - 1.0 - left, height / 2.0);
    svg.text(beside, &placed.panel.y.label, turned);
}

/// The powers of ten that tick labels leave out: above the vertical axis, and right below the horizontal one.
fn draw_exponents(svg: &mut Svg, placed: &Placed<'_>, area: Area) {
    let look = TextLook {
        size: TICK,
        anchor: Anchor::Start,
        ..TextLook::default()
    };
    svg.text(
        area.origin.offset(-TICK_LENGTH, -EXPONENT_LIFT),
        &placed.y.exponent_label(),
        look,
    );
    if placed.labelled_x {
        let corner = area.origin.offset(
            area.size.0 + RIGHT - 4.0,
            area.size.1 + foot(placed, area.size.0) - 3.0,
        );
        let look = TextLook {
            anchor: Anchor::End,
            ..look
        };
        svg.text(corner, &placed.x.exponent_label(), look);
    }
}

fn draw_rule(svg: &mut Svg, rule: &Rule, frame: &Frame<'_>) {
    let rect = frame.rect();
    let axis = if rule.vertical { frame.x } else { frame.y };
    let Some(fraction) = axis
        .place(rule.value)
        .filter(|f| (-1e-9..=1.0 + 1e-9).contains(f))
    else {
        return;
    };
    let ends = if rule.vertical {
        let x = frame.across(fraction);
        [at(x, rect.low.y), at(x, rect.high.y)]
    } else {
        let y = frame.up(fraction);
        [at(rect.low.x, y), at(rect.high.x, y)]
    };
    svg.polyline(&ends, &reference_style());
}
