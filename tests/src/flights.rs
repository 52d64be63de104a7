//! Random moments of a flight: a snapshot that any level adopts, and an input.

use nalgebra::Vector3;
use proptest::prelude::*;
use quad_dynamics::{Input, RigidBodyState, RotorSnapshot, Snapshot, Vehicle};
use quad_kinematics::EulerAngles;
use quad_rotor::RotorOutput;

/// A vehicle, a moment of its flight and what drives it.
#[derive(Clone, Debug)]
pub struct Draw {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// The moment, in terms that every level adopts.
    pub snapshot: Snapshot<f64>,
    /// Commands inside the PWM range, wind, and rotation of the air.
    pub input: Input<f64>,
}

/// A vector with components between `−size` and `size`.
pub fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

/// Attitudes that keep ten degrees away from the singularity of the Euler angles.
pub fn attitude() -> impl Strategy<Value = EulerAngles<f64>> {
    (-3.1..3.1, -1.4..1.4, -3.1..3.1).prop_map(|(r, p, y)| EulerAngles::new(r, p, y))
}

/// A component of air speed, m/s, away from zero, where drag has its kink.
fn air_speed() -> impl Strategy<Value = f64> {
    (0.2..6.0_f64, any::<bool>()).prop_map(|(speed, back)| if back { -speed } else { speed })
}

/// A rigid body in fast flight, in wind (W, m/s), that leaves no component of the air speed near zero.
pub fn body() -> impl Strategy<Value = (RigidBodyState<f64>, Vector3<f64>)> {
    let air = [air_speed(), air_speed(), air_speed()].prop_map(Vector3::from);
    (vector(20.0), air, attitude(), vector(5.0), vector(5.0)).prop_map(
        |(position, air_velocity, attitude, body_rates, wind)| {
            let attitude = attitude.quaternion();
            let state = RigidBodyState {
                position,
                velocity: air_velocity + attitude.conjugate().rotate(&wind),
                attitude,
                body_rates,
            };
            (state, wind)
        },
    )
}

/// What one rotor does, as shares of its range: thrust, torque, their rates, and the command.
type Shares = (f64, f64, f64, f64, f64);

fn rotor() -> impl Strategy<Value = Shares> {
    (
        0.1..0.9_f64,
        0.1..0.9_f64,
        -2.0..2.0_f64,
        -2.0..2.0_f64,
        0.05..0.95_f64,
    )
}

/// Any moment of any flight of a vehicle from the strategy; commands, thrusts and torques are positive and
/// inside the limits, so that no kink is near.
pub fn draw(vehicle: impl Strategy<Value = Vehicle>) -> impl Strategy<Value = Draw> {
    let rotors = prop::array::uniform4(rotor());
    (vehicle, body(), rotors, 0.0..0.5_f64, vector(0.5)).prop_map(
        |(vehicle, (body, wind), shares, discharge, air_rates)| {
            let high = *vehicle.zeroed_range().end();
            let gains = &vehicle.linear_rotor;
            let (thrust, torque) = (gains.thrust_gain * high, gains.torque_gain * high);
            let rotors = shares.map(|(t, q, t_rate, q_rate, _)| RotorSnapshot {
                output: RotorOutput {
                    thrust: t * thrust,
                    torque: q * torque,
                },
                rate: RotorOutput {
                    thrust: t_rate * thrust,
                    torque: q_rate * torque,
                },
            });
            let capacity = vehicle.battery.as_ref().map_or(0.0, |b| b.capacity);
            Draw {
                snapshot: Snapshot {
                    body,
                    rotors,
                    charge_drawn: Some(discharge * capacity),
                },
                input: Input {
                    commands: shares.map(|(.., u)| u * high),
                    wind,
                    air_rates,
                },
                vehicle,
            }
        },
    )
}
