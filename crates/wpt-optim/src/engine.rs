//! The same flight in the engine: with black boxes, other agents, stops and everything else that the engine offers.

use crate::error::ProblemError;
use crate::path::Path;
use crate::problem::Problem;
use crate::rollout::aimed;
use quad_ndi::Reference;
use sifre::quadrotor::{QuadrotorError, Setup, Start};
use sifre::{
    Engine, EtsSetup, Facing, GimballedEts, Guidance, Member, ModelQuadrotor, Moment, SimulationError, Tilt,
};

/// Name of the vehicle in the engine.
pub const QUADROTOR: &str = "quadrotor";
/// Name of the station in the engine.
pub const STATION: &str = "ets";

/// Why a flight can't be put into the engine.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The decision.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The vehicle.
    #[error(transparent)]
    Quadrotor(#[from] QuadrotorError),
    /// The simulation.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

/// A path as the engine's guidance, its heading its own.
#[derive(Clone, Copy, Debug)]
struct Crossing(Path<f64>);

impl Guidance for Crossing {
    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        let Path {
            leg,
            gravity,
            tilt_law,
            ..
        } = &self.0;
        Reference::following(leg.flat_output(now.time_s), *gravity, *tilt_law)
    }

    fn tilt(&self) -> Option<Tilt> {
        Some(Tilt {
            gravity: self.0.gravity,
            law: self.0.tilt_law,
        })
    }
}

impl Problem {
    /// The flight of a decision as a simulation of the engine: agents [`QUADROTOR`] and [`STATION`], at their start.
    ///
    /// # Errors
    /// As [`Problem::evaluate`]; what the engine refuses.
    pub fn simulation(&self, x: &[f64]) -> Result<Engine, EngineError> {
        let path = self.path_of(x)?;
        let mission = self.mission();
        let pilot = self.fleet.pilot();
        let flight = self.fleet.launched(&path);
        let guidance = Facing::agent(Crossing(path), STATION);
        let setup = Setup::new(QUADROTOR, &mission.vehicle, self.level(), pilot, guidance);
        let start = Start {
            position_m: flight.body.position.into(),
            yaw_rad: flight.body.attitude.euler_angles().yaw,
        };
        let mut quadrotor = ModelQuadrotor::new(Setup { start, ..setup })?;
        quadrotor.put_in_flight(&flight);
        let ets = self.fleet.ets();
        let seen = quadrotor.flight();
        let receiver = ets.receiver.on(&seen.position, &seen.rotation.matrix);
        let gimbal = aimed(ets, &receiver.centre).gimbal;
        let station = GimballedEts::new(EtsSetup {
            name: STATION.to_owned(),
            target: QUADROTOR.to_owned(),
            station: mission.station.clone(),
            pan_rad: gimbal.pan,
            tilt_rad: gimbal.tilt,
            seed: 0,
        });
        Ok(Engine::new(vec![
            Member::new(quadrotor, mission.step),
            Member::new(station, mission.station_step),
        ])?)
    }
}
