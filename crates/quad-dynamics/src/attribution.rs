//! Attribution: how much of a difference between two models each part between them is answerable for.
//!
//! With n parts and a number v(S) measured on a model that has the parts S (a height error, a cost), three answers for a part i:
//!
//! ```text
//! from below   v({i}) − v(∅)            switched on alone
//! from above   v(N) − v(N ∖ {i})        switched off last
//! Shapley      φ_i = Σ_S ∣S∣! (n − ∣S∣ − 1)! / n!  (v(S ∪ {i}) − v(S)),  S ⊆ N ∖ {i}
//! ```
//!
//! The first two leave out, or count twice, what parts do together. Shapley's value is the only one that adds up to
//! v(N) − v(∅) (efficiency), treats alike what acts alike (symmetry), gives nothing to what does nothing (dummy) and adds up over
//! sums of games. All 2ⁿ numbers are needed; each is measured once. Source: L. S. Shapley, A value for n-person games, Contributions to the
//! Theory of Games II, 1953.
//!
//! The parts between two models of the family are the features that one has beyond the other ([`Parts::between`]). A part that needs
//! another which is not there (voltage sag without rotors that feel the voltage) does nothing.
//!
//! ```
//! use quad_dynamics::{Feature, Level, Parts, Phenomenon};
//!
//! let parts = Parts::between_levels(Level::Three, Level::Four);
//! assert_eq!(parts.parts().len(), 3); // identified rotor dynamics, drag, gyroscopic torque
//! // A run would go here; this one pretends that drag costs 5, and 2 more together with the rotors' dynamics.
//! let result = parts.attribute(|level, phenomena| {
//!     let drag = phenomena.contains(Phenomenon::Drag);
//!     Ok::<_, std::convert::Infallible>(match (drag, level) {
//!         (true, Level::Four) => 7.0,
//!         (true, _) => 5.0,
//!         _ => 0.0,
//!     })
//! })?;
//! let drag = result.share(Feature::Phenomenon(Phenomenon::Drag)).expect("a part");
//! assert_eq!((drag.from_below, drag.from_above), (5.0, 7.0));
//! assert!((drag.shapley - 6.0).abs() < 1e-12);
//! assert!((result.shares.iter().map(|s| s.shapley).sum::<f64>() - 7.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::{Feature, Level, PhenomenonSet, Resolution};
use std::collections::BTreeSet;

/// Most parts that are attributed to: 2¹² models, and beyond that nobody waits.
pub const MOST_PARTS: usize = 12;

/// The parts between a model and one above it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    base: BTreeSet<Feature>,
    parts: Vec<Feature>,
}

/// What one part is answerable for, in the unit of what was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The part.
    pub part: Feature,
    /// Change when it is switched on alone.
    pub from_below: f64,
    /// Change when it is switched on last.
    pub from_above: f64,
    /// Its Shapley value.
    pub shapley: f64,
}

/// A difference and what it is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribution {
    /// What was measured on the model without any of the parts.
    pub base: f64,
    /// What was measured on the model with all of them.
    pub top: f64,
    /// The parts' shares, in the order of [`Parts::parts`].
    pub shares: Vec<Share>,
}

/// Why a difference can't be attributed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AttributionError<E> {
    /// The upper model lacks something that the lower one has.
    #[error("level {} is not above level {}: it has no {}, so the difference between them is not one of parts added", .upper.number(), .lower.number(), .lacks.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    NotAbove {
        /// The lower level.
        lower: Level,
        /// The upper level.
        upper: Level,
        /// What the upper lacks.
        lacks: Vec<Feature>,
    },
    /// More parts than can be measured in all combinations.
    #[error(
        "{found} parts have 2^{found} combinations: attribute to {MOST_PARTS} at most, by models that are closer together"
    )]
    TooManyParts {
        /// How many there are.
        found: usize,
    },
    /// A run failed.
    #[error("a run of the attribution failed: {0}")]
    Run(#[source] E),
    /// A run gave no number.
    #[error("the run at {level} with {phenomena} gave {value}, which is no finite number")]
    NotFinite {
        /// The level.
        level: Level,
        /// The phenomena.
        phenomena: PhenomenonSet,
        /// What it gave.
        value: f64,
    },
}

impl Parts {
    /// The parts that a model has beyond another, which must have none beyond it.
    ///
    /// # Errors
    /// [`AttributionError::NotAbove`], [`AttributionError::TooManyParts`].
    pub fn between<E>(lower: &Resolution, upper: &Resolution) -> Result<Self, AttributionError<E>> {
        let lacks = lower.beyond(upper);
        if !lacks.is_empty() {
            return Err(AttributionError::NotAbove {
                lower: lower.level,
                upper: upper.level,
                lacks,
            });
        }
        let parts = switchable(upper.beyond(lower));
        let found = parts.len();
        if found > MOST_PARTS {
            return Err(AttributionError::TooManyParts { found });
        }
        Ok(Self {
            base: lower.features.clone(),
            parts,
        })
    }

    /// The parts between two levels with their own phenomena, the lower first; none where they are the same.
    pub fn between_levels(a: Level, b: Level) -> Self {
        let [lower, upper] = [a.min(b), a.max(b)].map(|level| Resolution::of(level, &level.phenomena()));
        Self {
            parts: switchable(upper.beyond(&lower)),
            base: lower.features,
        }
    }

    /// The parts.
    pub fn parts(&self) -> &[Feature] {
        &self.parts
    }

    /// The model with the parts of a set, bit i for part i: parts whose prerequisites are missing are left out.
    pub fn model(&self, set: usize) -> (Level, PhenomenonSet) {
        let chosen = self.parts.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
        let mut features: BTreeSet<Feature> =
            self.base.iter().copied().chain(chosen.map(|(_, f)| *f)).collect();
        if features.contains(&Feature::NonLinearRotor) {
            features.insert(Feature::VoltageDependence);
        }
        let level = Resolution::highest_level_within(&features);
        let phenomena = features.iter().filter_map(|feature| match feature {
            Feature::Phenomenon(phenomenon) => Some(*phenomenon),
            _ => None,
        });
        let phenomena: PhenomenonSet = phenomena.collect();
        (level, phenomena.admitted_by(level))
    }

    /// Measures every model between the two and shares out the difference: `measure` gives the number of a run at a level with
    /// phenomena. It is called once for each model that differs.
    ///
    /// # Errors
    /// A run that fails or gives no finite number.
    pub fn attribute<E>(
        &self,
        mut measure: impl FnMut(Level, &PhenomenonSet) -> Result<f64, E>,
    ) -> Result<Attribution, AttributionError<E>> {
        let mut known: Vec<((Level, PhenomenonSet), f64)> = Vec::new();
        let mut values = Vec::with_capacity(1 << self.parts.len());
        for set in 0..1_usize << self.parts.len() {
            let model = self.model(set);
            let value = match known.iter().find(|(seen, _)| *seen == model) {
                Some((_, value)) => *value,
                None => {
                    let value = measure(model.0, &model.1).map_err(AttributionError::Run)?;
                    if !value.is_finite() {
                        let (level, phenomena) = model;
                        return Err(AttributionError::NotFinite {
                            level,
                            phenomena,
                            value,
                        });
                    }
                    known.push((model, value));
                    value
                }
            };
            values.push(value);
        }
        Ok(self.shares(&values))
    }

    /// The attribution from the numbers of all sets, bit i for part i.
    fn shares(&self, values: &[f64]) -> Attribution {
        let all = values.len() - 1;
        let shapley = shapley_values(self.parts.len(), |set| values[set]);
        let share = |(i, (part, shapley)): (usize, (&Feature, f64))| Share {
            part: *part,
            from_below: values[1 << i] - values[0],
            from_above: values[all] - values[all ^ (1 << i)],
            shapley,
        };
        Attribution {
            base: values[0],
            top: values[all],
            shares: self.parts.iter().zip(shapley).enumerate().map(share).collect(),
        }
    }
}

/// What can be switched by itself: the rotors' dependence on the voltage comes with their polynomials.
fn switchable(mut features: Vec<Feature>) -> Vec<Feature> {
    features.retain(|feature| *feature != Feature::VoltageDependence);
    features
}

impl Attribution {
    /// The share of a part.
    pub fn share(&self, part: Feature) -> Option<&Share> {
        self.shares.iter().find(|share| share.part == part)
    }

    /// The whole difference, top − base.
    pub fn difference(&self) -> f64 {
        self.top - self.base
    }
}

/// Shapley values of a game of `n` players from the value of every coalition, bit i for player i.
pub fn shapley_values(n: usize, value: impl Fn(usize) -> f64) -> Vec<f64> {
    // ∣S∣! (n − ∣S∣ − 1)! / n! = 1 / (n C(n−1, ∣S∣)).
    let binomial = |k: usize| (0..k).fold(1.0, |c, j| c * (n - 1 - j) as f64 / (j + 1) as f64);
    let weights: Vec<f64> = (0..n).map(|k| 1.0 / (n as f64 * binomial(k))).collect();
    (0..n)
        .map(|i| {
            let without = (0..1_usize << n).filter(|set| set >> i & 1 == 0);
            without
                .map(|set| weights[set.count_ones() as usize] * (value(set | 1 << i) - value(set)))
                .sum()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Phenomenon;
    use approx::assert_relative_eq;
    use proptest::prelude::*;
    use std::convert::Infallible;

    /// Random games of five players.
    const PLAYERS: usize = 5;

    fn game() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(-10.0..10.0_f64, 1 << PLAYERS)
    }

    /// By the definition over orders of arrival: the mean of what each adds when it comes, over all 120 orders.
    fn by_permutations(game: &[f64]) -> Vec<f64> {
        fn arrive(order: &mut Vec<usize>, game: &[f64], sums: &mut [f64], count: &mut f64) {
            if order.len() == PLAYERS {
                let mut set = 0;
                for &i in order.iter() {
                    sums[i] += game[set | 1 << i] - game[set];
                    set |= 1 << i;
                }
                *count += 1.0;
            }
            for i in 0..PLAYERS {
                if !order.contains(&i) {
                    order.push(i);
                    arrive(order, game, sums, count);
                    order.pop();
                }
            }
        }
        let (mut sums, mut count) = (vec![0.0; PLAYERS], 0.0);
        arrive(&mut Vec::new(), game, &mut sums, &mut count);
        sums.iter().map(|s| s / count).collect()
    }

    // Sums of 32 numbers of size ten.
    const ROUNDING: f64 = 1e-12;

    proptest! {
        #[test]
        fn agree_with_the_mean_over_orders(game in game()) {
            let values = shapley_values(PLAYERS, |s| game[s]);
            for (a, b) in values.iter().zip(by_permutations(&game)) {
                prop_assert!((a - b).abs() < ROUNDING);
            }
        }

        #[test]
        fn prop_efficiency(game in game()) {
            let sum: f64 = shapley_values(PLAYERS, |s| game[s]).iter().sum();
            prop_assert!((sum - (game[31] - game[0])).abs() < ROUNDING);
        }

        /// Players 1 and 3, whose exchange changes no coalition's value, get the same.
        #[test]
        fn prop_symmetry(game in game()) {
            let exchanged = |s: usize| s & !0b1010 | (s & 0b0010) << 2 | (s & 0b1000) >> 2;
            let values = shapley_values(PLAYERS, |s| game[s] + game[exchanged(s)]);
            prop_assert!((values[1] - values[3]).abs() < ROUNDING);
        }

        /// Player 2, who adds the same 3 to every coalition, gets 3; who adds nothing gets nothing.
        #[test]
        fn prop_dummy(game in game(), adds in prop::sample::select(vec![0.0, 3.0])) {
            let values = shapley_values(PLAYERS, |s| game[s & !0b100] + if s & 0b100 != 0 { adds } else { 0.0 });
            prop_assert!((values[2] - adds).abs() < ROUNDING);
        }

        #[test]
        fn prop_additivity(a in game(), b in game()) {
            let sum = shapley_values(PLAYERS, |s| a[s] + b[s]);
            let (a, b) = (shapley_values(PLAYERS, |s| a[s]), shapley_values(PLAYERS, |s| b[s]));
            for i in 0..PLAYERS {
                prop_assert!((sum[i] - a[i] - b[i]).abs() < ROUNDING);
            }
        }
    }

    /// The glove game: players 0 and 1 have a left glove, 2 the right one; a pair is worth 1. Values 1/6, 1/6, 2/3.
    #[test]
    fn exact_glove_game() {
        let values = shapley_values(3, |s| f64::from(s & 0b100 != 0 && s & 0b011 != 0));
        for (value, expected) in values.iter().zip([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]) {
            assert_relative_eq!(*value, expected, epsilon = 1e-15);
        }
    }

    /// From level 4 to 5: non-linear rotor (and with it the dependence on voltage), limits, sag. Sag without the rotors is not built.
    #[test]
    fn exact_models_between_levels_4_and_5() {
        let parts = Parts::between_levels(Level::Four, Level::Five);
        let place = |f: Feature| 1 << parts.parts().iter().position(|p| *p == f).unwrap();
        let sag = place(Feature::Phenomenon(Phenomenon::VoltageSag));
        let limits = place(Feature::Phenomenon(Phenomenon::InputLimits));
        let rotor = place(Feature::NonLinearRotor);
        assert_eq!(parts.parts().len(), 3);
        assert_eq!(parts.model(0), (Level::Four, Level::Four.phenomena()));
        assert_eq!(parts.model(sag), parts.model(0));
        assert_eq!(
            parts.model(limits | sag),
            (Level::Four, Level::Four.phenomena().with(Phenomenon::InputLimits))
        );
        assert_eq!(
            parts.model(sag | limits | rotor),
            (Level::Five, Level::Five.phenomena())
        );
        let vehicle = crate::Vehicle::qball_x4();
        let mut runs = 0;
        for set in 0..1 << parts.parts().len() {
            let (level, on) = parts.model(set);
            let origin = nalgebra::Vector3::zeros();
            assert!(crate::AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, origin, 0.0).is_ok());
        }
        let count = parts.attribute(|_, _| {
            runs += 1;
            Ok::<_, Infallible>(0.0)
        });
        // Two of the eight are the same as without sag.
        assert!(count.is_ok());
        assert_eq!(runs, 6);
    }

    #[test]
    fn exact_wrong_questions_are_errors() {
        let of = |level: Level, on: &PhenomenonSet| Resolution::of(level, on);
        let drag = PhenomenonSet::none().with(Phenomenon::Drag);
        let error =
            Parts::between::<Infallible>(&of(Level::Two, &drag), &of(Level::Three, &PhenomenonSet::none()));
        let text = error.unwrap_err().to_string();
        assert!(text.contains("has no drag"), "{text}");
        let parts = Parts::between_levels(Level::Three, Level::Four);
        let error = parts.attribute(|_, _| Ok::<_, Infallible>(f64::NAN)).unwrap_err();
        assert!(matches!(
            error,
            AttributionError::NotFinite {
                level: Level::Three,
                ..
            }
        ));
        let error = parts.attribute(|_, _| Err::<f64, _>("no")).unwrap_err();
        assert_eq!(error, AttributionError::Run("no"));
    }
}
