//! Jacobians of functions whose size is known at run time only, by dual numbers of a fixed size.

use nalgebra::DMatrix;
use quad_math::{Dual, constant};

/// Partial derivatives carried at once.
const CHUNK: usize = 8;

/// The dual number of the filters.
pub(super) type Seeded = Dual<CHUNK>;

/// `∂f_i/∂δ_j` of `f: ℝⁿ → ℝᵐ` at `δ = 0`, [`CHUNK`] columns at a time.
pub(super) fn by_chunks(
    inputs: usize,
    outputs: usize,
    mut f: impl FnMut(&[Seeded]) -> Vec<Seeded>,
) -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(outputs, inputs);
    for first in (0..inputs).step_by(CHUNK) {
        let columns = CHUNK.min(inputs - first);
        let mut seeds = vec![constant::<Seeded>(0.0); inputs];
        for k in 0..columns {
            seeds[first + k].eps =
                num_dual::Derivative::derivative_generic(nalgebra::Const::<CHUNK>, nalgebra::U1, k);
        }
        for (row, y) in f(&seeds).iter().enumerate() {
            if let Some(eps) = &y.eps.0 {
                for k in 0..columns {
                    jacobian[(row, first + k)] = eps[k];
                }
            }
        }
    }
    jacobian
}
