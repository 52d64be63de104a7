//! The closed loop of model i under controller i, its feedback continuous, is the linear system designed.
//!
//! Feedback is continuous when every stage of RK4 asks the controller anew. What is then left between flight and
//! design is the integrator's error, of order 4.

use super::*;
use crate::stability::{AttitudeLoop, HorizontalLoop, SecondOrder};
use crate::{C1, C2, C3, Controller, Gains, LoopGains, Reference};
use nalgebra::{DMatrix, DVector};
use quad_dynamics::{Flight, Level1, Level2, Level3, PhenomenonSet};
use quad_math::{Taylor3, output_derivatives, rk4};

/// Steps of the integrator, s; the fastest pole is 35 rad/s.
const STEPS: [f64; 3] = [0.008, 0.004, 0.002];

/// Length of a flight, s.
const END: f64 = 1.6;

/// A measured order may miss 4 by what the next term of the error expansion, `h p` times the first with a factor
/// of order one, makes at the coarser steps: measured 4.01 to 4.22, the latter with `h p` = 0.28.
const ORDER_TOLERANCE: f64 = 0.35;

/// Error left by the fine step where the response is of order one: `(h p)⁴/120` = 2e-7 with the fastest pole.
const LEFT: f64 = 2e-7;

/// Response to a unit step from rest of a loop with unit steady gain, no zeros and this polynomial (monic,
/// descending): `1 − y` and its derivatives obey the homogeneous equation, by the matrix exponential.
pub(super) fn step_response(polynomial: &[f64], t: f64) -> f64 {
    let n = polynomial.len() - 1;
    let companion = DMatrix::from_fn(n, n, |i, j| match (i + 1 == n, j == i + 1) {
        (true, _) => -polynomial[n - j],
        (false, is_next) => f64::from(u8::from(is_next)),
    });
    let start = DVector::from_fn(n, |i, _| f64::from(u8::from(i == 0)));
    1.0 - ((companion * t).exp() * start)[0]
}

/// The polynomial of a loop's own gains, of second or third order.
pub(super) fn polynomial(gains: &LoopGains<f64>, order: usize) -> Vec<f64> {
    let pair = SecondOrder::new(gains.natural_frequency, gains.damping).unwrap();
    match order {
        2 => AttitudeLoop::SecondOrder(pair).characteristic(),
        _ => AttitudeLoop::ThirdOrder {
            pair,
            pole_rad_s: gains.pole,
        }
        .characteristic(),
    }
}

/// Largest distance between what a flight shows and the truth, over the instants of the coarsest step.
fn error<M: QuadrotorModel<f64>, const N: usize>(
    model: &M,
    start: &StateOf<f64, M>,
    h: f64,
    feedback: &impl Fn(&StateOf<f64, M>, &Flight<f64>) -> [f64; 4],
    see: &impl Fn(&Flight<f64>) -> [f64; N],
    truth: &impl Fn(f64) -> [f64; N],
) -> f64 {
    let f =
        |_: f64, x: &StateOf<f64, M>| model.derivative(x, &Input::still_air(feedback(x, &model.flight(x))));
    let every = (STEPS[0] / h).round() as usize;
    let mut state = *start;
    let mut worst = 0.0_f64;
    for k in 1..=(END / h).round() as usize {
        state = rk4(f, 0.0, &state, h);
        if k % every == 0 {
            let (seen, wanted) = (see(&model.flight(&state)), truth(k as f64 * h));
            worst = seen
                .iter()
                .zip(wanted)
                .fold(worst, |m, (s, w)| m.max((s - w).abs()));
        }
    }
    worst
}

/// Checks that the error falls with the fourth power of the step and is small.
fn falls_by_order_four(name: &str, errors: [f64; 3]) {
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(
            (order - 4.0).abs() < ORDER_TOLERANCE,
            "{name}: order {order}, errors {errors:?}"
        );
    }
    assert!(errors[2] < LEFT, "{name}: {errors:?}");
}

/// Flies a controller on its model to a set point.
fn flown<M: QuadrotorModel<f64>, C: Controller<f64>, const N: usize>(
    name: &str,
    vehicle: &Vehicle,
    controller: &C,
    reference: &Reference<f64>,
    see: impl Fn(&Flight<f64>) -> [f64; N],
    truth: impl Fn(f64) -> [f64; N],
) {
    let model = M::build(vehicle, &PhenomenonSet::none()).unwrap();
    let start = model.hover(Vector3::zeros(), 0.0).state;
    let memory = controller.initial_memory();
    let feedback = |_: &StateOf<f64, M>, flight: &Flight<f64>| {
        controller.control(&memory, flight, reference, 1e-3).commands
    };
    falls_by_order_four(
        name,
        STEPS.map(|h| error(&model, &start, h, &feedback, &see, &truth)),
    );
}

fn gains() -> Gains<f64> {
    settings().gains().unwrap()
}

/// Height and heading responses to steps of a metre and a radian.
fn height_and_yaw(order: usize) -> impl Fn(f64) -> [f64; 2] {
    let g = gains();
    let (z, psi) = (polynomial(&g.height, order), polynomial(&g.yaw, order));
    move |t| [step_response(&z, t), step_response(&psi, t)]
}

fn seen(flight: &Flight<f64>) -> [f64; 2] {
    [flight.position.z, flight.attitude.yaw]
}

#[test]
fn exact_step_response_helper() {
    // Double pole at −3: y = 1 − (1 + 3t) e^(−3t). The exponential is good to some units in the last place.
    for t in [0.1_f64, 0.7, 2.0] {
        let truth = 1.0 - (1.0 + 3.0 * t) * (-3.0 * t).exp();
        assert!((step_response(&[1.0, 6.0, 9.0], t) - truth).abs() < 1e-14);
    }
}

#[test]
fn exact_c1_on_level_1_in_height_and_yaw() {
    for vehicle in vehicles() {
        let c1 = C1::new(&vehicle, &settings()).unwrap();
        let up_and_round = Reference::hold(Vector3::new(0.0, 0.0, 1.0), 1.0);
        flown::<Level1<f64>, _, 2>("c1 z psi", &vehicle, &c1, &up_and_round, seen, height_and_yaw(2));
    }
}

#[test]
fn exact_c1_on_level_1_in_position() {
    let g = gains();
    let second = |l: &LoopGains<f64>| SecondOrder::new(l.natural_frequency, l.damping).unwrap();
    let closed = HorizontalLoop {
        position: second(&g.position),
        attitude: AttitudeLoop::SecondOrder(second(&g.attitude)),
    };
    let fourth = closed.characteristic();
    let vehicle = Vehicle::qball_x4();
    let c1 = C1::new(&vehicle, &settings()).unwrap();
    // One direction at a time: with roll and pitch together body rates are no longer Euler rates.
    let ahead = Reference::hold(Vector3::new(1.0, 0.0, 0.0), 0.0);
    let truth = |t: f64| [step_response(&fourth, t), 0.0];
    flown::<Level1<f64>, _, 2>(
        "c1 x",
        &vehicle,
        &c1,
        &ahead,
        |f| [f.position.x, f.position.y],
        truth,
    );
    let right = Reference::hold(Vector3::new(0.0, 1.0, 0.0), 0.0);
    flown::<Level1<f64>, _, 2>(
        "c1 y",
        &vehicle,
        &c1,
        &right,
        |f| [f.position.y, f.position.x],
        truth,
    );
}

/// Far away in x and y, so that the vehicle tilts by tens of degrees; a metre and a radian in height and heading.
fn everywhere() -> Reference<f64> {
    Reference::hold(Vector3::new(8.0, -5.0, 1.0), 1.0)
}

#[test]
fn exact_c2_on_level_2_in_height_and_yaw_while_tilting() {
    for vehicle in vehicles() {
        let c2 = C2::new(&vehicle, &settings()).unwrap();
        flown::<Level2<f64>, _, 2>("c2 z psi", &vehicle, &c2, &everywhere(), seen, height_and_yaw(2));
    }
}

#[test]
fn exact_c3_on_level_3_in_height_and_yaw_while_tilting() {
    for vehicle in vehicles() {
        let c3 = C3::new(&vehicle, &settings()).unwrap();
        flown::<Level3<f64>, _, 2>("c3 z psi", &vehicle, &c3, &everywhere(), seen, height_and_yaw(3));
    }
}

/// Attitude to go to, rad: 50° of roll, −40° of pitch, and a radian of heading.
const TILTED: Vector3<f64> = Vector3::new(0.87, -0.7, 1.0);

fn angles(flight: &Flight<f64>) -> [f64; 3] {
    flight.attitude.vector().into()
}

fn attitude(order: usize) -> impl Fn(f64) -> [f64; 3] {
    let g = gains();
    let (tilt, psi) = (polynomial(&g.attitude, order), polynomial(&g.yaw, order));
    move |t| {
        let (tilt, psi) = (step_response(&tilt, t), step_response(&psi, t));
        [TILTED.x * tilt, TILTED.y * tilt, TILTED.z * psi]
    }
}

#[test]
fn exact_c2_attitude_at_large_tilt() {
    let vehicle = Vehicle::qball_x4();
    let c2 = C2::new(&vehicle, &settings()).unwrap();
    let loops = [&c2.gains.attitude, &c2.gains.attitude, &c2.gains.yaw];
    let feedback = |_: &StateOf<f64, Level2<f64>>, flight: &Flight<f64>| {
        let e = TILTED - flight.attitude.vector();
        let rates = flight.attitude.rates(&flight.body_rates).vector();
        let v = Vector3::from_fn(|i, _| loops[i].second_order(e[i], -rates[i], 0.0));
        c2.allocation.commands(&c2.invert(flight, 0.0, &v))
    };
    let model = Level2::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
    let start = model.hover(Vector3::zeros(), 0.0).state;
    let errors = STEPS.map(|h| error(&model, &start, h, &feedback, &angles, &attitude(2)));
    falls_by_order_four("c2 attitude", errors);
}

#[test]
fn exact_c3_attitude_at_large_tilt() {
    let vehicle = Vehicle::qball_x4();
    let none = PhenomenonSet::none();
    let c3 = C3::new(&vehicle, &settings()).unwrap();
    let loops = [&c3.gains.attitude, &c3.gains.attitude, &c3.gains.yaw];
    let twin = Level3::<Taylor3>::build(&vehicle, &none).unwrap();
    let no_input = Input::still_air([Taylor3::from_re(0.0); 4]);
    let feedback = |x: &StateOf<f64, Level3<f64>>, flight: &Flight<f64>| {
        // The Euler angles' second derivatives, which c3 works out for itself, by automatic differentiation.
        let [_, rates, accelerations, _] = output_derivatives(
            |x| quad_math::System::derivative(&twin, x, &no_input),
            |x| twin.flight(x).attitude.vector().into(),
            &flat(x),
        );
        let e = TILTED - flight.attitude.vector();
        let v = Vector3::from_fn(|i, _| loops[i].third_order(e[i], -rates[i], -accelerations[i], 0.0));
        c3.invert(flight, &flight.thrusts.unwrap(), 0.0, &v)
    };
    let model = Level3::<f64>::build(&vehicle, &none).unwrap();
    let start = model.hover(Vector3::zeros(), 0.0).state;
    let errors = STEPS.map(|h| error(&model, &start, h, &feedback, &angles, &attitude(3)));
    falls_by_order_four("c3 attitude", errors);
}
