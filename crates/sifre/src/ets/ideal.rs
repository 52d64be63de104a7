//! The station that always points exactly: the bound on what any tracker transmits.
//!
//! At each of its instants the beam goes through the centre of the receiver ([`::ets::Ets::aim`]): no gimbal dynamics, no camera,
//! no delay. Losses in the air, incidence and divergence remain. Where no angles reach the receiver it
//! keeps its last ones and reports [`Mode::Searching`].

use super::record::{self, Seen};
use super::{Ets, EtsSetup, pose};
use crate::agent::{Agent, AgentId, Directory, MemoryError, Moment, Published};
use crate::black_box::Channel;
use crate::error::BindError;
use crate::event::AgentEvent;
use crate::exact::Exact;
use ::ets::{Ets as Physics, Face, GimbalCommand, GimbalState, Link, Mode};
use serde::{Deserialize, Serialize};

/// A ground station whose beam always meets the centre of its target's receiver.
#[derive(Debug)]
pub struct IdealEts {
    setup: EtsSetup,
    physics: Physics<f64>,
    target: Option<AgentId>,
    gimbal: GimbalState<f64>,
    reaches: bool,
    face: Face<f64>,
}

/// All that it needs to resume.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Memory {
    angles: [Exact; 2],
    reaches: bool,
    face_centre: [Exact; 3],
    face_axes: [[Exact; 3]; 3],
}

impl IdealEts {
    /// The station, at the setup's angles until its first instant. The setup's seed has no effect: there is no noise.
    pub fn new(setup: EtsSetup) -> Self {
        let physics = Physics::new(&setup.station);
        Self {
            // Until the first instant the receiver is taken to be at the station.
            face: physics
                .receiver
                .on(&physics.pedestal.origin(), &nalgebra::Matrix3::identity()),
            gimbal: GimbalState::at_rest(setup.pan_rad, setup.tilt_rad),
            target: None,
            reaches: false,
            physics,
            setup,
        }
    }
}

impl Ets for IdealEts {
    fn target(&self) -> &str {
        &self.setup.target
    }

    fn mode(&self) -> Mode {
        if self.reaches {
            Mode::Tracking
        } else {
            Mode::Searching
        }
    }

    fn gimbal(&self) -> GimbalState<f64> {
        self.gimbal
    }

    fn link(&self) -> Link<f64> {
        self.physics.link(&self.gimbal, &self.face)
    }
}

impl Agent for IdealEts {
    fn name(&self) -> &str {
        &self.setup.name
    }

    fn kind(&self) -> &'static str {
        "ideal-ets"
    }

    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), BindError> {
        self.target = Some(directory.find(&self.setup.target)?);
        Ok(())
    }

    fn published(&self) -> Published {
        pose(&self.physics, &self.gimbal)
    }

    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        let target = now.published(self.target?);
        self.face = self
            .physics
            .receiver
            .on(&target.position, &target.rotation.matrix);
        let (aim, before) = (self.physics.aim(&self.face.centre), self.reaches);
        self.reaches = aim.is_some();
        self.gimbal = aim.unwrap_or(self.gimbal);
        match (before, self.reaches) {
            (true, false) => Some(AgentEvent::TargetLost),
            (false, true) => Some(AgentEvent::TargetFound),
            _ => None,
        }
    }

    fn advance(&mut self, _now: &Moment<'_>) {}

    fn channels(&self) -> Vec<Channel> {
        record::channels()
    }

    fn record(&self, row: &mut [f64]) {
        let seen = Seen {
            gimbal: self.gimbal,
            command: GimbalCommand {
                pan_rate: 0.0,
                tilt_rate: 0.0,
            },
            mode: self.mode(),
            face: self.face,
        };
        record::write(&self.physics, &self.setup.station, &seen, row);
    }

    fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value(Memory {
            angles: [self.gimbal.pan, self.gimbal.tilt].map(Exact),
            reaches: self.reaches,
            face_centre: <[f64; 3]>::from(self.face.centre).map(Exact),
            face_axes: <[[f64; 3]; 3]>::from(self.face.axes).map(|axis| axis.map(Exact)),
        })
    }

    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
        let memory = Memory::deserialize(memory)?;
        let numbers = memory.face_centre.iter().chain(memory.face_axes.as_flattened());
        MemoryError::check_numbers(
            "the receiver that it sees",
            &numbers.map(|x| x.0).collect::<Vec<_>>(),
        )?;
        let [pan, tilt] = memory.angles.map(|x| x.0);
        MemoryError::check_numbers("the station's angles", &[pan, tilt])?;
        self.gimbal = GimbalState::at_rest(pan, tilt);
        self.reaches = memory.reaches;
        self.face = Face {
            centre: memory.face_centre.map(|x| x.0).into(),
            axes: memory.face_axes.map(|axis| axis.map(|x| x.0)).into(),
        };
        Ok(())
    }
}
