//! What the vehicle is asked to do: the trajectory, nose to the station.
//!
//! The same operations as [`sifre::Facing`] around [`sifre::Mission`], over any scalar.

use nalgebra::Vector3;
use quad_dynamics::RigidBodyState;
use quad_kinematics::EulerRates;
use quad_math::Real;
use quad_ndi::{FlatOutput, Leg, Reference, TiltLaw};

/// A trajectory flown with the nose to a fixed point.
#[derive(Clone, Copy, Debug)]
pub struct Path<R: Real> {
    /// Position as polynomials of time.
    pub leg: Leg<R>,
    /// Where the nose points to: the station's crossing of axes in W, m.
    pub faced: Vector3<R>,
    /// Gravity g, m/s².
    pub gravity: R,
    /// How acceleration and tilt go together.
    pub tilt_law: TiltLaw,
}

impl<R: Real> Path<R> {
    /// The flat output at a time, s, with the nose to the point from where the vehicle really is.
    #[inline(always)]
    pub fn flat_output(&self, t: R, position: &Vector3<R>, velocity: &Vector3<R>) -> FlatOutput<R> {
        // The station's velocity less the vehicle's, as the engine has it.
        let line_rate = Vector3::zeros() - velocity;
        self.leg
            .flat_output(t)
            .facing(&(self.faced - position), &line_rate)
    }

    /// The reference at a time, s, for a vehicle at this position with this velocity in W.
    #[inline(always)]
    pub fn reference(&self, t: R, position: &Vector3<R>, velocity: &Vector3<R>) -> Reference<R> {
        let flat = self.flat_output(t, position, velocity);
        Reference::following(flat, self.gravity, self.tilt_law)
    }

    /// The reference at a time, s, for a vehicle that is exactly where it should be.
    pub fn ideal(&self, t: R) -> Reference<R> {
        let flat = self.leg.flat_output(t);
        self.reference(t, &flat.position, &flat.velocity)
    }

    /// The rigid body of a vehicle that is exactly where it should be, turning as it should.
    pub fn body(&self, t: R) -> RigidBodyState<R> {
        let Reference { flat, attitude } = self.ideal(t);
        let angles = flat.attitude(self.gravity, self.tilt_law);
        let quaternion = angles.quaternion();
        RigidBodyState {
            position: flat.position,
            velocity: quaternion.conjugate().rotate(&flat.velocity),
            attitude: quaternion,
            body_rates: angles.body_rates(&EulerRates::from_vector(&attitude.rates)),
        }
    }
}
