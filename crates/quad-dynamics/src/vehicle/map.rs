//! A vehicle over another scalar, number by number.

use nalgebra::{Matrix3, Scalar, Vector3};

use super::{
    Airframe, ArmParameters, BatteryParameters, DragParameters, Environment, LinearRotorParameters,
    MotorParameters, PolynomialRotorParameters, PropellerParameters, PwmRange, RotorDynamicsParameters,
    RotorMount, Vehicle,
};

impl Vehicle {
    /// The vehicle with every number taken through `f`, always in the same order.
    #[must_use]
    pub fn map<R: Scalar>(&self, mut f: impl FnMut(f64) -> R) -> Vehicle<R> {
        let f: &mut dyn FnMut(f64) -> R = &mut f;
        Vehicle {
            name: self.name.clone(),
            description: self.description.clone(),
            environment: Environment {
                gravity: f(self.environment.gravity),
                air_density: f(self.environment.air_density),
            },
            airframe: airframe(&self.airframe, f),
            rotors: self.rotors.each_ref().map(|mount| RotorMount {
                name: mount.name.clone(),
                position: vector(&mount.position, f),
                spin: mount.spin,
            }),
            pwm: PwmRange {
                minimum: f(self.pwm.minimum),
                maximum: f(self.pwm.maximum),
                zero_thrust: f(self.pwm.zero_thrust),
            },
            linear_rotor: LinearRotorParameters {
                thrust_gain: f(self.linear_rotor.thrust_gain),
                torque_gain: f(self.linear_rotor.torque_gain),
                bandwidth: f(self.linear_rotor.bandwidth),
            },
            rotor_dynamics: self.rotor_dynamics.map(|group| dynamics(&group, f)),
            polynomial_rotor: self.polynomial_rotor.map(|group| PolynomialRotorParameters {
                thrust: group.thrust.map(&mut *f),
                torque: group.torque.map(&mut *f),
            }),
            propeller: self.propeller.map(|group| PropellerParameters {
                diameter: f(group.diameter),
                thrust_coefficient: f(group.thrust_coefficient),
                torque_coefficient: f(group.torque_coefficient),
            }),
            motor: self.motor.map(|group| motor(&group, f)),
            battery: self.battery.map(|group| battery(&group, f)),
            drag: self.drag.map(|group| DragParameters {
                quadratic: vector(&group.quadratic, f),
                rate_damping: vector(&group.rate_damping, f),
            }),
            arms: self.arms.map(|group| ArmParameters {
                width: f(group.width),
                drag_coefficient: f(group.drag_coefficient),
                drop: f(group.drop),
            }),
        }
    }
}

fn vector<R: Scalar>(vector: &Vector3<f64>, f: &mut dyn FnMut(f64) -> R) -> Vector3<R> {
    vector.map(f)
}

fn airframe<R: Scalar>(group: &Airframe, f: &mut dyn FnMut(f64) -> R) -> Airframe<R> {
    let inertia: Matrix3<R> = group.inertia.map(&mut *f);
    Airframe {
        mass: f(group.mass),
        inertia,
        arm_length: f(group.arm_length),
        centre_of_mass: vector(&group.centre_of_mass, f),
    }
}

fn dynamics<R>(group: &RotorDynamicsParameters, f: &mut dyn FnMut(f64) -> R) -> RotorDynamicsParameters<R> {
    RotorDynamicsParameters {
        thrust_c1: f(group.thrust_c1),
        thrust_c2: f(group.thrust_c2),
        torque_c1: f(group.torque_c1),
        torque_c2: f(group.torque_c2),
        torque_c3: f(group.torque_c3),
        torque_c4: f(group.torque_c4),
    }
}

fn motor<R>(group: &MotorParameters, f: &mut dyn FnMut(f64) -> R) -> MotorParameters<R> {
    MotorParameters {
        velocity_constant: f(group.velocity_constant),
        resistance: f(group.resistance),
        no_load_current: f(group.no_load_current),
        rotor_inertia: f(group.rotor_inertia),
        controller_lag: f(group.controller_lag),
        full_voltage_duty: f(group.full_voltage_duty),
    }
}

fn battery<R>(group: &BatteryParameters, f: &mut dyn FnMut(f64) -> R) -> BatteryParameters<R> {
    BatteryParameters {
        nominal_voltage: f(group.nominal_voltage),
        full_voltage: f(group.full_voltage),
        internal_resistance: f(group.internal_resistance),
        capacity: f(group.capacity),
        exponential_amplitude: f(group.exponential_amplitude),
        exponential_rate: f(group.exponential_rate),
    }
}
