//! Figure 4.10: the identified linear and polynomial models together, and what their difference does to a flight.

use super::identified::Found;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::GREY;
use crate::plot::{Figure, Look, Panel, level_style, reference_style, series_style};
use crate::rotor_bench::RotorBench;
use crate::rotor_bench::panels::{DUTY, label, shown};
use crate::scenarios::{self, Flights};
use std::collections::BTreeMap;
use sysid::rotor_static::Quantity;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.10",
    title: "Identified steady-state models of thrust and torque",
    description: "Readings over the operating range at 11.1 V (virtual thrust stand, nominal rotor) with the line and the cubic \
                  identified from the stand, the grey line at hover; right, a step in height of a level 5 vehicle with the \
                  identified parameters under c1, and the height that the line's error at hover predicts.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[STATED, EXPLAINS],
    make: Make::Draw(draw),
};

const STATED: Claim = Claim::holds("gains and zero-thrust duty are stated with 95 % intervals");
const EXPLAINS: Claim =
    Claim::holds("the linear model's error at hover explains level 5's steady-state height error");

/// Largest disagreement of prediction and flight, relative: at 8 s a critically damped height loop of 2 s has
/// `(1 + ωt) e^(−ωt)` = 2e-9 of its metre left, and the integration's error is smaller still.
const AGREEMENT: f64 = 1e-3;

/// The vehicle file that the scenario names.
const VEHICLE: &str = "4.10-vehicle.toml";

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let found = Found::of(&bench, &vehicle, &bench.nominal(&vehicle)?)?;
    let identified = found.applied(&vehicle).to_file("figure 4.10").to_toml();
    let file = scenarios::find("4.10-flight")?;
    let files = BTreeMap::from([(VEHICLE.to_owned(), identified.clone())]);
    let Flights { flights, .. } = Flights::of(&file.scenario()?, &files)?;
    let flight = &flights[0];
    let height = flight.series(|row| -row.position.z);
    let reached = height.last().map_or(f64::NAN, |(_, h)| *h);

    // Four rotors that give less than the line says: the loop's ω² e must make up for 4 ΔT / m.
    let weight = vehicle.hover_thrust_per_rotor();
    let line = found.gains.thrust_at(found.hover_duty);
    let omega = flight.settings.gains::<f64>()?.height.natural_frequency;
    let predicted = 4.0 * (line.value - weight) / (vehicle.airframe.mass * omega.powi(2));
    let figure = Figure::columns(3)
        .panel(panel(&bench, &found, Quantity::Thrust))
        .panel(panel(&bench, &found, Quantity::Torque))
        .panel(
            Panel::new("Time *t*, s", "Height *h*, m")
                .line("level 5 under c1", level_style(5), height.iter().copied())
                .line(
                    "predicted at rest",
                    series_style(2),
                    [(5.0, 1.0 - predicted), (8.0, 1.0 - predicted)],
                )
                .horizontal(1.0, "commanded"),
        );
    let [k_t, k_q, zero] = [
        found.gains.thrust_gain,
        found.gains.torque_gain,
        found.gains.zero_thrust,
    ];
    Ok(Drawing::picture(figure.draw())
        .data(table(&bench, &found))
        .named_data("height", heights(&height))
        .settings(&bench)?
        .scenario(file)
        .file(VEHICLE, identified)
        .check(
            STATED,
            [k_t, k_q, zero].iter().all(|e| e.half_width() > 0.0),
            format!(
                "K_T = {:.1} ± {:.1} N, K_Q = {:.3} ± {:.3} N m, ū_0 = {:.5} ± {:.5}",
                k_t.value,
                k_t.half_width(),
                k_q.value,
                k_q.half_width(),
                zero.value,
                zero.half_width()
            ),
        )
        .check(
            EXPLAINS,
            flight.is_complete && ((1.0 - reached) / predicted - 1.0).abs() < AGREEMENT,
            format!(
                "the line is {:+.3} ± {:.3} N off at hover, which predicts {:.4} m below the command; flown: {:.4} m",
                line.value - weight,
                line.half_width(),
                predicted,
                1.0 - reached
            ),
        ))
}

fn panel(bench: &RotorBench, found: &Found, quantity: Quantity) -> Panel {
    let curve = |model: usize| {
        let duties = (0..=80).map(|k| 0.056 + 0.034 * f64::from(k) / 80.0);
        duties.map(move |u| {
            (
                100.0 * u,
                shown(quantity) * found.models(bench, quantity, u)[model],
            )
        })
    };
    let measured = found
        .samples
        .iter()
        .map(|s| (100.0 * s.duty, shown(quantity) * s.of(quantity)));
    let readings = found.samples.iter().map(|s| shown(quantity) * s.of(quantity));
    let (low, high) = readings.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    let hover = [low, high].map(|y| (100.0 * found.hover_duty, y));
    Panel::new(DUTY, label(quantity))
        .markers("measured", reference_style(), measured)
        .line("linear", series_style(1), curve(0))
        .line("polynomial", series_style(0), curve(1))
        .line("hover", Look::solid(GREY, 1.0), hover)
}

fn table(bench: &RotorBench, found: &Found) -> DataTable {
    let mut data = DataTable::new([
        "duty",
        "thrust_n",
        "torque_n_m",
        "linear_thrust_n",
        "polynomial_thrust_n",
        "linear_torque_n_m",
        "polynomial_torque_n_m",
    ]);
    for s in &found.samples {
        let [thrust, torque] = [Quantity::Thrust, Quantity::Torque].map(|q| found.models(bench, q, s.duty));
        data.push([
            s.duty.into(),
            s.thrust_n.into(),
            s.torque_n_m.into(),
            thrust[0].into(),
            thrust[1].into(),
            torque[0].into(),
            torque[1].into(),
        ]);
    }
    data
}

fn heights(height: &[(f64, f64)]) -> DataTable {
    let (times, heights): (Vec<f64>, Vec<f64>) = height.iter().copied().unzip();
    DataTable::from_columns(&[("t_s", &times), ("height_m", &heights)])
}
