//! Kicks and the process noise that gives them.

use super::qball;
use crate::*;
use approx::assert_relative_eq;
use nalgebra::Vector3;

/// A kick along W and B changes the motion by itself, at every level and any attitude, and nothing else.
#[test]
fn exact_kicks_change_velocity_and_rates() {
    let vehicle = qball();
    let kick = Kick {
        velocity: Vector3::new(0.1, -0.2, 0.3),
        body_rates: Vector3::new(-0.4, 0.5, 0.6),
    };
    for level in Level::ALL {
        let none = PhenomenonSet::none();
        let mut quadrotor =
            AnyQuadrotor::<f64>::hovering(level, &vehicle, &none, Vector3::new(1.0, 2.0, -3.0), 0.7).unwrap();
        let input = Input::still_air([0.03, 0.02, 0.025, 0.028]);
        for _ in 0..200 {
            quadrotor.step(quad_math::FixedStep::Rk4, &input, 1e-3);
        }
        let before = quadrotor.flight();
        quadrotor.kick(&kick);
        let after = quadrotor.flight();
        assert!(before.attitude.roll.abs() > 0.01);
        assert_relative_eq!(after.velocity - before.velocity, kick.velocity, epsilon = 1e-14);
        assert_relative_eq!(
            after.body_rates - before.body_rates,
            kick.body_rates,
            epsilon = 1e-13
        );
        assert_eq!(
            (after.position, after.attitude),
            (before.position, before.attitude)
        );
    }
}

/// The kicks of a second add up to the variance σ² whatever the step.
#[test]
fn exact_process_noise_gathers_with_time() {
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::Distribution;
    let noise = ProcessNoise {
        acceleration: 0.5,
        angular_acceleration: 2.0,
    };
    let mut generator = rand_chacha::ChaCha8Rng::seed_from_u64(1);
    let mut vector = || Vector3::from_fn(|_, _| rand_distr::StandardNormal.sample(&mut generator));
    for steps in [10, 50] {
        let seconds = 2000;
        let (mut linear, mut angular) = (0.0, 0.0);
        for _ in 0..seconds {
            let (mut v, mut w) = (Vector3::zeros(), Vector3::zeros());
            for _ in 0..steps {
                let kick = noise.kick(1.0 / f64::from(steps), [vector(), vector()]);
                v += kick.velocity;
                w += kick.body_rates;
            }
            linear += v.norm_squared() / 3.0;
            angular += w.norm_squared() / 3.0;
        }
        // 6000 squares know a variance to √(2/6000) = 1.8 %; three of these.
        assert_relative_eq!(linear / f64::from(seconds), 0.25, max_relative = 0.055);
        assert_relative_eq!(angular / f64::from(seconds), 4.0, max_relative = 0.055);
    }
}
