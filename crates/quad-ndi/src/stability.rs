//! Characteristic polynomials of the lateral and longitudinal response, and the gain limits they imply.
//!
//! About hover the horizontal motion is a double integrator of the tilt. The outer loop demands the
//! acceleration `a_d = ω_p² (r - x) - 2ζ_p ω_p ẋ`; the inner loop turns the demand into acceleration,
//! `a = H(s) a_d`, with unit steady gain, `H = A(0)/A(s)`. Hence `s² x = H a_d` closes to
//!
//! `s² A(s) + A(0) (2ζ_p ω_p s + ω_p²) = 0`
//!
//! with the attitude loop's own polynomial `A(s)`:
//!
//! * levels 1 and 2, second order: `θ̈ = ω_a² (θ_d - θ) - 2ζ_a ω_a θ̇`, so `A = s² + 2ζ_a ω_a s + ω_a²`;
//! * level 3, the rotor's lag inverted and one more pole placed: `A = (s + p)(s² + 2ζ_a ω_a s + ω_a²)`;
//! * a controller that does not know the rotor, flown on level 3: the moment of the second-order law comes
//!   through the lag `1/(s/ω_R + 1)`, `s² (s/ω_R + 1) θ = ω_a² (θ_d - θ) - 2ζ_a ω_a s θ`, so
//!   `A = s³ + ω_R s² + 2ζ_a ω_a ω_R s + ω_a² ω_R` after multiplication by `ω_R`.
//!
//! Polynomials are monic, in descending powers. Valid for small tilt at constant height and yaw, with the
//! rotors off their limits.
//!
//! Gain limits. On levels 1 and 2 the Routh array (table F.1, [`TABLE_F1`]) gives, with `k = ω_a/ω_p`,
//! `k > ζ_p/ζ_a` from the row of `s²` and `ζ_p k - ζ_p²/ζ_a > ζ_a` from the row of `s¹`, that is
//! `ω_a/ω_p > ζ_p/ζ_a + ζ_a/ζ_p`: at least 2, and exactly 2 for equal damping. With a third-order attitude
//! loop see [`AttitudeLoop::position_frequency_limit_rad_s`].

use crate::settling::{LoopError, check_damping, check_frequency, crossing, natural_frequency};

/// A second-order loop `s² + 2ζω_n s + ω_n²` with positive natural frequency and damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondOrder {
    natural_frequency_rad_s: f64,
    damping: f64,
}

impl SecondOrder {
    /// The loop of natural frequency `ω_n`, rad/s, and damping `ζ`.
    ///
    /// # Errors
    /// A frequency or damping that is NaN, infinite or not positive.
    pub fn new(natural_frequency_rad_s: f64, damping: f64) -> Result<Self, LoopError> {
        Ok(Self {
            natural_frequency_rad_s: check_frequency(natural_frequency_rad_s)?,
            damping: check_damping(damping)?,
        })
    }

    /// The loop of damping `ζ` that settles to 2 % in `settling_time_s`.
    ///
    /// # Errors
    /// A settling time or damping that is NaN, infinite or not positive.
    pub fn settling_in(settling_time_s: f64, damping: f64) -> Result<Self, LoopError> {
        Self::new(natural_frequency(settling_time_s, damping)?, damping)
    }

    /// Natural frequency `ω_n`, rad/s.
    pub fn natural_frequency_rad_s(&self) -> f64 {
        self.natural_frequency_rad_s
    }

    /// Damping ratio `ζ`.
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Gain on the error `ω_n²`, 1/s².
    pub fn stiffness(&self) -> f64 {
        self.natural_frequency_rad_s * self.natural_frequency_rad_s
    }

    /// Gain on the rate `2ζω_n`, 1/s.
    pub fn rate_gain(&self) -> f64 {
        2.0 * self.damping * self.natural_frequency_rad_s
    }
}

/// The attitude loop in roll or pitch, as flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AttitudeLoop {
    /// Levels 1 and 2: the moment follows its command at once.
    SecondOrder(SecondOrder),
    /// Level 3 under a controller that inverts the rotor's lag.
    ThirdOrder {
        /// The pair of poles.
        pair: SecondOrder,
        /// The further real pole at `-p`, rad/s, > 0.
        pole_rad_s: f64,
    },
    /// Level 3 under a controller that takes it for level 1 or 2.
    IgnoredRotorLag {
        /// What the controller means to place.
        designed: SecondOrder,
        /// Rotor bandwidth `ω_R`, rad/s, > 0.
        rotor_bandwidth_rad_s: f64,
    },
}

impl AttitudeLoop {
    /// The attitude loop's own polynomial `A(s)`, monic, descending.
    pub fn characteristic(&self) -> Vec<f64> {
        match *self {
            Self::SecondOrder(pair) => vec![1.0, pair.rate_gain(), pair.stiffness()],
            Self::ThirdOrder { .. } | Self::IgnoredRotorLag { .. } => {
                let [a1, a2, a3] = self.cubic();
                vec![1.0, a1, a2, a3]
            }
        }
    }

    /// The coefficients `a₁, a₂, a₃` of a third-order `A(s)`; of a second-order one its limit `p → ∞`, over
    /// `p`.
    fn cubic(&self) -> [f64; 3] {
        match *self {
            Self::SecondOrder(pair) => [1.0, pair.rate_gain(), pair.stiffness()],
            Self::ThirdOrder { pair, pole_rad_s: p } => [
                p + pair.rate_gain(),
                pair.stiffness() + p * pair.rate_gain(),
                p * pair.stiffness(),
            ],
            Self::IgnoredRotorLag {
                designed,
                rotor_bandwidth_rad_s: omega_r,
            } => [
                omega_r,
                designed.rate_gain() * omega_r,
                designed.stiffness() * omega_r,
            ],
        }
    }

    /// The largest natural frequency `ω_p` of the position loop of damping `ζ_p` up to which it is stable
    /// around this attitude loop, rad/s; 0 if the attitude loop itself is unstable.
    ///
    /// Second order: `ω_p < ω_a/(ζ_p/ζ_a + ζ_a/ζ_p)`.
    ///
    /// Third order, `A = s³ + a₁s² + a₂s + a₃`: by Liénard and Chipart the fifth-order loop is stable if and
    /// only if the Hurwitz determinants of order 2 and 4 are positive. The first is `a₁a₂ > a₃`, the attitude
    /// loop's own; the second becomes, with `u = ω_p/(2ζ_p a₁)`, `r = a₃/(a₁a₂)` and `c = 4ζ_p² a₁a₃/a₂²`,
    ///
    /// `(1 - r)(r - u) > c u (1 - u)²`
    ///
    /// up to the smallest `u` where both sides meet, found by bisection.
    /// (Beyond it a lightly damped attitude loop may have a further island of stability, which is of no
    /// practical use.)
    ///
    /// # Errors
    /// A damping that is NaN, infinite or not positive.
    pub fn position_frequency_limit_rad_s(&self, position_damping: f64) -> Result<f64, LoopError> {
        let zeta_p = check_damping(position_damping)?;
        if let Self::SecondOrder(pair) = self {
            return Ok(pair.natural_frequency_rad_s / frequency_ratio_limit(zeta_p, pair.damping)?);
        }
        let [a1, a2, a3] = self.cubic();
        let r = a3 / (a1 * a2);
        if r >= 1.0 {
            return Ok(0.0);
        }
        let c = 4.0 * zeta_p * zeta_p * a1 * a3 / (a2 * a2);
        let margin = |u: f64| (1.0 - r) * (r - u) - c * u * (1.0 - u).powi(2);
        // The margin starts positive and is convex up to u = 2/3. Its least value there, if it has one and it
        // is negative, lies beyond the first crossing; otherwise there is no crossing before u = r but one.
        let discriminant = 1.0 - 3.0 * (1.0 - r) / c;
        let turning = (2.0 - discriminant.max(0.0).sqrt()) / 3.0;
        let high = if discriminant > 0.0 && turning < r && margin(turning) < 0.0 {
            turning
        } else {
            r
        };
        Ok(2.0 * zeta_p * a1 * crossing(margin, 0.0, high))
    }
}

/// The ratio `ω_a/ω_p` above which the response of levels 1 and 2 is stable: `ζ_p/ζ_a + ζ_a/ζ_p`.
///
/// # Errors
/// A damping that is NaN, infinite or not positive.
pub fn frequency_ratio_limit(position_damping: f64, attitude_damping: f64) -> Result<f64, LoopError> {
    let ratio = check_damping(position_damping)? / check_damping(attitude_damping)?;
    Ok(ratio + 1.0 / ratio)
}

/// The natural frequency `ω_a` below which an attitude loop that ignores the rotor's lag is stable, rad/s:
/// `2ζ_a ω_R`.
///
/// From `s³/ω_R + s² + 2ζ_a ω_a s + ω_a²`: stable if and only if `2ζ_a ω_a > ω_a²/ω_R`.
///
/// # Errors
/// A damping or bandwidth that is NaN, infinite or not positive.
pub fn ignored_lag_frequency_limit_rad_s(
    attitude_damping: f64,
    rotor_bandwidth_rad_s: f64,
) -> Result<f64, LoopError> {
    Ok(2.0 * check_damping(attitude_damping)? * check_frequency(rotor_bandwidth_rad_s)?)
}

/// The closed loop of one horizontal direction.
///
/// ```
/// use quad_ndi::routh::{RouthArray, Stability};
/// use quad_ndi::stability::{AttitudeLoop, HorizontalLoop, SecondOrder};
/// let position = SecondOrder::settling_in(2.0, 1.0)?;
/// let attitude = SecondOrder::new(10.0 * position.natural_frequency_rad_s(), 1.0)?;
/// let closed = HorizontalLoop { position, attitude: AttitudeLoop::SecondOrder(attitude) };
/// assert_eq!(RouthArray::new(&closed.characteristic())?.stability(), Stability::Asymptotic);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HorizontalLoop {
    /// The outer loop, on position.
    pub position: SecondOrder,
    /// The inner loop, on roll or pitch.
    pub attitude: AttitudeLoop,
}

impl HorizontalLoop {
    /// The characteristic polynomial `s² A(s) + A(0) (2ζ_p ω_p s + ω_p²)`, monic, descending: of order 4 on
    /// levels 1 and 2, of order 5 on level 3.
    pub fn characteristic(&self) -> Vec<f64> {
        let mut polynomial = self.attitude.characteristic();
        let steady = polynomial[polynomial.len() - 1];
        polynomial.extend([
            steady * self.position.rate_gain(),
            steady * self.position.stiffness(),
        ]);
        polynomial
    }
}

/// The loops that table F.1 speaks of: levels 1 and 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLoops {
    /// The position loop, `ζ_p, ω_p`.
    pub position: SecondOrder,
    /// The attitude loop, `ζ_a, ω_a`.
    pub attitude: SecondOrder,
}

/// An entry of a symbolic Routh array.
#[derive(Clone, Copy, Debug)]
pub struct SymbolicEntry {
    /// The power of s of its row.
    pub power: usize,
    /// Its place in the row, from 0.
    pub column: usize,
    /// The expression.
    pub expression: &'static str,
    /// Its value.
    pub value: fn(&TwoLoops) -> f64,
}

impl TwoLoops {
    /// `[ω_p, ζ_p, ω_a, ζ_a]`, the letters of the expressions.
    fn letters(&self) -> [f64; 4] {
        let (p, a) = (self.position, self.attitude);
        [
            p.natural_frequency_rad_s,
            p.damping,
            a.natural_frequency_rad_s,
            a.damping,
        ]
    }

    /// `ω_p² ω_a²`, which ends three of the rows.
    fn last(&self) -> f64 {
        self.position.stiffness() * self.attitude.stiffness()
    }

    /// The same as a loop of one horizontal direction.
    pub fn horizontal(&self) -> HorizontalLoop {
        HorizontalLoop {
            position: self.position,
            attitude: AttitudeLoop::SecondOrder(self.attitude),
        }
    }
}

/// Table F.1: the Routh array of `s⁴ + 2ζ_a ω_a s³ + ω_a² s² + 2ζ_p ω_p ω_a² s + ω_p² ω_a²`, levels 1 and 2.
///
/// Entries not listed are zero.
pub const TABLE_F1: [SymbolicEntry; 9] = [
    SymbolicEntry {
        power: 4,
        column: 0,
        expression: "1",
        value: |_| 1.0,
    },
    SymbolicEntry {
        power: 4,
        column: 1,
        expression: "ω_a²",
        value: |l| l.attitude.stiffness(),
    },
    SymbolicEntry {
        power: 4,
        column: 2,
        expression: "ω_p² ω_a²",
        value: TwoLoops::last,
    },
    SymbolicEntry {
        power: 3,
        column: 0,
        expression: "2ζ_a ω_a",
        value: |l| l.attitude.rate_gain(),
    },
    SymbolicEntry {
        power: 3,
        column: 1,
        expression: "2ζ_p ω_p ω_a²",
        value: |l| l.position.rate_gain() * l.attitude.stiffness(),
    },
    SymbolicEntry {
        power: 2,
        column: 0,
        expression: "ω_a (ω_a − ω_p ζ_p/ζ_a)",
        value: |l| {
            let [omega_p, zeta_p, omega_a, zeta_a] = l.letters();
            omega_a * (omega_a - omega_p * zeta_p / zeta_a)
        },
    },
    SymbolicEntry {
        power: 2,
        column: 1,
        expression: "ω_p² ω_a²",
        value: TwoLoops::last,
    },
    SymbolicEntry {
        power: 1,
        column: 0,
        expression: "2ω_p ω_a² [ζ_p − ζ_a ω_p/(ω_a − ω_p ζ_p/ζ_a)]",
        value: |l| {
            let [omega_p, zeta_p, omega_a, zeta_a] = l.letters();
            2.0 * omega_p
                * omega_a
                * omega_a
                * (zeta_p - zeta_a * omega_p / (omega_a - omega_p * zeta_p / zeta_a))
        },
    },
    SymbolicEntry {
        power: 0,
        column: 0,
        expression: "ω_p² ω_a²",
        value: TwoLoops::last,
    },
];

#[cfg(test)]
mod tests;
