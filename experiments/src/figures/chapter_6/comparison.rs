//! What the comparisons of dynamic inversion and PID share: the tuned gains, pairs of flights, pictures, numbers.

use super::{paths, settings, steps};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::flight::{Law, Scenario, completed, series};
use crate::item::{Context, ItemError};
use crate::plot::svg::Svg;
use crate::plot::{Figure, Look, Panel, series_style};
use quad_dynamics::{Level, Phenomenon};
use quad_ndi::metrics::StepMetrics;
use quad_ndi::pid::{self, TuningOptions};
use quad_ndi::{FlightLog, PidSettings, Record};
use std::sync::Mutex;

/// The level both controllers fly: the one that neither was designed on.
pub(super) const FLOWN: Level = Level::Five;

/// Gains of this run, tuned once and shared by the five figures.
static TUNED: Mutex<Option<PidSettings>> = Mutex::new(None);

/// The PID gains: tuned on the level and with the phenomena and limits that they fly, by the seeded procedure of
/// `quad_ndi::pid::tune`. PID has no model to be designed from, so it is tuned where it is used.
pub(super) fn tuned(context: &Context) -> Result<PidSettings, ItemError> {
    let mut cache = TUNED
        .lock()
        .map_err(|_| ItemError::new("the tuning failed in another figure"))?;
    if let Some(settings) = *cache {
        return Ok(settings);
    }
    let vehicle = crate::flight::load_vehicle(context, crate::flight::NOMINAL_VEHICLE)?;
    let phenomena = FLOWN
        .phenomena()
        .without(Phenomenon::VoltageSag)
        .with(Phenomenon::InputLimits);
    let options = TuningOptions {
        level: FLOWN,
        phenomena,
        ..TuningOptions::default()
    };
    let settings = pid::tune(&vehicle, &options)?.settings;
    *cache = Some(settings);
    Ok(settings)
}

/// The same flight under both controllers.
#[derive(Debug)]
pub(super) struct Pair {
    /// The scenario of the inversion; PID differs in controller and gains only.
    pub(super) scenario: Scenario,
    /// Name, look and log of each.
    pub(super) flights: [(&'static str, Look, FlightLog); 2],
}

/// Flies a scenario of c3 on level 5 with limits, and the same under PID.
pub(super) fn fly(context: &Context, ndi: Scenario) -> Result<Pair, ItemError> {
    let ndi = Scenario {
        input_limits: true,
        ..ndi
    };
    let pid = Scenario {
        controller: Law::Pid,
        pid: Some(tuned(context)?),
        ..ndi.clone()
    };
    let flights = [
        ("NDI (c3)", series_style(0), ndi.fly(context, FLOWN)?),
        ("PID", series_style(1), pid.fly(context, FLOWN)?),
    ];
    // The scenario file keeps both: the settings of the inversion and the gains of PID.
    Ok(Pair {
        scenario: Scenario { pid: pid.pid, ..ndi },
        flights,
    })
}

/// The trajectory of figure 6.17 under both.
pub(super) fn fly_trajectory(context: &Context) -> Result<Pair, ItemError> {
    fly(context, paths::scenario(Law::C3))
}

/// A step under both, with the settings of the other steps.
pub(super) fn fly_step(
    context: &Context,
    step: fn(Law, quad_ndi::Settings, f64) -> Scenario,
) -> Result<Pair, ItemError> {
    let scenario = Scenario {
        record_every: 1,
        ..step(Law::C3, settings::flight(), 12.0)
    };
    fly(context, scenario)
}

/// What a step's figure shows, and to when.
pub(super) struct StepShown {
    /// The quantity that steps.
    pub(super) response: Shown,
    /// Its set point.
    pub(super) set_point: Shown,
    /// The pseudo-input that drives it.
    pub(super) input: Shown,
    /// Settling time that both controllers were designed or tuned for, s.
    pub(super) designed_s: f64,
    /// End of the input's time axis, s: it is over sooner than the response.
    pub(super) input_until_s: f64,
}

/// PID has been tuned for the settling time that the inversion has by design.
pub(super) const AS_TUNED: Claim =
    Claim::holds("the tuned PID settles within a tenth of the settling time that it was tuned for");

/// A step's figure: response, input, data, numbers of both.
pub(super) fn step_drawing(
    context: &Context,
    step: fn(Law, quad_ndi::Settings, f64) -> Scenario,
    shown: &StepShown,
) -> Result<Drawing, ItemError> {
    let pair = fly_step(context, step)?;
    let (label, value) = shown.response;
    let mut above = Panel::new("Time *t*, s", label).line(
        shown.set_point.0,
        crate::plot::reference_style(),
        series(&pair.flights[0].2, shown.set_point.1),
    );
    let mut below = Panel::new("Time *t*, s", shown.input.0);
    for (name, look, log) in &pair.flights {
        above = above.line(*name, *look, series(log, value));
        let early = series(log, shown.input.1).into_iter();
        let early = early.take_while(|(t, _)| *t <= shown.input_until_s);
        below = below.line(*name, *look, early.collect::<Vec<_>>());
    }
    let figure = Figure::columns(1)
        .panel(above.x_range(0.0, SHOWN * shown.designed_s))
        .panel(below.x_range(0.0, shown.input_until_s))
        .panel_size(440.0, 190.0);
    let settled_s = StepMetrics::of(&series(&pair.flights[1].2, value), 1.0).and_then(|m| m.settling_time_s);
    let drawing = Drawing::picture(figure.draw())
        .data(table(&pair, EARLY_S))
        .scenario(&pair.scenario)?
        .check(
            AS_TUNED,
            settled_s.is_some_and(|t| (t / shown.designed_s - 1.0).abs() < 0.1),
            format!("{settled_s:.2?} s for {} s", shown.designed_s),
        );
    Ok(remarks(&pair, value).into_iter().fold(drawing, Drawing::note))
}

/// End of a response's time axis, in designed settling times.
const SHOWN: f64 = 1.8;

/// Time within which every record of a step is kept in the data, s.
const EARLY_S: f64 = 1.0;

/// Time between the rows of data after that, s.
const ROW_S: f64 = 0.02;

/// A quantity with its axis label.
pub(super) type Shown = (&'static str, fn(&Record) -> f64);

/// Panels of quantities in columns, row by row.
pub(super) fn picture(pair: &Pair, columns: usize, shown: &[Shown], reference: &[Option<Shown>]) -> Svg {
    let mut figure = Figure::columns(columns).share_x().panel_size(320.0, 130.0);
    for (i, (label, value)) in shown.iter().enumerate() {
        let mut panel = Panel::new("Time *t*, s", *label);
        if let Some(Some((name, wanted))) = reference.get(i) {
            let points = series(&pair.flights[0].2, wanted);
            panel = panel.line(*name, crate::plot::reference_style(), points);
        }
        for (name, look, log) in &pair.flights {
            panel = panel.line(*name, *look, series(log, value));
        }
        figure = figure.panel(panel);
    }
    figure.draw()
}

/// Columns: controller, time, position, heading, pseudo-inputs; every record to `early_s`, s, then one each 20 ms.
pub(super) fn table(pair: &Pair, early_s: f64) -> DataTable {
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
    for (name, _, log) in &pair.flights {
        let mut next_s = f64::NEG_INFINITY;
        for r in &log.records {
            if r.time_s > early_s && r.time_s < next_s {
                continue;
            }
            // A quarter of the shortest step, lest rounding skip a row.
            next_s = r.time_s + ROW_S - 0.25e-3;
            let (p, u) = (&r.flight.position, &r.pseudo_inputs);
            table.push([
                (*name).into(),
                r.time_s.into(),
                p.x.into(),
                p.y.into(),
                p.z.into(),
                r.flight.attitude.yaw.into(),
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
pub(super) fn remarks(pair: &Pair, value: fn(&Record) -> f64) -> Vec<String> {
    let remark = |(name, _, log): &(&'static str, Look, FlightLog)| {
        if !completed(log) {
            return format!("{name}: diverged");
        }
        StepMetrics::of(&series(log, value), 1.0).map_or_else(String::new, |m| {
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
