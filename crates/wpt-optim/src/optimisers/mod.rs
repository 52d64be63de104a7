//! Optimisers that are asked for candidates and told what they cost.
//!
//! | type | kind | several candidates at a time | source |
//! | --- | --- | --- | --- |
//! | [`NelderMead`] | local simplex | its first simplex, its shrinking | Nelder and Mead 1965, rules of Lagarias et al. 1998 |
//! | [`LineSearch`] | along one variable after the other, over a box that is then narrowed | its scans | Kiefer 1953 (golden section) |
//! | [`Annealing`] | global, one walker | the sample that sets its first temperature | Corana et al. 1987 |
//! | [`Evolution`] | global, a population | each generation | Storn and Price 1997 |
//! | [`QuasiNewton`] | local, with gradients | no | Bertsekas 1982 (projected BFGS) |
//!
//! All of them keep candidates within the bounds, take anything random from a seed, can be saved (serde) at any time and
//! go on as if they had not been interrupted, and end with a [`StopReason`]. [`run`] and [`run_parallel`] drive them
//! within [`Limits`] and answer with a [`Report`]. The four without gradients are [`sifre::Optimiser`]s, too.
//!
//! # Why not a library's
//! argmin's solvers call the cost from inside their own iteration, have no bounds, and keep their state (the simplex,
//! the generator) to themselves: they can be asked and told only by a second thread or by replaying every cost known so far,
//! and neither can be saved. Crate `cmaes` too is driven by a closure and can't be saved, and it is built on an older
//! nalgebra. So the text-book algorithms stand here, each one function `next` that reads as its source; argmin and
//! SciPy are their oracles in the tests.
//!
//! ```
//! use sifre::Variable;
//! use wpt_optim::optimisers::{Limits, NelderMead, SimplexSettings, run, test_functions::himmelblau};
//!
//! let axis = |name: &str| Variable { name: name.into(), unit: "1".into(), lower: -5.0, upper: 5.0 };
//! let variables = vec![axis("x"), axis("y")];
//! let mut simplex = NelderMead::new(variables, &[0.0, 0.0], SimplexSettings::default())?;
//! let report = run(&mut simplex, |x| himmelblau(x), Limits::evaluations(500), &mut |_| std::ops::ControlFlow::Continue(()))?;
//! assert!(report.best.cost < 1e-6, "{}", report.stop);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod annealing;
mod draws;
mod error;
mod evolution;
mod line_search;
mod nelder_mead;
mod quasi_newton;
mod run;
mod search;
mod space;
mod stepwise;
pub mod test_functions;

pub use annealing::{Annealing, AnnealingSettings, Walk};
pub use error::{RunError, SetupError};
pub use evolution::{Evolution, EvolutionSettings, Population};
pub use line_search::{LineSearch, LineSearchSettings, Lines};
pub use nelder_mead::{Coefficients, NelderMead, Simplex, SimplexSettings};
pub use quasi_newton::{ProjectedBfgs, QuasiNewton, QuasiNewtonSettings, gradient_by_dual_numbers};
pub use run::{Limits, Progress, Report, run, run_parallel};
pub use search::{Answer, CostAndGradient, FAILED_COST, Search, StopReason};
pub use space::Space;
pub use stepwise::{Next, Rule, Stepwise, Vertex};
