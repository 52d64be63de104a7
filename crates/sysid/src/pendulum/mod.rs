//! Moments of inertia by the bifilar torsional pendulum.
//!
//! The body hangs on two parallel strings of length L, each a distance b from the axis through its centre of mass. Turned
//! by θ it rises, and its weight drives it back. Over a quarter turn each string's lower end moves sideways by the
//! chord `2 b sin(θ/2)`, so the strings span the height h and the body has risen by z:
//!
//! ```text
//! h(θ) = √(L² − 4 b² sin²(θ/2)),   z = L − h,   z' = b² sin θ / h,   z'' = b² cos θ / h + b⁴ sin² θ / h³
//! T = ½ I θ̇² + ½ m ż² = ½ (I + m z'²) θ̇²,   V = m g z
//! ```
//!
//! Lagrange's equation with a damping moment, part viscous and part quadratic:
//!
//! ```text
//! (I + m z'²) θ̈ + m z' z'' θ̇² + m g z' = −c θ̇ − d |θ̇| θ̇
//! ```
//!
//! For small angles `z' ≈ b² θ / L`, the other terms are of higher order, and the oscillator has the period
//! `T = 2π √(I L / (m g b²))`, hence the small-angle law `I = m g b² T² / (4 π² L)`.
//!
//! - [`from_timings`]: the small-angle law, with the uncertainty from the scatter of the timings.
//! - [`fit_history`]: the full equation, fitted to the history of the angle.
//! - [`Suspension::period`]: the period at any amplitude, without damping, by quadrature.
//!
//! Assumptions: strings massless, inextensible, parallel at rest, free of twist; the body a symmetric suspension about a
//! principal axis through its centre of mass, vertical; no swinging sideways. Valid while the strings are not
//! horizontal, `2 b sin(θ/2) < L`. The relative error of I from wrong m, b, L is that of m, twice that of b and that of L;
//! it is in no interval. Air that moves along adds to I.
//! Source: thesis, section 4.4 and figure 4.5 (method); the equation is derived above.

mod fit;
mod history;
mod motion;

pub use fit::{Damping, SwingFit, fit_history};
pub use history::AngleSample;
pub use motion::{Pendulum, Swing, SwingRate};

use crate::estimate::{Estimate, Fit};
use crate::regression::{FitError, Row, linear};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The strings and what hangs on them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Suspension {
    /// Mass m, kg.
    pub mass_kg: f64,
    /// Distance b of each string from the axis, m: half their spacing.
    pub half_spacing_m: f64,
    /// Length L of the strings, m.
    pub length_m: f64,
    /// Gravitational acceleration g, m/s².
    pub gravity_m_s2: f64,
}

/// A timing by stopwatch: a row of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// How many whole periods were timed.
    pub periods: u32,
    /// How long they took together, s.
    pub duration_s: f64,
}

/// Moment of inertia from timings.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedInertia {
    /// Moment of inertia I about the vertical axis, kg m².
    pub inertia: Estimate,
    /// Period T, s: duration = T × periods, fitted through the origin; residuals are of the durations, s.
    pub period: Fit<1>,
}

/// Why a pendulum test has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PendulumError {
    /// A length, mass or acceleration outside its range.
    #[error(
        "the suspension's {what} must lie in {minimum} to {maximum} {unit}, got {value} {unit}; is the unit right?"
    )]
    Suspension {
        /// Name of the number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// Smallest value accepted.
        minimum: f64,
        /// Largest value accepted.
        maximum: f64,
    },
    /// A timing without periods, or with a period that no such pendulum has.
    #[error(
        "timing {index} (counted from 0): {periods} periods in {duration_s} s; are these full periods, and seconds?"
    )]
    Timing {
        /// Place in the order of the data.
        index: usize,
        /// Periods given.
        periods: u32,
        /// Duration given, s.
        duration_s: f64,
    },
    /// A number is NaN or infinite.
    #[error("sample {index} (counted from 0) must be finite")]
    NotFinite {
        /// Place in the order of the data.
        index: usize,
    },
    /// Time stands still or goes back.
    #[error(
        "time must increase, got {time_s} s after {before_s} s at sample {index} (counted from 0): sort the samples, remove duplicates"
    )]
    TimeNotIncreasing {
        /// Place in the order of the data.
        index: usize,
        /// Time of the sample before, s.
        before_s: f64,
        /// Its time, s.
        time_s: f64,
    },
    /// An angle beyond half a turn.
    #[error("sample {index}: {angle_rad} rad is more than half a turn; is it in degrees?")]
    Angle {
        /// Place in the order of the data.
        index: usize,
        /// The angle, rad.
        angle_rad: f64,
    },
    /// The strings would be horizontal or worse.
    #[error(
        "an amplitude of {amplitude_rad:.3} rad is beyond {limit_rad:.3} rad, where the strings would be horizontal: check b and L"
    )]
    BeyondStrings {
        /// Largest departure from the middle, rad.
        amplitude_rad: f64,
        /// Where the strings would be horizontal, rad.
        limit_rad: f64,
    },
    /// Nothing swings, or the noise drowns it, or it is sampled too slowly.
    #[error(
        "no oscillation found: steps between samples have {roughness:.2} of the signal's own mean square (2 for noise alone, \
         0 for a constant, 0.44 for ten samples per period); release it from a larger angle, sample faster"
    )]
    NoOscillation {
        /// Mean square of the steps over the variance.
        roughness: f64,
    },
    /// Less than a period and a half was recorded.
    #[error("a fit needs at least 4 passages through the middle (one and a half periods), got {crossings}")]
    TooFewPeriods {
        /// Passages through the middle.
        crossings: usize,
    },
    /// The fit was refused.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// Nodes of the quadrature of a quarter period. The integrand is smooth and periodic, so the midpoint rule converges faster
/// than any power.
const NODES: u32 = 64;
/// Periods believed, s.
const PERIODS_S: (f64, f64) = (0.02, 100.0);

impl Suspension {
    /// Checks the numbers.
    ///
    /// # Errors
    /// A number outside the range of any laboratory.
    pub fn validate(&self) -> Result<(), PendulumError> {
        let ranges = [
            ("mass", self.mass_kg, "kg", 1e-3, 1e3),
            ("half spacing", self.half_spacing_m, "m", 5e-3, 10.0),
            ("string length", self.length_m, "m", 0.02, 50.0),
            ("gravity", self.gravity_m_s2, "m/s²", 0.5, 30.0),
        ];
        for (what, value, unit, minimum, maximum) in ranges {
            // Not within the range, or NaN.
            if !(minimum..=maximum).contains(&value) {
                return Err(PendulumError::Suspension {
                    what,
                    value,
                    unit,
                    minimum,
                    maximum,
                });
            }
        }
        Ok(())
    }

    /// Stiffness for small angles, `m g b² / L`, N m/rad.
    pub fn stiffness(&self) -> f64 {
        self.mass_kg * self.gravity_m_s2 * self.half_spacing_m.powi(2) / self.length_m
    }

    /// Moment of inertia by the small-angle law, `I = m g b² T² / (4 π² L)`, kg m², of a period, s.
    pub fn inertia_of(&self, period_s: f64) -> f64 {
        self.stiffness() * (period_s / TAU).powi(2)
    }

    /// Period for small angles, s, of a moment of inertia, kg m².
    pub fn small_angle_period(&self, inertia: f64) -> f64 {
        TAU * (inertia / self.stiffness()).sqrt()
    }

    /// Angle at which the strings would be horizontal, rad; π if they never are.
    pub fn limit(&self) -> f64 {
        let ratio = self.length_m / (2.0 * self.half_spacing_m);
        if ratio < 1.0 { 2.0 * ratio.asin() } else { PI }
    }

    /// Period at an amplitude, s, without damping, by quadrature over a quarter of it:
    ///
    /// `T = 4 ∫₀^A √((I + m z'²) / (2 m g (z(A) − z(θ)))) dθ`, with `θ = A sin u`. NaN beyond [`Suspension::limit`].
    pub fn period(&self, inertia: f64, amplitude: f64) -> f64 {
        if amplitude == 0.0 {
            return self.small_angle_period(inertia);
        }
        let Self {
            mass_kg: m,
            half_spacing_m: b,
            length_m: l,
            gravity_m_s2: g,
        } = *self;
        let height = |angle: f64| (l * l - 4.0 * (b * (0.5 * angle).sin()).powi(2)).sqrt();
        let step = FRAC_PI_2 / f64::from(NODES);
        let integrand = |u: f64| {
            let angle = amplitude * u.sin();
            let slope = b * b * angle.sin() / height(angle);
            // h(θ) − h(A), by the difference of squares: no cancellation near A.
            let fall = 4.0 * b * b * (0.5 * (amplitude + angle)).sin() * (0.5 * (amplitude - angle)).sin()
                / (height(angle) + height(amplitude));
            let inertia = inertia + m * slope * slope;
            (inertia / (2.0 * m * g * fall)).sqrt() * amplitude * u.cos()
        };
        (0..NODES)
            .map(|k| 4.0 * step * integrand((f64::from(k) + 0.5) * step))
            .sum()
    }
}

/// Moment of inertia by the small-angle law, its uncertainty from the scatter of the timings.
///
/// Timings of more periods weigh more: the error of a timing is that of the stopwatch, whatever it times.
///
/// ```
/// use sysid::pendulum::{Suspension, Timing, from_timings};
/// let suspension = Suspension { mass_kg: 0.958, half_spacing_m: 0.235, length_m: 0.70, gravity_m_s2: 9.81 };
/// let timings = [20.638, 20.570, 20.574].map(|duration_s| Timing { periods: 20, duration_s });
/// let found = from_timings(&suspension, &timings)?;
/// assert!(found.inertia.interval().contains(0.0199));
/// # Ok::<(), sysid::pendulum::PendulumError>(())
/// ```
///
/// # Errors
/// Fewer than two timings, numbers outside their range.
pub fn from_timings(suspension: &Suspension, timings: &[Timing]) -> Result<TimedInertia, PendulumError> {
    suspension.validate()?;
    for (index, timing) in timings.iter().enumerate() {
        let period_s = timing.duration_s / f64::from(timing.periods);
        // Not within the range, NaN, or no period at all.
        if !(PERIODS_S.0..=PERIODS_S.1).contains(&period_s) {
            return Err(PendulumError::Timing {
                index,
                periods: timing.periods,
                duration_s: timing.duration_s,
            });
        }
    }
    let rows: Vec<Row<1>> = timings
        .iter()
        .map(|timing| Row {
            regressors: [f64::from(timing.periods)],
            y: timing.duration_s,
        })
        .collect();
    let period = linear(&rows)?;
    let [found] = period.parameters;
    let value = suspension.inertia_of(found.value);
    Ok(TimedInertia {
        inertia: found.mapped(value, 2.0 * value / found.value),
        period,
    })
}

#[cfg(test)]
mod tests;
