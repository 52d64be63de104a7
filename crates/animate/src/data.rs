//! The data of the page, as its viewer reads them.
//!
//! Positions are in W, m, three numbers per row; attitudes are unit quaternions `[x, y, z, w]` from the agent's frame to W, four
//! per row, neighbours of the same sign, so that the viewer may interpolate them. Angles in rad. What may be missing is `null`.

use crate::columns::Columns;
use crate::error::AnimateError;
use crate::scene::{Kind, LEVEL_COLOURS, Scene, SceneAgent};
use crate::view::View;
use ets::{Aperture, Station};
use quad_dynamics::Level;
use quad_kinematics::EulerAngles;
use serde::Serialize;

/// The decimal to which lengths, angles and quaternions are written: 0.01 mm, 0.01 mrad.
const DECIMALS: f64 = 1e5;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Data {
    /// Instants, s.
    t: Vec<f64>,
    agents: Vec<Agent>,
    /// Colours of the levels, lowest first.
    colours: [&'static str; Level::ALL.len()],
    #[serde(flatten)]
    view: View,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub(crate) enum Agent {
    #[serde(rename_all = "camelCase")]
    Quadrotor {
        name: String,
        arm: f64,
        p: Vec<f64>,
        q: Vec<f64>,
        level: Option<Vec<u8>>,
        receivers: Vec<Receiver>,
    },
    #[serde(rename_all = "camelCase")]
    Ets(Box<Ground>),
    #[serde(rename_all = "camelCase")]
    Target { name: String, p: Vec<f64> },
}

/// A ground station.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Ground {
    name: String,
    tracks: String,
    position: [f64; 3],
    heading: f64,
    travel: Travel,
    lens: Lens,
    beam: Beam,
    limits: Limits,
    pan: Vec<f64>,
    tilt: Vec<f64>,
    q: Vec<f64>,
    range: Option<Vec<Option<f64>>>,
    incidence: Option<Vec<Option<f64>>>,
    spot_right: Option<Vec<Option<f64>>>,
    spot_up: Option<Vec<Option<f64>>>,
    visible: Option<Vec<Option<f64>>>,
    mode: Option<Vec<Option<f64>>>,
}

#[derive(Serialize)]
struct Travel {
    pan: [f64; 2],
    tilt: [f64; 2],
}

#[derive(Serialize)]
struct Lens {
    focal: f64,
    principal: [f64; 2],
    pixels: [f64; 2],
}

#[derive(Serialize)]
struct Beam {
    waist: f64,
    divergence: f64,
    offset: [f64; 3],
}

#[derive(Serialize)]
struct Limits {
    range: f64,
    incidence: f64,
    spot: f64,
}

/// A receiver on a vehicle, and whose it is; `axes` are `e_1`, `e_2`, `n` in B.
#[derive(Serialize)]
pub(crate) struct Receiver {
    station: String,
    offset: [f64; 3],
    axes: [[f64; 3]; 3],
    width: f64,
    height: f64,
}

impl Data {
    /// The data of a scene at the rows kept.
    pub(crate) fn new(columns: &Columns<'_>, scene: &Scene) -> Result<Self, AnimateError> {
        let make = |agent| Agent::new(agent, scene, columns);
        let agents: Vec<Agent> = scene.agents.iter().map(make).collect::<Result<_, _>>()?;
        Ok(Self {
            t: rounded(&columns.times_s),
            view: View::of(agents.iter().flat_map(Agent::places)),
            agents,
            colours: LEVEL_COLOURS,
        })
    }
}

impl Agent {
    fn new(of: &SceneAgent, scene: &Scene, columns: &Columns<'_>) -> Result<Self, AnimateError> {
        let kind = of.kind.name();
        let position = || columns.pose(&of.name, kind, ["position.x", "position.y", "position.z"]);
        match &of.kind {
            Kind::Quadrotor { arm_m } => {
                let position = position()?;
                let angles = ["attitude.roll", "attitude.pitch", "attitude.yaw"];
                let [roll, pitch, yaw] = columns.pose(&of.name, kind, angles)?;
                let attitude = |k: usize| EulerAngles::new(roll[k], pitch[k], yaw[k]);
                Ok(Self::Quadrotor {
                    name: of.name.clone(),
                    arm: positive(&format!("the arm of \"{}\", m,", of.name), *arm_m)?,
                    p: interleaved(&position),
                    q: quaternions((0..yaw.len()).map(attitude)),
                    level: levels(columns, &of.name)?,
                    receivers: receivers_of(&of.name, scene),
                })
            }
            Kind::Ets { tracks, station } => Ok(Self::Ets(Box::new(Ground::new(
                of, tracks, station, scene, columns,
            )?))),
            Kind::Target => Ok(Self::Target {
                name: of.name.clone(),
                p: interleaved(&position()?),
            }),
        }
    }

    /// The positions in W that it takes, m.
    fn places(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let flat: &[f64] = match self {
            Self::Quadrotor { p, .. } | Self::Target { p, .. } => p,
            Self::Ets(ground) => &ground.position,
        };
        flat.chunks_exact(3).map(|p| [p[0], p[1], p[2]])
    }
}

impl Ground {
    fn new(
        of: &SceneAgent,
        tracks: &str,
        station: &Station,
        scene: &Scene,
        columns: &Columns<'_>,
    ) -> Result<Self, AnimateError> {
        if !scene.agents.iter().any(|agent| agent.name == tracks) {
            return Err(AnimateError::UnknownTarget {
                station: of.name.clone(),
                wanted: tracks.to_owned(),
                known: scene.agents.iter().map(|agent| agent.name.clone()).collect(),
            });
        }
        check_place(&of.name, station, columns)?;
        let [pan, tilt] = columns.pose(&of.name, of.kind.name(), ["gimbal.pan", "gimbal.tilt"])?;
        let heading = station.pedestal.heading;
        let attitude = |k: usize| EulerAngles::new(0.0, tilt[k], heading + pan[k]);
        let optional = |channel: &str| columns.get(&format!("{}.{channel}", of.name)).map(gaps);
        let (gimbal, camera, beam) = (&station.gimbal, &station.camera, &station.beam);
        Ok(Self {
            name: of.name.clone(),
            tracks: tracks.to_owned(),
            position: station.pedestal.position,
            heading,
            travel: Travel {
                pan: [gimbal.pan.minimum, gimbal.pan.maximum],
                tilt: [gimbal.tilt.minimum, gimbal.tilt.maximum],
            },
            lens: Lens {
                focal: positive("the camera's focal length, px,", camera.focal_length)?,
                principal: camera.principal_point,
                pixels: camera.pixels,
            },
            beam: Beam {
                waist: beam.waist_radius,
                divergence: beam.divergence,
                offset: beam.offset,
            },
            limits: Limits {
                range: station.limits.range,
                incidence: station.limits.incidence,
                spot: station.limits.spot,
            },
            q: quaternions((0..pan.len()).map(attitude)),
            pan: rounded(&pan),
            tilt: rounded(&tilt),
            range: optional("range"),
            incidence: optional("incidence"),
            spot_right: optional("spot.right"),
            spot_up: optional("spot.up"),
            visible: optional("visible"),
            mode: optional("mode"),
        })
    }
}

/// Refuses a place of the station from which the recorded ranges can't have been measured.
fn check_place(name: &str, station: &Station, columns: &Columns<'_>) -> Result<(), AnimateError> {
    let [x, y, z, range] = ["target.x", "target.y", "target.z", "range"]
        .map(|channel| columns.get(&format!("{name}.{channel}")));
    let (Some(x), Some(y), Some(z), Some(range)) = (x, y, z, range) else {
        return Ok(());
    };
    let origin = station.pedestal.origin();
    // The range counts from the emitter, which is beside the crossing of the axes; a millimetre for rounding of the files.
    let beside = nalgebra::Vector3::from(station.beam.offset).norm() + 1e-3;
    for (k, &range_m) in range.iter().enumerate() {
        let distance_m = (nalgebra::Vector3::new(x[k], y[k], z[k]) - origin).norm();
        if (distance_m - range_m).abs() > beside {
            return Err(AnimateError::StationElsewhere {
                station: name.to_owned(),
                position_m: station.pedestal.position,
                time_s: columns.times_s[k],
                distance_m,
                range_m,
            });
        }
    }
    Ok(())
}

/// The receivers that stations see on this agent.
fn receivers_of(carrier: &str, scene: &Scene) -> Vec<Receiver> {
    let on_it = |agent: &SceneAgent| match &agent.kind {
        Kind::Ets { tracks, station } if tracks == carrier => Some(Receiver {
            station: agent.name.clone(),
            offset: station.receiver.offset,
            axes: station.receiver.axes().into(),
            width: station.receiver.aperture.extent()[0],
            height: station.receiver.aperture.extent()[1],
        }),
        _ => None,
    };
    scene.agents.iter().filter_map(on_it).collect()
}

/// Width and height of a receiver's face, m.
trait Extent {
    fn extent(&self) -> [f64; 2];
}

impl Extent for Aperture<f64> {
    fn extent(&self) -> [f64; 2] {
        match *self {
            Self::Disc { radius } => [2.0 * radius; 2],
            Self::Rectangle {
                half_width,
                half_height,
            } => [2.0 * half_width, 2.0 * half_height],
        }
    }
}

/// The level at each row, if it is recorded.
fn levels(columns: &Columns<'_>, agent: &str) -> Result<Option<Vec<u8>>, AnimateError> {
    let channel = format!("{agent}.level");
    let Some(column) = columns.get(&channel) else {
        return Ok(None);
    };
    let numbers = Level::ALL.map(Level::number);
    let level = |(k, value): (usize, f64)| match numbers.into_iter().find(|&level| f64::from(level) == value)
    {
        Some(level) => Ok(level),
        None => Err(AnimateError::BadLevel {
            channel: channel.clone(),
            time_s: columns.times_s[k],
            value,
        }),
    };
    column
        .into_iter()
        .enumerate()
        .map(level)
        .collect::<Result<_, _>>()
        .map(Some)
}

/// Attitudes as quaternions whose neighbours have the same sign.
fn quaternions(attitudes: impl Iterator<Item = EulerAngles<f64>>) -> Vec<f64> {
    let mut before = [0.0, 0.0, 0.0, 1.0];
    let mut all = Vec::new();
    for attitude in attitudes {
        let q = attitude.quaternion();
        let mut now = [q.v.x, q.v.y, q.v.z, q.w];
        if now.iter().zip(before).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            now = now.map(|x| -x);
        }
        all.extend(now);
        before = now;
    }
    rounded(&all)
}

fn interleaved(xyz: &[Vec<f64>; 3]) -> Vec<f64> {
    let [x, y, z] = xyz;
    let rows = x.iter().zip(y).zip(z).flat_map(|((&x, &y), &z)| [x, y, z]);
    rounded(&rows.collect::<Vec<_>>())
}

fn round(x: f64) -> f64 {
    (x * DECIMALS).round() / DECIMALS
}

fn rounded(column: &[f64]) -> Vec<f64> {
    column.iter().copied().map(round).collect()
}

/// Non-finite numbers are gaps in a curve.
fn gaps(column: Vec<f64>) -> Vec<Option<f64>> {
    column
        .into_iter()
        .map(|x| x.is_finite().then(|| round(x)))
        .collect()
}

/// The number, if it is a length that can be drawn.
fn positive(what: &str, value: f64) -> Result<f64, AnimateError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(AnimateError::NotPositive {
            what: what.to_owned(),
            value,
        })
    }
}
