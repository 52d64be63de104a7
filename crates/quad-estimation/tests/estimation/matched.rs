//! A truth that is exactly what a filter believes in: the process itself, noise drawn from its own Q, R and first belief.

use crate::support::{drawn, generator, hovering_within, normals, process};
use nalgebra::DVector;
use quad_dynamics::{Level, Vehicle};
use quad_estimation::sensor::{EARTH_FIELD_UT, Instrument};
use quad_estimation::{Belief, Filter, InitialUncertainty, LevelProcess, Observation, Process};
use quad_ndi::{AnyController, C1, C2, Reference, Settings};

pub(crate) const STEP_S: f64 = 0.01;

/// Instrument, deviation, and every how many steps it reads.
const SENSORS: [(Instrument, f64, usize); 5] = [
    (Instrument::Accelerometer, 0.1, 1),
    (Instrument::Gyroscope, 0.01, 1),
    (
        Instrument::Magnetometer {
            field_ut: EARTH_FIELD_UT,
        },
        1.0,
        5,
    ),
    (Instrument::Sonar, 0.03, 5),
    (Instrument::PositionFix, 0.05, 10),
];

/// Moderate, so that linearisation is not what is tested.
pub(crate) const UNCERTAINTY: InitialUncertainty = InitialUncertainty {
    position_m: 0.1,
    velocity_m_s: 0.1,
    attitude_rad: 0.03,
    rates_rad_s: 0.05,
    own: 0.05,
    disturbance_m_s2: 0.2,
    gyroscope_bias_rad_s: 0.02,
    accelerometer_bias_m_s2: 0.2,
};

/// Sums over a flight.
pub(crate) struct Told {
    /// NEES of all errors at the end.
    pub(crate) nees: f64,
    /// NEES of the twelve errors of the rigid body at the end.
    pub(crate) rigid_nees: f64,
    /// Sum of the NIS, and number of readings.
    pub(crate) nis: f64,
    pub(crate) readings: usize,
    pub(crate) belief: Belief,
}

fn controller(level: Level) -> AnyController<f64> {
    let vehicle = Vehicle::qball_x4();
    // Slow enough for c2 on the rotors of levels 4 and 5.
    let mut settings = Settings::default();
    settings.position.settling_time_s = 5.0;
    settings.yaw.settling_time_s = 3.0;
    match level {
        Level::One => AnyController::C1(C1::new(&vehicle, &settings).expect("valid").into()),
        _ => AnyController::C2(C2::new(&vehicle, &settings).expect("valid").into()),
    }
}

/// Flies the process itself under a controller that sees the truth, and filters beside it.
pub(crate) fn fly<F: Filter<Process = LevelProcess>>(
    level: Level,
    seed: u64,
    steps: usize,
    make: impl Fn(LevelProcess, Belief) -> F,
) -> Told {
    let mut truth = process(level);
    let first = hovering_within(&truth, &UNCERTAINTY);
    let mut random = generator(seed);
    let mut x = drawn(&truth, &first, &mut random);
    let mut filter = make(truth.clone(), first);
    let mut pilot = controller(level);
    let (mut nis, mut readings) = (0.0, 0);
    let mut input = truth.hover_input();
    for k in 1..=steps {
        let t = k as f64 * STEP_S;
        let at = [0.5 * t.sin(), 0.5 * (1.0 - t.cos()), -1.0 - 0.1 * t].into();
        let flight = truth.model_at(&x).flight();
        input.commands = pilot.update(&flight, &Reference::hold(at, 0.3 + 0.2 * t), STEP_S);
        let moved = truth.transition(&x, &input, STEP_S);
        let noise = truth
            .process_noise(STEP_S)
            .map(f64::sqrt)
            .component_mul(&normals(truth.error_len(), &mut random));
        x = truth.retract(&moved, &noise);
        filter.predict(&input, STEP_S).expect("a good step");
        for (instrument, deviation, every) in SENSORS {
            if k % every == 0 {
                let ideal = truth.observe(&x, &input, instrument);
                let values: DVector<f64> = &ideal + normals(ideal.len(), &mut random) * deviation;
                let observation = Observation {
                    instrument,
                    values,
                    deviation,
                };
                let told = filter.update(&input, &observation, None).expect("a good reading");
                nis += told.nis;
                readings += told.residual.len();
            }
        }
    }
    let belief = filter.belief().clone();
    let body = truth.model_at(&x).snapshot(&input).body;
    Told {
        nees: truth.nees(&belief, &x),
        rigid_nees: truth.estimate(&belief).nees(&body),
        nis,
        readings,
        belief,
    }
}
