//! A target crosses the station's field, is hidden behind a wall for two seconds, and is found again.
//!
//! Prints the mode of the tracker, the image error and where the power goes, twice a second.

use ets::{Ets, EtsInput, FrameClock, Station};
use nalgebra::{Vector2, Vector3};
use quad_kinematics::EulerAngles;

/// Duration, s, and steps per second.
const DURATION_S: f64 = 10.0;
const STEPS_PER_SECOND: u64 = 1000;

/// The sensor's centre flies east at 0.6 m/s, 4 m north and 1.5 m above the station.
fn sensor(t: f64) -> Vector3<f64> {
    Vector3::new(4.0, -3.0 + 0.6 * t, -1.5)
}

fn is_hidden(t: f64) -> bool {
    (3.0..5.0).contains(&t)
}

fn main() -> Result<(), ets::ClockError> {
    let station = Station::nominal();
    let ets = Ets::<f64>::new(&station);
    let clock = FrameClock::new(
        1.0 / STEPS_PER_SECOND as f64,
        station.frames.rate,
        station.frames.latency,
    )?;
    let mut state = ets.at_rest(-0.6, 0.3);
    println!("{}\n", station.description);
    println!(" t, s  mode       image error, px   incidence, deg   received, W   missed, W");
    for n in 0..=(DURATION_S as u64 * STEPS_PER_SECOND) {
        let t = n as f64 * clock.step_s();
        let target = sensor(t);
        if n % (STEPS_PER_SECOND / 2) == 0 {
            // The vehicle turns its nose, and the sensor, to the station.
            let r_wb = EulerAngles::level((-target.y).atan2(-target.x)).rotation().matrix;
            let centre_of_mass = target - r_wb * Vector3::from(ets.receiver.offset);
            let link = ets.link(&state.gimbal, &ets.receiver.on(&centre_of_mass, &r_wb));
            println!(
                "{t:5.1}  {:9}  {:15.2}   {:14.1}   {:11.3}   {:9.3}",
                format!("{:?}", state.sight.mode(&station.tracker)),
                ets.view(&state.gimbal, &target).point.norm(),
                link.geometry.incidence.to_degrees(),
                link.power.received,
                link.power.missed,
            );
        }
        // A wall is as good as a target behind the camera.
        let shown = if is_hidden(t) {
            -ets.axis(&state.gimbal)
        } else {
            target
        };
        let input = EtsInput {
            target: shown,
            noise: Vector2::zeros(),
        };
        state = ets.step(&clock, n, &state, &input);
    }
    Ok(())
}
