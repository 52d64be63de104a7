//! Commands are numbers wherever the vehicle is.

use super::bad_input::pid_settings;
use super::*;
use crate::{C1, C2, C3, Controller, Pid, Reference};
use nalgebra::Matrix3;
use quad_dynamics::{CommandLimits, Flight, Level3, PhenomenonSet};
use quad_kinematics::Rotation;

/// All four controllers' commands in a flight, without and with limits.
fn all_commands(vehicle: &Vehicle, flight: &Flight<f64>, reference: &Reference<f64>) -> Vec<[f64; 4]> {
    fn of<C: Controller<f64>>(c: &C, flight: &Flight<f64>, reference: &Reference<f64>) -> [f64; 4] {
        let first = c.control(&c.initial_memory(), flight, reference, 1e-3);
        // Once more, with the memory that the first call left.
        c.control(&first.memory, flight, reference, 1e-3).commands
    }
    let s = Settings::default();
    let mut c1 = C1::new(vehicle, &s).unwrap();
    let mut c2 = C2::new(vehicle, &s).unwrap();
    let mut c3 = C3::new(vehicle, &s).unwrap();
    let mut pid = Pid::new(vehicle, &pid_settings()).unwrap();
    let mut all = Vec::new();
    for limits in [None, Some(CommandLimits::of(vehicle))] {
        (c1.limits, c2.limits, c3.limits, pid.limits) = (limits, limits, limits, limits);
        all.extend([
            of(&c1, flight, reference),
            of(&c2, flight, reference),
            of(&c3, flight, reference),
            of(&pid, flight, reference),
        ]);
    }
    all
}

proptest! {
    #[test]
    fn prop_commands_are_finite_in_any_attitude(
        at in moment(Ranges { tilt: std::f64::consts::PI, rate: 1e3, share: 3.0 }),
        target in prop::array::uniform4(-1e3..1e3),
        which in 0..3_usize,
    ) {
        let vehicle = &vehicles()[which];
        let model = Level3::<f64>::build(vehicle, &PhenomenonSet::none()).unwrap();
        let flight = model.flight(&state_at(&model, vehicle, &at));
        let reference = Reference::hold(Vector3::new(target[0], target[1], target[2]), target[3]);
        for commands in all_commands(vehicle, &flight, &reference) {
            prop_assert!(commands.iter().all(|u| u.is_finite()), "{commands:?}");
        }
    }
}

#[test]
fn exact_commands_are_finite_with_the_nose_straight_up_or_down() {
    let vehicle = Vehicle::qball_x4();
    let model = Level3::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
    let mut flight = model.flight(&model.hover(Vector3::zeros(), 0.0).state);
    flight.body_rates = Vector3::new(1.0, -2.0, 3.0);
    for up in [1.0, -1.0] {
        // Exact zeros where heading and roll are read from.
        let matrix = Matrix3::new(0.0, 0.0, up, 0.0, 1.0, 0.0, -up, 0.0, 0.0);
        flight.rotation = Rotation::from_matrix(matrix);
        flight.attitude = flight.rotation.euler_angles();
        let reference = Reference::hold(Vector3::new(1.0, 2.0, 3.0), 0.5);
        for commands in all_commands(&vehicle, &flight, &reference) {
            assert!(commands.iter().all(|u| u.is_finite()), "{commands:?}");
        }
    }
}
