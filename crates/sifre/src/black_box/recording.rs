//! A recording in memory: what a black box wrote, read back.

use crate::black_box::{BlackBoxError, Channel};
use crate::clock::seconds;

/// A recording: channels, instants and numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    channels: Vec<Channel>,
    times_ns: Vec<u64>,
    values: Vec<f64>,
}

/// One row of a [`Recording`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// The instant, ns.
    pub time_ns: u64,
    /// One number per channel.
    pub values: &'a [f64],
}

impl Recording {
    /// A recording of these channels without rows.
    pub fn new(channels: Vec<Channel>) -> Self {
        Self {
            channels,
            ..Self::default()
        }
    }

    /// Makes room for so many rows.
    pub(crate) fn reserve(&mut self, rows: usize) {
        self.times_ns.reserve(rows);
        self.values.reserve(rows.saturating_mul(self.channels.len()));
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`BlackBoxError::RowLength`] if it has not one number per channel; [`BlackBoxError::Time`] beyond the clock's end.
    pub fn push(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        if row.len() != self.channels.len() {
            return Err(BlackBoxError::RowLength {
                row: self.times_ns.len() + 1,
                expected: self.channels.len(),
                found: row.len(),
            });
        }
        if seconds(time_ns).is_infinite() {
            let row = self.times_ns.len() + 1;
            return Err(BlackBoxError::Time { row, time_ns });
        }
        self.times_ns.push(time_ns);
        self.values.extend_from_slice(row);
        Ok(())
    }

    /// What the columns are.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.times_ns.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.times_ns.is_empty()
    }

    /// The instants in order, ns.
    pub fn times_ns(&self) -> &[u64] {
        &self.times_ns
    }

    /// The instants in order, s.
    pub fn times_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.times_ns.iter().map(|&ns| seconds(ns))
    }

    /// The rows in order of time.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let width = self.channels.len();
        self.times_ns.iter().enumerate().map(move |(k, &time_ns)| Row {
            time_ns,
            values: &self.values[k * width..(k + 1) * width],
        })
    }

    /// One channel over time, by its name with the agent's: `alpha.position.x`.
    pub fn column(&self, name: &str) -> Option<impl Iterator<Item = f64> + '_> {
        let place = self.channels.iter().position(|channel| channel.name == name)?;
        Some(self.rows().map(move |row| row.values[place]))
    }
}
