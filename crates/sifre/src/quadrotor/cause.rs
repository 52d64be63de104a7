//! Why a quadrotor probably diverged.
//!
//! ```text
//! h p > 2       a step h is too long for a pole −p: commands that are held for it, and RK4 (from 2.8 on), make the loop unstable
//! |a| > 100 g   a reference that no quadrotor can follow
//! ```

use super::ModelQuadrotor;
use crate::clock::StepSize;
use quad_ndi::Reference;

/// Step times pole from which on a sampled loop is unstable.
const STEP_TIMES_POLE: f64 = 2.0;

/// Acceleration of a reference that nothing can follow, m/s²: a hundred times the standard gravity.
const WILD_M_S2: f64 = 980.665;

/// What probably made it diverge with this step, in words.
pub(super) fn of(quadrotor: &ModelQuadrotor, step: StepSize) -> Option<String> {
    let substeps = quadrotor.setup.substeps.get();
    let h = step.seconds() / f64::from(substeps);
    let pole = quadrotor.quadrotor.fastest_pole();
    if h * pole > STEP_TIMES_POLE {
        let longest = STEP_TIMES_POLE / pole;
        return Some(format!(
            "its step of {h} s is too long for the fastest pole of its rotors, {pole:.0} rad/s: a step below {longest:.1e} s is stable"
        ));
    }
    let Reference { flat, .. } = &quadrotor.reference;
    let acceleration = flat.acceleration.norm();
    (acceleration > WILD_M_S2)
        .then(|| format!("its reference asks for an acceleration of {acceleration:.1e} m/s²"))
}
