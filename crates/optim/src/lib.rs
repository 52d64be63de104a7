//! Ask/tell optimisers: ask for candidates, tell their costs.
//!
//! | you have | use | kind | side by side | source |
//! | --- | --- | --- | --- | --- |
//! | a cost, and a start in the right valley | [`NelderMead`] | local simplex | its first simplex, its shrinking | Nelder and Mead 1965, rules of Lagarias et al. 1998 |
//! | variables that hardly interact, several valleys along one | [`LineSearch`] | one variable after the other, over a box that is then narrowed | its scans | Kiefer 1953 (golden section) |
//! | no good start, and thousands of evaluations | [`Evolution`] | global, a population | each generation | Storn and Price 1997 |
//! | the same, and evaluations one at a time | [`Annealing`] | global, one walker | the sample that sets its first temperature | Corana et al. 1987 |
//! | a cost with its gradient | [`QuasiNewton`], [`gradient_by_dual_numbers`] | local | no | Bertsekas 1982 (projected BFGS) |
//! | an expensive cost and cheap approximations of it | [`multi_fidelity`] | the cheap ones searched globally, the expensive one within a trust region | no | March and Willcox 2012 |
//! | a baseline to compare with | [`RandomSearch`] | uniform | all | |
//!
//! All of them keep candidates within the bounds, take anything random from a seed, can be saved (serde) at any time and
//! resume as if they had not been interrupted, and end with a [`StopReason`]. [`minimise`], [`run`] and [`run_parallel`] drive them
//! within [`Limits`] and return a [`Report`]. Any other loop can: [`Optimiser`] has `ask` and `tell`. A method of your own is
//! one function, [`Rule::next`], from the answers to a batch of points to the next batch; [`Stepwise`] does the asking and telling.
//!
//! ```
//! use optim::{Limits, NelderMead, SimplexSettings, Variable, minimise, test_functions::himmelblau};
//!
//! let axis = |name: &str| Variable { name: name.into(), unit: "1".into(), lower: -5.0, upper: 5.0 };
//! let mut simplex = NelderMead::new(vec![axis("x"), axis("y")], &[0.0, 0.0], SimplexSettings::default())?;
//! let report = minimise(&mut simplex, |x| himmelblau(x), Limits::evaluations(500))?;
//! assert!(report.best.cost < 1e-6, "{}", report.stop);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! Less cost is better. A cost that is NaN, infinite or beyond 1e300 counts as failed: a run replaces it by [`FAILED_COST`], so
//! that it is merely the worst. Tolerances of variables are shares of the width between their bounds; tolerances of costs are in
//! the cost's unit. Not converged is a result with a reason, not an error; `Err` is for a wrong question.
//!
//! # Why not an existing library
//!
//! argmin's solvers call the cost from inside their own iteration, have no bounds, and keep their state (the simplex,
//! the generator) private: an ask/tell interface to them needs a second thread or a replay of every cost so far, and neither can
//! be saved. Crate `cmaes` too is driven by a closure and can't be saved, and it is built on an older
//! nalgebra. So this crate has the textbook algorithms, each one function `next` that reads like its source; tests compare
//! them with SciPy's.
//!
//! # What it does not do
//!
//! No constraints but bounds, no noise in the cost, no more than some dozens of variables.

mod annealing;
mod answer;
mod draws;
mod error;
mod evolution;
mod line_search;
pub mod multi_fidelity;
mod nelder_mead;
mod optimiser;
mod quasi_newton;
mod random_search;
mod run;
mod space;
mod stepwise;
pub mod test_functions;

pub use annealing::{Annealing, AnnealingSettings, Walk};
pub use answer::{Answer, CostAndGradient, FAILED_COST};
pub use error::{RunError, SetupError, TellError};
pub use evolution::{Evolution, EvolutionSettings, Population};
pub use line_search::{LineSearch, LineSearchSettings, Lines};
pub use nelder_mead::{Coefficients, NelderMead, Simplex, SimplexSettings};
pub use optimiser::{Candidate, Evaluation, Optimiser, StopReason, Variable};
pub use quasi_newton::{ProjectedBfgs, QuasiNewton, QuasiNewtonSettings, gradient_by_dual_numbers};
pub use random_search::RandomSearch;
pub use run::{Limits, Progress, Report, minimise, run, run_parallel};
pub use space::Space;
pub use stepwise::{Next, Rule, Stepwise, Vertex};

/// The README's example is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
