//! The whole identification of a Crazyflie from three flights, and its result as a vehicle file.

use super::rotation::InertiaFit;
use super::thrust::ThrustFit;
use super::together::{Window, identify_thrust_and_inertia};
use super::yaw::{YawFit, identify_yaw};
use super::{FlightError, ThrustCurve};
use crate::estimate::Estimate;
use crate::recorded::InertialLog;
use crate::regression::{Row, linear};
use crate::validation::Agreement;
use quad_dynamics::vehicle::derive::fit_cubic;
use quad_dynamics::vehicle::{PolynomialRotorParameters, Sourced, Vehicle, VehicleFile};
use quad_rotor::RotorDynamics;
use std::ops::{Range, RangeInclusive};

/// Points of a curve that lines and cubics are drawn through.
const CURVE_POINTS: u32 = 101;
/// Duties over which the cubic of level 5 is fitted, the range of the crazyflie's own file.
const CUBIC_DUTIES: RangeInclusive<f64> = 0.3..=1.0;

/// A flight, the part to fit on and the part that is kept for validation, s.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    /// The flight.
    pub log: &'a InertialLog,
    /// Window to fit on.
    pub fit: Range<f64>,
    /// Window that the fit does not see.
    pub rest: Range<f64>,
}

impl<'a> Part<'a> {
    fn window(&self) -> Window<'a> {
        Window {
            log: self.log,
            span: self.fit.clone(),
        }
    }
}

/// Three flights for an identification.
#[derive(Clone, Debug)]
pub struct FlightTests<'a> {
    /// Mass of the vehicle, kg.
    pub mass: f64,
    /// A flight up and down.
    pub thrust: Part<'a>,
    /// A flight that rolls and pitches.
    pub roll_pitch: Part<'a>,
    /// A flight that yaws.
    pub yaw: Part<'a>,
}

/// What the flights tell, with lag on the thrust and one delay δ of the inertial unit's filters for all axes.
#[derive(Clone, Debug, PartialEq)]
pub struct CrazyflieIdentification {
    /// Thrust curve and lag.
    pub thrust: ThrustFit,
    /// `I_xx`, with the errors of thrust curve and lag.
    pub roll: InertiaFit,
    /// `I_yy`, with the errors of thrust curve and lag.
    pub pitch: InertiaFit,
    /// `κ/I_zz` and the zero of the yaw torque.
    pub yaw: YawFit,
}

/// Agreement on parts of flights that an identification did not see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unseen {
    /// Of the total thrust.
    pub thrust: Agreement,
    /// Of the roll acceleration.
    pub roll: Agreement,
    /// Of the pitch acceleration.
    pub pitch: Agreement,
    /// Of the yaw acceleration.
    pub yaw: Agreement,
}

/// Identifies thrust, roll, pitch and yaw; `vehicle` gives the rotors' places and spins, nothing else.
///
/// # Errors
/// Those of the single identifications.
pub fn identify_crazyflie(
    tests: &FlightTests<'_>,
    vehicle: &Vehicle,
) -> Result<CrazyflieIdentification, FlightError> {
    let (up_down, moved) = (tests.thrust.window(), tests.roll_pitch.window());
    let found = identify_thrust_and_inertia(&up_down, &moved, tests.mass, vehicle)?
        .with_thrust_errors(vehicle, &moved)?;
    let yaw = identify_yaw(&found.rotation_model(), vehicle, tests.yaw.log, &tests.yaw.fit)?;
    Ok(CrazyflieIdentification {
        thrust: found.thrust,
        roll: found.roll,
        pitch: found.pitch,
        yaw,
    })
}

impl CrazyflieIdentification {
    /// How well thrust, angular accelerations without what is slow, and yaw acceleration are predicted on the parts that were
    /// kept back.
    ///
    /// # Errors
    /// Parts without enough samples, or with constant commands.
    pub fn validate(&self, tests: &FlightTests<'_>, vehicle: &Vehicle) -> Result<Unseen, FlightError> {
        let (up_down, moved, turned) = (&tests.thrust, &tests.roll_pitch, &tests.yaw);
        Ok(Unseen {
            thrust: self.thrust.compare(up_down.log, &up_down.rest)?.agreement()?,
            roll: self.roll.compare(vehicle, moved.log, &moved.rest)?.agreement()?,
            pitch: self.pitch.compare(vehicle, moved.log, &moved.rest)?.agreement()?,
            yaw: self.yaw.compare(vehicle, turned.log, &turned.rest)?.agreement()?,
        })
    }

    /// The common delay δ of the inertial unit, s.
    pub fn delay_s(&self) -> f64 {
        0.5 * (self.roll.delay.value + self.pitch.delay.value)
    }
}

/// A vehicle file with the identified numbers in place of the base's; what was not identified stays the base's.
///
/// `I_zz` stays the base's, and the torque per thrust follows from the identified `κ/I_zz`.
///
/// # Errors
/// A base without the groups of levels 4 and 5.
pub fn vehicle_file(
    identified: &CrazyflieIdentification,
    base: &VehicleFile,
    source: &str,
) -> Result<VehicleFile, FlightError> {
    let mut file = base.clone();
    file.name = format!("{}, identified", base.name);
    let mass = identified.thrust.settings.mass;
    file.airframe.mass = Sourced::new(mass, source);
    file.airframe.inertia.m11 = number(identified.roll.inertia, source);
    file.airframe.inertia.m22 = number(identified.pitch.inertia, source);
    let torque_per_thrust = identified.yaw.ratio().value * base.airframe.inertia.m33.value;
    let hover = mass * base.environment.gravity.value / 4.0;
    let curve = identified.thrust.curve();
    let rotor = RotorNumbers {
        curve,
        voltage_ratio: 1.0,
        commands: curve.command(0.5 * hover)..=curve.command(1.5 * hover).min(1.0),
        lag: identified.thrust.lag(),
        torque_per_thrust,
        zero: identified.yaw.zero().value,
    };
    rotor.write(&mut file, source)?;
    Ok(file)
}

/// What a vehicle file says of its rotors.
pub(super) struct RotorNumbers {
    /// Thrust curve over the duty at nominal voltage.
    pub(super) curve: ThrustCurve,
    /// Voltage of the flight over the nominal one, for the levels that don't see the voltage.
    pub(super) voltage_ratio: f64,
    /// Commands over which the line of levels 1 to 4 is drawn.
    pub(super) commands: RangeInclusive<f64>,
    /// Motor lag, s.
    pub(super) lag: Estimate,
    /// Reaction torque per thrust κ, m.
    pub(super) torque_per_thrust: f64,
    /// Zero of the reaction torque, rad/s.
    pub(super) zero: f64,
}

impl RotorNumbers {
    pub(super) fn write(&self, file: &mut VehicleFile, source: &str) -> Result<(), FlightError> {
        let base = Vehicle::from_file(file, "base of an identification")?;
        let needed_by = "a replay at levels 4 and 5";
        let nominal = base.require_battery(needed_by)?.nominal_voltage;
        let controller_lag = base.require_motor(needed_by)?.controller_lag;
        let number = |value: f64| Sourced::new(value, source);
        let [intercept, gain] = self.line()?;
        file.pwm.zero_thrust = number(-intercept / gain);
        file.linear_rotor.thrust_gain = number(gain);
        file.linear_rotor.torque_gain = number(gain * self.torque_per_thrust);
        let bandwidth = self.lag.mapped(1.0 / self.lag.value, self.lag.value.powi(-2));
        file.linear_rotor.bandwidth = self::number(bandwidth, source);
        let (slow, fast) = (1.0 / self.lag.value, 1.0 / controller_lag);
        file.rotor_dynamics = Some(RotorDynamics {
            thrust_c1: number(slow + fast),
            thrust_c2: number(slow * fast),
            torque_c1: number(slow * fast / self.zero),
            torque_c2: number(slow * fast),
            torque_c3: number(slow + fast),
            torque_c4: number(slow * fast),
        });
        let points = evenly(&CUBIC_DUTIES).map(|duty| (duty * nominal, self.curve.thrust(duty)));
        let thrust = fit_cubic(points)?;
        let torque = thrust.scaled(self.torque_per_thrust);
        file.polynomial_rotor = Some(PolynomialRotorParameters {
            thrust: thrust.map(number),
            torque: torque.map(number),
        });
        Ok(())
    }

    /// Least-squares line `[intercept, gain]` through the curve over the commands.
    fn line(&self) -> Result<[f64; 2], FlightError> {
        let rows: Vec<Row<2>> = evenly(&self.commands)
            .map(|c| Row {
                regressors: [1.0, c],
                y: self.curve.thrust(c * self.voltage_ratio),
            })
            .collect();
        Ok(linear(&rows)?.values())
    }
}

fn evenly(range: &RangeInclusive<f64>) -> impl Iterator<Item = f64> + Clone + use<> {
    let (start, end) = (*range.start(), *range.end());
    (0..CURVE_POINTS).map(move |k| start + (end - start) * f64::from(k) / f64::from(CURVE_POINTS - 1))
}

/// An estimate as a number of a vehicle file.
pub(super) fn number(estimate: Estimate, source: &str) -> Sourced<f64> {
    Sourced {
        standard_error: Some(estimate.standard_error),
        ..Sourced::new(estimate.value, source)
    }
}

/// The Crazyflie's file.
#[cfg(test)]
pub(super) fn base() -> VehicleFile {
    VehicleFile::parse(quad_dynamics::vehicle::builtin::CRAZYFLIE_TOML, "crazyflie.toml").unwrap()
}
