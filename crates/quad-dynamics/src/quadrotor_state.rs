//! The state of levels 2 to 5 and of the mechanistic vehicle: body, four rotors, supply.

use crate::{RigidBodyRate, RigidBodyState};
use quad_math::{Flat, Rate, Real, State};

/// State of a quadrotor: body, four rotors, supply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadrotorState<R: Real, X, Y> {
    /// The rigid body.
    pub body: RigidBodyState<R>,
    /// The rotors.
    pub rotors: [X; 4],
    /// The supply.
    pub supply: Y,
}

/// Rate of [`QuadrotorState`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadrotorRate<R: Real, X, Y> {
    /// The rigid body's.
    pub body: RigidBodyRate<R>,
    /// The rotors'.
    pub rotors: [X; 4],
    /// The supply's.
    pub supply: Y,
}

impl<R: Real, X: State<R>, Y: State<R>> State<R> for QuadrotorState<R, X, Y> {
    type Rate = QuadrotorRate<R, X::Rate, Y::Rate>;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &Self::Rate) -> Self {
        Self {
            body: self.body.advanced(h, &rate.body),
            rotors: self.rotors.advanced(h, &rate.rotors),
            supply: self.supply.advanced(h, &rate.supply),
        }
    }

    #[inline(always)]
    fn normalised(self) -> Self {
        Self {
            body: self.body.normalised(),
            rotors: self.rotors.normalised(),
            supply: self.supply.normalised(),
        }
    }
}

impl<R: Real, X: Rate<R>, Y: Rate<R>> Rate<R> for QuadrotorRate<R, X, Y> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            body: RigidBodyRate::zero(),
            rotors: [X::zero(); 4],
            supply: Y::zero(),
        }
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            body: self.body.add_scaled(h, &other.body),
            rotors: self.rotors.add_scaled(h, &other.rotors),
            supply: self.supply.add_scaled(h, &other.supply),
        }
    }
}

impl<R: Real, X: Flat<R>, Y: Flat<R>> Flat<R> for QuadrotorState<R, X, Y> {
    const LEN: usize = RigidBodyState::<R>::LEN + 4 * X::LEN + Y::LEN;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.body.write(out);
        self.rotors.write(&mut out[RigidBodyState::<R>::LEN..]);
        self.supply
            .write(&mut out[RigidBodyState::<R>::LEN + 4 * X::LEN..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            body: RigidBodyState::read(values),
            rotors: Flat::read(&values[RigidBodyState::<R>::LEN..]),
            supply: Y::read(&values[RigidBodyState::<R>::LEN + 4 * X::LEN..]),
        }
    }
}

impl<R: Real, X: Flat<R>, Y: Flat<R>> Flat<R> for QuadrotorRate<R, X, Y> {
    const LEN: usize = RigidBodyRate::<R>::LEN + 4 * X::LEN + Y::LEN;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        self.body.write(out);
        self.rotors.write(&mut out[RigidBodyRate::<R>::LEN..]);
        self.supply
            .write(&mut out[RigidBodyRate::<R>::LEN + 4 * X::LEN..]);
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            body: RigidBodyRate::read(values),
            rotors: Flat::read(&values[RigidBodyRate::<R>::LEN..]),
            supply: Y::read(&values[RigidBodyRate::<R>::LEN + 4 * X::LEN..]),
        }
    }
}
