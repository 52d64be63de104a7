//! The simulation against independent solutions, and recovery of noiseless truths.

use super::*;
use approx::assert_relative_eq;
use nalgebra::Matrix2;
use quad_math::{FixedStep, System, jacobian};
use quad_rotor::{ResponseRate, ResponseState, RotorDynamics, RotorOutput};

/// `e^{A h}` by scaling and squaring of the power series: another route than the closed form.
fn series(a1: f64, a2: f64, h: f64) -> Matrix2<f64> {
    const SQUARINGS: i32 = 20;
    let a = Matrix2::new(-a1, 1.0, -a2, 0.0) * (h / 2f64.powi(SQUARINGS));
    let mut phi = Matrix2::identity() + a + a * a / 2.0 + a * a * a / 6.0;
    for _ in 0..SQUARINGS {
        phi *= phi;
    }
    phi
}

#[test]
fn exact_transition_with_real_complex_and_double_poles() {
    for (a1, a2) in [
        (114.465, 1446.53), // the Qball-X4's rotor: 14.5 and 100 rad/s
        (4.0, 100.0),       // complex, ζ = 0.2
        (20.0, 100.0),      // double
        (20.001, 100.0),    // nearly double, either side
        (19.999, 100.0),
    ] {
        for h in [1e-4, 0.003, 0.02, 0.2] {
            let [[a, b], [c, d]] = transition::second_order(a1, a2, h);
            let truth = series(a1, a2, h);
            // Twenty squarings double a rounding of 1e-16 each: 1e-10 of the largest entry.
            let scale = 1e-10 * truth.amax().max(1e-3);
            for (value, truth) in [(a, truth.m11), (b, truth.m12), (c, truth.m21), (d, truth.m22)] {
                assert!((value - truth).abs() < scale, "{a1} {a2} {h}: {value} {truth}");
            }
        }
    }
}

#[test]
fn exact_transition_is_differentiable_through_the_double_pole() {
    let entries = |x: &[quad_math::Dual<2>; 2]| {
        let [[a, b], [c, d]] = transition::second_order(x[0], x[1], 0.1);
        [a, b, c, d]
    };
    let plain = |a1: f64, a2: f64| {
        let [[a, b], [c, d]] = transition::second_order(a1, a2, 0.1);
        [a, b, c, d]
    };
    for at in [[20.0, 100.0], [4.0, 100.0], [60.0, 100.0]] {
        let slopes = jacobian(entries, at);
        for j in 0..2 {
            let step = 1e-5 * at[j];
            let (mut up, mut down) = (at, at);
            up[j] += step;
            down[j] -= step;
            let (up, down) = (plain(up[0], up[1]), plain(down[0], down[1]));
            for i in 0..4 {
                let difference = (up[i] - down[i]) / (2.0 * step);
                // Central differences: cut-off (1e-5)² relative, rounding 1e-16/1e-4 of entries up to 40.
                assert!(
                    (slopes[(i, j)] - difference).abs() < 1e-9 + 1e-8 * difference.abs(),
                    "{at:?} entry {i} by {j}: {} {difference}",
                    slopes[(i, j)]
                );
            }
        }
    }
}

/// The empirical rotor of levels 4 and 5 under a held steady value.
struct Rotor(RotorDynamics<f64>);

impl System<f64> for Rotor {
    type State = ResponseState<f64>;
    type Input = f64;

    fn derivative(&self, x: &ResponseState<f64>, &u: &f64) -> ResponseRate<f64> {
        self.0.derivative(x, &RotorOutput { thrust: u, torque: u })
    }
}

/// Simulation of both structures against the rotor model of level 4, integrated, at irregular times.
#[test]
fn agree_with_the_integrated_rotor_of_level_4() {
    let rotor = Rotor(RotorDynamics {
        thrust_c1: 114.465,
        thrust_c2: 1446.53,
        torque_c1: 384.358,
        torque_c2: 1446.53,
        torque_c3: 114.465,
        torque_c4: 1446.53,
    });
    let times = irregular_times(0.007, 1.5, &mut generator(4)).unwrap();
    let input = prbs(0.05);
    let start = input(times[0]);
    let mut state = rotor.0.equilibrium(&RotorOutput {
        thrust: start,
        torque: start,
    });
    let (mut thrust, mut torque) = (vec![state.thrust], vec![state.torque]);
    for pair in times.windows(2) {
        let u = input(pair[0]);
        for _ in 0..80 {
            state = FixedStep::Rk4.step(&rotor, &state, &u, (pair[1] - pair[0]) / 80.0);
        }
        thrust.push(state.thrust);
        torque.push(state.torque);
    }
    let of = |structure, kappa| Truth {
        structure,
        gain: 1.0,
        offset: 0.0,
        kappa,
        denominator: [114.465, 1446.53],
    };
    let simulated = [
        of(Structure::SecondOrder, 0.0).outputs(&times, &input),
        of(Structure::SecondOrderWithZero, 384.358).outputs(&times, &input),
    ];
    for (k, (t, q)) in thrust.iter().zip(&torque).enumerate() {
        // RK4 with λh = 100/s · 0.13 ms: (λh)⁵/120 = 3e-12 a step, over the 80 steps that the transient of 7 (torque) lasts.
        assert!((simulated[0][k].output - t).abs() < 5e-9);
        assert!((simulated[1][k].output - q).abs() < 5e-9);
    }
}

fn values(coefficients: &Coefficients) -> Vec<f64> {
    match coefficients {
        Coefficients::FirstOrder { bandwidth } => vec![bandwidth.value],
        Coefficients::SecondOrder { c1, c2 } => vec![c1.value, c2.value],
        Coefficients::SecondOrderWithZero { c1, c2, c3, c4 } => [c1, c2, c3, c4].map(|c| c.value).into(),
    }
}

#[test]
fn exact_noiseless_truths_are_recovered_from_any_sampling() {
    let times = irregular_times(0.006, 2.0, &mut generator(7)).unwrap();
    let cases = [
        (
            Truth {
                structure: Structure::FirstOrder,
                ..Truth::second_order(1.0, 14.5)
            },
            vec![14.5],
        ),
        (Truth::second_order(114.465, 1446.53), vec![114.465, 1446.53]),
        (Truth::second_order(8.0, 400.0), vec![8.0, 400.0]),
        (
            Truth {
                structure: Structure::SecondOrderWithZero,
                kappa: 768.7,
                ..Truth::second_order(114.465, 1446.53)
            },
            vec![384.35, 1446.53, 114.465, 1446.53],
        ),
    ];
    for (truth, expected) in cases {
        let record = Record::new(&truth.outputs(&times, prbs(0.04))).unwrap();
        for start in [Start::Equilibrium, Start::Free] {
            let fit = identify(&record, truth.structure, start).unwrap();
            // The minimum is zero; Levenberg-Marquardt ends at 1e-8 relative or better, times the conditioning.
            for (value, expected) in values(&fit.coefficients).iter().zip(&expected) {
                assert_relative_eq!(*value, *expected, max_relative = 1e-6);
            }
            assert_relative_eq!(fit.gain.value, 2.0, max_relative = 1e-7);
            assert_relative_eq!(fit.offset.value, 0.3, max_relative = 1e-6);
            assert!(fit.fit_percent > 99.9999);
        }
    }
}

#[test]
fn exact_poles_by_the_quadratic_formula() {
    let times = uniform_times(0.005, 3.0).unwrap();
    let fit = |c1, c2| {
        let samples = Truth::second_order(c1, c2).outputs(&times, prbs(0.04));
        identify(
            &noisy(&samples, 0.01, 1),
            Structure::SecondOrder,
            Start::Equilibrium,
        )
        .unwrap()
    };
    let Poles::Real { slow, fast } = fit(114.465, 1446.53).poles else {
        panic!("two real poles")
    };
    for (rate, truth) in [(slow, 14.465), (fast, 100.0)] {
        // Four standard errors: a false alarm once in 16000.
        assert!((rate.value - truth).abs() < 4.0 * rate.standard_error, "{rate:?}");
    }
    let Poles::Complex {
        natural_frequency,
        damping,
    } = fit(8.0, 400.0).poles
    else {
        panic!("a complex pair")
    };
    assert!((natural_frequency.value - 20.0).abs() < 4.0 * natural_frequency.standard_error);
    assert!((damping.value - 0.2).abs() < 4.0 * damping.standard_error);
}

#[test]
fn exact_a_record_that_begins_in_motion_needs_a_free_start() {
    let times = uniform_times(0.005, 3.0).unwrap();
    let samples = Truth::second_order(30.0, 400.0).outputs(&times, prbs(0.04));
    // The first 0.41 s cut off: the rest begins on the move, just after a change of the input.
    let cut = noisy(&samples[82..], 0.002, 5);
    let fit = |start| identify(&cut, Structure::SecondOrder, start).unwrap();
    let free = fit(Start::Free);
    assert!(
        free.whiteness.is_white() && free.warnings.is_empty(),
        "{:?}",
        free.warnings
    );
    let Coefficients::SecondOrder { c1, c2 } = free.coefficients else {
        panic!()
    };
    assert!((c1.value - 30.0).abs() < 4.0 * c1.standard_error);
    assert!((c2.value - 400.0).abs() < 4.0 * c2.standard_error);
    assert!(!fit(Start::Equilibrium).whiteness.is_white());
}
