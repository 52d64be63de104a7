//! Columns of a recording at the rows that are kept.

use crate::error::AnimateError;
use sifre::Recording;
use std::collections::HashMap;

/// Some rows of a recording, equally apart in number, the first and the last among them.
pub(crate) struct Columns<'a> {
    recording: &'a Recording,
    rows: Vec<usize>,
    places: HashMap<&'a str, usize>,
    /// The instants kept, s.
    pub(crate) times_s: Vec<f64>,
}

impl<'a> Columns<'a> {
    /// At most this many rows, two at least.
    pub(crate) fn thinned(recording: &'a Recording, max_frames: usize) -> Self {
        let rows = kept_rows(recording.len(), max_frames);
        let all: Vec<f64> = recording.times_s().collect();
        let channels = recording.channels().iter().enumerate();
        Self {
            times_s: rows.iter().map(|&k| all[k]).collect(),
            places: channels.map(|(i, channel)| (channel.name.as_str(), i)).collect(),
            recording,
            rows,
        }
    }

    /// One channel at the rows kept, whatever its numbers.
    pub(crate) fn get(&self, channel: &str) -> Option<Vec<f64>> {
        let place = *self.places.get(channel)?;
        let mut wanted = self.rows.iter().peekable();
        let mut column = Vec::with_capacity(self.rows.len());
        for (k, row) in self.recording.rows().enumerate() {
            if wanted.next_if_eq(&&k).is_some() {
                column.push(row.values[place]);
            }
        }
        Some(column)
    }

    /// Channels that must be there and finite: what a pose is made of.
    pub(crate) fn pose<const N: usize>(
        &self,
        agent: &str,
        kind: &'static str,
        channels: [&str; N],
    ) -> Result<[Vec<f64>; N], AnimateError> {
        let mut all = channels.map(|_| Vec::new());
        for (column, name) in all.iter_mut().zip(channels) {
            let channel = format!("{agent}.{name}");
            let Some(found) = self.get(&channel) else {
                let agent = agent.to_owned();
                return Err(AnimateError::MissingChannel { agent, kind, channel });
            };
            if let Some(k) = found.iter().position(|x| !x.is_finite()) {
                let (time_s, value) = (self.times_s[k], found[k]);
                return Err(AnimateError::NotFinite {
                    channel,
                    time_s,
                    value,
                });
            }
            *column = found;
        }
        Ok(all)
    }
}

/// The rows kept of `len`: at most `most`, from the first to the last.
fn kept_rows(len: usize, most: usize) -> Vec<usize> {
    let most = most.max(2);
    if len <= most {
        return (0..len).collect();
    }
    // In 128 bits the product can't overflow; it is rounded down, so rows rise strictly because len > most.
    let row = |i: usize| (i as u128 * (len - 1) as u128 / (most - 1) as u128) as usize;
    (0..most).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_all_rows_are_kept_if_they_are_few() {
        assert_eq!(kept_rows(0, 5), [0_usize; 0]);
        assert_eq!(kept_rows(1, 5), [0]);
        assert_eq!(kept_rows(5, 5), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn prop_thinned_rows_rise_from_the_first_to_the_last() {
        for len in 2..200 {
            for most in 2..40 {
                let rows = kept_rows(len, most);
                assert_eq!(rows.len(), len.min(most));
                assert_eq!((rows[0], rows[rows.len() - 1]), (0, len - 1));
                assert!(rows.windows(2).all(|pair| pair[0] < pair[1]));
            }
        }
    }
}
