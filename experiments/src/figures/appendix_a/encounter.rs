//! Quadrotors that fly past a ground station each, facing it.

use crate::figures::appendix_g::crossing::controller;
use crate::flight::{NOMINAL_VEHICLE, load_vehicle};
use crate::item::{Context, ItemError};
use crate::station::{NOMINAL_STATION, load_station};
use animate::Scene;
use ets::Station;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::Waypoint;
use serde::Serialize;
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Setup, Start};
use sifre::{Engine, EtsSetup, Facing, GimballedEts, Member, Mission, ModelQuadrotor, Recording, steps};
use std::sync::Arc;

/// Duration of the flight, s.
const DURATION_S: f64 = 12.0;

/// The path about the station, at equal times: bearing from it, degrees; height over the ground, m.
const PATH: [[f64; 2]; 4] = [[-55.0, 1.0], [-20.0, 2.1], [20.0, 1.3], [55.0, 2.3]];

/// Distance from the station, m.
const DISTANCE_M: f64 = 3.6;

/// How far the station looks aside at the start, rad: the quadrotor is inside its field of view, half of which is 25.6°.
const ASIDE_RAD: f64 = 0.25;

/// A quadrotor and its station.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pair {
    /// Name of the quadrotor.
    pub(super) quadrotor: &'static str,
    /// Its level.
    pub(super) level: Level,
    /// Name of the station.
    pub(super) station: &'static str,
    /// Where the gimbal's axes cross in W, m.
    pub(super) position_m: [f64; 3],
}

/// One quadrotor at level 5 and one station on a mast of 1 m.
pub(super) const ONE: Pair = Pair {
    quadrotor: "Quad",
    level: Level::Five,
    station: "ETS",
    position_m: [0.0, 0.0, -1.0],
};

/// What determines the flight.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Encounter {
    vehicle: &'static str,
    station: &'static str,
    duration_s: f64,
    distance_m: f64,
    bearing_deg_and_height_m: [[f64; 2]; 4],
    looks_aside_rad: f64,
    pub(super) pairs: Vec<Pair>,
}

/// A flight with what it was flown with.
pub(super) struct Flown {
    pub(super) encounter: Encounter,
    pub(super) recording: Recording,
    vehicle: Arc<Vehicle>,
    nominal: Station,
}

impl Encounter {
    /// The flight of these pairs.
    pub(super) fn of(pairs: Vec<Pair>) -> Self {
        Self {
            vehicle: NOMINAL_VEHICLE,
            station: NOMINAL_STATION,
            duration_s: DURATION_S,
            distance_m: DISTANCE_M,
            bearing_deg_and_height_m: PATH,
            looks_aside_rad: ASIDE_RAD,
            pairs,
        }
    }

    /// Flies it.
    pub(super) fn fly(self, context: &Context) -> Result<Flown, ItemError> {
        let vehicle = Arc::new(load_vehicle(context, self.vehicle)?);
        let nominal = load_station(context, self.station)?;
        let mut members = Vec::new();
        for pair in &self.pairs {
            members.push(Member::new(pair.quadrotor(&vehicle)?, steps::QUADROTOR.step));
            members.push(Member::new(
                GimballedEts::new(pair.ets(&nominal)),
                steps::ETS.step,
            ));
        }
        let mut simulation = Engine::new(members)?;
        let id = simulation.attach(steps::BLACK_BOX.step, MemoryBox::default())?;
        let report = simulation.run(self.duration_s, &mut ())?;
        if !report.status.is_completed() {
            return Err(ItemError::new(report.status.to_string()));
        }
        let memory = simulation
            .detach::<MemoryBox>(id)
            .ok_or_else(|| ItemError::new("the black box is gone"))??;
        Ok(Flown {
            encounter: self,
            recording: memory.recording,
            vehicle,
            nominal,
        })
    }
}

impl Pair {
    /// The waypoints about the station; on the way as fast along the arc as the mean.
    fn waypoints(&self) -> [Waypoint; 4] {
        let leg = DURATION_S / 3.0;
        let rate = (PATH[3][0] - PATH[0][0]).to_radians() / DURATION_S;
        std::array::from_fn(|k| {
            let (bearing, height) = (PATH[k][0].to_radians(), PATH[k][1]);
            let speed = if k == 0 || k == 3 { 0.0 } else { rate * DISTANCE_M };
            let [north, east, _] = self.position_m;
            let (s, c) = bearing.sin_cos();
            Waypoint {
                time_s: leg * k as f64,
                position_m: [north + DISTANCE_M * c, east + DISTANCE_M * s, -height],
                velocity_m_s: [-speed * s, speed * c, 0.0],
                yaw_rad: 0.0,
                yaw_rate_rad_s: 0.0,
            }
        })
    }

    fn quadrotor(&self, vehicle: &Arc<Vehicle>) -> Result<ModelQuadrotor, ItemError> {
        let (pilot, tilt_law) = controller(self.level, vehicle)?;
        let waypoints = self.waypoints();
        let mission = Mission::through(&waypoints, vehicle.environment.gravity, tilt_law)?;
        let start = Start {
            position_m: waypoints[0].position_m,
            yaw_rad: std::f64::consts::PI + PATH[0][0].to_radians(),
        };
        let guidance = Facing::agent(mission, self.station);
        Ok(ModelQuadrotor::new(Setup {
            start,
            ..Setup::new(self.quadrotor, vehicle, self.level, pilot, guidance)
        })?)
    }

    fn ets(&self, nominal: &Station) -> EtsSetup {
        EtsSetup {
            station: self.station(nominal),
            pan_rad: PATH[0][0].to_radians() + ASIDE_RAD,
            ..EtsSetup::nominal(self.station, self.quadrotor)
        }
    }

    /// Its station: the nominal one at its place.
    pub(super) fn station(&self, nominal: &Station) -> Station {
        let mut station = nominal.clone();
        station.pedestal.position = self.position_m;
        station
    }
}

impl Flown {
    /// What is to be seen.
    pub(super) fn scene(&self, title: &str) -> Scene {
        let add = |scene: Scene, pair: &Pair| {
            scene
                .quadrotor(pair.quadrotor, self.vehicle.airframe.arm_length)
                .ets(pair.station, pair.quadrotor, &pair.station(&self.nominal))
        };
        self.encounter.pairs.iter().fold(Scene::new(title), add)
    }

    /// The parameters of the stations, but for their places.
    pub(super) fn nominal(&self) -> &Station {
        &self.nominal
    }
}
