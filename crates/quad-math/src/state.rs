//! States and their rates: what a solver may do with them.
//!
//! Equations see named fields; solvers see a point that moves along a rate. [`State`] and [`Rate`] are
//! that seam, and [`Flat`] is the one place where a state says in which order its numbers stand in a
//! vector (for Jacobians, files and error norms).

use crate::Real;
use nalgebra::SVector;

/// Rate of change of a state: an element of a vector space over `R`.
pub trait Rate<R: Real>: Copy {
    /// The zero of the space.
    fn zero() -> Self;

    /// `self + h · other`.
    fn add_scaled(&self, h: R, other: &Self) -> Self;
}

/// A point that can move along a rate.
pub trait State<R: Real>: Copy + std::fmt::Debug {
    /// Its rate of change.
    type Rate: Rate<R>;

    /// `x + h · ẋ`, component by component; constraints of the state are not enforced.
    fn advanced(&self, h: R, rate: &Self::Rate) -> Self;

    /// The nearest state that meets the constraints of its representation, such as `|q| = 1`.
    ///
    /// Fixed-step integrators call it once after each whole step.
    #[inline(always)]
    fn normalised(self) -> Self {
        self
    }
}

/// The order of a state's (or rate's) numbers in a flat vector.
///
/// The only place that knows this order; `read(write(x)) = x` is a property test of every implementor.
pub trait Flat<R: Real>: Sized {
    /// How many numbers.
    const LEN: usize;

    /// Writes the numbers to the front of `out`.
    ///
    /// # Panics
    /// If `out` is shorter than [`Self::LEN`]: a programming error, not an input error.
    fn write(&self, out: &mut [R]);

    /// Reads the numbers from the front of `values`.
    ///
    /// # Panics
    /// If `values` is shorter than [`Self::LEN`]: a programming error, not an input error.
    fn read(values: &[R]) -> Self;
}

impl<R: Real> Rate<R> for () {
    #[inline(always)]
    fn zero() -> Self {}

    #[inline(always)]
    fn add_scaled(&self, _h: R, (): &Self) -> Self {}
}

impl<R: Real> State<R> for () {
    type Rate = ();

    #[inline(always)]
    fn advanced(&self, _h: R, (): &()) -> Self {}
}

impl<R: Real> Flat<R> for () {
    const LEN: usize = 0;

    #[inline(always)]
    fn write(&self, _out: &mut [R]) {}

    #[inline(always)]
    fn read(_values: &[R]) -> Self {}
}

impl<R: Real, const N: usize> Rate<R> for SVector<R, N> {
    #[inline(always)]
    fn zero() -> Self {
        Self::zeros()
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        self + other * h
    }
}

impl<R: Real, const N: usize> State<R> for SVector<R, N> {
    type Rate = Self;

    #[inline(always)]
    fn advanced(&self, h: R, rate: &Self) -> Self {
        self + rate * h
    }
}

impl<R: Real, const N: usize> Flat<R> for SVector<R, N> {
    const LEN: usize = N;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..N].copy_from_slice(self.as_slice());
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self::from_column_slice(&values[..N])
    }
}

impl<R: Real, T: Rate<R>, const N: usize> Rate<R> for [T; N] {
    #[inline(always)]
    fn zero() -> Self {
        [T::zero(); N]
    }

    #[inline(always)]
    fn add_scaled(&self, h: R, other: &Self) -> Self {
        std::array::from_fn(|i| self[i].add_scaled(h, &other[i]))
    }
}

impl<R: Real, T: State<R>, const N: usize> State<R> for [T; N] {
    type Rate = [T::Rate; N];

    #[inline(always)]
    fn advanced(&self, h: R, rate: &Self::Rate) -> Self {
        std::array::from_fn(|i| self[i].advanced(h, &rate[i]))
    }

    #[inline(always)]
    fn normalised(self) -> Self {
        self.map(State::normalised)
    }
}

impl<R: Real, T: Flat<R>, const N: usize> Flat<R> for [T; N] {
    const LEN: usize = N * T::LEN;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        for (i, item) in self.iter().enumerate() {
            item.write(&mut out[i * T::LEN..]);
        }
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        std::array::from_fn(|i| T::read(&values[i * T::LEN..]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector2, Vector3};
    use proptest::prelude::*;

    /// A point on the unit circle: the smallest state with a constraint.
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct OnCircle(Vector2<f64>);

    impl State<f64> for OnCircle {
        type Rate = Vector2<f64>;

        fn advanced(&self, h: f64, rate: &Self::Rate) -> Self {
            Self(self.0 + rate * h)
        }

        fn normalised(self) -> Self {
            Self(self.0.normalize())
        }
    }

    #[test]
    fn exact_an_array_is_normalised_item_by_item() {
        let off = OnCircle(Vector2::new(3.0, 4.0));
        assert_eq!([off; 3].normalised(), [OnCircle(Vector2::new(0.6, 0.8)); 3]);
    }

    #[test]
    fn exact_a_step_ends_on_the_constraint() {
        let turn = |_, x: &OnCircle| Vector2::new(-x.0.y, x.0.x);
        let x = crate::rk4(&turn, 0.0, &OnCircle(Vector2::x()), 0.5);
        // One division by the norm: an ulp. Without it RK4 is off by h⁶/144 = 1e-4.
        assert!((x.0.norm() - 1.0).abs() < 3e-16);
        let x = crate::euler(&turn, 0.0, &OnCircle(Vector2::x()), 0.5);
        assert!((x.0.norm() - 1.0).abs() < 3e-16);
    }

    proptest! {
        #[test]
        fn prop_flat_round_trip(values in prop::array::uniform6(-1e6..1e6_f64)) {
            let mut flat = [0.0; 6];
            let pair = <[Vector3<f64>; 2]>::read(&values);
            pair.write(&mut flat);
            prop_assert_eq!(flat, values);
            prop_assert_eq!(<[Vector3<f64>; 2] as Flat<f64>>::LEN, 6);
            let one = <SVector<f64, 6> as Flat<f64>>::read(&values);
            one.write(&mut flat);
            prop_assert_eq!(flat, values);
        }

        #[test]
        fn prop_arrays_move_item_by_item(
            x in prop::array::uniform2(-10.0..10.0_f64),
            rate in prop::array::uniform2(-10.0..10.0_f64),
            h in -1.0..1.0_f64,
        ) {
            let items = x.map(SVector::<f64, 1>::new);
            let rates = rate.map(SVector::<f64, 1>::new);
            let moved = items.advanced(h, &rates);
            prop_assert_eq!(Rate::add_scaled(&items, h, &rates), moved);
            for i in 0..2 {
                prop_assert_eq!(moved[i].x, x[i] + rate[i] * h);
            }
            prop_assert_eq!(items.advanced(h, &<[SVector<f64, 1>; 2] as Rate<f64>>::zero()), items);
        }
    }
}
