//! A measurement that comes late tells as much as if it had come in time.

use crate::support::{generator, hovering, normals, process, scaled_difference};
use quad_dynamics::{Input, Level};
use quad_estimation::sensor::{Instrument, Measurement};
use quad_estimation::{Estimator, ExtendedFilter, Filter, LevelProcess, Spread, UnscentedFilter};

fn measurements() -> Vec<Measurement> {
    let mut random = generator(11);
    let mut all = Vec::new();
    for k in 1..=20_u64 {
        let noise = normals(6, &mut random);
        let taken = |instrument, taken_ns, values, deviation| Measurement {
            instrument,
            taken_ns,
            arrives_ns: taken_ns,
            values,
            deviation,
        };
        let rates = vec![0.01 * noise[0], 0.01 * noise[1], 0.01 * noise[2]];
        all.push(taken(Instrument::Gyroscope, 10_000_000 * k, rates, 0.01));
        if k % 5 == 2 {
            let at = vec![0.1 * noise[3], 0.1 * noise[4], -1.0 + 0.1 * noise[5]];
            // Between two of the filter's instants.
            all.push(taken(
                Instrument::PositionFix,
                10_000_000 * k + 3_000_000,
                at,
                0.1,
            ));
        }
    }
    all
}

/// Steps of 10 ms, each reading taken in `delay_ns` after its fix was taken.
fn run<F: Filter<Process = LevelProcess>>(
    filter: F,
    input: Input<f64>,
    delay_ns: u64,
    instants: &[u64],
) -> F {
    let mut estimator = Estimator::new(filter, input, 60_000_000);
    let mut waiting = measurements();
    for (k, &now_ns) in instants.iter().enumerate() {
        let mut input = input;
        // The same on either side of an instant that one of the runs has more.
        input.commands[2] *= 1.0 + 0.01 * ((now_ns.div_ceil(10_000_000)) % 3) as f64;
        estimator
            .predict(&input, now_ns)
            .unwrap_or_else(|e| panic!("{k}: {e}"));
        waiting.retain(|m| {
            let delay = match m.instrument {
                Instrument::PositionFix => delay_ns,
                _ => 0,
            };
            let due = m.taken_ns + delay <= now_ns;
            if due {
                estimator.update(m).expect("within its memory");
            }
            !due
        });
    }
    assert!(waiting.is_empty());
    estimator.into_filter()
}

#[test]
fn agree_late_measurements_with_timely_ones() {
    let coarse: Vec<u64> = (1..=24).map(|k| 10_000_000 * k).collect();
    // In time means an instant at each fix.
    let mut fine = coarse.clone();
    fine.extend(
        measurements()
            .iter()
            .filter(|m| m.instrument == Instrument::PositionFix)
            .map(|m| m.taken_ns),
    );
    fine.sort_unstable();
    let p = process(Level::Four);
    let (belief, input) = (hovering(&p), p.hover_input());
    let extended = || ExtendedFilter::new(p.clone(), belief.clone()).expect("same size");
    let timely = run(extended(), input, 0, &fine);
    for delay_ns in [1, 20_000_000, 47_000_000] {
        let late = run(extended(), input, delay_ns, &coarse);
        // The same operations in the same order.
        assert_eq!(late.belief(), timely.belief(), "{delay_ns} ns");
    }
    let unscented = || UnscentedFilter::new(p.clone(), belief.clone(), Spread::default()).expect("same size");
    let timely_points = run(unscented(), input, 0, &fine);
    let late_points = run(unscented(), input, 20_000_000, &coarse);
    assert_eq!(late_points.belief(), timely_points.belief());
    // So short a flight so near hover is almost linear: the two filters differ by curvature, a per cent of a variance.
    let difference = scaled_difference(&timely_points.belief().covariance, &timely.belief().covariance);
    assert!(difference < 0.02, "{difference}");
}
