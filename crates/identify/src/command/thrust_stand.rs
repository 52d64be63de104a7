//! `identify thrust-stand`.

use super::Done;
use crate::arguments::{Common, LineRange};
use crate::output::Answer;
use crate::{input, plot, vehicle};
use quad_dynamics::vehicle::file::VehicleFile;
use quad_plot::{Figure, Panel};
use sysid::Fit;
use sysid::rotor_static::{
    LinearGains, PropellerSample, PropellerScale, Quantity, StaticSample, coefficient, linear_gains,
    polynomial,
};

/// How far a voltage may lie from the one of the line, relative: half of what the line accepts as one voltage.
const SAME_VOLTAGE: f64 = 0.01;
/// A quantity of a thrust stand with its keys, units and axis.
struct Shown {
    quantity: Quantity,
    coefficient: &'static str,
    cubic: [(&'static str, &'static str); 3],
    axis: &'static str,
}

const THRUST: Shown = Shown {
    quantity: Quantity::Thrust,
    coefficient: "propeller.thrust_coefficient",
    cubic: [
        ("polynomial_rotor.thrust_k1_n_per_v", "N/V"),
        ("polynomial_rotor.thrust_k2_n_per_v2", "N/V²"),
        ("polynomial_rotor.thrust_k3_n_per_v3", "N/V³"),
    ],
    axis: "Thrust *T*, N",
};
const TORQUE: Shown = Shown {
    quantity: Quantity::Torque,
    coefficient: "propeller.torque_coefficient",
    cubic: [
        ("polynomial_rotor.torque_k1_n_m_per_v", "N m/V"),
        ("polynomial_rotor.torque_k2_n_m_per_v2", "N m/V²"),
        ("polynomial_rotor.torque_k3_n_m_per_v3", "N m/V³"),
    ],
    axis: "Torque *Q*, N m",
};

pub(super) fn identify(common: &Common, range: LineRange, answer: &mut Answer) -> Done {
    let path = common
        .vehicle
        .as_ref()
        .ok_or("a thrust stand needs --vehicle: diameter, air density and PWM range")?;
    let file = vehicle::read(path)?;
    let propeller = file
        .propeller
        .as_ref()
        .ok_or("the vehicle file has no [propeller] with its diameter")?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter_m.value,
        air_density_kg_m3: file.environment.air_density_kg_m3.value,
    };
    let samples = input::sweep(&common.data, answer)?;
    let minimum = file.pwm.minimum.value;
    let steady: Vec<PropellerSample> = samples.iter().map(PropellerSample::from).collect();
    let mut coefficients = Vec::new();
    let mut cubics = Vec::new();
    for shown in [&THRUST, &TORQUE] {
        let fit = coefficient(&steady, &scale, shown.quantity)?;
        answer.warn(&fit.warnings);
        answer.push(shown.coefficient, "1", fit.parameters[0]);
        coefficients.push(fit.parameters[0].value);
    }
    for shown in [&THRUST, &TORQUE] {
        let fit = polynomial(&samples, minimum, shown.quantity)?;
        answer.warn(&fit.warnings);
        for ((key, unit), estimate) in shown.cubic.iter().zip(fit.parameters) {
            answer.push(key, unit, estimate);
        }
        cubics.push(fit);
    }
    let line = gains(&samples, &file, range, answer);
    let mut figure = plot::figure(2);
    for (shown, coefficient) in [&THRUST, &TORQUE].into_iter().zip(coefficients) {
        let unit = |speed: f64| coefficient * scale.unit(shown.quantity, speed);
        figure = figure.panel(over_speed(shown, &samples, unit));
    }
    for (shown, fit) in [&THRUST, &TORQUE].into_iter().zip(&cubics) {
        figure = figure.panel(over_effective(shown, &samples, minimum, fit));
    }
    for (shown, fit) in [&THRUST, &TORQUE].into_iter().zip(&cubics) {
        figure = figure.panel(left_over(shown, &samples, minimum, fit));
    }
    answer.figure = Some(match &line {
        Some((gains, chosen)) => lines(figure, chosen, gains),
        None => figure,
    });
    Ok(())
}

/// The linear gains from the rows of one voltage within the operating range; the rest stands without them.
fn gains(
    samples: &[StaticSample],
    file: &VehicleFile,
    range: LineRange,
    answer: &mut Answer,
) -> Option<(LinearGains, Vec<StaticSample>)> {
    let voltage = voltage(samples, file)?;
    let from = range.line_from.unwrap_or(f64::NEG_INFINITY);
    let to = range.line_to.unwrap_or(f64::INFINITY);
    let chosen: Vec<StaticSample> = samples
        .iter()
        .filter(|s| (s.battery_voltage_v / voltage - 1.0).abs() <= SAME_VOLTAGE)
        .filter(|s| (from..=to).contains(&s.duty))
        .copied()
        .collect();
    let (lowest, highest) = plot::span(chosen.iter().map(|s| s.duty));
    match linear_gains(&chosen) {
        Ok(gains) => {
            let made = format!("line over duties {lowest} to {highest} at {voltage} V");
            let warnings: Vec<String> = gains.warnings().map(|w| format!("line: {w}")).collect();
            answer.warn(&warnings);
            answer.push_made("linear_rotor.thrust_gain_n", "N", gains.thrust_gain, &made);
            answer.push_made("linear_rotor.torque_gain_n_m", "N m", gains.torque_gain, &made);
            answer.push_made("pwm.zero_thrust", "1", gains.zero_thrust, &made);
            Some((gains, chosen))
        }
        Err(error) => {
            answer.warnings.push(format!(
                "no linear gains from the {} rows near {voltage} V: {error}",
                chosen.len()
            ));
            None
        }
    }
}

/// The voltage of the line, V: the vehicle's nominal one, or the data's middle one.
fn voltage(samples: &[StaticSample], file: &VehicleFile) -> Option<f64> {
    if let Some(battery) = &file.battery {
        return Some(battery.nominal_voltage_v.value);
    }
    let mut voltages: Vec<f64> = samples.iter().map(|s| s.battery_voltage_v).collect();
    voltages.sort_by(f64::total_cmp);
    voltages.get(voltages.len() / 2).copied()
}

fn over_speed(shown: &Shown, samples: &[StaticSample], fitted: impl Fn(f64) -> f64) -> Panel {
    let points = samples.iter().map(|s| (s.speed_rad_s, s.of(shown.quantity)));
    let (_, fastest) = plot::span(samples.iter().map(|s| s.speed_rad_s));
    plot::measured(
        Panel::new("Rotor speed *Ω*, rad s^{−1}", shown.axis),
        points.collect(),
    )
    .line(
        "constant coefficient",
        plot::FIT,
        plot::curve(0.0, fastest, fitted),
    )
}

const EFFECTIVE: &str = "*x* = (*ū* − *ū*_{min}) *V*_{b}, V";

fn over_effective(shown: &Shown, samples: &[StaticSample], minimum: f64, fit: &Fit<3>) -> Panel {
    let x = |s: &StaticSample| s.effective(minimum);
    let points = samples.iter().map(|s| (x(s), s.of(shown.quantity)));
    let (_, end) = plot::span(samples.iter().map(x));
    let [k1, k2, k3] = fit.values();
    plot::measured(Panel::new(EFFECTIVE, shown.axis), points.collect()).line(
        "cubic",
        plot::FIT,
        plot::curve(0.0, end, |x| ((k3 * x + k2) * x + k1) * x),
    )
}

fn left_over(shown: &Shown, samples: &[StaticSample], minimum: f64, fit: &Fit<3>) -> Panel {
    let points = samples.iter().zip(&fit.residuals);
    plot::residuals(
        Panel::new(EFFECTIVE, format!("Residual of the cubic: {}", shown.axis)),
        points.map(|(s, r)| (s.effective(minimum), *r)).collect(),
    )
}

/// The line of the linear rotor over its range, thrust and torque.
fn lines(figure: Figure, chosen: &[StaticSample], gains: &LinearGains) -> Figure {
    let (_, end) = plot::span(chosen.iter().map(|s| s.duty));
    let zero = gains.zero_thrust.value;
    [
        (&THRUST, gains.thrust_gain.value),
        (&TORQUE, gains.torque_gain.value),
    ]
    .into_iter()
    .fold(figure, |figure, (shown, gain)| {
        let points = chosen.iter().map(|s| (s.duty, s.of(shown.quantity)));
        let panel = plot::measured(Panel::new("Duty *ū*", shown.axis), points.collect());
        figure.panel(panel.line(
            "line",
            plot::FIT,
            plot::curve(zero, end, |duty| gain * (duty - zero)),
        ))
    })
}
