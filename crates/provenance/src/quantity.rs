//! What a number is: its key, its unit, and the range in which it can be believed.

/// Key, unit and accepted range of a number of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Full path of its key.
    pub key: &'static str,
    /// Unit, as messages print it.
    pub unit: &'static str,
    /// Smallest value accepted.
    pub minimum: f64,
    /// Largest value accepted; [`f64::MAX`] for no bound.
    pub maximum: f64,
    /// What may have happened if a value is outside; empty if there is nothing to add.
    pub hint: &'static str,
    /// The value of a file that does not have the key; `None` if every file must have it.
    pub default: Option<f64>,
}

/// A value that is not in its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RangeError {
    /// NaN or infinite.
    #[error("{value} {unit} is not a finite number")]
    NotFinite {
        /// The value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Below or above what is accepted.
    #[error("{value} {unit} is {}{}", outside(*.minimum, *.maximum, .unit), remark(.hint))]
    Outside {
        /// The value.
        value: f64,
        /// Smallest value accepted.
        minimum: f64,
        /// Largest value accepted.
        maximum: f64,
        /// Unit of the three.
        unit: &'static str,
        /// What may have happened; empty if there is nothing to add.
        hint: &'static str,
    },
}

impl Quantity {
    /// A number that every file must have.
    #[must_use]
    pub const fn new(
        key: &'static str,
        unit: &'static str,
        minimum: f64,
        maximum: f64,
        hint: &'static str,
    ) -> Self {
        Self {
            key,
            unit,
            minimum,
            maximum,
            hint,
            default: None,
        }
    }

    /// The same number, zero where a file does not have it.
    #[must_use]
    pub const fn or_zero(self) -> Self {
        Self {
            default: Some(0.0),
            ..self
        }
    }

    /// The same number within other bounds.
    #[must_use]
    pub const fn within(self, (minimum, maximum): (f64, f64), hint: &'static str) -> Self {
        Self {
            minimum,
            maximum,
            hint,
            ..self
        }
    }

    /// The value is finite and in range.
    ///
    /// # Errors
    /// [`RangeError`] with value, range and hint.
    pub fn check(&self, value: f64) -> Result<(), RangeError> {
        let Self {
            unit,
            minimum,
            maximum,
            hint,
            ..
        } = *self;
        if !value.is_finite() {
            return Err(RangeError::NotFinite { value, unit });
        }
        if value < minimum || value > maximum {
            return Err(RangeError::Outside {
                value,
                minimum,
                maximum,
                unit,
                hint,
            });
        }
        Ok(())
    }
}

/// The range that a value is not in; one-sided where there is no upper bound.
fn outside(minimum: f64, maximum: f64, unit: &str) -> String {
    if maximum == f64::MAX {
        format!("below {minimum} {unit}")
    } else {
        format!("outside {minimum} to {maximum} {unit}")
    }
}

/// A hint as the tail of a sentence, nothing if there is none.
fn remark(hint: &str) -> String {
    if hint.is_empty() {
        String::new()
    } else {
        format!("; {hint}")
    }
}
