//! What follows from a vehicle's parameters by a formula of one line.

use nalgebra::{Matrix4, Vector3};
use quad_math::Real;
use quad_rotor::{Motor, Propeller, RotorDynamics};

use super::{
    ArmParameters, BatteryParameters, PolynomialRotorParameters, PropellerParameters, Vehicle, VehicleError,
};
use crate::{Drag, PerRotor, ROTORS};

impl<R: Real> Vehicle<R> {
    /// Hubs relative to the centre of mass, in B, m.
    #[must_use]
    pub fn hubs(&self) -> PerRotor<Vector3<R>> {
        self.rotors
            .each_ref()
            .map(|rotor| rotor.hub_position - self.airframe.centre_of_mass)
    }
}

impl Vehicle {
    /// Control matrix C: pseudo-inputs `[u_col, u_lat, u_long, u_yaw] = C u` from the zeroed commands of the four rotors.
    ///
    /// Column i is `[1, −y_i/L, x_i/L, −s_i]` with the hub relative to the centre of mass, so that
    /// `T = K_T u_col`, `M_x = L K_T u_lat`, `M_y = L K_T u_long`, `M_z = K_Q u_yaw`.
    #[must_use]
    pub fn control_matrix(&self) -> Matrix4<f64> {
        let (arm, hubs) = (self.airframe.arm_length, self.hubs());
        Matrix4::from_fn(|row, i| match row {
            0 => 1.0,
            1 => -hubs[i].y / arm,
            2 => hubs[i].x / arm,
            _ => -self.rotors[i].spin.sign(),
        })
    }

    /// Weight `m g`, N.
    #[must_use]
    pub fn weight(&self) -> f64 {
        self.airframe.mass * self.environment.gravity
    }

    /// Thrust per rotor in hover `m g / 4`, N, for rotors placed evenly about the centre of mass.
    #[must_use]
    pub fn hover_thrust_per_rotor(&self) -> f64 {
        self.weight() / ROTORS as f64
    }

    /// Span b, m: from tip to tip of the two rotors that are farthest apart, from hub to hub without a propeller;
    /// at least an arm.
    #[must_use]
    pub fn span(&self) -> f64 {
        let hubs = self.hubs().into_iter();
        let pairs = hubs
            .clone()
            .flat_map(|a| hubs.clone().map(move |b| (a - b).norm()));
        let diameter = self.propeller.as_ref().map_or(0.0, |p| p.diameter);
        pairs.fold(self.airframe.arm_length, f64::max) + diameter
    }

    /// Range of the zeroed command u: lower end `ū_min − ū_0` and upper end `ū_max − ū_0`.
    #[must_use]
    pub fn zeroed_range(&self) -> std::ops::RangeInclusive<f64> {
        let pwm = self.pwm;
        (pwm.minimum - pwm.zero_thrust)..=(pwm.maximum - pwm.zero_thrust)
    }
}

impl<R> Vehicle<R> {
    /// Transfer functions of the empirical rotor.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_rotor_dynamics(&self, needed_by: &'static str) -> Result<&RotorDynamics<R>, VehicleError> {
        self.require(&self.rotor_dynamics, "rotor_dynamics", needed_by)
    }

    /// Static polynomials of the empirical rotor.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_polynomial_rotor(
        &self,
        needed_by: &'static str,
    ) -> Result<&PolynomialRotorParameters<R>, VehicleError> {
        self.require(&self.polynomial_rotor, "polynomial_rotor", needed_by)
    }

    /// Propeller.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_propeller(
        &self,
        needed_by: &'static str,
    ) -> Result<&PropellerParameters<R>, VehicleError> {
        self.require(&self.propeller, "propeller", needed_by)
    }

    /// Motor and speed controller.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_motor(&self, needed_by: &'static str) -> Result<&Motor<R>, VehicleError> {
        self.require(&self.motor, "motor", needed_by)
    }

    /// Battery.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_battery(&self, needed_by: &'static str) -> Result<&BatteryParameters<R>, VehicleError> {
        self.require(&self.battery, "battery", needed_by)
    }

    /// Drag and rate damping.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_drag(&self, needed_by: &'static str) -> Result<&Drag<R>, VehicleError> {
        self.require(&self.drag, "drag", needed_by)
    }

    /// Arms under the rotors.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if the vehicle has none.
    pub fn require_arms(&self, needed_by: &'static str) -> Result<&ArmParameters<R>, VehicleError> {
        self.require(&self.arms, "arms", needed_by)
    }

    fn require<'a, T>(
        &self,
        group: &'a Option<T>,
        name: &'static str,
        needed_by: &'static str,
    ) -> Result<&'a T, VehicleError> {
        group.as_ref().ok_or_else(|| VehicleError::MissingGroup {
            vehicle: self.name.clone(),
            group: name,
            needed_by,
        })
    }
}

impl<R: Real> PropellerParameters<R> {
    /// The static law `T = k_T Ω²`, `Q = k_Q Ω²` in air of a density ρ, kg/m³.
    #[must_use]
    pub fn law(&self, air_density: R) -> Propeller<R> {
        Propeller::from_coefficients(
            self.thrust_coefficient,
            self.torque_coefficient,
            self.diameter,
            air_density,
        )
    }
}
