//! Unit steps in height: the three dynamic inversions on every level they may fly, as a table.
//!
//! Prints a short report: `cargo run -p quad-ndi --example step_in_height`.

use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
use quad_math::TimeGrid;
use quad_ndi::metrics::StepMetrics;
use quad_ndi::{AnyController, C1, C2, C3, FlightPlan, FlightStatus, Flyer, Reference, Settings};
use std::error::Error;
use std::num::NonZeroU64;

/// Sampling time of the controller and step of the model, s.
const STEP_S: f64 = 1e-3;
/// Length of a flight, s: three settling times.
const END_S: f64 = 6.0;
/// Height to climb to, m; position in W points down.
const CLIMB_M: f64 = 1.0;

/// One flight at a level, with the level's own phenomena: how the height went, or when the flight broke off.
fn climb(
    vehicle: &Vehicle,
    level: Level,
    controller: AnyController<f64>,
) -> Result<Option<StepMetrics>, Box<dyn Error>> {
    let model = AnyQuadrotor::hovering(level, vehicle, &level.phenomena(), Vector3::zeros(), 0.0)?;
    let plan = FlightPlan {
        grid: TimeGrid::from_seconds(STEP_S, END_S)?,
        record_every: NonZeroU64::MIN,
    };
    let up = Reference::hold(Vector3::new(0.0, 0.0, -CLIMB_M), 0.0);
    let log = Flyer::new(vehicle, model, controller)?.fly(&plan, |_| up);
    if let FlightStatus::Diverged { time_s, .. } = log.status {
        println!("diverged at {time_s} s");
        return Ok(None);
    }
    let height: Vec<(f64, f64)> = log
        .records
        .iter()
        .map(|r| (r.time_s, -r.flight.position.z))
        .collect();
    Ok(StepMetrics::of(&height, CLIMB_M))
}

fn main() -> Result<(), Box<dyn Error>> {
    let vehicle = Vehicle::qball_x4();
    let settings = Settings::default();
    println!(
        "{}: {CLIMB_M} m up, settling time asked for {} s\n",
        vehicle.name, settings.height.settling_time_s
    );
    println!("controller  level  settled, s  overshoot, %  steady-state error, mm");
    let controllers: [(&str, AnyController<f64>); 3] = [
        ("c1", AnyController::C1(C1::new(&vehicle, &settings)?.into())),
        ("c2", AnyController::C2(C2::new(&vehicle, &settings)?.into())),
        ("c3", AnyController::C3(C3::new(&vehicle, &settings)?.into())),
    ];
    for (name, controller) in controllers {
        for level in Level::ALL
            .into_iter()
            .filter(|&level| controller.check(level).is_ok())
        {
            let Some(m) = climb(&vehicle, level, controller.clone())? else {
                continue;
            };
            let settled = m.settling_time_s.map_or("-".to_string(), |t| format!("{t:.2}"));
            println!(
                "{name:<10} {:>6} {settled:>11} {:>13.1} {:>23.1}",
                level.number(),
                100.0 * m.overshoot,
                1e3 * m.steady_state_error,
            );
        }
        println!();
    }
    println!(
        "c1 and c2 don't know the rotors' lag and settle later from level 3 on. No controller knows that the"
    );
    println!("rotors of level 5 are not linear and that their battery sags: an error remains.");
    Ok(())
}
