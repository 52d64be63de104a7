//! Settings of the chapter's runs, and why they are what they are.

use quad_ndi::{AttitudeSettings, LoopSettings, Settings};

/// Settling time of the height steps without and with limits, s: fast enough for the limits to bite.
pub(super) const HEIGHT_SETTLING_S: f64 = 1.0;

/// Settling time of the yaw steps, s.
pub(super) const YAW_SETTLING_S: f64 = 2.0;

/// Settling time of the horizontal steps and trajectories, s.
///
/// The captions' 2 s with `ω_n,a = 10 ω_n,p` asks for `ω_n,a` = 29.2 rad/s, which the Routh array refuses to
/// c1 and c2 above level 3: the limit is `2 ζ_a ω_R` = 30 rad/s at level 3 and 17.9 rad/s with the motor
/// controller's pole of level 4. With 5 s, `ω_n,a` = 11.7 rad/s keeps a factor of 2.6 and 1.5.
pub(super) const POSITION_SETTLING_S: f64 = 5.0;

/// The caption's `p_z = 20 ω_n,z`.
pub(super) const HEIGHT_POLE_RATIO: f64 = 20.0;

/// The caption's `ω_n,a = 10 ω_n,p`.
pub(super) const FREQUENCY_RATIO: f64 = 10.0;

/// Settings for steps in height with this settling time, s.
pub(super) fn height(settling_time_s: f64) -> Settings {
    let height = LoopSettings {
        settling_time_s,
        damping: 1.0,
        pole_ratio: HEIGHT_POLE_RATIO,
    };
    Settings { height, ..flight() }
}

/// Settings for steps in yaw, horizontal steps and trajectories.
pub(crate) fn flight() -> Settings {
    let with = |settling_time_s| LoopSettings {
        settling_time_s,
        damping: 1.0,
        pole_ratio: HEIGHT_POLE_RATIO,
    };
    Settings {
        height: with(2.0),
        yaw: with(YAW_SETTLING_S),
        position: with(POSITION_SETTLING_S),
        attitude: AttitudeSettings {
            frequency_ratio: FREQUENCY_RATIO,
            damping: 1.0,
            pole_ratio: 5.0,
        },
    }
}
