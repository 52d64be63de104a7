//! Eight cameras on the walls of a room, placed by differential evolution.
//!
//!     cargo run --release -p coverage --example place_cameras
//!
//! Prints where they go and how much of the volume three or more of them see, before and after.

use coverage::RoomFile;
use optim::{Evolution, EvolutionSettings, Limits, minimise};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let file = RoomFile::from_toml_str(RoomFile::TEMPLATE, "template")?;
    let (task, rig) = (file.task()?, file.wall_rig()?);
    let percent = |decision: &[f64]| -> Result<f64, Box<dyn Error>> {
        Ok(1e2 * task.coverage(&rig.cameras(decision))?.fraction)
    };
    println!("first guess: {:.1} % seen", percent(&rig.first_guess())?);

    let mut search = Evolution::new(rig.variables(), EvolutionSettings::default())?;
    let limits = Limits::evaluations(file.search.evaluations);
    let found = minimise(&mut search, |x| rig.cost(&task, x), limits)?;
    let decision = &found.best.candidate.values;
    println!("placed: {:.1} % seen; {}", percent(decision)?, found.stop);
    for camera in rig.cameras(decision) {
        let p = camera.position_m;
        let [azimuth, elevation] = [camera.azimuth_rad, camera.elevation_rad].map(f64::to_degrees);
        println!(
            "{:6.2} m north {:6.2} m east {:5.2} m up, azimuth {:4.0}°, elevation {elevation:4.0}°",
            p.x,
            p.y,
            -p.z,
            azimuth.rem_euclid(360.0)
        );
    }
    Ok(())
}
