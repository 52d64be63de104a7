//! What the comparisons of dynamic inversion and PID share: the tuned gains, pairs of flights, pictures, numbers.

use super::{paths, settings};
use crate::data::DataTable;
use crate::flight::{Law, Scenario, completed, series};
use crate::item::{Context, ItemError};
use crate::plot::svg::Svg;
use crate::plot::{Controller, Figure, Look, Panel, controller_style};
use quad_dynamics::{Level, Phenomenon};
use quad_ndi::metrics::StepMetrics;
use quad_ndi::pid::{self, TuningOptions};
use quad_ndi::{FlightLog, PidSettings, Record};
use std::sync::Mutex;

/// The level both controllers fly: the one that neither was designed on.
pub(super) const FLOWN: Level = Level::Five;

/// Gains of this run, tuned once and shared by the five figures.
static TUNED: Mutex<Option<PidSettings>> = Mutex::new(None);

/// The PID gains: tuned on the level and with the phenomena that they fly, by the seeded procedure of
/// `quad_ndi::pid::tune`. PID has no model to be designed from, so it is tuned where it is used.
pub(super) fn tuned(context: &Context) -> Result<PidSettings, ItemError> {
    let mut cache = TUNED
        .lock()
        .map_err(|_| ItemError::new("the tuning failed in another figure"))?;
    if let Some(settings) = *cache {
        return Ok(settings);
    }
    let vehicle = crate::flight::load_vehicle(context, crate::flight::NOMINAL_VEHICLE)?;
    let phenomena = FLOWN.phenomena().without(Phenomenon::VoltageSag);
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
        (
            "NDI (c3)",
            controller_style(Controller::Ndi),
            ndi.fly(context, FLOWN)?,
        ),
        ("PID", controller_style(Controller::Pid), pid.fly(context, FLOWN)?),
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
    fly(context, step(Law::C3, settings::flight(), 12.0))
}

/// A quantity with its axis label.
pub(super) type Shown = (&'static str, fn(&Record) -> f64);

/// Panels of quantities in columns, row by row.
pub(super) fn picture(pair: &Pair, columns: usize, shown: &[Shown], reference: &[Option<Shown>]) -> Svg {
    let size = if columns == 1 {
        (440.0, 190.0)
    } else {
        (320.0, 130.0)
    };
    let mut figure = Figure::columns(columns).share_x().panel_size(size.0, size.1);
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

/// Columns: controller, time, position, heading, pseudo-inputs.
pub(super) fn table(pair: &Pair) -> DataTable {
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
        for r in log.records.iter().step_by(5) {
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
                "{name}: {settled}, overshoot {:.1} %, steady-state error {:.4}, RMS error {:.3}",
                100.0 * m.overshoot,
                m.steady_state_error,
                m.rms_error
            )
        })
    };
    pair.flights.iter().map(remark).collect()
}
