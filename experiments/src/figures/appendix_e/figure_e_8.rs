//! Figure E.8: the four rotors at one voltage.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, series_style};
use crate::rotor_bench::panels::{DUTY, label, shown};
use crate::rotor_bench::{PLACES, RotorBench};
use sysid::rotor_static::{Quantity, StaticSample, linear_gains};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "E.8",
    title: "Characterisation of the four rotors at constant voltage",
    description: "Thrust and reaction torque of the four rotors over the operating range at 11.1 V (virtual thrust stand, twenty \
                  readings a point), with the lines of table 4.5; below, each rotor less the mean of the four.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[DIFFER],
    make: Make::Draw(draw),
};

const DIFFER: Claim =
    Claim::holds("the rotors differ by more than the readings' noise: no one line serves all four");

/// Standard deviation of a mean of twenty thrust readings, N: 0.03/√20.
const NOISE: f64 = 0.0067;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let bench = RotorBench::default();
    let vehicle = bench.vehicle(context)?;
    let mut data = DataTable::new(["rotor", "duty", "thrust_n", "torque_n_m"]);
    let mut tests: Vec<Vec<StaticSample>> = Vec::new();
    for (rotor, place) in bench.four(&vehicle)?.iter().zip(PLACES) {
        let samples = bench.operating(&vehicle, rotor)?;
        for s in &samples {
            data.push([
                place.into(),
                s.duty.into(),
                s.thrust_n.into(),
                s.torque_n_m.into(),
            ]);
        }
        tests.push(samples);
    }
    let figure = Figure::columns(2)
        .panel(panel(&tests, Quantity::Thrust)?)
        .panel(panel(&tests, Quantity::Torque)?)
        .panel(differences(&tests, Quantity::Thrust))
        .panel(differences(&tests, Quantity::Torque));
    // Spread of the four at each duty, root mean square over the range.
    let points = tests.iter().map(Vec::len).min().unwrap_or(0);
    let spread = |k: usize| {
        let mean = mean(&tests, Quantity::Thrust, k);
        tests.iter().map(|t| (t[k].thrust_n - mean).powi(2)).sum::<f64>() / 3.0
    };
    let deviation = ((0..points).map(spread).sum::<f64>() / points as f64).sqrt();
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .settings(&bench)?
        .check(
            DIFFER,
            deviation > 3.0 * NOISE,
            format!(
                "standard deviation between rotors {:.3} N, of a reading {:.3} N",
                deviation, NOISE
            ),
        ))
}

fn panel(tests: &[Vec<StaticSample>], quantity: Quantity) -> Result<Panel, ItemError> {
    let mut panel = Panel::new(DUTY, label(quantity)).x_range(6.0, 8.9).line(
        "lines of table 4.5",
        Look::solid(INK, 1.6),
        [],
    );
    for (i, samples) in tests.iter().enumerate() {
        let gains = linear_gains(samples)?;
        let gain = match quantity {
            Quantity::Thrust => gains.thrust_gain.value,
            Quantity::Torque => gains.torque_gain.value,
        };
        let ends = [samples.first(), samples.last()].into_iter().flatten();
        let line = ends.map(|s| {
            let zeroed = s.duty - gains.zero_thrust.value;
            (100.0 * s.duty, shown(quantity) * gain * zeroed)
        });
        let points = samples
            .iter()
            .map(|s| (100.0 * s.duty, shown(quantity) * s.of(quantity)));
        panel = panel.line("", series_style(i), line).markers(
            format!("{} {}", i + 1, PLACES[i]),
            series_style(i),
            points,
        );
    }
    Ok(panel)
}

/// Mean of the rotors at the k-th duty, N or N m.
fn mean(tests: &[Vec<StaticSample>], quantity: Quantity, k: usize) -> f64 {
    tests.iter().map(|t| t[k].of(quantity)).sum::<f64>() / tests.len() as f64
}

fn differences(tests: &[Vec<StaticSample>], quantity: Quantity) -> Panel {
    let words = match quantity {
        Quantity::Thrust => "Thrust less mean, N",
        Quantity::Torque => "Torque less mean, mN m",
    };
    let panel = Panel::new(DUTY, words).x_range(6.0, 8.9).horizontal(0.0, "");
    tests.iter().enumerate().fold(panel, |panel, (i, samples)| {
        let points = samples.iter().enumerate().map(|(k, s)| {
            (
                100.0 * s.duty,
                shown(quantity) * (s.of(quantity) - mean(tests, quantity, k)),
            )
        });
        panel.markers(format!("{} {}", i + 1, PLACES[i]), series_style(i), points)
    })
}
