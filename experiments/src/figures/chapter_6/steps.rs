//! What the step responses of the chapter share: flights on several levels, their picture, data and metrics.

use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::flight::{Scenario, completed, series};
use crate::item::{Context, ItemError};
use crate::plot::svg::Svg;
use crate::plot::{Figure, Panel, level_name, level_style};
use quad_dynamics::{AnyQuadrotor, Level};
use quad_ndi::metrics::{Effort, StepMetrics};
use quad_ndi::{FlightLog, FlightStatus, Record};

/// The quantity that steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Height `−z`, m.
    Height,
    /// Heading ψ, rad.
    Yaw,
    /// Horizontal position x, m.
    X,
}

impl Quantity {
    /// Axis label of the quantity.
    pub(super) const fn label(self) -> &'static str {
        match self {
            Self::Height => "Height *h* = −*z*, m",
            Self::Yaw => "Yaw *ψ*, rad",
            Self::X => "Position *x*, m",
        }
    }

    const fn column(self) -> &'static str {
        match self {
            Self::Height => "height_m",
            Self::Yaw => "yaw_rad",
            Self::X => "x_m",
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Height | Self::X => "m",
            Self::Yaw => "rad",
        }
    }

    /// The quantity in a record.
    pub(super) fn of(self, record: &Record) -> f64 {
        match self {
            Self::Height => -record.flight.position.z,
            Self::Yaw => record.flight.attitude.yaw,
            Self::X => record.flight.position.x,
        }
    }

    /// Label, column and index of the pseudo-input that drives it.
    const fn pseudo_input(self) -> (&'static str, &'static str, usize) {
        match self {
            Self::Height => ("Collective *u*_{col}", "u_col", 0),
            Self::Yaw => ("Yaw input *u*_{yaw}", "u_yaw", 3),
            Self::X => ("Longitudinal *u*_{long}", "u_long", 2),
        }
    }
}

/// The step commanded in every one of these figures: one metre, one radian.
pub(super) const STEP: f64 = 1.0;

/// One level's flight.
#[derive(Debug)]
pub(super) struct Outcome {
    /// The level.
    pub(super) level: Level,
    /// What was recorded.
    pub(super) log: FlightLog,
    /// How the quantity responded.
    pub(super) metrics: Option<StepMetrics>,
    /// What it cost.
    pub(super) effort: Effort,
}

impl Outcome {
    /// The quantity over time.
    pub(super) fn response(&self, quantity: Quantity) -> Vec<(f64, f64)> {
        series(&self.log, |r| quantity.of(r))
    }
}

/// Flies a scenario on each of the levels.
pub(super) fn fly(
    context: &Context,
    scenario: &Scenario,
    quantity: Quantity,
    levels: &[Level],
) -> Result<Vec<Outcome>, ItemError> {
    let vehicle = scenario.vehicle(context)?;
    let limits = scenario.limits(&vehicle);
    let outcome = |&level: &Level| {
        let log = scenario.fly_vehicle(&vehicle, level)?;
        let at_rest = AnyQuadrotor::<f64>::hovering(
            level,
            &vehicle,
            &scenario.phenomena(level),
            nalgebra::Vector3::zeros(),
            0.0,
        )?;
        let response = series(&log, |r| quantity.of(r));
        let metrics = completed(&log)
            .then(|| StepMetrics::of(&response, STEP))
            .flatten();
        let effort = Effort::of(&log.records, &at_rest.hover_input().commands, limits.as_ref());
        Ok(Outcome {
            level,
            metrics,
            effort,
            log,
        })
    };
    levels.iter().map(outcome).collect()
}

/// The drawing of a step on several levels: response above, pseudo-input below, data, scenario, metrics.
pub(super) fn drawing(
    scenario: &Scenario,
    quantity: Quantity,
    outcomes: &[Outcome],
) -> Result<Drawing, ItemError> {
    let drawing = Drawing::picture(picture(quantity, outcomes, shown_s(scenario, quantity)))
        .data(table(quantity, outcomes))
        .scenario(scenario)?;
    Ok(outcomes.iter().fold(drawing, |d, o| d.note(remark(quantity, o))))
}

/// End of the time axis in designed settling times: what follows is rest, in the data alone.
const SHOWN: f64 = 1.6;

/// End of the time axis, s.
fn shown_s(scenario: &Scenario, quantity: Quantity) -> f64 {
    let settings = &scenario.settings;
    let designed = match quantity {
        Quantity::Height => &settings.height,
        Quantity::Yaw => &settings.yaw,
        Quantity::X => &settings.position,
    };
    (SHOWN * designed.settling_time_s).min(scenario.duration_s)
}

/// Largest excursion that is still drawn, in steps; a diverging flight leaves the picture there.
const CLIP: (f64, f64) = (-0.6, 2.0);

fn picture(quantity: Quantity, outcomes: &[Outcome], shown_s: f64) -> Svg {
    let (input_label, _, input) = quantity.pseudo_input();
    let mut above = Panel::new("Time *t*, s", quantity.label()).horizontal(STEP, "");
    let mut below = Panel::new("Time *t*, s", input_label);
    let mut extreme = (0.0_f64, 0.0_f64);
    for o in outcomes {
        let (name, look) = (level_name(o.level.number()), level_style(o.level.number()));
        let response = o.response(quantity);
        for &(_, y) in &response {
            extreme = (extreme.0.min(y), extreme.1.max(y));
        }
        above = above.line(name.clone(), look, response);
        below = below.line(name, look, series(&o.log, |r| r.pseudo_inputs[input]));
    }
    if extreme.0 < CLIP.0 || extreme.1 > CLIP.1 {
        above = above.y_range(extreme.0.max(CLIP.0), extreme.1.min(CLIP.1));
    }
    let mut figure = Figure::columns(1)
        .panel(above.x_range(0.0, shown_s))
        .share_x()
        .panel_size(440.0, 180.0);
    if quantity == Quantity::X {
        figure = figure.panel(differences(outcomes)).panel_size(440.0, 150.0);
        let pitch = outcomes
            .iter()
            .fold(Panel::new("Time *t*, s", "Pitch *θ*, rad"), |panel, o| {
                let (name, look) = (level_name(o.level.number()), level_style(o.level.number()));
                panel.line(name, look, series(&o.log, |r| r.flight.attitude.pitch))
            });
        figure = figure.panel(pitch);
    }
    if let Some((low, high)) = range_without_spike(outcomes, input) {
        below = below.y_range(low, high);
    }
    figure.panel(below.x_range(0.0, shown_s)).draw()
}

/// The horizontal position less that of the lowest level, which the position itself hides.
fn differences(outcomes: &[Outcome]) -> Panel {
    let Some((lowest, others)) = outcomes.split_first() else {
        return Panel::default();
    };
    let label = format!("*x* − *x*_{{level {}}}, mm", lowest.level.number());
    let base = lowest.response(Quantity::X);
    let panel = Panel::new("Time *t*, s", label).horizontal(0.0, "");
    others.iter().fold(panel, |panel, o| {
        let response = o.response(Quantity::X);
        let points = response
            .iter()
            .zip(&base)
            .map(|((t, x), (_, b))| (*t, 1e3 * (x - b)));
        let number = o.level.number();
        panel.line("", level_style(number), points.collect::<Vec<_>>())
    })
}

/// Time after which an input counts as past its first spike, s.
const SPIKE_S: f64 = 0.1;

/// Margin of a range that leaves the first spike out, as a fraction of it.
const SPIKE_MARGIN: f64 = 0.15;

/// Range of a pseudo-input after its first spike, with a margin, where the spike would hide the rest.
fn range_without_spike(outcomes: &[Outcome], input: usize) -> Option<(f64, f64)> {
    let extremes = |from: f64| {
        let records = outcomes
            .iter()
            .flat_map(|o| &o.log.records)
            .filter(move |r| r.time_s >= from);
        records
            .map(|r| r.pseudo_inputs[input])
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| {
                (low.min(u), high.max(u))
            })
    };
    let ((low, high), (later_low, later_high)) = (extremes(0.0), extremes(SPIKE_S));
    let span = later_high - later_low;
    (high - low > 3.0 * span).then_some((later_low - SPIKE_MARGIN * span, later_high + SPIKE_MARGIN * span))
}

/// Columns: time, then quantity and pseudo-input of each level.
fn table(quantity: Quantity, outcomes: &[Outcome]) -> DataTable {
    let (_, input_column, input) = quantity.pseudo_input();
    let longest = outcomes.iter().max_by_key(|o| o.log.records.len());
    let mut names = vec!["t_s".to_owned()];
    let mut columns: Vec<Vec<f64>> = vec![
        longest
            .map(|o| o.log.records.iter().map(|r| r.time_s).collect())
            .unwrap_or_default(),
    ];
    for o in outcomes {
        let level = o.level.number();
        names.push(format!("{}_level_{level}", quantity.column()));
        columns.push(o.log.records.iter().map(|r| quantity.of(r)).collect());
        names.push(format!("{input_column}_level_{level}"));
        columns.push(o.log.records.iter().map(|r| r.pseudo_inputs[input]).collect());
    }
    // A flight that diverged has no values after that: NaN leaves the cell without a number.
    let rows = columns[0].len();
    for column in &mut columns {
        column.resize(rows, f64::NAN);
    }
    let borrowed: Vec<(&str, &[f64])> = names
        .iter()
        .zip(&columns)
        .map(|(name, column)| (name.as_str(), column.as_slice()))
        .collect();
    DataTable::from_columns(&borrowed)
}

/// A number with four digits after the point, and a zero without sign.
pub(super) fn fixed(value: f64) -> String {
    let text = format!("{value:.4}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|b| b == b'0' || b == b'.') => size.to_owned(),
        _ => text,
    }
}

/// One sentence of numbers on a flight.
fn remark(quantity: Quantity, outcome: &Outcome) -> String {
    let name = level_name(outcome.level.number());
    if let FlightStatus::Diverged { time_s, .. } = outcome.log.status {
        return format!("{name}: diverged, no finite state from {time_s:.3} s on");
    }
    let Some(m) = outcome.metrics else {
        return format!("{name}: no step");
    };
    let settled = m
        .settling_time_s
        .map_or("does not settle to 2 %".to_owned(), |t| {
            format!("settles in {t:.2} s")
        });
    format!(
        "{name}: {settled}, overshoot {:.1} %, error at the end {} {unit}, RMS error {:.3} {unit}, RMS command {:.4}, \
         saturated {:.2} s, largest pseudo-input {:.3}",
        100.0 * m.overshoot,
        fixed(m.steady_state_error),
        m.rms_error,
        outcome.effort.rms_command,
        outcome.effort.saturation_time_s,
        outcome
            .log
            .records
            .iter()
            .map(|r| r.pseudo_inputs[quantity.pseudo_input().2].abs())
            .fold(0.0, f64::max),
        unit = quantity.unit(),
    )
}

/// Largest distance between two responses at the same instants; infinite if one is shorter.
pub(super) fn distance(a: &[(f64, f64)], b: &[(f64, f64)]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    a.iter()
        .zip(b)
        .map(|(p, q)| (p.1 - q.1).abs())
        .fold(0.0, f64::max)
}

/// The critically damped second-order step, `1 − (1 + ω t) e^(−ω t)`.
pub(super) fn design(natural_frequency: f64, t: f64) -> f64 {
    STEP * (1.0 - (1.0 + natural_frequency * t) * (-natural_frequency * t).exp())
}

/// Largest distance of a response from its design.
pub(super) fn distance_from_design(response: &[(f64, f64)], natural_frequency: f64) -> f64 {
    response
        .iter()
        .map(|&(t, y)| (y - design(natural_frequency, t)).abs())
        .fold(0.0, f64::max)
}

/// Time at which a response first reaches 90 % of the step, s; infinite if it never does.
pub(super) fn rise_time_s(response: &[(f64, f64)]) -> f64 {
    response
        .iter()
        .find(|(_, y)| *y >= 0.9 * STEP)
        .map_or(f64::INFINITY, |(t, _)| *t)
}

/// By how much the commands of all flights exceed a range at most; negative inside it.
pub(super) fn largest_excess(outcomes: &[Outcome], range: &std::ops::RangeInclusive<f64>) -> f64 {
    let excess = |u: f64| (range.start() - u).max(u - range.end());
    outcomes
        .iter()
        .flat_map(|o| &o.log.records)
        .flat_map(|r| r.commands)
        .map(excess)
        .fold(f64::NEG_INFINITY, f64::max)
}
