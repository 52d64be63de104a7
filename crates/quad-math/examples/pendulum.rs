//! One model, many uses: a pendulum stepped, integrated to a tolerance, linearised and batched.
//!
//! Prints a short report: `cargo run -p quad-math --example pendulum`.

use nalgebra::{SimdValue, Vector2};
use quad_math::{
    AdaptiveOptions, DormandPrince, Dual, F64x4, FixedStep, Real, Segment, Simulation, TimeGrid, constant,
    jacobian, rk4,
};
use std::error::Error;

/// Gravity over length, 1/s² (a pendulum of one metre).
const STIFFNESS: f64 = 9.81;

/// `φ̈ = -(g/l) sin φ`, state `(φ, φ̇)` in rad and rad/s.
fn swing<R: Real>(x: &Vector2<R>) -> Vector2<R> {
    Vector2::new(x.y, -x.x.simd_sin() * constant(STIFFNESS))
}

/// Energy over `m l²`, 1/s²: constant along the exact motion.
fn energy(x: &Vector2<f64>) -> f64 {
    0.5 * x.y * x.y - STIFFNESS * x.x.cos()
}

fn main() -> Result<(), Box<dyn Error>> {
    let start = Vector2::new(1.0, 0.0);
    let end_s = 20.0;

    // Three orders of magnitude finer than the best of the fixed steps below.
    let options = AdaptiveOptions {
        absolute_tolerance: 1e-12,
        relative_tolerance: 1e-12,
        ..AdaptiveOptions::default()
    };
    let accurate = DormandPrince::new(options)?.run(|_, x| swing(x), 0.0..end_s, start)?;
    println!("Pendulum of 1 m let go at 1 rad, {end_s} s");
    println!(
        "adaptive:   φ = {:+.9} rad, {} steps accepted, {} rejected, {} evaluations",
        accurate.last.state.x,
        accurate.statistics.accepted,
        accurate.statistics.rejected,
        accurate.statistics.evaluations,
    );

    println!("\nfixed step   h, ms   error of φ, rad   drift of energy, 1/s²");
    for (name, method) in [("Euler", FixedStep::Euler), ("RK4", FixedStep::Rk4)] {
        for step_s in [0.01, 0.005] {
            let grid = TimeGrid::from_seconds(step_s, end_s)?;
            let run = Simulation {
                method,
                ..Simulation::on(grid)
            }
            .run(|_, x| swing(x), start);
            let worst = run
                .samples
                .iter()
                .filter_map(|sample| Some((sample.state.x - accurate.at(sample.time_s)?.x).abs()))
                .fold(0.0, f64::max);
            let drift = run
                .samples
                .last()
                .map_or(f64::NAN, |last| energy(&last.state) - energy(&start));
            println!("{name:10} {:>7} {worst:>17.1e} {drift:>23.1e}", step_s * 1e3);
        }
    }

    let a = jacobian(|x: &[Dual<2>; 2]| swing(&Vector2::from(*x)).into(), [0.0, 0.0]);
    let frequency = (-a[(1, 0)]).sqrt();
    println!(
        "\nlinearised about rest: ω = {frequency:.4} rad/s (√(g/l) = {:.4})",
        STIFFNESS.sqrt()
    );

    let angles = [0.1, 0.5, 1.0, 2.0];
    let mut lanes = Vector2::new(F64x4::from(angles), F64x4::splat(0.0));
    for _ in 0..100 {
        lanes = rk4(
            &|_, x: &Vector2<F64x4>| swing(x),
            constant(0.0),
            &lanes,
            constant(0.01),
        );
    }
    println!("\nfour pendulums in lanes, after 1 s:");
    for (lane, angle) in angles.into_iter().enumerate() {
        println!("  from {angle:.1} rad: φ = {:+.6} rad", lanes.x.extract(lane));
    }

    let lift = Segment::<f64, 6>::new([0.0; 3], [1.0, 0.0, 0.0], 2.0)?;
    println!("\nminimum-jerk move of 1 rad in 2 s:  t, s   φ, rad   φ̇, rad/s   φ̈, rad/s²");
    for t in [0.0, 0.5, 1.0, 1.5, 2.0] {
        let [value, rate, acceleration] = lift.derivatives(t);
        println!("{t:>41.1} {value:>8.4} {rate:>10.4} {acceleration:>12.4}");
    }
    Ok(())
}
