//! The scenarios that come with the project.

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        &[$(($name, include_str!(concat!("../scenarios/", $name, ".toml")))),+]
    };
}

/// Name and text of each file in `scenarios/`, the simplest first.
pub const READY: &[(&str, &str)] = files![
    "hover",
    "step-in-height",
    "horizontal-step",
    "helix",
    "waypoints",
    "gust",
    "estimator-in-the-loop",
    "wrong-start",
    "near-the-ground",
    "crazyflie",
    "payload",
    "level-change",
    "track-fixed",
    "lost-view",
    "power-transmission-10s",
    "power-transmission-20s",
    "optimise-transmission",
    "two-quadrotors",
    "swarm",
];

/// The text of a ready scenario.
#[must_use]
pub fn ready(name: &str) -> Option<&'static str> {
    READY
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}
