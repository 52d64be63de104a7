//! Machine code for the processor at hand, from a build for any processor.
//!
//! A build for plain x86-64 may use vectors of two doubles only, although nearly every such machine has
//! room for four (AVX2) or eight (AVX-512). [`dispatch`] compiles a job once for each of these
//! instruction sets and picks, at run time, the best one present. The results do not depend on the choice,
//! not in the last bit: the compiler neither reorders floating-point operations nor contracts them into
//! fused ones, so more lanes only means more vehicles at a time. [`crate::Batch`] is built on it.
//!
//! What it cannot do: a function that is *called* from the job, rather than inlined into it, keeps the code of
//! the plain build. Hence the `#[inline(always)]` on the physics.

use pulp::{Arch, NullaryFnOnce};

/// A job as [`pulp`] wants it: with a call that is inlined into each version of the code.
///
/// A bare closure will not do. `pulp` calls it through `FnOnce`, and the compiler's adapter from `FnMut` to
/// `FnOnce` is not inlined, whatever the closure asks for: the job would run, slowly, as plain code.
struct Job<F>(F);

impl<O, F: FnMut() -> O> NullaryFnOnce for Job<F> {
    type Output = O;

    #[inline(always)]
    fn call(mut self) -> O {
        (self.0)()
    }
}

/// Runs a job with the best instruction set that this processor has; the job runs once.
///
/// Choosing costs about a nanosecond, so a job should be a loop, not an operation. Mark the closure
/// `#[inline(always)]`, and all that it calls in the loop: what is not inlined is not recompiled.
///
/// ```
/// let (x, mut y) = ([1.0; 64], [0.5; 64]);
/// quad_math::dispatch(#[inline(always)] || {
///     for (y, x) in y.iter_mut().zip(&x) {
///         *y += 2.0 * x;
///     }
/// });
/// assert_eq!(y, [2.5; 64]);
/// ```
#[inline(always)]
pub fn dispatch<O>(job: impl FnMut() -> O) -> O {
    Arch::new().dispatch(Job(job))
}

/// The instruction set that [`dispatch`] chooses on this processor, for reports of measurements.
pub fn instruction_set() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    match Arch::new() {
        Arch::V4(_) => return "x86-64-v4 (AVX-512)",
        Arch::V3(_) => return "x86-64-v3 (AVX2)",
        _ => {}
    }
    "baseline"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_job_runs_once_and_its_value_comes_back() {
        let mut runs = 0;
        let value = dispatch(|| {
            runs += 1;
            42
        });
        assert_eq!((value, runs), (42, 1));
    }

    #[test]
    fn agree_every_instruction_set_gives_the_same_bits() {
        // Products and sums that a fused operation would round differently.
        #[inline(always)]
        fn job(x: &[f64; 64]) -> [f64; 64] {
            x.map(
                #[inline(always)]
                |x| x * x - (x + 1.0) * (x - 1.0) + x.abs().sqrt() / 3.0,
            )
        }
        let x: [f64; 64] = std::array::from_fn(|i| 0.1 + 1.7 * i as f64);
        let plain = job(std::hint::black_box(&x));
        assert_eq!(
            dispatch(
                #[inline(always)]
                || job(&x)
            ),
            plain
        );
    }

    #[test]
    fn exact_the_choice_has_a_name() {
        assert!(["x86-64-v4 (AVX-512)", "x86-64-v3 (AVX2)", "baseline"].contains(&instruction_set()));
    }
}
