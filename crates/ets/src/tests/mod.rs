//! Tests by oracle, one module per part.

mod battery;
mod camera;
mod clock;
mod gimbal;
mod image;
mod light;
mod loss;
mod power;
mod receiver;
mod tracker;

use crate::{Camera, Ets, EtsInput, EtsState, FrameClock, Gimbal, GimbalAxis, Pedestal, Station};
use nalgebra::{Vector2, Vector3};

/// A gimbal without limits worth the name: the designed dynamics show unclipped.
fn free_gimbal() -> Gimbal<f64> {
    let axis = GimbalAxis {
        time_constant: 0.05,
        rate_limit: 1e6,
        minimum: -1e6,
        maximum: 1e6,
    };
    Gimbal {
        pan: axis,
        tilt: axis,
    }
}

fn pedestal() -> Pedestal<f64> {
    Pedestal {
        position: [1.0, -2.0, -0.5],
        heading: 0.7,
    }
}

fn camera() -> Camera<f64> {
    Station::nominal().camera
}

fn nominal() -> (Station, Ets<f64>, FrameClock) {
    let station = Station::nominal();
    let clock = FrameClock::new(1e-3, station.frames.rate, station.frames.latency).unwrap();
    let ets = Ets::new(&station);
    (station, ets, clock)
}

/// Runs a station after a target that moves as `target(t)`; calls `each` with time and state after every step.
fn run(
    ets: &Ets<f64>,
    clock: &FrameClock,
    mut state: EtsState<f64>,
    steps: u64,
    target: impl Fn(f64) -> Vector3<f64>,
    mut each: impl FnMut(f64, &EtsState<f64>),
) -> EtsState<f64> {
    for n in 0..steps {
        let input = EtsInput {
            target: target(n as f64 * clock.step_s()),
            noise: Vector2::zeros(),
        };
        state = ets.step(clock, n, &state, &input);
        each((n + 1) as f64 * clock.step_s(), &state);
    }
    state
}
