//! Ground effect: thrust that grows near the ground.
//!
//! ```text
//! T_i = g(z_i/R) T_i,∞      g = 1 / (1 − (R / 4z)²)
//! ```
//!
//! with the height z of each hub above the ground, the plane z = 0 of W, and the rotor radius R. A source at the rotor
//! and its mirror image below the ground take a part of the inflow away, so that the same power gives more thrust;
//! the torque stays as it is.
//!
//! Valid for hover over flat ground from z/R = 0.5 up, where the source compares it with measurements; at z/R = 1/4
//! the formula has a pole. Below 0.5 the gain is held at its value there, 4/3 (kink). Each rotor is taken alone: the
//! fountain between four wakes is not in it, and forward flight is not either. Source: I. C. Cheeseman and W. E. Bennett,
//! The effect of the ground on a helicopter rotor in forward flight, ARC R&M 3021, 1955.

use crate::{BuildError, RigidBodyState, Vehicle};
use nalgebra::Vector3;
use quad_math::{Real, constant};

/// Ground effect on the rotors of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundEffect<R: Real> {
    /// Rotor radius R, m.
    pub radius: R,
    /// Hub positions relative to the centre of mass, along B, m.
    pub hubs: [Vector3<R>; 4],
}

impl<R: Real> GroundEffect<R> {
    /// Lowest z/R at which the formula is used; below, its value here is held.
    pub const LOWEST_HEIGHT_IN_RADII: f64 = 0.5;

    /// The ground effect on a vehicle.
    ///
    /// # Errors
    /// If the vehicle has no propeller.
    pub fn of(vehicle: &Vehicle) -> Result<Self, BuildError> {
        Self::with(&vehicle.map(constant))
    }

    pub(crate) fn with(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let propeller = vehicle.require_propeller("the phenomenon ground-effect")?;
        Ok(Self {
            radius: propeller.diameter / constant(2.0),
            hubs: vehicle.hubs(),
        })
    }

    /// Thrust at a height over thrust far from the ground, `g`, from the height in radii, z/R.
    #[inline(always)]
    pub fn gain(height_in_radii: R) -> R {
        let height = height_in_radii.simd_max(constant(Self::LOWEST_HEIGHT_IN_RADII));
        let quarter = (constant::<R>(4.0) * height).simd_recip();
        (R::one() - quarter * quarter).simd_recip()
    }

    /// The gain of each rotor of a body in the air.
    #[inline(always)]
    pub fn gains(&self, body: &RigidBodyState<R>) -> [R; 4] {
        std::array::from_fn(|i| {
            let height = -(body.position + body.attitude.rotate(&self.hubs[i])).z;
            Self::gain(height / self.radius)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level2, Phenomenon, PhenomenonSet, QuadrotorModel};
    use approx::assert_relative_eq;
    use quad_math::System;

    /// The values that Cheeseman and Bennett's formula takes, worked out apart from this code.
    #[test]
    fn exact_gain_at_published_heights() {
        // Printed to five decimals.
        for (height, gain) in [(0.5, 1.33333), (1.0, 1.06667), (2.0, 1.01587), (4.0, 1.00392)] {
            assert_relative_eq!(GroundEffect::<f64>::gain(height), gain, epsilon = 5e-6);
        }
        for below in [0.49, 0.25, 0.0, -3.0] {
            assert_relative_eq!(GroundEffect::<f64>::gain(below), 4.0 / 3.0, max_relative = 1e-15);
        }
        assert_eq!(GroundEffect::<f64>::gain(1e9), 1.0);
    }

    /// In hover at one radius the vehicle rises with `g (1.06667 − 1)`; rolled to the right, the right rotor is nearer
    /// to the ground, lifts more and rolls it back.
    #[test]
    fn exact_lifts_and_rights_the_vehicle() {
        let vehicle = Vehicle::qball_x4();
        let on = PhenomenonSet::none().with(Phenomenon::GroundEffect);
        let model = Level2::<f64>::build(&vehicle, &on).unwrap();
        let hover = model.hover(Vector3::new(0.0, 0.0, -0.127), 0.0);
        let rate = model.derivative(&hover.state, &hover.input).body;
        assert_relative_eq!(rate.velocity.z, -9.81 / 15.0, max_relative = 1e-12);
        assert_relative_eq!(rate.body_rates.norm(), 0.0, epsilon = 1e-12);

        let mut rolled = hover.state;
        let roll = 0.1_f64;
        rolled.body.attitude = quad_kinematics::EulerAngles {
            roll,
            pitch: 0.0,
            yaw: 0.0,
        }
        .quaternion();
        let thrust = |height: f64| 1.4 * 9.81 / 4.0 / (1.0 - (0.127 / (4.0 * height)).powi(2));
        let drop = 0.2 * roll.sin();
        let moment = 0.2 * (thrust(0.127 + drop) - thrust(0.127 - drop));
        let rate = model.derivative(&rolled, &hover.input).body;
        assert!(moment < 0.0);
        assert_relative_eq!(rate.body_rates.x, moment / 0.03, max_relative = 1e-9);
    }
}
