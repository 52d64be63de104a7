//! What the replay of a motion-capture flight needs beside the identified vehicle: how this individual differs.
//!
//! A vehicle that carries markers and a deck, with other motors at other voltages, is not the one that was identified. From
//! one flight (the fitted one) follow
//!
//! ```text
//! mass           the effective mass m of −m f_z = Σ T(c_i V/V_nominal): mass over thrust scale, which a flight can't part
//! inertia        I_xx, I_yy in the same scale of thrust;  I_zz grows in the proportion of I_xx + I_yy
//! lag, delay     τ that explains roll and pitch best, δ of the gyroscope's records behind the motors' commands
//! trim           offsets of the commands that cancel the mean moments of unequal rotors, of a shifted centre of mass
//! ```
//!
//! Yaw is hardly excited on such flights and held in closed loop, so that `κ/I_zz` can't be identified from them: a regression
//! answers with the controller's reaction. A flat body has `I_zz ≈ I_xx + I_yy`, hence the proportion.
//!
//! They are held for every other flight of the same vehicle. The dependence of thrust on battery voltage is an assumption,
//! `T = T(c V_b / V_nominal)`, since the flights for the curve carry no voltage.

use super::rotation::{
    Axis, InertiaFit, RotationModel, SensorDelay, compare, identify_inertia, lagged_thrusts,
};
use super::signal::Segment;
use super::vehicle::{RotorNumbers, number};
use super::{FlightError, LagOn, ThrustCurve};
use crate::estimate::Fit;
use crate::recorded::{InertialLog, MotionCaptureFlight};
use crate::regression::{Row, linear};
use nalgebra::{Matrix4, Vector4};
use quad_dynamics::vehicle::{Sourced, Vehicle, VehicleFile};
use std::ops::Range;

/// Length of the bins, s: five samples of the telemetry.
const BIN_S: f64 = 0.05;
/// Slowest motion used for roll and pitch, s.
const SLOWEST_S: f64 = 1.0;
/// Lags tried, s: from faster than any brushed motor with a propeller of this size to twice the identified one.
const LAGS: Range<f64> = 0.01..0.16;
/// Rounds of the golden section: `0.618³⁰` of the range is a tenth of a microsecond.
const ROUNDS: usize = 30;
/// Thrusts, relative to hover, over which the line of levels 1 to 4 is drawn: the range that was flown.
const OPERATING_RANGE: [f64; 2] = [0.75, 1.25];

/// How an individual vehicle differs from the identified one.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Effective mass m, kg, as the inverse `[1/m]`, 1/kg.
    pub inverse_mass: Fit<1>,
    /// `I_xx` in the thrust curve's scale.
    pub roll: InertiaFit,
    /// `I_yy`, likewise.
    pub pitch: InertiaFit,
    /// Motor lag τ, s.
    pub lag_s: f64,
    /// Offsets to add to the raw commands, duty, in the order of the rotors.
    pub trim: [f64; 4],
    /// Mean battery voltage of the flight, V.
    pub voltage: f64,
    /// The curve over `c V_b / V_nominal`.
    pub curve: ThrustCurve,
    /// Nominal voltage, V.
    pub nominal_voltage: f64,
}

/// Calibrates a vehicle on a window, s, of a flight; `vehicle` gives the rotors' places and the nominal voltage.
///
/// # Errors
/// A vehicle without battery; those of the single identifications.
pub fn calibrate(
    flight: &MotionCaptureFlight,
    window: &Range<f64>,
    curve: ThrustCurve,
    vehicle: &Vehicle,
) -> Result<Calibration, FlightError> {
    let nominal_voltage = vehicle
        .require_battery("a calibration on a flight")?
        .nominal_voltage;
    let log = at_nominal_voltage(flight, nominal_voltage);
    let model = |lag_s: f64| RotationModel {
        curve,
        lag_on: LagOn::Thrust,
        lag_s,
        delay: SensorDelay::Identified,
        bin_s: BIN_S,
        slowest_s: SLOWEST_S,
    };
    let both = |lag_s: f64| -> Result<[InertiaFit; 2], FlightError> {
        let fit = |axis| identify_inertia(axis, &model(lag_s), vehicle, &log, window);
        Ok([fit(Axis::Roll)?, fit(Axis::Pitch)?])
    };
    let unexplained = |lag_s: f64| -> f64 {
        both(lag_s).map_or(f64::INFINITY, |fits| {
            fits.iter()
                .map(|fit| 1.0 - fit.goodness.r_squared.unwrap_or(0.0))
                .sum()
        })
    };
    let lag_s = golden_section(LAGS, unexplained);
    let [roll, pitch] = both(lag_s)?;
    let segment = Segment::new(&log, window, BIN_S)?;
    let thrusts = lagged_thrusts(&model(lag_s), &segment);
    let inverse_mass = inverse_mass(&log, &segment, &thrusts)?;
    let voltage = mean(
        flight
            .inertial
            .window(window.start, window.end)
            .map(|k| flight.voltage[k]),
    );
    Ok(Calibration {
        trim: trim(vehicle, &curve, &thrusts, voltage / nominal_voltage)?,
        inverse_mass,
        roll,
        pitch,
        lag_s,
        voltage,
        curve,
        nominal_voltage,
    })
}

impl Calibration {
    /// Effective mass, kg.
    pub fn mass(&self) -> crate::Estimate {
        let inverse = self.inverse_mass.parameters[0];
        inverse.mapped(1.0 / inverse.value, inverse.value.powi(-2))
    }

    /// Delay of the records behind the commands, s: mean of roll and pitch.
    pub fn delay_s(&self) -> f64 {
        0.5 * (self.roll.delay.value + self.pitch.delay.value)
    }

    /// Angular acceleration, rad/s², measured and predicted from the motors alone over a flight's window, without what is slow.
    ///
    /// # Errors
    /// A window without enough samples.
    pub fn compare(
        &self,
        axis: Axis,
        vehicle: &Vehicle,
        flight: &MotionCaptureFlight,
        window: &Range<f64>,
    ) -> Result<super::Comparison, FlightError> {
        let fit = match axis {
            Axis::Roll => &self.roll,
            Axis::Pitch => &self.pitch,
        };
        let log = at_nominal_voltage(flight, self.nominal_voltage);
        compare(axis, &fit.model, fit.inertia.value, vehicle, &log, window)
    }

    /// The vehicle file of this individual.
    ///
    /// # Errors
    /// A base without the groups of levels 4 and 5, or numbers that no vehicle has.
    pub fn vehicle_file(&self, base: &VehicleFile, source: &str) -> Result<VehicleFile, FlightError> {
        let mut file = base.clone();
        file.name = format!("{}, calibrated", base.name);
        let mass = self.mass();
        file.airframe.mass = number(mass, source);
        file.airframe.inertia.m11 = number(self.roll.inertia, source);
        file.airframe.inertia.m22 = number(self.pitch.inertia, source);
        let plane = |file: &VehicleFile| file.airframe.inertia.m11.value + file.airframe.inertia.m22.value;
        let growth = plane(&file) / plane(base);
        let inertia_zz = base.airframe.inertia.m33.value * growth;
        file.airframe.inertia.m33 = Sourced::new(inertia_zz, "in proportion to I_xx + I_yy");
        let hover = mass.value * base.environment.gravity.value / 4.0;
        let voltage_ratio = self.voltage / self.nominal_voltage;
        let command = |share: f64| (self.curve.command(share * hover) / voltage_ratio).min(1.0);
        let rotor = RotorNumbers {
            curve: self.curve,
            voltage_ratio,
            commands: command(OPERATING_RANGE[0])..=command(OPERATING_RANGE[1]),
            lag: crate::Estimate::known(self.lag_s, 0.0),
            torque_per_thrust: base.linear_rotor.torque_gain.value / base.linear_rotor.thrust_gain.value,
            zero: zero(base)?,
        };
        rotor.write(&mut file, source)?;
        Ok(file)
    }
}

/// Zero of the reaction torque of a vehicle file, rad/s.
fn zero(base: &VehicleFile) -> Result<f64, FlightError> {
    let vehicle = Vehicle::from_file(base, "base of a calibration")?;
    let dynamics = vehicle.require_rotor_dynamics("a calibration on a flight")?;
    Ok(dynamics.torque_c2 / dynamics.torque_c1)
}

/// The flight's log with commands that would give the same thrust at nominal voltage.
fn at_nominal_voltage(flight: &MotionCaptureFlight, nominal: f64) -> InertialLog {
    let mut log = flight.inertial.clone();
    for (commands, voltage) in log.commands.iter_mut().zip(&flight.voltage) {
        *commands = commands.map(|c| c * voltage / nominal);
    }
    log
}

/// `−f_z = (1/m) Σ T_i` by least squares.
fn inverse_mass(
    log: &InertialLog,
    segment: &Segment<'_>,
    thrusts: &[[f64; 4]],
) -> Result<Fit<1>, FlightError> {
    let start = segment.samples.start;
    let total = segment.means(|k| thrusts[k - start].iter().sum());
    let force = segment.means(|k| -log.specific_force[k].z);
    let rows: Vec<Row<1>> = total
        .iter()
        .zip(force)
        .map(|(&t, y)| Row { regressors: [t], y })
        .collect();
    let regressors: Vec<[f64; 1]> = rows.iter().map(|row| row.regressors).collect();
    Ok(linear(&rows)?.with_correlated_errors(&regressors))
}

/// Offsets of the commands that leave the total thrust and take away the mean moments, which a flight that ends as level as
/// it began can't have had.
fn trim(
    vehicle: &Vehicle,
    curve: &ThrustCurve,
    thrusts: &[[f64; 4]],
    voltage_ratio: f64,
) -> Result<[f64; 4], FlightError> {
    let means: [f64; 4] = std::array::from_fn(|i| mean(thrusts.iter().map(|t| t[i])));
    let hubs = vehicle.hubs();
    let effect = Matrix4::from_fn(|row, i| [1.0, -hubs[i].y, hubs[i].x, -vehicle.rotors[i].spin.sign()][row]);
    let mut wanted = -effect * Vector4::from(means);
    wanted[0] = 0.0;
    let singular = FlightError::NotPhysical {
        what: "determinant of the rotors' layout",
        value: 0.0,
    };
    let change = effect.lu().solve(&wanted).ok_or(singular)?;
    Ok(std::array::from_fn(|i| {
        let command = curve.command(means[i]);
        change[i] / (curve.slope(command) * voltage_ratio)
    }))
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for v in values {
        sum += v;
        count += 1.0;
    }
    sum / count
}

/// Minimum of a function with one valley over a range.
fn golden_section(range: Range<f64>, value: impl Fn(f64) -> f64) -> f64 {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (range.start, range.end);
    let (mut a, mut b) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut at_a, mut at_b) = (value(a), value(b));
    for _ in 0..ROUNDS {
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - ratio * (high - low);
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + ratio * (high - low);
            at_b = value(b);
        }
    }
    0.5 * (low + high)
}
