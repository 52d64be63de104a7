//! A hovering vehicle in a wind of 5 m/s: how far it is carried at each level, which level is enough, and why.
//!
//!     cargo run -p study --example what_separates_levels

use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, BuildError, Input, Level, PhenomenonSet, Vehicle};
use quad_math::FixedStep;
use std::error::Error;
use study::attribution::Parts;
use study::selection::{Answer, Tolerance, select};

const WIND_M_S: f64 = 5.0;
const STEP_S: f64 = 0.01;
const STEPS: u32 = 200;

/// Distance downwind, m, after two seconds with the commands of hover.
fn carried(level: Level, phenomena: &PhenomenonSet) -> Result<f64, BuildError> {
    let vehicle = Vehicle::qball_x4();
    let mut quadrotor = AnyQuadrotor::<f64>::hovering(level, &vehicle, phenomena, Vector3::zeros(), 0.0)?;
    let wind = Vector3::new(WIND_M_S, 0.0, 0.0);
    let input = Input::in_wind(quadrotor.hover_input().commands, wind);
    for _ in 0..STEPS {
        quadrotor.step(FixedStep::Rk4, &input, STEP_S);
    }
    Ok(quadrotor.flight().position.x)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut answers = Vec::new();
    for level in Level::ALL {
        let distance = carried(level, &level.phenomena())?;
        println!("{level}: carried {distance:.4} m");
        answers.push(Answer {
            level,
            values: vec![distance],
            price: f64::from(level.number()),
        });
    }
    let tolerance = Tolerance {
        absolute: 0.01,
        relative: 0.0,
    };
    println!("to 1 cm, {} is enough", select(&answers, tolerance)?.dependable);

    for (lower, upper) in Level::ALL.into_iter().zip(Level::ALL.into_iter().skip(1)) {
        let why = Parts::between_levels(lower, upper).attribute(carried)?;
        println!("from {lower} to {upper}: {:+.4} m", why.difference());
        for share in &why.shares {
            println!("    {:28} {:+.4} m", share.part.to_string(), share.shapley);
        }
    }
    Ok(())
}
