//! How much model is enough: the cheapest level that agrees with level 5 on what is asked.
//!
//! What is asked is any number, or several: a step metric, the error on a trajectory, a cost Φ, each in one or more cases
//! (set points, starts, winds). A level **agrees** if in every case i `|qᵢ − qᵢ⁽⁵⁾| ≤ a + r |qᵢ⁽⁵⁾|`, with an absolute
//! tolerance a in the unit of q and a relative one r. A value that is not finite (a flight that diverged) disagrees.
//!
//! Two answers are given, because agreement can be luck: errors of a coarse model may cancel in one case.
//!
//! - the **cheapest** level that agrees;
//! - the **dependable** one: the cheapest that agrees while every level above it does so too.
//!
//! They are the same where resolution helps steadily. Level 5 agrees with itself, so there always is an answer.

use quad_dynamics::Level;
use serde::Serialize;

/// What one level answered, and at what price.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// The level.
    pub level: Level,
    /// The numbers asked for, one per case, in the same order at every level.
    pub values: Vec<f64>,
    /// What it cost, in any unit that is the same for all levels: seconds, derivative evaluations.
    pub price: f64,
}

/// How near is near enough.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tolerance {
    /// In the unit of what is asked.
    pub absolute: f64,
    /// Of level 5's value.
    pub relative: f64,
}

/// One level's agreement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// The level's answer.
    pub answer: Answer,
    /// Greatest difference to level 5 over the cases, in the unit of what is asked; infinite where a value is not finite.
    pub difference: f64,
    /// Greatest difference over its tolerance: agreement is 1 or less.
    pub strain: f64,
}

impl Agreement {
    /// Whether every case is near enough.
    pub fn agrees(&self) -> bool {
        self.strain <= 1.0
    }
}

/// The evidence and what follows from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Selection {
    /// All levels asked, lowest first.
    pub levels: Vec<Agreement>,
    /// The cheapest level that agrees.
    pub cheapest: Level,
    /// The cheapest level that agrees while every asked level above it agrees too.
    pub dependable: Level,
}

/// Why no level can be selected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SelectionError {
    /// Nothing to agree with.
    #[error(
        "{} is missing from the answers: the others are compared with it",
        Level::HIGHEST
    )]
    NoReference,
    /// Nothing asked.
    #[error("{} answered with no numbers: at least one is needed", Level::HIGHEST)]
    NothingAsked,
    /// Level 5 gave NaN or an infinite number.
    #[error(
        "{} must answer with finite numbers, got {value} in case {case}",
        Level::HIGHEST
    )]
    BadReference {
        /// The case, from 0.
        case: usize,
        /// Its value.
        value: f64,
    },
    /// A level twice.
    #[error("{level} answered twice")]
    Twice {
        /// Which.
        level: Level,
    },
    /// A level that was asked something else.
    #[error(
        "{level} must answer with {expected} numbers as {} does, got {values}",
        Level::HIGHEST
    )]
    OtherCases {
        /// Which.
        level: Level,
        /// How many it gave.
        values: usize,
        /// How many level 5 gave.
        expected: usize,
    },
    /// A tolerance that is negative, NaN or infinite, or both zero.
    #[error(
        "tolerances must be finite, not negative and not both zero, got absolute {absolute}, relative {relative}"
    )]
    BadTolerance {
        /// The absolute one.
        absolute: f64,
        /// The relative one.
        relative: f64,
    },
    /// A price that is negative, NaN or infinite.
    #[error("the price of {level} must be finite and not negative, got {price}")]
    BadPrice {
        /// Which.
        level: Level,
        /// Its price.
        price: f64,
    },
}

/// Selects the level that is enough.
///
/// # Errors
/// No level 5, answers to different questions, prices or tolerances that are negative or not finite.
///
/// ```
/// use quad_dynamics::Level;
/// use study::selection::{Answer, Tolerance, select};
///
/// let answer = |level, value, price| Answer { level, values: vec![value], price };
/// // The steady height error, m, after a step: only the non-linear rotor has one.
/// let answers = [answer(Level::Three, 0.0, 1.0), answer(Level::Four, 0.001, 1.6), answer(Level::Five, 0.073, 1.8)];
/// let within = |absolute| select(&answers, Tolerance { absolute, relative: 0.0 });
/// assert_eq!(within(0.1)?.dependable, Level::Three);
/// assert_eq!(within(0.01)?.dependable, Level::Five);
/// # Ok::<(), study::selection::SelectionError>(())
/// ```
pub fn select(answers: &[Answer], tolerance: Tolerance) -> Result<Selection, SelectionError> {
    let Tolerance { absolute, relative } = tolerance;
    let sound = |x: f64| x.is_finite() && x >= 0.0;
    if !(sound(absolute) && sound(relative) && absolute + relative > 0.0) {
        return Err(SelectionError::BadTolerance { absolute, relative });
    }
    let reference = answers
        .iter()
        .find(|a| a.level == Level::HIGHEST)
        .ok_or(SelectionError::NoReference)?;
    check(answers, reference)?;
    let mut levels: Vec<_> = answers
        .iter()
        .map(|a| agreement(a, reference, tolerance))
        .collect();
    levels.sort_by_key(|a| a.answer.level);
    let from = levels
        .iter()
        .rposition(|a| !a.agrees())
        .map_or(0, |last| last + 1);
    let cheapest = |of: &[Agreement]| {
        let agreeing = of.iter().filter(|a| a.agrees());
        agreeing
            .min_by(|a, b| a.answer.price.total_cmp(&b.answer.price))
            .map_or(Level::HIGHEST, |a| a.answer.level)
    };
    Ok(Selection {
        cheapest: cheapest(&levels),
        dependable: cheapest(&levels[from..]),
        levels,
    })
}

fn check(answers: &[Answer], reference: &Answer) -> Result<(), SelectionError> {
    let expected = reference.values.len();
    if expected == 0 {
        return Err(SelectionError::NothingAsked);
    }
    if let Some((case, value)) = reference.values.iter().enumerate().find(|(_, v)| !v.is_finite()) {
        return Err(SelectionError::BadReference { case, value: *value });
    }
    for (k, Answer { level, values, price }) in answers.iter().enumerate() {
        let (level, price) = (*level, *price);
        if answers[..k].iter().any(|a| a.level == level) {
            return Err(SelectionError::Twice { level });
        }
        if values.len() != expected {
            return Err(SelectionError::OtherCases {
                level,
                values: values.len(),
                expected,
            });
        }
        if !(price.is_finite() && price >= 0.0) {
            return Err(SelectionError::BadPrice { level, price });
        }
    }
    Ok(())
}

fn agreement(answer: &Answer, reference: &Answer, tolerance: Tolerance) -> Agreement {
    let (mut difference, mut strain) = (0.0_f64, 0.0_f64);
    for (value, truth) in answer.values.iter().zip(&reference.values) {
        let apart = (value - truth).abs();
        let allowed = tolerance.absolute + tolerance.relative * truth.abs();
        // Nothing allowed and nothing apart is agreement.
        let share = if apart == 0.0 { 0.0 } else { apart / allowed };
        difference = difference.max(if apart.is_finite() { apart } else { f64::INFINITY });
        strain = strain.max(if share.is_finite() { share } else { f64::INFINITY });
    }
    Agreement {
        answer: answer.clone(),
        difference,
        strain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answers(values: [f64; 5], prices: [f64; 5]) -> Vec<Answer> {
        let of = |((level, value), price): ((Level, f64), f64)| Answer {
            level,
            values: vec![value],
            price,
        };
        Level::ALL.into_iter().zip(values).zip(prices).map(of).collect()
    }

    const WITHIN_A_TENTH: Tolerance = Tolerance {
        absolute: 0.1,
        relative: 0.0,
    };

    #[test]
    fn exact_luck_is_told_from_resolution() {
        // Level 1 agrees by luck, level 2 doesn't, 3 to 5 do; level 4 is cheaper than 3.
        let answers = answers([1.05, 2.0, 1.08, 1.02, 1.0], [1.0, 2.0, 4.0, 3.0, 5.0]);
        let selection = select(&answers, WITHIN_A_TENTH).unwrap();
        assert_eq!(selection.cheapest, Level::One);
        assert_eq!(selection.dependable, Level::Four);
        assert_eq!(selection.levels[1].difference, 1.0);
    }

    #[test]
    fn exact_level_5_is_the_last_resort_and_not_a_number_disagrees() {
        let answers = answers([f64::NAN, f64::INFINITY, 3.0, 2.0, 0.0], [1.0; 5]);
        let selection = select(
            &answers,
            Tolerance {
                absolute: 0.0,
                relative: 0.5,
            },
        )
        .unwrap();
        assert_eq!(
            (selection.cheapest, selection.dependable),
            (Level::Five, Level::Five)
        );
        assert!(selection.levels[0].strain.is_infinite() && selection.levels[0].difference.is_infinite());
        assert!(
            selection.levels[4].agrees(),
            "with nothing allowed, nothing apart agrees"
        );
    }

    #[test]
    fn exact_every_case_counts() {
        let answer = |level, values: [f64; 2], price| Answer {
            level,
            values: values.to_vec(),
            price,
        };
        let answers = [
            answer(Level::Five, [1.0, 10.0], 2.0),
            answer(Level::Two, [1.0, 11.5], 1.0),
        ];
        let within = |relative| {
            select(
                &answers,
                Tolerance {
                    absolute: 0.0,
                    relative,
                },
            )
            .unwrap()
            .dependable
        };
        assert_eq!(within(0.2), Level::Two);
        assert_eq!(within(0.1), Level::Five);
    }

    #[test]
    fn exact_bad_input() {
        let good = answers([1.0; 5], [1.0; 5]);
        let told = |answers: &[Answer], tolerance| select(answers, tolerance).unwrap_err().to_string();
        assert!(told(&good[..4], WITHIN_A_TENTH).contains("level 5 is missing"));
        assert!(told(&good, Tolerance::default()).contains("not both zero"));
        assert!(
            told(
                &good,
                Tolerance {
                    absolute: f64::NAN,
                    relative: 0.0
                }
            )
            .contains("finite")
        );
        assert!(told(&answers([1.0, 1.0, 1.0, 1.0, f64::NAN], [1.0; 5]), WITHIN_A_TENTH).contains("case 0"));
        assert!(told(&answers([1.0; 5], [1.0, -1.0, 1.0, 1.0, 1.0]), WITHIN_A_TENTH).contains("got -1"));
        let twice = [good.clone(), good.clone()].concat();
        assert!(told(&twice, WITHIN_A_TENTH).contains("twice"));
        let mut other = good.clone();
        other[0].values.push(1.0);
        assert!(told(&other, WITHIN_A_TENTH).contains("got 2"));
        other[4].values.clear();
        assert!(told(&other, WITHIN_A_TENTH).contains("no numbers"));
    }
}
