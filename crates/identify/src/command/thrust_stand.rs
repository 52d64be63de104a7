//! `identify thrust-stand`.

use super::Done;
use crate::arguments::{Common, LineRange};
use crate::output::Answer;
use crate::{input, plot, vehicle};
use quad_dynamics::vehicle::VehicleFile;
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
    /// Labels of the axis and of residuals.
    axis: &'static str,
    residual: &'static str,
}

impl Shown {
    /// What is drawn of a sample.
    fn drawn(&self, sample: &StaticSample) -> f64 {
        self.axis_scale() * sample.of(self.quantity)
    }

    /// Thrust in N, torque in mN m.
    fn axis_scale(&self) -> f64 {
        match self.quantity {
            Quantity::Thrust => 1.0,
            Quantity::Torque => MILLI,
        }
    }
}

const MILLI: f64 = 1e3;

const THRUST: Shown = Shown {
    quantity: Quantity::Thrust,
    coefficient: "propeller.thrust_coefficient",
    cubic: [
        ("polynomial_rotor.thrust_k1_n_per_v", "N/V"),
        ("polynomial_rotor.thrust_k2_n_per_v2", "N/V²"),
        ("polynomial_rotor.thrust_k3_n_per_v3", "N/V³"),
    ],
    axis: "Thrust *T*, N",
    residual: "Residual of *T*, mN",
};
const TORQUE: Shown = Shown {
    quantity: Quantity::Torque,
    coefficient: "propeller.torque_coefficient",
    cubic: [
        ("polynomial_rotor.torque_k1_n_m_per_v", "N m/V"),
        ("polynomial_rotor.torque_k2_n_m_per_v2", "N m/V²"),
        ("polynomial_rotor.torque_k3_n_m_per_v3", "N m/V³"),
    ],
    axis: "Torque *Q*, mN m",
    residual: "Residual of *Q*, mN m",
};

pub(super) fn identify(common: &Common, range: LineRange, answer: &mut Answer) -> Done {
    let path = common
        .vehicle
        .as_ref()
        .ok_or("a thrust stand needs --vehicle for diameter, air density and PWM range")?;
    let file = vehicle::read(path, answer)?;
    let propeller = file
        .propeller
        .as_ref()
        .ok_or("the vehicle file needs [propeller] with a diameter")?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter.value,
        air_density_kg_m3: file.environment.air_density.value,
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
        return Some(battery.nominal_voltage.value);
    }
    let mut voltages: Vec<f64> = samples.iter().map(|s| s.battery_voltage_v).collect();
    voltages.sort_by(f64::total_cmp);
    voltages.get(voltages.len() / 2).copied()
}

fn over_speed(shown: &Shown, samples: &[StaticSample], fitted: impl Fn(f64) -> f64) -> Panel {
    let speeds = samples.iter().map(|s| s.speed_rad_s);
    let (_, fastest) = plot::span(speeds.clone());
    let points = speeds.zip(samples.iter().map(|s| shown.drawn(s)));
    plot::measured(
        Panel::new("Rotor speed *Ω*, rad s^{−1}", shown.axis),
        points.clone().collect(),
    )
    .line(
        "constant coefficient",
        plot::FIT,
        plot::curve(0.0, fastest, |speed| shown.axis_scale() * fitted(speed)),
    )
    .x_range(0.0, BEYOND * fastest)
}

/// How far an axis goes beyond the last point, which would be cut at its end.
const BEYOND: f64 = 1.03;

const EFFECTIVE: &str = "*x* = (*ū* − *ū*_{min}) *V*_{b}, V";

fn over_effective(shown: &Shown, samples: &[StaticSample], minimum: f64, fit: &Fit<3>) -> Panel {
    let x = |s: &StaticSample| s.effective(minimum);
    let points = samples.iter().map(|s| (x(s), shown.drawn(s)));
    let (_, end) = plot::span(samples.iter().map(x));
    let [k1, k2, k3] = fit.values();
    let cubic = |x: f64| shown.axis_scale() * ((k3 * x + k2) * x + k1) * x;
    plot::measured(Panel::new(EFFECTIVE, shown.axis), points.collect())
        .line("cubic", plot::FIT, plot::curve(0.0, end, cubic))
        .x_range(0.0, BEYOND * end)
}

fn left_over(shown: &Shown, samples: &[StaticSample], minimum: f64, fit: &Fit<3>) -> Panel {
    let points = samples.iter().zip(&fit.residuals);
    let (_, end) = plot::span(samples.iter().map(|s| s.effective(minimum)));
    let points = points.map(|(s, r)| (s.effective(minimum), MILLI * r)).collect();
    plot::residuals(
        Panel::new(EFFECTIVE, shown.residual)
            .caption("of the cubic")
            .x_range(0.0, BEYOND * end),
        points,
    )
}

/// The line of the linear rotor over its range, thrust and torque, and what it leaves.
fn lines(figure: Figure, chosen: &[StaticSample], gains: &LinearGains) -> Figure {
    let zero = gains.zero_thrust.value;
    let (_, end) = plot::span(chosen.iter().map(|s| s.duty));
    let wide = |panel: Panel| plot::wide(panel, chosen.iter().map(|s| s.duty).chain([zero]));
    let both = [
        (&THRUST, gains.thrust_gain.value, &gains.thrust.residuals),
        (&TORQUE, gains.torque_gain.value, &gains.torque.residuals),
    ];
    let figure = both.into_iter().fold(figure, |figure, (shown, gain, _)| {
        let points = chosen.iter().map(|s| (s.duty, shown.drawn(s)));
        let line = |duty: f64| shown.axis_scale() * gain * (duty - zero);
        let panel = plot::measured(Panel::new("Duty *ū*", shown.axis), points.collect());
        figure.panel(wide(panel.line(
            "line of the linear rotor",
            plot::FIT,
            plot::curve(zero, end, line),
        )))
    });
    both.into_iter().fold(figure, |figure, (shown, _, residuals)| {
        let points = chosen.iter().zip(residuals).map(|(s, r)| (s.duty, MILLI * r));
        let panel = Panel::new("Duty *ū*", shown.residual).caption("of the line");
        figure.panel(wide(plot::residuals(panel, points.collect())))
    })
}
