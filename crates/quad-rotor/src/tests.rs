//! Oracles: closed-form step responses, conservation of power, automatic differentiation.

use crate::*;
use approx::assert_relative_eq;
use num_dual::Dual64;
use proptest::prelude::*;
use quad_math::{Flat, Real, State, constant, rk4};

/// The project's nominal rotor of the Qball-X4 (models page of the reconstruction).
fn mechanistic<R: Real>() -> MechanisticRotor<R> {
    MechanisticRotor {
        propeller: Propeller {
            thrust_per_speed_squared: constant(1.616e-5),
            torque_per_speed_squared: constant(2.654e-7),
        },
        motor: Motor {
            velocity_constant: constant(1020.0 * std::f64::consts::TAU / 60.0),
            resistance: constant(0.126),
            no_load_current: constant(1.1),
            rotor_inertia: constant(6.5e-5),
            controller_lag: constant(0.01),
            full_voltage_duty: constant(0.05),
        },
        zero_thrust_offset: constant(0.01),
    }
}

fn dynamics() -> RotorDynamics<f64> {
    // Poles at -15 and -100, zero at -4.
    RotorDynamics {
        thrust_c1: 115.0,
        thrust_c2: 1500.0,
        torque_c1: 1500.0 / 4.0,
        torque_c2: 1500.0,
        torque_c3: 115.0,
        torque_c4: 1500.0,
    }
}

fn linear() -> LinearRotor<f64> {
    LinearRotor {
        thrust_gain: 269.0,
        torque_gain: 4.4,
        dynamics: dynamics(),
    }
}

fn non_linear() -> NonLinearRotor<f64> {
    NonLinearRotor {
        thrust: Cubic {
            k1: 4.0,
            k2: 40.0,
            k3: -10.0,
        },
        torque: Cubic {
            k1: 0.08,
            k2: 0.6,
            k3: -0.1,
        },
        range_end: 0.63,
        zero_thrust_offset: 0.01,
        dynamics: dynamics(),
    }
}

/// Flies the rotor's own equation for `time` seconds under a constant input.
fn run<M: RotorModel<f64>>(rotor: &M, start: M::State, input: &RotorInput<f64>, time: f64) -> M::State {
    let steps = 2000;
    let h = time / f64::from(steps);
    let f = |_, x: &M::State| rotor.derivative(x, input);
    (0..steps).fold(start, |x, _| rk4(f, 0.0, &x, h))
}

/// RK4 with h·pole ≤ 0.02 leaves (h·pole)⁵/120 a step, far below this.
const STEP_TOLERANCE: f64 = 1e-7;

#[test]
fn exact_first_order_step() {
    let rotor = FirstOrderRotor {
        thrust_gain: 120.0,
        torque_per_thrust: 0.02,
        bandwidth: 15.0,
    };
    let input = RotorInput {
        command: 0.03,
        voltage: 11.1,
    };
    let end = run(&rotor, ThrustState { thrust: 1.0 }, &input, 0.2);
    let steady = 3.6;
    assert_relative_eq!(
        end.thrust,
        steady + (1.0 - steady) * (-15.0_f64 * 0.2).exp(),
        epsilon = STEP_TOLERANCE
    );
}

#[test]
fn exact_empirical_step_by_partial_fractions() {
    let rotor = linear();
    let input = RotorInput {
        command: 0.02,
        voltage: 11.1,
    };
    let at_rest = rotor.equilibrium(&RotorInput {
        command: 0.0,
        ..input
    });
    let t = 0.1;
    let end = run(&rotor, at_rest, &input, t);
    let (a, b) = (15.0_f64, 100.0_f64);
    // Unit step through ab/((s+a)(s+b)), and its derivative through the zero at -4.
    let unit = 1.0 - (b * (-a * t).exp() - a * (-b * t).exp()) / (b - a);
    let slope = a * b / (b - a) * ((-a * t).exp() - (-b * t).exp());
    assert_relative_eq!(end.thrust, 269.0 * 0.02 * unit, epsilon = STEP_TOLERANCE);
    assert_relative_eq!(
        end.torque,
        4.4 * 0.02 * (unit + slope / 4.0),
        epsilon = STEP_TOLERANCE
    );
}

proptest! {
    #[test]
    fn prop_equilibrium_is_at_rest(command in 0.0..0.035, voltage in 9.0..12.6) {
        let input = RotorInput { command, voltage };
        let mut rates = [0.0; 4];
        non_linear().derivative(&non_linear().equilibrium(&input), &input).write(&mut rates);
        // Rates are differences of terms up to 1500 · 10 N: rounding of those.
        prop_assert!(rates.iter().all(|r| r.abs() < 1e-10));
        let m = mechanistic::<f64>();
        m.derivative(&m.equilibrium(&input), &input).write(&mut rates);
        // Torques of 0.1 N m, rounded, over the inertia of 6.5e-5 kg m².
        prop_assert!(rates[..2].iter().all(|r| r.abs() < 1e-9));
    }

    #[test]
    fn prop_trim_command_gives_the_thrust(thrust in 0.2..7.8, voltage in 10.0..12.6) {
        fn check<M: RotorModel<f64>>(rotor: &M, thrust: f64, voltage: f64) -> f64 {
            let input = RotorInput { command: rotor.command_for_thrust(thrust, voltage), voltage };
            rotor.output(&rotor.equilibrium(&input), &input).thrust - thrust
        }
        let ideal = IdealRotor { thrust_gain: 120.0, torque_gain: 4.0 };
        let first = FirstOrderRotor { thrust_gain: 120.0, torque_per_thrust: 0.03, bandwidth: 15.0 };
        // Rounding, carried through a handful of operations.
        for error in [
            check(&ideal, thrust, voltage), check(&first, thrust, voltage), check(&linear(), thrust, voltage),
            check(&non_linear(), thrust, voltage), check(&mechanistic(), thrust, voltage),
        ] {
            prop_assert!(error.abs() < 1e-11, "{error}");
        }
    }

    /// Conservation: battery power = copper loss + no-load loss + shaft power into air and spin.
    #[test]
    fn prop_motor_power_balance(speed in 50.0..800.0, effective_voltage in 1.0..12.0) {
        let m = mechanistic::<f64>();
        let state = SpinState { speed, effective_voltage };
        let input = RotorInput { command: 0.02, voltage: 11.1 };
        let current = m.motor.current(effective_voltage, speed);
        let spin = m.motor.rotor_inertia * m.derivative(&state, &input).speed * speed;
        let air = m.propeller.torque(speed) * speed;
        let no_load = m.motor.no_load_current / m.motor.velocity_constant * speed;
        let copper = m.motor.resistance * current * current;
        let electric = effective_voltage * current;
        // Rounding of powers up to some kilowatts.
        prop_assert!((electric - copper - no_load - air - spin).abs() < 1e-9);
        // Newton's third law: the airframe's reaction is the air's torque plus what spins the rotor up.
        let reaction = m.output(&state, &input).torque;
        prop_assert!((reaction - m.propeller.torque(speed) - spin / speed).abs() < 1e-12);
    }

    /// The closed-form bandwidth is minus the derivative of Ω̇ by Ω.
    #[test]
    fn exact_bandwidth_by_automatic_differentiation(speed in 100.0..700.0) {
        let m = mechanistic::<Dual64>();
        let state = SpinState { speed: Dual64::from(speed).derivative(), effective_voltage: Dual64::from(5.0) };
        let input = RotorInput { command: Dual64::from(0.02), voltage: Dual64::from(11.1) };
        let pole = -m.derivative(&state, &input).speed.eps;
        assert_relative_eq!(pole, mechanistic::<f64>().bandwidth(speed), max_relative = 1e-12);
    }

    #[test]
    fn prop_lifted_state_keeps_the_output(
        thrust in 0.5..7.0, torque in 0.01..0.1, slope in -20.0..20.0, twist in -1.0..1.0,
    ) {
        let input = RotorInput { command: 0.02, voltage: 11.1 };
        let output = RotorOutput { thrust, torque };
        let rate = RotorOutput { thrust: slope, torque: twist };
        let state = non_linear().state_for_output(&output, &rate, &input);
        prop_assert_eq!(non_linear().output(&state, &input), output);
        prop_assert_eq!(non_linear().output_rate(&state, &input).thrust, slope);
        // Rounding of terms up to c_Q1 · Q = 40 N m/s.
        prop_assert!((non_linear().output_rate(&state, &input).torque - twist).abs() < 1e-12);
        let m = mechanistic::<f64>();
        let state = m.state_for_output(&output, &rate, &input);
        prop_assert!((m.output(&state, &input).thrust - thrust).abs() < 1e-12);
        prop_assert!((m.output(&state, &input).torque - torque).abs() < 1e-12);
    }

    /// The rate of the output is the derivative of the output along the flow.
    #[test]
    fn exact_output_rate_by_automatic_differentiation(speed in 100.0..700.0, volts in 3.0..9.0) {
        let input = RotorInput { command: 0.02, voltage: 11.1 };
        let now = SpinState { speed, effective_voltage: volts };
        let rate = mechanistic::<f64>().derivative(&now, &input);
        let flow = SpinState {
            speed: Dual64::new(speed, rate.speed),
            effective_voltage: Dual64::new(volts, rate.effective_voltage),
        };
        let dual_input = RotorInput { command: Dual64::from(0.02), voltage: Dual64::from(11.1) };
        let dual = mechanistic::<Dual64>().output(&flow, &dual_input);
        let ours = mechanistic::<f64>().output_rate(&now, &input);
        assert_relative_eq!(ours.thrust, dual.thrust.eps, max_relative = 1e-11, epsilon = 1e-9);
        assert_relative_eq!(ours.torque, dual.torque.eps, max_relative = 1e-11, epsilon = 1e-9);
    }

    #[test]
    fn prop_flat_round_trip(v in [0.0..10.0, -9.0..9.0, 0.0..1.0, -1.0..1.0]) {
        let mut out = [0.0; 4];
        ResponseState::read(&v).write(&mut out);
        prop_assert_eq!(out, v);
        SpinState::read(&v).write(&mut out);
        prop_assert_eq!(out, v);
        BatteryState::read(&v).write(&mut out);
        ThrustState::read(&v).write(&mut out);
        prop_assert_eq!(out, v);
    }

    #[test]
    fn prop_speed_law_inverts(speed in 10.0..800.0, thrust_rate in -50.0..50.0) {
        let p = mechanistic::<f64>().propeller;
        assert_relative_eq!(p.speed_for_thrust(p.thrust(speed)), speed, max_relative = 1e-14);
        let rate = p.speed_rate_for_thrust_rate(speed, thrust_rate);
        assert_relative_eq!(2.0 * p.thrust_per_speed_squared * speed * rate, thrust_rate, epsilon = 1e-12);
    }
}

/// The nominal polynomial of the Qball-X4 rises to 1.3 V and falls beyond: the root wanted is the lower one,
/// although `y / k_1` lies far beyond the top.
#[test]
fn exact_cubic_is_inverted_on_its_rising_branch() {
    let thrust = Cubic {
        k1: 0.721143,
        k2: 54.7341,
        k3: -28.2224,
    };
    for x in [0.01, 0.1, 0.25, 0.42, 0.63] {
        // Newton's last step leaves rounding.
        assert_relative_eq!(thrust.inverse(thrust.value(x)), x, max_relative = 1e-14);
    }
}

/// At and below zero thrust the speed is zero with a finite slope; above idling it is the root.
#[test]
fn exact_speed_near_zero_thrust() {
    let speed = |thrust: f64| {
        let propeller = mechanistic::<Dual64>().propeller;
        propeller.speed_for_thrust(Dual64::from(thrust).derivative())
    };
    assert_eq!(speed(-1.0), Dual64::new(0.0, 0.0));
    let k_t = 1.616e-5;
    // The line to the idle speed of 10 rad/s, Ω = T / (10 k_T); three roundings.
    assert_relative_eq!(speed(1e-6).re, 1e-6 / (10.0 * k_t), max_relative = 1e-15);
    assert!(speed(0.0).eps.is_finite() && speed(0.0).re == 0.0);
    // dΩ/dT = 1 / (2 k_T Ω); a handful of roundings.
    let hover = speed(3.43);
    assert_relative_eq!(hover.re, (3.43_f64 / k_t).sqrt(), max_relative = 1e-15);
    assert_relative_eq!(hover.eps, 1.0 / (2.0 * k_t * hover.re), max_relative = 1e-14);
}

#[test]
fn exact_polynomials_continue_as_tangents() {
    let rotor = non_linear();
    let at = |x: f64| {
        let input = RotorInput {
            command: x / 11.1 - rotor.zero_thrust_offset,
            voltage: 11.1,
        };
        rotor.steady(&input).thrust
    };
    let end = rotor.range_end;
    let (value, slope) = (rotor.thrust.value(end), rotor.thrust.slope(end));
    // Rounding of commands of order one.
    assert_relative_eq!(at(end + 5.0), value + 5.0 * slope, max_relative = 1e-12);
    assert_relative_eq!(at(-0.1), -0.1 * rotor.thrust.k1, max_relative = 1e-12);
    assert_relative_eq!(at(0.5 * end), rotor.thrust.value(0.5 * end), max_relative = 1e-12);
}

#[test]
fn exact_hover_of_the_nominal_rotor() {
    // By hand: Ω = √(3.4335/1.616e-5) = 460.9 rad/s, I = 0.05639 N m · 106.8 + 1.1 = 7.12 A,
    // V_eff = 460.9/106.8 + 0.126 · 7.12 = 5.212 V, duty = 5.212/11.1 · 0.05 = 0.02348.
    let m = mechanistic::<f64>();
    let duty = m.command_for_thrust(1.4 * 9.81 / 4.0, 11.1) + 0.01;
    assert_relative_eq!(duty, 0.02348, epsilon = 5e-6);
}

#[test]
fn exact_stopped_rotor_stays_stopped() {
    let m = mechanistic::<f64>();
    // Half of the voltage that overcomes the no-load current.
    let state = SpinState {
        speed: 0.0,
        effective_voltage: 0.5 * 1.1 * 0.126,
    };
    let duty = state.effective_voltage / 11.1 * 0.05;
    let input = RotorInput {
        command: duty - 0.01,
        voltage: 11.1,
    };
    assert_eq!(m.derivative(&state, &input).speed, 0.0);
    assert_eq!(m.steady_speed(state.effective_voltage), 0.0);
    assert_eq!(
        m.output(&state, &input),
        RotorOutput {
            thrust: 0.0,
            torque: 0.0
        }
    );
}

#[test]
fn exact_battery_discharge() {
    let sag = Sag {
        full_voltage: 12.59,
        internal_resistance: 0.061,
        exponential_amplitude: 1.53,
        exponential_rate: 29.89,
    };
    let battery = Battery {
        nominal_voltage: 11.1,
        sag: Some(sag),
    };
    let full = battery.full();
    assert_relative_eq!(battery.voltage(&full, 10.0), 12.59 - 0.61, epsilon = 1e-12);
    // 12 A for 90 s draws 0.3 Ah.
    let rate = battery.derivative(&full, 12.0);
    let later = full.advanced(90.0, &rate);
    assert_relative_eq!(later.charge_drawn, 0.3, epsilon = 1e-12);
    let expected = 12.59 - 1.53 * (1.0 - (-29.89_f64 * 0.3).exp());
    assert_relative_eq!(battery.voltage(&later, 0.0), expected, epsilon = 1e-12);
    // Switched off, neither load nor charge matters.
    assert_eq!(Battery { sag: None, ..battery }.voltage(&later, 30.0), 11.1);
}

#[test]
fn exact_propeller_coefficients() {
    // T = C_T ρ n² D⁴ at 100 rev/s with D = 0.254 m, computed by hand.
    let p = Propeller::from_coefficients(0.12, 0.0075, 0.254, 1.225);
    let omega = 100.0 * std::f64::consts::TAU;
    assert_relative_eq!(
        p.thrust(omega),
        0.12 * 1.225 * 1e4 * 0.254_f64.powi(4),
        max_relative = 1e-14
    );
    assert_relative_eq!(
        p.torque(omega),
        0.0075 * 1.225 * 1e4 * 0.254_f64.powi(5),
        max_relative = 1e-14
    );
}
