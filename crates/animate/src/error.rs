//! Why a recording can't be animated.

use quad_dynamics::Level;

/// Why a recording can't be animated.
#[derive(Debug, thiserror::Error)]
pub enum AnimateError {
    /// A recording without rows.
    #[error("the recording has no rows: attach a black box before the run, and finish it after")]
    EmptyRecording,
    /// A scene without agents.
    #[error("the scene has no agents; the recording has the channels {channels:?}")]
    NoAgents {
        /// The first channels of the recording.
        channels: Vec<String>,
    },
    /// Two agents of one name.
    #[error("the scene has two agents named \"{name}\"")]
    SameName {
        /// The name.
        name: String,
    },
    /// A channel that an agent is drawn from isn't recorded.
    #[error("agent \"{agent}\" can't be drawn as a {kind}: the recording has no channel \"{channel}\"")]
    MissingChannel {
        /// The agent.
        agent: String,
        /// How it is to be drawn.
        kind: &'static str,
        /// The channel.
        channel: String,
    },
    /// A number that a pose is drawn from is NaN or infinite.
    #[error("channel \"{channel}\": a pose must be finite, got {value} at {time_s} s")]
    NotFinite {
        /// The channel.
        channel: String,
        /// The instant, s.
        time_s: f64,
        /// The number.
        value: f64,
    },
    /// A level that there is not.
    #[error("channel \"{channel}\": {value} at {time_s} s is not a level; levels are {} to {}", Level::LOWEST.number(), Level::HIGHEST.number())]
    BadLevel {
        /// The channel.
        channel: String,
        /// The instant, s.
        time_s: f64,
        /// The number.
        value: f64,
    },
    /// A station is said to track an agent that the scene doesn't have.
    #[error("station \"{station}\" tracks \"{wanted}\", which is not in the scene; known: {known:?}")]
    UnknownTarget {
        /// The station.
        station: String,
        /// The name that nobody has.
        wanted: String,
        /// The names that there are.
        known: Vec<String>,
    },
    /// A station whose recorded ranges don't fit where it is said to stand.
    #[error(
        "station \"{station}\" can't be at {position_m:?} m: its target would be {distance_m:.2} m away \
         at {time_s} s, and {range_m:.2} m are recorded: give the scene the station's own parameters"
    )]
    StationElsewhere {
        /// The station.
        station: String,
        /// Where it is said to stand in W, m.
        position_m: [f64; 3],
        /// The instant, s.
        time_s: f64,
        /// Distance from there to the recorded target, m.
        distance_m: f64,
        /// The recorded range, m.
        range_m: f64,
    },
    /// A length that must be positive.
    #[error("{what} must be positive and finite, got {value}")]
    NotPositive {
        /// What it is.
        what: String,
        /// The number.
        value: f64,
    },
    /// Too few rows asked for.
    #[error("an animation needs at least 2 rows, got a maximum of {max_frames}")]
    TooFewFrames {
        /// The number asked for.
        max_frames: usize,
    },
    /// The data can't be written as JSON.
    #[error("the animation's data can't be written: {0}")]
    Json(#[from] serde_json::Error),
    /// The MCAP file can't be written.
    #[cfg(feature = "mcap")]
    #[error("the MCAP file can't be written: {0}")]
    Mcap(#[from] mcap::McapError),
}
