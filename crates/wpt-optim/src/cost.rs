//! The cost: errors of range, incidence and spot, and penalties for leaving the limits.
//!
//! ```text
//! e_R = R/R_max,  e_α = α/α_max,  e_s = ‖s‖/s_max
//! Φ   = 1/T ∫ Σ w_i f(e_i²) + Σ p_j f(v_j²) dt
//! f(s) = s up to Q²,  Q² (1 + ln(s/Q²)) beyond
//! ```
//!
//! with Q = [`BEND`] limits: inside, the thesis' mean of the weighted squares; beyond, still growing, with a continuous slope, but
//! slowly, so that a glance at the receiver's back (a spot kilometres away on its plane) does not drown all else. Violations, each zero
//! within its limit:
//!
//! | violation v | of |
//! | --- | --- |
//! | `ε/ε_max − 1` | lost target: the receiver's angle ε off the optical axis, and the camera's half angle of view ε_max |
//! | `1 − a/(‖s‖ + w)` | overfill: how much of the reach of the spot, of radius w, is over the edge of the receiver, a from its centre |
//! | `(h_min − h)/1 m` | the ground |
//! | `√Σ (u_i − sat u_i)²/(u_max − u_min)` | saturation: commands beyond the rotors' limits, whether the model has limits or not |
//!
//! Kinks: where a violation begins. Source: thesis 7.5; bend, violations and their weights are *choices*.

use crate::error::ProblemError;
use ets::{Aperture, Ets, GimbalState, Light, Station};
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Flight, Vehicle};
use quad_math::{Real, atan2, constant, sqrt};
use serde::{Deserialize, Serialize};

/// Ratio Q to a limit beyond which a term grows with the logarithm only.
pub const BEND: f64 = 3.0;

/// Greatest weight: seven terms of at most a hundred each stay below [`FAILURE`]. Weights count relative to each other.
pub const HEAVIEST: f64 = 100.0;

/// What each instant costs after a flight has failed: more than any instant of a flight that has not.
pub const FAILURE: f64 = 1e5;

/// Distance from the origin beyond which a flight counts as failed, m.
pub const LOST_M: f64 = 1e3;

/// Under every root, so that its derivative at zero is finite, in squared units of what is rooted.
const TINY: f64 = 1e-24;

/// Weights w of the errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Weights {
    /// Of the range.
    pub range: f64,
    /// Of the incidence.
    pub incidence: f64,
    /// Of the spot's offset.
    pub spot: f64,
}

/// Weights p of the penalties, and the limits that the station doesn't have.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Penalties {
    /// Of a lost target.
    pub lost_target: f64,
    /// Of overfill.
    pub overfill: f64,
    /// Of the ground.
    pub ground: f64,
    /// Of saturation.
    pub saturation: f64,
    /// Least height h_min of the vehicle's centre of mass, m.
    pub least_height_m: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            range: 1.0,
            incidence: 1.0,
            spot: 1.0,
        }
    }
}

impl Default for Penalties {
    fn default() -> Self {
        Self {
            lost_target: 10.0,
            overfill: 10.0,
            ground: 10.0,
            saturation: 10.0,
            least_height_m: 0.5,
        }
    }
}

/// One number per term of the cost: three errors, four penalties.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Terms<R> {
    /// Error of range.
    pub range: R,
    /// Error of incidence.
    pub incidence: R,
    /// Error of the spot.
    pub spot: R,
    /// Lost target.
    pub lost_target: R,
    /// Overfill.
    pub overfill: R,
    /// Ground.
    pub ground: R,
    /// Saturation.
    pub saturation: R,
}

impl<R: Copy> Terms<R> {
    /// Names, in the order of [`Self::array`].
    pub const NAMES: [&'static str; 7] = [
        "range",
        "incidence",
        "spot",
        "lost target",
        "overfill",
        "ground",
        "saturation",
    ];

    /// The terms in order.
    #[inline(always)]
    pub fn array(&self) -> [R; 7] {
        [
            self.range,
            self.incidence,
            self.spot,
            self.lost_target,
            self.overfill,
            self.ground,
            self.saturation,
        ]
    }

    /// The reverse of [`Self::array`].
    #[inline(always)]
    pub fn from_array([range, incidence, spot, lost_target, overfill, ground, saturation]: [R; 7]) -> Self {
        Self {
            range,
            incidence,
            spot,
            lost_target,
            overfill,
            ground,
            saturation,
        }
    }
}

/// The cost function over one kind of scalar: limits and weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cost<R: Real> {
    weights: [R; 7],
    range_limit: R,
    incidence_limit: R,
    spot_limit: R,
    view_limit: R,
    edge: R,
    least_height: R,
    light: Light<R>,
    commands: CommandLimits<R>,
}

/// What an instant looks like: geometry and terms of the cost, not yet weighted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glance<R: Real> {
    /// Range R, m.
    pub(crate) range: R,
    /// Incidence α, rad.
    pub(crate) incidence: R,
    /// Spot offset to the right and up, seen by who looks at the receiver, m.
    pub(crate) spot: nalgebra::Vector2<R>,
    /// The terms.
    pub(crate) terms: Terms<R>,
}

/// `f(s)` of a squared ratio (see the module's head).
#[inline(always)]
pub(crate) fn bent<R: Real>(square: R) -> R {
    let bend: R = constant(BEND * BEND);
    square.simd_min(bend) + bend * (square.simd_max(bend) / bend).simd_ln()
}

/// `f(v²)` of a violation; zero where `v ≤ 0`.
#[inline(always)]
fn penalty<R: Real>(violation: R) -> R {
    let v = violation.simd_max(R::zero());
    bent(v * v)
}

fn check(key: &'static str, value: f64, positive: bool) -> Result<f64, ProblemError> {
    if value.is_finite() && value >= 0.0 && !(positive && value == 0.0) {
        Ok(value)
    } else {
        Err(ProblemError::BadNumber { key, value, positive })
    }
}

fn weight(key: &'static str, value: f64) -> Result<f64, ProblemError> {
    if value > HEAVIEST {
        return Err(ProblemError::TooHeavy { key, value });
    }
    check(key, value, false)
}

/// Half of the camera's narrower angle of view, rad.
fn view_limit(station: &Station) -> f64 {
    let camera = &station.camera;
    let half = |i: usize| {
        let near = camera.principal_point[i].min(camera.pixels[i] - camera.principal_point[i]);
        (near / camera.focal_length).atan()
    };
    half(0).min(half(1))
}

impl Cost<f64> {
    /// The cost function of a station's limits with these weights.
    pub(crate) fn new(
        station: &Station,
        vehicle: &Vehicle,
        weights: &Weights,
        penalties: &Penalties,
    ) -> Result<Self, ProblemError> {
        let edge = match station.receiver.aperture {
            Aperture::Disc { radius } => radius,
            Aperture::Rectangle {
                half_width,
                half_height,
            } => half_width.min(half_height),
        };
        Ok(Self {
            weights: [
                weight("weights.range", weights.range)?,
                weight("weights.incidence", weights.incidence)?,
                weight("weights.spot", weights.spot)?,
                weight("penalties.lost_target", penalties.lost_target)?,
                weight("penalties.overfill", penalties.overfill)?,
                weight("penalties.ground", penalties.ground)?,
                weight("penalties.saturation", penalties.saturation)?,
            ],
            range_limit: check("limits.range", station.limits.range, true)?,
            incidence_limit: check("limits.incidence", station.limits.incidence, true)?,
            spot_limit: check("limits.spot", station.limits.spot, true)?,
            view_limit: check("half angle of view", view_limit(station), true)?,
            edge: check("edge of the receiver", edge, true)?,
            least_height: check("penalties.least_height_m", penalties.least_height_m, false)?,
            light: station.beam.through(&station.atmosphere),
            commands: CommandLimits::of(vehicle),
        })
    }

    /// The same cost over another scalar.
    pub(crate) fn over<R: Real>(&self) -> Cost<R> {
        let l = &self.light;
        Cost {
            weights: self.weights.map(constant),
            range_limit: constant(self.range_limit),
            incidence_limit: constant(self.incidence_limit),
            spot_limit: constant(self.spot_limit),
            view_limit: constant(self.view_limit),
            edge: constant(self.edge),
            least_height: constant(self.least_height),
            light: Light {
                power: constant(l.power),
                waist_squared: constant(l.waist_squared),
                divergence_squared: constant(l.divergence_squared),
                attenuation: constant(l.attenuation),
            },
            commands: CommandLimits {
                minimum: constant(self.commands.minimum),
                maximum: constant(self.commands.maximum),
            },
        }
    }
}

impl<R: Real> Cost<R> {
    /// `Σ w_i f_i` of terms, or of their means.
    #[inline(always)]
    pub(crate) fn weighted(&self, terms: &Terms<R>) -> R {
        let terms = terms.array();
        (0..7).fold(R::zero(), |sum, i| sum + self.weights[i] * terms[i])
    }

    /// Geometry and terms at an instant; `commands` are the rotors' commands u in force.
    #[inline(always)]
    pub(crate) fn glance(
        &self,
        ets: &Ets<R>,
        gimbal: &GimbalState<R>,
        flight: &Flight<R>,
        commands: &[R; 4],
    ) -> Glance<R> {
        let face = ets.receiver.on(&flight.position, &flight.rotation.matrix);
        let ray = ets.ray(gimbal);
        let link = face.under(&ray);
        let from_axes = face.centre - ets.pedestal.origin();
        let spot_squared = link.spot.norm_squared();
        let radius_squared = self.light.radius_squared(link.range);
        let reach = sqrt(spot_squared + constant(TINY)) + sqrt(radius_squared);
        let square = |ratio: R| ratio * ratio;
        Glance {
            range: link.range,
            incidence: link.incidence,
            spot: link.spot,
            terms: Terms {
                range: bent(square(link.range / self.range_limit)),
                incidence: bent(square(link.incidence / self.incidence_limit)),
                spot: bent(spot_squared / square(self.spot_limit)),
                lost_target: penalty(angle(&ray.direction, &from_axes) / self.view_limit - R::one()),
                overfill: penalty(R::one() - self.edge / reach),
                ground: penalty(self.least_height + flight.position.z),
                saturation: bent(self.excess_squared(commands)),
            },
        }
    }

    /// Commands in the middle of their limits.
    pub(crate) fn midway(&self) -> [R; 4] {
        [(self.commands.minimum + self.commands.maximum) * constant(0.5); 4]
    }

    /// Square of the commands' excess over their limits, relative to the range of commands, summed over the rotors.
    #[inline(always)]
    fn excess_squared(&self, commands: &[R; 4]) -> R {
        let l = &self.commands;
        let span = l.maximum - l.minimum;
        commands.iter().fold(R::zero(), |sum, &u| {
            let excess = (u - u.simd_clamp(l.minimum, l.maximum)) / span;
            sum + excess * excess
        })
    }
}

/// Angle between a unit vector and a vector, rad.
#[inline(always)]
fn angle<R: Real>(direction: &Vector3<R>, line: &Vector3<R>) -> R {
    let across = direction.cross(line).norm_squared();
    atan2(sqrt(across + constant(TINY)), direction.dot(line))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quad_math::jacobian;

    #[test]
    fn exact_squares_within_the_bend_and_growth_with_a_continuous_slope_beyond() {
        assert_eq!(bent(0.0), 0.0);
        let square = BEND * BEND;
        assert_eq!(bent(0.9 * square), 0.9 * square);
        // Q² (1 + ln e) = 2 Q².
        assert!((bent(square * std::f64::consts::E) - 2.0 * square).abs() < 1e-13);
        for part in [1.0 - 1e-6, 1.0 + 1e-6] {
            // d/ds is 1 below and Q²/s above: 1 − 1e-6.
            let slope = jacobian(|x| [bent(x[0])], [part * square]).x;
            assert!((slope - 1.0).abs() < 2e-6, "{slope} at {part} Q²");
        }
        assert!(bent(1e300_f64).is_finite() && bent(1e300) > bent(1e299));
        assert_eq!(penalty(-3.0), 0.0);
    }

    #[test]
    fn exact_half_the_narrower_angle_of_view() {
        // 240 rows of 6 µm behind 4 mm: atan(1.44/4) = 19.8°.
        let limit = view_limit(&Station::nominal());
        assert!((limit - (1.44_f64 / 4.0).atan()).abs() < 1e-15);
    }
}
