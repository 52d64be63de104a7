//! Quadrotors that fly past a ground station each, facing it: a scenario file, flown and recorded.

use crate::item::ItemError;
use crate::scenarios::{self, ScenarioFile};
use animate::Scene;
use ets::Station;
use scenario::{AgentKind, Keep, Run};
use sifre::Recording;

/// A quadrotor and its station.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    /// Name of the quadrotor.
    pub(super) quadrotor: String,
    /// From the centre of mass to a rotor, m.
    arm_length_m: f64,
    /// Name of the station.
    pub(super) station: String,
    /// The station where it stands.
    pub(super) ets: Station,
}

/// A flight with what it was flown with.
pub(super) struct Encounter {
    pub(super) file: &'static ScenarioFile,
    pub(super) pairs: Vec<Pair>,
    pub(super) recording: Recording,
}

impl Encounter {
    /// Flies the scenario file of this name.
    pub(super) fn fly(name: &str) -> Result<Self, ItemError> {
        let file = scenarios::find(name)?;
        let scenario = file.scenario()?;
        let mut run = scenario.build(&())?.start()?;
        let flown = run.fly(&Keep::rows(scenario.output.step_s), &mut ())?;
        if !flown.ending.report.status.is_completed() {
            return Err(ItemError::new(flown.ending.to_string()));
        }
        Ok(Self {
            file,
            pairs: pairs(&run),
            recording: flown.recording,
        })
    }

    /// What is to be seen.
    pub(super) fn scene(&self, title: &str) -> Scene {
        let add = |scene: Scene, pair: &Pair| {
            scene.quadrotor(pair.quadrotor.clone(), pair.arm_length_m).ets(
                pair.station.clone(),
                pair.quadrotor.clone(),
                &pair.ets,
            )
        };
        self.pairs.iter().fold(Scene::new(title), add)
    }
}

/// The stations of a run with the quadrotors that they track.
fn pairs(run: &Run) -> Vec<Pair> {
    let arm_length_m = |name: &str| {
        run.agents.iter().find_map(|agent| match &agent.kind {
            AgentKind::Quadrotor { vehicle, .. } if agent.name == name => Some(vehicle.airframe.arm_length),
            _ => None,
        })
    };
    let pair = |agent: &scenario::AgentInfo| match &agent.kind {
        AgentKind::Ets { station, tracks } => Some(Pair {
            arm_length_m: arm_length_m(tracks)?,
            quadrotor: tracks.clone(),
            station: agent.name.clone(),
            ets: station.as_ref().clone(),
        }),
        _ => None,
    };
    run.agents.iter().filter_map(pair).collect()
}
