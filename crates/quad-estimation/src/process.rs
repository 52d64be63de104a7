//! What a filter needs to know of the world: how the state moves, what is measured, and how errors add to it.

use nalgebra::{DMatrix, DVector};

/// A stochastic process `x' = Φ(x, u, h) ⊞ w`, `w ~ N(0, Q)`, with measurements `y = h(x, u) + v`, `v ~ N(0, R)`.
///
/// States live on a manifold: an error `δ ∈ ℝⁿ` is added by [`Process::retract`] (`x ⊞ δ`) and read off by
/// [`Process::local`] (`x ⊟ x̂`), so that an attitude can be a quaternion and have three errors (Hertzberg et al.,
/// *Information Fusion* 14, 2013). Covariances are of `δ`.
pub trait Process {
    /// The known input `u`, held over a step.
    type Input: Copy;
    /// What can be measured.
    type Instrument: Copy;

    /// How many numbers a state has.
    fn state_len(&self) -> usize;

    /// How many errors it has, n.
    fn error_len(&self) -> usize;

    /// How many readings an instrument gives at once.
    fn readings(&self, instrument: Self::Instrument) -> usize;

    /// `x ⊞ δ`.
    fn retract(&self, x: &DVector<f64>, error: &DVector<f64>) -> DVector<f64>;

    /// `x ⊟ x̂`: the δ with `x̂ ⊞ δ = x`.
    fn local(&self, reference: &DVector<f64>, x: &DVector<f64>) -> DVector<f64>;

    /// `∂((x̂ ⊞ δ) ⊟ (x̂ ⊞ δ̂))/∂δ` at `δ = δ̂`: how errors about the old mean turn into errors about the new one; the
    /// identity where errors simply add.
    fn reset_jacobian(&self, error: &DVector<f64>) -> DMatrix<f64>;

    /// `Φ(x, u, h)`, h in s.
    fn transition(&mut self, x: &DVector<f64>, input: &Self::Input, step_s: f64) -> DVector<f64>;

    /// `∂(Φ(x ⊞ δ) ⊟ Φ(x))/∂δ` at `δ = 0`.
    fn transition_jacobian(&mut self, x: &DVector<f64>, input: &Self::Input, step_s: f64) -> DMatrix<f64>;

    /// Diagonal of Q for a step of h, s.
    fn process_noise(&self, step_s: f64) -> DVector<f64>;

    /// `h(x, u)` of an instrument.
    fn observe(
        &mut self,
        x: &DVector<f64>,
        input: &Self::Input,
        instrument: Self::Instrument,
    ) -> DVector<f64>;

    /// `∂h(x ⊞ δ, u)/∂δ` at `δ = 0`.
    fn observe_jacobian(
        &mut self,
        x: &DVector<f64>,
        input: &Self::Input,
        instrument: Self::Instrument,
    ) -> DMatrix<f64>;
}
