//! The virtual bifilar pendulum: a vehicle on two strings, a camera for the angle, a stopwatch for the periods.
//!
//! The truth is integrated in Hamilton's form, to a tolerance, so that it shares neither equation nor integrator with the fit
//! that is judged by it:
//!
//! ```text
//! p = (I + m z'²) θ̇,   θ̇ = p / (I + m z'²),   ṗ = m z' z'' θ̇² − m g z' − c θ̇ − d |θ̇| θ̇
//! ```

use super::{Generator, Sensor, SensorError};
use crate::pendulum::{AngleSample, Suspension, Timing};
use nalgebra::Vector2;
use quad_dynamics::Vehicle;
use quad_math::{AdaptiveError, AdaptiveOptions, AdaptiveRun, DormandPrince};
use serde::{Deserialize, Serialize};

/// Axis of the airframe that is vertical in the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// `x_B`: moment of inertia `I_xx`.
    Roll,
    /// `y_B`: moment of inertia `I_yy`.
    Pitch,
    /// `z_B`: moment of inertia `I_zz`.
    Yaw,
}

impl Axis {
    /// All three, in the order of `x_B`, `y_B`, `z_B`.
    pub const ALL: [Self; 3] = [Self::Roll, Self::Pitch, Self::Yaw];

    /// Moment of inertia of a vehicle about this axis, kg m²: the truth of the virtual test.
    pub fn inertia(self, vehicle: &Vehicle) -> f64 {
        let i = self as usize;
        vehicle.airframe.inertia[(i, i)]
    }
}

/// Strings, air and instruments.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PendulumRig {
    /// Distance of each string from the axis, m.
    pub half_spacing_m: f64,
    /// Length of the strings, m.
    pub length_m: f64,
    /// Viscous damping, N m s/rad.
    pub viscous_n_m_s: f64,
    /// Quadratic damping, N m s²/rad².
    pub quadratic_n_m_s2: f64,
    /// Angle from which the body is let go, rad.
    pub release_rad: f64,
    /// Samples of the angle per second, Hz.
    pub rate_hz: f64,
    /// Length of the record, s.
    pub duration_s: f64,
    /// Measurement of the angle, rad.
    pub angle_rad: Sensor,
    /// Measurement of a duration, s: reaction times of start and stop together.
    pub stopwatch_s: Sensor,
}

impl Default for PendulumRig {
    /// Strings of 0.7 m at ±0.2 m, released at 40°, 20 s at 50 Hz by motion capture; damping of a bluff body, assumed.
    fn default() -> Self {
        Self {
            half_spacing_m: 0.2,
            length_m: 0.7,
            viscous_n_m_s: 1.5e-3,
            quadratic_n_m_s2: 4e-4,
            release_rad: 0.7,
            rate_hz: 50.0,
            duration_s: 20.0,
            angle_rad: Sensor {
                noise: 2e-3,
                bias: 0.01,
                quantum: 5e-4,
                ..Sensor::PERFECT
            },
            stopwatch_s: Sensor {
                noise: 0.07,
                quantum: 0.01,
                ..Sensor::PERFECT
            },
        }
    }
}

/// Why a pendulum test cannot be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PendulumRigError {
    /// A sensor's numbers are wrong.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// The suspension's numbers are wrong, or the release is beyond its strings.
    #[error(transparent)]
    Pendulum(#[from] crate::pendulum::PendulumError),
    /// A number of the rig is not finite or has the wrong sign.
    #[error("the rig's {what} must be finite and {least} or more, got {value}")]
    Number {
        /// Which.
        what: &'static str,
        /// Smallest value.
        least: f64,
        /// The value.
        value: f64,
    },
    /// The integrator refused.
    #[error(transparent)]
    Integrator(#[from] AdaptiveError),
    /// The motion could not be integrated to its end.
    #[error("the motion could not be integrated beyond {reached_s} s")]
    Unfinished {
        /// Time reached, s.
        reached_s: f64,
    },
}

/// Tolerance of the integration, rad and N m s: far below any sensor.
const TOLERANCE: f64 = 1e-11;
/// Longest step, s: the continuous extension between steps is then as good as the steps.
const LONGEST_STEP_S: f64 = 0.01;

impl PendulumRig {
    /// The suspension of this vehicle.
    pub fn suspension(&self, vehicle: &Vehicle) -> Suspension {
        Suspension {
            mass_kg: vehicle.airframe.mass,
            half_spacing_m: self.half_spacing_m,
            length_m: self.length_m,
            gravity_m_s2: vehicle.environment.gravity,
        }
    }

    /// Lets the vehicle swing about an axis and samples the angle.
    ///
    /// # Errors
    /// Numbers that make no test.
    pub fn swing(
        &self,
        vehicle: &Vehicle,
        axis: Axis,
        generator: &mut Generator,
    ) -> Result<Vec<AngleSample>, PendulumRigError> {
        let motion = self.motion(vehicle, axis, self.duration_s)?;
        let count = (self.duration_s * self.rate_hz).floor() as u32;
        let times = (0..=count).map(|k| f64::from(k) / self.rate_hz);
        Ok(times
            .filter_map(|time_s| motion.at(time_s).map(|x| (time_s, x.x)))
            .map(|(time_s, angle)| AngleSample {
                time_s,
                angle_rad: self.angle_rad.read(angle, generator),
            })
            .collect())
    }

    /// Times full periods by stopwatch, the given number of times, each from a release at the rig's angle.
    ///
    /// # Errors
    /// Numbers that make no test.
    pub fn timings(
        &self,
        vehicle: &Vehicle,
        axis: Axis,
        periods: u32,
        repetitions: u32,
        generator: &mut Generator,
    ) -> Result<Vec<Timing>, PendulumRigError> {
        let (suspension, inertia) = (self.suspension(vehicle), axis.inertia(vehicle));
        let longest_s = suspension
            .period(inertia, self.release_rad)
            .max(suspension.small_angle_period(inertia));
        // The first quarter, and as much again to be safe.
        let motion = self.motion(vehicle, axis, (f64::from(periods) + 0.5) * longest_s)?;
        let passages = passages(&motion);
        let last = passages.get(2 * periods as usize);
        let (Some(first), Some(last)) = (passages.first(), last) else {
            return Err(PendulumRigError::Unfinished {
                reached_s: motion.last.time_s,
            });
        };
        let duration_s = last - first;
        Ok((0..repetitions)
            .map(|_| Timing {
                periods,
                duration_s: self.stopwatch_s.read(duration_s, generator),
            })
            .collect())
    }

    /// The true motion from rest at the angle of release, in Hamilton's form: angle and angular momentum.
    fn motion(
        &self,
        vehicle: &Vehicle,
        axis: Axis,
        duration_s: f64,
    ) -> Result<AdaptiveRun<Vector2<f64>>, PendulumRigError> {
        self.validate()?;
        let suspension = self.suspension(vehicle);
        suspension.validate()?;
        if self.release_rad >= suspension.limit() {
            return Err(crate::pendulum::PendulumError::BeyondStrings {
                amplitude_rad: self.release_rad,
                limit_rad: suspension.limit(),
            }
            .into());
        }
        let (mass, gravity) = (suspension.mass_kg, suspension.gravity_m_s2);
        let inertia = axis.inertia(vehicle);
        let rate = |_time_s: f64, x: &Vector2<f64>| {
            let rise = suspension.rise(x.x);
            let velocity = x.y / (inertia + mass * rise.slope * rise.slope);
            let conservative = mass * rise.slope * (rise.curvature * velocity * velocity - gravity);
            let damping = (self.viscous_n_m_s + self.quadratic_n_m_s2 * velocity.abs()) * velocity;
            Vector2::new(velocity, conservative - damping)
        };
        let options = AdaptiveOptions {
            absolute_tolerance: TOLERANCE,
            relative_tolerance: TOLERANCE,
            maximum_step_s: LONGEST_STEP_S,
            ..AdaptiveOptions::default()
        };
        let run =
            DormandPrince::new(options)?.run(rate, 0.0..duration_s, Vector2::new(self.release_rad, 0.0))?;
        if !run.is_complete() {
            return Err(PendulumRigError::Unfinished {
                reached_s: run.last.time_s,
            });
        }
        Ok(run)
    }

    fn validate(&self) -> Result<(), PendulumRigError> {
        self.angle_rad.validate()?;
        self.stopwatch_s.validate()?;
        let numbers = [
            ("viscous damping, N m s", self.viscous_n_m_s, 0.0),
            ("quadratic damping, N m s²", self.quadratic_n_m_s2, 0.0),
            ("release angle, rad", self.release_rad, f64::MIN_POSITIVE),
            ("sampling rate, Hz", self.rate_hz, 0.1),
            ("duration, s", self.duration_s, 0.1),
        ];
        for (what, value, least) in numbers {
            if !(value.is_finite() && value >= least) {
                return Err(PendulumRigError::Number { what, least, value });
            }
        }
        Ok(())
    }
}

/// Times of the passages through zero, s, in order.
fn passages(motion: &AdaptiveRun<Vector2<f64>>) -> Vec<f64> {
    let samples: Vec<_> = motion.samples().collect();
    let changes = samples
        .windows(2)
        .filter(|pair| pair[0].state.x.signum() != pair[1].state.x.signum());
    changes
        .map(|pair| passage(motion, pair[0].time_s, pair[1].time_s))
        .collect()
}

/// Time of the one passage through zero between two instants, s, by bisection.
fn passage(motion: &AdaptiveRun<Vector2<f64>>, mut from: f64, mut to: f64) -> f64 {
    let angle = |time_s: f64| motion.at(time_s).map_or(f64::NAN, |x| x.x);
    let side = angle(from).signum();
    // 2⁻⁴⁰ of a step of 0.01 s: rounding.
    for _ in 0..40 {
        let middle = 0.5 * (from + to);
        if angle(middle) * side > 0.0 {
            from = middle;
        } else {
            to = middle;
        }
    }
    0.5 * (from + to)
}
