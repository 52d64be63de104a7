//! What a quadrotor needs to resume later, and how it is read.

use super::estimation::{Estimating, EstimatingMemory};
use super::gusts::MEMORY;
use super::{ModelQuadrotor, model};
use crate::agent::{ATTITUDE_ERROR, MemoryError, Published};
use crate::exact::{Exact, exact, plain};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Flight, Level, PhenomenonSet};
use quad_ndi::check_pairing;
use serde::{Deserialize, Serialize};

/// Everything a quadrotor needs to resume.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Memory {
    pub(super) level: Level,
    pub(super) phenomena: PhenomenonSet,
    pub(super) entry: Option<usize>,
    pub(super) state: Vec<Exact>,
    pub(super) pilot: Vec<Exact>,
    pub(super) commands: [Exact; 4],
    pub(super) wind: [Exact; 3],
    pub(super) air_rates: [Exact; 3],
    pub(super) air: [Exact; MEMORY],
    pub(super) charge_drawn: Exact,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) estimating: Option<EstimatingMemory>,
}

/// What a memory holds, checked.
pub(super) struct Restored {
    pub(super) memory: Memory,
    pub(super) quadrotor: AnyQuadrotor<f64>,
    pub(super) estimating: Option<Box<Estimating>>,
}

impl ModelQuadrotor {
    /// Everything it needs to resume.
    pub(super) fn memory(&self) -> Memory {
        let mut state = vec![0.0; self.quadrotor.state_len()];
        self.quadrotor.write_state(&mut state);
        Memory {
            level: self.quadrotor.level(),
            phenomena: self.quadrotor.phenomena().clone(),
            entry: self.entry,
            state: exact(&state),
            pilot: exact(&self.setup.pilot.memory()),
            commands: self.input.commands.map(Exact),
            wind: <[f64; 3]>::from(self.input.wind).map(Exact),
            air_rates: <[f64; 3]>::from(self.input.air_rates).map(Exact),
            air: self.air.memory().map(Exact),
            charge_drawn: Exact(self.charge_drawn),
            estimating: self.estimating.as_ref().map(|e| e.memory()),
        }
    }

    /// Its memory, checked: the model it flies and nothing changed yet.
    pub(super) fn read(&self, memory: &serde_json::Value) -> Result<Restored, MemoryError> {
        let mut memory = Memory::deserialize(memory)?;
        check_pairing(self.setup.pilot.level(), memory.level)?;
        let vehicle = &self.setup.vehicle;
        let mut quadrotor = model(vehicle, memory.level, &memory.phenomena, Vector3::zeros(), 0.0)?;
        MemoryError::check_length("the model's state", quadrotor.state_len(), memory.state.len())?;
        check_numbers(&memory)?;
        let count = self.scripted.len();
        match memory.entry {
            Some(entry) if entry >= count => return Err(MemoryError::Entry { entry, count }),
            _ => {}
        }
        quadrotor.read_state(&plain(&memory.state));
        if let Some(body) = quadrotor.rigid_body() {
            let length = body.attitude.norm_squared().sqrt();
            if (length - 1.0).abs() > ATTITUDE_ERROR {
                return Err(MemoryError::Attitude { length });
            }
        }
        let Flight {
            position,
            velocity,
            rotation,
            body_rates,
            ..
        } = quadrotor.flight();
        let seen = Published {
            position,
            velocity,
            rotation,
            body_rates,
        };
        seen.check_flight()?;
        let estimating = match (&self.estimating, memory.estimating.take()) {
            (None, None) => None,
            (Some(estimating), Some(memory)) => Some(Box::new(estimating.remembered(memory)?)),
            _ => return Err(MemoryError::OneHasAnEstimator),
        };
        Ok(Restored {
            memory,
            quadrotor,
            estimating,
        })
    }
}

/// Refuses numbers that no flight leads to.
fn check_numbers(memory: &Memory) -> Result<(), MemoryError> {
    let groups: [(&'static str, &[Exact]); 7] = [
        ("the model's state", &memory.state),
        ("the controller's memory", &memory.pilot),
        ("the list of commands", &memory.commands),
        ("the wind", &memory.wind),
        ("the rotation of the air", &memory.air_rates),
        ("the memory of the gusts", &memory.air),
        ("the charge drawn", &[memory.charge_drawn]),
    ];
    groups
        .iter()
        .try_for_each(|(what, numbers)| MemoryError::check_numbers(what, &plain(numbers)))
}
