//! Rotor dynamics: transfer functions from steps or pseudo-random binary sequences, at any sampling pattern.
//!
//! ```text
//! first order             y(s) = K a / (s + a) u(s)                       level 3: bandwidth ω_R = a
//! second order            y(s) = K c_2 / (s² + c_1 s + c_2) u(s)          thrust of levels 4, 5
//! second order with zero  y(s) = K (c_1 s + c_2) / (s² + c_3 s + c_4) u(s), c_2 = c_4   reaction torque of levels 4, 5
//! ```
//!
//! plus an offset and, if asked for, a free initial state. The fit is an output-error fit in continuous time: the model is
//! simulated from the input alone, held between samples (the way a flight computer commands a rotor), by the exact solution
//! over each interval, so the sampling may be as irregular as it likes; least squares on the output by
//! Levenberg-Marquardt. Stability is built in: the denominators' coefficients are exponentials of the fitted numbers, hence
//! positive, and a denominator of order one or two with positive coefficients is stable. Real and complex poles are one
//! text. The order is chosen by the Bayesian information criterion ([`select`]), the residuals are tested for whiteness.
//!
//! Assumptions: white noise on the output, none on input and time; a linear, time-invariant rotor, hence small changes
//! about one working point. Where that fails, residuals are correlated and a warning reports it. Source: Ljung, *System
//! Identification*, 2nd ed., chapters 4, 7, 9, 16; thesis, chapter 4.5.3 and table 4.6 (coefficients; the form is ours).

mod fit;
mod model;
mod record;
mod result;
mod selection;
mod start;
#[cfg(test)]
mod tests;
mod transition;

pub use fit::{IdentificationError, identify};
pub use record::{DynamicSample, Record, RecordError, ResponseSample};
pub use result::{Coefficients, Poles, ResponseFit};
pub use selection::{Candidate, Selection, select};

use serde::{Deserialize, Serialize};

/// The form of a transfer function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Structure {
    /// `a / (s + a)`.
    FirstOrder,
    /// `c_2 / (s² + c_1 s + c_2)`.
    SecondOrder,
    /// `(c_1 s + c_2) / (s² + c_3 s + c_4)`, `c_2 = c_4`.
    SecondOrderWithZero,
}

impl Structure {
    /// All of them, in order of the number of coefficients.
    pub const ALL: [Self; 3] = [Self::FirstOrder, Self::SecondOrder, Self::SecondOrderWithZero];

    /// Number of poles.
    pub const fn order(self) -> usize {
        match self {
            Self::FirstOrder => 1,
            Self::SecondOrder | Self::SecondOrderWithZero => 2,
        }
    }
}

/// What a record began from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// From rest under the first input.
    Equilibrium,
    /// From anywhere: the initial state is fitted too.
    Free,
}
