//! From the file to the vehicle and back.

use nalgebra::{Matrix3, Vector3};

use super::file::{
    AirframeFile, ArmsFile, BatteryFile, DragFile, EnvironmentFile, LinearRotorFile, MotorFile, Number,
    PolynomialRotorFile, PropellerFile, PwmFile, RotorDynamicsFile, RotorFile, Triple,
};
use super::limits::{self, Quantity};
use super::{
    Airframe, ArmParameters, BatteryParameters, DragParameters, Environment, LinearRotorParameters,
    MotorParameters, PolynomialRotorParameters, PropellerParameters, PwmRange, RotorDynamicsParameters,
    RotorMount, Sourced, Vehicle, VehicleError, VehicleFile,
};

impl Vehicle {
    /// Reads and validates a vehicle from the text of its file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Any [`VehicleError`] but [`VehicleError::MissingGroup`], the first that is found.
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, VehicleError> {
        Self::from_file(&VehicleFile::from_toml_str(text, origin)?, origin)
    }

    /// Takes the numbers out of a file and validates them; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// As [`Vehicle::from_toml_str`], less what concerns the text.
    pub fn from_file(file: &VehicleFile, origin: &str) -> Result<Self, VehicleError> {
        let vehicle = Reader { origin }.vehicle(file)?;
        vehicle.validate(origin)?;
        Ok(vehicle)
    }

    /// The vehicle as a file, every number with the same source: a vehicle does not remember where each came from.
    #[must_use]
    pub fn to_file(&self, source: &str) -> VehicleFile {
        Writer { source }.vehicle(self)
    }

    /// The vehicle as TOML text, every number with the same source (see [`Vehicle::to_file`]).
    #[must_use]
    pub fn to_toml(&self, source: &str) -> String {
        self.to_file(source).to_toml()
    }
}

impl TryFrom<VehicleFile> for Vehicle {
    type Error = VehicleError;

    /// As [`Vehicle::from_file`], with the vehicle's name as origin.
    fn try_from(file: VehicleFile) -> Result<Self, VehicleError> {
        Self::from_file(&file, &file.name)
    }
}

/// Takes values out of a file; checks what the vehicle will no longer show, sources and standard errors.
struct Reader<'a> {
    origin: &'a str,
}

impl Reader<'_> {
    fn vehicle(&self, file: &VehicleFile) -> Result<Vehicle, VehicleError> {
        let airframe = self.airframe(&file.airframe)?;
        Ok(Vehicle {
            name: file.name.clone(),
            description: file.description.clone(),
            environment: Environment {
                gravity: self.number(&file.environment.gravity_m_s2, &limits::GRAVITY)?,
                air_density: self.number(&file.environment.air_density_kg_m3, &limits::AIR_DENSITY)?,
            },
            rotors: self.rotors(&file.rotors, &airframe.centre_of_mass)?,
            airframe,
            pwm: PwmRange {
                minimum: self.number(&file.pwm.minimum, &limits::PWM_MINIMUM)?,
                maximum: self.number(&file.pwm.maximum, &limits::PWM_MAXIMUM)?,
                zero_thrust: self.number(&file.pwm.zero_thrust, &limits::PWM_ZERO_THRUST)?,
            },
            linear_rotor: LinearRotorParameters {
                thrust_gain: self.number(&file.linear_rotor.thrust_gain_n, &limits::THRUST_GAIN)?,
                torque_gain: self.number(&file.linear_rotor.torque_gain_n_m, &limits::TORQUE_GAIN)?,
                bandwidth: self.number(&file.linear_rotor.bandwidth_rad_s, &limits::BANDWIDTH)?,
            },
            rotor_dynamics: file
                .rotor_dynamics
                .as_ref()
                .map(|group| self.rotor_dynamics(group))
                .transpose()?,
            polynomial_rotor: file
                .polynomial_rotor
                .as_ref()
                .map(|group| self.polynomial(group))
                .transpose()?,
            propeller: file
                .propeller
                .as_ref()
                .map(|group| self.propeller(group))
                .transpose()?,
            motor: file.motor.as_ref().map(|group| self.motor(group)).transpose()?,
            battery: file
                .battery
                .as_ref()
                .map(|group| self.battery(group))
                .transpose()?,
            drag: file.drag.as_ref().map(|group| self.drag(group)).transpose()?,
            arms: file.arms.as_ref().map(|group| self.arms(group)).transpose()?,
        })
    }

    fn airframe(&self, file: &AirframeFile) -> Result<Airframe, VehicleError> {
        let [xx, yy, zz] = [
            &file.inertia_xx_kg_m2,
            &file.inertia_yy_kg_m2,
            &file.inertia_zz_kg_m2,
        ];
        let xx = self.number(xx, &limits::INERTIA[0])?;
        let yy = self.number(yy, &limits::INERTIA[1])?;
        let zz = self.number(zz, &limits::INERTIA[2])?;
        let xy = self.optional(&file.inertia_xy_kg_m2, &limits::INERTIA_PRODUCT[0])?;
        let xz = self.optional(&file.inertia_xz_kg_m2, &limits::INERTIA_PRODUCT[1])?;
        let yz = self.optional(&file.inertia_yz_kg_m2, &limits::INERTIA_PRODUCT[2])?;
        Ok(Airframe {
            mass: self.number(&file.mass_kg, &limits::MASS)?,
            inertia: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            arm_length: self.number(&file.arm_length_m, &limits::ARM_LENGTH)?,
            centre_of_mass: self.triple(&file.centre_of_mass_m, &limits::CENTRE_OF_MASS)?,
        })
    }

    fn rotors(
        &self,
        files: &[RotorFile],
        centre_of_mass: &Vector3<f64>,
    ) -> Result<[RotorMount; 4], VehicleError> {
        let mounts = files
            .iter()
            .map(|file| {
                let hub = self.triple(&file.hub_position_m, &limits::HUB_POSITION)?;
                Ok(RotorMount {
                    name: file.name.clone(),
                    position: hub - centre_of_mass,
                    spin: file.spin,
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        let count = mounts.len();
        mounts.try_into().map_err(|_| VehicleError::RotorCount {
            origin: self.origin.to_owned(),
            count,
        })
    }

    fn rotor_dynamics(&self, file: &RotorDynamicsFile) -> Result<RotorDynamicsParameters, VehicleError> {
        Ok(RotorDynamicsParameters {
            thrust_c1: self.number(&file.thrust_c1_per_s, &limits::THRUST_C1)?,
            thrust_c2: self.number(&file.thrust_c2_per_s2, &limits::THRUST_C2)?,
            torque_c1: self.number(&file.torque_c1_per_s, &limits::TORQUE_C1)?,
            torque_c2: self.number(&file.torque_c2_per_s2, &limits::TORQUE_C2)?,
            torque_c3: self.number(&file.torque_c3_per_s, &limits::TORQUE_C3)?,
            torque_c4: self.number(&file.torque_c4_per_s2, &limits::TORQUE_C4)?,
        })
    }

    fn polynomial(&self, file: &PolynomialRotorFile) -> Result<PolynomialRotorParameters, VehicleError> {
        let [thrust, torque] = [&limits::POLYNOMIAL_THRUST, &limits::POLYNOMIAL_TORQUE];
        Ok(PolynomialRotorParameters {
            thrust: [
                self.number(&file.thrust_k1_n_per_v, &thrust[0])?,
                self.number(&file.thrust_k2_n_per_v2, &thrust[1])?,
                self.number(&file.thrust_k3_n_per_v3, &thrust[2])?,
            ],
            torque: [
                self.number(&file.torque_k1_n_m_per_v, &torque[0])?,
                self.number(&file.torque_k2_n_m_per_v2, &torque[1])?,
                self.number(&file.torque_k3_n_m_per_v3, &torque[2])?,
            ],
        })
    }

    fn propeller(&self, file: &PropellerFile) -> Result<PropellerParameters, VehicleError> {
        Ok(PropellerParameters {
            diameter: self.number(&file.diameter_m, &limits::DIAMETER)?,
            thrust_coefficient: self.number(&file.thrust_coefficient, &limits::THRUST_COEFFICIENT)?,
            torque_coefficient: self.number(&file.torque_coefficient, &limits::TORQUE_COEFFICIENT)?,
        })
    }

    fn motor(&self, file: &MotorFile) -> Result<MotorParameters, VehicleError> {
        Ok(MotorParameters {
            velocity_constant: self.number(&file.velocity_constant_rad_s_v, &limits::VELOCITY_CONSTANT)?,
            resistance: self.number(&file.resistance_ohm, &limits::RESISTANCE)?,
            no_load_current: self.number(&file.no_load_current_a, &limits::NO_LOAD_CURRENT)?,
            rotor_inertia: self.number(&file.rotor_inertia_kg_m2, &limits::ROTOR_INERTIA)?,
            controller_lag: self.number(&file.controller_lag_s, &limits::CONTROLLER_LAG)?,
            full_voltage_duty: self.number(&file.full_voltage_duty, &limits::FULL_VOLTAGE_DUTY)?,
        })
    }

    fn battery(&self, file: &BatteryFile) -> Result<BatteryParameters, VehicleError> {
        Ok(BatteryParameters {
            nominal_voltage: self.number(&file.nominal_voltage_v, &limits::NOMINAL_VOLTAGE)?,
            full_voltage: self.number(&file.full_voltage_v, &limits::FULL_VOLTAGE)?,
            internal_resistance: self.number(&file.internal_resistance_ohm, &limits::INTERNAL_RESISTANCE)?,
            capacity: self.number(&file.capacity_ah, &limits::CAPACITY)?,
            exponential_amplitude: self
                .number(&file.exponential_amplitude_v, &limits::EXPONENTIAL_AMPLITUDE)?,
            exponential_rate: self.number(&file.exponential_rate_per_ah, &limits::EXPONENTIAL_RATE)?,
        })
    }

    fn drag(&self, file: &DragFile) -> Result<DragParameters, VehicleError> {
        Ok(DragParameters {
            quadratic: self.triple(&file.quadratic_n_s2_m2, &limits::QUADRATIC_DRAG)?,
            rate_damping: self.triple(&file.rate_damping_n_m_s, &limits::RATE_DAMPING)?,
        })
    }

    fn arms(&self, file: &ArmsFile) -> Result<ArmParameters, VehicleError> {
        Ok(ArmParameters {
            width: self.number(&file.width_m, &limits::ARM_WIDTH)?,
            drag_coefficient: self.number(&file.drag_coefficient, &limits::ARM_DRAG_COEFFICIENT)?,
            drop: self.number(&file.drop_m, &limits::ARM_DROP)?,
        })
    }

    fn optional(&self, number: &Option<Number>, quantity: &Quantity) -> Result<f64, VehicleError> {
        number
            .as_ref()
            .map_or(Ok(0.0), |number| self.number(number, quantity))
    }

    fn number(&self, number: &Number, quantity: &Quantity) -> Result<f64, VehicleError> {
        self.source(&number.source, quantity)?;
        self.standard_errors(number.standard_error.as_slice(), quantity)?;
        Ok(number.value)
    }

    fn triple(&self, triple: &Triple, quantity: &Quantity) -> Result<Vector3<f64>, VehicleError> {
        self.source(&triple.source, quantity)?;
        self.standard_errors(
            triple
                .standard_error
                .as_ref()
                .map_or(&[], |errors| errors.as_slice()),
            quantity,
        )?;
        Ok(Vector3::from(triple.value))
    }

    fn source(&self, source: &str, quantity: &Quantity) -> Result<(), VehicleError> {
        if source.trim().is_empty() {
            return Err(VehicleError::EmptySource {
                origin: self.origin.to_owned(),
                key: quantity.key.to_owned(),
            });
        }
        Ok(())
    }

    fn standard_errors(&self, errors: &[f64], quantity: &Quantity) -> Result<(), VehicleError> {
        let bounds = Quantity {
            minimum: 0.0,
            maximum: f64::MAX,
            hint: "",
            ..*quantity
        };
        errors
            .iter()
            .try_for_each(|&error| bounds.check(error, self.origin, ".standard_error"))
    }
}

/// Puts one source beside every number.
struct Writer<'a> {
    source: &'a str,
}

impl Writer<'_> {
    fn number(&self, value: f64) -> Number {
        Sourced::new(value, self.source)
    }

    fn triple(&self, value: Vector3<f64>) -> Triple {
        Sourced::new(value.into(), self.source)
    }

    fn vehicle(&self, vehicle: &Vehicle) -> VehicleFile {
        let number = |value| self.number(value);
        VehicleFile {
            name: vehicle.name.clone(),
            description: vehicle.description.clone(),
            environment: EnvironmentFile {
                gravity_m_s2: number(vehicle.environment.gravity),
                air_density_kg_m3: number(vehicle.environment.air_density),
            },
            airframe: self.airframe(&vehicle.airframe),
            rotors: vehicle
                .rotors
                .iter()
                .map(|mount| self.rotor(mount, &vehicle.airframe.centre_of_mass))
                .collect(),
            pwm: PwmFile {
                minimum: number(vehicle.pwm.minimum),
                maximum: number(vehicle.pwm.maximum),
                zero_thrust: number(vehicle.pwm.zero_thrust),
            },
            linear_rotor: LinearRotorFile {
                thrust_gain_n: number(vehicle.linear_rotor.thrust_gain),
                torque_gain_n_m: number(vehicle.linear_rotor.torque_gain),
                bandwidth_rad_s: number(vehicle.linear_rotor.bandwidth),
            },
            rotor_dynamics: vehicle.rotor_dynamics.map(|group| self.rotor_dynamics(&group)),
            polynomial_rotor: vehicle.polynomial_rotor.map(|group| self.polynomial(&group)),
            propeller: vehicle.propeller.map(|group| PropellerFile {
                diameter_m: number(group.diameter),
                thrust_coefficient: number(group.thrust_coefficient),
                torque_coefficient: number(group.torque_coefficient),
            }),
            motor: vehicle.motor.map(|group| self.motor(&group)),
            battery: vehicle.battery.map(|group| self.battery(&group)),
            drag: vehicle.drag.map(|group| DragFile {
                quadratic_n_s2_m2: self.triple(group.quadratic),
                rate_damping_n_m_s: self.triple(group.rate_damping),
            }),
            arms: vehicle.arms.map(|group| ArmsFile {
                width_m: number(group.width),
                drag_coefficient: number(group.drag_coefficient),
                drop_m: number(group.drop),
            }),
        }
    }

    fn airframe(&self, airframe: &Airframe) -> AirframeFile {
        let inertia = &airframe.inertia;
        let product = |value: f64| (value != 0.0).then(|| self.number(value));
        AirframeFile {
            mass_kg: self.number(airframe.mass),
            inertia_xx_kg_m2: self.number(inertia.m11),
            inertia_yy_kg_m2: self.number(inertia.m22),
            inertia_zz_kg_m2: self.number(inertia.m33),
            inertia_xy_kg_m2: product(inertia.m12),
            inertia_xz_kg_m2: product(inertia.m13),
            inertia_yz_kg_m2: product(inertia.m23),
            arm_length_m: self.number(airframe.arm_length),
            centre_of_mass_m: self.triple(airframe.centre_of_mass),
        }
    }

    fn rotor(&self, mount: &RotorMount, centre_of_mass: &Vector3<f64>) -> RotorFile {
        RotorFile {
            name: mount.name.clone(),
            hub_position_m: self.triple(mount.position + centre_of_mass),
            spin: mount.spin,
        }
    }

    fn rotor_dynamics(&self, group: &RotorDynamicsParameters) -> RotorDynamicsFile {
        RotorDynamicsFile {
            thrust_c1_per_s: self.number(group.thrust_c1),
            thrust_c2_per_s2: self.number(group.thrust_c2),
            torque_c1_per_s: self.number(group.torque_c1),
            torque_c2_per_s2: self.number(group.torque_c2),
            torque_c3_per_s: self.number(group.torque_c3),
            torque_c4_per_s2: self.number(group.torque_c4),
        }
    }

    fn polynomial(&self, group: &PolynomialRotorParameters) -> PolynomialRotorFile {
        let [thrust, torque] = [group.thrust, group.torque].map(|terms| terms.map(|term| self.number(term)));
        let ([thrust_k1, thrust_k2, thrust_k3], [torque_k1, torque_k2, torque_k3]) = (thrust, torque);
        PolynomialRotorFile {
            thrust_k1_n_per_v: thrust_k1,
            thrust_k2_n_per_v2: thrust_k2,
            thrust_k3_n_per_v3: thrust_k3,
            torque_k1_n_m_per_v: torque_k1,
            torque_k2_n_m_per_v2: torque_k2,
            torque_k3_n_m_per_v3: torque_k3,
        }
    }

    fn motor(&self, group: &MotorParameters) -> MotorFile {
        MotorFile {
            velocity_constant_rad_s_v: self.number(group.velocity_constant),
            resistance_ohm: self.number(group.resistance),
            no_load_current_a: self.number(group.no_load_current),
            rotor_inertia_kg_m2: self.number(group.rotor_inertia),
            controller_lag_s: self.number(group.controller_lag),
            full_voltage_duty: self.number(group.full_voltage_duty),
        }
    }

    fn battery(&self, group: &BatteryParameters) -> BatteryFile {
        BatteryFile {
            nominal_voltage_v: self.number(group.nominal_voltage),
            full_voltage_v: self.number(group.full_voltage),
            internal_resistance_ohm: self.number(group.internal_resistance),
            capacity_ah: self.number(group.capacity),
            exponential_amplitude_v: self.number(group.exponential_amplitude),
            exponential_rate_per_ah: self.number(group.exponential_rate),
        }
    }
}
