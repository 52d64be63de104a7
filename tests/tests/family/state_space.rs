//! The battery, part one: states as vectors, hover as a fixed point, finiteness over the valid box.

use crate::support::outputs;
use family_tests::{
    Draw, Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, draw, flat,
    from_flat, phenomena, rate, vehicle,
};
use nalgebra::Vector3;
use num_dual::Dual64;
use proptest::prelude::*;
use quad_dynamics::{
    Input, Phenomenon, PhenomenonSet, QuadrotorModel, RigidBodyState, RotorSnapshot, Snapshot, StateOf,
    Vehicle,
};
use quad_math::{FixedStep, Flat, System, constant};
use quad_rotor::RotorOutput;

/// Each model of the family on a test generic in it.
macro_rules! every_model {
    ($check:ident, $($argument:expr),*) => {{
        $check::<FamilyOne>($($argument),*)?;
        $check::<FamilyTwo>($($argument),*)?;
        $check::<FamilyThree>($($argument),*)?;
        $check::<FamilyFour>($($argument),*)?;
        $check::<FamilyFive>($($argument),*)?;
        $check::<FamilyMechanistic>($($argument),*)?;
    }};
}

/// All phenomena that a model may have.
fn everything<F: Family>() -> PhenomenonSet {
    F::PHENOMENA.iter().copied().collect()
}

fn round_trip<F: Family>(draw: &Draw) -> Result<(), TestCaseError> {
    let model = F::Over::<f64>::build(&draw.vehicle, &everything::<F>()).unwrap();
    let numbers = flat(&model.adopt(&draw.snapshot, &draw.input));
    let again = flat(&from_flat::<f64, StateOf<f64, F::Over<f64>>>(&numbers));
    prop_assert_eq!(&numbers, &again);
    // No number is written twice or left out: distinct numbers come back distinct.
    let distinct: Vec<f64> = (0..numbers.len()).map(|i| i as f64 + 0.5).collect();
    let again = flat(&from_flat::<f64, StateOf<f64, F::Over<f64>>>(&distinct));
    prop_assert_eq!(distinct, again);
    Ok(())
}

/// Hover: no acceleration of any kind, in the air and in the rotors; only the battery's charge moves.
fn hover_is_a_fixed_point<F: Family>(vehicle: &Vehicle, yaw: f64) -> Result<(), TestCaseError> {
    // The trim is that of free air.
    for on in [
        PhenomenonSet::none(),
        everything::<F>().without(Phenomenon::GroundEffect),
    ] {
        let model = F::Over::<f64>::build(vehicle, &on).unwrap();
        let hover = model.hover(Vector3::new(1.0, 2.0, -3.0), yaw);
        let rates = flat(&model.derivative(&hover.state, &hover.input));
        let has_supply = F::PHENOMENA.contains(&Phenomenon::VoltageSag);
        let (body, rest) = rates.split_at(rates.len().min(RigidBodyState::<f64>::LEN));
        let (rotors, supply) = rest.split_at(rest.len() - usize::from(has_supply));
        // The body: the trim's relative error, 1e-11, times the acceleration that one rotor gives. The rotors:
        // the same error times the largest coefficient of a response, 1e4 /s².
        let airframe = &vehicle.airframe;
        let angular = vehicle.weight() * airframe.arm_length / airframe.inertia.symmetric_eigenvalues().min();
        prop_assert!(
            body.iter().all(|r| r.abs() <= 1e-11 * (angular + 10.0)),
            "{on}: {rates:?}"
        );
        let scale = 1e4 * vehicle.weight() + 1e4;
        prop_assert!(rotors.iter().all(|r| r.abs() <= 1e-11 * scale), "{on}: {rates:?}");
        let sags = on.contains(Phenomenon::VoltageSag);
        prop_assert_eq!(supply.iter().any(|&q| q > 0.0), sags);
    }
    Ok(())
}

/// One second of hover under RK4 goes nowhere, battery sag excepted.
fn hover_stays<F: Family>(vehicle: &Vehicle) -> Result<(), TestCaseError> {
    let on = everything::<F>()
        .without(Phenomenon::VoltageSag)
        .without(Phenomenon::GroundEffect);
    let model = F::Over::<f64>::build(vehicle, &on).unwrap();
    let hover = model.hover(Vector3::new(1.0, 2.0, -3.0), 0.7);
    let end = (0..250).fold(hover.state, |x, _| {
        FixedStep::Rk4.step(&model, &x, &hover.input, 2e-3)
    });
    let moved = (model.flight(&end).position - Vector3::new(1.0, 2.0, -3.0)).amax();
    // Residual accelerations of 1e-10 m/s² and tilts of their double integral.
    prop_assert!(moved < 1e-9, "{moved}");
    Ok(())
}

/// A corner or an inner point of the valid box: every part at an end of its range, or anywhere.
#[derive(Clone, Debug)]
struct BoxPoint {
    vehicle: Vehicle,
    snapshot: Snapshot<f64>,
    input: Input<f64>,
}

/// One end, the other, zero, or between.
fn extreme(size: f64) -> impl Strategy<Value = f64> {
    prop_oneof![Just(-size), Just(0.0), Just(size), -size..size]
}

fn extreme_vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [extreme(size), extreme(size), extreme(size)].prop_map(Vector3::from)
}

/// Ten kilometres, 100 m/s, 100 rad/s, any attitude with the poles, thrusts from reversed to double,
/// commands far outside the limits, a gale, any charge.
fn box_point() -> impl Strategy<Value = BoxPoint> {
    let attitude = [
        extreme(std::f64::consts::PI),
        extreme(1.5),
        extreme(std::f64::consts::PI),
    ];
    let shares = prop::array::uniform4([
        extreme(2.0),
        extreme(2.0),
        extreme(50.0),
        extreme(50.0),
        extreme(3.0),
    ]);
    let body = (
        extreme_vector(1e4),
        extreme_vector(100.0),
        attitude,
        extreme_vector(100.0),
    );
    (vehicle(), body, shares, extreme_vector(40.0), 0.0..1.0_f64).prop_map(
        |(vehicle, (position, velocity, [roll, pitch, yaw], body_rates), shares, wind, discharge)| {
            let high = *vehicle.zeroed_range().end();
            let gains = vehicle.linear_rotor;
            let output = |t: f64, q: f64| RotorOutput {
                thrust: t * gains.thrust_gain * high,
                torque: q * gains.torque_gain * high,
            };
            let body = RigidBodyState {
                position,
                velocity,
                attitude: quad_kinematics::EulerAngles::new(roll, pitch, yaw).quaternion(),
                body_rates,
            };
            let rotors = shares.map(|[t, q, dt, dq, _]| RotorSnapshot {
                output: output(t, q),
                rate: output(dt, dq),
            });
            let charge_drawn = Some(discharge * vehicle.battery.unwrap().capacity);
            let commands = shares.map(|[.., u]| u * high);
            BoxPoint {
                vehicle,
                snapshot: Snapshot {
                    body,
                    rotors,
                    charge_drawn,
                },
                input: Input::in_wind(commands, wind),
            }
        },
    )
}

/// Derivative, step and outputs are numbers, and so are the derivative's own derivatives.
fn finite<F: Family>(point: &BoxPoint) -> Result<(), TestCaseError> {
    let on = everything::<F>();
    let model = F::Over::<f64>::build(&point.vehicle, &on).unwrap();
    let state = model.adopt(&point.snapshot, &point.input);
    let all_finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
    prop_assert!(all_finite(&flat(&state)));
    prop_assert!(all_finite(&flat(&model.derivative(&state, &point.input))));
    let next = FixedStep::Rk4.step(&model, &state, &point.input, 1e-3);
    prop_assert!(all_finite(&flat(&next)), "{next:?}");
    prop_assert!(all_finite(outputs(&model.flight(&state)).as_slice()));

    let dual = F::Over::<Dual64>::build(&point.vehicle, &on).unwrap();
    let numbers = family_tests::join(&state, &point.input);
    for moving in 0..numbers.len() {
        let mut all: Vec<Dual64> = numbers.iter().map(|&x| constant(x)).collect();
        all[moving].eps = 1.0;
        let column = rate(&dual, &all);
        prop_assert!(
            column.iter().all(|x| x.eps.is_finite()),
            "column {moving}: {column:?}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn prop_random_vehicles_are_valid(vehicle in vehicle()) {
        prop_assert_eq!(vehicle.validate("random"), Ok(()));
    }

    #[test]
    fn prop_flat_round_trip(draw in draw(vehicle())) {
        every_model!(round_trip, &draw);
    }

    #[test]
    fn prop_hover_is_a_fixed_point(vehicle in vehicle(), yaw in -3.0..3.0_f64) {
        every_model!(hover_is_a_fixed_point, &vehicle, yaw);
    }

    #[test]
    fn prop_finite_over_the_valid_box(point in box_point()) {
        every_model!(finite, &point);
    }

    /// A model that builds with everything builds with any part of it.
    #[test]
    fn prop_phenomena_switch_one_by_one(vehicle in vehicle(), on in phenomena::<FamilyFive>()) {
        let model = quad_dynamics::Level5::<f64>::build(&vehicle, &on).unwrap();
        prop_assert_eq!(model.phenomena(), &on);
        prop_assert_eq!(model.drag.is_some(), on.contains(Phenomenon::Drag));
    }
}

#[test]
fn regress_hover_of_the_named_vehicles_stays() {
    let check = || -> Result<(), TestCaseError> {
        for vehicle in [Vehicle::qball_x4(), Vehicle::crazyflie()] {
            every_model!(hover_stays, &vehicle);
            every_model!(hover_is_a_fixed_point, &vehicle, 0.3);
        }
        Ok(())
    };
    check().unwrap();
}
