//! Is this a station? Every number against its range, then the numbers against each other.
//!
//! The ranges are those of any station, from a desk-top pointer to a ground telescope; they catch slips of units and of sign.

use super::{Station, StationError};
use crate::camera::MAX_SLOPE;
use crate::{Aperture, ErrorDynamics, FrameClock, GimbalAxis};
use nalgebra::Vector3;
use provenance::Quantity;

/// Relative tolerance of the normal's length and of the diffraction limit: six printed digits.
const PRINTED: f64 = 1e-6;

/// A number, and what it must be.
type Check = (Quantity, f64);

const fn check(
    key: &'static str,
    value: f64,
    unit: &'static str,
    (minimum, maximum): (f64, f64),
    hint: &'static str,
) -> Check {
    (Quantity::new(key, unit, minimum, maximum, hint), value)
}

impl Station {
    /// Checks every number against its range and the numbers against each other; `origin` names the station in messages.
    ///
    /// # Errors
    /// The first mistake found, with its key, value and range.
    pub fn validate(&self, origin: &str) -> Result<(), StationError> {
        let origin = || origin.to_owned();
        let parts = [
            self.mechanics(),
            self.camera_checks(),
            self.tracking(),
            self.light(),
        ];
        for (quantity, value) in parts.into_iter().flatten() {
            quantity.check(value).map_err(|error| StationError::Range {
                origin: origin(),
                key: quantity.key,
                error,
            })?;
        }
        for (axis, limits) in [("pan", &self.gimbal.pan), ("tilt", &self.gimbal.tilt)] {
            if limits.minimum >= limits.maximum {
                return Err(StationError::NoTravel {
                    origin: origin(),
                    axis,
                    minimum_deg: limits.minimum.to_degrees(),
                    maximum_deg: limits.maximum.to_degrees(),
                });
            }
        }
        self.optics(&origin())?;
        self.beam_and_face(&origin())
    }

    fn mechanics(&self) -> Vec<Check> {
        let place = |value| check("pedestal.position_m", value, "m", (-1e5, 1e5), "");
        let heading = check(
            "pedestal.heading_deg",
            self.pedestal.heading.to_degrees(),
            "°",
            (-720.0, 720.0),
            "",
        );
        let mut checks: Vec<Check> = self.pedestal.position.map(place).into();
        checks.push(heading);
        checks.extend(axis(
            [
                "pan.time_constant_s",
                "pan.rate_limit_deg_s",
                "pan.minimum_deg",
                "pan.maximum_deg",
            ],
            &self.gimbal.pan,
        ));
        checks.extend(axis(
            [
                "tilt.time_constant_s",
                "tilt.rate_limit_deg_s",
                "tilt.minimum_deg",
                "tilt.maximum_deg",
            ],
            &self.gimbal.tilt,
        ));
        checks
    }

    fn camera_checks(&self) -> Vec<Check> {
        let (camera, frames) = (&self.camera, &self.frames);
        let focal = "focal length over pixel pitch, are both in metres?";
        vec![
            check(
                "camera.focal_length_m",
                camera.focal_length,
                "px",
                (10.0, 1e7),
                focal,
            ),
            check("camera.pixels_px", camera.pixels[0], "px", (2.0, 1e5), ""),
            check("camera.pixels_px", camera.pixels[1], "px", (2.0, 1e5), ""),
            check("camera.quantum_px", camera.quantum, "px", (0.0, 100.0), ""),
            check("camera.frame_rate_hz", frames.rate, "Hz", (0.1, 1e5), ""),
            check(
                "camera.latency_s",
                frames.latency,
                "s",
                (0.0, 10.0),
                "is this in milliseconds?",
            ),
            check("camera.noise_px", frames.noise, "px", (0.0, 1e3), ""),
        ]
    }

    fn tracking(&self) -> Vec<Check> {
        let tracker = &self.tracker;
        let (time_constant, damping) = match tracker.dynamics {
            ErrorDynamics::FirstOrder { time_constant } => (time_constant, 1.0),
            ErrorDynamics::SecondOrder {
                natural_frequency,
                damping,
            } => (1.0 / natural_frequency, damping),
        };
        let search = &tracker.search;
        let (radius, pitch, speed) = (
            search.radius.to_degrees(),
            search.pitch.to_degrees(),
            search.speed.to_degrees(),
        );
        vec![
            check(
                "tracker.time_constant_s",
                time_constant,
                "s",
                (1e-4, 1e3),
                "is this in milliseconds?",
            ),
            check("tracker.damping", damping, "(dimensionless)", (0.05, 20.0), ""),
            check(
                "tracker.fading",
                tracker.fading,
                "(dimensionless)",
                (0.0, 0.999),
                "",
            ),
            check("tracker.hold_s", tracker.hold, "s", (0.0, 3600.0), ""),
            check("tracker.search_radius_deg", radius, "°", (0.01, 180.0), ""),
            check("tracker.search_pitch_deg", pitch, "°", (0.001, 180.0), ""),
            check("tracker.search_speed_deg_s", speed, "°/s", (0.001, 1e4), ""),
        ]
    }

    fn light(&self) -> Vec<Check> {
        let (beam, receiver, limits) = (&self.beam, &self.receiver, &self.limits);
        let nanometres = "is this in nanometres?";
        let millimetres = "is this in millimetres?";
        let mut checks = vec![
            check("laser.power_w", beam.power, "W", (1e-6, 1e7), ""),
            check(
                "laser.wavelength_m",
                beam.wavelength,
                "m",
                (1e-7, 2e-5),
                nanometres,
            ),
            check(
                "laser.waist_radius_m",
                beam.waist_radius,
                "m",
                (1e-6, 10.0),
                millimetres,
            ),
            check(
                "laser.divergence_rad",
                beam.divergence,
                "rad",
                (0.0, 0.2),
                "is this in milliradians?",
            ),
            check(
                "atmosphere.visibility_m",
                self.atmosphere.visibility,
                "m",
                (1.0, 1e6),
                "is this in kilometres?",
            ),
            check(
                "receiver.efficiency",
                receiver.efficiency,
                "(dimensionless)",
                (0.0, 1.0),
                "is this in percent?",
            ),
            check("limits.range_m", limits.range, "m", (1e-2, 1e7), ""),
            check(
                "limits.incidence_deg",
                limits.incidence.to_degrees(),
                "°",
                (0.01, 90.1),
                "",
            ),
            check("limits.spot_offset_m", limits.spot, "m", (1e-6, 1e3), millimetres),
        ];
        let side = |key, value| check(key, value, "m", (1e-6, 1e3), millimetres);
        match receiver.aperture {
            Aperture::Disc { radius } => checks.push(side("receiver.radius_m", radius)),
            Aperture::Rectangle {
                half_width,
                half_height,
            } => {
                checks.push(side("receiver.width_m", 2.0 * half_width));
                checks.push(side("receiver.height_m", 2.0 * half_height));
            }
        }
        let offset = |key, value| check(key, value, "m", (-100.0, 100.0), millimetres);
        checks.extend(beam.offset.map(|value| offset("laser.offset_m", value)));
        checks.extend(receiver.offset.map(|value| offset("receiver.offset_m", value)));
        checks
    }

    fn optics(&self, origin: &str) -> Result<(), StationError> {
        let (origin, camera) = (origin.to_owned(), &self.camera);
        let (point, pixels) = (camera.principal_point, camera.pixels);
        if !(0..2).all(|i| point[i] >= 0.0 && point[i] <= pixels[i]) {
            return Err(StationError::PrincipalPoint {
                origin,
                point,
                pixels,
            });
        }
        let reach = (0..2)
            .map(|i| point[i].max(pixels[i] - point[i]))
            .fold(0.0, f64::max);
        let slope = reach / camera.focal_length;
        if slope > MAX_SLOPE {
            return Err(StationError::TooWide {
                origin,
                slope,
                limit: MAX_SLOPE,
            });
        }
        let period = 1.0 / self.frames.rate;
        if let Err(source) = FrameClock::new(period, self.frames.rate, self.frames.latency) {
            return Err(StationError::Frames { origin, source });
        }
        // One period passes between deliveries; the second is for steps as long as a period.
        let (hold_s, least_s) = (self.tracker.hold, 2.0 * period + self.frames.latency);
        if hold_s < least_s {
            return Err(StationError::HoldTooShort {
                origin,
                hold_s,
                least_s,
            });
        }
        let [wide, high] = camera.field_of_view();
        let (pitch, view) = (self.tracker.search.pitch, wide.min(high));
        if pitch > view {
            return Err(StationError::SearchGaps {
                origin,
                pitch_deg: pitch.to_degrees(),
                view_deg: view.to_degrees(),
            });
        }
        Ok(())
    }

    fn beam_and_face(&self, origin: &str) -> Result<(), StationError> {
        let origin = origin.to_owned();
        if self.beam.quality() < 1.0 - PRINTED {
            return Err(StationError::BelowDiffraction {
                origin,
                divergence_rad: self.beam.divergence,
                limit_rad: self.beam.divergence / self.beam.quality(),
            });
        }
        let length = Vector3::from(self.receiver.normal).norm();
        if length.is_nan() || (length - 1.0).abs() > PRINTED {
            return Err(StationError::NotUnit { origin, length });
        }
        Ok(())
    }
}

/// The four numbers of an axis, by their keys.
fn axis(keys: [&'static str; 4], axis: &GimbalAxis<f64>) -> [Check; 4] {
    let angle = |key, value: f64| check(key, value.to_degrees(), "°", (-3600.0, 3600.0), "");
    [
        check(
            keys[0],
            axis.time_constant,
            "s",
            (1e-4, 100.0),
            "is this in milliseconds?",
        ),
        check(
            keys[1],
            axis.rate_limit.to_degrees(),
            "°/s",
            (1e-3, 1e4),
            "is this in rad/s?",
        ),
        angle(keys[2], axis.minimum),
        angle(keys[3], axis.maximum),
    ]
}
