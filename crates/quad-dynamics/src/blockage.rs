//! Airframe blockage: the arms stand in the slipstream, and their drag takes from the thrust.
//!
//! ```text
//! v_i = −V_c/2 + √(V_c²/4 + T / (2 ρ A))      induced velocity, momentum theory
//! w   = V_c + κ v_i,   κ = 1 + d / √(d² + R²)  slipstream at the arm
//! D   = ½ ρ C_D S (|w| w − |V_c| V_c)          download, S = b R
//! ```
//!
//! with thrust T, disc area A = π R², climb V_c through the air along −z_B, arm width b and distance d of the arm below the
//! disc. κ is the acceleration of the slipstream, on the axis of a vortex cylinder: 1 in the disc, 2 far below. Each
//! arm blocks one radius of its own rotor. The free-stream part is taken off, since the airframe's drag has it already. In
//! hover D is the fixed share `C_D κ² S / (4 A)` of the thrust. The torque stays as it is.
//!
//! Valid in hover and climb, at forward speeds below the hover's induced velocity (5 m/s on the Qball-X4). In descent up to twice
//! that momentum theory has no answer: the climb's curve is continued. Source: J. G. Leishman, Principles of Helicopter Aerodynamics, 2nd
//! ed., 2006, chapters 2 (induced velocity) and 6 (download of the fuselage); S. F. Hoerner, Fluid-Dynamic Drag,
//! 1965 (C_D); that there is blockage: thesis 3.7. The one-arm strip is this project's choice.

use crate::{BuildError, Vehicle};
use nalgebra::SimdBool as _;
use quad_math::{Real, constant};

/// Least square of the induced velocity's root, m²/s²: below a micrometre a second it is as good as nothing, and the
/// derivative stays finite.
const LEAST_SQUARE: f64 = 1e-12;

/// The arms under the rotors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blockage<R: Real> {
    /// `½ ρ C_D S`, N s²/m².
    pub drag: R,
    /// `1 / (2 ρ A)`, m²/(N s²): thrust to the square of the induced velocity in hover.
    pub induced: R,
    /// Velocity κ of the slipstream at the arm over that in the disc, dimensionless, 1 to 2.
    pub acceleration: R,
}

impl<R: Real> Blockage<R> {
    /// The blockage of a vehicle.
    ///
    /// # Errors
    /// If the vehicle has no propeller or no arms.
    pub fn of(vehicle: &Vehicle) -> Result<Self, BuildError> {
        Self::with(&vehicle.map(constant))
    }

    pub(crate) fn with(vehicle: &Vehicle<R>) -> Result<Self, BuildError> {
        let needed_by = "the phenomenon blockage";
        let arms = vehicle.require_arms(needed_by)?;
        let radius = vehicle.require_propeller(needed_by)?.diameter / constant(2.0);
        let density = vehicle.environment.air_density;
        let disc = R::simd_pi() * radius * radius;
        let half: R = constant(0.5);
        Ok(Self {
            drag: half * density * arms.drag_coefficient * arms.width * radius,
            induced: half / (density * disc),
            acceleration: R::one() + arms.drop / arms.drop.simd_hypot(radius),
        })
    }

    /// Induced velocity `v_i` in the disc, m/s downwards, from thrust, N, and climb through the air, m/s.
    #[inline(always)]
    pub fn induced_velocity(&self, thrust: R, climb: R) -> R {
        let half = climb * constant(0.5);
        let square = half * half + thrust.simd_max(R::zero()) * self.induced;
        square.simd_max(constant(LEAST_SQUARE)).simd_sqrt() - half
    }

    /// Share of the thrust that is lost in hover, `C_D κ² S / (4 A)`; NaN where nothing would be left.
    pub fn share_in_hover(&self) -> R {
        let share = self.drag * self.acceleration * self.acceleration * self.induced;
        share.simd_lt(R::one()).if_else(|| share, || constant(f64::NAN))
    }

    /// Thrust lost to an arm D, N along z_B, positive down.
    #[inline(always)]
    pub fn download(&self, thrust: R, climb: R) -> R {
        let slipstream = climb + self.acceleration * self.induced_velocity(thrust, climb);
        self.drag * (slipstream.simd_abs() * slipstream - climb.simd_abs() * climb)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level2, Phenomenon, PhenomenonSet, QuadrotorModel};
    use approx::assert_relative_eq;
    use nalgebra::Vector3;
    use quad_math::System;

    fn qball() -> Blockage<f64> {
        Blockage::of(&Vehicle::qball_x4()).unwrap()
    }

    /// 3.4335 N on a disc of 0.0506707 m²: `√(3.4335 / (2 · 1.225 · 0.0506707))` = 5.259 m/s, by a pocket calculator.
    #[test]
    fn exact_induced_velocity_in_hover_and_climb() {
        let hover = qball().induced_velocity(3.4335, 0.0);
        assert_relative_eq!(hover, 5.259, epsilon = 5e-4);
        // Momentum: T = 2 ρ A (V_c + v) v, in climb and slow descent.
        for climb in [-2.0, 0.0, 1.0, 5.0] {
            let v = qball().induced_velocity(3.4335, climb);
            let thrust = 2.0 * 1.225 * std::f64::consts::PI * 0.127 * 0.127 * (climb + v) * v;
            assert_relative_eq!(thrust, 3.4335, max_relative = 1e-12);
        }
        // The induced power per rotor in hover, T v = 18.1 W, lies below the propeller's measured shaft power of
        // 26.4 W: figure of merit 0.68, as a slow flyer has it.
        let merit = 3.4335 * hover / 26.4;
        assert!((0.6..0.8).contains(&merit), "{merit}");
    }

    /// In hover the download is the same share of any thrust, `C_D κ² S / (4 A)`.
    #[test]
    fn exact_share_of_the_thrust_in_hover() {
        let acceleration = 1.0 + 0.03 / (0.03_f64 * 0.03 + 0.127 * 0.127).sqrt();
        let share = 1.2 * acceleration * acceleration * 0.02 / (4.0 * std::f64::consts::PI * 0.127);
        assert_relative_eq!(share, 0.022_74, epsilon = 5e-5);
        for thrust in [0.1, 3.4335, 8.0] {
            assert_relative_eq!(
                qball().download(thrust, 0.0),
                share * thrust,
                max_relative = 1e-12
            );
        }
        // No slipstream, no download that the airframe's drag doesn't have.
        assert_relative_eq!(qball().download(0.0, 3.0), 0.0, epsilon = 1e-6);
    }

    /// The vehicle sinks by the share of its weight; in a climb, where the slipstream is faster, by another share.
    #[test]
    fn exact_the_vehicle_sinks() {
        let vehicle = Vehicle::qball_x4();
        let on = PhenomenonSet::none().with(Phenomenon::Blockage);
        let model = Level2::<f64>::build(&vehicle, &on).unwrap();
        let hover = model.hover(Vector3::zeros(), 0.0);
        let mut input = Level2::<f64>::build(&vehicle, &PhenomenonSet::none())
            .unwrap()
            .hover(Vector3::zeros(), 0.0)
            .input;
        let rate = model.derivative(&hover.state, &input).body;
        let loss = 4.0 * qball().download(3.4335, 0.0);
        assert_relative_eq!(rate.velocity.z, loss / 1.4, max_relative = 1e-9);
        // Air that comes from above is climb.
        input.wind = Vector3::new(0.0, 0.0, 1.0);
        let climbing = model.derivative(&hover.state, &input).body;
        let loss = 4.0 * qball().download(3.4335, 1.0);
        assert_relative_eq!(climbing.velocity.z, loss / 1.4, max_relative = 1e-9);
        // The model's own trim makes up for it.
        let trimmed = model.derivative(&hover.state, &hover.input).body;
        assert_relative_eq!(trimmed.velocity.z, 0.0, epsilon = 1e-12);
    }

    #[test]
    fn exact_no_arms_is_an_error() {
        let mut vehicle = Vehicle::qball_x4();
        vehicle.arms = None;
        let message = Blockage::<f64>::of(&vehicle).unwrap_err().to_string();
        assert!(
            message.contains("[arms]") && message.contains("blockage"),
            "{message}"
        );
    }
}
