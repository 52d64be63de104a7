//! Law 9: level 2 integrated with a quaternion, with a rotation matrix, and with Euler angles in the
//! Lagrangian form flies the same trajectory.

use crate::support::{flow, fly, outputs};
use family_tests::{flat, vehicle};
use nalgebra::{Matrix3, SVector, Vector3};
use proptest::prelude::*;
use quad_dynamics::{
    Input, Level, Level2, Phenomenon, PhenomenonSet, QuadrotorModel, QuadrotorState, RigidBodyState, Wrench,
};
use quad_kinematics::{Body, EulerAngles, EulerRates, Rotation, World};
use quad_math::{Flat, System};
use quad_rotor::RotorInput;

/// Force and moment of level 2 at an attitude, from its own text.
fn wrench(model: &Level2<f64>, body: RigidBodyState<f64>, input: &Input<f64>) -> Wrench<f64> {
    let inputs = input.commands.map(|command| RotorInput {
        command,
        voltage: 1.0,
    });
    let state = QuadrotorState {
        body,
        rotors: [(); 4],
        supply: (),
    };
    model.wrench(&state, &inputs, input)
}

/// Level 2 in the form of Euler-Lagrange: position and velocity in W, `η` and `η̇`.
struct Lagrangian(Level2<f64>);

/// Level 2 with the rotation matrix as its attitude: position in W, velocity in B, `R_WB`, `ω`.
struct WithMatrix(Level2<f64>);

impl System<f64> for Lagrangian {
    type State = SVector<f64, 12>;
    type Input = Input<f64>;

    fn derivative(&self, x: &Self::State, input: &Input<f64>) -> SVector<f64, 12> {
        let part = |at: usize| Vector3::from(x.fixed_rows::<3>(at));
        let attitude = EulerAngles::from_vector(&part(6));
        let rates = EulerRates::from_vector(&part(9));
        let rotation = attitude.rotation().matrix;
        let body = RigidBodyState {
            position: part(0),
            velocity: rotation.transpose() * part(3),
            attitude: attitude.quaternion(),
            body_rates: attitude.body_rates(&rates),
        };
        let wrench = wrench(&self.0, body, input);
        let body = &self.0.body;
        let acceleration = body.lagrange_inertial_acceleration(&(rotation * wrench.force));
        let angular = body.lagrange_euler_acceleration(&attitude, &rates, &wrench.moment);
        let parts = [part(3), acceleration, part(9), angular];
        SVector::from_iterator(parts.iter().flat_map(|v| v.iter().copied()))
    }
}

impl System<f64> for WithMatrix {
    type State = SVector<f64, 18>;
    type Input = Input<f64>;

    fn derivative(&self, x: &Self::State, input: &Input<f64>) -> SVector<f64, 18> {
        let part = |at: usize| Vector3::from(x.fixed_rows::<3>(at));
        let rotation =
            Rotation::<f64, Body, World>::from_matrix(Matrix3::from_column_slice(&x.as_slice()[6..15]));
        let body = RigidBodyState {
            position: part(0),
            velocity: part(3),
            attitude: rotation.quaternion(),
            body_rates: part(15),
        };
        let rate = self.0.body.derivative(&body, &wrench(&self.0, body, input));
        let mut out = SVector::<f64, 18>::zeros();
        rate.position.write(out.as_mut_slice());
        rate.velocity.write(&mut out.as_mut_slice()[3..]);
        out.as_mut_slice()[6..15].copy_from_slice(rotation.derivative(&body.body_rates).as_slice());
        rate.body_rates.write(&mut out.as_mut_slice()[15..]);
        out
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn agree_three_ways_to_integrate_level_2(
        vehicle in vehicle(),
        pulse in prop::array::uniform4(-0.04..0.04_f64),
        wind in family_tests::vector(3.0),
        tilt in family_tests::vector(0.4),
        full in any::<bool>(),
    ) {
        let on: PhenomenonSet = if full { Level::Four.phenomena() } else { PhenomenonSet::none() };
        prop_assert_eq!(on.contains(Phenomenon::Drag), full);
        let model = Level2::<f64>::build(&vehicle, &on).unwrap();
        let hover = model.hover(Vector3::zeros(), 0.5);
        let commands = std::array::from_fn(|i| hover.input.commands[i] * (1.0 + pulse[i]));
        let input = Input::in_wind(commands, wind);
        let attitude = EulerAngles::from_vector(&tilt);
        let mut start = hover.state;
        start.body.attitude = attitude.quaternion();
        start.body.velocity = Vector3::new(2.0, -1.0, 0.5);
        // Long enough for half a radian, whatever the size, and not for the singularity of the Euler angles.
        let time = 1.5 * (vehicle.airframe.arm_length / vehicle.environment.gravity).sqrt();
        let steps = 500;
        let end = outputs(&model.flight(&fly(&model, start, &input, time, steps)));

        let rotation = attitude.rotation().matrix;
        let start_w = rotation * start.body.velocity;
        let lagrangian: Vec<f64> = [Vector3::zeros(), start_w, tilt, Vector3::zeros()].iter().flat_map(flat).collect();
        let z = flow(&Lagrangian(model.clone()), SVector::from_vec(lagrangian), &input, time, steps);
        let eta = EulerAngles::from_vector(&Vector3::from(z.fixed_rows::<3>(6)));
        let rates = EulerRates::from_vector(&Vector3::from(z.fixed_rows::<3>(9)));
        let by_angles = [
            z.as_slice()[..6].to_vec(), eta.rotation().matrix.as_slice().to_vec(), flat(&eta.body_rates(&rates)),
        ].concat();

        let matrix = [&[0.0; 3], start.body.velocity.as_slice(), rotation.as_slice(), &[0.0; 3]].concat();
        let y = flow(&WithMatrix(model), SVector::from_vec(matrix), &input, time, steps);
        let r: Matrix3<f64> = Matrix3::from_column_slice(&y.as_slice()[6..15]);
        let by_matrix = [
            &y.as_slice()[..3], (r * Vector3::from(y.fixed_rows::<3>(3))).as_slice(), r.as_slice(),
            &y.as_slice()[15..],
        ].concat();
        // h is 0.6 ms at most: below 20 rad/s RK4 leaves (h ω)⁵/120 = 2e-12 a step, 500 steps 1e-9; the kinks of
        // drag (the air speed may pass zero) cost some h² of the drag's share.
        prop_assert!((end - SVector::<f64, 18>::from_vec(by_angles)).amax() < 1e-7);
        prop_assert!((end - SVector::<f64, 18>::from_vec(by_matrix)).amax() < 1e-7);
    }
}
