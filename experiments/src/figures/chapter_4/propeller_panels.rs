//! The panels and the data of figure 4.7.

use super::propeller::{AdvanceRow, Identified, Row, SCALE};
use crate::data::DataTable;
use crate::plot::panel::BandPoint;
use crate::plot::style::{Look, reference_style};
use crate::plot::{Panel, series_style};
use quad_dynamics::vehicle::derive::rad_per_s;
use sysid::rotor_static::Quantity;

const CONSTANT: &str = "one coefficient";
const VARYING: &str = "coefficient follows speed";
const MEASURED: &str = "measured, static";

const fn measured() -> Look {
    reference_style()
}

/// Speeds of a curve from the slowest to the fastest measured, rpm.
fn speeds(rows: &[Row]) -> impl Iterator<Item = f64> + Clone + use<> {
    let slowest = rows.iter().map(|r| r.rpm).fold(f64::INFINITY, f64::min);
    let fastest = rows.iter().map(|r| r.rpm).fold(0.0, f64::max);
    (0..=60).map(move |k| slowest + (fastest - slowest) * f64::from(k) / 60.0)
}

const SPEED: &str = "Speed, 1000 rpm";

/// Thrust or torque against the speed.
pub(super) fn force_panel(label: &str, rows: &[Row], quantity: Quantity, fit: &Identified) -> Panel {
    let unit = |rpm: f64| SCALE.unit(quantity, rad_per_s(rpm));
    let constant = fit.constant.values()[0];
    Panel::new(SPEED, label)
        .x_range(2.0, 7.0)
        .x_step(1.0)
        .line(
            CONSTANT,
            series_style(1),
            speeds(rows).map(|n| (n / 1e3, constant * unit(n))),
        )
        .line(
            VARYING,
            series_style(0),
            speeds(rows).map(|n| (n / 1e3, fit.varying.at(rad_per_s(n)).value * unit(n))),
        )
        .markers(
            MEASURED,
            measured(),
            rows.iter().map(|r| (r.rpm / 1e3, r.value(quantity))),
        )
}

/// A coefficient against the speed, with its intervals.
pub(super) fn coefficient_panel(label: &str, rows: &[Row], quantity: Quantity, fit: &Identified) -> Panel {
    let constant = fit.constant.parameters[0].interval();
    let band = |n: f64, interval: sysid::Interval| BandPoint {
        x: n / 1e3,
        lower: interval.lower,
        upper: interval.upper,
    };
    let at = |n: f64| fit.varying.at(rad_per_s(n));
    let value = fit.constant.values()[0];
    Panel::new(SPEED, label)
        .x_range(2.0, 7.0)
        .x_step(1.0)
        .band("", series_style(1), speeds(rows).map(|n| band(n, constant)))
        .band(
            "",
            series_style(0),
            speeds(rows).map(|n| band(n, at(n).interval())),
        )
        .line(CONSTANT, series_style(1), speeds(rows).map(|n| (n / 1e3, value)))
        .line(
            VARYING,
            series_style(0),
            speeds(rows).map(|n| (n / 1e3, at(n).value)),
        )
        .markers(
            MEASURED,
            measured(),
            rows.iter().map(|r| (r.rpm / 1e3, r.coefficient(quantity))),
        )
}

/// Nominal speeds of the runs in a stream, thousands of revolutions per minute, rounded to halves.
const RUNS: [f64; 4] = [4.0, 5.0, 6.0, 6.5];

/// A coefficient against the advance ratio, run by run.
pub(super) fn stream_panel(label: &str, rows: &[AdvanceRow], value: fn(&AdvanceRow) -> f64) -> Panel {
    let panel = Panel::new("Advance ratio *J*", label)
        .x_range(0.0, 0.85)
        .x_step(0.2);
    RUNS.iter().enumerate().fold(panel, |panel, (i, speed)| {
        let run = rows
            .iter()
            .filter(|row| (row.rpm / 500.0).round() / 2.0 == *speed);
        let points = run.map(|row| (row.sample.advance_ratio, value(row)));
        panel.markers(format!("{:.0} rpm", 1e3 * speed), series_style(2 + i), points)
    })
}

/// The measurements and what the laws make of them.
pub(super) fn table(rows: &[Row], thrust: &Identified, torque: &Identified) -> DataTable {
    let mut data = DataTable::new([
        "speed_rpm",
        "thrust_n",
        "torque_n_m",
        "fitted_thrust_n",
        "fitted_torque_n_m",
        "fitted_c_t_of_speed",
        "fitted_c_q_of_speed",
    ]);
    for r in rows {
        let fitted = |quantity, i: &Identified| i.constant.values()[0] * SCALE.unit(quantity, r.speed());
        data.push([
            r.rpm.into(),
            r.value(Quantity::Thrust).into(),
            r.value(Quantity::Torque).into(),
            fitted(Quantity::Thrust, thrust).into(),
            fitted(Quantity::Torque, torque).into(),
            thrust.varying.at(r.speed()).value.into(),
            torque.varying.at(r.speed()).value.into(),
        ]);
    }
    data
}
