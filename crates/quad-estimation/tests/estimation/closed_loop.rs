//! Filters beside the loop and inside it: level 5 flies, sees itself through sensors, and is flown by what it believes.

use crate::support::generator;
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
use quad_estimation::sensor::{Quality, Seen, SensorSuite};
use quad_estimation::{Estimator, ExtendedFilter, InitialUncertainty, LevelProcess, ProcessNoise};
use quad_math::FixedStep;
use quad_ndi::{AnyController, C3, Reference, Settings};

const STEP_NS: u64 = 5_000_000;
const STEP_S: f64 = 5e-3;

/// Whose state the controller sees.
#[derive(Clone, Copy, PartialEq)]
enum Loop {
    /// The truth; the filter flies beside the loop.
    Beside,
    /// The estimate.
    Inside,
}

/// Root mean squares over the second half of a flight.
struct Flown {
    /// Of the estimate's position error, m, and of what the filter says of it.
    position: f64,
    stated: f64,
}

fn fly(filter_level: Level, quality: Quality, which: Loop, seed: u64) -> Flown {
    let vehicle = Vehicle::qball_x4();
    let phenomena = Level::Five.phenomena();
    let start = Vector3::new(0.0, 0.0, -1.0);
    let mut truth = AnyQuadrotor::hovering(Level::Five, &vehicle, &phenomena, start, 0.0).unwrap();
    let mut input = truth.hover_input();
    let process = LevelProcess::new(
        filter_level,
        &vehicle,
        &filter_level.phenomena(),
        ProcessNoise {
            disturbance: 0.3,
            rates: 0.3,
            ..ProcessNoise::default().with_drifts_of(&quality.sensors())
        },
    )
    .unwrap();
    let belief = process
        .belief(
            &truth.snapshot(&input),
            &input,
            &InitialUncertainty::default().with_biases_of(&quality.sensors()),
        )
        .unwrap();
    let filter = ExtendedFilter::new(process, belief).unwrap();
    let suite: SensorSuite = quality.suite();
    let mut random = generator(seed);
    let mut sensors = suite.turned_on(&mut random);
    let mut estimator = Estimator::new(filter, input, suite.longest_delay_ns() + STEP_NS);
    let mut settings = Settings::default();
    settings.position.settling_time_s = 5.0;
    let mut controller = AnyController::C3(C3::new(&vehicle, &settings).unwrap().into());
    let steps = 3000;
    let (mut position, mut stated) = (0.0, 0.0);
    for k in 1..=steps {
        let t = k as f64 * STEP_S;
        let reference = Reference::hold(Vector3::new((0.5 * t).sin(), 0.0, -1.5), 0.2);
        let flight = match which {
            Loop::Beside => truth.flight(),
            Loop::Inside => {
                use quad_estimation::Filter;
                let mean = estimator.filter().belief().mean.clone();
                estimator.filter_mut().process_mut().model_at(&mean).flight()
            }
        };
        input.commands = controller.update(&flight, &reference, STEP_S);
        truth.step(FixedStep::Rk4, &input, STEP_S);
        let now_ns = k * STEP_NS;
        estimator.predict(&input, now_ns).expect("finite commands");
        for measurement in suite.sample(&mut sensors, now_ns, &Seen::of(&truth, &input), &mut random) {
            estimator.update(&measurement).expect("in order");
        }
        if k > steps / 2 {
            let estimate = estimator.estimate();
            let body = truth.snapshot(&input).body;
            position += estimate.error(&body).position.norm_squared();
            stated += estimate.deviations().fixed_rows::<3>(0).norm_squared();
        }
    }
    let rms = |sum: f64| (sum / (steps - steps / 2) as f64).sqrt();
    Flown {
        position: rms(position),
        stated: rms(stated),
    }
}

/// Beside the loop or in it, the filter errs as it says it does: within a factor of two, with a process noise that was not tuned.
#[test]
fn prop_level_5_is_flown_by_its_estimates() {
    for (quality, which, allowed) in [
        (Quality::Good, Loop::Beside, 0.02),
        (Quality::Good, Loop::Inside, 0.02),
        (Quality::Poor, Loop::Inside, 0.1),
    ] {
        for level in [Level::Three, Level::Five] {
            let flown = fly(level, quality, which, 5);
            assert!(flown.position < allowed);
            let ratio = flown.position / flown.stated;
            assert!((0.5..2.0).contains(&ratio), "{level}: {ratio}");
        }
    }
}
