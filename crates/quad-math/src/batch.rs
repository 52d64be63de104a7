//! Many vehicles at once: the scalar code of a model, vectorised over vehicles.
//!
//! A [`Batch`] holds its states as a structure of arrays, in blocks of [`LANES`] vehicles: row `k` of a
//! block is number `k` ([`Flat`]'s order) of each. Its loop reads one vehicle, steps it by the model's own text
//! on plain `f64` (or `f32`), and writes it back. Where the compiler can, it turns that loop, whole, into vector
//! code for two, four, eight or sixteen vehicles, whatever the processor that runs it has
//! ([`crate::dispatch`]).
//!
//! So a batch gives *bit for bit* what the same vehicles give one by one, on every processor: no arithmetic
//! type stands between. The other way, a scalar that *is* several lanes ([`crate::F64x4`]), has its width fixed
//! when the program is built.
//!
//! What vectorises: arithmetic, [`crate::sqrt`], comparisons, selections, minima, maxima and clamps, in code
//! that is all `#[inline(always)]`, [`Flat::read`] and [`Flat::write`] included. What keeps the whole loop
//! scalar: a sine or any other call to a library function (the scalar `simd_sqrt` is one), even on a path that is
//! switched off; and switches in the parameters, such as an `Option` that the step looks into. It is then slow,
//! never wrong; only a measurement tells.

use crate::{Flat, Real, System, dispatch, rk4_step};
use std::marker::PhantomData;

/// Vehicles in a block: the widest vector of the smallest scalar (AVX-512, `f32`).
///
/// Fewer would do for the arithmetic, but a loop of four or eight turns is unrolled before the compiler
/// looks for vectors, and then finds none.
pub const LANES: usize = 16;

/// The most numbers that a state in a batch may have; more is an error when the program is built.
pub const MAX_NUMBERS: usize = 64;

/// Vehicles side by side: states `X` of numbers `T`, a structure of arrays.
///
/// ```
/// use quad_math::{Batch, Real, System, constant, rk4_step};
/// use nalgebra::Vector2;
///
/// /// `ẍ = u − x`.
/// struct Spring;
///
/// impl<R: Real> System<R> for Spring {
///     type State = Vector2<R>;
///     type Input = R;
///
///     #[inline(always)]
///     fn derivative(&self, x: &Vector2<R>, &u: &R) -> Vector2<R> {
///         Vector2::new(x.y, u - x.x)
///     }
/// }
///
/// let start: Vec<_> = (0..100).map(|i| Vector2::new(f64::from(i), 0.0)).collect();
/// let inputs = vec![0.5; 100];
/// let mut batch = Batch::new(&start);
/// batch.rk4_step(&Spring, &inputs, 0.01);
/// assert_eq!(batch.state(7), Some(rk4_step(&Spring, &start[7], &0.5, 0.01)));
/// ```
#[derive(Clone, Debug)]
pub struct Batch<X, T> {
    /// `X::LEN` rows per block.
    rows: Vec<[T; LANES]>,
    count: usize,
    state: PhantomData<X>,
}

impl<T: Real, X: Flat<T> + Copy> Batch<X, T> {
    /// A batch of these states, in this order.
    pub fn new(states: &[X]) -> Self {
        const { assert!(X::LEN > 0 && X::LEN <= MAX_NUMBERS) }
        let mut rows = vec![[T::zero(); LANES]; states.len().div_ceil(LANES) * X::LEN];
        let mut flat = [T::zero(); MAX_NUMBERS];
        for (b, block) in states.chunks(LANES).enumerate() {
            for lane in 0..LANES {
                // Lanes beyond the last vehicle repeat it, so that they hold nothing strange.
                block[lane.min(block.len() - 1)].write(&mut flat[..X::LEN]);
                for (row, number) in rows[b * X::LEN..][..X::LEN].iter_mut().zip(&flat) {
                    row[lane] = *number;
                }
            }
        }
        Self {
            rows,
            count: states.len(),
            state: PhantomData,
        }
    }

    /// How many vehicles.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The state of one vehicle; `None` beyond the last.
    pub fn state(&self, vehicle: usize) -> Option<X> {
        (vehicle < self.count).then(|| {
            let block = &self.rows[vehicle / LANES * X::LEN..][..X::LEN];
            read_lane(block, vehicle % LANES)
        })
    }

    /// The states of all vehicles, in order.
    pub fn states(&self) -> impl Iterator<Item = X> {
        (0..self.count).filter_map(|vehicle| self.state(vehicle))
    }

    /// One step of the classical Runge-Kutta method for every vehicle, each input held: [`rk4_step`].
    ///
    /// No heap allocation.
    ///
    /// # Panics
    /// If there is not one input per vehicle: a programming error, not an input error.
    pub fn rk4_step<S: System<T, State = X>>(&mut self, system: &S, inputs: &[S::Input], h: T) {
        self.update(
            inputs,
            #[inline(always)]
            |x, u| rk4_step(system, x, u, h),
        );
    }

    /// Replaces every state `x` by `f(x, item)` with the vehicle's own item: an input, or its parameters too.
    ///
    /// `f` is one step, marked `#[inline(always)]`: a loop over steps inside it would not vectorise.
    ///
    /// # Panics
    /// If there is not one item per vehicle: a programming error, not an input error.
    #[inline(always)]
    pub fn update<U: Copy>(&mut self, items: &[U], f: impl Fn(&X, &U) -> X) {
        assert_eq!(items.len(), self.count, "one item per vehicle");
        let rows = &mut self.rows;
        dispatch(
            #[inline(always)]
            || {
                // Results gather in a local array, of which the compiler knows that nothing else points to it:
                // it could not vectorise stores that might change the system's parameters.
                let mut next = [[T::zero(); LANES]; MAX_NUMBERS];
                // Whole and padded blocks go through one loop: the step is inlined here once.
                for (block, items) in rows.chunks_exact_mut(X::LEN).zip(items.chunks(LANES)) {
                    let mut padded = [items[0]; LANES];
                    padded[..items.len()].copy_from_slice(items);
                    let (block, next) = (&mut block[..X::LEN], &mut next[..X::LEN]);
                    // The loop that the compiler vectorises.
                    for (lane, item) in padded.iter().enumerate() {
                        let mut flat = [T::zero(); MAX_NUMBERS];
                        f(&read_lane(block, lane), item).write(&mut flat[..X::LEN]);
                        for (row, number) in next.iter_mut().zip(&flat) {
                            row[lane] = *number;
                        }
                    }
                    block.copy_from_slice(next);
                }
            },
        );
    }
}

/// The state in one lane of a block.
#[inline(always)]
fn read_lane<T: Real, X: Flat<T>>(block: &[[T; LANES]], lane: usize) -> X {
    let mut flat = [T::zero(); MAX_NUMBERS];
    for (number, row) in flat.iter_mut().zip(block) {
        *number = row[lane];
    }
    X::read(&flat[..X::LEN])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{constant, sqrt};
    use nalgebra::Vector3;
    use proptest::prelude::*;

    /// Products, a quotient, a root, a selection and a clamp: everything that is to vectorise.
    struct Tangle;

    impl<R: Real> System<R> for Tangle {
        type State = Vector3<R>;
        type Input = R;

        #[inline(always)]
        fn derivative(&self, x: &Vector3<R>, &u: &R) -> Vector3<R> {
            let speed = sqrt(x.norm_squared() + R::one());
            let push = u.simd_clamp(constant(-0.5), constant(0.5));
            let side = x.x.select(x.y.simd_gt(x.z), x.z);
            Vector3::new(push - side / speed, x.x * x.z, x.x.simd_max(x.y) - x.z * speed)
        }
    }

    /// 20 steps of a batch of `n` against the same vehicles one by one.
    fn assert_same_bits<T: Real + Into<f64>>(values: &[f64]) {
        let n = values.len();
        let mut one_by_one: Vec<Vector3<T>> = (0..n)
            .map(|i| Vector3::from_fn(|k, _| constant(values[(i + 5 * k) % n])))
            .collect();
        let inputs: Vec<T> = values.iter().map(|&v| constant(0.3 * v)).collect();
        let mut batch = Batch::new(&one_by_one);
        for _ in 0..20 {
            batch.rk4_step(&Tangle, &inputs, constant(0.01));
            for (x, u) in one_by_one.iter_mut().zip(&inputs) {
                *x = rk4_step(&Tangle, x, u, constant(0.01));
            }
        }
        let bits = |x: &Vector3<T>| -> [u64; 3] { (*x).map(|v| v.into().to_bits()).into() };
        let together: Vec<_> = batch.states().collect();
        assert_eq!(
            together.iter().map(bits).collect::<Vec<_>>(),
            one_by_one.iter().map(bits).collect::<Vec<_>>()
        );
    }

    proptest! {
        #[test]
        fn agree_a_batch_is_its_vehicles_one_by_one(
            values in prop::collection::vec(-3.0..3.0_f64, 1..50),
        ) {
            assert_same_bits::<f64>(&values);
            assert_same_bits::<f32>(&values);
        }

        #[test]
        fn prop_states_go_in_and_out(values in prop::collection::vec(prop::num::f64::NORMAL, 0..50)) {
            let states: Vec<[Vector3<f64>; 2]> =
                values.iter().map(|&v| [Vector3::repeat(v), Vector3::new(v, 1.0, -v)]).collect();
            let batch = Batch::new(&states);
            prop_assert_eq!(batch.len(), states.len());
            prop_assert_eq!(batch.is_empty(), states.is_empty());
            prop_assert_eq!(batch.state(states.len()), None);
            prop_assert_eq!(batch.states().collect::<Vec<_>>(), states);
        }
    }

    #[test]
    fn exact_update_gives_every_vehicle_its_own_item() {
        let mut batch = Batch::new(&[Vector3::<f64>::zeros(); 19]);
        let items: Vec<f64> = (0..19).map(f64::from).collect();
        batch.update(&items, |x, &item| x.add_scalar(item));
        for (state, item) in batch.states().zip(items) {
            assert_eq!(state, Vector3::repeat(item));
        }
    }

    #[test]
    #[should_panic(expected = "one item per vehicle")]
    fn exact_a_missing_input_is_a_programming_error() {
        Batch::new(&[Vector3::<f64>::zeros(); 3]).rk4_step(&Tangle, &[0.0; 2], 0.01);
    }
}
