//! Either filter, chosen at run time.

use crate::{
    Belief, EstimationError, ExtendedFilter, Filter, Innovation, Observation, Process, UnscentedFilter,
};

/// An extended or an unscented Kalman filter on a process.
#[derive(Clone, Debug)]
pub enum AnyFilter<P> {
    /// Error-state extended.
    Extended(ExtendedFilter<P>),
    /// Unscented.
    Unscented(UnscentedFilter<P>),
}

impl<P: Process> Filter for AnyFilter<P> {
    type Process = P;

    fn process(&self) -> &P {
        match self {
            Self::Extended(filter) => filter.process(),
            Self::Unscented(filter) => filter.process(),
        }
    }

    fn process_mut(&mut self) -> &mut P {
        match self {
            Self::Extended(filter) => filter.process_mut(),
            Self::Unscented(filter) => filter.process_mut(),
        }
    }

    fn belief(&self) -> &Belief {
        match self {
            Self::Extended(filter) => filter.belief(),
            Self::Unscented(filter) => filter.belief(),
        }
    }

    fn believe(&mut self, belief: Belief) {
        match self {
            Self::Extended(filter) => filter.believe(belief),
            Self::Unscented(filter) => filter.believe(belief),
        }
    }

    fn predicted(&mut self, input: &P::Input, step_s: f64) -> Result<Belief, EstimationError> {
        match self {
            Self::Extended(filter) => filter.predicted(input, step_s),
            Self::Unscented(filter) => filter.predicted(input, step_s),
        }
    }

    fn corrected(
        &mut self,
        input: &P::Input,
        observation: &Observation<P::Instrument>,
        gate: Option<f64>,
    ) -> Result<(Belief, Innovation), EstimationError> {
        match self {
            Self::Extended(filter) => filter.corrected(input, observation, gate),
            Self::Unscented(filter) => filter.corrected(input, observation, gate),
        }
    }
}
