//! A measurement that comes late tells as much as if it had come in time.

use crate::support::{generator, hovering, normals, process, scaled_difference};
use quad_dynamics::{Input, Level};
use quad_estimation::sensor::{Instrument, Measurement};
use quad_estimation::{
    AnyFilter, Estimator, EstimatorMemory, ExtendedFilter, Filter, LevelProcess, Spread, UnscentedFilter,
};

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
    run_with(filter, input, delay_ns, instants, |_| ())
}

/// The same, with something done at the end of every instant.
fn run_with<F: Filter<Process = LevelProcess>>(
    filter: F,
    input: Input<f64>,
    delay_ns: u64,
    instants: &[u64],
    mut at_end: impl FnMut(&mut Estimator<F>),
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
        at_end(&mut estimator);
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

/// An estimator that is put away and taken up at every instant, fixes on their way, believes the same bit for bit.
#[test]
fn agree_a_recalled_estimator_with_one_that_was_never_put_away() {
    let instants: Vec<u64> = (1..=24).map(|k| 10_000_000 * k).collect();
    let p = process(Level::Four);
    let (belief, input) = (hovering(&p), p.hover_input());
    let filter = || AnyFilter::Extended(ExtendedFilter::new(p.clone(), belief.clone()).expect("same size"));
    let whole = run(filter(), input, 47_000_000, &instants);
    let recalled = run_with(filter(), input, 47_000_000, &instants, |estimator| {
        let written = serde_json::to_value(estimator.memory()).expect("finite numbers");
        let memory: EstimatorMemory = serde_json::from_value(written).expect("what was written");
        let mut other = Estimator::new(filter(), input, 60_000_000);
        other.recall(&memory).expect("the same filter");
        assert_eq!(other.memory(), memory);
        assert_eq!(other.now_ns(), estimator.now_ns());
        *estimator = other;
    });
    assert_eq!(recalled.belief(), whole.belief());
}

#[test]
fn exact_memories_that_can_not_be_are_refused() {
    let p = process(Level::Three);
    let (belief, input) = (hovering(&p), p.hover_input());
    let filter = ExtendedFilter::new(p, belief.clone()).expect("same size");
    let mut estimator = Estimator::new(filter, input, 60_000_000);
    estimator.predict(&input, 10_000_000).expect("finite commands");
    let good = estimator.memory();
    let spoilt: [fn(&mut EstimatorMemory); 7] = [
        |memory| memory.mean.clear(),
        |memory| memory.mean[3] = f64::NAN,
        |memory| memory.covariance[0] = -1.0,
        |memory| memory.covariance.truncate(1),
        |memory| memory.instants.clear(),
        |memory| memory.instants[1].time_ns = 0,
        |memory| memory.instants[1].commands[2] = f64::INFINITY,
    ];
    let before = estimator.filter().belief().clone();
    for (k, spoil) in spoilt.into_iter().enumerate() {
        let mut memory = good.clone();
        spoil(&mut memory);
        assert!(estimator.recall(&memory).is_err(), "{k}");
        assert_eq!(estimator.filter().belief(), &before, "{k}");
        assert_eq!(estimator.memory(), good, "{k}");
    }
    // A belief begun anew forgets what was before.
    estimator.restart(belief.clone(), input).expect("same size");
    assert_eq!(estimator.filter().belief(), &belief);
    assert_eq!(
        (estimator.oldest_ns(), estimator.now_ns()),
        (10_000_000, 10_000_000)
    );
}
