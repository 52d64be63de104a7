//! Why coverage can't be counted.

/// Why coverage can't be counted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CoverageError {
    /// A length that isn't positive.
    #[error("{what} must be positive and finite, got {value_m} m")]
    NonPositiveLength {
        /// Which.
        what: &'static str,
        /// Its value, m.
        value_m: f64,
    },
    /// A field of view that isn't one.
    #[error("the {which} field of view must lie between 0 and π rad, got {value_rad}")]
    BadField {
        /// Horizontal or vertical.
        which: &'static str,
        /// Its value, rad.
        value_rad: f64,
    },
    /// Distances in the wrong order.
    #[error("a camera's range needs 0 <= near < far, got {near_m} m to {far_m} m")]
    BadRange {
        /// Smallest distance, m.
        near_m: f64,
        /// Greatest distance, m.
        far_m: f64,
    },
    /// A volume that leaves the room.
    #[error(
        "the volume must lie inside the room of {room_m:?} m (length, width, height), got a reach of {reach_m:?} m"
    )]
    VolumeOutside {
        /// Its farthest corner, W, m.
        reach_m: [f64; 3],
        /// The room, m.
        room_m: [f64; 3],
    },
    /// A camera that isn't in the room.
    #[error(
        "camera {index} must be inside the room of {room_m:?} m (length, width, height), got {position_m:?} m"
    )]
    CameraOutside {
        /// Which, from 0.
        index: usize,
        /// Where, W, m.
        position_m: [f64; 3],
        /// The room, m.
        room_m: [f64; 3],
    },
    /// A camera that looks nowhere.
    #[error(
        "camera {index}: azimuth and elevation must be finite, got {azimuth_rad} and {elevation_rad} rad"
    )]
    NoDirection {
        /// Which, from 0.
        index: usize,
        /// Azimuth, rad.
        azimuth_rad: f64,
        /// Elevation, rad.
        elevation_rad: f64,
    },
    /// More grid points than is sensible.
    #[error("the volume may have at most {limit} cells, got {points:.0} of {spacing_m} m: use larger cells")]
    TooManyPoints {
        /// Edge of a cell, m.
        spacing_m: f64,
        /// How many there would be.
        points: f64,
        /// How many there may be.
        limit: usize,
    },
    /// No cameras, or more than can be placed.
    #[error("a rig needs 1 to {limit} cameras, got {cameras}")]
    BadCount {
        /// How many were asked for.
        cameras: usize,
        /// How many there may be.
        limit: usize,
    },
    /// Heights in the wrong order or outside the room.
    #[error(
        "cameras between {least_m} m and {most_m} m over the floor: the first must be at least 0 and below the second, the second no more \
         than the room's {room_m} m"
    )]
    BadHeights {
        /// Least height, m.
        least_m: f64,
        /// Greatest height, m.
        most_m: f64,
        /// Height of the room, m.
        room_m: f64,
    },
    /// Nothing asked.
    #[error("at least one camera must see a marker, got 0")]
    NobodyNeeded,
}
