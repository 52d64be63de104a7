//! What a filter on a level says of the flight, in terms that do not depend on the level.

use crate::level::LevelProcess;
use crate::level::turn_between;
use crate::{Belief, Filter};
use nalgebra::{DVector, SMatrix, SVector, Vector3};
use quad_dynamics::RigidBodyState;
use quad_kinematics::Quaternion;
use quad_math::Real;

/// The rigid body as estimated, with the covariance of its twelve errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Position in W, m.
    pub position: Vector3<f64>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<f64>,
    /// Attitude.
    pub attitude: Quaternion<f64>,
    /// Body rates, rad/s.
    pub body_rates: Vector3<f64>,
    /// Disturbance of the specific force along B, m/s².
    pub disturbance: Vector3<f64>,
    /// Bias of the gyroscope, rad/s.
    pub gyroscope_bias: Vector3<f64>,
    /// Bias of the accelerometer, m/s².
    pub accelerometer_bias: Vector3<f64>,
    /// Covariance of the errors `[δr_W, δv_W, δθ_B, δω_B]`, truth less estimate, the attitude's being twice the Gibbs vector that
    /// turns the estimate into the truth.
    pub covariance: SMatrix<f64, 12, 12>,
}

/// Truth less estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimateError {
    /// Of the position, m, along W.
    pub position: Vector3<f64>,
    /// Of the velocity, m/s, along W.
    pub velocity: Vector3<f64>,
    /// Of the attitude, rad, along B.
    pub attitude: Vector3<f64>,
    /// Of the body rates, rad/s.
    pub body_rates: Vector3<f64>,
}

impl EstimateError {
    /// The twelve errors in the order of [`Estimate::covariance`].
    pub fn vector(&self) -> SVector<f64, 12> {
        let mut all = SVector::<f64, 12>::zeros();
        for (i, part) in [self.position, self.velocity, self.attitude, self.body_rates]
            .iter()
            .enumerate()
        {
            all.fixed_rows_mut::<3>(3 * i).copy_from(part);
        }
        all
    }
}

impl Estimate {
    /// Truth less estimate.
    pub fn error(&self, truth: &RigidBodyState<f64>) -> EstimateError {
        EstimateError {
            position: truth.position - self.position,
            velocity: truth.attitude.rotate(&truth.velocity) - self.velocity,
            attitude: turn_between(&self.attitude, &truth.attitude),
            body_rates: truth.body_rates - self.body_rates,
        }
    }

    /// Normalised estimation error squared `eᵀ P⁻¹ e` of the twelve errors, χ² with 12 degrees of freedom if the filter is
    /// consistent; NaN for a covariance that is none.
    pub fn nees(&self, truth: &RigidBodyState<f64>) -> f64 {
        let e = self.error(truth).vector();
        self.covariance
            .cholesky()
            .map_or(f64::NAN, |factor| e.dot(&factor.solve(&e)))
    }

    /// Standard deviations of the twelve errors.
    pub fn deviations(&self) -> SVector<f64, 12> {
        self.covariance.diagonal().map(f64::sqrt)
    }
}

/// What a filter believes of the rigid body.
pub fn estimate(filter: &mut impl Filter<Process = LevelProcess>) -> Estimate {
    let belief = filter.belief().clone();
    filter.process_mut().estimate(&belief)
}

impl LevelProcess {
    /// A belief about this level's state in terms of the rigid body.
    pub fn estimate(&mut self, belief: &Belief) -> Estimate {
        let Belief { mean, covariance } = belief;
        let layout = self.layout().clone();
        let x = mean.as_slice();
        let attitude = layout.attitude(x);
        let flight = self.model_at(mean).flight();
        let jacobian = self.jacobian_of(mean, 12, |dual, layout, x| {
            dual.read_state(x);
            let flight = dual.flight();
            let turn = turn_between(&lifted(&attitude), &layout.attitude(x));
            [flight.position, flight.velocity, turn, flight.body_rates]
                .iter()
                .flat_map(|v| v.iter().copied().collect::<Vec<_>>())
                .collect()
        });
        let twelve = &jacobian * covariance * jacobian.transpose();
        Estimate {
            position: flight.position,
            velocity: flight.velocity,
            attitude,
            body_rates: flight.body_rates,
            disturbance: layout.disturbance(x),
            gyroscope_bias: layout.gyroscope_bias(x),
            accelerometer_bias: layout.accelerometer_bias(x),
            covariance: SMatrix::from_fn(|i, j| 0.5 * (twelve[(i, j)] + twelve[(j, i)])),
        }
    }

    /// Normalised estimation error squared of all errors of the level's own state, χ² with as many degrees of freedom if
    /// the filter is consistent. The truth is a state of the same process; NaN for a covariance that is none.
    pub fn nees(&self, belief: &Belief, truth: &DVector<f64>) -> f64 {
        use crate::Process;
        let e = self.local(&belief.mean, truth);
        let factor = belief.covariance.clone().cholesky();
        factor.map_or(f64::NAN, |factor| e.dot(&factor.solve(&e)))
    }
}

/// A quaternion as constants of another scalar.
fn lifted<R: Real>(q: &Quaternion<f64>) -> Quaternion<R> {
    Quaternion {
        w: quad_math::constant(q.w),
        v: q.v.map(quad_math::constant),
    }
}
