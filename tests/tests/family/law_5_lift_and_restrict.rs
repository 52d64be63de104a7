//! Law 5: `restrict(lift(x)) = x` between neighbours, and what acts on the airframe does not jump.

use crate::support::worst_over;
use approx::assert_relative_eq;
use family_tests::{
    Draw, Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, draw, flat,
    vehicle,
};
use nalgebra::Vector3;
use proptest::prelude::*;
use quad_dynamics::{
    AnyQuadrotor, Input, Level, Phenomenon, PhenomenonSet, QuadrotorModel, Snapshot, Vehicle,
};
use quad_math::{FixedStep, System};

/// A model of the family over `f64`.
type Model<F> = <F as Family>::Over<f64>;

/// Largest difference of a state that was lifted and restricted from itself, over the tolerance.
fn round_trip<Lower: Family, Upper: Family>(draw: &Draw, lower_on: &PhenomenonSet) -> f64 {
    let lower = Model::<Lower>::build(&draw.vehicle, lower_on).unwrap();
    let upper = Model::<Upper>::build(&draw.vehicle, &PhenomenonSet::none()).unwrap();
    let x = lower.adopt(&draw.snapshot, &draw.input);
    let lifted = upper.adopt(&lower.snapshot(&x, &draw.input), &draw.input);
    let back = lower.adopt(&upper.snapshot(&lifted, &draw.input), &draw.input);
    let (x, back) = (flat(&x), flat(&back));
    // A chain of roundings; the Euler angles of level 1 lose a digit near the singularity, and the memory of
    // the torque response is the rest of terms up to c_Q1 Q_∞.
    let response = draw.vehicle.rotor_dynamics.map_or(0.0, |d| {
        (d.torque_c1 + d.torque_c3) * draw.vehicle.linear_rotor.torque_gain
    });
    worst_over(&back, &x, |i| 1e-12 * x[i].abs().max(1.0) + 1e-14 * response)
}

/// Acceleration of the body, linear in B and angular, of a flight that a model adopted.
fn accelerations<F: Family>(draw: &Draw, on: &PhenomenonSet, snapshot: &Snapshot<f64>) -> Vec<f64> {
    let model = Model::<F>::build(&draw.vehicle, on).unwrap();
    let x = model.adopt(snapshot, &draw.input);
    let rate = flat(&model.derivative(&x, &draw.input));
    [&rate[3..6], &rate[10..13]].concat()
}

/// Largest jump of the acceleration when a flight is lifted, over the tolerance.
fn jump<Lower: Family, Upper: Family>(draw: &Draw, on: &PhenomenonSet) -> f64 {
    let lower = Model::<Lower>::build(&draw.vehicle, on).unwrap();
    let x = lower.adopt(&draw.snapshot, &draw.input);
    let before = accelerations::<Lower>(draw, on, &lower.snapshot(&x, &draw.input));
    let after = accelerations::<Upper>(draw, on, &lower.snapshot(&x, &draw.input));
    // Thrust and torque are handed over as they are, to a rounding or two; they cancel in the moments, so
    // that the tolerance refers to the acceleration that one rotor at full thrust gives.
    let full = draw.vehicle.linear_rotor.thrust_gain * draw.vehicle.zeroed_range().end();
    let airframe = &draw.vehicle.airframe;
    let angular = full * airframe.arm_length / airframe.inertia.symmetric_eigenvalues().min();
    worst_over(&before, &after, |i| {
        1e-13 * if i < 3 { 100.0 } else { angular.max(100.0) }
    })
}

/// The phenomena that levels 2 to 5 share, on and off.
fn phenomena_of_all() -> impl Strategy<Value = PhenomenonSet> {
    let all = [Phenomenon::Drag, Phenomenon::GyroscopicTorque];
    prop::sample::subsequence(all.to_vec(), 0..=2).prop_map(|set| set.into_iter().collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn prop_restrict_undoes_lift(draw in draw(vehicle())) {
        let none = PhenomenonSet::none();
        for worst in [
            round_trip::<FamilyOne, FamilyTwo>(&draw, &none),
            round_trip::<FamilyTwo, FamilyThree>(&draw, &none),
            round_trip::<FamilyThree, FamilyFour>(&draw, &none),
            round_trip::<FamilyFour, FamilyFive>(&draw, &none),
        ] {
            prop_assert!(worst <= 1.0, "{worst}");
        }
    }

    /// Two levels up and back: nothing that the lowest level knows is lost on the way.
    #[test]
    fn prop_restrict_undoes_lift_over_two_levels(draw in draw(vehicle())) {
        let none = PhenomenonSet::none();
        for worst in [
            round_trip::<FamilyOne, FamilyThree>(&draw, &none),
            round_trip::<FamilyTwo, FamilyFour>(&draw, &none),
            round_trip::<FamilyThree, FamilyFive>(&draw, &none),
        ] {
            prop_assert!(worst <= 1.0, "{worst}");
        }
    }

    #[test]
    fn agree_acceleration_is_continuous_on_lift(draw in draw(vehicle()), on in phenomena_of_all()) {
        for worst in [
            jump::<FamilyTwo, FamilyThree>(&draw, &on),
            jump::<FamilyThree, FamilyFour>(&draw, &on),
            jump::<FamilyFour, FamilyFive>(&draw, &on),
            jump::<FamilyFive, FamilyMechanistic>(&draw, &on),
        ] {
            prop_assert!(worst <= 1.0, "{worst}");
        }
    }

    /// Level 1 has the whole circle of headings and more; the levels above have it once.
    #[test]
    fn prop_headings_beyond_half_a_turn_come_back_within_it(draw in draw(vehicle()), turns in -3..=3_i32) {
        let none = PhenomenonSet::none();
        let one = Model::<FamilyOne>::build(&draw.vehicle, &none).unwrap();
        let two = Model::<FamilyTwo>::build(&draw.vehicle, &none).unwrap();
        let mut x = one.adopt(&draw.snapshot, &draw.input);
        let heading = x.attitude.yaw;
        x.attitude.yaw += f64::from(turns) * std::f64::consts::TAU;
        let lifted = two.adopt(&one.snapshot(&x, &draw.input), &draw.input);
        let back = one.adopt(&two.snapshot(&lifted, &draw.input), &draw.input);
        // Rounding of sines of up to seven half turns, times ten near the singularity.
        assert_relative_eq!(back.attitude.yaw, heading, epsilon = 1e-12);
    }
}

/// A climb with roll and yaw that runs through all levels and back at run time.
#[test]
fn agree_any_quadrotor_changes_level_in_flight() {
    let vehicle = Vehicle::qball_x4();
    let none = PhenomenonSet::none();
    let start = Vector3::new(1.0, -2.0, -3.0);
    let mut quadrotor = AnyQuadrotor::<f64>::hovering(Level::One, &vehicle, &none, start, 0.4).unwrap();
    let mut commands = quadrotor.hover_input().commands;
    let steps = [1.05, 1.03, 1.06, 1.01];
    commands.iter_mut().zip(steps).for_each(|(u, s)| *u *= s);
    let input = Input::still_air(commands);
    let up_and_down = Level::ALL.into_iter().chain(Level::ALL.into_iter().rev());
    for level in up_and_down {
        let before = quadrotor.flight();
        quadrotor = quadrotor.at_level(level, &vehicle, &none, &input).unwrap();
        let after = quadrotor.flight();
        assert_eq!(quadrotor.level(), level);
        // Roundings of a conversion between attitudes.
        assert_relative_eq!(before.position, after.position, epsilon = 1e-14);
        assert_relative_eq!(before.velocity, after.velocity, epsilon = 1e-14);
        assert_relative_eq!(before.rotation.matrix, after.rotation.matrix, epsilon = 1e-14);
        assert_relative_eq!(before.body_rates, after.body_rates, epsilon = 1e-14);
        for _ in 0..20 {
            quadrotor.step(FixedStep::Rk4, &input, 1e-3);
        }
    }
    let flight = quadrotor.flight();
    assert!(flight.position.z < start.z && flight.attitude.roll > 0.0);
}
