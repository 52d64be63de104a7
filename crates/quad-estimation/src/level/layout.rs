//! The order of a filter's numbers: the model's flat state, then disturbance and biases; and of their errors.
//!
//! Every level's flat state begins with position, velocity, attitude and rates, whatever follows. The attitude is a quaternion
//! at levels 2 to 5 and Euler angles at level 1. Errors add, but for the quaternion, whose error is twice the Gibbs
//! vector of a small turn along B:
//!
//! ```text
//! q = q̂ ⊗ δq(δθ),  δq(δθ) = [1, δθ/2] / √(1 + |δθ|²/4)         δθ = 2 v/w of q̂* ⊗ q
//! ```
//!
//! which is smooth, has no branch, and is the rotation vector to second order. Errors about a new mean `q̂ ⊗ δq(δθ̂)` follow
//! from those about the old one by `G = (1 − [δθ̂/2]×) / (1 + |δθ̂|²/4)`, exactly at the new mean. Source: Markley, *J.
//! Guidance* 26 (2003); Solà (2017), section 6.3, has G to first order.

use nalgebra::{DMatrix, Matrix3, Vector3};
use quad_dynamics::AnyQuadrotor;
use quad_kinematics::{EulerAngles, Quaternion, cross_matrix};
use quad_math::{Flat, Real, constant};

/// Where the errors that every level has stand in the error state.
pub mod places {
    /// δr, m, along W.
    pub const POSITION: usize = 0;
    /// δv, m/s: along B at levels 2 to 5, along W at level 1.
    pub const VELOCITY: usize = 3;
    /// δθ, rad: along B at levels 2 to 5, of the Euler angles at level 1.
    pub const ATTITUDE: usize = 6;
    /// δω, rad/s: of the body rates at levels 2 to 5, of the Euler angles' rates at level 1.
    pub const RATES: usize = 9;
    /// The level's own states of rotors and supply begin here.
    pub const OWN: usize = 12;
}

/// Disturbance and two biases.
pub(crate) const EXTRAS: usize = 9;

/// How the attitude is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Attitude {
    Euler,
    Quaternion,
}

/// Sizes and scales of a level's state.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    attitude: Attitude,
    model_len: usize,
    /// Natural sizes of the rotors' and supply's states, in their units.
    pub(super) own_scales: Vec<f64>,
    /// Longest step of the integrator, s.
    pub(super) longest_step_s: f64,
}

impl Layout {
    pub(crate) fn of(model: &AnyQuadrotor<f64>, longest_step_s: f64) -> Self {
        let is_rigid_body = model.level().capabilities().non_linear_rigid_body;
        Self {
            attitude: if is_rigid_body {
                Attitude::Quaternion
            } else {
                Attitude::Euler
            },
            model_len: model.state_len(),
            longest_step_s,
            own_scales: model.own_scales(),
        }
    }

    pub(crate) fn state_len(&self) -> usize {
        self.model_len + EXTRAS
    }

    pub(crate) fn error_len(&self) -> usize {
        places::OWN + self.own_scales.len() + EXTRAS
    }

    /// Where the attitude's numbers end in a state.
    fn attitude_end(&self) -> usize {
        match self.attitude {
            Attitude::Euler => places::ATTITUDE + 3,
            Attitude::Quaternion => places::ATTITUDE + 4,
        }
    }

    pub(crate) fn velocity_is_along_body(&self) -> bool {
        self.attitude == Attitude::Quaternion
    }

    /// The attitude in a state.
    pub(crate) fn attitude<R: Real>(&self, x: &[R]) -> Quaternion<R> {
        match self.attitude {
            Attitude::Euler => EulerAngles::read(&x[places::ATTITUDE..]).quaternion(),
            Attitude::Quaternion => Quaternion::read(&x[places::ATTITUDE..]),
        }
    }

    pub(crate) fn disturbance<R: Real>(&self, x: &[R]) -> Vector3<R> {
        Vector3::read(&x[self.model_len..])
    }

    pub(crate) fn gyroscope_bias<R: Real>(&self, x: &[R]) -> Vector3<R> {
        Vector3::read(&x[self.model_len + 3..])
    }

    pub(crate) fn accelerometer_bias<R: Real>(&self, x: &[R]) -> Vector3<R> {
        Vector3::read(&x[self.model_len + 6..])
    }

    /// `x ⊞ δ`.
    pub(crate) fn retract<R: Real>(&self, x: &[R], error: &[R]) -> Vec<R> {
        let mut moved = x.to_vec();
        let (before, turned) = (places::ATTITUDE, self.attitude_end());
        for i in 0..before {
            moved[i] += error[i];
        }
        let turn = Vector3::read(&error[before..]);
        match self.attitude {
            Attitude::Euler => (Vector3::read(&x[before..]) + turn).write(&mut moved[before..]),
            Attitude::Quaternion => {
                let q = Quaternion::read(&x[before..]).product(&small_turn(&turn));
                q.write(&mut moved[before..]);
            }
        }
        for (value, error) in moved[turned..].iter_mut().zip(&error[before + 3..]) {
            *value += *error;
        }
        moved
    }

    /// `x ⊟ x̂`.
    pub(crate) fn local<R: Real>(&self, reference: &[R], x: &[R]) -> Vec<R> {
        let (before, turned) = (places::ATTITUDE, self.attitude_end());
        let mut error: Vec<R> = (0..before).map(|i| x[i] - reference[i]).collect();
        let turn = match self.attitude {
            Attitude::Euler => Vector3::read(&x[before..]) - Vector3::<R>::read(&reference[before..]),
            Attitude::Quaternion => turn_between(
                &Quaternion::read(&reference[before..]),
                &Quaternion::read(&x[before..]),
            ),
        };
        error.extend_from_slice(turn.as_slice());
        error.extend(x[turned..].iter().zip(&reference[turned..]).map(|(x, r)| *x - *r));
        error
    }

    /// G of the head of this file.
    pub(crate) fn reset_jacobian(&self, error: &[f64]) -> DMatrix<f64> {
        let n = self.error_len();
        let mut g = DMatrix::identity(n, n);
        if self.attitude == Attitude::Quaternion {
            let half = Vector3::<f64>::read(&error[places::ATTITUDE..]) * 0.5;
            let block = (Matrix3::identity() - cross_matrix(&half)) / (1.0 + half.norm_squared());
            g.fixed_view_mut::<3, 3>(places::ATTITUDE, places::ATTITUDE)
                .copy_from(&block);
        }
        g
    }
}

/// `δq(δθ)`.
fn small_turn<R: Real>(turn: &Vector3<R>) -> Quaternion<R> {
    Quaternion {
        w: R::one(),
        v: turn * constant::<R>(0.5),
    }
    .normalised()
}

/// The δθ, rad along B, that turns one attitude into the other, twice the Gibbs vector; infinite for half a turn.
pub(crate) fn turn_between<R: Real>(from: &Quaternion<R>, to: &Quaternion<R>) -> Vector3<R> {
    let q = from.conjugate().product(to);
    q.v * (constant::<R>(2.0) / q.w)
}
