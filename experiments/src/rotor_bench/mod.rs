//! The rotor tests of the virtual laboratory, as the figures and tables of chapter 4 and appendix E share them.
//!
//! One campaign: static sweeps at three voltages, a sweep over the operating range at one, a pseudo-random sequence and a
//! step about hover; for the vehicle's nominal rotor and for four rotors that differ from it at random. Every test has a
//! seed of its own, so that an item shows the same readings wherever it appears.

pub(crate) mod panels;

use self::panels::Characterisation;
use crate::item::{Context, ItemError};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::derive::{SteadyRotor, rad_per_s};
use quad_rotor::MechanisticRotor;
use serde::Serialize;
use sysid::laboratory::generator;
use sysid::laboratory::thrust_stand::{
    BenchSupply, Instruments, Prbs, RotorSpread, StaticSweep, Step, ThrustStand, uniform_times,
};
use sysid::rotor_dynamics::{DynamicSample, Record};
use sysid::rotor_static::{Quantity, StaticSample, polynomial};

/// Names of the four rotors in the order of the commands, as the captions of appendix E have them.
pub(crate) const PLACES: [&str; 4] = ["rear", "front", "left", "right"];

/// Thrust at the fast end of the propeller's measurements, N; beyond, the mechanistic rotor is an extrapolation.
pub(crate) const MEASURED_THRUST: f64 = 7.84;

/// The settings of the campaign.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct RotorBench {
    vehicle: &'static str,
    /// Seed of the campaign.
    seed: u64,
    /// Lowest and highest raw duty of the static sweeps, and how many.
    static_duties: (f64, f64, usize),
    /// Voltages of the static sweeps, V.
    pub(crate) voltages_v: [f64; 3],
    /// Voltage of all other tests, V.
    pub(crate) nominal_voltage_v: f64,
    /// Readings averaged for each static point.
    readings: usize,
    /// Speeds at the ends of the operating range, rpm: those at which the propeller was measured.
    operating_rpm: (f64, f64),
    /// Points of the sweep over the operating range.
    operating_points: usize,
    /// Half the swing of sequence and step, in duty.
    amplitude: f64,
    /// Time that a bit of the sequence is held, s.
    bit_s: f64,
    /// Sampling period of the dynamic tests, s.
    period_s: f64,
    /// Duration of the sequence, s.
    sequence_s: f64,
    spread: RotorSpread,
    instruments: Instruments,
}

/// A rotor on the stand: which one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TestedRotor {
    /// 0 for the nominal rotor, 1 to 4 for the rotors of the vehicle.
    pub(crate) number: u64,
    /// The stand with this rotor.
    pub(crate) stand: ThrustStand,
}

/// The tests; their numbers keep the seeds apart.
#[derive(Clone, Copy)]
enum Test {
    Rotors = 0,
    Statics = 1,
    Operating = 2,
    Sequence = 3,
    Step = 4,
}

impl Default for RotorBench {
    fn default() -> Self {
        Self {
            vehicle: NOMINAL_VEHICLE,
            seed: 2014,
            static_duties: (0.055, 0.1, 16),
            voltages_v: [9.9, 11.1, 12.6],
            nominal_voltage_v: 11.1,
            readings: 20,
            operating_rpm: (2377.0, 6528.0),
            operating_points: 26,
            amplitude: 0.0015,
            bit_s: 0.03,
            period_s: 0.005,
            sequence_s: 10.0,
            spread: RotorSpread::default(),
            instruments: Instruments::default(),
        }
    }
}

impl RotorBench {
    pub(crate) fn vehicle(&self, context: &Context) -> Result<Vehicle, ItemError> {
        load_vehicle(context, self.vehicle)
    }

    /// The vehicle's nominal rotor.
    pub(crate) fn nominal(&self, vehicle: &Vehicle) -> Result<TestedRotor, ItemError> {
        let stand = ThrustStand {
            instruments: self.instruments,
            ..ThrustStand::of(vehicle)?
        };
        Ok(TestedRotor { number: 0, stand })
    }

    /// The vehicle's four rotors, 1 rear, 2 front, 3 left, 4 right.
    pub(crate) fn four(&self, vehicle: &Vehicle) -> Result<[TestedRotor; 4], ItemError> {
        let random = &mut generator(self.seed_of(Test::Rotors, 0));
        let stands = ThrustStand::four(vehicle, &self.spread, random)?;
        Ok(std::array::from_fn(|i| TestedRotor {
            number: i as u64 + 1,
            stand: ThrustStand {
                instruments: self.instruments,
                ..stands[i]
            },
        }))
    }

    /// The static sweep over duty and voltage.
    pub(crate) fn statics(&self, rotor: &TestedRotor) -> Result<Vec<StaticSample>, ItemError> {
        let (first, last, count) = self.static_duties;
        let sweep = StaticSweep {
            duties: evenly(first, last, count),
            supplies: self
                .voltages_v
                .map(|voltage_v| BenchSupply::Regulated { voltage_v })
                .into(),
            readings: self.readings,
        };
        let random = &mut generator(self.seed_of(Test::Statics, rotor.number));
        Ok(rotor.stand.sweep(&sweep, random)?)
    }

    /// The static sweep with the polynomials fitted to it.
    pub(crate) fn characterise(&self, rotor: &TestedRotor) -> Result<Characterisation, ItemError> {
        let samples = self.statics(rotor)?;
        let fit = |quantity| polynomial(&samples, rotor.stand.minimum_duty, quantity);
        Ok(Characterisation {
            thrust: fit(Quantity::Thrust)?,
            torque: fit(Quantity::Torque)?,
            samples,
        })
    }

    /// The sweep over the operating range at nominal voltage.
    pub(crate) fn operating(
        &self,
        vehicle: &Vehicle,
        rotor: &TestedRotor,
    ) -> Result<Vec<StaticSample>, ItemError> {
        let steady = SteadyRotor::of(vehicle)?;
        let duty = |rpm| rotor.stand.minimum_duty + steady.duty(rad_per_s(rpm), self.nominal_voltage_v);
        let sweep = StaticSweep {
            duties: evenly(
                duty(self.operating_rpm.0),
                duty(self.operating_rpm.1),
                self.operating_points,
            ),
            supplies: vec![self.supply()],
            readings: self.readings,
        };
        let random = &mut generator(self.seed_of(Test::Operating, rotor.number));
        Ok(rotor.stand.sweep(&sweep, random)?)
    }

    /// The pseudo-random sequence about the hover duty.
    pub(crate) fn sequence(
        &self,
        rotor: &TestedRotor,
        hover_duty: f64,
    ) -> Result<Vec<DynamicSample>, ItemError> {
        let sequence = Prbs {
            centre: hover_duty,
            amplitude: self.amplitude,
            hold_s: self.bit_s,
            skipped_bits: 0,
        };
        let random = &mut generator(self.seed_of(Test::Sequence, rotor.number));
        let times = uniform_times(self.period_s, self.sequence_s)?;
        Ok(rotor
            .stand
            .record(&times, sequence.signal(), self.supply(), random)?)
    }

    /// A step through the hover duty at 0.1 s.
    pub(crate) fn step(&self, rotor: &TestedRotor, hover_duty: f64) -> Result<Vec<DynamicSample>, ItemError> {
        let step = Step {
            before: hover_duty - self.amplitude,
            after: hover_duty + self.amplitude,
            at_s: 0.1,
        };
        let random = &mut generator(self.seed_of(Test::Step, rotor.number));
        let times = uniform_times(self.period_s, 0.5)?;
        Ok(rotor
            .stand
            .record(&times, |t| step.at(t), self.supply(), random)?)
    }

    fn supply(&self) -> BenchSupply {
        BenchSupply::Regulated {
            voltage_v: self.nominal_voltage_v,
        }
    }

    fn seed_of(&self, test: Test, rotor: u64) -> u64 {
        self.seed + 100 * test as u64 + rotor
    }
}

impl TestedRotor {
    /// The rotor's truth in closed form.
    pub(crate) fn truth(&self, vehicle: &Vehicle) -> Result<SteadyRotor, ItemError> {
        let MechanisticRotor { propeller, motor, .. } = self.stand.rotor;
        let mut truth = SteadyRotor::of(vehicle)?;
        truth.rotor = MechanisticRotor {
            propeller,
            motor,
            ..truth.rotor
        };
        Ok(truth)
    }

    /// The same readings without noise: what the identification would see of a perfect stand.
    pub(crate) fn noiseless(&self, samples: &[StaticSample]) -> Vec<StaticSample> {
        let truth = |s: &StaticSample| {
            let output = self.stand.steady(s.duty, s.battery_voltage_v);
            StaticSample {
                thrust_n: output.thrust,
                torque_n_m: output.torque,
                ..*s
            }
        };
        samples.iter().map(truth).collect()
    }
}

/// A record of the response to the duty.
pub(crate) fn record(samples: &[DynamicSample], quantity: Quantity) -> Result<Record, ItemError> {
    let output: fn(&DynamicSample) -> f64 = match quantity {
        Quantity::Thrust => |s| s.thrust_n,
        Quantity::Torque => |s| s.torque_n_m,
    };
    Ok(Record::of(samples, |s| s.duty, output)?)
}

/// Values evenly over a range, ends included.
fn evenly(first: f64, last: f64, count: usize) -> Vec<f64> {
    let step = (last - first) / (count - 1) as f64;
    (0..count).map(|i| first + step * i as f64).collect()
}
