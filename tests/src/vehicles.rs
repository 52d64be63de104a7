//! Random vehicles: any mass from a toy to a carrier, any layout, all groups present and consistent.
//!
//! Sizes follow from the mass and a few dimensionless factors, so that every draw is a vehicle that
//! could fly. Each passes `Vehicle::validate`.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use quad_dynamics::vehicle::{
    Airframe, ArmParameters, BatteryParameters, Environment, LinearRotorParameters,
    PolynomialRotorParameters, PropellerParameters, PwmRange, RotorMount, Spin,
};
use quad_dynamics::{Drag, Vehicle};
use quad_kinematics::Quaternion;
use quad_rotor::{Cubic, Motor, RotorDynamics};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

const GRAVITY: f64 = 9.81;
const AIR_DENSITY: f64 = 1.225;

/// The vehicle that the others are scaled from, with the cube root of the mass: mass, kg, arm, m, and
/// battery voltage, V, of the Qball-X4.
const REFERENCE_MASS: f64 = 1.4;
const REFERENCE_ARM: f64 = 0.2;
const REFERENCE_VOLTAGE: f64 = 11.1;

/// Angles of the hubs from the nose, clockwise seen from above, and spins, for '+' and 'x'.
const PLUS: [(f64, Spin); 4] = [
    (PI, Spin::Clockwise),
    (0.0, Spin::Clockwise),
    (-FRAC_PI_2, Spin::CounterClockwise),
    (FRAC_PI_2, Spin::CounterClockwise),
];
const CROSS: [(f64, Spin); 4] = [
    (FRAC_PI_4, Spin::CounterClockwise),
    (PI - FRAC_PI_4, Spin::Clockwise),
    (-PI + FRAC_PI_4, Spin::CounterClockwise),
    (-FRAC_PI_4, Spin::Clockwise),
];

/// A number between two positive ones, evenly in its logarithm.
fn log_uniform(range: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    (range.start.ln()..range.end.ln()).prop_map(f64::exp)
}

/// Inertia over `m L²`: second moments of a mass distribution along three random axes, so that it is
/// positive definite and meets the triangle inequality by construction.
fn inertia_shape() -> impl Strategy<Value = Matrix3<f64>> {
    let moment = || 0.02..0.2_f64;
    let tilt = [-0.5..0.5_f64, -0.5..0.5, -0.5..0.5];
    ([moment(), moment(), moment()], tilt).prop_map(|([a, b, c], tilt)| {
        let r = Quaternion {
            w: 1.0,
            v: tilt.into(),
        }
        .normalised()
        .rotation()
        .matrix;
        let principal = Matrix3::from_diagonal(&Vector3::new(b + c, a + c, a + b));
        let full = r * principal * r.transpose();
        // Rounding leaves it an ulp from symmetric; the vehicle wants it exactly so.
        (full + full.transpose()) * 0.5
    })
}

/// Hubs over the arm length in the geometric frame, and spins: '+', 'x', or either with bent arms.
fn layout() -> impl Strategy<Value = [(Vector3<f64>, Spin); 4]> {
    let regular = prop_oneof![Just(PLUS), Just(CROSS)];
    let bend = prop::array::uniform4((-0.25..0.25_f64, 0.75..1.3_f64, -0.3..0.3_f64));
    (regular, prop::option::of(bend), any::<bool>()).prop_map(|(regular, bend, reversed)| {
        std::array::from_fn(|i| {
            let (angle, spin) = regular[i];
            let (turn, stretch, height) = bend.map_or((0.0, 1.0, 0.0), |b| b[i]);
            let (sin, cos) = (angle + turn).sin_cos();
            let spin = if reversed { opposite(spin) } else { spin };
            (Vector3::new(stretch * cos, stretch * sin, height), spin)
        })
    })
}

fn opposite(spin: Spin) -> Spin {
    match spin {
        Spin::Clockwise => Spin::CounterClockwise,
        Spin::CounterClockwise => Spin::Clockwise,
    }
}

/// What the empirical and mechanistic rotors are drawn from, dimensionless.
#[derive(Clone, Copy, Debug)]
struct RotorFactors {
    /// Thrust of all rotors at full command over weight.
    thrust_to_weight: f64,
    /// Torque per thrust over arm length.
    torque_per_thrust: f64,
    /// ω_R, rad/s.
    bandwidth: f64,
    /// Second pole over ω_R, of thrust and of torque.
    second_pole: [f64; 2],
    /// Zero of the torque over ω_R.
    zero: f64,
    /// Shares of the linear and cubic terms in the full thrust; the square has the rest.
    shares: [f64; 2],
    /// Nominal battery voltage, V; as drawn, for the reference mass.
    voltage: f64,
    /// Motor voltage in hover over battery voltage.
    hover_voltage: f64,
}

fn rotor_factors() -> impl Strategy<Value = RotorFactors> {
    let first = (
        2.2..4.0_f64,
        0.03..0.2_f64,
        5.0..60.0_f64,
        [2.5..9.0_f64, 2.5..9.0],
    );
    let second = (
        0.2..2.0_f64,
        [0.1..0.5_f64, -0.3..0.3],
        0.7..1.4_f64,
        0.3..0.5_f64,
    );
    (first, second).prop_map(
        |(
            (thrust_to_weight, torque_per_thrust, bandwidth, second_pole),
            (zero, shares, voltage, hover_voltage),
        )| {
            RotorFactors {
                thrust_to_weight,
                torque_per_thrust,
                bandwidth,
                second_pole,
                zero,
                shares,
                voltage,
                hover_voltage,
            }
        },
    )
}

impl RotorFactors {
    fn linear(&self, weight: f64, arm: f64, pwm: &PwmRange) -> LinearRotorParameters {
        let thrust_gain = self.thrust_to_weight * weight / 4.0 / (pwm.maximum - pwm.zero_thrust);
        LinearRotorParameters {
            thrust_gain,
            torque_gain: thrust_gain * self.torque_per_thrust * arm,
            bandwidth: self.bandwidth,
        }
    }

    fn dynamics(&self) -> RotorDynamics<f64> {
        let w = self.bandwidth;
        let [thrust, torque] = self
            .second_pole
            .map(|factor| (w * (1.0 + factor), w * w * factor));
        RotorDynamics {
            thrust_c1: thrust.0,
            thrust_c2: thrust.1,
            torque_c1: torque.1 / (self.zero * w),
            torque_c2: torque.1,
            torque_c3: torque.0,
            torque_c4: torque.1,
        }
    }

    /// Full thrust at full duty and nominal voltage, as the linear rotor; rising all the way.
    fn polynomial(&self, weight: f64, arm: f64, pwm: &PwmRange) -> PolynomialRotorParameters {
        let full_thrust = self.thrust_to_weight * weight / 4.0;
        let x = (pwm.maximum - pwm.minimum) * self.voltage;
        let [linear, cubic] = self.shares;
        let thrust = [linear / x, (1.0 - linear - cubic) / (x * x), cubic / (x * x * x)]
            .map(|term| term * full_thrust);
        let [k1, k2, k3] = thrust;
        let thrust = Cubic { k1, k2, k3 };
        PolynomialRotorParameters {
            thrust,
            torque: thrust.map(|term| term * self.torque_per_thrust * arm),
        }
    }

    fn propeller(&self, arm: f64) -> PropellerParameters {
        let (diameter, thrust_coefficient) = (1.2 * arm, 0.12);
        PropellerParameters {
            diameter,
            thrust_coefficient,
            torque_coefficient: thrust_coefficient * self.torque_per_thrust * arm / diameter,
        }
    }

    /// A motor that hovers at the drawn share of the voltage, loses a tenth of it in copper, and has the
    /// drawn bandwidth there.
    fn motor(&self, weight: f64, arm: f64, pwm: &PwmRange) -> Motor<f64> {
        let law = self.propeller(arm).law(AIR_DENSITY);
        let (k_t, k_q) = (law.thrust_per_speed_squared, law.torque_per_speed_squared);
        let speed = (weight / 4.0 / k_t).sqrt();
        let volts = self.hover_voltage * self.voltage;
        let velocity_constant = speed / (0.9 * volts);
        let current = velocity_constant * k_q * speed * speed;
        let no_load_current = 0.05 * current;
        let resistance = 0.1 * volts / (current + no_load_current);
        let damping = 1.0 / (resistance * velocity_constant.powi(2)) + 2.0 * k_q * speed;
        Motor {
            velocity_constant,
            resistance,
            no_load_current,
            rotor_inertia: damping / self.bandwidth,
            controller_lag: 0.2 / self.bandwidth,
            full_voltage_duty: pwm.maximum - pwm.minimum,
        }
    }

    /// A pack that sags by a twentieth of its voltage in hover and drops a tenth soon after full.
    fn battery(&self, motor: &Motor<f64>, weight: f64, arm: f64) -> BatteryParameters {
        let torque = self.torque_per_thrust * arm * weight / 4.0;
        let hover_current =
            4.0 * self.hover_voltage * (motor.velocity_constant * torque + motor.no_load_current);
        let capacity = hover_current * 0.2;
        BatteryParameters {
            nominal_voltage: self.voltage,
            full_voltage: 1.13 * self.voltage,
            internal_resistance: 0.05 * self.voltage / hover_current,
            capacity,
            exponential_amplitude: 0.1 * self.voltage,
            exponential_rate: 20.0 / capacity,
        }
    }
}

/// A PWM range and where in its lower third the thrust is zero.
fn pwm() -> impl Strategy<Value = PwmRange> {
    (0.0..0.2_f64, 0.05..0.8_f64, 0.0..0.3_f64).prop_map(|(minimum, span, zero)| PwmRange {
        minimum,
        maximum: minimum + span,
        zero_thrust: minimum + zero * span,
    })
}

/// Drag equal to the weight at 10 to 25 m/s; damping that halves a rate in about a second.
fn drag(mass: f64, arm: f64) -> impl Strategy<Value = Drag<f64>> {
    let speed = || 10.0..25.0_f64;
    let damping = || 0.02..0.1_f64;
    ([speed(), speed(), speed()], [damping(), damping(), damping()]).prop_map(move |(speed, damping)| Drag {
        quadratic: Vector3::from(speed).map(|v| mass * GRAVITY / (v * v)),
        rate_damping: Vector3::from(damping) * (mass * arm * arm),
    })
}

/// Any vehicle from 20 g to 8 kg, every group present: '+', 'x' and irregular layouts, full inertia
/// matrix, centre of mass up to a tenth of the arm away from the geometric centre.
pub fn vehicle() -> impl Strategy<Value = Vehicle> {
    let mass = log_uniform(0.02..8.0);
    let slenderness = 0.8..1.25_f64;
    (mass, slenderness).prop_flat_map(|(mass, slenderness)| {
        let arm = REFERENCE_ARM * (mass / REFERENCE_MASS).cbrt() * slenderness;
        let offset = [-0.1..0.1_f64, -0.1..0.1, -0.1..0.1];
        (
            inertia_shape(),
            layout(),
            offset,
            pwm(),
            rotor_factors(),
            drag(mass, arm),
        )
            .prop_map(move |(inertia, layout, offset, pwm, factors, drag)| {
                let centre_of_mass = Vector3::from(offset) * arm;
                let airframe = Airframe {
                    mass,
                    inertia: inertia * (mass * arm * arm),
                    arm_length: arm,
                    centre_of_mass,
                };
                let rotors = layout.map(|(hub, spin)| RotorMount {
                    name: "drawn".to_owned(),
                    hub_position: hub * arm,
                    spin,
                });
                let voltage = factors.voltage * REFERENCE_VOLTAGE * (mass / REFERENCE_MASS).cbrt();
                assemble(airframe, rotors, pwm, &RotorFactors { voltage, ..factors }, drag)
            })
    })
}

fn assemble(
    airframe: Airframe,
    rotors: [RotorMount; 4],
    pwm: PwmRange,
    factors: &RotorFactors,
    drag: Drag<f64>,
) -> Vehicle {
    let (weight, arm) = (airframe.mass * GRAVITY, airframe.arm_length);
    let motor = factors.motor(weight, arm, &pwm);
    Vehicle {
        name: "random".to_owned(),
        description: String::new(),
        environment: Environment {
            gravity: GRAVITY,
            air_density: AIR_DENSITY,
        },
        airframe,
        rotors,
        pwm,
        linear_rotor: factors.linear(weight, arm, &pwm),
        rotor_dynamics: Some(factors.dynamics()),
        polynomial_rotor: Some(factors.polynomial(weight, arm, &pwm)),
        propeller: Some(factors.propeller(arm)),
        motor: Some(motor),
        battery: Some(factors.battery(&motor, weight, arm)),
        drag: Some(drag),
        arms: Some(ArmParameters {
            width: 0.05 * airframe.arm_length,
            drag_coefficient: 1.2,
            drop: 0.1 * airframe.arm_length,
        }),
    }
}

/// The same vehicle with its zero-thrust command at the bottom of the range.
pub fn without_offset(mut vehicle: Vehicle) -> Vehicle {
    let span = vehicle.pwm.maximum - vehicle.pwm.zero_thrust;
    vehicle.pwm.zero_thrust = vehicle.pwm.minimum;
    // The same full thrust over the longer range.
    let stretch = span / (vehicle.pwm.maximum - vehicle.pwm.minimum);
    vehicle.linear_rotor.thrust_gain *= stretch;
    vehicle.linear_rotor.torque_gain *= stretch;
    vehicle
}
