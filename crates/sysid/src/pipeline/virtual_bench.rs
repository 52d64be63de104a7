//! All benches of the virtual laboratory, one after the other, on one vehicle.

use super::{Measurements, SwingTest};
use crate::laboratory::flights::{FlightTest, FlightTestError};
use crate::laboratory::generator;
use crate::laboratory::pendulum::{Axis, PendulumRig, PendulumRigError};
use crate::laboratory::supports::{SupportError, SupportRig, icosahedral_cage};
use crate::laboratory::thrust_stand::{
    BenchSupply, Prbs, StandError, StaticSweep, ThrustStand, uniform_times,
};
use quad_dynamics::vehicle::derive::{SteadyRotor, rad_per_s};
use quad_dynamics::{Vehicle, VehicleError};
use quad_ndi::Settings;

/// The laboratory and how its tests are run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualLaboratory {
    /// Supports.
    pub supports: SupportRig,
    /// Pendulum.
    pub pendulum: PendulumRig,
    /// Flight.
    pub flight: FlightTest,
    /// What the controller of the flight is asked to achieve.
    pub controller: Settings,
}

/// Why a test could not be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LaboratoryError {
    /// Support test.
    #[error(transparent)]
    Supports(#[from] SupportError),
    /// Pendulum.
    #[error(transparent)]
    Pendulum(#[from] PendulumRigError),
    /// Thrust stand.
    #[error(transparent)]
    Stand(#[from] StandError),
    /// Flight.
    #[error(transparent)]
    Flight(#[from] FlightTestError),
    /// The vehicle lacks propeller, motor or battery.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
}

/// Radius of the cage that stands on the supports, m.
const CAGE_RADIUS_M: f64 = 0.35;
/// Duties of the sweep, above the bottom of the range and to its top, and voltages, V: those of the nominal parameters'
/// derivation, so that its cubic is the truth of this one.
const SWEEP_DUTIES: u32 = 51;
const SWEEP_VOLTAGES: u32 = 10;
const SWEEP_VOLTAGES_V: (f64, f64) = (9.9, 12.6);
/// Duties of the sweep over the operating range, and the range: the speeds at which the propeller was measured.
const OPERATING_DUTIES: u32 = 101;
const OPERATING_RPM: (f64, f64) = (2377.0, 6528.0);
/// Readings averaged for a point of a sweep.
const READINGS: usize = 10;
/// Amplitude of the pseudo-random duty, its bit length, s, sampling period, s, and duration, s: thrust within a tenth of hover.
const AMPLITUDE: f64 = 0.0015;
const HOLD_S: f64 = 0.03;
const PERIOD_S: f64 = 0.005;
const DURATION_S: f64 = 8.0;

impl VirtualLaboratory {
    /// The usual rigs with a controller that is asked for this.
    pub fn new(controller: Settings) -> Self {
        Self {
            supports: SupportRig::default(),
            pendulum: PendulumRig::default(),
            flight: FlightTest::default(),
            controller,
        }
    }

    /// Runs every test on a vehicle. The same seed gives the same measurements; each test has a generator of its own, so that
    /// a change of one leaves the others as they are.
    ///
    /// # Errors
    /// A vehicle that lacks groups, or that a rig can't take.
    pub fn measure(&self, vehicle: &Vehicle, seed: u64) -> Result<Measurements, LaboratoryError> {
        // Any odd multiplier keeps the streams of different seeds apart.
        let stream = |test: u64| generator(seed.wrapping_mul(16).wrapping_add(test));
        let cage = icosahedral_cage(CAGE_RADIUS_M);
        let placings = self
            .supports
            .measure(vehicle, &[cage[0], cage[4], cage[8]], &mut stream(0))?;
        let swing = |axis: Axis, test: u64| -> Result<SwingTest, PendulumRigError> {
            Ok(SwingTest {
                suspension: self.pendulum.suspension(vehicle),
                samples: self.pendulum.swing(vehicle, axis, &mut stream(test))?,
            })
        };
        let stand = ThrustStand::of(vehicle)?;
        let steady = SteadyRotor::of(vehicle)?;
        let nominal_v = vehicle.require_battery("the virtual laboratory")?.nominal_voltage;
        let regulated = |voltage_v| BenchSupply::Regulated { voltage_v };
        let pwm = &vehicle.pwm;
        let sweep = StaticSweep {
            duties: evenly(pwm.minimum, pwm.maximum, SWEEP_DUTIES),
            supplies: evenly(SWEEP_VOLTAGES_V.0, SWEEP_VOLTAGES_V.1, SWEEP_VOLTAGES)
                .into_iter()
                .map(regulated)
                .collect(),
            readings: READINGS,
        };
        let duty_at = |rpm| pwm.minimum + steady.duty(rad_per_s(rpm), nominal_v);
        let operating = StaticSweep {
            duties: evenly(
                duty_at(OPERATING_RPM.0),
                duty_at(OPERATING_RPM.1),
                OPERATING_DUTIES,
            ),
            supplies: vec![regulated(nominal_v)],
            readings: READINGS,
        };
        let hover = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
        let signal = Prbs {
            centre: pwm.minimum + steady.duty(hover, nominal_v),
            amplitude: AMPLITUDE,
            hold_s: HOLD_S,
            skipped_bits: 0,
        };
        Ok(Measurements {
            placings,
            swings: [
                swing(Axis::Roll, 1)?,
                swing(Axis::Pitch, 2)?,
                swing(Axis::Yaw, 3)?,
            ],
            sweep: stand.sweep(&sweep, &mut stream(4))?,
            operating: stand.sweep(&operating, &mut stream(5))?,
            dynamic: stand.record(
                &uniform_times(PERIOD_S, DURATION_S)?,
                signal.signal(),
                regulated(nominal_v),
                &mut stream(6),
            )?,
            flight: self.flight.fly(vehicle, &self.controller, &mut stream(7))?,
        })
    }
}

fn evenly(start: f64, end: f64, count: u32) -> Vec<f64> {
    let step = (end - start) / f64::from(count - 1);
    (0..count).map(|i| start + step * f64::from(i)).collect()
}
