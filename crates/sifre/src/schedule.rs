//! Schedules: a value that changes at given instants and holds in between.

use crate::clock::instant_ns;
use quad_math::GridError;
use serde::{Deserialize, Serialize};

/// From this time on, this value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry<T> {
    /// From when, s.
    pub from_s: f64,
    /// What.
    pub value: T,
}

/// A value over time, piecewise constant: what it is depends on the time alone, so that resuming needs no memory.
///
/// In files: a list of entries in order of time.
///
/// ```
/// use sifre::Schedule;
/// let gust = Schedule::new([(2.0, [3.0, 0.0, 0.0]), (2.5, [0.0; 3])])?;
/// assert_eq!(gust.at(1_999_999_999), None);
/// assert_eq!(gust.at(2_000_000_000), Some(&[3.0, 0.0, 0.0]));
/// # Ok::<(), sifre::ScheduleError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    try_from = "Vec<Entry<T>>",
    into = "Vec<Entry<T>>",
    bound(serialize = "T: Clone + Serialize")
)]
pub struct Schedule<T> {
    entries: Vec<Entry<T>>,
    from_ns: Vec<u64>,
}

/// Why a schedule can't be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ScheduleError {
    /// A time that the clock doesn't have.
    #[error("entry {index} of the schedule: {source}")]
    Time {
        /// The entry, from 1.
        index: usize,
        /// Why.
        source: GridError,
    },
    /// An entry not later than the one before.
    #[error("entry {index} of the schedule must start later than the one before, got {from_s} s")]
    NotLater {
        /// The entry, from 1.
        index: usize,
        /// Its time, s.
        from_s: f64,
    },
    /// A number that is NaN or infinite.
    #[error("entry {index} of the schedule contains a non-finite number")]
    NotFinite {
        /// The entry, from 1.
        index: usize,
    },
}

impl<T> Schedule<T> {
    /// The schedule of these values, each from its time in s on.
    ///
    /// # Errors
    /// A time that is negative, not finite or no whole number of nanoseconds, or not later than the one before.
    pub fn new(entries: impl IntoIterator<Item = (f64, T)>) -> Result<Self, ScheduleError> {
        let entries: Vec<_> = entries
            .into_iter()
            .map(|(from_s, value)| Entry { from_s, value })
            .collect();
        Self::try_from(entries)
    }

    /// The place of the entry in force at an instant, ns, from 0; `None` before the first entry.
    #[inline]
    pub fn place_at(&self, time_ns: u64) -> Option<usize> {
        if self.from_ns.is_empty() {
            return None;
        }
        let next = self.from_ns.partition_point(|&from| from <= time_ns);
        next.checked_sub(1)
    }

    /// The value at an instant, ns; `None` before the first entry.
    #[inline]
    pub fn at(&self, time_ns: u64) -> Option<&T> {
        self.place_at(time_ns).map(|place| &self.entries[place].value)
    }

    /// The times of the entries, ns, in order.
    pub(crate) fn times(&self) -> impl Iterator<Item = u64> {
        self.from_ns.iter().copied()
    }

    /// All values in order of time.
    pub fn values(&self) -> impl Iterator<Item = &T> {
        self.entries.iter().map(|entry| &entry.value)
    }
}

impl<const N: usize> Schedule<[f64; N]> {
    /// Checks that all numbers are finite.
    pub(crate) fn check_finite(&self) -> Result<(), ScheduleError> {
        match self
            .values()
            .position(|value| !value.iter().all(|x| x.is_finite()))
        {
            Some(place) => Err(ScheduleError::NotFinite { index: place + 1 }),
            None => Ok(()),
        }
    }
}

impl<T> Default for Schedule<T> {
    /// Nothing at any time.
    fn default() -> Self {
        Self {
            entries: Vec::new(),
            from_ns: Vec::new(),
        }
    }
}

impl<T> TryFrom<Vec<Entry<T>>> for Schedule<T> {
    type Error = ScheduleError;

    fn try_from(entries: Vec<Entry<T>>) -> Result<Self, ScheduleError> {
        let mut from_ns: Vec<u64> = Vec::with_capacity(entries.len());
        for (k, entry) in entries.iter().enumerate() {
            let (index, from_s) = (k + 1, entry.from_s);
            let ns = instant_ns(from_s).map_err(|source| ScheduleError::Time { index, source })?;
            if from_ns.last().is_some_and(|&before| ns <= before) {
                return Err(ScheduleError::NotLater { index, from_s });
            }
            from_ns.push(ns);
        }
        Ok(Self { entries, from_ns })
    }
}

impl<T> From<Schedule<T>> for Vec<Entry<T>> {
    fn from(schedule: Schedule<T>) -> Self {
        schedule.entries
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_values_hold_until_the_next() {
        let schedule = Schedule::new([(0.0, 'a'), (0.5, 'b'), (1.0, 'c')]).unwrap();
        for (ns, value) in [(0, 'a'), (499_999_999, 'a'), (500_000_000, 'b'), (u64::MAX, 'c')] {
            assert_eq!(schedule.at(ns), Some(&value));
        }
        assert_eq!(Schedule::<char>::default().at(7), None);
    }

    #[test]
    fn exact_wrong_schedules_are_errors() {
        assert!(matches!(
            Schedule::new([(1.0, 0), (1.0, 1)]),
            Err(ScheduleError::NotLater { index: 2, .. })
        ));
        assert!(matches!(
            Schedule::new([(f64::NAN, 0)]),
            Err(ScheduleError::Time { index: 1, .. })
        ));
        assert!(matches!(
            Schedule::new([(-1.0, 0)]),
            Err(ScheduleError::Time { index: 1, .. })
        ));
        let gust = Schedule::new([(0.0, [f64::NAN; 3])]).unwrap();
        assert_eq!(gust.check_finite(), Err(ScheduleError::NotFinite { index: 1 }));
    }

    #[test]
    fn exact_a_schedule_survives_a_file() {
        let schedule = Schedule::new([(0.25, [1.0, 2.0]), (0.5, [0.0; 2])]).unwrap();
        let text = serde_json::to_string(&schedule).unwrap();
        assert_eq!(
            text,
            r#"[{"from_s":0.25,"value":[1.0,2.0]},{"from_s":0.5,"value":[0.0,0.0]}]"#
        );
        assert_eq!(
            serde_json::from_str::<Schedule<[f64; 2]>>(&text).unwrap(),
            schedule
        );
    }
}
