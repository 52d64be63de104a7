//! Ground stations and targets.

use super::{AgentInfo, AgentKind, Built, finite, finite_waypoints};
use crate::error::ScenarioError;
use crate::file::{EtsFile, PathFile, TargetFile};
use crate::library::{Library, station_error};
use ets::GimbalAxis;
use quad_ndi::{Trajectory, Waypoint};
use sifre::{EtsSetup, GimballedEts, Member, Path, Target};

/// Adds a station to what is built.
pub(super) fn add(
    built: &mut Built,
    seed: u64,
    file: &EtsFile,
    library: &Library<'_>,
) -> Result<(), ScenarioError> {
    let mut station = library.station(&file.name, &file.station)?;
    let agent = format!("ets \"{}\"", file.name);
    if let Some(position_m) = file.position_m {
        for value in position_m {
            finite(&agent, "position_m", value)?;
        }
        station.pedestal.position = position_m;
    }
    if let Some(heading_deg) = file.heading_deg {
        station.pedestal.heading = heading_deg.to_radians();
    }
    if let Some(noise_px) = file.noise_px {
        station.frames.noise = noise_px;
    }
    if let Some(power_w) = file.power_w {
        station.beam.power = power_w;
    }
    station
        .validate(&format!("{} as \"{}\"", file.station, file.name))
        .map_err(|source| station_error(&file.name, source))?;
    in_travel(&agent, "pan_deg", file.pan_deg, &station.gimbal.pan)?;
    in_travel(&agent, "tilt_deg", file.tilt_deg, &station.gimbal.tilt)?;
    let setup = EtsSetup {
        name: file.name.clone(),
        target: file.tracks.clone(),
        station: station.clone(),
        pan_rad: file.pan_deg.to_radians(),
        tilt_rad: file.tilt_deg.to_radians(),
        seed,
    };
    built
        .members
        .push(Member::new(GimballedEts::new(setup), file.step_s));
    built.agents.push(AgentInfo {
        name: file.name.clone(),
        kind: AgentKind::Ets {
            station: Box::new(station),
            tracks: file.tracks.clone(),
        },
    });
    Ok(())
}

/// Refuses a start that the gimbal can't take.
fn in_travel(
    agent: &str,
    key: &'static str,
    value_deg: f64,
    axis: &GimbalAxis<f64>,
) -> Result<(), ScenarioError> {
    if (axis.minimum..=axis.maximum).contains(&value_deg.to_radians()) {
        return Ok(());
    }
    Err(ScenarioError::Travel {
        agent: agent.to_owned(),
        key,
        value_deg,
        from_deg: axis.minimum.to_degrees(),
        to_deg: axis.maximum.to_degrees(),
    })
}

/// Adds a target to what is built.
pub(super) fn add_target(built: &mut Built, file: &TargetFile) -> Result<(), ScenarioError> {
    let agent = format!("target \"{}\"", file.name);
    let path = match &file.path {
        PathFile::Fixed { position_m, yaw_deg } => {
            for &value in position_m {
                finite(&agent, "path.position_m", value)?;
            }
            finite(&agent, "path.yaw_deg", *yaw_deg)?;
            Path::Fixed {
                position: (*position_m).into(),
                yaw: yaw_deg.to_radians(),
            }
        }
        PathFile::Waypoints { waypoints } => {
            let waypoints: Vec<Waypoint> = waypoints.iter().map(Waypoint::from).collect();
            finite_waypoints(&agent, "path.waypoints", &waypoints)?;
            let trajectory = Trajectory::through(&waypoints);
            Path::Scripted(trajectory.map_err(|source| ScenarioError::Trajectory {
                agent: file.name.clone(),
                source,
            })?)
        }
    };
    let target = Target::new(file.name.clone(), path);
    built.members.push(Member::new(target, file.step_s));
    built.agents.push(AgentInfo {
        name: file.name.clone(),
        kind: AgentKind::Target,
    });
    Ok(())
}
