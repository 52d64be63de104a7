//! From the file to the station.

use super::file::{AxisFile, Order, ReceiverFile, StationFile, TrackerFile};
use super::{Frames, LinkLimits, Station, StationError};
use crate::{
    Aperture, Atmosphere, Beam, Camera, ErrorDynamics, Gimbal, GimbalAxis, Pedestal, Receiver, Search,
    Tracker,
};

impl Station {
    /// Reads and validates a station from the text of its file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Any [`StationError`], the first that is found.
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, StationError> {
        Self::from_file(&StationFile::from_toml_str(text, origin)?, origin)
    }

    /// Takes the numbers out of a file and validates them; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Station::from_toml_str`], less what concerns the text.
    pub fn from_file(file: &StationFile, origin: &str) -> Result<Self, StationError> {
        let (camera, laser) = (&file.camera, &file.laser);
        let station = Self {
            name: file.name.clone(),
            description: file.description.clone(),
            pedestal: Pedestal {
                position: file.pedestal.position_m.value,
                heading: file.pedestal.heading_deg.value.to_radians(),
            },
            gimbal: Gimbal {
                pan: axis(&file.pan),
                tilt: axis(&file.tilt),
            },
            camera: Camera {
                focal_length: camera.focal_length_m.value / camera.pixel_pitch_m.value,
                pixels: camera.pixels_px.value,
                principal_point: camera.principal_point_px.value,
                quantum: camera.quantum_px.value,
            },
            frames: Frames {
                rate: camera.frame_rate_hz.value,
                latency: camera.latency_s.value,
                noise: camera.noise_px.value,
            },
            tracker: tracker(&file.tracker),
            beam: Beam {
                power: laser.power_w.value,
                wavelength: laser.wavelength_m.value,
                waist_radius: laser.waist_radius_m.value,
                divergence: laser.divergence_rad.value,
                offset: laser.offset_m.value,
            },
            atmosphere: Atmosphere {
                visibility: file.atmosphere.visibility_m.value,
                law: file.atmosphere.law.value,
            },
            receiver: receiver(&file.receiver, origin)?,
            limits: LinkLimits {
                range: file.limits.range_m.value,
                incidence: file.limits.incidence_deg.value.to_radians(),
                spot: file.limits.spot_offset_m.value,
            },
        };
        station.validate(origin)?;
        Ok(station)
    }
}

fn axis(file: &AxisFile) -> GimbalAxis<f64> {
    GimbalAxis {
        time_constant: file.time_constant_s.value,
        rate_limit: file.rate_limit_deg_s.value.to_radians(),
        minimum: file.minimum_deg.value.to_radians(),
        maximum: file.maximum_deg.value.to_radians(),
    }
}

fn tracker(file: &TrackerFile) -> Tracker<f64> {
    let time_constant = file.time_constant_s.value;
    Tracker {
        dynamics: match file.order.value {
            Order::First => ErrorDynamics::FirstOrder { time_constant },
            Order::Second => ErrorDynamics::SecondOrder {
                natural_frequency: 1.0 / time_constant,
                damping: 1.0,
            },
        },
        fading: file.fading.value,
        hold: file.hold_s.value,
        search: Search {
            radius: file.search_radius_deg.value.to_radians(),
            pitch: file.search_pitch_deg.value.to_radians(),
            speed: file.search_speed_deg_s.value.to_radians(),
        },
    }
}

fn receiver(file: &ReceiverFile, origin: &str) -> Result<Receiver<f64>, StationError> {
    let aperture = match (&file.radius_m, &file.width_m, &file.height_m) {
        (Some(radius), None, None) => Aperture::Disc { radius: radius.value },
        (None, Some(width), Some(height)) => Aperture::Rectangle {
            half_width: width.value / 2.0,
            half_height: height.value / 2.0,
        },
        _ => {
            return Err(StationError::Aperture {
                origin: origin.to_owned(),
            });
        }
    };
    Ok(Receiver {
        aperture,
        offset: file.offset_m.value,
        normal: file.normal.value,
        efficiency: file.efficiency.value,
    })
}
