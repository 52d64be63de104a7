//! Settling time and natural frequency: the time after which a step response stays within 2 % of its end.
//!
//! Second order, `ÿ + 2ζω_n ẏ + ω_n² y = ω_n² r`: the remaining error `e = 1 - y` after a unit step depends
//! on `x = ω_n t` and `ζ` only, so the product `ω_n τ_s` is a function of `ζ`. At `ζ = 1` it solves
//! `(1 + x) e⁻ˣ = 0.02`: `x = 5.8339`, the rule `ω_n = 5.834/τ_s`. For other `ζ` it is found from the exact
//! response, not from the envelope (which fails near `ζ = 1`):
//!
//! * `ζ < 1`: `e = e^(-ζx) (cos βx + ζ sin(βx)/β)`, `β = √(1 - ζ²)`, has its extrema at `βx = kπ`, of
//!   magnitude `e^(-ζkπ/β)`, and is monotone in between. So the last crossing of 0.02 lies after the last
//!   extremum beyond it. The product jumps where an extremum is exactly 0.02 (the largest: `ζ = 0.78`).
//! * `ζ ≥ 1`: `e` is monotone.
//!
//! With a further real pole `p`, `e₃` is `e` through the lag `ė₃ = p (e - e₃)`; it is evaluated exactly by
//! the matrix exponential of the three-state cascade.

use nalgebra::{Matrix3, Vector3};

/// The band around the final value that counts as settled.
pub const SETTLING_BAND: f64 = 0.02;

/// Instants per unit of `1/ω_n` at which the three-state response is searched for its last crossing.
const SEARCH_INSTANTS: f64 = 50.0;

/// The slowest pole `σ` bounds the error by that of a triple pole, `(1 + y + y²/2) e⁻ʸ`, `y = σt`, which is
/// 0.0138 at this `y`: beyond it the response stays in the band.
const TRIPLE_POLE_HORIZON: f64 = 8.0;

/// Likewise for a double pole: `(1 + y) e⁻ʸ` is 0.0174 at this `y`.
const DOUBLE_POLE_HORIZON: f64 = 6.0;

/// The slowest pole over the fastest below which the search would take too long to be meant.
const SMALLEST_SEPARATION: f64 = 1e-5;

/// A loop that cannot be specified so.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoopError {
    /// A settling time that is not a positive, finite number.
    #[error("a settling time must be positive and finite, got {settling_time_s} s")]
    BadSettlingTime {
        /// The settling time given, s.
        settling_time_s: f64,
    },
    /// A damping ratio that is not a positive, finite number.
    #[error("a damping ratio must be positive and finite, got {damping}")]
    BadDamping {
        /// The damping ratio given.
        damping: f64,
    },
    /// A natural frequency, real pole or bandwidth that is not a positive, finite number.
    #[error("a frequency must be positive and finite, got {frequency_rad_s} rad/s")]
    BadFrequency {
        /// The frequency given, rad/s.
        frequency_rad_s: f64,
    },
    /// A real pole over a natural frequency that is not positive and finite, or poles so far apart (or a
    /// damping so light) that the response has no practical settling time.
    #[error(
        "the poles are too far apart: real pole {pole_ratio} times the natural frequency, damping {damping}"
    )]
    BadPoleRatio {
        /// The ratio `p/ω_n` given.
        pole_ratio: f64,
        /// The damping ratio given.
        damping: f64,
    },
}

pub(crate) fn check_damping(damping: f64) -> Result<f64, LoopError> {
    if damping.is_finite() && damping > 0.0 {
        Ok(damping)
    } else {
        Err(LoopError::BadDamping { damping })
    }
}

pub(crate) fn check_frequency(frequency_rad_s: f64) -> Result<f64, LoopError> {
    if frequency_rad_s.is_finite() && frequency_rad_s > 0.0 {
        Ok(frequency_rad_s)
    } else {
        Err(LoopError::BadFrequency { frequency_rad_s })
    }
}

fn check_settling_time(settling_time_s: f64) -> Result<f64, LoopError> {
    if settling_time_s.is_finite() && settling_time_s > 0.0 {
        Ok(settling_time_s)
    } else {
        Err(LoopError::BadSettlingTime { settling_time_s })
    }
}

/// Natural frequency `ω_n` of the second-order loop of damping `ζ` that settles in `settling_time_s`, rad/s.
///
/// ```
/// use quad_ndi::settling::natural_frequency;
/// let omega_n = natural_frequency(2.0, 1.0)?;
/// assert!((omega_n - 5.834 / 2.0).abs() < 1e-4);
/// # Ok::<(), quad_ndi::settling::LoopError>(())
/// ```
///
/// # Errors
/// A settling time or damping that is NaN, infinite or not positive.
pub fn natural_frequency(settling_time_s: f64, damping: f64) -> Result<f64, LoopError> {
    Ok(settling_product(damping)? / check_settling_time(settling_time_s)?)
}

/// Settling time `τ_s` of the second-order loop, s.
///
/// # Errors
/// A frequency or damping that is NaN, infinite or not positive.
pub fn settling_time(natural_frequency_rad_s: f64, damping: f64) -> Result<f64, LoopError> {
    Ok(settling_product(damping)? / check_frequency(natural_frequency_rad_s)?)
}

/// Natural frequency `ω_n` of the loop `(s + p)(s² + 2ζω_n s + ω_n²)` with `p = pole_ratio · ω_n` that
/// settles in `settling_time_s`, rad/s.
///
/// # Errors
/// A settling time, damping or ratio that is NaN, infinite or not positive, or poles too far apart.
pub fn natural_frequency_with_pole(
    settling_time_s: f64,
    damping: f64,
    pole_ratio: f64,
) -> Result<f64, LoopError> {
    Ok(settling_product_with_pole(damping, pole_ratio)? / check_settling_time(settling_time_s)?)
}

/// The product `ω_n τ_s` of a second-order loop of damping `ζ`.
///
/// # Errors
/// A damping that is NaN, infinite or not positive.
pub fn settling_product(damping: f64) -> Result<f64, LoopError> {
    check_damping(damping)?;
    let excess = |x: f64| second_order_error(x, damping).abs() - SETTLING_BAND;
    if damping < 1.0 {
        let half_period = std::f64::consts::PI / (1.0 - damping * damping).sqrt();
        // e^(-ζ k half_period) > 0.02 for the last time; k = 0 is the start, e = 1.
        let last_beyond = (-SETTLING_BAND.ln() / (damping * half_period)).ceil() - 1.0;
        Ok(crossing(
            excess,
            last_beyond * half_period,
            (last_beyond + 1.0) * half_period,
        ))
    } else {
        let fast = damping + (damping * damping - 1.0).sqrt();
        Ok(crossing(excess, 0.0, DOUBLE_POLE_HORIZON * fast))
    }
}

/// The error `e(x)` of the second-order step response at `x = ω_n t`.
fn second_order_error(x: f64, damping: f64) -> f64 {
    if damping < 1.0 {
        let beta = (1.0 - damping * damping).sqrt();
        (-damping * x).exp() * ((beta * x).cos() + damping * (beta * x).sin() / beta)
    } else {
        // Poles -slow, -fast with slow · fast = 1. Written so that nothing cancels as they meet:
        // e = e^(-slow x) (1 + slow (1 - e^(-d x))/d), d = fast - slow.
        let root = (damping * damping - 1.0).sqrt();
        let (slow, difference) = (1.0 / (damping + root), 2.0 * root);
        let y = difference * x;
        let mean_decay = if y > 0.0 { -(-y).exp_m1() / y } else { 1.0 };
        (-slow * x).exp() * (1.0 + slow * x * mean_decay)
    }
}

/// The product `ω_n τ_s` of a loop of a second-order part of damping `ζ` and a real pole
/// `p = pole_ratio · ω_n`.
///
/// The last crossing is searched at 50 instants per `1/ω_n` and then refined to rounding.
///
/// # Errors
/// A damping or ratio that is NaN, infinite or not positive, or poles too far apart.
pub fn settling_product_with_pole(damping: f64, pole_ratio: f64) -> Result<f64, LoopError> {
    check_damping(damping)?;
    let slow = if damping < 1.0 {
        damping
    } else {
        1.0 / (damping + (damping * damping - 1.0).sqrt())
    };
    let slowest = slow.min(pole_ratio);
    let is_sane =
        pole_ratio.is_finite() && slowest > SMALLEST_SEPARATION && pole_ratio < 1.0 / SMALLEST_SEPARATION;
    if !is_sane {
        return Err(LoopError::BadPoleRatio { pole_ratio, damping });
    }
    // (e, ė, e₃) in the time x = ω_n t.
    #[rustfmt::skip]
    let cascade = Matrix3::new(
        0.0,        1.0,            0.0,
        -1.0,       -2.0 * damping, 0.0,
        pole_ratio, 0.0,            -pole_ratio,
    );
    let start = Vector3::new(1.0, 0.0, 1.0);
    let is_beyond = |state: &Vector3<f64>| state.z.abs() > SETTLING_BAND;

    let step = 1.0 / SEARCH_INSTANTS;
    let transition = (cascade * step).exp();
    let instants = (TRIPLE_POLE_HORIZON / slowest * SEARCH_INSTANTS).ceil() as u64;
    let mut state = start;
    let (mut last_beyond, mut state_there) = (0, start);
    for k in 1..=instants {
        state = transition * state;
        if is_beyond(&state) {
            (last_beyond, state_there) = (k, state);
        }
    }
    let excess = |x: f64| ((cascade * x).exp() * state_there).z.abs() - SETTLING_BAND;
    Ok(last_beyond as f64 * step + crossing(excess, 0.0, step))
}

/// Where `f`, positive at `low` and not positive at `high`, changes sign: bisection to the last bit.
pub(crate) fn crossing(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return high;
        }
        if f(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn thesis_critical_damping() {
        // 5.834 in the source, to four digits.
        assert_relative_eq!(settling_product(1.0).unwrap(), 5.834, epsilon = 5e-4);
    }

    #[test]
    fn exact_critical_damping_solves_its_equation() {
        let x = settling_product(1.0).unwrap();
        // The slope there is x e⁻ˣ = 0.017: a few roundings of 0.02.
        assert_relative_eq!((1.0 + x) * (-x).exp(), SETTLING_BAND, max_relative = 1e-14);
    }

    #[test]
    fn exact_error_is_continuous_through_critical_damping() {
        for x in [0.1, 1.0, 5.0, 10.0] {
            let critical = second_order_error(x, 1.0);
            for damping in [1.0 - 1e-9, 1.0 + 1e-9] {
                // The sensitivity to ζ is at most of order x³ e⁻ˣ ≈ 1.
                assert!((second_order_error(x, damping) - critical).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn exact_light_damping_approaches_its_envelope() {
        // The last crossing precedes the envelope's by at most half an oscillation.
        for damping in [0.01, 0.05, 0.1] {
            let beta = (1.0_f64 - damping * damping).sqrt();
            let envelope = -(SETTLING_BAND * beta).ln() / damping;
            let product = settling_product(damping).unwrap();
            assert!(product <= envelope && product > envelope - std::f64::consts::PI / beta);
        }
    }

    #[test]
    fn exact_heavy_damping_approaches_the_slow_pole() {
        // e → fast/(fast - slow) e^(-slow x).
        let damping = 50.0_f64;
        let root = (damping * damping - 1.0).sqrt();
        let (slow, fast) = (1.0 / (damping + root), damping + root);
        let expected = (fast / (2.0 * root) / SETTLING_BAND).ln() / slow;
        assert_relative_eq!(settling_product(damping).unwrap(), expected, max_relative = 1e-12);
    }

    #[test]
    fn exact_the_response_stays_in_the_band() {
        for damping in [0.05, 0.3, 0.7, 0.78, 0.79, 0.9, 0.999, 1.0, 1.001, 1.5, 4.0] {
            let product = settling_product(damping).unwrap();
            // Just before it is outside, from then on inside.
            assert!(second_order_error(product * (1.0 - 1e-9), damping).abs() > SETTLING_BAND);
            for k in 0..5000 {
                let x = product * (1.0 + f64::from(k) / 1000.0);
                assert!(
                    second_order_error(x, damping).abs() <= SETTLING_BAND * (1.0 + 1e-12),
                    "ζ = {damping}"
                );
            }
        }
    }

    #[test]
    fn exact_fast_real_pole_only_delays() {
        // A fast pole delays a slow response by 1/p, with an error of the second order in 1/p.
        let second = settling_product(1.0).unwrap();
        for ratio in [50.0, 100.0, 500.0] {
            let delay = settling_product_with_pole(1.0, ratio).unwrap() - second;
            assert!((delay * ratio - 1.0).abs() < 2.0 / ratio, "{delay}");
        }
    }

    #[test]
    fn exact_slow_real_pole_rules() {
        // e₃ → e^(-pt)/(1 - 2ζp + p²) in units of 1/ω_n: the residue of the pole at -p.
        let (damping, p) = (0.7, 0.02);
        let expected = (1.0 / (1.0 - 2.0 * damping * p + p * p) / SETTLING_BAND).ln() / p;
        assert_relative_eq!(
            settling_product_with_pole(damping, p).unwrap(),
            expected,
            max_relative = 1e-9
        );
    }

    #[test]
    fn exact_triple_pole() {
        let y = settling_product_with_pole(1.0, 1.0).unwrap();
        // Exponentials of defective matrices by scaling and squaring: a few digits of the sixteen lost.
        assert_relative_eq!(
            (1.0 + y + 0.5 * y * y) * (-y).exp(),
            SETTLING_BAND,
            max_relative = 1e-11
        );
    }

    #[test]
    fn exact_round_trip() {
        let omega = natural_frequency(3.0, 0.8).unwrap();
        assert_relative_eq!(settling_time(omega, 0.8).unwrap(), 3.0, max_relative = 1e-15);
        let omega = natural_frequency_with_pole(2.0, 1.0, 20.0).unwrap();
        assert_relative_eq!(
            omega * 2.0,
            settling_product_with_pole(1.0, 20.0).unwrap(),
            max_relative = 1e-15
        );
    }

    #[test]
    fn exact_wrong_questions_are_errors() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                natural_frequency(bad, 1.0),
                Err(LoopError::BadSettlingTime { .. })
            ));
            assert!(matches!(
                natural_frequency(1.0, bad),
                Err(LoopError::BadDamping { .. })
            ));
            assert!(matches!(
                settling_time(bad, 1.0),
                Err(LoopError::BadFrequency { .. })
            ));
            assert!(matches!(
                settling_product_with_pole(1.0, bad),
                Err(LoopError::BadPoleRatio { .. })
            ));
            assert!(matches!(
                settling_product_with_pole(bad, 1.0),
                Err(LoopError::BadDamping { .. })
            ));
        }
    }
}
