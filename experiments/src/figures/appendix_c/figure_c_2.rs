//! Figure C.2: recorded against commanded trajectory.

use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, reference_style, series_style};
use crate::recordings::nanobench;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "C.2",
    title: "Recorded against commanded trajectory",
    description: "A Crazyflie on a figure of eight at 1 m/s: its set point and what motion capture recorded (NanoBench, Ullah and Baca 2026), in plan \
                  and over time. North is the laboratory's *x*.",
    kind: Kind::Plot,
    origin: Origin::Measured,
    claims: &[],
    make: Make::Draw(draw),
};

const FLIGHT: &str = "B3_figure8_fast_rep1.csv";
/// From before take-off to touch-down, where the set point ends, s.
const SHOWN: std::ops::Range<f64> = 2.0..23.0;
/// The path itself, between take-off and landing, for the error, s.
const ON_PATH: std::ops::Range<f64> = 7.0..20.0;
/// Every so many samples are stored: 20 Hz.
const STORED_EVERY: usize = 5;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let flight = nanobench(context, FLIGHT)?;
    let samples = flight.inertial.window(SHOWN.start, SHOWN.end);
    let time = &flight.inertial.time;
    let (flown, wanted) = (&flight.position, &flight.set_point);
    let north_east = |v: &nalgebra::Vector3<f64>| (v.y, v.x);
    let plan = Panel::new("East *y*, m", "North *x*, m")
        .equal_aspect()
        .x_step(1.0)
        .line(
            "commanded",
            reference_style(),
            wanted[samples.clone()].iter().map(north_east),
        )
        .line(
            "recorded",
            series_style(0),
            flown[samples.clone()].iter().map(north_east),
        );
    let over_time = |label: &str, value: fn(&nalgebra::Vector3<f64>) -> f64| {
        let series = |vectors: &[nalgebra::Vector3<f64>]| -> Vec<(f64, f64)> {
            samples.clone().map(|k| (time[k], value(&vectors[k]))).collect()
        };
        Panel::new("Time *t*, s", label)
            .line("commanded", reference_style(), series(wanted))
            .line("recorded", series_style(0), series(flown))
    };
    let figure = Figure::columns(2)
        .panel_size(270.0, 190.0)
        .panel(plan)
        .panel(over_time("North *x*, m", |v| v.x))
        .panel(over_time("East *y*, m", |v| v.y))
        .panel(over_time("Height *h*, m", |v| -v.z));
    let columns = [
        "t_s",
        "x_commanded_m",
        "y_commanded_m",
        "z_commanded_m",
        "x_m",
        "y_m",
        "z_m",
    ];
    // The recording's own numbers are not committed as a reference: they are others' data.
    let mut data = columns[1..]
        .iter()
        .fold(DataTable::new(columns), |table, column| {
            table.with_volatile(column)
        });
    for k in samples.step_by(STORED_EVERY) {
        let (w, p) = (wanted[k], flown[k]);
        data.push([time[k], w.x, w.y, w.z, p.x, p.y, p.z].map(Into::into));
    }
    let on_path = flight.inertial.window(ON_PATH.start, ON_PATH.end);
    let count = on_path.len() as f64;
    let squares: f64 = on_path.map(|k| (flown[k] - wanted[k]).norm_squared()).sum();
    let error = (squares / count).sqrt();
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .settings(&toml::toml! {
            flight = FLIGHT
            shown_s = [(SHOWN.start), (SHOWN.end)]
        })?
        .note(format!(
            "Distance from the set point on the path, root mean square: {error:.2} m. The vehicle follows a moving point with its standard \
             controller and lags behind it."
        )))
}
