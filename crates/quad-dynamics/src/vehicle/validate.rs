//! Is this a quadrotor? Every number against its range, then the numbers against each other.

use nalgebra::{Matrix4, Vector3};

use super::limits::{self, Quantity};
use super::{Airframe, RotorDynamicsParameters, Vehicle, VehicleError};

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

/// Number of rotors, as a factor.
const ROTORS: f64 = 4.0;

impl Quantity {
    /// The value is finite and in range; `suffix` completes the key path.
    pub(super) fn check(&self, value: f64, origin: &str, suffix: &str) -> Result<(), VehicleError> {
        let (origin, key) = (origin.to_owned(), format!("{}{suffix}", self.key));
        if !value.is_finite() {
            return Err(VehicleError::NotFinite {
                origin,
                key,
                value,
                unit: self.unit,
            });
        }
        if value < self.minimum || value > self.maximum {
            let Self {
                unit,
                minimum,
                maximum,
                hint,
                ..
            } = *self;
            return Err(VehicleError::OutOfRange {
                origin,
                key,
                value,
                minimum,
                maximum,
                unit,
                hint,
            });
        }
        Ok(())
    }

    /// The same quantity within other bounds.
    fn within(&self, (minimum, maximum): (f64, f64), hint: &'static str) -> Self {
        Self {
            minimum,
            maximum,
            hint,
            ..*self
        }
    }
}

impl Vehicle {
    /// Checks every number against its range and the numbers against each other; `origin` names the vehicle in messages.
    ///
    /// # Errors
    /// The first mistake found, with its key path, value and range.
    pub fn validate(&self, origin: &str) -> Result<(), VehicleError> {
        let check = Checker { origin };
        check.environment_and_airframe(self)?;
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
    fn all(&self, checks: &[(f64, Quantity)]) -> Result<(), VehicleError> {
        checks
            .iter()
            .try_for_each(|(value, quantity)| quantity.check(*value, self.origin, ""))
    }

    fn vector(&self, vector: &Vector3<f64>, quantity: &Quantity) -> Result<(), VehicleError> {
        let indexed = vector.iter().enumerate();
        indexed
            .into_iter()
            .try_for_each(|(i, &value)| quantity.check(value, self.origin, &format!("[{i}]")))
    }

    fn environment_and_airframe(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        let Airframe {
            mass,
            inertia,
            arm_length,
            centre_of_mass,
        } = &vehicle.airframe;
        self.all(&[
            (vehicle.environment.gravity, limits::GRAVITY),
            (vehicle.environment.air_density, limits::AIR_DENSITY),
            (*mass, limits::MASS),
            (*arm_length, limits::ARM_LENGTH),
        ])?;
        self.vector(centre_of_mass, &limits::CENTRE_OF_MASS)?;
        let scale = mass * arm_length.powi(2);
        let bounds = (
            INERTIA_PER_MASS_ARM_SQUARED.0 * scale,
            INERTIA_PER_MASS_ARM_SQUARED.1 * scale,
        );
        for (moment, quantity) in inertia.diagonal().iter().zip(&limits::INERTIA) {
            let plausible = quantity.within(
                bounds,
                "the range is 0.001 to 10 times mass times arm length squared",
            );
            plausible.check(*moment, self.origin, "")?;
        }
        let products = [
            (inertia.m12, inertia.m21),
            (inertia.m13, inertia.m31),
            (inertia.m23, inertia.m32),
        ];
        for ((upper, lower), quantity) in products.into_iter().zip(&limits::INERTIA_PRODUCT) {
            quantity
                .within((-bounds.1, bounds.1), "")
                .check(upper, self.origin, "")?;
            if upper != lower {
                return Err(VehicleError::AsymmetricInertia {
                    origin: self.origin.to_owned(),
                    upper,
                    lower,
                });
            }
        }
        self.inertia(&vehicle.airframe)
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
        for (i, rotor) in vehicle.rotors.iter().enumerate() {
            let hub = rotor.position + vehicle.airframe.centre_of_mass;
            let key = |suffix: &str| format!("rotors[{i}].hub_position_m{suffix}");
            for (axis, &coordinate) in hub.iter().enumerate() {
                limits::HUB_POSITION
                    .check(coordinate, self.origin, "")
                    .map_err(|error| with_key(error, key(&format!("[{axis}]"))))?;
            }
            let hint = "the horizontal distance of a hub is 0.5 to 2 times `airframe.arm_length_m`";
            limits::HUB_POSITION
                .within(bounds, hint)
                .check(hub.xy().norm(), self.origin, "")
                .map_err(|error| with_key(error, key("")))?;
        }
        Ok(())
    }

    fn pwm_and_linear_rotor(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        let (pwm, rotor) = (&vehicle.pwm, &vehicle.linear_rotor);
        self.all(&[
            (pwm.minimum, limits::PWM_MINIMUM),
            (pwm.maximum, limits::PWM_MAXIMUM),
        ])?;
        if pwm.minimum >= pwm.maximum {
            return Err(VehicleError::PwmOrder {
                origin: self.origin.to_owned(),
                minimum: pwm.minimum,
                maximum: pwm.maximum,
            });
        }
        let inside = limits::PWM_ZERO_THRUST.within(
            (pwm.minimum, pwm.maximum),
            "it lies between `pwm.minimum` and `pwm.maximum`",
        );
        self.all(&[
            (pwm.zero_thrust, inside),
            (rotor.thrust_gain, limits::THRUST_GAIN),
            (rotor.torque_gain, limits::TORQUE_GAIN),
            (rotor.bandwidth, limits::BANDWIDTH),
        ])?;
        let bounds = (
            TORQUE_PER_THRUST_M.0 * rotor.thrust_gain,
            TORQUE_PER_THRUST_M.1 * rotor.thrust_gain,
        );
        let hint = "the range is 0.1 mm to 1 m of torque per thrust; is this in N·mm?";
        self.all(&[(rotor.torque_gain, limits::TORQUE_GAIN.within(bounds, hint))])
    }

    fn optional_groups(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        if let Some(group) = &vehicle.rotor_dynamics {
            self.rotor_dynamics(group)?;
        }
        if let Some(group) = &vehicle.polynomial_rotor {
            for (terms, quantities) in [
                (group.thrust, limits::POLYNOMIAL_THRUST),
                (group.torque, limits::POLYNOMIAL_TORQUE),
            ] {
                terms
                    .iter()
                    .zip(quantities)
                    .try_for_each(|(&k, limit)| limit.check(k, self.origin, ""))?;
            }
        }
        if let Some(group) = &vehicle.propeller {
            self.all(&[
                (group.diameter, limits::DIAMETER),
                (group.thrust_coefficient, limits::THRUST_COEFFICIENT),
                (group.torque_coefficient, limits::TORQUE_COEFFICIENT),
            ])?;
        }
        self.motor_and_battery(vehicle)?;
        if let Some(group) = &vehicle.drag {
            self.vector(&group.quadratic, &limits::QUADRATIC_DRAG)?;
            self.vector(&group.rate_damping, &limits::RATE_DAMPING)?;
        }
        if let Some(group) = &vehicle.arms {
            self.all(&[
                (group.width, limits::ARM_WIDTH),
                (group.drag_coefficient, limits::ARM_DRAG_COEFFICIENT),
                (group.drop, limits::ARM_DROP),
            ])?;
        }
        Ok(())
    }

    fn motor_and_battery(&self, vehicle: &Vehicle) -> Result<(), VehicleError> {
        if let Some(group) = &vehicle.motor {
            self.all(&[
                (group.velocity_constant, limits::VELOCITY_CONSTANT),
                (group.resistance, limits::RESISTANCE),
                (group.no_load_current, limits::NO_LOAD_CURRENT),
                (group.rotor_inertia, limits::ROTOR_INERTIA),
                (group.controller_lag, limits::CONTROLLER_LAG),
                (group.full_voltage_duty, limits::FULL_VOLTAGE_DUTY),
            ])?;
        }
        if let Some(group) = &vehicle.battery {
            self.all(&[(group.nominal_voltage, limits::NOMINAL_VOLTAGE)])?;
            let above_nominal = limits::FULL_VOLTAGE.within(
                (group.nominal_voltage, limits::FULL_VOLTAGE.maximum),
                "a full battery is not below its nominal voltage",
            );
            self.all(&[
                (group.full_voltage, above_nominal),
                (group.internal_resistance, limits::INTERNAL_RESISTANCE),
                (group.capacity, limits::CAPACITY),
                (group.exponential_amplitude, limits::EXPONENTIAL_AMPLITUDE),
                (group.exponential_rate, limits::EXPONENTIAL_RATE),
            ])?;
        }
        Ok(())
    }

    /// Second order with positive coefficients is stable (Routh); the torque's steady gain is one.
    fn rotor_dynamics(&self, group: &RotorDynamicsParameters) -> Result<(), VehicleError> {
        self.all(&[
            (group.thrust_c1, limits::THRUST_C1),
            (group.thrust_c2, limits::THRUST_C2),
            (group.torque_c1, limits::TORQUE_C1),
            (group.torque_c2, limits::TORQUE_C2),
            (group.torque_c3, limits::TORQUE_C3),
            (group.torque_c4, limits::TORQUE_C4),
        ])?;
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
        let maximum_thrust_n = ROTORS * vehicle.linear_rotor.thrust_gain * vehicle.zeroed_range().end();
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

/// The same error under another key path: entries of a list carry their index.
fn with_key(error: VehicleError, key: String) -> VehicleError {
    match error {
        VehicleError::NotFinite {
            origin, value, unit, ..
        } => VehicleError::NotFinite {
            origin,
            key,
            value,
            unit,
        },
        VehicleError::OutOfRange {
            origin,
            value,
            minimum,
            maximum,
            unit,
            hint,
            ..
        } => VehicleError::OutOfRange {
            origin,
            key,
            value,
            minimum,
            maximum,
            unit,
            hint,
        },
        other => other,
    }
}
