//! `identify flight`.

use super::Done;
use crate::arguments::{Common, Flown};
use crate::input::{Part, Recorded};
use crate::output::Answer;
use crate::{input, plot, ulog, vehicle};
use quad_dynamics::Vehicle;
use quad_plot::panel::BandPoint;
use quad_plot::{Figure, Look, Panel};
use std::error::Error;
use std::ops::RangeInclusive;
use sysid::flight::{Comparison, ThrustAndInertia, Window, identify_thrust_and_inertia};
use sysid::recorded::InertialLog;

/// Run-in that a part begins after unless it is chosen, s: the lag's state is unknown before.
const RUN_IN_S: f64 = 1.0;
/// The line of levels 1 to 4 goes through the curve from half to one and a half times the thrust of hover.
const LINE_OF_HOVER: (f64, f64) = (0.5, 1.5);
/// Longest median step, s, at which lag and inertia can be identified: half a bin of the increments.
const LONGEST_STEP_S: f64 = 0.0105;
/// Seconds that the picture shows of the rotation: more hides the curves in each other.
const SHOWN_S: f64 = 4.0;

pub(super) fn identify(common: &Common, flown: &Flown, answer: &mut Answer) -> Done {
    let path = common
        .vehicle
        .as_ref()
        .ok_or("a flight needs --vehicle for mass, positions of the rotors and PWM range")?;
    let file = vehicle::read(path, answer)?;
    let vehicle = Vehicle::from_file(&file, &path.display().to_string())?;
    let log = log(common, flown, &vehicle, answer)?;
    let mass = flown.mass_kg.unwrap_or(vehicle.airframe.mass);
    let span = flown.from.unwrap_or(first(&log) + RUN_IN_S)..flown.to.unwrap_or(f64::INFINITY);
    let window = Window { log: &log, span };
    let found = identify_thrust_and_inertia(&window, &window, mass, &vehicle)?
        .with_thrust_errors(&vehicle, &window)?;
    answer.warn(&found.thrust.fit.warnings);
    for fit in [&found.roll, &found.pitch] {
        let axis = format!("{:?}", fit.axis).to_lowercase();
        let named: Vec<String> = fit.warnings.iter().map(|w| format!("{axis}: {w}")).collect();
        answer.warn(&named);
    }
    numbers(&found, &vehicle, mass, answer);
    answer.figure = Some(figure(&found, &vehicle, &window)?);
    Ok(())
}

fn first(log: &InertialLog) -> f64 {
    log.time.first().copied().unwrap_or_default()
}

/// The flight with commands as shares of the vehicle's PWM range, at nominal voltage where both voltages are known.
fn log(
    common: &Common,
    flown: &Flown,
    vehicle: &Vehicle,
    answer: &mut Answer,
) -> Result<InertialLog, Box<dyn Error>> {
    let is_ulog = common
        .data
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("ulg"));
    let part = Part::of(flown.from, flown.to);
    let mut recorded = if is_ulog {
        let motors = <[usize; 4]>::try_from(flown.motors.as_slice())
            .map_err(|_| "--motors needs four numbers, as in 1,2,3,4")?;
        ulog::flight(&common.data, &motors, part, answer)?
    } else {
        let mut recorded = input::flight(&common.data, part, answer)?;
        shares(&mut recorded.log, vehicle)?;
        recorded
    };
    at_nominal_voltage(&mut recorded, vehicle, answer);
    let log = recorded.log;
    let mut steps: Vec<f64> = log.time.windows(2).map(|t| t[1] - t[0]).collect();
    steps.sort_by(f64::total_cmp);
    if let Some(&step) = steps.get(steps.len() / 2)
        && step > LONGEST_STEP_S
    {
        answer.warnings.push(format!(
            "lag and inertia need at least 100 samples per second, the log has {:.0}",
            1.0 / step
        ));
    }
    Ok(log)
}

/// Raw duties as shares `c = (ū − ū_min)/(ū_max − ū_min)` of the vehicle's range.
fn shares(log: &mut InertialLog, vehicle: &Vehicle) -> Result<(), Box<dyn Error>> {
    let (minimum, maximum) = (vehicle.pwm.minimum, vehicle.pwm.maximum);
    for (commands, time) in log.commands.iter_mut().zip(&log.time) {
        for command in commands {
            if !(minimum..=maximum).contains(command) {
                return Err(format!(
                    "the duty must lie in the vehicle's PWM range, {minimum} to {maximum}, got {command} at {time} s"
                )
                .into());
            }
            *command = (*command - minimum) / (maximum - minimum);
        }
    }
    Ok(())
}

/// Commands that would give the same motor voltage at the battery's nominal voltage: `c V/V_nominal`. A battery falls by a tenth
/// and more in flight, and a thrust curve of the command alone would move with it.
fn at_nominal_voltage(recorded: &mut Recorded, vehicle: &Vehicle, answer: &mut Answer) {
    let (Some(voltage), Some(battery)) = (&recorded.voltage, &vehicle.battery) else {
        answer.warnings.push(
            "the log or the vehicle file has no battery voltage: the thrust curve holds at the flight's mean voltage".to_owned(),
        );
        return;
    };
    for (commands, volts) in recorded.log.commands.iter_mut().zip(voltage) {
        *commands = commands.map(|c| c * volts / battery.nominal_voltage);
    }
}

fn numbers(found: &ThrustAndInertia, vehicle: &Vehicle, mass: f64, answer: &mut Answer) {
    let pwm = &vehicle.pwm;
    let range = pwm.maximum - pwm.minimum;
    let operating = operating(found, mass * vehicle.environment.gravity / 4.0);
    let line = found.thrust.line(&operating);
    let zero = line.zero.mapped(pwm.minimum + range * line.zero.value, range);
    let gain = line.gain.mapped(line.gain.value / range, 1.0 / range);
    let lag = found.thrust.lag();
    let duty = |share: f64| pwm.minimum + range * share;
    let line_of = format!(
        "line through the thrust curve over duties {:.4} to {:.4}, mass {mass} kg assumed known",
        duty(*operating.start()),
        duty(*operating.end())
    );
    let taken = format!("mass {mass} kg assumed known");
    let inverse = 1.0 / lag.value;
    for (key, fit) in [
        ("airframe.inertia_xx_kg_m2", &found.roll),
        ("airframe.inertia_yy_kg_m2", &found.pitch),
    ] {
        answer.push_made(key, "kg m²", fit.inertia, &taken);
    }
    answer.push_made("linear_rotor.thrust_gain_n", "N", gain, &line_of);
    answer.push_made("pwm.zero_thrust", "1", zero, &line_of);
    answer.push(
        "linear_rotor.bandwidth_rad_s",
        "rad/s",
        lag.mapped(inverse, inverse * inverse),
    );
    answer.push("motor lag", "s", lag);
    for (name, fit) in [("delay of roll", &found.roll), ("delay of pitch", &found.pitch)] {
        answer.push(name, "s", fit.delay);
    }
    let names = ["thrust curve k_0", "thrust curve k_1", "thrust curve k_2"];
    for (name, estimate) in names.iter().zip(found.thrust.fit.parameters) {
        answer.push(name, "N", estimate);
    }
}

/// The commands of the line, shares of the range.
fn operating(found: &ThrustAndInertia, hover: f64) -> RangeInclusive<f64> {
    let curve = found.thrust.curve();
    curve.command(LINE_OF_HOVER.0 * hover)..=curve.command(LINE_OF_HOVER.1 * hover).min(1.0)
}

fn figure(
    found: &ThrustAndInertia,
    vehicle: &Vehicle,
    window: &Window<'_>,
) -> Result<Figure, Box<dyn Error>> {
    let thrust = found.thrust.compare(window.log, &window.span)?;
    let roll = found.roll.compare(vehicle, window.log, &window.span)?;
    let pitch = found.pitch.compare(vehicle, window.log, &window.span)?;
    let mut figure = plot::figure(2);
    for (comparison, name, symbol) in [
        (&thrust, "Total thrust Σ*T*, N", "Σ*T*, N"),
        (&roll, "Roll *ṗ*, rad s^{−2}", "*ṗ*, rad s^{−2}"),
        (&pitch, "Pitch *q̇*, rad s^{−2}", "*q̇*, rad s^{−2}"),
    ] {
        let left = Panel::new("Time *t*, s", format!("Residual of {symbol}")).line(
            "",
            THIN,
            shown(comparison, &residual(comparison)),
        );
        figure = figure
            .panel(compared(comparison, name))
            .panel(left.horizontal(0.0, ""));
    }
    Ok(figure.panel(curve(found, window)))
}

/// Look of measured series.
const THIN: Look = Look {
    width: 1.2,
    ..plot::DATA
};

fn compared(comparison: &Comparison, label: &str) -> Panel {
    Panel::new("Time *t*, s", label)
        .line("measured", THIN, shown(comparison, &comparison.measured))
        .line(
            "fit",
            plot::FIT.dashed("4 2"),
            shown(comparison, &comparison.predicted),
        )
}

fn residual(comparison: &Comparison) -> Vec<f64> {
    let pairs = comparison.measured.iter().zip(&comparison.predicted);
    pairs.map(|(m, p)| m - p).collect()
}

/// The first seconds of a series.
fn shown(comparison: &Comparison, values: &[f64]) -> Vec<(f64, f64)> {
    let start = comparison.time.first().copied().unwrap_or_default();
    let points = comparison.time.iter().copied().zip(values.iter().copied());
    points.take_while(|(t, _)| *t <= start + SHOWN_S).collect()
}

/// The thrust curve with its 95 % band over the commands that were flown.
fn curve(found: &ThrustAndInertia, window: &Window<'_>) -> Panel {
    let at = |c: f64| found.thrust.thrust(c);
    let samples = window.log.window(window.span.start, window.span.end);
    let (lowest, highest) = plot::span(window.log.commands[samples].iter().flatten().copied());
    let band = plot::curve(lowest, highest, |c| at(c).half_width());
    Panel::new(
        "Share of the PWM range at nominal voltage *c*",
        "Thrust of one rotor *T*, N",
    )
    .band(
        "95 % interval",
        plot::DATA,
        band.iter().map(|&(x, half)| BandPoint {
            x,
            lower: at(x).value - half,
            upper: at(x).value + half,
        }),
    )
    .line(
        "thrust curve",
        plot::FIT,
        plot::curve(lowest, highest, |c| at(c).value),
    )
}
