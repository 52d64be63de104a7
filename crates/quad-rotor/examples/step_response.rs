//! The same step of the command on all five rotor models of the Qball-X4.
//!
//! Prints a short report: `cargo run -p quad-rotor --example step_response`.

use quad_math::rk4;
use quad_rotor::{
    Cubic, FirstOrderRotor, IdealRotor, LinearRotor, MechanisticRotor, Motor, NonLinearRotor, Propeller,
    RotorDynamics, RotorInput, RotorModel, RotorOutput,
};

/// Battery voltage, V, and zero-thrust duty above the bottom of the range (nominal Qball-X4).
const VOLTAGE: f64 = 11.1;
const ZERO_THRUST_OFFSET: f64 = 0.0098654;
/// Gains of the line through the operating range, N and N m per unit of duty, and bandwidth, rad/s.
const THRUST_GAIN: f64 = 265.817;
const TORQUE_GAIN: f64 = 4.3646;
const BANDWIDTH: f64 = 14.4653;
/// Commands u before and after the step: hover and a tenth of a newton or so more.
const COMMANDS: [f64; 2] = [0.0130, 0.0160];
/// Time step, s, of the integration, and the instants of the report, ms.
const STEP_S: f64 = 1e-3;
const INSTANTS_MS: [u32; 7] = [0, 20, 50, 100, 150, 200, 400];

/// Transfer functions linearised at hover: motor pole 14.5 rad/s, controller pole 100 rad/s, torque zero
/// 3.8 rad/s.
const DYNAMICS: RotorDynamics<f64> = RotorDynamics {
    thrust_c1: 114.465,
    thrust_c2: 1446.53,
    torque_c1: 384.358,
    torque_c2: 1446.53,
    torque_c3: 114.465,
    torque_c4: 1446.53,
};

/// Cubics in `x = (ū − ū_min) V_b` through the mechanistic rotor's steady states.
const THRUST: Cubic<f64> = Cubic {
    k1: 0.721143,
    k2: 54.7341,
    k3: -28.2224,
};
const TORQUE: Cubic<f64> = Cubic {
    k1: 0.0118409,
    k2: 0.898711,
    k3: -0.463401,
};

/// APC slow flyer 10x4.7 on an E-flite Park 480.
const MECHANISTIC: MechanisticRotor<f64> = MechanisticRotor {
    propeller: Propeller {
        thrust_per_speed_squared: 1.616e-5,
        torque_per_speed_squared: 2.654e-7,
    },
    motor: Motor {
        velocity_constant: 106.8142,
        resistance: 0.126,
        no_load_current: 1.1,
        rotor_inertia: 6.5e-5,
        controller_lag: 0.01,
        full_voltage_duty: 0.05,
    },
    zero_thrust_offset: ZERO_THRUST_OFFSET,
};

/// Thrust and torque at the instants of the report after the step, from rest at the first command.
fn response<M: RotorModel<f64>>(rotor: &M) -> Vec<RotorOutput<f64>> {
    let [before, after] = COMMANDS.map(|command| RotorInput {
        command,
        voltage: VOLTAGE,
    });
    let rate = |_, x: &M::State| rotor.derivative(x, &after);
    let step = |x: M::State| rk4(rate, 0.0, &x, STEP_S);
    let mut state = rotor.equilibrium(&before);
    let mut elapsed_ms = 0;
    let at = |instant_ms| {
        while elapsed_ms < instant_ms {
            state = step(state);
            elapsed_ms += 1;
        }
        rotor.output(&state, &after)
    };
    INSTANTS_MS.into_iter().map(at).collect()
}

fn main() {
    let ideal = IdealRotor {
        thrust_gain: THRUST_GAIN,
        torque_gain: TORQUE_GAIN,
    };
    let first_order = FirstOrderRotor {
        thrust_gain: THRUST_GAIN,
        torque_per_thrust: TORQUE_GAIN / THRUST_GAIN,
        bandwidth: BANDWIDTH,
    };
    let linear = LinearRotor {
        thrust_gain: THRUST_GAIN,
        torque_gain: TORQUE_GAIN,
        dynamics: DYNAMICS,
    };
    let non_linear = NonLinearRotor {
        thrust: THRUST,
        torque: TORQUE,
        range_end: 0.63,
        zero_thrust_offset: ZERO_THRUST_OFFSET,
        dynamics: DYNAMICS,
    };
    let responses = [
        ("ideal (levels 1, 2)", response(&ideal)),
        ("first order (level 3)", response(&first_order)),
        ("linear (level 4)", response(&linear)),
        ("non-linear (level 5)", response(&non_linear)),
        ("mechanistic", response(&MECHANISTIC)),
    ];
    let [before, after] = COMMANDS;
    println!("Step of the zeroed command from {before} to {after} at {VOLTAGE} V\n");
    type Part = fn(&RotorOutput<f64>) -> f64;
    let parts: [(&str, Part); 2] = [
        ("thrust, N", |o| o.thrust),
        ("reaction torque, N mm", |o| 1e3 * o.torque),
    ];
    for (quantity, part) in parts {
        print!("{quantity:<24}");
        INSTANTS_MS
            .iter()
            .for_each(|ms| print!("{:>8}", format!("{ms} ms")));
        println!();
        for (name, outputs) in &responses {
            print!("{name:<24}");
            outputs.iter().for_each(|output| print!("{:>8.3}", part(output)));
            println!();
        }
        println!();
    }
    println!("The torque of the upper three contains what it takes to spin the rotor up: it overshoots.");
}
