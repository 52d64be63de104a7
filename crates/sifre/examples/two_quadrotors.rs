//! Two quadrotors and a ground station: alpha flies a lap at level 5 and changes to level 3 on the way, bravo follows it at
//! level 3, the station keeps its beam on alpha.
//!
//! Prints a short report and writes the recording as CSV, Parquet or JSON lines, by the ending of the file:
//! `cargo run -p sifre --example two_quadrotors -- target/two_quadrotors.csv`.

use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, C3, Settings, TiltLaw, Waypoint};
use sifre::black_box::{CsvBox, JsonLinesBox, ParquetBox};
use sifre::quadrotor::{LevelChoice, Script, Setup, Start};
use sifre::{
    Engine, Ets as _, EtsSetup, Facing, Follow, GimballedEts, Member, Mission, ModelQuadrotor, Progress,
    Schedule, StopCondition, steps,
};
use std::error::Error;
use std::fs::File;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Duration of the flight, s.
const DURATION_S: f64 = 16.0;

/// Corners of the lap in W, m; z points down.
const CORNERS: [[f64; 3]; 5] = [
    [4.0, -2.0, -1.5],
    [6.0, -2.0, -2.0],
    [6.0, 2.0, -2.0],
    [4.0, 2.0, -1.5],
    [4.0, -2.0, -1.5],
];

fn lap() -> Vec<Waypoint> {
    let corner = |(k, &position_m): (usize, &[f64; 3])| Waypoint {
        time_s: 4.0 * k as f64,
        position_m,
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    };
    CORNERS.iter().enumerate().map(corner).collect()
}

/// The three agents, each at its own step.
fn members() -> Result<Vec<Member>, Box<dyn Error>> {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let settings = Settings::default();
    let gravity = vehicle.environment.gravity;

    let c3 = AnyController::C3(C3::new(&vehicle, &settings)?.into());
    let mission = Facing::agent(Mission::through(&lap(), gravity, TiltLaw::Exact)?, "station");
    let alpha = Setup {
        start: Start {
            position_m: CORNERS[0],
            yaw_rad: 2.7,
        },
        script: Script {
            wind_m_s: Schedule::new([(2.0, [0.0, 1.5, 0.0])])?,
            level: Schedule::new([(8.0, LevelChoice::from(Level::Three))])?,
            ..Script::default()
        },
        ..Setup::new("alpha", &vehicle, Level::Five, c3.clone(), mission)
    };

    let bravo = Setup {
        start: Start {
            position_m: [3.0, -3.0, -1.5],
            yaw_rad: 0.0,
        },
        ..Setup::new(
            "bravo",
            &vehicle,
            Level::Three,
            c3,
            Follow::agent("alpha", [-1.0, -1.0, 0.0], 0.0),
        )
    };

    let station = EtsSetup {
        pan_rad: -0.4,
        tilt_rad: 0.3,
        ..EtsSetup::nominal("station", "alpha")
    };
    Ok(vec![
        Member::new(ModelQuadrotor::new(alpha)?, steps::QUADROTOR.step),
        Member::new(ModelQuadrotor::new(bravo)?, steps::QUADROTOR.step),
        Member::new(GimballedEts::new(station), steps::ETS.step),
    ])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = Engine::new(members()?)?;
    simulation.stop_when(StopCondition::below_ground())?;
    if let Some(path) = std::env::args().nth(1) {
        let (file, every) = (File::create(&path)?, steps::BLACK_BOX.step);
        match path.rsplit('.').next() {
            Some("parquet") => simulation.attach(every, ParquetBox::new(file))?,
            Some("jsonl") => simulation.attach(every, JsonLinesBox::new(file))?,
            _ => simulation.attach(every, CsvBox::new(file))?,
        };
    }

    println!(" t, s  alpha's level  x, m    y, m    z, m   bravo behind, m  received, W");
    for second in 1..=16 {
        // A callback like this is also where Ctrl-C would be asked about.
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let report = simulation.run(DURATION_S / 16.0 * f64::from(second), &mut go_on)?;
        if !report.status.is_completed() {
            println!("the flight ended at {} s: {}", report.time_s, report.status);
            break;
        }
        let (Some(alpha), Some(bravo), Some(station)) = (
            simulation.agent::<ModelQuadrotor>("alpha"),
            simulation.agent::<ModelQuadrotor>("bravo"),
            simulation.agent::<GimballedEts>("station"),
        ) else {
            break;
        };
        let (a, b) = (alpha.flight().position, bravo.flight().position);
        println!(
            "{:5.1}  {:>13}  {:6.2}  {:6.2}  {:6.2}  {:15.3}  {:11.3}",
            report.time_s,
            alpha.level().number(),
            a.x,
            a.y,
            a.z,
            (a - b).norm(),
            station.link().power.received,
        );
    }
    simulation.finish_recordings()?;
    println!("\nWhat happened:");
    for event in simulation.events() {
        println!(
            "{:6.3} s  {:8} {:?}",
            event.time_ns as f64 / 1e9,
            event.agent,
            event.what
        );
    }
    Ok(())
}
