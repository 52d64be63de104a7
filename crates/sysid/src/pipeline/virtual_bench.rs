//! All benches of the virtual laboratory, one after the other, on one vehicle.

use super::{CellTest, DynamicReading, Measurements, StaticReading, SwingTest};
use crate::laboratory::flights::{FlightTest, FlightTestError};
use crate::laboratory::load_cells::{Channel, LoadCell, LoadCellRigError};
use crate::laboratory::pendulum::{Axis, PendulumRig, PendulumRigError};
use crate::laboratory::supports::{SupportError, SupportRig, icosahedral_cage};
use crate::laboratory::thrust_stand::{
    BenchSupply, Instruments, Prbs, StandError, StaticSweep, ThrustStand, uniform_times,
};
use crate::laboratory::{Generator, Sensor, generator};
use crate::rotor_dynamics::DynamicSample;
use crate::rotor_static::StaticSample;
use quad_dynamics::vehicle::derive::{SteadyRotor, rad_per_s};
use quad_dynamics::{Vehicle, VehicleError};
use quad_ndi::Settings;
use rand::RngExt;

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
    /// Load cells.
    #[error(transparent)]
    LoadCells(#[from] LoadCellRigError),
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
/// Readings of a setting of a sweep, one after the other.
const READINGS: usize = 10;
/// Equal loads from none to a cell's capacity, up and down, and readings of each on either way.
const CELL_STEPS: u32 = 10;
const CELL_READINGS: u32 = 5;
/// Amplitude of the pseudo-random duty, its bit length, s, and sampling period, s: thrust within a tenth of hover.
const AMPLITUDE: f64 = 0.0015;
const HOLD_S: f64 = 0.03;
const PERIOD_S: f64 = 0.005;
/// Bits of the first half of the record; the second half has the same ones inverted, so that the mean duty is hover's and what
/// is even in the excitation drops out. Source: Godfrey, *Perturbation Signals for System Identification*, 1993 (inverse-repeat
/// sequences).
const HALF_BITS: u32 = 133;

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
        let stand = Stand::of(vehicle, &mut stream(10))?;
        let steady = SteadyRotor::of(vehicle)?;
        let nominal_v = vehicle.require_battery("the virtual laboratory")?.nominal_voltage;
        let regulated = |voltage_v| BenchSupply::Regulated { voltage_v };
        let pwm = &vehicle.pwm;
        let sweep = StaticSweep {
            duties: repeated(evenly(pwm.minimum, pwm.maximum, SWEEP_DUTIES)),
            supplies: evenly(SWEEP_VOLTAGES_V.0, SWEEP_VOLTAGES_V.1, SWEEP_VOLTAGES)
                .into_iter()
                .map(regulated)
                .collect(),
            readings: 1,
        };
        let duty_at = |rpm| pwm.minimum + steady.duty(rad_per_s(rpm), nominal_v);
        let operating = StaticSweep {
            duties: repeated(middles(
                duty_at(OPERATING_RPM.0),
                duty_at(OPERATING_RPM.1),
                OPERATING_DUTIES,
            )),
            supplies: vec![regulated(nominal_v)],
            readings: 1,
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
            thrust_cell: stand.thrust_cell.calibrate(&mut stream(8))?,
            torque_cell: stand.torque_cell.calibrate(&mut stream(9))?,
            sweep: stand.sweep(&sweep, &mut stream(4))?,
            operating: stand.sweep(&operating, &mut stream(5))?,
            dynamic: stand.record(&signal, regulated(nominal_v), &mut stream(6))?,
            flight: self.flight.fly(vehicle, &self.controller, &mut stream(7))?,
        })
    }
}

/// The thrust stand with its load cells.
struct Stand {
    /// Rotor, supply, tachometer and voltmeter; thrust and torque as the cells feel them, shaken by the running rotor.
    stand: ThrustStand,
    thrust_cell: Cell,
    torque_cell: Cell,
}

/// One cell of its kind: its departure from a straight line lies anywhere within what the data sheet allows.
struct Cell {
    cell: LoadCell,
    /// The data sheet's limit.
    non_linearity: f64,
}

impl Cell {
    fn one_of(kind: LoadCell, generator: &mut Generator) -> Self {
        Self {
            cell: LoadCell {
                non_linearity: kind.non_linearity * generator.random_range(-1.0..1.0),
                ..kind
            },
            non_linearity: kind.non_linearity,
        }
    }

    fn calibrate(&self, generator: &mut Generator) -> Result<CellTest, LoadCellRigError> {
        Ok(CellTest {
            capacity: self.cell.capacity,
            non_linearity: self.non_linearity,
            samples: self.cell.calibrate(CELL_STEPS, CELL_READINGS, generator)?,
        })
    }

    fn read(&self, load: f64, generator: &mut Generator) -> f64 {
        self.cell.read(load, generator)
    }
}

impl Stand {
    fn of(vehicle: &Vehicle, generator: &mut Generator) -> Result<Self, StandError> {
        let usual = Instruments::default();
        let mut stand = ThrustStand::of(vehicle)?;
        // The stand's usual noise is that of the running rotor; digits and limits are the cells'.
        stand.instruments.thrust = Sensor::noisy(usual.thrust.noise);
        stand.instruments.torque = Sensor::noisy(usual.torque.noise);
        Ok(Self {
            stand,
            thrust_cell: Cell::one_of(LoadCell::of(vehicle, Channel::Thrust), generator),
            torque_cell: Cell::one_of(LoadCell::of(vehicle, Channel::TorqueClockwise), generator),
        })
    }

    fn sweep(
        &self,
        sweep: &StaticSweep,
        generator: &mut Generator,
    ) -> Result<Vec<StaticReading>, StandError> {
        let felt = self.stand.sweep(sweep, generator)?;
        let mut reading = |s: &StaticSample| StaticReading {
            duty: s.duty,
            battery_voltage_v: s.battery_voltage_v,
            thrust_cell_v: self.thrust_cell.read(s.thrust_n, generator),
            torque_cell_v: self.torque_cell.read(s.torque_n_m, generator),
            speed_rad_s: s.speed_rad_s,
        };
        Ok(felt.iter().map(&mut reading).collect())
    }

    fn record(
        &self,
        signal: &Prbs,
        supply: BenchSupply,
        generator: &mut Generator,
    ) -> Result<Vec<DynamicReading>, StandError> {
        let half_s = f64::from(HALF_BITS) * HOLD_S;
        let bits = signal.signal();
        let centre = signal.centre;
        let duty = |time_s: f64| {
            // As in the sequence itself: a sample at the turn must not depend on rounding.
            if time_s < half_s - 1e-9 {
                bits(time_s)
            } else {
                2.0 * centre - bits(time_s - half_s)
            }
        };
        let times = uniform_times(PERIOD_S, 2.0 * half_s - PERIOD_S)?;
        let felt = self.stand.record(&times, duty, supply, generator)?;
        let mut reading = |s: &DynamicSample| DynamicReading {
            time_s: s.time_s,
            duty: s.duty,
            battery_voltage_v: s.battery_voltage_v,
            thrust_cell_v: self.thrust_cell.read(s.thrust_n, generator),
            torque_cell_v: self.torque_cell.read(s.torque_n_m, generator),
            speed_rad_s: s.speed_rad_s,
        };
        Ok(felt.iter().map(&mut reading).collect())
    }
}

/// Each duty as often as it is read.
fn repeated(duties: Vec<f64>) -> Vec<f64> {
    let read = |duty| std::iter::repeat_n(duty, READINGS);
    duties.into_iter().flat_map(read).collect()
}

/// Middles of equal parts of a range. A line through them misses as the line through the whole range does, to `1/n²` of what
/// it misses; points from end to end weigh the ends by `1/n` too much.
fn middles(start: f64, end: f64, count: u32) -> Vec<f64> {
    let part = (end - start) / f64::from(count);
    (0..count).map(|i| start + part * (f64::from(i) + 0.5)).collect()
}

fn evenly(start: f64, end: f64, count: u32) -> Vec<f64> {
    let step = (end - start) / f64::from(count - 1);
    (0..count).map(|i| start + step * f64::from(i)).collect()
}
