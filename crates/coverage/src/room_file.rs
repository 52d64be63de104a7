//! The file of a room and its cameras.

use crate::{Camera, CoverageError, Lens, Room, Task, Volume, WallRig};
use nalgebra::Vector3;
use provenance::{ReadError, from_toml};
use serde::Deserialize;

/// A room, the volume to be covered, and its cameras, as in a TOML file; [`RoomFile::TEMPLATE`] explains the keys.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoomFile {
    room: Room,
    volume: VolumeFile,
    lens: LensFile,
    /// The rig that is looked for.
    pub rig: RigFile,
    /// How it is looked for.
    #[serde(default)]
    pub search: SearchFile,
    /// The cameras as installed.
    #[serde(default)]
    camera: Vec<CameraFile>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct VolumeFile {
    centre_m: [f64; 3],
    size_m: [f64; 3],
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LensFile {
    horizontal_field_deg: f64,
    vertical_field_deg: f64,
    near_m: f64,
    far_m: f64,
}

/// The rig that is looked for.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigFile {
    cameras: usize,
    /// Cameras that must see a marker.
    pub needed: u32,
    least_height_m: f64,
    most_height_m: f64,
}

/// How it is looked for.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SearchFile {
    spacing_m: f64,
    /// Evaluations of the search.
    pub evaluations: u64,
    /// Seed of the search.
    pub seed: u64,
}

impl Default for SearchFile {
    fn default() -> Self {
        Self {
            spacing_m: 0.2,
            evaluations: 4000,
            seed: 0,
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraFile {
    position_m: [f64; 3],
    azimuth_deg: f64,
    elevation_deg: f64,
}

impl RoomFile {
    /// A commented file to start from.
    pub const TEMPLATE: &str = include_str!("../template.toml");

    /// Reads a file's text; `origin` is its name in messages.
    ///
    /// # Errors
    /// Text that is not TOML, an unknown or missing key, a value of another type; with line and column.
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, ReadError> {
        from_toml(text, origin)
    }

    /// What should be covered.
    ///
    /// # Errors
    /// As of [`Task::new`].
    pub fn task(&self) -> Result<Task, CoverageError> {
        let volume = Volume {
            centre_m: Vector3::from(self.volume.centre_m),
            size_m: Vector3::from(self.volume.size_m),
        };
        let lens = Lens {
            horizontal_field_rad: self.lens.horizontal_field_deg.to_radians(),
            vertical_field_rad: self.lens.vertical_field_deg.to_radians(),
            near_m: self.lens.near_m,
            far_m: self.lens.far_m,
        };
        Task::new(self.room, volume, lens, self.rig.needed, self.search.spacing_m)
    }

    /// The rig that is looked for.
    ///
    /// # Errors
    /// As of [`WallRig::new`].
    pub fn wall_rig(&self) -> Result<WallRig, CoverageError> {
        let RigFile {
            cameras,
            least_height_m,
            most_height_m,
            ..
        } = self.rig;
        WallRig::new(self.room, cameras, least_height_m..=most_height_m)
    }

    /// The cameras as installed; empty if the file has none.
    pub fn installed(&self) -> Vec<Camera> {
        let camera = |file: &CameraFile| Camera {
            position_m: Vector3::from(file.position_m),
            azimuth_rad: file.azimuth_deg.to_radians(),
            elevation_rad: file.elevation_deg.to_radians(),
        };
        self.camera.iter().map(camera).collect()
    }

    /// North and east edges of the flight volume, m.
    pub fn volume_m(&self) -> [[f64; 2]; 2] {
        let VolumeFile { centre_m, size_m } = self.volume;
        [0, 1].map(|i| [centre_m[i] - 0.5 * size_m[i], centre_m[i] + 0.5 * size_m[i]])
    }
}
