//! A quadrotor crosses the field of a ground station and changes from level 5 to level 3 on the way; the flight
//! becomes an animation.
//!
//! `cargo run -p animate --example flight -- target/flight.html`, then open the file in a browser. With a second
//! argument, `target/flight.png`, a Chromium on this machine draws a still as well.

use animate::{Browser, Options, Scene, Size, html};
use ets::Station;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, C3, Settings, TiltLaw, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{LevelChoice, Script, Setup, Start};
use sifre::{
    Engine, EtsSetup, Facing, GimballedEts, Member, Mission, ModelQuadrotor, Recording, Schedule, steps,
};
use std::error::Error;
use std::sync::Arc;

/// Duration of the crossing, s.
const DURATION_S: f64 = 10.0;

/// From rest to rest, past the station and up; z points down.
const ENDS: [[f64; 3]; 2] = [[4.0, -3.0, -1.2], [4.0, 3.0, -2.2]];

/// The station on a mast of 1 m.
fn station() -> Station {
    let mut station = Station::nominal();
    station.pedestal.position = [0.0, 0.0, -1.0];
    station
}

fn fly() -> Result<Recording, Box<dyn Error>> {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let pilot = AnyController::C3(C3::new(&vehicle, &Settings::default())?.into());
    let waypoint = |k: usize| Waypoint {
        time_s: DURATION_S * k as f64,
        position_m: ENDS[k],
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    };
    let mission = Mission::through(
        &[waypoint(0), waypoint(1)],
        vehicle.environment.gravity,
        TiltLaw::Exact,
    )?;
    let [x, y, _] = ENDS[0];
    let alpha = Setup {
        start: Start {
            position_m: ENDS[0],
            yaw_rad: (-y).atan2(-x),
        },
        script: Script {
            level: Schedule::new([(DURATION_S / 2.0, LevelChoice::from(Level::Three))])?,
            ..Script::default()
        },
        ..Setup::new(
            "alpha",
            &vehicle,
            Level::Five,
            pilot,
            Facing::agent(mission, "station"),
        )
    };
    let ets = EtsSetup {
        station: station(),
        pan_rad: y.atan2(x) + 0.2,
        ..EtsSetup::nominal("station", "alpha")
    };
    let mut simulation = Engine::new(vec![
        Member::new(ModelQuadrotor::new(alpha)?, steps::QUADROTOR.step),
        Member::new(GimballedEts::new(ets), steps::ETS.step),
    ])?;
    let id = simulation.attach(steps::BLACK_BOX.step, MemoryBox::default())?;
    simulation.run(DURATION_S, &mut ())?;
    let memory = simulation
        .detach::<MemoryBox>(id)
        .ok_or("the black box is gone")??;
    Ok(memory.recording)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().unwrap_or_else(|| "target/flight.html".into());
    let scene = Scene::new("A crossing of the station's field")
        .quadrotor("alpha", 0.2)
        .ets("station", "alpha", &station());
    let page = html(&fly()?, &scene, &Options::default())?;
    std::fs::write(&file, &page)?;
    println!("{file}: {} kB", page.len() / 1000);
    if let Some(still) = arguments.next() {
        let browser = Browser::find().ok_or("no Chromium in the path: name one in CHROMIUM")?;
        let size = Size {
            width: 1200,
            height: 700,
            scale: 2.0,
        };
        std::fs::write(&still, browser.screenshot(&page, "t=4&still=1", size)?)?;
        println!("{still}: as at 4 s");
    }
    Ok(())
}
