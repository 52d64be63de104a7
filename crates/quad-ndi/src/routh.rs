//! The Routh array of a real polynomial: how many roots lie in the right half plane, without finding them.
//!
//! For `p(s) = a₀ sⁿ + a₁ sⁿ⁻¹ + … + a_n` the first two rows hold the alternate coefficients, every further
//! row follows from the two above it, `x_j = b_(j+1) - (b₀/c₀) c_(j+1)` with `b` the upper and `c` the lower
//! one, and the sign changes of the first column count the roots with positive real part.
//!
//! **A zero pivot in a row that is not zero.** The textbook replaces it by `ε → 0⁺`. Here the row, with `p`
//! leading zeros, is shifted left by `p` places and added to itself with the sign `(-1)^p`. As a polynomial
//! the row `Q` becomes `Q (1 + (-1)^p s^(2p))`, and on the imaginary axis that factor is `1 + ω^(2p) > 0`:
//! the Cauchy index, hence the number of sign changes, is that of the limit, and no small number enters.
//!
//! **A row of zeros.** The row above it is an even or odd polynomial `g` (the auxiliary polynomial) whose
//! roots are roots of `p`, symmetric about the origin; the row is replaced by `g′`. With `v` sign changes
//! below it, `g` has `v` roots in the right half plane, as many in the left, and `deg g - 2v` on the
//! imaginary axis. A second row of zeros below whose auxiliary polynomial has imaginary roots tells that
//! these are repeated. (After a zero pivot the common factor may hold roots of `1 + (-1)^p s^(2p)`, but never
//! imaginary ones: both counts stay right.)
//!
//! What counts as zero: each entry carries a bound of its rounding error, begun at [`COEFFICIENT_ULPS`] units
//! in the last place of each coefficient. An entry within its bound is zero.
//!
//! Sources: Routh (1877); Gantmacher, *The Theory of Matrices* 2, chapter XV (array, zero rows, Cauchy
//! index); Benidir and Picinbono, *IEEE Trans. Automatic Control* 35 (1990) 218-222 (shift and add).

use std::fmt;

/// How many units in the last place a coefficient may be off: a few operations made it.
pub const COEFFICIENT_ULPS: f64 = 8.0;

/// A polynomial that has no Routh array (or no roots to find).
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PolynomialError {
    /// No coefficients.
    #[error("a polynomial needs at least one coefficient")]
    Empty,
    /// The coefficient of the highest power is zero.
    #[error("the leading coefficient of a polynomial of degree {degree} must not be zero")]
    ZeroLeading {
        /// The degree that the number of coefficients implies.
        degree: usize,
    },
    /// A coefficient that is NaN or infinite.
    #[error("the coefficient of s^{power} must be finite")]
    NotFinite {
        /// Its power of s.
        power: usize,
    },
    /// An entry beyond the range of numbers, from coefficients of wildly different sizes.
    #[error("the row of s^{power} overflows: scale time")]
    Overflow {
        /// The row.
        power: usize,
    },
    /// The eigenvalue iteration did not converge.
    #[error("the eigenvalues of the companion matrix of degree {degree} could not be computed")]
    NoConvergence {
        /// The degree.
        degree: usize,
    },
}

/// Degree of a polynomial given by descending coefficients, if they are finite and the first is not zero.
pub(crate) fn checked_degree(coefficients: &[f64]) -> Result<usize, PolynomialError> {
    let degree = coefficients.len().checked_sub(1).ok_or(PolynomialError::Empty)?;
    if let Some(place) = coefficients.iter().position(|a| !a.is_finite()) {
        return Err(PolynomialError::NotFinite {
            power: degree - place,
        });
    }
    if coefficients[0] == 0.0 {
        return Err(PolynomialError::ZeroLeading { degree });
    }
    Ok(degree)
}

/// How a row came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowOrigin {
    /// From the coefficients or by the rule of two rows.
    Regular,
    /// By the rule, with this many leading zeros: the row is the sum of itself and its shifted copy.
    ZeroPivot {
        /// The number of leading zeros.
        leading_zeros: usize,
    },
    /// By the rule a row of zeros: the row is the derivative of the auxiliary polynomial above it.
    ZeroRow,
}

/// A row of the array.
#[derive(Clone, Debug, PartialEq)]
pub struct RouthRow {
    /// The power of s its first entry belongs to.
    pub power: usize,
    /// The entries, of `s^power`, `s^(power - 2)`, … Entries within their rounding error are zero.
    pub entries: Vec<f64>,
    /// How it came about.
    pub origin: RowOrigin,
}

/// What the array says about the roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// All roots in the open left half plane.
    Asymptotic,
    /// None in the right half plane, simple ones on the imaginary axis.
    Marginal {
        /// How many on the axis.
        imaginary_axis: usize,
    },
    /// Roots in the right half plane, or repeated ones on the imaginary axis.
    Unstable {
        /// How many in the right half plane, counted as often as they repeat.
        right_half_plane: usize,
        /// How many on the axis, counted as often as they repeat.
        imaginary_axis: usize,
    },
}

/// The Routh array.
///
/// ```
/// use quad_ndi::routh::{RouthArray, Stability};
/// // s³ + 2s² + 3s + 10: two roots in the right half plane.
/// let array = RouthArray::new(&[1.0, 2.0, 3.0, 10.0])?;
/// assert_eq!(array.first_column(), [1.0, 2.0, -2.0, 10.0]);
/// assert_eq!(array.stability(), Stability::Unstable { right_half_plane: 2, imaginary_axis: 0 });
/// # Ok::<(), quad_ndi::routh::PolynomialError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RouthArray {
    rows: Vec<RouthRow>,
}

/// A number and a bound of its rounding error.
#[derive(Clone, Copy)]
struct Bounded {
    value: f64,
    error: f64,
}

impl Bounded {
    const ZERO: Self = Self {
        value: 0.0,
        error: 0.0,
    };

    fn coefficient(value: f64) -> Self {
        Self {
            value,
            error: COEFFICIENT_ULPS * f64::EPSILON * value.abs(),
        }
    }

    /// `self` times a small whole number.
    fn times(self, factor: f64) -> Self {
        let value = self.value * factor;
        Self {
            value,
            error: self.error * factor.abs() + f64::EPSILON * value.abs(),
        }
    }

    fn plus(self, other: Self) -> Self {
        let value = self.value + other.value;
        Self {
            value,
            error: self.error + other.error + f64::EPSILON * value.abs(),
        }
    }

    /// `b₁ - (b₀/c₀) c₁`, zero if within the error bound.
    fn eliminated(b1: Self, b0: Self, c0: Self, c1: Self) -> Self {
        let ratio = b0.value / c0.value;
        let ratio_error = (b0.error + ratio.abs() * c0.error) / c0.value.abs() + f64::EPSILON * ratio.abs();
        let product = ratio * c1.value;
        let value = b1.value - product;
        let error = b1.error
            + ratio.abs() * c1.error
            + ratio_error * (c1.value.abs() + c1.error)
            + f64::EPSILON * (product.abs() + value.abs());
        if value.abs() <= error {
            Self { value: 0.0, error }
        } else {
            Self { value, error }
        }
    }
}

/// The row with `leading_zeros` plus its copy shifted over them, with the sign `(-1)^leading_zeros`.
fn shifted_and_added(row: &[Bounded], leading_zeros: usize) -> Vec<Bounded> {
    let sign = if leading_zeros.is_multiple_of(2) {
        1.0
    } else {
        -1.0
    };
    let shifted = row[leading_zeros..].iter().map(|entry| entry.times(sign));
    let padded = shifted.chain(std::iter::repeat(Bounded::ZERO));
    row.iter()
        .zip(padded)
        .map(|(entry, other)| entry.plus(other))
        .collect()
}

/// The derivative of the even or odd polynomial of degree `power` that the row holds.
fn derivative(row: &[Bounded], power: usize) -> Vec<Bounded> {
    let terms = row
        .iter()
        .enumerate()
        .map(|(j, entry)| entry.times(power as f64 - 2.0 * j as f64));
    // An odd row's last term is linear and stays, an even one's is constant and goes.
    terms.take(entries_of(power - 1)).collect()
}

/// How many entries the row of `s^power` has.
const fn entries_of(power: usize) -> usize {
    power / 2 + 1
}

impl RouthArray {
    /// The array of the polynomial with these real coefficients in descending powers.
    ///
    /// # Errors
    /// No coefficients, one that is not finite, a leading one that is zero; overflow on the way.
    pub fn new(coefficients: &[f64]) -> Result<Self, PolynomialError> {
        let degree = checked_degree(coefficients)?;
        let every_second = |from: usize| -> Vec<Bounded> {
            coefficients
                .iter()
                .skip(from)
                .step_by(2)
                .map(|&a| Bounded::coefficient(a))
                .collect()
        };
        let mut upper = every_second(0);
        let mut rows = vec![row_of(degree, &upper, RowOrigin::Regular)];
        let mut next = every_second(1);
        for power in (0..degree).rev() {
            if !next
                .iter()
                .all(|entry| entry.value.is_finite() && entry.error.is_finite())
            {
                return Err(PolynomialError::Overflow { power });
            }
            let (lower, origin) = regularised(next, &upper, power);
            rows.push(row_of(power, &lower, origin));
            let at = |row: &[Bounded], j: usize| row.get(j).copied().unwrap_or(Bounded::ZERO);
            let count = power.checked_sub(1).map_or(0, entries_of);
            next = (1..=count)
                .map(|j| Bounded::eliminated(at(&upper, j), upper[0], lower[0], at(&lower, j)))
                .collect();
            upper = lower;
        }
        Ok(Self { rows })
    }

    /// The rows, from the highest power down to `s⁰`.
    pub fn rows(&self) -> &[RouthRow] {
        &self.rows
    }

    /// Degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.rows.len() - 1
    }

    /// The first entries of the rows, none of them zero.
    pub fn first_column(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row.entries[0]).collect()
    }

    /// Number of roots in the open right half plane: the sign changes of the first column.
    pub fn right_half_plane(&self) -> usize {
        self.sign_changes_below(0)
    }

    /// Number of roots on the imaginary axis, the origin included, counted as often as they repeat.
    pub fn imaginary_axis(&self) -> usize {
        self.zero_rows()
            .next()
            .map_or(0, |place| self.imaginary_roots_of_auxiliary(place))
    }

    /// What the array says about the roots.
    pub fn stability(&self) -> Stability {
        let (right_half_plane, imaginary_axis) = (self.right_half_plane(), self.imaginary_axis());
        let repeated = self
            .zero_rows()
            .nth(1)
            .is_some_and(|place| self.imaginary_roots_of_auxiliary(place) > 0);
        if right_half_plane > 0 || repeated {
            Stability::Unstable {
                right_half_plane,
                imaginary_axis,
            }
        } else if imaginary_axis > 0 {
            Stability::Marginal { imaginary_axis }
        } else {
            Stability::Asymptotic
        }
    }

    /// Sign changes of the first column from row `place` on.
    fn sign_changes_below(&self, place: usize) -> usize {
        let changes = |pair: &&[RouthRow]| (pair[0].entries[0] > 0.0) != (pair[1].entries[0] > 0.0);
        self.rows[place..].windows(2).filter(changes).count()
    }

    /// The places of the rows that were zero.
    fn zero_rows(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.rows.len()).filter(|&place| self.rows[place].origin == RowOrigin::ZeroRow)
    }

    /// Imaginary roots of the auxiliary polynomial above the zero row at `place`.
    fn imaginary_roots_of_auxiliary(&self, place: usize) -> usize {
        self.rows[place - 1].power - 2 * self.sign_changes_below(place - 1)
    }
}

/// A row as it is in the array, after the special cases.
fn regularised(row: Vec<Bounded>, upper: &[Bounded], power: usize) -> (Vec<Bounded>, RowOrigin) {
    match row.iter().position(|entry| entry.value != 0.0) {
        Some(0) => (row, RowOrigin::Regular),
        Some(leading_zeros) => (
            shifted_and_added(&row, leading_zeros),
            RowOrigin::ZeroPivot { leading_zeros },
        ),
        None => (derivative(upper, power + 1), RowOrigin::ZeroRow),
    }
}

fn row_of(power: usize, entries: &[Bounded], origin: RowOrigin) -> RouthRow {
    RouthRow {
        power,
        entries: entries.iter().map(|entry| entry.value).collect(),
        origin,
    }
}

/// `power` as superscript.
fn superscript(power: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    power
        .to_string()
        .bytes()
        .map(|digit| DIGITS[usize::from(digit - b'0')])
        .collect()
}

/// A number with six significant digits, in decimals where that is short.
fn cell(value: f64) -> String {
    const DIGITS: i32 = 6;
    let magnitude = value.abs().log10().floor();
    if value == 0.0 {
        "0".to_owned()
    } else if (-3.0..f64::from(DIGITS)).contains(&magnitude) {
        let decimals = (DIGITS - 1 - magnitude as i32).unsigned_abs() as usize;
        let text = format!("{value:.decimals$}");
        if decimals == 0 {
            text
        } else {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
    } else {
        format!("{value:.5e}")
    }
}

impl fmt::Display for RouthArray {
    /// The table, one line per row: `s³ │ 1 3`; special rows say how they came about.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let label_width = superscript(self.degree()).chars().count();
        for row in &self.rows {
            write!(formatter, "s{:<label_width$} │", superscript(row.power))?;
            for entry in &row.entries {
                write!(formatter, " {:>12}", cell(*entry))?;
            }
            match row.origin {
                RowOrigin::Regular => writeln!(formatter)?,
                RowOrigin::ZeroPivot { leading_zeros } => {
                    writeln!(formatter, "   (zero pivot: shifted by {leading_zeros} and added)")?;
                }
                RowOrigin::ZeroRow => writeln!(formatter, "   (zero row: derivative of the row above)")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
