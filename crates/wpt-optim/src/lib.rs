//! Trajectories for wireless power transmission: the problem, its rollouts and its cost.
//!
//! A quadrotor crosses the field of a ground station that keeps a laser on the receiver it carries. Where should it cross, and how
//! fast should it enter and leave, so that range, incidence and spot offset stay small? A [`Problem`] is that question at one level of the model
//! family; flights answer it.
//!
//! ```
//! use quad_dynamics::Level;
//! use wpt_optim::{Choice, Problem};
//!
//! // Cross in 4 s (the studies take 10 s and 20 s), deciding on x_0 and x_f.
//! let problem = Problem::nominal(Choice::Two, 4.0, Level::Three)?;
//! let near = problem.evaluate(&[1.5, 1.5])?;
//! let far = problem.evaluate(&[5.0, 5.0])?;
//! assert!(far.cost < near.cost && near.means.incidence > far.means.incidence);
//!
//! // Downhill from there, by dual numbers through the whole flight.
//! let slope = problem.gradient(&[1.5, 1.5])?.gradient;
//! assert!(slope[0] + slope[1] < 0.0);
//! # Ok::<(), wpt_optim::ProblemError>(())
//! ```
//!
//! # Where to find an equation
//!
//! | equation | code | source |
//! | --- | --- | --- |
//! | polynomials from boundary conditions | [`Mission`], [`Ends`], [`Condition`] | thesis 7.4 |
//! | nose to the station, tilt and rates from the path | [`Path`] | 7.4, appendix A |
//! | `Φ = 1/T ∫ Σ w_i f(e_i²) + Σ p_j f(v_j²) dt` | head of `cost.rs`; [`Weights`], [`Penalties`], [`Terms`] | 7.5 |
//! | controller, model, station and cost in one loop | head of `rollout.rs` | |
//! | the cost without dynamics | [`Problem::ideal`] | |
//! | the nominal settings | [`Choice`], [`Mission::crossing`] | 7.6, *choices* |
//!
//! # Questions to a problem
//!
//! | question | by |
//! | --- | --- |
//! | one decision | [`Problem::evaluate`], with its history [`Problem::histories`] |
//! | four side by side, on SIMD lanes | [`Problem::evaluate_lanes`] |
//! | many, on SIMD lanes and all cores | [`Problem::evaluate_all`], [`Problem::surface`] |
//! | cost and gradient | [`Problem::gradient`] |
//! | the same flight in the engine, bit for bit | [`Problem::simulation`] |
//! | a function for the optimisers of [`optim`] that counts | [`Objective`], with [`Problem::variables`] |
//!
//! # Conventions
//!
//! World north-east-down; a decision on a height is one on `z = −h`. Pairing: c1 on level 1, c2 on level 2, c3 on levels 3 to 5. Bounds
//! are the optimiser's business: a decision outside is flown like any other. The cost is finite whatever happens; a failed
//! flight says when it failed.
//!
//! # What it does not do
//!
//! No wind, no noise: a cost is a number, not a sample. A gradient is that of the side of a kink that was flown (a lost target, a
//! command at its limit). Over the station the bearing turns by half a turn at once and costs are steep there: trust no
//! gradient within half a metre of the zenith.

mod condition;
mod cost;
mod decision;
mod engine;
mod error;
mod fleet;
mod ideal;
mod mission;
mod nominal;
mod outcome;
mod path;
mod problem;
mod recorded;
mod rollout;
mod surface;

pub use condition::{Axis, Condition, Order, Side, UnknownCondition};
pub use cost::{BEND, FAILURE, HEAVIEST, LOST_M, Penalties, Terms, Weights};
pub use decision::Decision;
pub use engine::{EngineError, QUADROTOR, STATION};
pub use error::ProblemError;
pub use mission::{Ends, Mission};
pub use nominal::{Choice, HALF_CROSSING_M, HEIGHT_M, POSITION_SETTLING_S};
pub use outcome::{Failure, Histories, History, Outcome};
pub use path::Path;
pub use problem::{Gradient, LANES, Problem};
pub use recorded::{CostBox, Pair, Span};
pub use surface::{Grid, Minimum, Objective, Surface};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
