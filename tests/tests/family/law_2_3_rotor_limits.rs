//! Laws 2 and 3: with ever faster rotors level 3 tends to level 2, and level 4 to level 3, each at first
//! order in the time constant that vanishes.

use crate::support::{fly, outputs};
use family_tests::vehicle;
use nalgebra::{SVector, Vector3};
use proptest::prelude::*;
use quad_dynamics::{Input, Level2, Level3, Level4, Phenomenon, PhenomenonSet, QuadrotorModel, Vehicle};

/// Rates that the vanishing time constant is the inverse of, rad/s: two octaves.
const RATES: [f64; 3] = [800.0, 1600.0, 3200.0];

/// Length of the flight, s, and its steps: `h · rate` is 0.5 at most, so that RK4 follows the fast mode to
/// `0.5⁵/120` of its amplitude, a fortieth of a percent.
const FLIGHT: (f64, u32) = (0.3, 1920);

/// A pulse that differs from rotor to rotor, as shares of the hover command.
fn pulse() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(0.05..0.15_f64)
}

/// Where a flight from hover under a step of the commands ends.
fn end<M: QuadrotorModel<f64>>(vehicle: &Vehicle, on: &PhenomenonSet, pulse: &[f64; 4]) -> SVector<f64, 18> {
    let model = M::build(vehicle, on).unwrap();
    let hover = model.hover(Vector3::zeros(), 0.3);
    let commands = std::array::from_fn(|i| hover.input.commands[i] * (1.0 + pulse[i]));
    let state = fly(
        &model,
        hover.state,
        &Input::still_air(commands),
        FLIGHT.0,
        FLIGHT.1,
    );
    outputs(&model.flight(&state))
}

/// Orders at which the errors fall with the doubling rates.
fn orders(errors: [f64; 3]) -> [f64; 2] {
    [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()]
}

fn drag_and_gyroscopic_torque() -> PhenomenonSet {
    [Phenomenon::Drag, Phenomenon::GyroscopicTorque]
        .into_iter()
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn agree_level_3_tends_to_level_2(vehicle in vehicle(), pulse in pulse(), full in any::<bool>()) {
        let on = if full { drag_and_gyroscopic_torque() } else { PhenomenonSet::none() };
        let limit = end::<Level2<f64>>(&vehicle, &on, &pulse);
        let errors = RATES.map(|rate| {
            let mut fast = vehicle.clone();
            fast.linear_rotor.bandwidth = rate;
            (end::<Level3<f64>>(&fast, &on, &pulse) - limit).norm()
        });
        // The second-order term is smaller than the first by 1/(rate · time), a third of a percent, times a
        // factor of order one.
        for order in orders(errors) {
            prop_assert!((order - 1.0).abs() < 0.05, "order {order}, errors {errors:?}");
        }
    }

    #[test]
    fn agree_level_4_tends_to_level_3(vehicle in vehicle(), pulse in pulse()) {
        let none = PhenomenonSet::none();
        let limit = end::<Level3<f64>>(&vehicle, &none, &pulse);
        let w = vehicle.linear_rotor.bandwidth;
        let errors = RATES.map(|pole| {
            let mut fast = vehicle.clone();
            let d = fast.rotor_dynamics.as_mut().unwrap();
            (d.thrust_c1, d.thrust_c2) = (w + pole, w * pole);
            (d.torque_c3, d.torque_c4, d.torque_c2) = (w + pole, w * pole, w * pole);
            // The zero goes to infinity twice as fast: at the pole itself it would cancel it exactly.
            d.torque_c1 = d.torque_c2 / (2.0 * pole);
            (end::<Level4<f64>>(&fast, &none, &pulse) - limit).norm()
        });
        // Relative size of the second-order term: ω_R over the pole, at most 60/800, times a factor of order
        // one.
        for order in orders(errors) {
            prop_assert!((order - 1.0).abs() < 0.1, "order {order}, errors {errors:?}");
        }
    }
}
