//! The sampled loop goes over into the continuous one as the sampling time goes to zero, at order one.

use super::linear_dynamics::{polynomial, step_response};
use super::*;
use crate::{Airborne, C1, C2, C3, ClosedLoop, Controller, InCharge, Plant, Reference};
use quad_dynamics::{Level1, Level2, Level3, PhenomenonSet};

/// Sampling times, s.
const STEPS: [f64; 4] = [0.008, 0.004, 0.002, 0.001];

/// Length of a flight, s.
const END: f64 = 1.6;

/// Largest distance of height and heading from the design, over the flight.
fn error<M: QuadrotorModel<f64>, C: Controller<f64> + Copy>(
    vehicle: &Vehicle,
    controller: &C,
    order: usize,
    h: f64,
) -> f64 {
    let model = M::build(vehicle, &PhenomenonSet::none()).unwrap();
    let hover = model.hover(Vector3::zeros(), 0.0);
    let reference = Reference::hold(Vector3::new(0.0, 0.0, 1.0), 1.0);
    let gains = settings().gains::<f64>().unwrap();
    let designed = [polynomial(&gains.height, order), polynomial(&gains.yaw, order)];
    let mut flying = ClosedLoop {
        plant: Airborne {
            model: &model,
            state: hover.state,
        },
        feedback: InCharge::from(*controller),
    };
    let every = (STEPS[0] / h).round() as usize;
    let mut worst = 0.0_f64;
    for k in 1..=(END / h).round() as usize {
        flying.step(&reference, &Input::still_air([0.0; 4]), h);
        if k % every == 0 {
            let flight = flying.plant.flight();
            let [z, psi] = designed.each_ref().map(|p| step_response(p, k as f64 * h));
            worst = worst
                .max((flight.position.z - z).abs())
                .max((flight.attitude.yaw - psi).abs());
        }
    }
    worst
}

fn falls_by_order_one(name: &str, errors: [f64; 4]) {
    for pair in errors.windows(2) {
        // The second-order term is `h` times a pole, at most 12 rad/s here, of the first: a tenth at the coarse end.
        let order = (pair[0] / pair[1]).log2();
        assert!(
            (order - 1.0).abs() < 0.2,
            "{name}: order {order}, errors {errors:?}"
        );
    }
}

#[test]
fn exact_sampled_loops_converge_at_order_one() {
    let vehicle = Vehicle::qball_x4();
    let s = settings();
    let c1 = C1::new(&vehicle, &s).unwrap();
    falls_by_order_one("c1", STEPS.map(|h| error::<Level1<f64>, _>(&vehicle, &c1, 2, h)));
    let c2 = C2::new(&vehicle, &s).unwrap();
    falls_by_order_one("c2", STEPS.map(|h| error::<Level2<f64>, _>(&vehicle, &c2, 2, h)));
    let c3 = C3::new(&vehicle, &s).unwrap();
    falls_by_order_one("c3", STEPS.map(|h| error::<Level3<f64>, _>(&vehicle, &c3, 3, h)));
}
