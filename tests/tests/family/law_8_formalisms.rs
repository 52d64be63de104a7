//! Law 8: Newton-Euler and Euler-Lagrange give the same accelerations, and the matrices of the Lagrangian
//! form are what the kinetic energy says.

use approx::assert_relative_eq;
use family_tests::{attitude, vector, vehicle};
use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual64, HyperDual64};
use proptest::prelude::*;
use quad_dynamics::{RigidBody, RigidBodyState, Vehicle, Wrench};
use quad_kinematics::{EulerAngles, EulerRates};
use quad_math::{Real, constant};

/// A state in Euler angles, and what acts on it.
#[derive(Clone, Copy, Debug)]
struct Motion {
    attitude: EulerAngles<f64>,
    rates: EulerRates<f64>,
    velocity: Vector3<f64>,
    wrench: Wrench<f64>,
}

fn motion() -> impl Strategy<Value = Motion> {
    let wrench = (vector(20.0), vector(1.0));
    (attitude(), vector(5.0), vector(10.0), wrench).prop_map(
        |(attitude, rates, velocity, (force, moment))| Motion {
            attitude,
            rates: EulerRates::from_vector(&rates),
            velocity,
            wrench: Wrench { force, moment },
        },
    )
}

/// Kinetic energy of rotation, J: `½ ωᵀ I ω` with `ω = J⁻¹(η) η̇`.
fn kinetic_energy<R: Real>(inertia: &Matrix3<f64>, angles: &Vector3<R>, rates: &Vector3<R>) -> R {
    let omega = EulerAngles::from_vector(angles).body_rate_matrix() * rates;
    omega.dot(&(inertia.map(constant::<R>) * omega)) * constant(0.5)
}

/// Angles or rates whose first part moves along `a` and second along `b`.
fn moving(at: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> Vector3<HyperDual64> {
    Vector3::from_fn(|i, _| HyperDual64::new(at[i], a[i], b[i], 0.0))
}

fn unit(i: usize) -> Vector3<f64> {
    Vector3::ith(i, 1.0)
}

/// `M_ij = ∂²T/∂η̇_i ∂η̇_j`.
fn mass_matrix_by_energy(inertia: &Matrix3<f64>, motion: &Motion) -> Matrix3<f64> {
    let (eta, rates, zero) = (motion.attitude.vector(), motion.rates.vector(), Vector3::zeros());
    Matrix3::from_fn(|i, j| {
        let angles = moving(&eta, &zero, &zero);
        kinetic_energy(inertia, &angles, &moving(&rates, &unit(i), &unit(j))).eps1eps2
    })
}

/// `C η̇` as Lagrange's equations leave it: `d/dt(∂T/∂η̇) − ∂T/∂η` at `η̈ = 0`.
fn coriolis_terms_by_energy(inertia: &Matrix3<f64>, motion: &Motion) -> Vector3<f64> {
    let (eta, rates, zero) = (motion.attitude.vector(), motion.rates.vector(), Vector3::zeros());
    Vector3::from_fn(|i, _| {
        // Along the flow the angles move with their rates.
        let along = kinetic_energy(
            inertia,
            &moving(&eta, &zero, &rates),
            &moving(&rates, &unit(i), &zero),
        );
        let across = kinetic_energy(
            inertia,
            &moving(&eta, &unit(i), &zero),
            &moving(&rates, &zero, &zero),
        );
        along.eps1eps2 - across.eps1
    })
}

/// `Ṁ` along the flow.
fn mass_matrix_rate(vehicle: &Vehicle, motion: &Motion) -> Matrix3<f64> {
    let (eta, rates) = (motion.attitude.vector(), motion.rates.vector());
    let angles = EulerAngles::from_vector(&eta.zip_map(&rates, Dual64::new));
    RigidBody::<Dual64>::of(vehicle)
        .euler_mass_matrix(&angles)
        .map(|m| m.eps)
}

/// Rounding of a hundred operations on numbers of the size given, `1/cos² θ ≤ 35` near the singularity.
fn rounding(size: f64) -> f64 {
    1e-12 * size
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Forms 1 and 2 against the translation of Newton-Euler.
    #[test]
    fn agree_translation_in_three_ways(vehicle in vehicle(), motion in motion()) {
        let body = RigidBody::<f64>::of(&vehicle);
        let omega = motion.attitude.body_rates(&motion.rates);
        let state = RigidBodyState {
            position: Vector3::zeros(),
            velocity: motion.velocity,
            attitude: motion.attitude.quaternion(),
            body_rates: omega,
        };
        let newton = body.derivative(&state, &motion.wrench).velocity;
        let size = rounding(newton.amax() + omega.norm() * motion.velocity.norm());
        let Wrench { force, .. } = motion.wrench;
        let form_2 = body.lagrange_body_velocity_rate(&motion.attitude, &motion.velocity, &omega, &force);
        assert_relative_eq!(form_2, newton, epsilon = size);
        let r_wb = motion.attitude.rotation().matrix;
        let form_1 = body.lagrange_inertial_acceleration(&(r_wb * force));
        // v̇_W = R (v̇_B + ω × v_B).
        assert_relative_eq!(form_1, r_wb * (newton + omega.cross(&motion.velocity)), epsilon = size);
    }

    /// Form 3 against `η̈ = J ω̇ + J̇ ω` with `ω̇` of Newton-Euler.
    #[test]
    fn agree_rotation_in_two_ways(vehicle in vehicle(), motion in motion()) {
        let body = RigidBody::<f64>::of(&vehicle);
        let omega = motion.attitude.body_rates(&motion.rates);
        let acceleration = body.angular_acceleration(&omega, &motion.wrench.moment);
        let angles = motion.attitude.vector().zip_map(&motion.rates.vector(), Dual64::new);
        let j = EulerAngles::from_vector(&angles).rate_matrix();
        let newton = j.map(|x| x.re) * acceleration + j.map(|x| x.eps) * omega;
        let lagrange = body.lagrange_euler_acceleration(&motion.attitude, &motion.rates, &motion.wrench.moment);
        // J and M⁻¹ are large near the singularity: their terms cancel there, so the parts give the size.
        let cos = motion.attitude.pitch.cos();
        let parts = acceleration.amax() + omega.norm() * motion.rates.vector().norm();
        let spread = body.inertia.norm() * body.inertia_inverse.norm();
        assert_relative_eq!(lagrange, newton, epsilon = rounding(parts * spread / (cos * cos)));
    }

    #[test]
    fn exact_mass_matrix_by_automatic_differentiation(vehicle in vehicle(), motion in motion()) {
        let body = RigidBody::<f64>::of(&vehicle);
        let by_energy = mass_matrix_by_energy(&body.inertia, &motion);
        let tolerance = rounding(body.inertia.norm());
        assert_relative_eq!(body.euler_mass_matrix(&motion.attitude), by_energy, epsilon = tolerance);
    }

    #[test]
    fn exact_coriolis_terms_by_automatic_differentiation(vehicle in vehicle(), motion in motion()) {
        let body = RigidBody::<f64>::of(&vehicle);
        let by_energy = coriolis_terms_by_energy(&body.inertia, &motion);
        let rates = motion.rates.vector();
        let terms = body.euler_coriolis_matrix(&motion.attitude, &motion.rates) * rates;
        let tolerance = rounding(body.inertia.norm() * rates.norm_squared());
        assert_relative_eq!(terms, by_energy, epsilon = tolerance);
    }

    /// `Ṁ − 2C` is skew-symmetric: the Coriolis terms do no work.
    #[test]
    fn prop_mass_rate_minus_twice_coriolis_is_skew(vehicle in vehicle(), motion in motion()) {
        let body = RigidBody::<f64>::of(&vehicle);
        let c = body.euler_coriolis_matrix(&motion.attitude, &motion.rates);
        let n = mass_matrix_rate(&vehicle, &motion) - c * 2.0;
        let tolerance = rounding(body.inertia.norm() * motion.rates.vector().norm());
        assert_relative_eq!(n, -n.transpose(), epsilon = tolerance);
    }

    /// `M` is symmetric and positive definite away from the singularity.
    #[test]
    fn prop_mass_matrix_is_positive_definite(vehicle in vehicle(), motion in motion()) {
        let m = RigidBody::<f64>::of(&vehicle).euler_mass_matrix(&motion.attitude);
        assert_relative_eq!(m, m.transpose(), epsilon = rounding(m.norm()));
        prop_assert!(m.cholesky().is_some());
    }
}
