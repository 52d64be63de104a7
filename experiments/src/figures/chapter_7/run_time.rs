//! Run time of one call of the cost at each level: processor time of the calling thread, and of many calls the least, for all else that a
//! machine does only adds to it.

use super::optimisations::{Case, Effort};
use crate::item::ItemError;
use cpu_time::ThreadTime;
use std::hint::black_box;

/// Rounds without a new least time after which it counts as found.
const PATIENCE: u32 = 6;
/// Most rounds.
const MOST_ROUNDS: u32 = 60;
/// What counts as a new least time: less by this share.
const NEWS: f64 = 0.01;
/// Share by which a level may seem faster than the one below and still count as not faster: the spread of such minima on a busy
/// machine.
pub(super) const MARGIN: f64 = 0.1;

/// Least time of a call at each level, s, at the minima found. Levels take turns, so that a busy moment meets them all.
pub(super) fn least_times(case: Case, effort: Effort) -> Result<Vec<f64>, ItemError> {
    let solved = case.solved(effort)?;
    let mut least = vec![f64::INFINITY; solved.len()];
    let mut still = 0;
    for _ in 0..MOST_ROUNDS {
        let mut news = false;
        for (least, level) in least.iter_mut().zip(solved) {
            let began = ThreadTime::try_now()?;
            black_box(level.problem.evaluate(level.first().best())?);
            let time = began.try_elapsed()?.as_secs_f64();
            news |= time < (1.0 - NEWS) * *least;
            *least = least.min(time);
        }
        still = if news { 0 } else { still + 1 };
        if still == PATIENCE {
            break;
        }
    }
    Ok(least)
}

/// Whether no level is faster than the one below it, but for the margin.
pub(super) fn never_falls(times: &[f64]) -> bool {
    times.windows(2).all(|pair| pair[1] >= (1.0 - MARGIN) * pair[0])
}
