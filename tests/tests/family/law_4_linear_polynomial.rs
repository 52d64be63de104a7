//! Law 4: level 5 with a linear polynomial, constant voltage and no limits is level 4.

use crate::support::{fly, outputs, worst_over};
use family_tests::{FamilyFour, draw, flat, phenomena, vehicle, without_offset};
use proptest::prelude::*;
use quad_dynamics::{Level4, Level5, QuadrotorModel, QuadrotorState, StateOf, Vehicle};
use quad_math::System;
use quad_rotor::{BatteryState, Cubic};

/// A vehicle whose polynomial is the line of its linear rotor: `k_1 x = (K_T / V_b) · u V_b`.
fn with_linear_polynomial() -> impl Strategy<Value = Vehicle> {
    vehicle().prop_map(without_offset).prop_map(|mut vehicle| {
        let voltage = vehicle.battery.as_ref().unwrap().nominal_voltage;
        let gains = vehicle.linear_rotor;
        let polynomial = vehicle.polynomial_rotor.as_mut().unwrap();
        let line = |k1| Cubic { k1, k2: 0.0, k3: 0.0 };
        polynomial.thrust = line(gains.thrust_gain / voltage);
        polynomial.torque = line(gains.torque_gain / voltage);
        vehicle
    })
}

/// The same body and rotors on the battery of level 5.
fn at_level_5(state: &StateOf<f64, Level4<f64>>) -> StateOf<f64, Level5<f64>> {
    QuadrotorState {
        body: state.body,
        rotors: state.rotors,
        supply: BatteryState { charge_drawn: 0.0 },
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn exact_level_5_on_a_line_is_level_4(
        draw in draw(with_linear_polynomial()),
        on in phenomena::<FamilyFour>().prop_map(|set| set.without(quad_dynamics::Phenomenon::InputLimits)),
    ) {
        let four = Level4::<f64>::build(&draw.vehicle, &on).unwrap();
        let five = Level5::<f64>::build(&draw.vehicle, &on).unwrap();
        let state = four.adopt(&draw.snapshot, &draw.input);
        let rates = flat(&four.derivative(&state, &draw.input));
        let rates_5 = flat(&five.derivative(&at_level_5(&state), &draw.input));
        // Three roundings of the steady thrust and torque, weighted with c_T2, c_Q1 or c_Q2 in the rotors' rates.
        let d = draw.vehicle.rotor_dynamics.unwrap();
        let gains = &draw.vehicle.linear_rotor;
        let weight = (d.thrust_c2 * gains.thrust_gain).max((d.torque_c1 + d.torque_c2) * gains.torque_gain);
        let worst = worst_over(&rates, &rates_5[..rates.len()], |i| {
            if i < 13 { f64::MIN_POSITIVE } else { 4.0 * f64::EPSILON * weight }
        });
        prop_assert!(worst <= 1.0, "{worst}");
        prop_assert_eq!(rates_5[rates.len()], 0.0);

        let later = fly(&four, state, &draw.input, 0.2, 200);
        let later_5 = fly(&five, at_level_5(&state), &draw.input, 0.2, 200);
        let (end, end_5) = (outputs(&four.flight(&later)), outputs(&five.flight(&later_5)));
        // Rounding at the start, carried through a fifth of a second in which it may grow a hundredfold.
        prop_assert!((end - end_5).amax() < 1e-11 * end.amax().max(1.0));
    }

    /// Both hold hover with the same commands.
    #[test]
    fn exact_hover_on_a_line_is_that_of_level_4(vehicle in with_linear_polynomial()) {
        let none = quad_dynamics::PhenomenonSet::none();
        let four = Level4::<f64>::build(&vehicle, &none).unwrap();
        let five = Level5::<f64>::build(&vehicle, &none).unwrap();
        let commands = |input: quad_dynamics::Input<f64>| input.commands;
        let u4 = commands(four.hover(nalgebra::Vector3::zeros(), 0.0).input);
        let u5 = commands(five.hover(nalgebra::Vector3::zeros(), 0.0).input);
        // A dozen roundings, and the secant's last step on the yaw balance.
        prop_assert!(worst_over(&u4, &u5, |i| 1e-13 * u4[i].abs()) <= 1.0, "{u4:?} {u5:?}");
    }
}
