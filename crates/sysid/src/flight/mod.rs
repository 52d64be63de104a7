//! Identification from recorded flights: thrust curve, motor lag, moments of inertia, and what a replay needs besides.
//!
//! ```text
//! thrust       −m f_z = Σ T_i,   T = k_0 + k_1 c + k_2 c²,   lag τ on the command or on the thrust      [`ThrustFit`]
//! roll, pitch  I ω̇ = M(t − δ),   M_x = −Σ y_i T_i,   M_y = Σ x_i T_i                                  [`InertiaFit`]
//! yaw          I_zz ṙ = κ (1 + s/z) Q(t − δ),   Q = −Σ s_i T_i                                           [`YawFit`]
//! ```
//!
//! f is the specific force that the accelerometer measures, c the motor commands (duty, 0 to 1), T the thrust of one rotor,
//! (x, y) its hub and s its spin in B. No rate is differentiated: a model is compared with the *increments* of the
//! gyroscope's rates over short bins, that is, both sides of the equation are integrated over the bin, and the noise of
//! the gyroscope stays on the left side, where least squares wants it.
//!
//! Assumptions: rigid body, equal rotors, no wind, small coupling between axes (the products of rates are left out: at most
//! 3 % of the angular accelerations of these flights). Axial inflow is left out: the thrust curve is that of flight near
//! hover. Residuals of a flight are correlated (what the model leaves out is), so standard errors are those of
//! [`crate::regression`]'s estimator for correlated residuals.
//!
//! Commands are held from one sample to the next. Where the true ones change in between, as in a log of every tenth command, the hold
//! weakens fast moments and delays all: at 100 samples a second and tones to 5 Hz, holding or joining by lines moves I by 2 %.
//!
//! What the data can and can't tell: inertia and lag trade places. At frequencies above `1/τ`, `ω̇/M ∝ 1/(I τ)`, and below 1 Hz
//! moments of drag that are not modelled take part. So τ is taken from the thrust, and the delay δ of the gyroscope's
//! filter (its phase grows with frequency: 20° at 8 Hz) is identified with I. In yaw only `κ/I_zz` can be identified.

mod calibration;
mod rotation;
mod signal;
mod thrust;
mod together;
mod vehicle;
mod yaw;

pub use calibration::{Calibration, calibrate};
pub use rotation::{
    Axis, InertiaFit, RotationModel, SensorDelay, identify_inertia, inertia_by_moment_regression,
};
pub use signal::Comparison;
pub use thrust::{ThrustFit, ThrustLine, ThrustSettings, identify_thrust};
pub use together::{ThrustAndInertia, Window, identify_thrust_and_inertia};
pub use vehicle::{CrazyflieIdentification, FlightTests, Part, Unseen, identify_crazyflie, vehicle_file};
pub use yaw::{YawFit, identify_yaw};

use crate::regression::FitError;
use crate::validation::AgreementError;
use quad_math::Real;

/// Thrust of one rotor at rest over its command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrustCurve<R = f64> {
    /// `k_0`, N.
    pub constant: R,
    /// `k_1`, N per unit of duty.
    pub linear: R,
    /// `k_2`, N per squared unit of duty.
    pub quadratic: R,
}

impl<R: Real> ThrustCurve<R> {
    /// `T(c) = k_0 + k_1 c + k_2 c²`, N.
    pub fn thrust(&self, command: R) -> R {
        self.constant + (self.linear + self.quadratic * command) * command
    }
}

impl ThrustCurve {
    /// `dT/dc`, N per unit of duty.
    pub fn slope(&self, command: f64) -> f64 {
        self.linear + 2.0 * self.quadratic * command
    }

    /// The command that gives a thrust, N, on the rising branch.
    pub fn command(&self, thrust: f64) -> f64 {
        let discriminant = self.linear.powi(2) + 4.0 * self.quadratic * (thrust - self.constant);
        (-self.linear + discriminant.max(0.0).sqrt()) / (2.0 * self.quadratic)
    }
}

/// What follows the command with the motor's lag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LagOn {
    /// The command itself: `T = T(c̄)` with `τ c̄̇ = c − c̄`, the form of the reference identification.
    Command,
    /// The thrust: `τ Ṫ = T(c) − T`, the form of levels 3 to 5.
    Thrust,
}

/// Why an identification from a flight is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlightError {
    /// The window has no or too few samples.
    #[error(
        "too few samples in the window {from} to {to} s, got {samples} samples; the log spans {first} to {last} s"
    )]
    TooFewSamples {
        /// Start of the window, s.
        from: f64,
        /// End of the window, s.
        to: f64,
        /// Samples in it.
        samples: usize,
        /// Start of the log, s.
        first: f64,
        /// End of the log, s.
        last: f64,
    },
    /// Commands that never change.
    #[error(
        "motor {motor}'s command is {value} throughout the window {from} to {to} s: nothing can be identified from it"
    )]
    ConstantInput {
        /// Number of the motor, from 1.
        motor: usize,
        /// The command, duty.
        value: f64,
        /// Start of the window, s.
        from: f64,
        /// End of the window, s.
        to: f64,
    },
    /// A sensor that never changes: stuck or not connected.
    #[error("the {sensor} reads {value} throughout the window: is it stuck or not connected?")]
    ConstantSensor {
        /// Which, with its unit.
        sensor: &'static str,
        /// What it reads.
        value: f64,
    },
    /// A setting that must be positive.
    #[error("{what} must be positive and finite, got {value}")]
    NotPositive {
        /// What, with its unit.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// An estimate without physical meaning: the model does not fit the data.
    #[error("{what} = {value} from these data is not physical: check the signs and the order of the motors")]
    NotPhysical {
        /// What, with its unit.
        what: &'static str,
        /// The value.
        value: f64,
    },
    /// The least-squares problem.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The comparison.
    #[error(transparent)]
    Agreement(#[from] AgreementError),
    /// The vehicle.
    #[error(transparent)]
    Vehicle(#[from] quad_dynamics::vehicle::VehicleError),
    /// A curve of the vehicle.
    #[error(transparent)]
    Curve(#[from] quad_dynamics::vehicle::derive::FitError),
}

/// The value if it is positive and finite.
fn positive(what: &'static str, value: f64) -> Result<f64, FlightError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(FlightError::NotPositive { what, value })
    }
}

#[cfg(test)]
mod tests;
