//! The numbers of a vehicle: for each its field, key, unit and accepted range, once.
//!
//! The ranges are not those of a good quadrotor but of any quadrotor: they span a milligram-scale flapping room toy to a passenger
//! drone and are there to catch a slip of units or of sign, not to judge a design. What numbers must be to each other is checked
//! by [`Vehicle::validate`].

use nalgebra::{Matrix3, Scalar, Vector3};
use provenance::Quantity;
use quad_rotor::{Cubic, Motor, RotorDynamics};

use super::{
    Airframe, ArmParameters, BatteryParameters, Environment, LinearRotorParameters,
    PolynomialRotorParameters, PropellerParameters, PwmRange, RotorMount, Vehicle,
};
use crate::Drag;

/// A number of a vehicle: what it is, and of which rotor and axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Key, unit and accepted range.
    pub quantity: &'static Quantity,
    /// Index of the rotor, from 0, where each rotor has one.
    pub rotor: Option<usize>,
    /// Body axis 0 forward, 1 right, 2 down, where each axis has one.
    pub axis: Option<usize>,
}

impl Entry {
    /// Its group, and its key there.
    #[must_use]
    pub fn group_and_name(&self) -> (&'static str, &'static str) {
        self.quantity
            .key
            .split_once('.')
            .unwrap_or(("", self.quantity.key))
    }

    /// Path of its key in the file, vectors without their axis: `airframe.mass_kg`, `rotors[1].hub_position_m`.
    #[must_use]
    pub fn key(&self) -> String {
        match self.rotor {
            Some(k) => {
                let (list, name) = self.group_and_name();
                format!("{list}[{k}].{name}")
            }
            None => self.quantity.key.to_owned(),
        }
    }

    /// Path of its key in messages: `drag.quadratic_n_s2_m2[1]`.
    #[must_use]
    pub fn path(&self) -> String {
        match self.axis {
            Some(axis) => format!("{}[{axis}]", self.key()),
            None => self.key(),
        }
    }
}

/// Unit of a number that has none.
const ONE: &str = "(dimensionless)";
/// Bound of numbers whose plausibility follows from others.
const ANY: f64 = f64::MAX;
const LENGTH: &str = "is this in centimetres or millimetres?";
const DUTY: &str = "is this in percent or microseconds?";
const STABLE: &str = "both coefficients of a stable denominator are positive";
/// Real parts of poles lie within the range of bandwidths: sums up to twice, products up to the square of its ends.
const POLE_SUM: (f64, f64) = (0.1, 1e5);
const POLE_PRODUCT: (f64, f64) = (1e-2, 1e9);

// Numbers that are also held against others.
/// Off-diagonal elements xy, xz, yz may have any sign; their bounds follow from those of the diagonal.
pub(super) static INERTIA: [Quantity; 6] = [
    Quantity::new("airframe.inertia_xx_kg_m2", "kg·m²", 0.0, ANY, ""),
    Quantity::new("airframe.inertia_yy_kg_m2", "kg·m²", 0.0, ANY, ""),
    Quantity::new("airframe.inertia_zz_kg_m2", "kg·m²", 0.0, ANY, ""),
    Quantity::new("airframe.inertia_xy_kg_m2", "kg·m²", -ANY, ANY, "").or_zero(),
    Quantity::new("airframe.inertia_xz_kg_m2", "kg·m²", -ANY, ANY, "").or_zero(),
    Quantity::new("airframe.inertia_yz_kg_m2", "kg·m²", -ANY, ANY, "").or_zero(),
];
pub(super) static HUB_POSITION: Quantity = Quantity::new("rotors.hub_position_m", "m", -20.0, 20.0, LENGTH);
pub(super) static ZERO_THRUST: Quantity = Quantity::new("pwm.zero_thrust", "(duty)", 0.0, 1.0, "");
pub(super) static TORQUE_GAIN: Quantity = Quantity::new("linear_rotor.torque_gain_n_m", "N·m", 1e-8, 1e7, "");
pub(super) static FULL_VOLTAGE: Quantity = Quantity::new("battery.full_voltage_v", "V", 0.5, 1.5e3, "");

/// Visits the numbers of one rotor, or those that are the whole vehicle's.
struct Visitor<'a, N, M> {
    visit: &'a mut dyn FnMut(&Entry, &N) -> M,
    rotor: Option<usize>,
}

impl<N, M: Scalar> Visitor<'_, N, M> {
    fn at(&mut self, quantity: &'static Quantity, axis: Option<usize>, number: &N) -> M {
        let rotor = self.rotor;
        let entry = Entry {
            quantity,
            rotor,
            axis,
        };
        (self.visit)(&entry, number)
    }

    fn number(&mut self, quantity: &'static Quantity, number: &N) -> M {
        self.at(quantity, None, number)
    }

    fn vector(&mut self, quantity: &'static Quantity, v: &Vector3<N>) -> Vector3<M> {
        let mut axis = |k: usize| self.at(quantity, Some(k), &v[k]);
        Vector3::new(axis(0), axis(1), axis(2))
    }

    fn cubic(&mut self, terms: &'static [Quantity; 3], cubic: &Cubic<N>) -> Cubic<M> {
        Cubic {
            k1: self.number(&terms[0], &cubic.k1),
            k2: self.number(&terms[1], &cubic.k2),
            k3: self.number(&terms[2], &cubic.k3),
        }
    }

    /// What stands above the diagonal stands below it, too.
    fn inertia(&mut self, m: &Matrix3<N>) -> Matrix3<M> {
        let elements = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|k| self.number(&INERTIA[k], &m[elements[k]]));
        Matrix3::new(xx, xy.clone(), xz.clone(), xy, yy, yz.clone(), xz, yz, zz)
    }
}

/// A quantity that lives as long as the program.
macro_rules! q {
    ($($part:expr),+ $(,)?) => {
        const { &Quantity::new($($part),+) }
    };
}

impl<N> Vehicle<N> {
    /// The vehicle with every number taken through `visit`, always in the same order.
    #[must_use]
    #[rustfmt::skip]
    pub fn map_numbers<M: Scalar>(&self, mut visit: impl FnMut(&Entry, &N) -> M) -> Vehicle<M> {
        let mut visitor = Visitor { visit: &mut visit, rotor: None };
        let f = &mut visitor;
        Vehicle {
            name: self.name.clone(),
            description: self.description.clone(),
            environment: environment(&self.environment, f),
            airframe: airframe(&self.airframe, f),
            rotors: std::array::from_fn(|k| mount(&self.rotors[k], k, f)),
            pwm: pwm(&self.pwm, f),
            linear_rotor: linear_rotor(&self.linear_rotor, f),
            rotor_dynamics: self.rotor_dynamics.as_ref().map(|group| rotor_dynamics(group, f)),
            polynomial_rotor: self.polynomial_rotor.as_ref().map(|group| polynomial_rotor(group, f)),
            propeller: self.propeller.as_ref().map(|group| propeller(group, f)),
            motor: self.motor.as_ref().map(|group| motor(group, f)),
            battery: self.battery.as_ref().map(|group| battery(group, f)),
            drag: self.drag.as_ref().map(|group| drag(group, f)),
            arms: self.arms.as_ref().map(|group| arms(group, f)),
        }
    }

    /// Shows every number to `visit`.
    pub fn for_each_number(&self, mut visit: impl FnMut(&Entry, &N)) {
        let _ = self.map_numbers(|entry, number| visit(entry, number));
    }
}

impl<N: Scalar> Vehicle<N> {
    /// Lets `visit` change every number; what is said of an element of the inertia matrix holds for its mirror image, too.
    pub fn for_each_number_mut(&mut self, mut visit: impl FnMut(&Entry, &mut N)) {
        *self = self.map_numbers(|entry, number| {
            let mut number = number.clone();
            visit(entry, &mut number);
            number
        });
    }
}

impl Vehicle {
    /// The vehicle over another scalar: every number taken through `f`, always in the same order.
    #[must_use]
    pub fn map<R: Scalar>(&self, mut f: impl FnMut(f64) -> R) -> Vehicle<R> {
        self.map_numbers(|_, &number| f(number))
    }
}

fn environment<N, M: Scalar>(group: &Environment<N>, f: &mut Visitor<'_, N, M>) -> Environment<M> {
    const SEA_LEVEL: &str = "1.225 at sea level in the standard atmosphere";
    Environment {
        gravity: f.number(
            q!("environment.gravity_m_s2", "m/s²", 0.0, 30.0, ""),
            &group.gravity,
        ),
        air_density: f.number(
            q!("environment.air_density_kg_m3", "kg/m³", 0.01, 10.0, SEA_LEVEL),
            &group.air_density,
        ),
    }
}

#[rustfmt::skip]
fn airframe<N, M: Scalar>(group: &Airframe<N>, f: &mut Visitor<'_, N, M>) -> Airframe<M> {
    Airframe {
        mass: f.number(q!("airframe.mass_kg", "kg", 1e-3, 1e3, "is this in grams?"), &group.mass),
        inertia: f.inertia(&group.inertia),
        arm_length: f.number(q!("airframe.arm_length_m", "m", 0.01, 10.0, LENGTH), &group.arm_length),
        centre_of_mass: f.vector(q!("airframe.centre_of_mass_m", "m", -10.0, 10.0, LENGTH), &group.centre_of_mass),
    }
}

fn mount<N, M: Scalar>(group: &RotorMount<N>, k: usize, f: &mut Visitor<'_, N, M>) -> RotorMount<M> {
    f.rotor = Some(k);
    let hub_position = f.vector(&HUB_POSITION, &group.hub_position);
    f.rotor = None;
    RotorMount {
        name: group.name.clone(),
        hub_position,
        spin: group.spin,
    }
}

fn pwm<N, M: Scalar>(group: &PwmRange<N>, f: &mut Visitor<'_, N, M>) -> PwmRange<M> {
    PwmRange {
        minimum: f.number(q!("pwm.minimum", "(duty)", 0.0, 1.0, DUTY), &group.minimum),
        maximum: f.number(q!("pwm.maximum", "(duty)", 0.0, 1.0, DUTY), &group.maximum),
        zero_thrust: f.number(&ZERO_THRUST, &group.zero_thrust),
    }
}

#[rustfmt::skip]
fn linear_rotor<N, M: Scalar>(group: &LinearRotorParameters<N>, f: &mut Visitor<'_, N, M>) -> LinearRotorParameters<M> {
    const HERTZ: &str = "is this in hertz, or a time constant?";
    LinearRotorParameters {
        thrust_gain: f.number(q!("linear_rotor.thrust_gain_n", "N", 1e-4, 1e7, ""), &group.thrust_gain),
        torque_gain: f.number(&TORQUE_GAIN, &group.torque_gain),
        bandwidth: f.number(q!("linear_rotor.bandwidth_rad_s", "rad/s", 0.1, 1e3, HERTZ), &group.bandwidth),
    }
}

/// The zero of the torque's transfer function may be absent (c_Q1 = 0).
#[rustfmt::skip]
fn rotor_dynamics<N, M: Scalar>(group: &RotorDynamics<N>, f: &mut Visitor<'_, N, M>) -> RotorDynamics<M> {
    const S: (f64, f64) = POLE_SUM;
    const P: (f64, f64) = POLE_PRODUCT;
    RotorDynamics {
        thrust_c1: f.number(q!("rotor_dynamics.thrust_c1_per_s", "1/s", S.0, S.1, STABLE), &group.thrust_c1),
        thrust_c2: f.number(q!("rotor_dynamics.thrust_c2_per_s2", "1/s²", P.0, P.1, STABLE), &group.thrust_c2),
        torque_c1: f.number(q!("rotor_dynamics.torque_c1_per_s", "1/s", 0.0, 1e6, ""), &group.torque_c1),
        torque_c2: f.number(q!("rotor_dynamics.torque_c2_per_s2", "1/s²", P.0, P.1, ""), &group.torque_c2),
        torque_c3: f.number(q!("rotor_dynamics.torque_c3_per_s", "1/s", S.0, S.1, STABLE), &group.torque_c3),
        torque_c4: f.number(q!("rotor_dynamics.torque_c4_per_s2", "1/s²", P.0, P.1, STABLE), &group.torque_c4),
    }
}

/// Terms of a polynomial may have either sign.
#[rustfmt::skip]
fn polynomial_rotor<N, M: Scalar>(
    group: &PolynomialRotorParameters<N>,
    f: &mut Visitor<'_, N, M>,
) -> PolynomialRotorParameters<M> {
    const THRUST: [Quantity; 3] = [
        Quantity::new("polynomial_rotor.thrust_k1_n_per_v", "N/V", -1e6, 1e6, ""),
        Quantity::new("polynomial_rotor.thrust_k2_n_per_v2", "N/V²", -1e6, 1e6, ""),
        Quantity::new("polynomial_rotor.thrust_k3_n_per_v3", "N/V³", -1e6, 1e6, ""),
    ];
    const TORQUE: [Quantity; 3] = [
        Quantity::new("polynomial_rotor.torque_k1_n_m_per_v", "N·m/V", -1e6, 1e6, ""),
        Quantity::new("polynomial_rotor.torque_k2_n_m_per_v2", "N·m/V²", -1e6, 1e6, ""),
        Quantity::new("polynomial_rotor.torque_k3_n_m_per_v3", "N·m/V³", -1e6, 1e6, ""),
    ];
    PolynomialRotorParameters {
        thrust: f.cubic(&THRUST, &group.thrust),
        torque: f.cubic(&TORQUE, &group.torque),
    }
}

#[rustfmt::skip]
fn propeller<N, M: Scalar>(group: &PropellerParameters<N>, f: &mut Visitor<'_, N, M>) -> PropellerParameters<M> {
    const C_Q: &str = "C_Q is the power coefficient over 2π";
    PropellerParameters {
        diameter: f.number(q!("propeller.diameter_m", "m", 1e-3, 10.0, "is this in inches?"), &group.diameter),
        thrust_coefficient: f.number(q!("propeller.thrust_coefficient", ONE, 1e-3, 1.0, ""), &group.thrust_coefficient),
        torque_coefficient: f.number(q!("propeller.torque_coefficient", ONE, 1e-5, 0.2, C_Q), &group.torque_coefficient),
    }
}

#[rustfmt::skip]
fn motor<N, M: Scalar>(group: &Motor<N>, f: &mut Visitor<'_, N, M>) -> Motor<M> {
    const RPM: &str = "is this in rpm per volt?";
    const MILLIAMPERE: &str = "is this in milliampere?";
    const GRAM: &str = "is this in g·cm² or g·m²?";
    const MILLISECONDS: &str = "is this in milliseconds?";
    Motor {
        velocity_constant: f.number(q!("motor.velocity_constant_rad_s_v", "rad/s/V", 0.1, 1e4, RPM), &group.velocity_constant),
        resistance: f.number(q!("motor.resistance_ohm", "Ω", 1e-4, 100.0, "is this in milliohm?"), &group.resistance),
        no_load_current: f.number(q!("motor.no_load_current_a", "A", 0.0, 100.0, MILLIAMPERE), &group.no_load_current),
        rotor_inertia: f.number(q!("motor.rotor_inertia_kg_m2", "kg·m²", 1e-12, 10.0, GRAM), &group.rotor_inertia),
        controller_lag: f.number(q!("motor.controller_lag_s", "s", 1e-5, 1.0, MILLISECONDS), &group.controller_lag),
        full_voltage_duty: f.number(q!("motor.full_voltage_duty", "(duty)", 1e-3, 1.0, "is this in percent?"), &group.full_voltage_duty),
    }
}

#[rustfmt::skip]
fn battery<N, M: Scalar>(group: &BatteryParameters<N>, f: &mut Visitor<'_, N, M>) -> BatteryParameters<M> {
    const MILLIOHM: &str = "is this in milliohm?";
    BatteryParameters {
        nominal_voltage: f.number(q!("battery.nominal_voltage_v", "V", 0.5, 1e3, ""), &group.nominal_voltage),
        full_voltage: f.number(&FULL_VOLTAGE, &group.full_voltage),
        internal_resistance: f.number(q!("battery.internal_resistance_ohm", "Ω", 0.0, 10.0, MILLIOHM), &group.internal_resistance),
        capacity: f.number(q!("battery.capacity_ah", "A·h", 1e-3, 1e3, "is this in mA·h?"), &group.capacity),
        exponential_amplitude: f.number(q!("battery.exponential_amplitude_v", "V", 0.0, 1e3, ""), &group.exponential_amplitude),
        exponential_rate: f.number(q!("battery.exponential_rate_per_ah", "1/(A·h)", 0.0, 1e5, ""), &group.exponential_rate),
    }
}

#[rustfmt::skip]
fn drag<N, M: Scalar>(group: &Drag<N>, f: &mut Visitor<'_, N, M>) -> Drag<M> {
    Drag {
        quadratic: f.vector(q!("drag.quadratic_n_s2_m2", "N·s²/m²", 0.0, 1e3, ""), &group.quadratic),
        rate_damping: f.vector(q!("drag.rate_damping_n_m_s", "N·m·s", 0.0, 1e3, ""), &group.rate_damping),
    }
}

#[rustfmt::skip]
fn arms<N, M: Scalar>(group: &ArmParameters<N>, f: &mut Visitor<'_, N, M>) -> ArmParameters<M> {
    const MILLIMETRES: &str = "is this in millimetres?";
    ArmParameters {
        width: f.number(q!("arms.width_m", "m", 1e-4, 1.0, MILLIMETRES), &group.width),
        drag_coefficient: f.number(q!("arms.drag_coefficient", "(ratio)", 0.0, 3.0, ""), &group.drag_coefficient),
        drop: f.number(q!("arms.drop_m", "m", 0.0, 1.0, MILLIMETRES), &group.drop),
    }
}
