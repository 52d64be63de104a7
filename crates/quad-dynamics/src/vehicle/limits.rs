//! Key, unit and accepted range of every number of a vehicle.
//!
//! The ranges are not those of a good quadrotor but of any quadrotor: they span a milligram-scale flapping room toy to a
//! passenger drone and are there to catch a slip of units or of sign, not to judge a design.

/// Key, unit and range of one number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quantity {
    /// Full key path.
    pub(super) key: &'static str,
    /// Unit, as messages print it.
    pub(super) unit: &'static str,
    /// Smallest value accepted.
    pub(super) minimum: f64,
    /// Largest value accepted.
    pub(super) maximum: f64,
    /// What may have happened if a value is outside.
    pub(super) hint: &'static str,
}

const fn quantity(
    key: &'static str,
    unit: &'static str,
    minimum: f64,
    maximum: f64,
    hint: &'static str,
) -> Quantity {
    Quantity {
        key,
        unit,
        minimum,
        maximum,
        hint,
    }
}

/// Unit of a number that has none.
const ONE: &str = "(dimensionless)";
/// Bound of numbers whose plausibility follows from others, checked separately.
const ANY: f64 = f64::MAX;

pub(super) const GRAVITY: Quantity = quantity("environment.gravity_m_s2", "m/s²", 0.0, 30.0, "");
pub(super) const AIR_DENSITY: Quantity = quantity(
    "environment.air_density_kg_m3",
    "kg/m³",
    0.01,
    10.0,
    "1.225 at sea level in the standard atmosphere",
);

pub(super) const MASS: Quantity = quantity("airframe.mass_kg", "kg", 1e-3, 1e3, "is this in grams?");
/// The lower and upper bounds of the diagonal follow from m L² (see `validate`).
pub(super) const INERTIA: [Quantity; 3] = [
    quantity("airframe.inertia_xx_kg_m2", "kg·m²", 0.0, ANY, ""),
    quantity("airframe.inertia_yy_kg_m2", "kg·m²", 0.0, ANY, ""),
    quantity("airframe.inertia_zz_kg_m2", "kg·m²", 0.0, ANY, ""),
];
/// Off-diagonal elements xy, xz, yz: any sign, bounded by the triangle inequality of the whole matrix.
pub(super) const INERTIA_PRODUCT: [Quantity; 3] = [
    quantity("airframe.inertia_xy_kg_m2", "kg·m²", -ANY, ANY, ""),
    quantity("airframe.inertia_xz_kg_m2", "kg·m²", -ANY, ANY, ""),
    quantity("airframe.inertia_yz_kg_m2", "kg·m²", -ANY, ANY, ""),
];
pub(super) const ARM_LENGTH: Quantity = quantity(
    "airframe.arm_length_m",
    "m",
    0.01,
    10.0,
    "is this in centimetres or millimetres?",
);
pub(super) const CENTRE_OF_MASS: Quantity = quantity(
    "airframe.centre_of_mass_m",
    "m",
    -10.0,
    10.0,
    "is this in centimetres or millimetres?",
);
pub(super) const HUB_POSITION: Quantity = quantity(
    "rotors.hub_position_m",
    "m",
    -20.0,
    20.0,
    "is this in centimetres or millimetres?",
);

pub(super) const PWM_MINIMUM: Quantity = quantity(
    "pwm.minimum",
    "(duty)",
    0.0,
    1.0,
    "is this in percent or microseconds?",
);
pub(super) const PWM_MAXIMUM: Quantity = quantity(
    "pwm.maximum",
    "(duty)",
    0.0,
    1.0,
    "is this in percent or microseconds?",
);
pub(super) const PWM_ZERO_THRUST: Quantity = quantity("pwm.zero_thrust", "(duty)", 0.0, 1.0, "");

pub(super) const THRUST_GAIN: Quantity = quantity("linear_rotor.thrust_gain_n", "N", 1e-4, 1e7, "");
pub(super) const TORQUE_GAIN: Quantity = quantity("linear_rotor.torque_gain_n_m", "N·m", 1e-8, 1e7, "");
pub(super) const BANDWIDTH: Quantity = quantity(
    "linear_rotor.bandwidth_rad_s",
    "rad/s",
    0.1,
    1e3,
    "is this in hertz, or a time constant?",
);

/// Real parts of poles lie within the range of bandwidths: sums up to twice, products up to the square of its ends.
const POLE_SUM: (f64, f64) = (0.1, 1e5);
const POLE_PRODUCT: (f64, f64) = (1e-2, 1e9);
const STABLE: &str = "both coefficients of a stable denominator are positive";
pub(super) const THRUST_C1: Quantity = quantity(
    "rotor_dynamics.thrust_c1_per_s",
    "1/s",
    POLE_SUM.0,
    POLE_SUM.1,
    STABLE,
);
pub(super) const THRUST_C2: Quantity = quantity(
    "rotor_dynamics.thrust_c2_per_s2",
    "1/s²",
    POLE_PRODUCT.0,
    POLE_PRODUCT.1,
    STABLE,
);
/// The zero of the torque's transfer function may be absent (c_Q1 = 0).
pub(super) const TORQUE_C1: Quantity = quantity("rotor_dynamics.torque_c1_per_s", "1/s", 0.0, 1e6, "");
pub(super) const TORQUE_C2: Quantity = quantity(
    "rotor_dynamics.torque_c2_per_s2",
    "1/s²",
    POLE_PRODUCT.0,
    POLE_PRODUCT.1,
    "",
);
pub(super) const TORQUE_C3: Quantity = quantity(
    "rotor_dynamics.torque_c3_per_s",
    "1/s",
    POLE_SUM.0,
    POLE_SUM.1,
    STABLE,
);
pub(super) const TORQUE_C4: Quantity = quantity(
    "rotor_dynamics.torque_c4_per_s2",
    "1/s²",
    POLE_PRODUCT.0,
    POLE_PRODUCT.1,
    STABLE,
);

/// Terms of a polynomial may have either sign.
pub(super) const POLYNOMIAL_THRUST: [Quantity; 3] = [
    quantity("polynomial_rotor.thrust_k1_n_per_v", "N/V", -1e6, 1e6, ""),
    quantity("polynomial_rotor.thrust_k2_n_per_v2", "N/V²", -1e6, 1e6, ""),
    quantity("polynomial_rotor.thrust_k3_n_per_v3", "N/V³", -1e6, 1e6, ""),
];
/// Terms of a polynomial may have either sign.
pub(super) const POLYNOMIAL_TORQUE: [Quantity; 3] = [
    quantity("polynomial_rotor.torque_k1_n_m_per_v", "N·m/V", -1e6, 1e6, ""),
    quantity("polynomial_rotor.torque_k2_n_m_per_v2", "N·m/V²", -1e6, 1e6, ""),
    quantity("polynomial_rotor.torque_k3_n_m_per_v3", "N·m/V³", -1e6, 1e6, ""),
];

pub(super) const DIAMETER: Quantity = quantity("propeller.diameter_m", "m", 1e-3, 10.0, "is this in inches?");
pub(super) const THRUST_COEFFICIENT: Quantity = quantity("propeller.thrust_coefficient", ONE, 1e-3, 1.0, "");
pub(super) const TORQUE_COEFFICIENT: Quantity = quantity(
    "propeller.torque_coefficient",
    ONE,
    1e-5,
    0.2,
    "C_Q is the power coefficient over 2π",
);

pub(super) const VELOCITY_CONSTANT: Quantity = quantity(
    "motor.velocity_constant_rad_s_v",
    "rad/s/V",
    0.1,
    1e4,
    "is this in rpm per volt?",
);
pub(super) const RESISTANCE: Quantity =
    quantity("motor.resistance_ohm", "Ω", 1e-4, 100.0, "is this in milliohm?");
pub(super) const NO_LOAD_CURRENT: Quantity = quantity(
    "motor.no_load_current_a",
    "A",
    0.0,
    100.0,
    "is this in milliampere?",
);
pub(super) const ROTOR_INERTIA: Quantity = quantity(
    "motor.rotor_inertia_kg_m2",
    "kg·m²",
    1e-12,
    10.0,
    "is this in g·cm² or g·m²?",
);
pub(super) const CONTROLLER_LAG: Quantity = quantity(
    "motor.controller_lag_s",
    "s",
    1e-5,
    1.0,
    "is this in milliseconds?",
);
pub(super) const FULL_VOLTAGE_DUTY: Quantity = quantity(
    "motor.full_voltage_duty",
    "(duty)",
    1e-3,
    1.0,
    "is this in percent?",
);

pub(super) const NOMINAL_VOLTAGE: Quantity = quantity("battery.nominal_voltage_v", "V", 0.5, 1e3, "");
pub(super) const FULL_VOLTAGE: Quantity = quantity("battery.full_voltage_v", "V", 0.5, 1.5e3, "");
pub(super) const INTERNAL_RESISTANCE: Quantity = quantity(
    "battery.internal_resistance_ohm",
    "Ω",
    0.0,
    10.0,
    "is this in milliohm?",
);
pub(super) const CAPACITY: Quantity = quantity("battery.capacity_ah", "A·h", 1e-3, 1e3, "is this in mA·h?");
pub(super) const EXPONENTIAL_AMPLITUDE: Quantity =
    quantity("battery.exponential_amplitude_v", "V", 0.0, 1e3, "");
pub(super) const EXPONENTIAL_RATE: Quantity =
    quantity("battery.exponential_rate_per_ah", "1/(A·h)", 0.0, 1e5, "");

pub(super) const QUADRATIC_DRAG: Quantity = quantity("drag.quadratic_n_s2_m2", "N·s²/m²", 0.0, 1e3, "");
pub(super) const RATE_DAMPING: Quantity = quantity("drag.rate_damping_n_m_s", "N·m·s", 0.0, 1e3, "");

pub(super) const ARM_WIDTH: Quantity = quantity("arms.width_m", "m", 1e-4, 1.0, "is this in millimetres?");
pub(super) const ARM_DRAG_COEFFICIENT: Quantity = quantity("arms.drag_coefficient", "(ratio)", 0.0, 3.0, "");
pub(super) const ARM_DROP: Quantity = quantity("arms.drop_m", "m", 0.0, 1.0, "is this in millimetres?");
