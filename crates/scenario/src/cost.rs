//! The cost Φ of power transmission from a station to a quadrotor, with the weights and limits of the scenario.
//!
//! Every station that tracks a quadrotor has one. What a table `[optimise]` says of weights and limits holds for the
//! station that it names; others have the defaults of [`Weights`] and [`Penalties`] and their own limits.

use crate::assemble::{AgentInfo, AgentKind};
use crate::error::ScenarioError;
use crate::file::{EtsFile, OptimiseFile, Scenario};
use ets::Station;
use quad_dynamics::Vehicle;
use sifre::StepSize;
use std::collections::HashMap;
use std::sync::Arc;
use wpt_optim::{CostBox, Outcome, Pair, Penalties, Weights};

/// What the flight of a quadrotor in the beam of a station costs.
#[derive(Clone, Debug, PartialEq)]
pub struct StationCost {
    /// Whose cost it is.
    pub pair: Pair,
    /// The cost Φ and its terms. What a flight that ended early did not fly costs as a failure.
    pub outcome: Outcome,
    /// Whether the flight stayed within all limits to its end.
    pub is_complete: bool,
}

/// A cost that can be asked for.
#[derive(Debug)]
pub(crate) struct Judged {
    pub(crate) pair: Pair,
    /// The station's own step, at which it is judged.
    pub(crate) step: StepSize,
    station: Box<Station>,
    vehicle: Arc<Vehicle>,
    weights: Weights,
    penalties: Penalties,
}

impl Judged {
    /// A black box that sums it up.
    pub(crate) fn black_box(&self) -> Result<CostBox, ScenarioError> {
        CostBox::new(
            self.pair.clone(),
            &self.station,
            &self.vehicle,
            &self.weights,
            &self.penalties,
        )
        .map_err(|source| ScenarioError::Cost {
            station: self.pair.station.clone(),
            source: Box::new(source),
        })
    }
}

/// The costs of a scenario's stations.
pub(crate) fn judged(scenario: &Scenario, agents: &[AgentInfo]) -> Result<Vec<Judged>, ScenarioError> {
    let kinds: HashMap<&str, &AgentKind> = agents
        .iter()
        .map(|agent| (agent.name.as_str(), &agent.kind))
        .collect();
    let kind = |name: &str| kinds.get(name).copied();
    let one = |file: &EtsFile| {
        let optimise = scenario.optimise_of(file);
        let pair = pair(file, optimise);
        let (Some(AgentKind::Ets { station, .. }), Some(AgentKind::Quadrotor { vehicle, .. })) =
            (kind(&pair.station), kind(&pair.quadrotor))
        else {
            return None;
        };
        let mut station = station.clone();
        if let Some(limits) = optimise.map(|optimise| &optimise.limits) {
            let own = &mut station.limits;
            own.range = limits.range_m.unwrap_or(own.range);
            own.incidence = limits.incidence_deg.map_or(own.incidence, f64::to_radians);
            own.spot = limits.spot_m.unwrap_or(own.spot);
        }
        Some(Judged {
            pair,
            step: file.step_s,
            station,
            vehicle: Arc::clone(vehicle),
            weights: optimise.map_or_else(Weights::default, OptimiseFile::weights),
            penalties: optimise.map_or_else(Penalties::default, OptimiseFile::penalties),
        })
    };
    let all: Vec<Judged> = scenario.ets.iter().filter_map(one).collect();
    // Weights and limits that no cost can be made of are refused before anything is flown.
    for judged in &all {
        judged.black_box()?;
    }
    Ok(all)
}

/// The station and whoever carries the receiver.
fn pair(file: &EtsFile, optimise: Option<&OptimiseFile>) -> Pair {
    let named = optimise.and_then(|optimise| optimise.quadrotor.clone());
    Pair {
        quadrotor: named.unwrap_or_else(|| file.tracks.clone()),
        station: file.name.clone(),
    }
}

impl Scenario {
    /// The table `[optimise]`, if it is about this station.
    fn optimise_of(&self, station: &EtsFile) -> Option<&OptimiseFile> {
        self.optimise.as_ref().filter(|optimise| match &optimise.station {
            Some(name) => *name == station.name,
            None => self.ets.len() == 1,
        })
    }

    /// Whose cost the table `[optimise]` is about.
    ///
    /// # Errors
    /// A station that it doesn't name or that doesn't exist; a station that is judged with something else than a quadrotor.
    pub fn optimised_pair(&self) -> Result<Pair, ScenarioError> {
        let wanted = self
            .optimise
            .as_ref()
            .and_then(|optimise| optimise.station.clone());
        let Some(station) = self.ets.iter().find(|ets| self.optimise_of(ets).is_some()) else {
            let known: Vec<&str> = self.ets.iter().map(|ets| ets.name.as_str()).collect();
            return Err(ScenarioError::NoStation {
                wanted,
                known: match known[..] {
                    [] => "none".to_owned(),
                    _ => known.join(", "),
                },
            });
        };
        let pair = pair(station, self.optimise.as_ref());
        match self.quadrotor.iter().any(|other| other.name == pair.quadrotor) {
            true => Ok(pair),
            false => Err(ScenarioError::NotJudged {
                station: pair.station,
                quadrotor: pair.quadrotor,
            }),
        }
    }
}
