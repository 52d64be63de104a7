//! The seam between equations and solvers, and the fixed-step solvers themselves.
//!
//! A [`System`] is `ẋ = f(x, u)`. Every level of the quadrotor, every rotor, a gimbal or a pendulum is
//! one; controllers, estimators and integrators take any.
//!
//! Source of the formulas: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd
//! ed., table II.1.2.

use crate::{Rate, Real, State, constant};

/// A dynamic system `ẋ = f(x, u)` over scalars of kind `R`.
pub trait System<R: Real> {
    /// The state `x`.
    type State: State<R>;
    /// The input `u`.
    type Input: Copy;

    /// The rate `ẋ = f(x, u)`. Pure: it depends on nothing else and cannot fail.
    fn derivative(&self, state: &Self::State, input: &Self::Input) -> RateOf<R, Self>;
}

/// The rate of a system's state.
pub type RateOf<R, S> = <<S as System<R>>::State as State<R>>::Rate;

/// A fixed-step method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FixedStep {
    /// Explicit Euler, order 1.
    Euler,
    /// The classical Runge-Kutta method, order 4.
    #[default]
    Rk4,
}

impl FixedStep {
    /// The order of convergence for smooth right-hand sides.
    pub const fn order(self) -> u32 {
        match self {
            Self::Euler => 1,
            Self::Rk4 => 4,
        }
    }

    /// One step of size `h` of the system with the input held constant.
    #[inline(always)]
    pub fn step<R: Real, S: System<R> + ?Sized>(
        self,
        system: &S,
        state: &S::State,
        input: &S::Input,
        h: R,
    ) -> S::State {
        match self {
            Self::Euler => euler_step(system, state, input, h),
            Self::Rk4 => rk4_step(system, state, input, h),
        }
    }
}

/// One Euler step of size `h` with the input held constant.
#[inline(always)]
pub fn euler_step<R: Real, S: System<R> + ?Sized>(
    system: &S,
    state: &S::State,
    input: &S::Input,
    h: R,
) -> S::State {
    state.advanced(h, &system.derivative(state, input)).normalised()
}

/// One step of the classical Runge-Kutta method of size `h` with the input held constant.
#[inline(always)]
pub fn rk4_step<R: Real, S: System<R> + ?Sized>(
    system: &S,
    state: &S::State,
    input: &S::Input,
    h: R,
) -> S::State {
    rk4(
        #[inline(always)]
        |_, x: &S::State| system.derivative(x, input),
        R::zero(),
        state,
        h,
    )
}

/// One Euler step of size `h` of `ẋ = f(t, x)`.
#[inline(always)]
pub fn euler<R: Real, X: State<R>>(f: impl Fn(R, &X) -> X::Rate, t: R, x: &X, h: R) -> X {
    x.advanced(h, &f(t, x)).normalised()
}

/// One step of the classical Runge-Kutta method of size `h` of `ẋ = f(t, x)`.
#[inline(always)]
pub fn rk4<R: Real, X: State<R>>(f: impl Fn(R, &X) -> X::Rate, t: R, x: &X, h: R) -> X {
    let half = h * constant(0.5);
    let k1 = f(t, x);
    let k2 = f(t + half, &x.advanced(half, &k1));
    let k3 = f(t + half, &x.advanced(half, &k2));
    let k4 = f(t + h, &x.advanced(h, &k3));
    let two = constant(2.0);
    let sum = k1
        .add_scaled(two, &k2)
        .add_scaled(two, &k3)
        .add_scaled(R::one(), &k4);
    x.advanced(h * constant(1.0 / 6.0), &sum).normalised()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{F64x4, Simulation, TimeGrid, dormand_prince_step};
    use nalgebra::{SimdValue, Vector1, Vector2};

    /// A driven, damped Duffing oscillator `ẍ = -x - x³ - 0.1 ẋ + u`.
    struct Duffing;

    impl<R: Real> System<R> for Duffing {
        type State = Vector2<R>;
        type Input = R;

        fn derivative(&self, x: &Vector2<R>, &u: &R) -> Vector2<R> {
            Vector2::new(x.y, u - x.x - x.x * x.x * x.x - x.y * constant(0.1))
        }
    }

    /// `ẋ = x cos t`, `x(0) = 1`: `x = e^(sin t)`, explicit in time.
    fn wave(t: f64, x: &Vector1<f64>) -> Vector1<f64> {
        x * t.cos()
    }

    fn wave_truth(t: f64) -> f64 {
        t.sin().exp()
    }

    /// Error at t = 2 after steps of `h = 2/n`.
    fn error_at_end(n: u64, step: impl Fn(f64, &Vector1<f64>, f64) -> Vector1<f64>) -> f64 {
        let grid = TimeGrid::new(2_000_000_000 / n, n).unwrap();
        let run =
            Simulation::on(grid).run_map(|tick, x| step(tick.time_s, x, tick.step_s), Vector1::new(1.0));
        (run.samples.last().unwrap().state.x - wave_truth(2.0)).abs()
    }

    /// Least-squares slope of log₂(error) over log₂(h) for four step sizes.
    fn slope(error: impl Fn(u64) -> f64) -> f64 {
        let errors = [16, 32, 64, 128].map(|n| error(n).log2());
        // Abscissae -3/2, -1/2, 1/2, 3/2 in units of one halving.
        -(3.0 * (errors[3] - errors[0]) + (errors[2] - errors[1])) / 10.0
    }

    #[test]
    fn exact_orders_of_convergence() {
        let euler_slope = slope(|n| error_at_end(n, |t, x, h| euler(&wave, t, x, h)));
        let rk4_slope = slope(|n| error_at_end(n, |t, x, h| rk4(&wave, t, x, h)));
        let dopri5_slope = slope(|n| {
            error_at_end(n, |t, x, h| {
                dormand_prince_step(&wave, t, x, wave(t, x), h).dense.end
            })
        });
        // The next term of the error expansion bends the line by O(h), h from 1/8 to 1/64: a tenth or two.
        for (slope, order) in [
            (euler_slope, f64::from(FixedStep::Euler.order())),
            (rk4_slope, f64::from(FixedStep::Rk4.order())),
            (dopri5_slope, 5.0),
        ] {
            assert!(
                (slope - order).abs() < 0.2,
                "slope {slope} of a method of order {order}"
            );
        }
    }

    #[test]
    fn exact_dense_output_between_the_steps_converges_as_the_steps_do() {
        // A local error h⁵ that does not add up is a global error of order 5, anywhere between the steps.
        let worst = |n: u64| {
            let h = 2.0 / n as f64;
            let mut x = Vector1::new(1.0);
            let mut worst = 0.0_f64;
            for k in 0..n {
                let t = k as f64 * h;
                let step = dormand_prince_step(&wave, t, &x, wave(t, &x), h).dense;
                for theta in [0.2, 0.5, 0.8] {
                    worst = worst.max((step.at_fraction(theta).x - wave_truth(t + theta * h)).abs());
                }
                x = step.end;
            }
            worst
        };
        let slope = slope(worst);
        assert!((slope - 5.0).abs() < 0.2, "slope {slope}");
    }

    #[test]
    fn exact_polynomials_up_to_the_order_are_integrated_without_error() {
        // A method of order p integrates ẋ = t^(p-1) exactly.
        let x = rk4(
            &|t: f64, _: &Vector1<f64>| Vector1::new(4.0 * t * t * t),
            0.0,
            &Vector1::zeros(),
            2.0,
        );
        assert_eq!(x.x, 16.0);
        let x = euler(
            &|_: f64, _: &Vector1<f64>| Vector1::new(3.0),
            0.0,
            &Vector1::zeros(),
            2.0,
        );
        assert_eq!(x.x, 6.0);
    }

    #[test]
    fn agree_lanes_with_scalars() {
        let (starts, inputs) = ([0.5, -1.0, 1.5, 0.0], [0.0, 0.3, -0.2, 1.0]);
        for method in [FixedStep::Euler, FixedStep::Rk4] {
            let wide_start = Vector2::new(F64x4::from(starts), F64x4::splat(0.2));
            let wide = method.step(&Duffing, &wide_start, &F64x4::from(inputs), F64x4::splat(0.05));
            for lane in 0..4 {
                let x = Vector2::new(starts[lane], 0.2);
                let scalar = method.step(&Duffing, &x, &inputs[lane], 0.05);
                // Some fifty operations of order one, possibly fused in one of the two.
                assert!((wide.map(|v| v.extract(lane)) - scalar).amax() < 1e-14);
            }
        }
    }

    #[test]
    fn agree_held_input_with_a_function_of_time() {
        let f = |_, x: &Vector2<f64>| Duffing.derivative(x, &0.7);
        let x = Vector2::new(0.4, -0.1);
        assert_eq!(
            FixedStep::Rk4.step(&Duffing, &x, &0.7, 0.1),
            rk4(&f, 0.0, &x, 0.1)
        );
        assert_eq!(
            FixedStep::Euler.step(&Duffing, &x, &0.7, 0.1),
            euler(&f, 0.0, &x, 0.1)
        );
    }
}
