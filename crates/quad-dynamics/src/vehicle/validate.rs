//! Is this a quadrotor? Every number against its range, then the numbers against each other.

use nalgebra::Matrix4;

use provenance::{Place, Quantity};
use quad_rotor::RotorDynamics;

use super::groups::{FULL_VOLTAGE, HUB_POSITION, INERTIA, TORQUE_GAIN, ZERO_THRUST};
use super::{Airframe, Vehicle, VehicleError};
use crate::ROTORS;

/// Smallest and largest plausible moment of inertia in units of m L². With all mass at the hubs of a '+' it is 1/2 about
/// x and y and 1 about z; the bounds leave a factor of hundreds below (a compact body on long arms) and ten above
/// (propeller guards, payload on booms), and still catch g·m² for kg·m².
const INERTIA_PER_MASS_ARM_SQUARED: (f64, f64) = (1e-3, 10.0);

/// Smallest and largest horizontal distance of a hub from the geometric centre in units of L: equal by definition on a
/// symmetric airframe, a factor of two apart on a stretched one.
const HUB_DISTANCE_PER_ARM: (f64, f64) = (0.5, 2.0);

/// Smallest and largest ratio of torque to thrust, m. Known propellers lie between 3 mm (27 g quadrotor) and 0.1 m.
const TORQUE_PER_THRUST_M: (f64, f64) = (1e-4, 1.0);

/// Largest condition number of the control matrix: 1.4 for '+', 2 for 'X', and 1000 where one motion already needs a
/// thousand times the effort of another.
const LARGEST_CONDITION: f64 = 1e3;

/// Relative tolerance of the unit steady gain of the torque's transfer function: four printed digits.
const UNIT_GAIN_TOLERANCE: f64 = 1e-4;

/// Relative tolerance of the triangle inequality: a flat body meets it with equality, and files print few digits.
const TRIANGLE_TOLERANCE: f64 = 1e-6;

impl Vehicle {
    /// Checks every number against its range and the numbers against each other; `origin` names the vehicle in messages.
    ///
    /// # Errors
    /// All numbers outside their ranges; else the first contradiction between numbers, with its key path, value and range.
    pub fn validate(&self, origin: &str) -> Result<(), VehicleError> {
        let mut faults = Vec::new();
        self.for_each_number(|entry, &number| {
            let place = Place::somewhere(origin);
            let checked = entry.quantity.check(number);
            faults.extend(checked.map_err(VehicleError::range(place, entry.path())).err());
        });
        VehicleError::all(faults)?;
        let check = Checker { origin };
        check.airframe(&self.airframe)?;
        check.rotors(self)?;
        check.pwm_and_linear_rotor(self)?;
        check.optional_groups(self)?;
        check.inverse(&self.control_matrix())?;
        check.hover(self)
    }

    /// Inverse of the control matrix: commands of the four rotors from the pseudo-inputs.
    ///
    /// # Errors
    /// [`VehicleError::SingularControlMatrix`], which a validated vehicle cannot give.
    pub fn control_matrix_inverse(&self) -> Result<Matrix4<f64>, VehicleError> {
        Checker { origin: &self.name }.inverse(&self.control_matrix())
    }
}

struct Checker<'a> {
    origin: &'a str,
}

impl Checker<'_> {
    fn within(
        &self,
        quantity: Quantity,
        value: f64,
        bounds: (f64, f64),
        hint: &'static str,
    ) -> Result<(), VehicleError> {
        self.at(quantity.key, quantity.within(bounds, hint), value)
    }

    fn at(&self, key: &str, quantity: Quantity, value: f64) -> Result<(), VehicleError> {
        let place = Place::somewhere(self.origin);
        quantity
            .check(value)
            .map_err(VehicleError::range(place, key.to_owned()))
    }

    fn airframe(&self, airframe: &Airframe) -> Result<(), VehicleError> {
        let inertia = &airframe.inertia;
        let scale = airframe.mass * airframe.arm_length.powi(2);
        let (least, most) = INERTIA_PER_MASS_ARM_SQUARED;
        let (least, most) = (least * scale, most * scale);
        let hint = "the range is 0.001 to 10 times mass times arm length squared";
        let [xx, yy, zz, xy, xz, yz] = INERTIA;
        for (moment, quantity) in inertia.diagonal().iter().zip([xx, yy, zz]) {
            self.within(quantity, *moment, (least, most), hint)?;
        }
        let products = [
            (inertia.m12, inertia.m21),
            (inertia.m13, inertia.m31),
            (inertia.m23, inertia.m32),
        ];
        for ((upper, lower), quantity) in products.into_iter().zip([xy, xz, yz]) {
            self.within(quantity, upper, (-most, most), "")?;
            if upper != lower {
                return Err(VehicleError::AsymmetricInertia {
                    origin: self.origin.to_owned(),
                    upper,
                    lower,
                });
            }
        }
        self.inertia(airframe)
    }

    /// Principal moments positive, none larger than the sum of the other two.
    fn inertia(&self, airframe: &Airframe) -> Result<(), VehicleError> {
        let mut principal: [f64; 3] = airframe.inertia.symmetric_eigenvalues().into();
        principal.sort_by(f64::total_cmp);
        let [small, middle, large] = principal;
        if small > 0.0 && large <= (small + middle) * (1.0 + TRIANGLE_TOLERANCE) {
            return Ok(());
        }
        Err(VehicleError::UnphysicalInertia {
            origin: self.origin.to_owned(),
            principal,
        })
    }

    fn rotors(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        let arm = vehicle.airframe.arm_length;
        let bounds = (HUB_DISTANCE_PER_ARM.0 * arm, HUB_DISTANCE_PER_ARM.1 * arm);
        let hint = "the horizontal distance of a hub is 0.5 to 2 times `airframe.arm_length_m`";
        for (k, rotor) in vehicle.rotors.iter().enumerate() {
            let key = format!("rotors[{k}].hub_position_m");
            let distance = rotor.hub_position.xy().norm();
            self.at(&key, HUB_POSITION.within(bounds, hint), distance)?;
        }
        Ok(())
    }

    fn pwm_and_linear_rotor(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        let (pwm, rotor) = (&vehicle.pwm, &vehicle.linear_rotor);
        if pwm.minimum >= pwm.maximum {
            return Err(VehicleError::PwmOrder {
                origin: self.origin.to_owned(),
                minimum: pwm.minimum,
                maximum: pwm.maximum,
            });
        }
        let hint = "it lies between `pwm.minimum` and `pwm.maximum`";
        self.within(ZERO_THRUST, pwm.zero_thrust, (pwm.minimum, pwm.maximum), hint)?;
        let bounds = (
            TORQUE_PER_THRUST_M.0 * rotor.thrust_gain,
            TORQUE_PER_THRUST_M.1 * rotor.thrust_gain,
        );
        let hint = "the range is 0.1 mm to 1 m of torque per thrust; is this in N·mm?";
        self.within(TORQUE_GAIN, rotor.torque_gain, bounds, hint)
    }

    fn optional_groups(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        if let Some(group) = &vehicle.rotor_dynamics {
            self.rotor_dynamics(group)?;
        }
        if let Some(group) = &vehicle.battery {
            let bounds = (group.nominal_voltage, FULL_VOLTAGE.maximum);
            let hint = "a full battery is not below its nominal voltage";
            self.within(FULL_VOLTAGE, group.full_voltage, bounds, hint)?;
        }
        Ok(())
    }

    /// Second order with positive coefficients is stable (Routh); the torque's steady gain is one.
    fn rotor_dynamics(&self, group: &RotorDynamics<f64>) -> Result<(), VehicleError> {
        let (numerator, denominator) = (group.torque_c2, group.torque_c4);
        if (numerator - denominator).abs() > UNIT_GAIN_TOLERANCE * denominator {
            return Err(VehicleError::TorqueGainNotUnity {
                origin: self.origin.to_owned(),
                numerator,
                denominator,
            });
        }
        Ok(())
    }

    fn inverse(&self, control_matrix: &Matrix4<f64>) -> Result<Matrix4<f64>, VehicleError> {
        let determinant = control_matrix.determinant();
        let singular_values = control_matrix.singular_values();
        let condition = singular_values.max() / singular_values.min();
        let usable = condition <= LARGEST_CONDITION;
        control_matrix
            .try_inverse()
            .filter(|_| usable)
            .ok_or_else(|| VehicleError::SingularControlMatrix {
                origin: self.origin.to_owned(),
                determinant,
                condition,
                limit: LARGEST_CONDITION,
            })
    }

    fn hover(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        let maximum_thrust_n =
            ROTORS as f64 * vehicle.linear_rotor.thrust_gain * vehicle.zeroed_range().end();
        let weight_n = vehicle.weight();
        if maximum_thrust_n > weight_n {
            return Ok(());
        }
        Err(VehicleError::CannotHover {
            origin: self.origin.to_owned(),
            maximum_thrust_n,
            weight_n,
        })
    }
}
