//! Figures 6.21 to 6.25: dynamic inversion against PID, pairs of flights from one scenario file each.

use super::paths::{self, Path};
use super::steps::{self, Quantity};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::svg::Svg;
use crate::plot::{Figure, Look, Panel, reference_style, series_style};
use crate::scenarios::{self, Flight, Row, ScenarioFile};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_ndi::metrics::StepMetrics;
use quad_ndi::pid::{self, TuningOptions};

/// What the figures have in common.
const PAIR: Item = Item {
    id: "",
    title: "",
    description: "",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::NotReproducible("the pattern of a figure"),
};

/// A step in height.
pub(super) const FIGURE_6_21: Item = Item {
    id: "6.21",
    title: "NDI against PID: step in height",
    description: "A step of one metre in height on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 2 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first second of the collective pseudo-input.",
    claims: &[AS_TUNED, TUNED],
    make: Make::Draw(|context| {
        let drawing = step("6.21", Quantity::Height, "Collective *u*_{col}", 1.0)?;
        as_in_the_file(context, drawing)
    }),
    ..PAIR
};

/// A step in yaw.
pub(super) const FIGURE_6_22: Item = Item {
    id: "6.22",
    title: "NDI against PID: step in yaw",
    description: "A step of one radian in heading on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 2 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first second of the yaw pseudo-input.",
    claims: &[AS_TUNED],
    make: Make::Draw(|_| step("6.22", Quantity::Yaw, "Yaw input *u*_{yaw}", 1.0)),
    ..PAIR
};

/// A step in horizontal position.
pub(super) const FIGURE_6_23: Item = Item {
    id: "6.23",
    title: "NDI against PID: step in horizontal position",
    description: "A step of one metre in *x* on level 5 with limits, under controller c3 and under cascaded PID tuned there \
                  for the same settling time of 5 s, with a set-point weight of ½ lest its integral overshoot. Above the response; below, on an \
                  axis of its own, the first two seconds of the longitudinal pseudo-input.",
    claims: &[AS_TUNED],
    make: Make::Draw(|_| step("6.23", Quantity::X, "Longitudinal *u*_{long}", 2.0)),
    ..PAIR
};

/// The reference trajectory in space.
pub(super) const FIGURE_6_24: Item = Item {
    id: "6.24",
    title: "NDI against PID: following a trajectory",
    description: "The reference of figure 6.17 on level 5 with limits, under controller c3 with its feed-forward and \
                  under cascaded PID, which gets position, heading and their first derivatives. Below, the distance from the reference. Grey: projection on the ground.",
    make: Make::Draw(|_| in_space()),
    ..PAIR
};

/// The reference trajectory, outputs and inputs.
pub(super) const FIGURE_6_25: Item = Item {
    id: "6.25",
    title: "NDI against PID: outputs and inputs along a trajectory",
    description: "The flights of figure 6.24: the four outputs on the left with the reference, the four \
                  pseudo-inputs on the right. The reference is smooth to its fourth derivative; c3 feeds the fifth forward too, \
                  which jumps at the waypoints (3, 6, 9 and 12 s), and so do its lateral and longitudinal inputs.",
    make: Make::Draw(|_| {
        let pair = Pair::fly(LOOP)?;
        Ok(Drawing::picture(outputs_and_inputs(&pair))
            .data(table(&pair, 0.0))
            .scenario(pair.file))
    }),
    ..PAIR
};

/// PID has been tuned for the settling time that the inversion has by design.
const AS_TUNED: Claim =
    Claim::holds("the tuned PID settles within a tenth of the settling time that it was tuned for");
const TUNED: Claim =
    Claim::holds("the PID gains of the scenario files are those that the seeded tuning finds");

/// The scenario of the two trajectory figures.
const LOOP: &str = "6.24";

/// The same flight under both controllers.
#[derive(Debug)]
struct Pair {
    file: &'static ScenarioFile,
    /// Name, look and flight of each.
    flights: [(&'static str, Look, Flight); 2],
}

impl Pair {
    fn fly(name: &str) -> Result<Self, ItemError> {
        let flown = scenarios::fly(name)?;
        let one = |name, look, agent| -> Result<_, ItemError> {
            Ok((name, series_style(look), flown.named(agent)?.clone()))
        };
        Ok(Self {
            file: scenarios::find(name)?,
            flights: [one("NDI (c3)", 0, "ndi")?, one("PID", 1, "pid")?],
        })
    }
}

/// Tunes PID on the level and with the phenomena and limits that it flies, by the seeded procedure of `quad_ndi::pid::tune`, and compares
/// with the gains of all files. PID has no model to be designed from, so it is tuned where it is used.
fn as_in_the_file(context: &Context, drawing: Drawing) -> Result<Drawing, ItemError> {
    let flown = scenarios::fly(LOOP)?;
    let pid = flown.named("pid")?;
    let options = TuningOptions {
        level: pid.level,
        phenomena: pid.phenomena.clone(),
        ..TuningOptions::default()
    };
    let found = pid::tune(&load_vehicle(context, NOMINAL_VEHICLE)?, &options)?.settings;
    let mut differ = Vec::new();
    for name in ["6.21", "6.22", "6.23", LOOP] {
        let scenario = scenarios::find(name)?.scenario()?;
        let given = scenario
            .quadrotor
            .iter()
            .find_map(|quadrotor| quadrotor.controller.pid);
        if given != Some(found) {
            differ.push(name);
        }
    }
    let measured = match differ[..] {
        [] => "the same to the last digit".to_owned(),
        _ => format!("others in {}; found {found:?}", differ.join(", ")),
    };
    Ok(drawing.check(TUNED, differ.is_empty(), measured))
}

/// A step's figure: response, input, data, numbers of both.
fn step(name: &str, quantity: Quantity, input_label: &str, input_until_s: f64) -> Result<Drawing, ItemError> {
    let pair = Pair::fly(name)?;
    let [(_, _, ndi), (_, _, pid)] = &pair.flights;
    let designed_s = quantity.designed_s(&ndi.settings);
    let (_, _, input) = quantity.pseudo_input();
    let mut above = Panel::new("Time *t*, s", quantity.label()).line(
        "set point",
        reference_style(),
        ndi.series(|row| quantity.set_point(row)),
    );
    let mut below = Panel::new("Time *t*, s", input_label);
    for (name, look, flight) in &pair.flights {
        above = above.line(*name, *look, flight.series(|row| quantity.of(row)));
        let early = flight.series(|row| row.pseudo_inputs[input]).into_iter();
        let early = early.take_while(|(t, _)| *t <= input_until_s);
        below = below.line(*name, *look, early.collect::<Vec<_>>());
    }
    let figure = Figure::columns(1)
        .panel(above.x_range(0.0, SHOWN * designed_s))
        .panel(below.x_range(0.0, input_until_s))
        .panel_size(440.0, 190.0);
    let settled_s = StepMetrics::of(&pid.series(|row| quantity.of(row)), 1.0).and_then(|m| m.settling_time_s);
    let drawing = Drawing::picture(figure.draw())
        .data(table(&pair, EARLY_S))
        .scenario(pair.file)
        .check(
            AS_TUNED,
            settled_s.is_some_and(|t| (t / designed_s - 1.0).abs() < 0.1),
            format!("{settled_s:.2?} s for {designed_s} s"),
        );
    Ok(remarks(&pair, quantity).into_iter().fold(drawing, Drawing::note))
}

/// Figure 6.24.
fn in_space() -> Result<Drawing, ItemError> {
    let Pair { file, flights } = Pair::fly(LOOP)?;
    let paths = flights.map(|(name, look, flight)| Path {
        column: name.to_owned(),
        ..Path::new(name.to_owned(), look, flight)
    });
    let drawing = Drawing::picture(paths::picture(&paths))
        .data(paths::table(&paths))
        .scenario(file);
    Ok(paths::remarks(&paths).into_iter().fold(drawing, Drawing::note))
}

/// End of a response's time axis, in designed settling times.
const SHOWN: f64 = 1.8;

/// Time within which every record of a step is kept in the data, s.
const EARLY_S: f64 = 1.0;

/// Time between the rows of data after that, s.
const ROW_S: f64 = 0.02;

/// A quantity.
type Value = fn(&Row) -> f64;

/// A quantity with its axis label.
type Shown = (&'static str, Value);

/// Outputs with their references, and pseudo-inputs, row by row.
const OUTPUTS_AND_INPUTS: [(Shown, Option<Value>); 8] = [
    (
        ("North *x*, m", |row| row.position.x),
        Some(|row| row.reference.x),
    ),
    (("Collective *u*_{col}", |row| row.pseudo_inputs[0]), None),
    (("East *y*, m", |row| row.position.y), Some(|row| row.reference.y)),
    (("Lateral *u*_{lat}", |row| row.pseudo_inputs[1]), None),
    (
        ("Height −*z*, m", |row| -row.position.z),
        Some(|row| -row.reference.z),
    ),
    (("Longitudinal *u*_{long}", |row| row.pseudo_inputs[2]), None),
    (("Yaw *ψ*, rad", unwrapped_yaw), Some(|row| row.reference_yaw)),
    (("Yaw input *u*_{yaw}", |row| row.pseudo_inputs[3]), None),
];

/// The heading on the reference's turn of the circle, rad.
fn unwrapped_yaw(row: &Row) -> f64 {
    use std::f64::consts::TAU;
    let error = row.reference_yaw - row.attitude.yaw;
    row.attitude.yaw + (error / TAU).round() * TAU
}

/// Panels of all quantities in two columns.
fn outputs_and_inputs(pair: &Pair) -> Svg {
    let mut figure = Figure::columns(2).share_x().panel_size(320.0, 130.0);
    for ((label, value), reference) in OUTPUTS_AND_INPUTS {
        let mut panel = Panel::new("Time *t*, s", label);
        if let Some(wanted) = reference {
            let (_, _, first) = &pair.flights[0];
            panel = panel.line("reference", reference_style(), first.series(wanted));
        }
        for (name, look, flight) in &pair.flights {
            panel = panel.line(*name, *look, flight.series(value));
        }
        figure = figure.panel(panel);
    }
    figure.draw()
}

/// Columns: controller, time, position, heading, pseudo-inputs; every record to `early_s`, s, then one each 20 ms.
fn table(pair: &Pair, early_s: f64) -> DataTable {
    let mut table = DataTable::new([
        "controller",
        "t_s",
        "x_m",
        "y_m",
        "z_m",
        "yaw_rad",
        "u_col",
        "u_lat",
        "u_long",
        "u_yaw",
    ]);
    for (name, _, flight) in &pair.flights {
        let mut next_s = f64::NEG_INFINITY;
        for r in &flight.rows {
            if r.time_s > early_s && r.time_s < next_s {
                continue;
            }
            // A quarter of the shortest step, lest rounding skip a row.
            next_s = r.time_s + ROW_S - 0.25e-3;
            let (p, u) = (&r.position, &r.pseudo_inputs);
            table.push([
                (*name).into(),
                r.time_s.into(),
                p.x.into(),
                p.y.into(),
                p.z.into(),
                r.attitude.yaw.into(),
                u[0].into(),
                u[1].into(),
                u[2].into(),
                u[3].into(),
            ]);
        }
    }
    table
}

/// One sentence on each controller's step.
fn remarks(pair: &Pair, quantity: Quantity) -> Vec<String> {
    let remark = |(name, _, flight): &(&'static str, Look, Flight)| {
        if !flight.is_complete {
            return format!("{name}: ended early");
        }
        StepMetrics::of(&flight.series(|row| quantity.of(row)), 1.0).map_or_else(String::new, |m| {
            let settled = m
                .settling_time_s
                .map_or("does not settle to 2 %".to_owned(), |t| {
                    format!("settles in {t:.2} s")
                });
            format!(
                "{name}: {settled}, overshoot {:.1} %, error at the end {}, RMS error {:.3}",
                100.0 * m.overshoot,
                steps::fixed(m.steady_state_error),
                m.rms_error
            )
        })
    };
    pair.flights.iter().map(remark).collect()
}
