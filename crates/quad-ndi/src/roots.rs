//! Roots of a real polynomial as the eigenvalues of its companion matrix.
//!
//! The independent check of the Routh array, and the source of damping and frequency of each mode.

use crate::routh::{PolynomialError, checked_degree};
use faer::Mat;
use nalgebra::Complex;

/// The roots of the polynomial with these coefficients in descending powers, in no particular order.
///
/// Time is scaled by the geometric mean of the roots' magnitudes first, so that fast and slow loops are
/// found with the same relative accuracy. A root repeated `m` times is accurate to about `ε^(1/m)` only.
///
/// ```
/// let roots = quad_ndi::roots::roots(&[1.0, 3.0, 2.0])?; // (s + 1)(s + 2)
/// let sum: f64 = roots.iter().map(|root| root.re).sum();
/// assert!((sum + 3.0).abs() < 1e-14);
/// # Ok::<(), quad_ndi::routh::PolynomialError>(())
/// ```
///
/// # Errors
/// As [`RouthArray::new`](crate::routh::RouthArray::new), or if the eigenvalue iteration does not converge.
pub fn roots(coefficients: &[f64]) -> Result<Vec<Complex<f64>>, PolynomialError> {
    let degree = checked_degree(coefficients)?;
    if degree == 0 {
        return Ok(Vec::new());
    }
    let leading = coefficients[0];
    let mean_magnitude = (coefficients[degree] / leading).abs().powf(1.0 / degree as f64);
    let scale = if mean_magnitude.is_finite() && mean_magnitude > 0.0 {
        mean_magnitude
    } else {
        1.0
    };

    // With s = scale · z: z^n + Σ a_k/(a₀ scale^k) z^(n - k).
    let companion = Mat::from_fn(degree, degree, |row, column| {
        if row == 0 {
            let k = column + 1;
            -coefficients[k] / leading / scale.powi(k as i32)
        } else {
            f64::from(u8::from(row == column + 1))
        }
    });
    let scaled = companion
        .eigenvalues()
        .map_err(|_| PolynomialError::NoConvergence { degree })?;
    Ok(scaled
        .into_iter()
        .map(|root| Complex::new(root.re, root.im) * scale)
        .collect())
}

/// The largest real part of the roots, rad/s: negative if all of them decay.
///
/// # Errors
/// As [`roots`]; a constant has none and gives -∞.
pub fn spectral_abscissa(coefficients: &[f64]) -> Result<f64, PolynomialError> {
    Ok(roots(coefficients)?
        .iter()
        .map(|root| root.re)
        .fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn exact_known_roots() {
        // (s + 1)(s + 2)(s² + 2s + 5): -1, -2, -1 ± 2i.
        let mut found = roots(&[1.0, 5.0, 13.0, 19.0, 10.0]).unwrap();
        found.sort_by(|a, b| (a.re, a.im).partial_cmp(&(b.re, b.im)).unwrap());
        assert_relative_eq!(found[0].re, -2.0, max_relative = 1e-13);
        let magnitudes: f64 = found.iter().map(|root| root.norm()).product();
        // Well separated roots: a few hundred units in the last place.
        assert_relative_eq!(magnitudes, 10.0, max_relative = 1e-13);
        assert_relative_eq!(
            spectral_abscissa(&[1.0, 5.0, 13.0, 19.0, 10.0]).unwrap(),
            -1.0,
            max_relative = 1e-13
        );
    }

    #[test]
    fn exact_time_scale_does_not_matter() {
        // s² + 2 ζ ω s + ω² for frequencies far apart: the abscissa is -ζ ω.
        for omega in [1e-8, 1.0, 1e8] {
            let abscissa = spectral_abscissa(&[1.0, 2.0 * 0.3 * omega, omega * omega]).unwrap();
            assert_relative_eq!(abscissa, -0.3 * omega, max_relative = 1e-14);
        }
    }

    #[test]
    fn exact_special_cases() {
        assert!(roots(&[3.0]).unwrap().is_empty());
        assert_eq!(spectral_abscissa(&[3.0]), Ok(f64::NEG_INFINITY));
        // A root at the origin makes the geometric mean zero.
        assert_relative_eq!(spectral_abscissa(&[1.0, 4.0, 0.0]).unwrap(), 0.0, epsilon = 1e-15);
        assert_eq!(roots(&[]), Err(PolynomialError::Empty));
        assert_eq!(
            roots(&[0.0, 1.0]),
            Err(PolynomialError::ZeroLeading { degree: 1 })
        );
        assert_eq!(
            roots(&[1.0, f64::NAN]),
            Err(PolynomialError::NotFinite { power: 0 })
        );
    }
}
