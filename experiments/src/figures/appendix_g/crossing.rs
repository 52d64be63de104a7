//! A vehicle crosses the station's field, facing it, at any level and with all steps refined.

use crate::item::ItemError;
use ets::Station;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, Law, LoopDesign, PidSettings, Settings, TiltLaw, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Setup, Start};
use sifre::{
    Engine, EtsSetup, Facing, GimballedEts, Member, Mission, ModelQuadrotor, Recording, StepSize, steps,
};
use std::sync::Arc;

/// Duration of the crossing, s.
const DURATION_S: f64 = 10.0;

/// The crossing: from rest to rest.
fn waypoints() -> [Waypoint; 2] {
    [(0.0, -3.0), (DURATION_S, 3.0)].map(|(time_s, y)| Waypoint {
        time_s,
        position_m: [5.0, y, -1.5],
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    })
}

/// The inversion that is paired with a level, and how it takes tilt.
pub(in crate::figures) fn controller(
    level: Level,
    vehicle: &Vehicle,
) -> Result<(AnyController<f64>, TiltLaw), ItemError> {
    let law = Law::paired(level);
    let design = LoopDesign {
        inversion: Settings::default(),
        pid: PidSettings::default(),
    };
    Ok((law.build(vehicle, &design)?, law.tilt_law()))
}

/// The crossing at a level, every step `refinement` times shorter than declared.
pub(super) fn cross(
    vehicle: &Arc<Vehicle>,
    station: &Station,
    level: Level,
    refinement: u64,
) -> Result<Recording, ItemError> {
    let (pilot, tilt_law) = controller(level, vehicle)?;
    let mission = Mission::through(&waypoints(), vehicle.environment.gravity, tilt_law)?;
    let [x, y, z] = waypoints()[0].position_m;
    let start = Start {
        position_m: [x, y, z],
        yaw_rad: (-y).atan2(-x),
    };
    let setup = Setup::new(
        "quadrotor",
        vehicle,
        level,
        pilot,
        Facing::agent(mission, "station"),
    );
    let quadrotor = ModelQuadrotor::new(Setup { start, ..setup })?;
    let ets = GimballedEts::new(EtsSetup {
        station: station.clone(),
        pan_rad: y.atan2(x),
        tilt_rad: (-z).atan2(x.hypot(y)),
        ..EtsSetup::nominal("station", "quadrotor")
    });
    let finer = |declared: steps::DeclaredStep| -> Result<StepSize, ItemError> {
        Ok(declared.step.refined(refinement)?)
    };
    let mut simulation = Engine::new(vec![
        Member::new(quadrotor, finer(steps::QUADROTOR)?),
        Member::new(ets, finer(steps::ETS)?),
    ])?;
    let id = simulation.attach(steps::BLACK_BOX.step, MemoryBox::default())?;
    let report = simulation.run(DURATION_S, &mut ())?;
    if !report.status.is_completed() {
        return Err(ItemError::new(format!("{level}: {}", report.status)));
    }
    let memory = simulation
        .detach::<MemoryBox>(id)
        .ok_or_else(|| ItemError::new("the black box is gone"))??;
    Ok(memory.recording)
}
