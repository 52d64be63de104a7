//! State estimation with poor sensors on any level's model.

mod belief;
mod error;
mod estimate;
mod estimator;
mod extended;
mod filter;
mod level;
mod process;
pub mod sensor;
mod unscented;

pub use belief::{Belief, Innovation, Verdict};
pub use error::EstimationError;
pub use estimate::{Estimate, EstimateError, estimate};
pub use estimator::Estimator;
pub use extended::ExtendedFilter;
pub use filter::{Filter, Observation};
pub use level::{InitialUncertainty, LevelError, LevelProcess, ProcessNoise, places};
pub use process::Process;
pub use unscented::{Spread, UnscentedFilter};
