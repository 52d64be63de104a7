//! Law 7: what turns or mirrors the world turns or mirrors the flight.
//!
//! Turning: no heading is special. Mirroring: under the reflection `P` of a vertical plane polar vectors
//! (position, velocity, force) become `P v`, axial ones (body rates, moments) `−P ω`, and the spins change
//! sense. The plane between the x and the y axis exchanges these; on a symmetric '+' layout it exchanges
//! rear with left and front with right, and since the left and right rotors spin against the others, the
//! mirrored vehicle is the vehicle itself with its rotors renamed.

use crate::support::{fly, worst_over};
use approx::assert_relative_eq;
use family_tests::{
    Draw, Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, draw, flat,
    vehicle,
};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use quad_dynamics::vehicle::Spin;
use quad_dynamics::{
    Input, Level, Level1, LinearState, PhenomenonSet, QuadrotorModel, RigidBodyState, RotorSnapshot,
    Snapshot, Vehicle,
};
use quad_kinematics::{EulerAngles, EulerRates, Quaternion};

/// Length of the flights, s, and their steps: short enough for the fastest modes of the smallest vehicles,
/// so that nothing amplifies rounding.
const FLIGHT: (f64, u32) = (0.2, 200);

/// A change of the axes that leaves the laws of motion as they are, on everything that moves.
trait Symmetry {
    /// How far two flights may differ that should be the same, relative to the larger of 1 and their numbers.
    const TOLERANCE: f64;

    fn state(&self, state: &RigidBodyState<f64>) -> RigidBodyState<f64>;
    fn polar(&self, vector: &Vector3<f64>) -> Vector3<f64>;
    fn axial(&self, vector: &Vector3<f64>) -> Vector3<f64>;
    fn per_rotor<T: Copy>(&self, values: [T; 4]) -> [T; 4];
}

/// Turns the world about its vertical by an angle, rad.
struct Turn(f64);

impl Symmetry for Turn {
    /// The flow commutes; RK4 does so to its truncation error only, because its inner stages leave the unit
    /// quaternions, where `R(q)` as it is written is no longer a product: `(h ω)⁵/120` a step, 200 steps, h ω up
    /// to 0.06 on the smallest vehicles.
    const TOLERANCE: f64 = 1e-6;

    fn state(&self, state: &RigidBodyState<f64>) -> RigidBodyState<f64> {
        let turn = Quaternion::from_axis_angle(&Vector3::z(), self.0);
        RigidBodyState {
            position: turn.rotate(&state.position),
            attitude: turn.product(&state.attitude),
            ..*state
        }
    }

    fn polar(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        Quaternion::from_axis_angle(&Vector3::z(), self.0).rotate(vector)
    }

    fn axial(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.polar(vector)
    }

    fn per_rotor<T: Copy>(&self, values: [T; 4]) -> [T; 4] {
        values
    }
}

/// Mirrors world and body at a vertical plane; rotor `i` of the mirrored vehicle is rotor `order[i]`.
struct Mirror {
    reflection: Matrix3<f64>,
    order: [usize; 4],
}

impl Mirror {
    /// Exchanges x and y.
    #[rustfmt::skip]
    const EXCHANGE: Matrix3<f64> = Matrix3::new(
        0.0, 1.0, 0.0,
        1.0, 0.0, 0.0,
        0.0, 0.0, 1.0,
    );

    /// Exchanges left and right.
    #[rustfmt::skip]
    const LEFT_RIGHT: Matrix3<f64> = Matrix3::new(
        1.0,  0.0, 0.0,
        0.0, -1.0, 0.0,
        0.0,  0.0, 1.0,
    );

    /// The mirrored vehicle, rotors in the order of the original.
    fn vehicle(&self, vehicle: &Vehicle) -> Vehicle {
        let p = self.reflection;
        let mut mirrored = vehicle.clone();
        let airframe = &mut mirrored.airframe;
        airframe.inertia = p * airframe.inertia * p.transpose();
        airframe.centre_of_mass = p * airframe.centre_of_mass;
        for rotor in &mut mirrored.rotors {
            rotor.hub_position = p * rotor.hub_position;
            rotor.spin = match rotor.spin {
                Spin::Clockwise => Spin::CounterClockwise,
                Spin::CounterClockwise => Spin::Clockwise,
            };
        }
        if let Some(drag) = &mut mirrored.drag {
            // Coefficients belong to axes, whichever way these point.
            drag.quadratic = p.abs() * drag.quadratic;
            drag.rate_damping = p.abs() * drag.rate_damping;
        }
        mirrored
    }
}

impl Symmetry for Mirror {
    /// Exchanges and changes of sign are exact, sums in another order are not: some hundreds of steps of
    /// rounding, spread by the flow about tenfold.
    const TOLERANCE: f64 = 1e-11;

    fn state(&self, state: &RigidBodyState<f64>) -> RigidBodyState<f64> {
        let p = self.reflection;
        RigidBodyState {
            position: p * state.position,
            velocity: p * state.velocity,
            attitude: Quaternion {
                w: state.attitude.w,
                v: -(p * state.attitude.v),
            },
            body_rates: self.axial(&state.body_rates),
        }
    }

    fn polar(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.reflection * vector
    }

    fn axial(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        -(self.reflection * vector)
    }

    fn per_rotor<T: Copy>(&self, values: [T; 4]) -> [T; 4] {
        self.order.map(|i| values[i])
    }
}

fn transformed(symmetry: &impl Symmetry, draw: &Draw) -> (Snapshot<f64>, Input<f64>) {
    let rotors: [RotorSnapshot<f64>; 4] = symmetry.per_rotor(draw.snapshot.rotors);
    let snapshot = Snapshot {
        body: symmetry.state(&draw.snapshot.body),
        rotors,
        ..draw.snapshot
    };
    let input = Input {
        commands: symmetry.per_rotor(draw.input.commands),
        wind: symmetry.polar(&draw.input.wind),
        air_rates: symmetry.axial(&draw.input.air_rates),
    };
    (snapshot, input)
}

/// Both ways round the square: transformed then flown, flown then transformed.
fn assert_commutes<F: Family, S: Symmetry>(symmetry: &S, draw: &Draw, other: &Vehicle, on: &PhenomenonSet) {
    let tolerance = S::TOLERANCE;
    let model = F::Over::<f64>::build(&draw.vehicle, on).unwrap();
    let model_there = F::Over::<f64>::build(other, on).unwrap();
    let (snapshot, input) = transformed(symmetry, draw);
    let here = fly(
        &model,
        model.adopt(&draw.snapshot, &draw.input),
        &draw.input,
        FLIGHT.0,
        FLIGHT.1,
    );
    let there = fly(
        &model_there,
        model_there.adopt(&snapshot, &input),
        &input,
        FLIGHT.0,
        FLIGHT.1,
    );
    let expected = symmetry.state(&model.snapshot(&here, &draw.input).body);
    let found = model_there.snapshot(&there, &input).body;
    assert_relative_eq!(
        found.position,
        expected.position,
        epsilon = tolerance,
        max_relative = tolerance
    );
    assert_relative_eq!(
        found.velocity,
        expected.velocity,
        epsilon = tolerance,
        max_relative = tolerance
    );
    assert_relative_eq!(
        found.body_rates,
        expected.body_rates,
        epsilon = tolerance,
        max_relative = tolerance
    );
    let (r_found, r_expected) = (
        found.attitude.rotation().matrix,
        expected.attitude.rotation().matrix,
    );
    assert_relative_eq!(r_found, r_expected, epsilon = tolerance);
}

fn assert_levels_2_to_5_commute(symmetry: &impl Symmetry, draw: &Draw, other: &Vehicle) {
    let on = |level: Level| level.phenomena();
    assert_commutes::<FamilyTwo, _>(symmetry, draw, other, &on(Level::Four));
    assert_commutes::<FamilyThree, _>(symmetry, draw, other, &on(Level::Four));
    assert_commutes::<FamilyFour, _>(symmetry, draw, other, &on(Level::Four));
    assert_commutes::<FamilyFive, _>(symmetry, draw, other, &on(Level::Five));
    assert_commutes::<FamilyMechanistic, _>(symmetry, draw, other, &on(Level::Five));
}

/// Level 1 mirrored in its own terms: its angles are the components of a small rotation, an axial vector. (As
/// Euler angles of a finite rotation they would be mirrored so to first order only, for the order of the three
/// rotations changes when x and y are exchanged.)
fn assert_level_1_commutes(mirror: &Mirror, draw: &Draw, other: &Vehicle) {
    let (p, none) = (mirror.reflection, PhenomenonSet::none());
    let reflected = |x: &LinearState<f64>| LinearState {
        position: p * x.position,
        velocity: p * x.velocity,
        attitude: EulerAngles::from_vector(&-(p * x.attitude.vector())),
        attitude_rates: EulerRates::from_vector(&-(p * x.attitude_rates.vector())),
    };
    let here = Level1::<f64>::build(&draw.vehicle, &none).unwrap();
    let there = Level1::<f64>::build(other, &none).unwrap();
    let start = here.adopt(&draw.snapshot, &draw.input);
    let (_, input) = transformed(mirror, draw);
    let expected = reflected(&fly(&here, start, &draw.input, FLIGHT.0, FLIGHT.1));
    let found = fly(&there, reflected(&start), &input, FLIGHT.0, FLIGHT.1);
    let (found, expected) = (flat(&found), flat(&expected));
    assert!(
        worst_over(&found, &expected, |i| Mirror::TOLERANCE
            * expected[i].abs().max(1.0))
            <= 1.0
    );
}

/// The same moment with a tenth of the tilt and of the rates, and rotors within a tenth of hover.
fn gentle(mut draw: Draw) -> Draw {
    let body = &mut draw.snapshot.body;
    let angles = body.attitude.euler_angles();
    body.attitude = EulerAngles::new(angles.roll * 0.1, angles.pitch * 0.1, angles.yaw).quaternion();
    body.body_rates *= 0.1;
    let gains = draw.vehicle.linear_rotor;
    let hover = draw.vehicle.hover_thrust_per_rotor() / gains.thrust_gain;
    let full = *draw.vehicle.zeroed_range().end();
    let near_hover = |u: f64| hover * (0.9 + 0.2 * u / full);
    draw.input.commands = draw.input.commands.map(near_hover);
    for (rotor, u) in draw.snapshot.rotors.iter_mut().zip(draw.input.commands) {
        rotor.output.thrust = gains.thrust_gain * u;
        rotor.output.torque = gains.torque_gain * u;
        rotor.rate.thrust *= 0.1;
        rotor.rate.torque *= 0.1;
    }
    draw
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn prop_no_heading_is_special(draw in draw(vehicle()), turn in -3.0..3.0_f64) {
        let draw = gentle(draw);
        assert_commutes::<FamilyOne, _>(&Turn(turn), &draw, &draw.vehicle, &PhenomenonSet::none());
        assert_levels_2_to_5_commute(&Turn(turn), &draw, &draw.vehicle);
    }

    #[test]
    fn prop_mirrored_vehicles_fly_mirrored(draw in draw(vehicle()), exchange in any::<bool>()) {
        let draw = gentle(draw);
        let reflection = if exchange { Mirror::EXCHANGE } else { Mirror::LEFT_RIGHT };
        let mirror = Mirror { reflection, order: [0, 1, 2, 3] };
        let there = mirror.vehicle(&draw.vehicle);
        there.validate("mirrored").unwrap();
        assert_level_1_commutes(&mirror, &draw, &there);
        assert_levels_2_to_5_commute(&mirror, &draw, &there);
    }

    /// The Qball-X4 is its own mirror image with x and y exchanged: rear (1) and left (3), front (2) and
    /// right (4) change places.
    #[test]
    fn prop_exchange_of_x_and_y_on_the_plus_layout(draw in draw(Just(Vehicle::qball_x4()))) {
        let draw = gentle(draw);
        let mirror = Mirror { reflection: Mirror::EXCHANGE, order: [2, 3, 0, 1] };
        assert_level_1_commutes(&mirror, &draw, &draw.vehicle);
        assert_levels_2_to_5_commute(&mirror, &draw, &draw.vehicle);
    }

    /// The Crazyflie's 'x' layout is its own mirror image with left and right exchanged.
    #[test]
    fn prop_exchange_of_left_and_right_on_the_x_layout(draw in draw(Just(Vehicle::crazyflie()))) {
        let draw = gentle(draw);
        let mirror = Mirror { reflection: Mirror::LEFT_RIGHT, order: [3, 2, 1, 0] };
        assert_level_1_commutes(&mirror, &draw, &draw.vehicle);
        assert_levels_2_to_5_commute(&mirror, &draw, &draw.vehicle);
    }
}

/// A law that everything passes is no law: without the change of the spins the exchange does not commute.
#[test]
#[should_panic(expected = "assert_relative_eq")]
fn exact_exchange_of_the_wrong_rotors_is_noticed() {
    let vehicle = Vehicle::qball_x4();
    let zero = quad_rotor::RotorOutput {
        thrust: 0.0,
        torque: 0.0,
    };
    let hover = vehicle.hover_thrust_per_rotor() / vehicle.linear_rotor.thrust_gain;
    let draw = Draw {
        snapshot: Snapshot {
            body: RigidBodyState::at_rest(Vector3::zeros(), 0.2),
            rotors: [RotorSnapshot {
                output: zero,
                rate: zero,
            }; 4],
            charge_drawn: None,
        },
        input: Input::still_air([1.0, 1.0, 1.1, 1.0].map(|s| s * hover)),
        vehicle,
    };
    // Rear with right and front with left is the other diagonal plane: x becomes −y.
    let mirror = Mirror {
        reflection: Mirror::EXCHANGE,
        order: [3, 2, 1, 0],
    };
    assert_commutes::<FamilyTwo, _>(&mirror, &draw, &draw.vehicle, &PhenomenonSet::none());
}
