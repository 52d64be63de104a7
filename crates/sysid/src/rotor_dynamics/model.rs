//! The simulated output of a structure, generic in the scalar.
//!
//! The output is linear in some parameters (gain K, offset, `κ = K c_1` of the zero, free initial state) and not in the
//! denominator's coefficients, which enter by their logarithms. In a parameter vector the linear ones come first:
//! `[K, offset, κ?, free state.., ln a_1?, ln a_last]`.

use super::record::Record;
use super::transition::second_order;
use super::{Start, Structure};
use crate::regression::Predictor;
use quad_math::{Real, constant};

/// A structure that is to describe a record.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model<'a> {
    pub(super) record: &'a Record,
    pub(super) structure: Structure,
    pub(super) start: Start,
}

/// Place of the gain in a parameter vector.
pub(super) const GAIN: usize = 0;
/// Place of the offset.
pub(super) const OFFSET: usize = 1;
/// Place of `κ = K c_1`, where the structure has a zero.
pub(super) const ZERO: usize = 2;

impl Structure {
    /// Linear parameters without the free initial state: gain, offset and zero.
    pub(super) const fn linear_parameters(self) -> usize {
        match self {
            Self::FirstOrder | Self::SecondOrder => 2,
            Self::SecondOrderWithZero => 3,
        }
    }
}

impl Model<'_> {
    /// How many parameters are linear.
    pub(super) fn linear_count(&self) -> usize {
        let free = match self.start {
            Start::Equilibrium => 0,
            Start::Free => self.structure.order(),
        };
        self.structure.linear_parameters() + free
    }

    /// The output at each time of the record for these parameters.
    pub(super) fn output<R: Real>(&self, parameters: &[R]) -> Vec<R> {
        let (linear, logarithms) = parameters.split_at(self.linear_count());
        let free = &linear[self.structure.linear_parameters()..];
        let deviation = |i: usize| free.get(i).copied().unwrap_or_else(R::zero);
        let gain = linear[GAIN];
        let states = match *logarithms {
            [a] => {
                let plant = FirstOrder {
                    a: a.simd_exp(),
                    gain,
                };
                self.follow(&plant, [deviation(0), R::zero()])
            }
            [a1, a2] => {
                let (a1, a2) = (a1.simd_exp(), a2.simd_exp());
                let b1 = match self.structure {
                    Structure::SecondOrderWithZero => linear[ZERO],
                    Structure::FirstOrder | Structure::SecondOrder => R::zero(),
                };
                self.follow(&SecondOrder { a1, a2, b1, gain }, [deviation(0), deviation(1)])
            }
            _ => Vec::new(),
        };
        states.into_iter().map(|y| y + linear[OFFSET]).collect()
    }

    /// The first state over the record, from the equilibrium under the first input and a deviation from it.
    fn follow<R: Real>(&self, plant: &impl Plant<R>, deviation: [R; 2]) -> Vec<R> {
        let Record { times, inputs, .. } = self.record;
        let rest = plant.equilibrium(constant(inputs[0]));
        let mut x = [rest[0] + deviation[0], rest[1] + deviation[1]];
        let mut outputs = Vec::with_capacity(times.len());
        outputs.push(x[0]);
        let mut known: Option<(f64, [[R; 2]; 2])> = None;
        for (interval, &input) in times.windows(2).zip(inputs) {
            let h = interval[1] - interval[0];
            let (_, phi) = *match &mut known {
                Some(pair) if (pair.0 - h).abs() <= SAME_INTERVAL * h => pair,
                other => other.insert((h, plant.transition(h))),
            };
            let goal = plant.equilibrium(constant(input));
            let e = [x[0] - goal[0], x[1] - goal[1]];
            x = [
                goal[0] + phi[0][0] * e[0] + phi[0][1] * e[1],
                goal[1] + phi[1][0] * e[0] + phi[1][1] * e[1],
            ];
            outputs.push(x[0]);
        }
        outputs
    }
}

/// Relative difference up to which two intervals share their transition: rounding of times such as `0.02 k`.
const SAME_INTERVAL: f64 = 1e-9;

impl<const N: usize> Predictor<N> for Model<'_> {
    fn predict<R: Real>(&self, parameters: &[R; N]) -> Vec<R> {
        self.output(parameters)
    }
}

/// A plant of at most two states whose first is the output, in the output's unit.
trait Plant<R> {
    /// The state at rest under an input.
    fn equilibrium(&self, input: R) -> [R; 2];

    /// The transition of a deviation from rest over an interval, s.
    fn transition(&self, interval_s: f64) -> [[R; 2]; 2];
}

/// `ẏ = a (K u − y)`.
struct FirstOrder<R> {
    a: R,
    gain: R,
}

impl<R: Real> Plant<R> for FirstOrder<R> {
    fn equilibrium(&self, input: R) -> [R; 2] {
        [self.gain * input, R::zero()]
    }

    fn transition(&self, h: f64) -> [[R; 2]; 2] {
        let o = R::zero();
        [[(-self.a * constant(h)).simd_exp(), o], [o, o]]
    }
}

/// `ẏ = −a_1 y + b + κ u`, `ḃ = −a_2 y + K a_2 u`: the form of the empirical rotors of levels 4 and 5.
struct SecondOrder<R> {
    a1: R,
    a2: R,
    /// κ.
    b1: R,
    gain: R,
}

impl<R: Real> Plant<R> for SecondOrder<R> {
    fn equilibrium(&self, input: R) -> [R; 2] {
        let y = self.gain * input;
        [y, self.a1 * y - self.b1 * input]
    }

    fn transition(&self, h: f64) -> [[R; 2]; 2] {
        second_order(self.a1, self.a2, h)
    }
}
