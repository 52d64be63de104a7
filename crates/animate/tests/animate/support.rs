//! A short flight, recorded.

use animate::Scene;
use ets::Station;
use nalgebra::Vector3;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, C3, Reference, Settings};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{LevelChoice, Script, Setup, Start};
use sifre::{
    Engine, EtsSetup, Facing, GimballedEts, Member, ModelQuadrotor, Recording, Schedule, Target, steps,
};
use std::sync::Arc;

/// Duration of the flight, s.
pub(crate) const DURATION_S: f64 = 3.0;

/// When the quadrotor changes from level 5 to level 3, s.
pub(crate) const CHANGE_S: f64 = 1.5;

/// A name that is HTML.
pub(crate) const NASTY: &str = "<b>mark</b> & </script>";

/// Where the target stands in W, m.
const MARK_M: [f64; 3] = [2.5, 2.0, -0.5];

/// A station that stands elsewhere than the nominal one and looks north-east at zero pan.
pub(crate) fn station() -> Station {
    let mut station = Station::nominal();
    station.pedestal.position = [-0.5, 0.3, -1.0];
    station.pedestal.heading = 0.6;
    station
}

/// A quadrotor goes 1 m east, watched by a station that has to turn first; a target stands by.
pub(crate) fn flight() -> Recording {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let pilot = AnyController::C3(C3::new(&vehicle, &Settings::default()).unwrap().into());
    let alpha = Setup {
        start: Start {
            position_m: [3.0, -0.5, -1.5],
            yaw_rad: 3.0,
        },
        script: Script {
            level: Schedule::new([(CHANGE_S, LevelChoice::from(Level::Three))]).unwrap(),
            ..Script::default()
        },
        ..Setup::new(
            "alpha",
            &vehicle,
            Level::Five,
            pilot,
            Facing::agent(Reference::hold(Vector3::new(3.0, 0.5, -1.5), 0.0), "station"),
        )
    };
    let ets = EtsSetup {
        station: station(),
        pan_rad: -0.7,
        ..EtsSetup::nominal("station", "alpha")
    };
    let mut simulation = Engine::new(vec![
        Member::new(ModelQuadrotor::new(alpha).unwrap(), steps::QUADROTOR.step),
        Member::new(GimballedEts::new(ets), steps::ETS.step),
        Member::new(Target::fixed(NASTY, MARK_M.into()), steps::TARGET.step),
    ])
    .unwrap();
    let id = simulation
        .attach(steps::BLACK_BOX.step, MemoryBox::default())
        .unwrap();
    assert!(simulation.run(DURATION_S, &mut ()).unwrap().status.is_completed());
    simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording
}

/// The scene of [`flight`].
pub(crate) fn scene() -> Scene {
    Scene::new("A <short> flight")
        .quadrotor("alpha", 0.2)
        .ets("station", "alpha", &station())
        .target(NASTY)
}

/// One channel of a recording.
pub(crate) fn column(recording: &Recording, name: &str) -> Vec<f64> {
    recording.column(name).expect("a recorded channel").collect()
}

/// The recording with one number replaced.
pub(crate) fn with_value(recording: &Recording, channel: &str, row: usize, value: f64) -> Recording {
    let place = recording
        .channels()
        .iter()
        .position(|c| c.name == channel)
        .expect("a recorded channel");
    let mut changed = Recording::new(recording.channels().to_vec());
    for (k, old) in recording.rows().enumerate() {
        let mut values = old.values.to_vec();
        if k == row {
            values[place] = value;
        }
        changed.push(old.time_ns, &values).unwrap();
    }
    changed
}
