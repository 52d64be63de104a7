//! The models of the family as types over any scalar, and their states as flat vectors.

use proptest::prelude::*;
use quad_dynamics::{
    Input, Level1, Level2, Level3, Level4, Level5, MechanisticQuadrotor, Phenomenon, PhenomenonSet,
    QuadrotorModel, StateOf,
};
use quad_math::{Flat, Real, constant};

/// A model of the family whose scalar is still open.
pub trait Family {
    /// The model over a scalar.
    type Over<R: Real>: QuadrotorModel<R>;

    /// The phenomena that it may have.
    const PHENOMENA: &'static [Phenomenon];
}

macro_rules! family {
    ($($name:ident: $model:ident, $text:literal, [$($phenomenon:ident),*];)*) => {$(
        #[doc = $text]
        #[derive(Debug)]
        pub enum $name {}

        impl Family for $name {
            type Over<R: Real> = $model<R>;
            const PHENOMENA: &'static [Phenomenon] = &[$(Phenomenon::$phenomenon),*];
        }
    )*};
}

family! {
    FamilyOne: Level1, "Level 1.", [InputLimits];
    FamilyTwo: Level2, "Level 2.", [Drag, GyroscopicTorque, InputLimits, GroundEffect, Blockage];
    FamilyThree: Level3, "Level 3.", [Drag, GyroscopicTorque, SpinUpReaction, InputLimits, GroundEffect, Blockage];
    FamilyFour: Level4, "Level 4.", [Drag, GyroscopicTorque, InputLimits, GroundEffect, Blockage];
    FamilyFive: Level5, "Level 5.", [Drag, GyroscopicTorque, InputLimits, VoltageSag, GroundEffect, Blockage];
    FamilyMechanistic: MechanisticQuadrotor, "The mechanistic vehicle.",
        [Drag, GyroscopicTorque, InputLimits, VoltageSag, GroundEffect, Blockage];
}

/// Any of the phenomena that a model may have, switched on and off at random.
pub fn phenomena<F: Family>() -> impl Strategy<Value = PhenomenonSet> {
    prop::sample::subsequence(F::PHENOMENA, 0..=F::PHENOMENA.len())
        .prop_map(|chosen| chosen.into_iter().collect())
}

/// A state as numbers.
pub fn flat<R: Real, X: Flat<R>>(x: &X) -> Vec<R> {
    let mut out = vec![R::zero(); X::LEN];
    x.write(&mut out);
    out
}

/// A state from numbers of another scalar, with zero derivatives and the same in every lane.
pub fn from_flat<R: Real, X: Flat<R>>(values: &[f64]) -> X {
    let values: Vec<R> = values.iter().map(|&v| constant(v)).collect();
    X::read(&values)
}

/// State, commands, wind and rotation of the air in one vector.
pub fn join<R: Real, X: Flat<R>>(state: &X, input: &Input<R>) -> Vec<R> {
    let mut all = flat(state);
    all.extend(input.commands);
    all.extend(input.wind.iter().chain(&input.air_rates));
    all
}

/// The reverse of [`join`].
pub fn split<R: Real, X: Flat<R>>(all: &[R]) -> (X, Input<R>) {
    let input = &all[X::LEN..];
    let input = Input {
        commands: std::array::from_fn(|i| input[i]),
        wind: Flat::read(&input[4..]),
        air_rates: Flat::read(&input[7..]),
    };
    (X::read(all), input)
}

/// The rate of a model's state at a joined vector of state and input, as numbers.
pub fn rate<R: Real, M: QuadrotorModel<R>>(model: &M, all: &[R]) -> Vec<R> {
    let (state, input) = split::<R, StateOf<R, M>>(all);
    flat(&model.derivative(&state, &input))
}
