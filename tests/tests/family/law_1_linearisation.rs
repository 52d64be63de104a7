//! Law 1: level 2 at hover linearises to level 1, and both to the matrices of chapter 3.3.3.

use approx::assert_relative_eq;
use family_tests::{flat, from_flat, vehicle};
use nalgebra::{Matrix3, SMatrix, Vector3};
use num_dual::HyperDual64;
use proptest::prelude::*;
use quad_dynamics::{
    Input, Level1, Level2, LinearState, PhenomenonSet, QuadrotorModel, QuadrotorState, Vehicle,
};
use quad_math::{Dual, Flat, System, constant, jacobian};

type A = SMatrix<f64, 12, 12>;
type B = SMatrix<f64, 12, 4>;

/// Linear model `ẋ = A δx + B δu` in the state of level 1.
struct Linear {
    a: A,
    b: B,
}

/// The matrices by hand, chapter 3.3.3: what each line says is in the head of `level1.rs`.
fn by_hand(vehicle: &Vehicle, yaw: f64) -> Linear {
    let (g, (s, c)) = (vehicle.environment.gravity, yaw.sin_cos());
    let identity = Matrix3::<f64>::identity();
    let mut a = A::zeros();
    a.fixed_view_mut::<3, 3>(0, 3).copy_from(&identity);
    a.fixed_view_mut::<3, 3>(6, 9).copy_from(&identity);
    let tilt = Matrix3::new(-g * s, -g * c, 0.0, g * c, -g * s, 0.0, 0.0, 0.0, 0.0);
    a.fixed_view_mut::<3, 3>(3, 6).copy_from(&tilt);
    let gains = &vehicle.linear_rotor;
    let (arm, control) = (vehicle.airframe.arm_length, vehicle.control_matrix());
    let roll_pitch = arm * gains.thrust_gain;
    let moments = Matrix3::from_diagonal(&Vector3::new(roll_pitch, roll_pitch, gains.torque_gain));
    let inverse = vehicle.airframe.inertia.try_inverse().unwrap();
    let angular = inverse * moments * control.fixed_view::<3, 4>(1, 0);
    let mut b = B::zeros();
    b.row_mut(5)
        .copy_from(&(control.row(0) * (-gains.thrust_gain / vehicle.airframe.mass)));
    b.fixed_view_mut::<3, 4>(9, 0).copy_from(&angular);
    Linear { a, b }
}

/// The matrices of level 1 at hover by automatic differentiation.
fn of_level_1(vehicle: &Vehicle, yaw: f64) -> Linear {
    let model = Level1::<f64>::build(vehicle, &PhenomenonSet::none()).unwrap();
    let hover = model.hover(Vector3::zeros(), yaw);
    let model = Level1::<Dual<16>>::build(vehicle, &PhenomenonSet::none()).unwrap();
    let mut at = [0.0; 16];
    hover.state.write(&mut at);
    at[12..].copy_from_slice(&hover.input.commands);
    let j = jacobian(
        |x| {
            let input = Input::still_air(std::array::from_fn(|i| x[12 + i]));
            let rate = model.derivative(&LinearState::read(x), &input);
            let mut out = [constant(0.0); 12];
            rate.write(&mut out);
            out
        },
        at,
    );
    Linear {
        a: j.fixed_columns::<12>(0).into(),
        b: j.fixed_columns::<4>(12).into(),
    }
}

/// The matrices of level 2 at hover, in the state of level 1.
///
/// Column by column with hyper-dual numbers: the first part of each number follows the column's variable, the
/// second follows time along the flow, so that the mixed part of the state of level 1 that level 2 is
/// restricted to is the derivative of its rate.
fn of_level_2(vehicle: &Vehicle, yaw: f64) -> Linear {
    let one = Level1::<HyperDual64>::build(vehicle, &PhenomenonSet::none()).unwrap();
    let two = Level2::<HyperDual64>::build(vehicle, &PhenomenonSet::none()).unwrap();
    let hover = one.hover(Vector3::zeros(), constant(yaw));
    let column = |j: usize| {
        let mut z = flat(&hover.state);
        let mut input = hover.input;
        match j.checked_sub(12) {
            None => z[j].eps1 = 1.0,
            Some(rotor) => input.commands[rotor].eps1 = 1.0,
        }
        let lifted = two.adopt(&one.snapshot(&LinearState::read(&z), &input), &input);
        let rate = flat(&two.derivative(&lifted, &input));
        let mut moving = flat(&lifted);
        for (x, r) in moving.iter_mut().zip(rate) {
            (x.eps2, x.eps1eps2) = (r.re, r.eps1);
        }
        let moving: QuadrotorState<_, _, _> = Flat::read(&moving);
        flat(&one.adopt(&two.snapshot(&moving, &input), &input))
    };
    let entry = |row: usize, j: usize| column(j)[row].eps1eps2;
    Linear {
        a: A::from_fn(&entry),
        b: B::from_fn(|row, rotor| entry(row, 12 + rotor)),
    }
}

/// Rounding of some tens of operations, against the largest entry of a matrix.
fn rounding<const M: usize, const N: usize>(of: &SMatrix<f64, M, N>) -> f64 {
    1e-13 * of.amax()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn agree_level_2_linearises_to_level_1(vehicle in vehicle(), yaw in -3.1..3.1_f64) {
        let (one, two) = (of_level_1(&vehicle, yaw), of_level_2(&vehicle, yaw));
        assert_relative_eq!(two.a, one.a, epsilon = rounding(&one.a));
        assert_relative_eq!(two.b, one.b, epsilon = rounding(&one.b));
    }

    #[test]
    fn thesis_3_3_3_linear_matrices_by_hand(vehicle in vehicle(), yaw in -3.1..3.1_f64) {
        let (one, hand) = (of_level_1(&vehicle, yaw), by_hand(&vehicle, yaw));
        assert_relative_eq!(one.a, hand.a, epsilon = rounding(&hand.a));
        assert_relative_eq!(one.b, hand.b, epsilon = rounding(&hand.b));
    }

    /// Away from hover the levels differ by the square of the deviation: halving it quarters the difference.
    #[test]
    fn prop_level_1_errs_in_second_order(
        vehicle in vehicle(),
        yaw in -3.1..3.1_f64,
        direction in prop::array::uniform12(prop_oneof![-1.0..-0.3_f64, 0.3..1.0_f64]),
    ) {
        let one = Level1::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
        let two = Level2::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
        let hover = one.hover(Vector3::zeros(), yaw);
        let difference = |size: f64| {
            let mut z = flat(&hover.state);
            z.iter_mut().zip(direction).for_each(|(z, d)| *z += size * d);
            let state: LinearState<f64> = from_flat(&z);
            let x = two.adopt(&one.snapshot(&state, &hover.input), &hover.input);
            let (rate, linear) = (two.derivative(&x, &hover.input), one.derivative(&state, &hover.input));
            let acceleration = rate.body.velocity + x.body.body_rates.cross(&x.body.velocity);
            (x.body.attitude.rotate(&acceleration) - linear.velocity).norm()
        };
        let order = (difference(1e-2) / difference(5e-3)).log2();
        // The next term of the expansion is smaller by the deviation, 1e-2, times a factor of order one.
        prop_assert!((order - 2.0).abs() < 0.1, "order {order}");
    }
}
