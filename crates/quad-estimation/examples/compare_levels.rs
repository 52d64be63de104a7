//! What a filter's level is worth: level 5 flies steps to the side, filters on every level watch with poor sensors.
//!
//! `cargo run -p quad-estimation --example compare_levels`

use quad_dynamics::{AnyQuadrotor, Level, Vehicle};
use quad_estimation::sensor::{Quality, Seen};
use quad_estimation::{Estimator, ExtendedFilter, InitialUncertainty, LevelProcess, ProcessNoise};
use quad_math::FixedStep;
use quad_ndi::{AnyController, C3, Reference, Settings};
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

const STEP_NS: u64 = 5_000_000;
const STEP_S: f64 = 5e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let vehicle = Vehicle::qball_x4();
    let start = [0.0, 0.0, -1.5].into();
    println!("filter    position  velocity  tilt      (root mean square, then as stated)");
    for level in Level::ALL {
        let phenomena = Level::Five.phenomena();
        let mut truth = AnyQuadrotor::hovering(Level::Five, &vehicle, &phenomena, start, 0.0)?;
        let mut settings = Settings::default();
        settings.position.settling_time_s = 5.0;
        let mut pilot = AnyController::C3(C3::new(&vehicle, &settings)?.into());
        let mut input = truth.hover_input();

        let suite = Quality::Poor.suite();
        let noise = ProcessNoise::default().with_drifts_of(suite.sensors());
        let process = LevelProcess::new(level, &vehicle, &level.phenomena(), noise)?;
        let uncertain = InitialUncertainty::default().with_biases_of(suite.sensors());
        let belief = process.belief(&truth.snapshot(&input), &input, &uncertain)?;
        let memory_ns = suite.longest_delay_ns() + STEP_NS;
        let mut estimator = Estimator::new(ExtendedFilter::new(process, belief)?, input, memory_ns);
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut sensors = suite.turned_on(&mut random);

        let (mut found, mut stated, steps) = ([0.0; 3], [0.0; 3], 2000);
        for k in 1..=steps {
            let side = if (k / 500) % 2 == 0 { 0.0 } else { 1.0 };
            let reference = Reference::hold([0.0, side, -1.5].into(), 0.0);
            input.commands = pilot.update(&truth.flight(), &reference, STEP_S);
            truth.step(FixedStep::Rk4, &input, STEP_S);
            estimator.predict(&input, k * STEP_NS)?;
            let seen = Seen::of(&truth, &input);
            for reading in suite.sample(&mut sensors, k * STEP_NS, &seen, &mut random) {
                estimator.update(&reading)?;
            }
            let estimate = estimator.estimate();
            let error = estimate.error(&truth.snapshot(&input).body).vector();
            for (i, (from, n)) in [(0, 3), (3, 3), (6, 2)].into_iter().enumerate() {
                found[i] += error.rows(from, n).norm_squared();
                stated[i] += estimate.covariance.diagonal().rows(from, n).sum();
            }
        }
        let rms = |sums: [f64; 3]| sums.map(|sum| (sum / steps as f64).sqrt());
        let ([r, v, tilt], [sr, sv, st]) = (rms(found), rms(stated));
        let (tilt, st) = (tilt.to_degrees(), st.to_degrees());
        println!("{level}   {r:.3} m   {v:.3} m/s {tilt:.2}°     {sr:.3} m, {sv:.3} m/s, {st:.2}°");
    }
    Ok(())
}
