//! The same vehicle let go from a tilt of 10 degrees, held by its hover commands, at all five levels.
//!
//! Prints a short report: `cargo run -p quad-dynamics --example five_levels`.

use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, BuildError, Flight, Input, Level, Snapshot, Vehicle};
use quad_kinematics::EulerAngles;
use quad_math::FixedStep;

/// Tilt at the start: roll 10 degrees, right side down.
const TILT_DEGREES: f64 = 10.0;
/// Height at the start, m.
const HEIGHT_M: f64 = 10.0;
/// Time step, s; steps between the lines of the report; lines.
const STEP_S: f64 = 1e-3;
const STEPS_PER_LINE: u32 = 500;
const LINES: u32 = 4;

/// The vehicle of a level in its own hover, tilted.
fn tilted(level: Level, vehicle: &Vehicle) -> Result<(AnyQuadrotor<f64>, Input<f64>), BuildError> {
    let on = level.phenomena();
    let start = Vector3::new(0.0, 0.0, -HEIGHT_M);
    let level_flight = AnyQuadrotor::hovering(level, vehicle, &on, start, 0.0)?;
    let input = level_flight.hover_input();
    let snapshot = level_flight.snapshot(&input);
    let mut body = snapshot.body;
    body.attitude = EulerAngles::new(TILT_DEGREES.to_radians(), 0.0, 0.0).quaternion();
    let tilted = AnyQuadrotor::from_snapshot(level, vehicle, &on, &Snapshot { body, ..snapshot }, &input)?;
    Ok((tilted, input))
}

fn line(level: Level, time_s: f64, flight: &Flight<f64>) {
    let speed = flight.velocity.norm();
    println!(
        "{:>5} {time_s:>6.1} {:>9.3} {:>9.3} {:>9.3} {:>9.2}",
        level.number(),
        flight.position.y,
        -flight.position.z,
        speed,
        flight.attitude.roll.to_degrees(),
    );
}

fn main() -> Result<(), BuildError> {
    let vehicle = Vehicle::qball_x4();
    println!(
        "{} let go at {TILT_DEGREES}° of roll, commands of hover held\n",
        vehicle.name
    );
    println!("level   t, s      y, m height, m  ∣v∣, m/s   roll, °");
    for level in Level::ALL {
        let (mut quadrotor, input) = tilted(level, &vehicle)?;
        for k in 0..=LINES {
            line(level, f64::from(k * STEPS_PER_LINE) * STEP_S, &quadrotor.flight());
            for _ in 0..STEPS_PER_LINE {
                quadrotor.step(FixedStep::Rk4, &input, STEP_S);
            }
        }
        println!();
    }
    println!("Level 1 keeps its height, for its lift does not tilt; drag brakes levels 4 and 5, and the");
    println!("battery of level 5 sags from its full voltage.");
    Ok(())
}
