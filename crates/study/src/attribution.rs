//! Attribution: how much of a difference between two models each part between them accounts for.
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
//! another which is missing (voltage sag without rotors that feel the voltage) does nothing.
//!
//! ```
//! use quad_dynamics::{Feature, Level, Phenomenon};
//! use study::attribution::Parts;
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

#[cfg(test)]
mod tests;

use quad_dynamics::{Feature, Level, PhenomenonSet, Resolution};
use std::collections::BTreeSet;

/// Most parts that are attributed to: 2¹² models, and beyond that nobody waits.
pub const MOST_PARTS: usize = 12;

/// The parts between a model and one above it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parts {
    base: BTreeSet<Feature>,
    parts: Vec<Feature>,
}

/// What one part accounts for, in the unit of what was measured.
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
    #[error("level {} is not above level {}: it has no {}; the upper level must contain everything the lower one has", .upper.number(), .lower.number(), .lacks.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
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
        "an attribution is to at most {MOST_PARTS} parts (2^parts runs), got {found}: compare models that are closer together"
    )]
    TooManyParts {
        /// How many there are.
        found: usize,
    },
    /// A run failed.
    #[error("a run of the attribution failed: {0}")]
    Run(#[source] E),
    /// A run gave NaN or an infinite number.
    #[error("the run at {level} with {phenomena} must give a finite number, got {value}")]
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
        (level, phenomena.admitted_by(level.capabilities()))
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

    /// The total difference, top − base.
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
