//! The mathematics below the physics: scalars, states, integration, derivatives, time grids, polynomials.
//!
//! One implementation serves many scalars. A model generic in `R:` [`Real`] runs on `f64`, on dual numbers (its
//! Jacobian is then exact) and on SIMD lanes (several vehicles in one processor instruction):
//!
//! | you have | you want | use |
//! | --- | --- | --- |
//! | `ẋ = f(x, u)` with the input held | one fixed step | [`FixedStep`], [`rk4_step`], [`euler_step`] |
//! | `ẋ = f(t, x)` and an exact grid | samples, or the instant it diverged | [`Simulation`] on a [`TimeGrid`] |
//! | `ẋ = f(t, x)` and a tolerance | a solution at any instant | [`DormandPrince`] |
//! | many vehicles of one model | a step of all, vectorised | [`Batch`] |
//! | `y = f(x)` | `∂y/∂x` | [`jacobian`] |
//! | `ẋ = f(x)`, `y = h(x)` | `y, ẏ, ÿ, y⃛`: Lie derivatives | [`output_derivatives`] |
//! | values and derivatives at two ends | the polynomial between them | [`Segment`] |
//!
//! # Example
//!
//! A damped oscillator `ẍ = -4x - 0.4ẋ`, written once, stepped on a grid and linearised by the same code.
//!
//! ```
//! use nalgebra::{Matrix2, Vector2};
//! use quad_math::{Dual, Real, Simulation, TimeGrid, constant, jacobian};
//!
//! fn rate<R: Real>(x: &Vector2<R>) -> Vector2<R> {
//!     Vector2::new(x.y, -x.x * constant(4.0) - x.y * constant(0.4))
//! }
//!
//! let grid = TimeGrid::from_seconds(0.01, 20.0)?;
//! let run = Simulation::on(grid).run(|_t, x| rate(x), Vector2::new(1.0, 0.0));
//! assert!(run.is_complete());
//! assert_eq!(run.samples[2000].time_s, 20.0); // a whole number of ticks: no drift
//!
//! let a = jacobian(|x: &[Dual<2>; 2]| rate(&Vector2::from(*x)).into(), [0.0, 0.0]);
//! assert_eq!(a, Matrix2::new(0.0, 1.0, -4.0, -0.4));
//! # Ok::<(), quad_math::GridError>(())
//! ```
//!
//! # What it does not do
//!
//! No units in the types: times are seconds and everything else is in the unit that its owner documents. The integrators
//! are explicit, for non-stiff problems. A step of constant input or smooth `f` is assumed: a kink within a
//! step costs accuracy whatever the order, so put kinks on the ends of steps.

mod adaptive;
mod atan2;
mod batch;
mod derivatives;
mod dispatch;
mod grid;
mod polynomial;
mod real;
mod round;
mod simulate;
mod sqrt;
mod state;
mod system;

pub use adaptive::{
    AdaptiveError, AdaptiveOptions, AdaptiveRun, AdaptiveStatistics, AdaptiveStatus, DenseStep,
    DormandPrince, DormandPrinceStep, dormand_prince_step,
};
pub use atan2::atan2;
pub use batch::{Batch, LANES, MAX_NUMBERS};
pub use derivatives::{Dual, Taylor3, jacobian, output_derivatives};
pub use dispatch::{dispatch, instruction_set};
pub use grid::{GridError, TimeGrid};
pub use polynomial::{End, Polynomial, Segment, SegmentError};
pub use real::{F32x8, F64x4, Real, constant};
pub use round::{round, wrapped};
pub use simulate::{Sample, Simulation, SimulationRun, SimulationStatus, Tick};
pub use sqrt::sqrt;
pub use state::{Flat, Rate, State};
pub use system::{FixedStep, RateOf, System, euler, euler_step, rk4, rk4_step};
