//! Derivatives by automatic differentiation: Jacobians and time derivatives along a flow.
//!
//! * [`jacobian`]: forward mode, exact to rounding, over [`num_dual::DualSVec64`].
//! * [`output_derivatives`]: `y, ẏ, ÿ, y⃛` of an output `y = h(x)` along `ẋ = f(x)`, that is the Lie
//!   derivatives `L_f^k h`, over [`num_dual::Dual3_64`] (truncated Taylor arithmetic in time).

use crate::{Flat, State};
use nalgebra::SMatrix;
use num_dual::{Dual3_64, DualSVec64};

/// The dual number that carries `N` partial derivatives.
pub type Dual<const N: usize> = DualSVec64<N>;

/// The truncated Taylor series in time up to third order.
pub type Taylor3 = Dual3_64;

/// The Jacobian `∂f_i/∂x_j` of `f: ℝᴺ → ℝᴹ` at `x`, `M × N`.
///
/// ```
/// let j = quad_math::jacobian(|x| [x[0] * x[1], x[1].sin()], [3.0, 0.0]);
/// assert_eq!(j, nalgebra::Matrix2::new(0.0, 3.0, 0.0, 1.0));
/// # use num_dual::DualNum;
/// ```
pub fn jacobian<const N: usize, const M: usize>(
    f: impl Fn(&[Dual<N>; N]) -> [Dual<N>; M],
    x: [f64; N],
) -> SMatrix<f64, M, N> {
    let seeded: [Dual<N>; N] = std::array::from_fn(|i| {
        let mut dual = Dual::<N>::from_re(x[i]);
        dual.eps = num_dual::Derivative::derivative_generic(nalgebra::Const::<N>, nalgebra::U1, i);
        dual
    });
    let y = f(&seeded);
    SMatrix::from_fn(|row, column| y[row].eps.0.map_or(0.0, |eps| eps[column]))
}

/// Values and first three time derivatives of outputs `y = h(x)` along the flow `ẋ = f(x)` at `x`.
///
/// `derivatives[k][i] = d^k y_i / dt^k`, k = 0 to 3. With `ẋ = f(x) + G(x) u` at constant `u` and an
/// output of relative degree `ν ≤ 3` this is `L_f^ν h + L_G L_f^(ν-1) h · u`.
///
/// The Taylor coefficients of the solution are found by Picard iteration: each pass through `f` makes
/// one more coefficient exact, so three passes suffice.
///
/// `X` is the state over [`Taylor3`]; `f` and `h` are the model's own text over that scalar. State and rate
/// must list their numbers in the same order.
///
/// # Panics
/// If `x` is shorter than the state: a programming error, not an input error.
pub fn output_derivatives<X, const M: usize>(
    f: impl Fn(&X) -> X::Rate,
    h: impl Fn(&X) -> [Taylor3; M],
    x: &[f64],
) -> [[f64; M]; 4]
where
    X: State<Taylor3> + Flat<Taylor3>,
    X::Rate: Flat<Taylor3>,
{
    const {
        assert!(
            X::LEN == <X::Rate as Flat<Taylor3>>::LEN,
            "each number of the state needs its rate"
        )
    };
    let mut series: Vec<Taylor3> = x.iter().map(|&value| Taylor3::from_re(value)).collect();
    let mut rate = vec![Taylor3::from_re(0.0); X::LEN];
    for _ in 0..3 {
        f(&X::read(&series)).write(&mut rate);
        for (coefficient, r) in series.iter_mut().zip(&rate) {
            // d/dt shifts the derivatives by one place.
            *coefficient = Taylor3::new(coefficient.re, r.re, r.v1, r.v2);
        }
    }
    let y = h(&X::read(&series));
    [y.map(|v| v.re), y.map(|v| v.v1), y.map(|v| v.v2), y.map(|v| v.v3)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rate, Real, constant, rk4};
    use approx::assert_relative_eq;
    use nalgebra::{Matrix2, SVector, Vector2};
    use proptest::prelude::*;

    /// A state with named fields whose rate is another struct, as the vehicles have.
    #[derive(Clone, Copy, Debug)]
    struct Pendulum<R> {
        angle: R,
        speed: R,
    }

    #[derive(Clone, Copy, Debug)]
    struct PendulumRate<R> {
        speed: R,
        acceleration: R,
    }

    impl<R: Real> Rate<R> for PendulumRate<R> {
        fn zero() -> Self {
            Self {
                speed: R::zero(),
                acceleration: R::zero(),
            }
        }

        fn add_scaled(&self, h: R, other: &Self) -> Self {
            Self {
                speed: self.speed + h * other.speed,
                acceleration: self.acceleration + h * other.acceleration,
            }
        }
    }

    impl<R: Real> State<R> for Pendulum<R> {
        type Rate = PendulumRate<R>;

        fn advanced(&self, h: R, rate: &Self::Rate) -> Self {
            Self {
                angle: self.angle + h * rate.speed,
                speed: self.speed + h * rate.acceleration,
            }
        }
    }

    impl<R: Real> Flat<R> for Pendulum<R> {
        const LEN: usize = 2;

        fn write(&self, out: &mut [R]) {
            (out[0], out[1]) = (self.angle, self.speed);
        }

        fn read(values: &[R]) -> Self {
            Self {
                angle: values[0],
                speed: values[1],
            }
        }
    }

    impl<R: Real> Flat<R> for PendulumRate<R> {
        const LEN: usize = 2;

        fn write(&self, out: &mut [R]) {
            (out[0], out[1]) = (self.speed, self.acceleration);
        }

        fn read(values: &[R]) -> Self {
            Self {
                speed: values[0],
                acceleration: values[1],
            }
        }
    }

    /// `φ̈ = -g sin φ` for a length of one metre.
    fn swing<R: Real>(x: &Pendulum<R>) -> PendulumRate<R> {
        PendulumRate {
            speed: x.speed,
            acceleration: -x.angle.simd_sin() * constant(9.81),
        }
    }

    proptest! {
        #[test]
        fn prop_jacobian_is_the_derivative(a in -2.0..2.0_f64, b in -2.0..2.0_f64) {
            use nalgebra::ComplexField;
            let j = jacobian(|x| [x[0].sin() * x[1], x[0] * x[0] + x[1].exp(), x[1]], [a, b]);
            let truth = [[a.cos() * b, a.sin()], [2.0 * a, b.exp()], [0.0, 1.0]];
            for (row, expected) in truth.iter().enumerate() {
                for (column, value) in expected.iter().enumerate() {
                    // One product or one elementary function: an ulp of numbers below 8, should the two
                    // libraries of elementary functions differ by it.
                    prop_assert!((j[(row, column)] - value).abs() < 4e-15);
                }
            }
        }

        #[test]
        fn prop_output_derivatives_of_the_pendulum(angle in -3.0..3.0_f64, speed in -3.0..3.0_f64) {
            let [y, y1, y2, y3] = output_derivatives::<Pendulum<Taylor3>, 2>(
                swing,
                |x| [x.angle, x.speed],
                &[angle, speed],
            );
            let g = 9.81;
            // φ, φ̇, φ̈ = -g sin φ, φ⃛ = -g φ̇ cos φ, φ⁗ = g φ̇² sin φ + g² sin φ cos φ.
            let fourth = g * speed * speed * angle.sin() + g * g * angle.sin() * angle.cos();
            let truth = [angle, speed, -g * angle.sin(), -g * speed * angle.cos(), fourth];
            for (k, derivative) in [y, y1, y2, y3].iter().enumerate() {
                // A handful of roundings of numbers up to 200.
                prop_assert!((derivative[0] - truth[k]).abs() < 2e-13);
                prop_assert!((derivative[1] - truth[k + 1]).abs() < 2e-13);
            }
        }
    }

    #[test]
    fn exact_jacobian_of_a_constant_is_zero() {
        let j = jacobian::<2, 1>(|_| [Dual::from_re(7.0)], [1.0, 2.0]);
        assert_eq!(j, nalgebra::Matrix1x2::zeros());
    }

    #[test]
    fn exact_jacobian_through_an_rk4_step() {
        // The step of ẋ = A x is x + hA x + … + (hA)⁴/24 x: its Jacobian is that matrix.
        let a = Matrix2::new(0.0, 1.0, -4.0, -0.4);
        let h = 0.1;
        let j = jacobian(
            |x: &[Dual<2>; 2]| {
                let rates = |_, x: &SVector<Dual<2>, 2>| a.map(constant::<Dual<2>>) * x;
                rk4(&rates, constant(0.0), &Vector2::from(*x), constant(h)).into()
            },
            [0.3, -0.7],
        );
        let ha = a * h;
        let series = Matrix2::identity() + ha + ha * ha / 2.0 + ha * ha * ha / 6.0 + ha * ha * ha * ha / 24.0;
        // Some thirty roundings of numbers of order one.
        assert_relative_eq!(j, series, epsilon = 1e-15, max_relative = 1e-14);
    }
}
