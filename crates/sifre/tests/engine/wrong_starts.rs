//! Filters with a wrong initial estimate.

use crate::support::{c3, ms, run_recorded, vehicle};
use nalgebra::Vector3;
use quad_dynamics::Level;
use quad_estimation::sensor::SensorSuite;
use quad_ndi::Reference;
use sifre::quadrotor::{
    EstimateUse, Estimation, EstimationSetupError, InitialError, QuadrotorError, Setup, Start, VectorError,
};
use sifre::{Engine, Member, ModelQuadrotor};

/// Two metres up, heading east, to the north at 2 m/s, watched by a filter without sensors.
fn quadrotor(error: InitialError, seed: u64) -> Result<ModelQuadrotor, QuadrotorError> {
    let vehicle = vehicle();
    let blind = SensorSuite::new([]).expect("no sensor is wrong");
    let at = [1.0, 0.0, -2.0];
    ModelQuadrotor::new(Setup {
        start: Start {
            position_m: at,
            yaw_rad: std::f64::consts::FRAC_PI_2,
        },
        velocity_m_s: [2.0, 0.0, 0.0],
        estimation: Some(Estimation {
            used: EstimateUse::Beside,
            error,
            ..Estimation::new(Level::Two, blind, seed)
        }),
        ..Setup::new(
            "alpha",
            &vehicle,
            Level::Three,
            c3(&vehicle),
            Reference::hold(at.into(), 0.0),
        )
    })
}

/// Estimate less flight at the start.
struct First {
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    attitude: Vector3<f64>,
}

fn first(error: InitialError, seed: u64) -> First {
    let quadrotor = quadrotor(error, seed).expect("a valid setup");
    let mut simulation = Engine::new(vec![Member::new(quadrotor, ms(2.0))]).expect("one agent");
    let (_, flown) = run_recorded(&mut simulation, 0.0);
    let difference = |what: &str, ends: [&str; 3]| {
        let at = |of: &str, end: &str| {
            let name = format!("alpha.{of}{what}.{end}");
            flown.column(&name).expect("a channel").next().expect("a row")
        };
        Vector3::from(ends.map(|end| at("estimate.", end) - at("", end)))
    };
    First {
        position: difference("position", ["x", "y", "z"]),
        velocity: difference("velocity", ["x", "y", "z"]),
        attitude: difference("attitude", ["roll", "pitch", "yaw"]),
    }
}

/// A wrong initial estimate is used as given: position and velocity along W, the attitude about B, each whatever the others are.
#[test]
fn exact_fixed_errors_are_believed() {
    let heading = InitialError {
        position_m: VectorError::Fixed([1.0, -2.0, 0.5]),
        velocity_m_s: VectorError::Fixed([0.3, 0.0, -0.1]),
        attitude_rad: VectorError::Fixed([0.0, 0.0, 0.2]),
    };
    let told = first(heading, 1);
    // Rounding of numbers of one.
    assert!((told.position - Vector3::new(1.0, -2.0, 0.5)).norm() < 1e-12);
    assert!((told.velocity - Vector3::new(0.3, 0.0, -0.1)).norm() < 1e-12);
    assert!((told.attitude - Vector3::new(0.0, 0.0, 0.2)).norm() < 1e-12);
    let roll = InitialError {
        attitude_rad: VectorError::Fixed([0.2, 0.0, 0.0]),
        ..InitialError::default()
    };
    let told = first(roll, 1);
    assert!((told.attitude - Vector3::new(0.2, 0.0, 0.0)).norm() < 1e-12);
    assert!(told.position.norm() < 1e-12 && told.velocity.norm() < 1e-12);
    let right = first(InitialError::default(), 1);
    assert!(right.position.norm() + right.velocity.norm() + right.attitude.norm() < 1e-12);
}

/// Drawn errors have the deviation that they are drawn with, on each axis, and are those of their seed whatever else is drawn.
#[test]
fn exact_drawn_errors_have_their_deviation() {
    let drawn = InitialError {
        position_m: VectorError::Drawn(2.0),
        velocity_m_s: VectorError::Drawn(0.5),
        attitude_rad: VectorError::Drawn(0.01),
    };
    let n = 300;
    let mut squares = [Vector3::zeros(); 3];
    for seed in 0..n {
        let told = first(drawn, seed);
        for (sum, error) in squares
            .iter_mut()
            .zip([told.position, told.velocity, told.attitude])
        {
            *sum += error.component_mul(&error);
        }
    }
    for (sum, deviation) in squares.iter().zip([2.0, 0.5, 0.01]) {
        for square in sum.iter() {
            let measured = f64::sqrt(square / n as f64);
            // The standard error of a deviation from n is 1/√(2n) = 4.1 %; four of them for nine numbers.
            assert!((measured / deviation - 1.0).abs() < 0.164, "{measured}");
        }
    }
    let alone = InitialError {
        velocity_m_s: VectorError::Drawn(0.5),
        ..InitialError::default()
    };
    let difference = first(alone, 7).velocity - first(drawn, 7).velocity;
    // The tilt that is drawn too turns the velocity to B and back: rounding.
    assert!(difference.norm() < 1e-12);
    assert!((first(drawn, 7).position - first(drawn, 8).position).norm() > 1e-3);
}

#[test]
fn exact_errors_that_are_none_are_refused() {
    let position = |position_m| InitialError {
        position_m,
        ..InitialError::default()
    };
    for (error, said) in [
        (position(VectorError::Drawn(-1.0)), "not negative, got -1"),
        (position(VectorError::Drawn(f64::NAN)), "position"),
        (position(VectorError::Fixed([0.0, f64::INFINITY, 0.0])), "inf"),
    ] {
        let refused = quadrotor(error, 1).unwrap_err();
        let QuadrotorError::Estimation { source, .. } = &refused else {
            panic!("{refused}");
        };
        assert!(matches!(**source, EstimationSetupError::Error(_)), "{refused}");
        assert!(refused.to_string().contains(said), "{refused}");
    }
}
