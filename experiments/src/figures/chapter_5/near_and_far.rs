//! To a station and away again, recorded: the flight of figure beyond.2.

use crate::figures::flight_settings;
use crate::item::ItemError;
use quad_dynamics::{Level, Resolution, Vehicle};
use quad_ndi::{AnyController, C1, TiltLaw, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{LevelRule, Script, Setup, Start};
use sifre::{Engine, Event, Member, Mission, ModelQuadrotor, Recording, Target, steps};
use std::sync::Arc;

/// Duration, s.
const END_S: f64 = 40.0;
/// Where it starts in W, m.
const FAR: [f64; 3] = [-12.0, 0.0, -2.0];
/// Where the station is in W, m.
pub(super) const STATION: [f64; 3] = [0.0, 0.0, -2.0];

/// A recorded flight.
pub(super) struct Flight {
    recording: Recording,
    pub(super) events: Vec<Event>,
}

/// Flies there and back under a rule, or at level 5 throughout.
pub(super) fn fly(vehicle: &Arc<Vehicle>, rule: Option<LevelRule>) -> Result<Flight, ItemError> {
    let at = |time_s, x| Waypoint {
        time_s,
        position_m: [x, FAR[1], FAR[2]],
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    };
    let points = [at(0.0, FAR[0]), at(16.0, -1.0), at(24.0, -1.0), at(END_S, FAR[0])];
    let mission = Mission::through(&points, vehicle.environment.gravity, TiltLaw::SmallAngle)?;
    let pilot = AnyController::C1(C1::new(vehicle, &flight_settings())?.into());
    let setup = Setup {
        start: Start {
            position_m: FAR,
            yaw_rad: 0.0,
        },
        script: Script {
            rule,
            ..Script::default()
        },
        ..Setup::new("a", vehicle, Level::Five, pilot, mission)
    };
    let step = steps::QUADROTOR.step;
    let station = Target::fixed("station", STATION.into());
    let mut simulation = Engine::new(vec![
        Member::new(ModelQuadrotor::new(setup)?, step),
        Member::new(station, step),
    ])?;
    let id = simulation.attach(step, MemoryBox::default())?;
    simulation.run(END_S, &mut ())?;
    let events = simulation.events().to_vec();
    let memory = simulation
        .detach::<MemoryBox>(id)
        .ok_or_else(|| ItemError::new("no black box"))??;
    Ok(Flight {
        recording: memory.recording,
        events,
    })
}

impl Flight {
    /// A column of the recording.
    pub(super) fn column(&self, name: &str) -> Vec<f64> {
        self.recording
            .column(&format!("a.{name}"))
            .map(Iterator::collect)
            .unwrap_or_default()
    }

    /// Three columns as rows.
    pub(super) fn vectors(&self, name: &str) -> Vec<nalgebra::Vector3<f64>> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| self.column(&format!("{name}.{axis}")));
        (0..x.len())
            .map(|k| nalgebra::Vector3::new(x[k], y[k], z[k]))
            .collect()
    }

    /// Numbers integrated: states times the four evaluations of each step.
    pub(super) fn cost(&self) -> f64 {
        let states = Level::ALL.map(|level| Resolution::of(level, &level.phenomena()).states as f64);
        self.column("level")
            .iter()
            .map(|level| 4.0 * states[*level as usize - 1])
            .sum()
    }
}
