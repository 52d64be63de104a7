//! What a quadrotor records, the same at every level.

use super::ModelQuadrotor;
use crate::black_box::{Channel, Frame, Role};
use nalgebra::Vector3;

/// Its channels, in the order of [`write`].
pub(super) fn channels(air_turns: bool, is_estimated: bool) -> Vec<Channel> {
    let (xyz, rotors) = (["x", "y", "z"], ["1", "2", "3", "4"]);
    let mut all = Vec::new();
    all.extend(Channel::group("position", xyz, Role::State, "m", Frame::World));
    all.extend(Channel::group("velocity", xyz, Role::State, "m/s", Frame::World));
    all.extend(Channel::group(
        "attitude",
        ["roll", "pitch", "yaw"],
        Role::State,
        "rad",
        Frame::Scalar,
    ));
    all.extend(Channel::group(
        "body_rate",
        ["p", "q", "r"],
        Role::State,
        "rad/s",
        Frame::Body,
    ));
    all.push(Channel::new("level", Role::State, "1", Frame::Scalar));
    all.push(Channel::new("charge_drawn", Role::State, "A h", Frame::Scalar));
    // Thrust is positive up, against the body's z axis.
    all.extend(Channel::group("thrust", rotors, Role::Output, "N", Frame::Scalar));
    all.extend(Channel::group("command", rotors, Role::Input, "1", Frame::Scalar));
    all.extend(Channel::group("wind", xyz, Role::Input, "m/s", Frame::World));
    if air_turns {
        all.extend(Channel::group(
            "air_rate",
            xyz,
            Role::Input,
            "rad/s",
            Frame::World,
        ));
    }
    all.extend(Channel::group(
        "reference.position",
        xyz,
        Role::Reference,
        "m",
        Frame::World,
    ));
    all.extend(Channel::group(
        "reference.velocity",
        xyz,
        Role::Reference,
        "m/s",
        Frame::World,
    ));
    all.push(Channel::new(
        "reference.yaw",
        Role::Reference,
        "rad",
        Frame::Scalar,
    ));
    if is_estimated {
        all.extend(estimates());
    }
    all
}

/// What an estimator says: the flight, and standard deviations of its position.
fn estimates() -> Vec<Channel> {
    let (xyz, angles) = (["x", "y", "z"], ["roll", "pitch", "yaw"]);
    [
        ("estimate.position", xyz, "m", Frame::World),
        ("estimate.velocity", xyz, "m/s", Frame::World),
        ("estimate.attitude", angles, "rad", Frame::Scalar),
        ("estimate.sd.position", xyz, "m", Frame::World),
    ]
    .into_iter()
    .flat_map(|(name, ends, unit, frame)| Channel::group(name, ends, Role::Output, unit, frame))
    .collect()
}

/// One number per channel.
pub(super) fn write(of: &ModelQuadrotor, row: &mut [f64]) {
    let (flight, flat) = (of.quadrotor.flight(), &of.reference.flat);
    let snapshot = of.quadrotor.snapshot(&of.input);
    let mut rest = row;
    let mut put = |values: &[f64]| {
        let (now, later) = std::mem::take(&mut rest).split_at_mut(values.len());
        now.copy_from_slice(values);
        rest = later;
    };
    let vector = |v: &Vector3<f64>| <[f64; 3]>::from(*v);
    put(&vector(&flight.position));
    put(&vector(&flight.velocity));
    put(&vector(&flight.attitude.vector()));
    put(&vector(&flight.body_rates));
    put(&[f64::from(of.quadrotor.level().number()), of.charge_drawn()]);
    put(&snapshot.rotors.map(|rotor| rotor.output.thrust));
    put(&of.input.commands);
    put(&vector(&of.input.wind));
    if of.air_turns() {
        put(&vector(&of.input.air_rates));
    }
    put(&vector(&flat.position));
    put(&vector(&flat.velocity));
    put(&[flat.yaw]);
    if let Some(estimating) = &of.estimating {
        let estimate = estimating.estimate();
        put(&vector(&estimate.position));
        put(&vector(&estimate.velocity));
        put(&vector(&estimate.attitude.euler_angles().vector()));
        put(&estimate.deviations().as_slice()[..3]);
    }
}
