//! How well stations point at their quadrotors and quadrotors face their stations, from the recording alone.

use super::encounter::{Encounter, Pair};
use crate::data::DataTable;
use crate::item::ItemError;
use crate::scenarios::column;
use ets::Aperture;
use nalgebra::Vector3;
use quad_kinematics::EulerAngles;

/// From when on the station counts as settled, s: ten times the tracker's time constant of 0.2 s.
const SETTLED_S: f64 = 2.0;

/// A yaw error of this size costs the receiver a hundredth of its power, which goes with the cosine: acos 0.99, rad.
pub(super) const YAW_ERROR_RAD: f64 = 0.141_5;

/// One instant of one pair.
pub(super) struct Aim {
    pub(super) t: f64,
    /// Between the beam's axis and the direction to the receiver, rad.
    pub(super) off: f64,
    /// What half the receiver's width spans at its distance, rad: beyond it the axis misses the receiver.
    pub(super) half_receiver: f64,
    /// Between the quadrotor's yaw and the bearing of its station, rad.
    pub(super) yaw_error: f64,
    /// Between the compass's reading and the bearing of the receiver, rad.
    pub(super) bearing_error: f64,
    /// Between the reading of the inclination and the elevation of the receiver, rad.
    pub(super) inclination_error: f64,
    /// Distance of the receiver's image from the centre of the picture, px.
    pub(super) image: f64,
    /// Whether the receiver is in the picture.
    pub(super) visible: bool,
}

/// A pair over the whole flight.
pub(super) fn aims(flown: &Encounter, pair: &Pair) -> Result<Vec<Aim>, ItemError> {
    let column = |agent: &str, channel: &str| column(&flown.recording, &format!("{agent}.{channel}"));
    let of = |channel: &str| column(&pair.quadrotor, channel);
    let its = |channel: &str| column(&pair.station, channel);
    let position = [of("position.x")?, of("position.y")?, of("position.z")?];
    let attitude = [of("attitude.roll")?, of("attitude.pitch")?, of("attitude.yaw")?];
    let [pan, tilt, heading] = [its("gimbal.pan")?, its("gimbal.tilt")?, its("heading")?];
    let (image, visible) = ([its("image.x")?, its("image.y")?], its("visible")?);
    let receiver = &pair.ets.receiver;
    let half_width = match receiver.aperture {
        Aperture::Disc { radius } => radius,
        Aperture::Rectangle { half_width, .. } => half_width,
    };
    let origin = Vector3::from(pair.ets.pedestal.position);
    let at = |(k, t): (usize, f64)| {
        let vehicle = Vector3::from(position.each_ref().map(|x| x[k]));
        let [roll, pitch, yaw] = attitude.each_ref().map(|x| x[k]);
        let r_wb = EulerAngles::new(roll, pitch, yaw).rotation().matrix;
        let sight = vehicle + r_wb * Vector3::from(receiver.offset) - origin;
        let (bearing, inclination) = (heading[k] + pan[k], tilt[k]);
        let beam = Vector3::new(
            inclination.cos() * bearing.cos(),
            inclination.cos() * bearing.sin(),
            -inclination.sin(),
        );
        let home = origin - vehicle;
        Aim {
            t,
            off: beam.angle(&sight),
            half_receiver: (half_width / sight.norm()).atan(),
            yaw_error: turn(yaw - home.y.atan2(home.x)).abs(),
            bearing_error: turn(bearing - sight.y.atan2(sight.x)).abs(),
            inclination_error: (inclination + sight.z.atan2(sight.xy().norm())).abs(),
            image: image[0][k].hypot(image[1][k]),
            visible: visible[k] == 1.0,
        }
    };
    Ok(flown.recording.times_s().enumerate().map(at).collect())
}

/// The instants at which the station has settled.
fn settled(aims: &[Aim]) -> impl Iterator<Item = &Aim> {
    aims.iter().filter(|aim| aim.t >= SETTLED_S)
}

/// The largest of something after the station has settled.
pub(super) fn most(aims: &[Aim], what: impl Fn(&Aim) -> f64) -> f64 {
    settled(aims).map(what).fold(0.0, f64::max)
}

/// The data of the figure, five rows a second.
pub(super) fn table(pairs: &[(&Pair, Vec<Aim>)]) -> DataTable {
    let mut table = DataTable::new([
        "station",
        "quadrotor",
        "t_s",
        "beam_off_receiver_deg",
        "half_receiver_deg",
        "yaw_error_deg",
        "image_off_centre_px",
    ]);
    for (pair, aims) in pairs {
        for aim in aims.iter().step_by(10) {
            table.push([
                pair.station.as_str().into(),
                pair.quadrotor.as_str().into(),
                aim.t.into(),
                aim.off.to_degrees().into(),
                aim.half_receiver.to_degrees().into(),
                aim.yaw_error.to_degrees().into(),
                aim.image.into(),
            ]);
        }
    }
    table
}

/// An angle within half a turn of zero.
fn turn(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}
