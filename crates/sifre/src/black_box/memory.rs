//! A black box in memory.

use super::{BlackBox, BlackBoxError, Channel, Recording};

/// Keeps the recording in memory: for runs short enough, and for tests.
#[derive(Clone, Debug, Default)]
pub struct MemoryBox {
    /// What was recorded.
    pub recording: Recording,
    rows: usize,
}

impl MemoryBox {
    /// With room for so many rows from the start; it grows beyond them.
    pub fn with_room_for(rows: usize) -> Self {
        Self {
            rows,
            ..Self::default()
        }
    }
}

impl BlackBox for MemoryBox {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        self.recording = Recording::new(channels.to_vec());
        self.recording.reserve(self.rows);
        Ok(())
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        self.recording.push(time_ns, row)
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(())
    }
}
