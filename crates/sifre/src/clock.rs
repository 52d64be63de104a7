//! The clock: whole nanoseconds, so that instants never drift and two rates meet exactly.
//!
//! All conversions between seconds and nanoseconds are [`TimeGrid`]'s, which knows which are exact.

use quad_math::{GridError, TimeGrid};
use serde::{Deserialize, Serialize};

/// A step of an agent or of a recorder: a positive whole number of nanoseconds. In files: seconds.
///
/// ```
/// use sifre::StepSize;
/// assert_eq!(StepSize::from_seconds(0.001)?.ns(), 1_000_000);
/// assert!(StepSize::from_seconds(0.0).is_err());
/// # Ok::<(), sifre::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct StepSize {
    ns: u64,
}

impl StepSize {
    /// A thousandth of a second.
    pub const MILLISECOND: Self = Self { ns: 1_000_000 };

    /// The step that is a small number of times longer, at least once.
    pub const fn times(self, factor: u8) -> Self {
        // 2⁵⁰ ns times 255 is below 2⁶⁴; a simulation ends at 2⁵⁰ ns, so a longer step is taken once.
        Self {
            ns: self.ns * if factor == 0 { 1 } else { factor as u64 },
        }
    }

    /// The step of a number of nanoseconds.
    ///
    /// # Errors
    /// Zero; more than 2⁵⁰ ns.
    pub const fn from_ns(ns: u64) -> Result<Self, GridError> {
        match TimeGrid::new(ns, 1) {
            Ok(_) => Ok(Self { ns }),
            Err(error) => Err(error),
        }
    }

    /// The step of a number of seconds, which must be a whole number of nanoseconds.
    ///
    /// # Errors
    /// A number that is not positive and finite, no whole number of nanoseconds, or beyond 2⁵⁰ ns.
    pub fn from_seconds(step_s: f64) -> Result<Self, GridError> {
        let ns = TimeGrid::from_seconds(step_s, step_s)?.tick_ns();
        Ok(Self { ns })
    }

    /// Its length, ns.
    pub const fn ns(self) -> u64 {
        self.ns
    }

    /// Its length h, s.
    pub const fn seconds(self) -> f64 {
        seconds(self.ns)
    }

    /// The step that is `factor` times shorter.
    ///
    /// # Errors
    /// If that is no whole number of nanoseconds.
    pub fn refined(self, factor: u64) -> Result<Self, GridError> {
        let ns = TimeGrid::new(self.ns, 1)?.refined(factor)?.tick_ns();
        Ok(Self { ns })
    }
}

impl TryFrom<f64> for StepSize {
    type Error = GridError;

    fn try_from(step_s: f64) -> Result<Self, GridError> {
        Self::from_seconds(step_s)
    }
}

impl From<StepSize> for f64 {
    fn from(step: StepSize) -> Self {
        step.seconds()
    }
}

/// An instant in s: the `f64` nearest to a number of nanoseconds up to 2⁵⁰.
pub(crate) const fn seconds(ns: u64) -> f64 {
    match TimeGrid::new(1, ns) {
        Ok(grid) => grid.end_s(),
        // Beyond the engine's clock, which stops at 2⁵⁰ ns.
        Err(_) => f64::INFINITY,
    }
}

/// An instant in ns from s; zero is an instant too.
pub(crate) fn instant_ns(time_s: f64) -> Result<u64, GridError> {
    if time_s == 0.0 {
        return Ok(0);
    }
    Ok(TimeGrid::from_seconds(time_s, time_s)?.tick_ns())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_wrong_steps_are_errors() {
        assert_eq!(StepSize::from_ns(0), Err(GridError::ZeroTick));
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.0 / 3.0, 1e300] {
            assert!(StepSize::from_seconds(wrong).is_err(), "{wrong}");
        }
        assert_eq!(instant_ns(0.0), Ok(0));
        assert!(instant_ns(-1.0).is_err() && instant_ns(f64::NAN).is_err());
    }

    proptest! {
        #[test]
        fn prop_steps_survive_a_file(ns in 1..1_u64 << 50) {
            let step = StepSize::from_ns(ns).unwrap();
            prop_assert_eq!(StepSize::from_seconds(step.seconds()), Ok(step));
            let text = serde_json::to_string(&step).unwrap();
            prop_assert_eq!(serde_json::from_str::<StepSize>(&text).unwrap(), step);
        }
    }
}
