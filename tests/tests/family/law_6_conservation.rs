//! Law 6: no force, no change. Energy and momenta are kept to the order of the integrator.

use crate::support::fly;
use approx::assert_relative_eq;
use family_tests::{Family, FamilyFive, FamilyFour, FamilyThree, FamilyTwo, body, vehicle};
use nalgebra::{SVector, Vector3};
use proptest::prelude::*;
use quad_dynamics::{
    Input, Phenomenon, PhenomenonSet, QuadrotorModel, RigidBody, RigidBodyState, RotorSnapshot, Snapshot,
    Vehicle, gyroscopic_torque,
};
use quad_rotor::RotorOutput;

/// Energy and two momenta.
type Invariants = SVector<f64, 7>;

/// Energy, J, linear and angular momentum in W, N s and N m s, of a flight.
fn invariants(body: &RigidBody<f64>, state: &RigidBodyState<f64>) -> Invariants {
    let rotate = |v: Vector3<f64>| state.attitude.rotate(&v);
    let linear = rotate(state.velocity * body.mass);
    let angular = rotate(body.inertia * state.body_rates);
    Invariants::from_iterator([&[body.energy(state)], linear.as_slice(), angular.as_slice()].concat())
}

/// A body with idle rotors.
fn idle(body: RigidBodyState<f64>) -> Snapshot<f64> {
    let zero = RotorOutput {
        thrust: 0.0,
        torque: 0.0,
    };
    Snapshot {
        body,
        rotors: [RotorSnapshot {
            output: zero,
            rate: zero,
        }; 4],
        charge_drawn: None,
    }
}

/// Commands u at which every model of the family gives no thrust: zero, or for the polynomials the
/// bottom of the range.
fn no_thrust(vehicle: &Vehicle, polynomial: bool) -> Input<f64> {
    let bottom = *vehicle.zeroed_range().start();
    Input::still_air([if polynomial { bottom } else { 0.0 }; 4])
}

/// Change of the invariants over a second of flight without thrust in `steps` steps.
fn drift<F: Family>(
    vehicle: &Vehicle,
    start: RigidBodyState<f64>,
    polynomial: bool,
    steps: u32,
) -> Invariants {
    let model = F::Over::<f64>::build(vehicle, &PhenomenonSet::none()).unwrap();
    let body = RigidBody::of(vehicle);
    let input = no_thrust(vehicle, polynomial);
    let state = model.adopt(&idle(start), &input);
    let end = fly(&model, state, &input, 1.0, steps);
    invariants(&body, &model.snapshot(&end, &input).body) - invariants(&body, &start)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// In weightlessness all seven; halving the step divides the drift by 2⁴ at least.
    #[test]
    fn prop_free_flight_keeps_energy_and_momenta((start, _) in body(), mut vehicle in vehicle()) {
        vehicle.environment.gravity = 0.0;
        let scale = invariants(&RigidBody::of(&vehicle), &start).amax();
        let coarse = drift::<FamilyTwo>(&vehicle, start, false, 128);
        let fine = drift::<FamilyTwo>(&vehicle, start, false, 256);
        // Rates up to 9 rad/s make h ω = 0.07: RK4 drifts by (h ω)⁴ · t ω / 120 at most.
        prop_assert!(coarse.amax() < 2e-6 * scale, "{coarse}");
        // Four octaves a halving, half an octave for the next term; below 1e-13 there is rounding only.
        prop_assert!(fine.amax() < coarse.amax() / 11.0 + 1e-13 * scale, "{coarse} {fine}");
    }

    /// The other levels with their rotors at rest fly the same arc.
    #[test]
    fn agree_free_flight_of_all_levels((start, _) in body(), mut vehicle in vehicle()) {
        vehicle.environment.gravity = 0.0;
        let two = drift::<FamilyTwo>(&vehicle, start, false, 128);
        let scale = invariants(&RigidBody::of(&vehicle), &start).amax();
        let others = [
            drift::<FamilyThree>(&vehicle, start, false, 128),
            drift::<FamilyFour>(&vehicle, start, false, 128),
            drift::<FamilyFive>(&vehicle, start, true, 128),
        ];
        for other in others {
            // The same operations on the body; the rounding of u = ū − ū_0 leaves a thrust of 1e-16 at level 5.
            assert_relative_eq!(other, two, epsilon = 1e-13 * scale);
        }
    }

    /// In free fall the energy, and the linear momentum grows by m g t along z.
    #[test]
    fn prop_free_fall_keeps_the_energy((start, _) in body(), vehicle in vehicle()) {
        let drift = drift::<FamilyTwo>(&vehicle, start, false, 256);
        let scale = invariants(&RigidBody::of(&vehicle), &start).amax() + vehicle.weight();
        // As above at h ω = 0.035.
        prop_assert!(drift[0].abs() < 1e-6 * scale, "{drift}");
        prop_assert!(drift.fixed_rows::<2>(1).amax() < 1e-6 * scale, "{drift}");
        prop_assert!((drift[3] - vehicle.weight()).abs() < 1e-6 * scale, "{drift}");
        prop_assert!(drift.fixed_rows::<3>(4).amax() < 1e-6 * scale, "{drift}");
    }

    /// The gyroscopic torque turns the momentum and does no work.
    #[test]
    fn exact_gyroscopic_torque_does_no_work(rates in family_tests::vector(10.0), momentum in -1.0..1.0_f64) {
        // Two products that cancel.
        prop_assert!(gyroscopic_torque(&rates, momentum).dot(&rates).abs() < 1e-13);
    }

    /// Drag takes energy out, in still air and whatever the attitude.
    #[test]
    fn prop_drag_takes_energy((start, _) in body(), vehicle in vehicle()) {
        let on = PhenomenonSet::none().with(Phenomenon::Drag);
        let model = quad_dynamics::Level2::<f64>::build(&vehicle, &on).unwrap();
        let input = no_thrust(&vehicle, false);
        let state = model.adopt(&idle(start), &input);
        let end = fly(&model, state, &input, 0.1, 100);
        let body = RigidBody::of(&vehicle);
        prop_assert!(body.energy(&end.body) < body.energy(&start));
    }
}
