//! What a station records, the same for every kind.

use crate::black_box::{Channel, Frame, Role};
use ::ets::{Ets as Physics, Face, GimbalCommand, GimbalState, Link, Mode, Station};

/// What there is to record of a station at an instant.
pub(super) struct Seen {
    pub(super) gimbal: GimbalState<f64>,
    pub(super) command: GimbalCommand<f64>,
    pub(super) mode: Mode,
    pub(super) face: Face<f64>,
}

/// Its channels, in the order of [`write`].
pub(super) fn channels() -> Vec<Channel> {
    let (axes, xyz) = (["pan", "tilt"], ["x", "y", "z"]);
    let mut all = Vec::new();
    all.extend(Channel::group("gimbal", axes, Role::State, "rad", Frame::Scalar));
    all.extend(Channel::group(
        "gimbal_rate",
        axes,
        Role::State,
        "rad/s",
        Frame::Scalar,
    ));
    // The position is fixed; it is recorded so that a recording can be understood alone.
    all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
    all.push(Channel::new("heading", Role::State, "rad", Frame::Scalar));
    // 0 searching, 1 coasting, 2 tracking.
    all.push(Channel::new("mode", Role::State, "1", Frame::Scalar));
    all.extend(Channel::group(
        "command",
        axes,
        Role::Input,
        "rad/s",
        Frame::Scalar,
    ));
    all.extend(Channel::group("target", xyz, Role::Reference, "m", Frame::World));
    all.extend(Channel::group(
        "image",
        ["x", "y"],
        Role::Output,
        "px",
        Frame::Camera,
    ));
    all.push(Channel::new("visible", Role::Output, "1", Frame::Scalar));
    all.push(Channel::new("range", Role::Output, "m", Frame::Scalar));
    all.push(Channel::new("incidence", Role::Output, "rad", Frame::Scalar));
    // On the sensor's plane: to the right of one who looks at it, and up the vehicle.
    all.extend(Channel::group(
        "spot",
        ["right", "up"],
        Role::Output,
        "m",
        Frame::Body,
    ));
    let power = ["transmitted", "received", "missed", "electrical"];
    all.extend(Channel::group("power", power, Role::Output, "W", Frame::Scalar));
    all
}

/// One number per channel.
pub(super) fn write(physics: &Physics<f64>, station: &Station, seen: &Seen, row: &mut [f64]) {
    let Seen {
        gimbal,
        command,
        mode,
        face,
    } = seen;
    let image = physics.view(gimbal, &face.centre);
    let Link { geometry, power } = physics.link(gimbal, face);
    let mode = match mode {
        Mode::Searching => 0.0,
        Mode::Coasting => 1.0,
        Mode::Tracking => 2.0,
    };
    let (target, pedestal) = (&face.centre, &station.pedestal);
    row.copy_from_slice(&[
        gimbal.pan,
        gimbal.tilt,
        gimbal.pan_rate,
        gimbal.tilt_rate,
        pedestal.position[0],
        pedestal.position[1],
        pedestal.position[2],
        pedestal.heading,
        mode,
        command.pan_rate,
        command.tilt_rate,
        target.x,
        target.y,
        target.z,
        image.point.x,
        image.point.y,
        image.visible,
        geometry.range,
        geometry.incidence,
        geometry.spot.x,
        geometry.spot.y,
        power.transmitted,
        power.received,
        power.missed,
        power.electrical,
    ]);
}
