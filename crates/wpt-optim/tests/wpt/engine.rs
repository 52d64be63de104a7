//! Engine and rollout agree bit for bit.

use crate::nominal;
use quad_dynamics::Level;
use sifre::black_box::MemoryBox;
use sifre::{Recording, StepSize};
use std::num::NonZeroU64;
use wpt_optim::{Choice, History, Problem};

/// Instants of the station between two that are compared: 20 ms.
const EVERY: u64 = 10;

/// A crossing north of the station that starts and ends in motion.
const NORTH: [f64; 4] = [5.0, -0.7, 3.5, 0.4];

fn fly(problem: &Problem, x: &[f64]) -> Recording {
    let mut simulation = problem.simulation(x).unwrap();
    let every = problem.mission().station_step.ns() * EVERY;
    let id = simulation
        .attach(StepSize::from_ns(every).unwrap(), MemoryBox::default())
        .unwrap();
    let report = simulation.run(problem.mission().duration_s, &mut ()).unwrap();
    assert!(report.status.is_completed());
    simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording
}

/// What the two have in common, by the engine's channels.
fn numbers(h: &History) -> [(&'static str, f64); 14] {
    [
        ("quadrotor.position.x", h.position_m[0]),
        ("quadrotor.position.y", h.position_m[1]),
        ("quadrotor.position.z", h.position_m[2]),
        ("quadrotor.velocity.y", h.velocity_m_s[1]),
        ("quadrotor.attitude.roll", h.attitude_rad[0]),
        ("quadrotor.attitude.pitch", h.attitude_rad[1]),
        ("quadrotor.attitude.yaw", h.attitude_rad[2]),
        ("quadrotor.reference.position.x", h.reference_m[0]),
        ("ets.gimbal.pan", h.gimbal_rad[0]),
        ("ets.gimbal.tilt", h.gimbal_rad[1]),
        ("ets.range", h.range_m),
        ("ets.incidence", h.incidence_rad),
        ("ets.spot.right", h.spot_m[0]),
        ("ets.spot.up", h.spot_m[1]),
    ]
}

fn assert_same_bits(problem: &Problem, x: &[f64]) {
    let recording = fly(problem, x);
    let flown = problem
        .histories(x, NonZeroU64::new(EVERY).unwrap())
        .unwrap()
        .instants;
    assert_eq!(flown.len(), recording.len());
    for (i, (name, _)) in numbers(&flown[0]).into_iter().enumerate() {
        let column = recording
            .column(name)
            .unwrap_or_else(|| panic!("no channel {name}"));
        for (instant, engine) in flown.iter().zip(column) {
            let rollout = numbers(instant)[i].1;
            let (t, level) = (instant.time_s, problem.level());
            assert!(
                rollout.to_bits() == engine.to_bits(),
                "{level}: {name} at {t} s: {rollout} and {engine}"
            );
        }
    }
}

#[test]
fn agree_engine_and_rollout() {
    for level in Level::ALL {
        assert_same_bits(&nominal(Choice::Four, 10.0, level), &NORTH);
    }
}

/// Over the station, where the bearing turns by half a turn, the target is lost and found, and commands saturate.
#[test]
fn agree_engine_and_rollout_over_the_station() {
    for level in [Level::One, Level::Three, Level::Five] {
        assert_same_bits(&nominal(Choice::Two, 10.0, level), &[4.0, -4.0]);
    }
}
