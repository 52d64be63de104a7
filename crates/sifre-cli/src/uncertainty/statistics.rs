//! From flights to what they say of each metric.
//!
//! ```text
//! mean    ȳ = 1/n Σ y_i          standard deviation   √(1/(n−1) Σ (y_i − ȳ)²)
//! range   the 2.5 % and 97.5 % quantiles, linear between the ordered draws
//! ```

use super::{Attempt, Ensemble, Job, Side};
use scenario::{End, Flown};
use study::sensitivity::{self, FirstOrder};

/// What is left out below and above the 95 % range.
const TAIL: f64 = 0.025;

/// What all flights say.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    /// Draws that were flown to their end.
    pub(super) done: usize,
    /// Draws that ended early.
    pub(super) early: usize,
    /// Draws that could not be flown.
    pub(super) refused: usize,
    /// Why, of the first that ended early or was not flown.
    pub(super) first_trouble: Option<String>,
    /// By metric.
    pub(super) metrics: Vec<Summary>,
}

/// What is known of a metric.
#[derive(Clone, Debug)]
pub(super) struct Summary {
    pub(super) name: String,
    /// Of the nominal vehicle.
    pub(super) nominal: f64,
    /// Of the draws, if at least two gave a number.
    pub(super) spread: Option<Spread>,
    /// To first order, if every number could be moved up and down.
    pub(super) first_order: Option<FirstOrder>,
}

/// A metric's distribution over the draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spread {
    /// Draws that gave a number.
    pub(super) count: usize,
    pub(super) mean: f64,
    pub(super) standard_deviation: f64,
    /// The 95 % range.
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Answer {
    pub(super) fn of(
        ensemble: &Ensemble,
        nominal: &Flown,
        flights: impl Iterator<Item = (Job, Option<Attempt>)>,
    ) -> Self {
        let mut answer = Self {
            done: 0,
            early: 0,
            refused: 0,
            first_trouble: None,
            metrics: Vec::new(),
        };
        let mut draws: Vec<Flown> = Vec::new();
        let mut steps: Vec<[Option<Flown>; 2]> = ensemble.numbers.iter().map(|_| [None, None]).collect();
        for (job, attempt) in flights.filter_map(|(job, attempt)| Some((job, attempt?))) {
            let draw = matches!(job, Job::Draw(_));
            let trouble = match attempt {
                Ok(flown) if flown.ending.end == End::Done => {
                    match job {
                        Job::Draw(_) => draws.push(flown),
                        Job::Step {
                            number,
                            side: Side::Up,
                        } => steps[number][0] = Some(flown),
                        Job::Step {
                            number,
                            side: Side::Down,
                        } => steps[number][1] = Some(flown),
                    }
                    continue;
                }
                Ok(flown) => {
                    answer.early += usize::from(draw);
                    flown.ending.to_string()
                }
                Err(words) => {
                    answer.refused += usize::from(draw);
                    words
                }
            };
            answer.first_trouble.get_or_insert(trouble);
        }
        answer.done = draws.len();
        let summary = |metric: &scenario::Metric| Summary {
            name: metric.name.clone(),
            nominal: metric.value,
            spread: Spread::of(
                draws
                    .iter()
                    .filter_map(|draw| value(draw, &metric.name))
                    .collect(),
            ),
            first_order: first_order(&steps, &metric.name),
        };
        answer.metrics = nominal.metrics.iter().map(summary).collect();
        answer
    }
}

/// A metric of a flight, if it is a number.
fn value(flight: &Flown, name: &str) -> Option<f64> {
    let metric = flight.metrics.iter().find(|metric| metric.name == name)?;
    Some(metric.value).filter(|value| value.is_finite())
}

fn first_order(steps: &[[Option<Flown>; 2]], name: &str) -> Option<FirstOrder> {
    let effect = |[up, down]: &[Option<Flown>; 2]| {
        Some(sensitivity::effect(
            value(up.as_ref()?, name)?,
            value(down.as_ref()?, name)?,
        ))
    };
    let effects = steps.iter().map(effect).collect::<Option<_>>()?;
    Some(FirstOrder { effects })
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Option<Self> {
        let count = values.len();
        if count < 2 {
            return None;
        }
        values.sort_by(f64::total_cmp);
        let n = count as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Some(Self {
            count,
            mean,
            standard_deviation: (squares / (n - 1.0)).sqrt(),
            low: quantile(&values, TAIL),
            high: quantile(&values, 1.0 - TAIL),
        })
    }
}

/// A quantile of values in order, at least one.
fn quantile(ordered: &[f64], share: f64) -> f64 {
    let place = share * (ordered.len() - 1) as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    ordered[below] + (place - place.floor()) * (ordered[above] - ordered[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0, 1, … 200: mean 100, variance n (n + 1)/12 for n = 201 values, quantiles at 5 and 195.
    #[test]
    fn exact_spread_of_equal_steps() {
        let spread = Spread::of((0..=200).rev().map(f64::from).collect()).unwrap();
        assert_eq!(spread.count, 201);
        assert_eq!(spread.mean, 100.0);
        let variance = 201.0 * 202.0 / 12.0;
        // Roundings of a sum of 201 terms.
        assert!((spread.standard_deviation.powi(2) / variance - 1.0).abs() < 1e-13);
        assert!((spread.low - 5.0).abs() < 1e-12 && (spread.high - 195.0).abs() < 1e-12);
    }

    #[test]
    fn exact_one_value_has_no_spread() {
        assert_eq!(Spread::of(vec![1.0]), None);
    }
}
