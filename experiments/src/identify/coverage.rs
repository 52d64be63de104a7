//! How often the whole identification's intervals contain the truth, counted over many seeds.

use super::Subject;
use crate::item::{Context, ItemError};
use rayon::prelude::*;
use std::fmt;

/// What must be known to read the counts.
const WORDS: &str = "Cubics and line: compared with the noise-free best curve over the same range; intervals by the scatter of repeated readings and \
                     the error of the load cells' lines. Rotor dynamics: compared with the closed form at hover, the mean of the excitation.";

/// Hits of each number's 95 % interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Identifications counted.
    pub runs: u32,
    /// Keys in the order of their identification, and how many intervals contained the truth.
    pub hits: Vec<(&'static str, u32)>,
}

impl Coverage {
    /// Counts over `runs` seeds from `first` on, several at once.
    ///
    /// # Errors
    /// As [`super::run`].
    pub fn count(context: &Context, first: u64, runs: u32) -> Result<Self, ItemError> {
        let subject = Subject::new(context)?;
        let one = |k: u32| -> Result<Vec<(&'static str, u32)>, ItemError> {
            let (_, found) = subject.identified(first + u64::from(k))?;
            let hit = |p: &sysid::pipeline::Parameter| -> Result<(&'static str, u32), ItemError> {
                let truth = subject.truth.get(p.key);
                let truth = truth.ok_or_else(|| ItemError::new(format!("no number {}", p.key)))?;
                Ok((p.key, u32::from(p.estimate.interval().contains(truth.value))))
            };
            found.parameters.iter().map(hit).collect()
        };
        let counted: Vec<_> = (0..runs).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let mut hits: Vec<(&'static str, u32)> = Vec::new();
        for run in counted {
            for (key, hit) in run {
                match hits.iter_mut().find(|(known, _)| *known == key) {
                    Some((_, sum)) => *sum += hit,
                    None => hits.push((key, hit)),
                }
            }
        }
        Ok(Self { runs, hits })
    }

    /// Share of all intervals that contain the truth.
    pub fn share(&self) -> f64 {
        let hits: u32 = self.hits.iter().map(|(_, hits)| hits).sum();
        f64::from(hits) / f64::from(self.runs) / self.hits.len() as f64
    }
}

impl fmt::Display for Coverage {
    /// Markdown.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| number | intervals that contain the truth, of {} |",
            self.runs
        )?;
        writeln!(f, "| --- | --- |")?;
        for (key, hits) in &self.hits {
            writeln!(f, "| `{key}` | {hits} |")?;
        }
        writeln!(
            f,
            "\n{:.1} % of all; 95 % are stated.\n\n{WORDS}",
            100.0 * self.share()
        )
    }
}
