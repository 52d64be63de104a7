use super::*;
use proptest::prelude::*;
use quad_dynamics::{Level2, PhenomenonSet, QuadrotorModel, Vehicle};
use quad_kinematics::EulerAngles;
use quad_math::Taylor3;

/// What is known of a smooth attitude history at one instant: `η, η̇, η̈`, and the flight it makes.
#[derive(Clone, Copy, Debug)]
struct Instant {
    eta: [Vector3<f64>; 3],
    flight: Flight<f64>,
}

fn instant() -> impl Strategy<Value = Instant> {
    prop::collection::vec(-1.0..1.0, 9).prop_map(|x: Vec<f64>| {
        // Any roll and yaw, pitch up to 80°, where its cosine is above the floor; rates and accelerations of
        // a tumbling vehicle.
        let eta = [
            Vector3::new(3.1 * x[0], 1.4 * x[1], 3.1 * x[2]),
            Vector3::new(x[3], x[4], x[5]) * 5.0,
            Vector3::new(x[6], x[7], x[8]) * 50.0,
        ];
        let vehicle = Vehicle::qball_x4();
        let model = Level2::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
        let mut flight = model.flight(&model.hover(Vector3::zeros(), 0.0).state);
        flight.attitude = EulerAngles::from_vector(&eta[0]);
        flight.rotation = flight.attitude.rotation();
        flight.body_rates = flight.attitude.body_rate_matrix() * eta[1];
        Instant { eta, flight }
    })
}

/// Rounding of some ten operations, divided by a cosine of 0.17, on numbers of this size.
fn close(ours: &Matrix3<f64>, theirs: &Matrix3<f64>, size: f64) -> bool {
    (ours - theirs).amax() < 1e-13 * size
}

proptest! {
    #[test]
    fn agree_euler_kinematics_with_automatic_differentiation(at in instant()) {
        let [eta, rates, accelerations] = at.eta;
        let series = |i: usize| Taylor3::new(eta[i], rates[i], accelerations[i], 0.0);
        let w = EulerAngles::new(series(0), series(1), series(2)).body_rate_matrix();
        let ours = EulerKinematics::of(&at.flight);
        prop_assert!((ours.rates - rates).amax() < 1e-12, "{} {rates}", ours.rates);
        prop_assert!(close(&ours.first_derivative(), &w.map(|x| x.v1), 10.0));
        // Squares of rates and accelerations, up to 100 1/s².
        prop_assert!(close(&ours.second_derivative(&accelerations), &w.map(|x| x.v2), 200.0));
    }

    #[test]
    fn prop_euler_kinematics_go_both_ways(at in instant(), v in prop::array::uniform3(-10.0..10.0)) {
        let ours = EulerKinematics::of(&at.flight);
        let v = Vector3::from(v);
        let there = ours.body_rates(&v);
        prop_assert!((there - at.flight.attitude.body_rate_matrix() * v).amax() < 1e-13);
        prop_assert!((ours.euler_rates(&there) - v).amax() < 1e-12);
    }

    #[test]
    fn prop_heading_is_that_of_the_attitude(at in instant()) {
        let (sin, cos) = at.eta[0].z.sin_cos();
        let heading = Heading::of(&at.flight);
        prop_assert!((heading.sin - sin).abs() < 1e-14 && (heading.cos - cos).abs() < 1e-14);
    }

    #[test]
    fn exact_tilt_makes_the_demanded_acceleration(at in instant(), a in prop::array::uniform3(-4.0..4.0)) {
        // Thrust along −z_B whose vertical part balances `up` accelerates by `a` in the horizontal.
        let (g, up) = (9.81, 9.81 - a[2]);
        let [roll, pitch] = tilt_errors([a[0], a[1]], up, &at.flight, g);
        let eta = &at.flight.attitude;
        let r = EulerAngles::new(eta.roll + roll, eta.pitch + pitch, at.eta[0].z).rotation().matrix;
        let thrust = up / r.m33;
        prop_assert!((-thrust * r.m13 - a[0]).abs() < 1e-12 && (-thrust * r.m23 - a[1]).abs() < 1e-12);
    }
}
