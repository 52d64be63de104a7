//! The tracking controller: dynamic inversion of the image kinematics, so that the target's image goes to the centre.
//!
//! First order: `q̇_d = L⁻¹(−r_C/T − d)`, commanded as it is, hence `ṙ_C = −r_C/T` but for the actuator's lag.
//!
//! Second order: the image has relative degree 2 with the lag `q̈ = (u − q̇)/τ` in the chain. With
//! `v = −2ζω_n ṙ_C − ω_n² r_C` the command is `u = q̇ + τ L⁻¹(v − b)`, hence `r̈_C + 2ζω_n ṙ_C + ω_n² r_C = 0` exactly, for any
//! motion of the target that is fed forward.
//!
//! `L` is inverted from the tilt axis, whose pivot `L_22 = f (1 + ζ²)` never vanishes: pan first, from the
//! remainder `S = L_11 − L_12 L_21 / L_22 = −f (1 + η² + ζ²)(c + s ζ)/(1 + ζ²)`, then tilt for the pan that the drive will
//! really give. Singularity: where `|c + s ζ| <` [`SINGULAR`] (a target within 5.7° of the zenith or nadir)
//! that factor is held at ±[`SINGULAR`] (a kink), which bounds the pan command and leaves tilt its authority: there the image's vertical
//! error still obeys the design and the horizontal one does not; pan turns as fast as it may. Never a NaN.
//!
//! Source: the thesis' 7.3.3 names the method; this derivation is ours (`crate::image` has `L`, `d`, `b`).

use crate::gimbal::{Gimbal, GimbalCommand, GimbalState, Pedestal};
use crate::image::{ImageKinematics, PointMotion};
use crate::scalar::absolute;
use crate::search::Search;
use nalgebra::Vector2;
use quad_math::{Real, constant};

/// Least magnitude of `c + s ζ`, the horizontal share of the line of sight, that is inverted exactly.
pub const SINGULAR: f64 = 0.1;

/// The dynamics that the image error is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorDynamics<R> {
    /// `ṙ_C = −r_C/T`; neglects the actuator's lag τ, so T should be several τ.
    FirstOrder {
        /// Time constant T, s.
        time_constant: R,
    },
    /// `r̈_C + 2ζω_n ṙ_C + ω_n² r_C = 0`; the actuator's lag is inverted too.
    SecondOrder {
        /// Natural frequency ω_n, rad/s.
        natural_frequency: R,
        /// Damping ratio ζ.
        damping: R,
    },
}

/// What the tracker is designed to do with and without a target in view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracker<R> {
    /// Dynamics of the image error.
    pub dynamics: ErrorDynamics<R>,
    /// Fading factor δ of the filter of the line of sight: 0 trusts the last two frames, near 1 averages many.
    pub fading: R,
    /// How long the last rate of the line of sight is held after the last sighting, s; then the search begins.
    pub hold: R,
    /// The search.
    pub search: Search<R>,
}

/// What a tracker must know of its station.
#[derive(Clone, Copy, Debug)]
pub struct Plant<'a, R> {
    /// Where the platform points and how fast it turns, by its encoders.
    pub state: &'a GimbalState<R>,
    /// The gimbal.
    pub gimbal: &'a Gimbal<R>,
    /// Where the station stands.
    pub pedestal: &'a Pedestal<R>,
    /// The image kinematics of its camera.
    pub kinematics: ImageKinematics<R>,
}

impl Tracker<f64> {
    /// The same tracker over another scalar.
    pub fn over<R: Real>(&self) -> Tracker<R> {
        Tracker {
            dynamics: self.dynamics.over(),
            fading: constant(self.fading),
            hold: constant(self.hold),
            search: self.search.over(),
        }
    }
}

impl ErrorDynamics<f64> {
    /// The same dynamics over another scalar.
    pub fn over<R: Real>(&self) -> ErrorDynamics<R> {
        match *self {
            Self::FirstOrder { time_constant } => ErrorDynamics::FirstOrder {
                time_constant: constant(time_constant),
            },
            Self::SecondOrder {
                natural_frequency,
                damping,
            } => ErrorDynamics::SecondOrder {
                natural_frequency: constant(natural_frequency),
                damping: constant(damping),
            },
        }
    }
}

impl<R: Real> ErrorDynamics<R> {
    /// The rates to command so that the image of `target` goes to the centre; `target` is the motion, along W, of a point
    /// from the crossing of the gimbal's axes, or of its direction.
    #[inline(always)]
    pub fn command(&self, plant: &Plant<'_, R>, target: &PointMotion<R>) -> GimbalCommand<R> {
        let r_cw = plant.pedestal.rotation(plant.state).matrix.transpose();
        let target_c = target.along(&r_cw);
        let image = plant.kinematics.image(&target_c.position);
        match *self {
            Self::FirstOrder { time_constant } => {
                let drift = plant
                    .kinematics
                    .target_motion(&target_c.position, &target_c.velocity);
                let demand = -(image / time_constant) - drift;
                let achievable = |pan: R| plant.gimbal.pan.admissible(pan, plant.state.pan);
                let rates = plant.solve(&image, &demand, achievable);
                GimbalCommand {
                    pan_rate: rates.x,
                    tilt_rate: rates.y,
                }
            }
            Self::SecondOrder {
                natural_frequency,
                damping,
            } => {
                let velocity = plant.kinematics.image_velocity(plant.state, &target_c);
                let demand = -(velocity * (damping * natural_frequency * constant(2.0)))
                    - image * (natural_frequency * natural_frequency);
                plant.accelerate(&image, &target_c, &demand)
            }
        }
    }
}

impl<R: Real> Plant<'_, R> {
    /// `u = q̇ + τ L⁻¹(v − b)`.
    #[inline(always)]
    fn accelerate(
        &self,
        image: &Vector2<R>,
        target_c: &PointMotion<R>,
        demand: &Vector2<R>,
    ) -> GimbalCommand<R> {
        let (x, pan, tilt) = (self.state, &self.gimbal.pan, &self.gimbal.tilt);
        let bias = self.kinematics.image_acceleration_at_constant_rates(x, target_c);
        let achievable =
            |q_ddot: R| pan.acceleration(x.pan_rate + pan.time_constant * q_ddot, x.pan, x.pan_rate);
        let q_ddot = self.solve(image, &(demand - bias), achievable);
        GimbalCommand {
            pan_rate: x.pan_rate + pan.time_constant * q_ddot.x,
            tilt_rate: x.tilt_rate + tilt.time_constant * q_ddot.y,
        }
    }

    /// `L⁻¹ w`, pan first and within what is achievable, then tilt for that pan (see the module's head).
    #[inline(always)]
    fn solve(&self, image: &Vector2<R>, w: &Vector2<R>, achievable: impl Fn(R) -> R) -> Vector2<R> {
        let f = self.kinematics.focal_length;
        let l = self.kinematics.interaction(self.state.tilt, image);
        let (s, c) = self.state.tilt.simd_sin_cos();
        let (eta, zeta) = (image.x / f, image.y / f);
        let horizontal = away_from_zero(c + s * zeta, constant(SINGULAR));
        let one = R::one();
        let remainder = -f * (one + eta * eta + zeta * zeta) * horizontal / (one + zeta * zeta);
        let pan = achievable((w.x - l.m12 * w.y / l.m22) / remainder);
        Vector2::new(pan, (w.y - l.m21 * pan) / l.m22)
    }
}

/// `x`, held at `±least` where its magnitude is below that; zero counts as positive.
#[inline(always)]
fn away_from_zero<R: Real>(x: R, least: R) -> R {
    let held = (-least).select(x.simd_lt(R::zero()), least);
    x.select(absolute(x).simd_ge(least), held)
}
