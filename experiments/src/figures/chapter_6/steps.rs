//! What the step responses of the chapter share: flights on several levels, their picture, data and metrics.

use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::ItemError;
use crate::plot::svg::Svg;
use crate::plot::{Figure, Panel, level_name, level_style};
use crate::scenarios::{self, Flight, Row, ScenarioFile};
use quad_dynamics::AnyQuadrotor;
use quad_ndi::Settings;
use quad_ndi::metrics::{Effort, StepMetrics};

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

    /// The quantity in a row.
    pub(super) fn of(self, row: &Row) -> f64 {
        match self {
            Self::Height => -row.position.z,
            Self::Yaw => row.attitude.yaw,
            Self::X => row.position.x,
        }
    }

    /// What is asked for in a row.
    pub(super) fn set_point(self, row: &Row) -> f64 {
        match self {
            Self::Height => -row.reference.z,
            Self::Yaw => row.reference_yaw,
            Self::X => row.reference.x,
        }
    }

    /// Settling time of the loop that controls it, s.
    pub(super) const fn designed_s(self, settings: &Settings) -> f64 {
        match self {
            Self::Height => settings.height.settling_time_s,
            Self::Yaw => settings.yaw.settling_time_s,
            Self::X => settings.position.settling_time_s,
        }
    }

    /// Label, column and index of the pseudo-input that drives it.
    pub(super) const fn pseudo_input(self) -> (&'static str, &'static str, usize) {
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
    /// What it did.
    pub(super) flight: Flight,
    /// How the quantity responded.
    pub(super) metrics: Option<StepMetrics>,
    /// What it cost.
    pub(super) effort: Effort,
}

impl Outcome {
    /// The quantity over time.
    pub(super) fn response(&self, quantity: Quantity) -> Vec<(f64, f64)> {
        self.flight.series(|row| quantity.of(row))
    }

    /// Number of its level.
    pub(super) const fn number(&self) -> u8 {
        self.flight.level.number()
    }
}

/// A step that was flown on several levels.
#[derive(Debug)]
pub(super) struct Steps {
    file: &'static ScenarioFile,
    quantity: Quantity,
    /// How the simulation ended.
    ending: String,
    /// Its flights, from the lowest level up.
    pub(super) outcomes: Vec<Outcome>,
}

/// Flies a scenario file, in which this quantity steps.
pub(super) fn fly(name: &str, quantity: Quantity) -> Result<Steps, ItemError> {
    let flown = scenarios::fly(name)?;
    let outcome = |flight: Flight| {
        let at_rest = AnyQuadrotor::<f64>::hovering(
            flight.level,
            &flight.vehicle,
            &flight.phenomena,
            nalgebra::Vector3::zeros(),
            0.0,
        )?;
        let response = flight.series(|row| quantity.of(row));
        let metrics = flight.is_complete.then(|| StepMetrics::of(&response, STEP));
        let commands: Vec<(f64, [f64; 4])> =
            flight.rows.iter().map(|row| (row.time_s, row.commands)).collect();
        let hover = at_rest.hover_input().commands;
        Ok(Outcome {
            metrics: metrics.flatten(),
            effort: Effort::of(&commands, &hover, flight.limits().as_ref()),
            flight,
        })
    };
    Ok(Steps {
        file: scenarios::find(name)?,
        quantity,
        ending: flown.flown.ending.to_string(),
        outcomes: flown
            .flights
            .into_iter()
            .map(outcome)
            .collect::<Result<_, ItemError>>()?,
    })
}

/// End of the time axis in designed settling times: what follows is rest, in the data alone.
const SHOWN: f64 = 1.6;

impl Steps {
    /// The drawing: response above, pseudo-input below, data, scenario, metrics.
    pub(super) fn drawing(&self) -> Drawing {
        let drawing = Drawing::picture(picture(self.quantity, &self.outcomes, self.shown_s()))
            .data(table(self.quantity, &self.outcomes))
            .scenario(self.file);
        self.outcomes.iter().fold(drawing, |d, o| d.note(self.remark(o)))
    }

    /// The file that was flown.
    pub(super) const fn file(&self) -> &'static ScenarioFile {
        self.file
    }

    /// The response of each level.
    pub(super) fn responses(&self) -> Vec<Vec<(f64, f64)>> {
        self.outcomes.iter().map(|o| o.response(self.quantity)).collect()
    }

    /// End of the time axis, s.
    fn shown_s(&self) -> f64 {
        self.outcomes.first().map_or(0.0, |first| {
            let end_s = first.flight.rows.last().map_or(0.0, |row| row.time_s);
            (SHOWN * self.quantity.designed_s(&first.flight.settings)).min(end_s)
        })
    }

    /// By how much the commands exceed the vehicle's range at most; negative inside it.
    pub(super) fn largest_excess(&self) -> f64 {
        let excess = |flight: &Flight| {
            let range = flight.vehicle.zeroed_range();
            let commands = flight.rows.iter().flat_map(|row| row.commands);
            commands
                .map(|u| (range.start() - u).max(u - range.end()))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        self.outcomes
            .iter()
            .map(|o| excess(&o.flight))
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// One sentence of numbers on a flight.
    fn remark(&self, outcome: &Outcome) -> String {
        let name = level_name(outcome.number());
        if !outcome.flight.is_complete {
            return format!("{name}: {}", self.ending);
        }
        let Some(m) = outcome.metrics else {
            return format!("{name}: no step");
        };
        let settled = m
            .settling_time_s
            .map_or("does not settle to 2 %".to_owned(), |t| {
                format!("settles in {t:.2} s")
            });
        let input = self.quantity.pseudo_input().2;
        let inputs = outcome
            .flight
            .rows
            .iter()
            .map(|row| row.pseudo_inputs[input].abs());
        format!(
            "{name}: {settled}, overshoot {:.1} %, error at the end {} {unit}, RMS error {:.3} {unit}, RMS command {:.4}, \
             saturated {:.2} s, largest pseudo-input {:.3}",
            100.0 * m.overshoot,
            fixed(m.steady_state_error),
            m.rms_error,
            outcome.effort.rms_command,
            outcome.effort.saturation_time_s,
            inputs.fold(0.0, f64::max),
            unit = self.quantity.unit(),
        )
    }
}

/// Largest excursion that is still drawn, in steps; a diverging flight leaves the picture there.
const CLIP: (f64, f64) = (-0.6, 2.0);

fn picture(quantity: Quantity, outcomes: &[Outcome], shown_s: f64) -> Svg {
    let (input_label, _, input) = quantity.pseudo_input();
    let mut above = Panel::new("Time *t*, s", quantity.label()).horizontal(STEP, "");
    let mut below = Panel::new("Time *t*, s", input_label);
    let mut extreme = (0.0_f64, 0.0_f64);
    for o in outcomes {
        let (name, look) = (level_name(o.number()), level_style(o.number()));
        let response = o.response(quantity);
        for &(_, y) in &response {
            extreme = (extreme.0.min(y), extreme.1.max(y));
        }
        above = above.line(name.clone(), look, response);
        below = below.line(name, look, o.flight.series(|row| row.pseudo_inputs[input]));
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
                let (name, look) = (level_name(o.number()), level_style(o.number()));
                panel.line(name, look, o.flight.series(|row| row.attitude.pitch))
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
    let label = format!("*x* − *x*_{{level {}}}, mm", lowest.number());
    let base = lowest.response(Quantity::X);
    let panel = Panel::new("Time *t*, s", label).horizontal(0.0, "");
    others.iter().fold(panel, |panel, o| {
        let response = o.response(Quantity::X);
        let points = response
            .iter()
            .zip(&base)
            .map(|((t, x), (_, b))| (*t, 1e3 * (x - b)));
        let number = o.number();
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
            .flat_map(|o| &o.flight.rows)
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
    let longest = outcomes.iter().max_by_key(|o| o.flight.rows.len());
    let mut names = vec!["t_s".to_owned()];
    let mut columns: Vec<Vec<f64>> = vec![
        longest
            .map(|o| o.flight.rows.iter().map(|r| r.time_s).collect())
            .unwrap_or_default(),
    ];
    for o in outcomes {
        let level = o.number();
        names.push(format!("{}_level_{level}", quantity.column()));
        columns.push(o.flight.rows.iter().map(|r| quantity.of(r)).collect());
        names.push(format!("{input_column}_level_{level}"));
        columns.push(o.flight.rows.iter().map(|r| r.pseudo_inputs[input]).collect());
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
