//! The controllers against their designs, against the generic inversion, and on bad input.

mod bad_input;
mod finite;
mod flights;
mod inversions;
mod lanes;
mod linear_dynamics;
mod pid;
mod sampled;

use crate::{AttitudeSettings, LoopSettings, Settings};
use nalgebra::Vector3;
use proptest::prelude::*;
use quad_dynamics::{Input, QuadrotorModel, RigidBodyState, RotorSnapshot, Snapshot, StateOf, Vehicle};
use quad_kinematics::EulerAngles;
use quad_math::Flat;
use quad_rotor::RotorOutput;

/// The three vehicles that come with the models.
pub(super) fn vehicles() -> [Vehicle; 3] {
    [
        Vehicle::qball_x4(),
        Vehicle::qball_x4_vendor(),
        Vehicle::crazyflie(),
    ]
}

/// Settings of middling speed: poles from 1.2 to 35 rad/s.
pub(super) fn settings() -> Settings {
    let with = |settling_time_s| LoopSettings {
        settling_time_s,
        damping: 1.0,
        pole_ratio: 3.0,
    };
    Settings {
        height: with(2.0),
        yaw: with(1.5),
        position: with(5.0),
        attitude: AttitudeSettings {
            frequency_ratio: 10.0,
            damping: 0.8,
            pole_ratio: 3.0,
        },
    }
}

/// A moment of flight without a vehicle: thrusts are in shares of a rotor's hover thrust.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    pub(super) body: RigidBodyState<f64>,
    pub(super) thrust_shares: [f64; 4],
}

/// Ranges of [`moment`]: tilt, rad, and body rates, rad/s; thrust shares are drawn within ±.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ranges {
    pub(super) tilt: f64,
    pub(super) rate: f64,
    pub(super) share: f64,
}

pub(super) fn moment(ranges: Ranges) -> impl Strategy<Value = Moment> {
    prop::collection::vec(-1.0..1.0, 16).prop_map(move |x: Vec<f64>| {
        let at = |i: usize| Vector3::new(x[i], x[i + 1], x[i + 2]);
        let attitude = EulerAngles::new(
            ranges.tilt * x[6],
            ranges.tilt * x[7],
            std::f64::consts::PI * x[8],
        );
        Moment {
            body: RigidBodyState {
                position: at(0) * 10.0,
                velocity: at(3) * 5.0,
                attitude: attitude.quaternion(),
                body_rates: at(9) * ranges.rate,
            },
            thrust_shares: std::array::from_fn(|i| 1.0 + ranges.share * x[12 + i]),
        }
    })
}

/// The thrusts of a moment on a vehicle, N.
pub(super) fn thrusts(vehicle: &Vehicle, moment: &Moment) -> [f64; 4] {
    moment
        .thrust_shares
        .map(|share| share * vehicle.hover_thrust_per_rotor())
}

/// A model's state at a moment of flight.
pub(super) fn state_at<M: QuadrotorModel<f64>>(
    model: &M,
    vehicle: &Vehicle,
    moment: &Moment,
) -> StateOf<f64, M> {
    let still = RotorOutput {
        thrust: 0.0,
        torque: 0.0,
    };
    let rotor = &vehicle.linear_rotor;
    let torque_per_thrust = rotor.torque_gain / rotor.thrust_gain;
    let snapshot = Snapshot {
        body: moment.body,
        rotors: thrusts(vehicle, moment).map(|thrust| RotorSnapshot {
            output: RotorOutput {
                thrust,
                torque: thrust * torque_per_thrust,
            },
            rate: still,
        }),
        charge_drawn: None,
    };
    model.adopt(&snapshot, &Input::still_air([0.0; 4]))
}

/// A state as numbers.
pub(super) fn flat<X: Flat<f64>>(state: &X) -> Vec<f64> {
    let mut numbers = vec![0.0; X::LEN];
    state.write(&mut numbers);
    numbers
}
