//! Air that turns about the vehicle.

use super::{ROUNDING, body_rate, qball};
use crate::*;
use approx::assert_relative_eq;
use nalgebra::Vector3;

fn drag() -> PhenomenonSet {
    PhenomenonSet::none().with(Phenomenon::Drag)
}

/// Air that rolls to the right (p_g > 0) takes a level body at rest along: `ṗ = d_x p_g / I_xx`, as if the body rolled by −p_g.
#[test]
fn exact_air_that_rolls_takes_the_body_along() {
    let vehicle = qball();
    let (d, inertia) = (vehicle.drag.expect("nominal").rate_damping, 0.03);
    let taken = body_rate(&drag(), |_, input| input.air_rates.x = 0.5);
    assert_relative_eq!(taken.body_rates.x, d.x * 0.5 / inertia, epsilon = ROUNDING);
    assert!(taken.body_rates.x > 0.0 && taken.body_rates.y == 0.0 && taken.body_rates.z == 0.0);
    let rolling = body_rate(&drag(), |body, _| body.body_rates.x = -0.5);
    assert_relative_eq!(taken.body_rates, rolling.body_rates, epsilon = ROUNDING);
    // Without drag the air is not felt.
    let deaf = body_rate(&PhenomenonSet::none(), |_, input| input.air_rates.x = 0.5);
    assert_eq!(deaf.body_rates, Vector3::zeros());
}

/// Rotation of the air is along W: heading east, air that turns about the north turns the body about its left, `q < 0`.
#[test]
fn exact_rotation_of_the_air_is_along_the_world() {
    let rate = body_rate(&drag(), |body, input| {
        *body = RigidBodyState::at_rest(Vector3::zeros(), std::f64::consts::FRAC_PI_2);
        input.air_rates.x = 0.5;
    });
    let d = qball().drag.expect("nominal").rate_damping;
    assert_relative_eq!(rate.body_rates.y, -d.y * 0.5 / 0.03, epsilon = ROUNDING);
    assert!(rate.body_rates.x.abs() < ROUNDING);
}

/// A body that turns with the air is not damped, at any attitude.
#[test]
fn exact_a_body_that_turns_with_the_air_is_not_damped() {
    let turning = Vector3::new(0.3, -0.2, 0.4);
    let change = |body: &mut RigidBodyState<f64>, air: Vector3<f64>, input: &mut Input<f64>| {
        body.attitude = quad_kinematics::EulerAngles::new(0.3, -0.4, 1.2).quaternion();
        body.body_rates = turning;
        input.air_rates = body.attitude.rotate(&air);
    };
    let with_the_air = body_rate(&drag(), |body, input| change(body, turning, input));
    let undamped = body_rate(&PhenomenonSet::none(), |body, input| {
        change(body, Vector3::zeros(), input);
    });
    assert_relative_eq!(with_the_air.body_rates, undamped.body_rates, epsilon = ROUNDING);
    let in_still_air = body_rate(&drag(), |body, input| change(body, Vector3::zeros(), input));
    assert!((in_still_air.body_rates - undamped.body_rates).norm() > 1e-3);
}
