//! Published step responses of a motor (data/README.md, `ntnu_motor`): not part of the repository.

use super::*;
use std::path::PathBuf;

/// The file below `QUAD_DATA` or `data/external`; `None`, with a printed line, where it is not there.
///
/// # Panics
/// In continuous integration, where the folder is named and the file must be in it.
fn external(relative: &str) -> Option<PathBuf> {
    let named = std::env::var_os("QUAD_DATA");
    let folder = named.as_ref().map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/external")),
        PathBuf::from,
    );
    let path = folder.join(relative);
    if path.is_file() {
        return Some(path);
    }
    let in_ci = std::env::var_os("CI").is_some_and(|value| !value.is_empty());
    assert!(!(in_ci && named.is_some()), "{} is missing", path.display());
    println!(
        "skipped: {} is not there (data/README.md says where to get it)",
        path.display()
    );
    None
}

/// Samples before a step that each record begins with: a tenth of a second at rest.
const LEAD: usize = 5;

/// Steps of the staircase at the record's beginning; after it come swings of 1559 to 2078.
const STAIRCASE: usize = 4;

/// Time constants of each step of a record.
fn time_constants(samples: &[ResponseSample]) -> Vec<Estimate> {
    let steps: Vec<usize> = (1..samples.len())
        .filter(|&k| samples[k].input != samples[k - 1].input)
        .collect();
    let ends = steps[1..].iter().copied().chain([samples.len()]);
    let fit = |(&step, end): (&usize, usize)| {
        let record = Record::new(&samples[step - LEAD..end]).unwrap();
        let fit = identify(&record, Structure::FirstOrder, Start::Equilibrium).unwrap();
        let Coefficients::FirstOrder { bandwidth } = fit.coefficients else {
            panic!()
        };
        let time_constant = bandwidth.mapped(1.0 / bandwidth.value, bandwidth.value.powi(-2));
        let (from, to) = (samples[step - 1].input, samples[step].input);
        let (value, half_width) = (time_constant.value, time_constant.half_width());
        println!(
            "{from:>6.0} to {to:>6.0}: {value:.4} ± {half_width:.4} s, fit {:.1} %",
            fit.fit_percent
        );
        time_constant
    };
    steps.iter().zip(ends).map(fit).collect()
}

#[test]
fn data_time_constants_of_a_motor_up_and_down() {
    let Some(path) = external("ntnu_motor/sample_time_const_data.csv") else {
        return;
    };
    let samples: Vec<ResponseSample> = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_path(path)
        .unwrap()
        .deserialize()
        .map(Result::unwrap)
        .collect();
    let found = time_constants(&samples);
    assert_eq!(found.len(), 7);
    // Published for a first-order fit: 0.019 to 0.022 s up and 0.026 to 0.050 s down. A motor is no first-order system (the
    // residuals are not white), so fits that treat its start and end otherwise differ by up to the interval's width: the
    // intervals must meet the published ranges. The swing up from 221 to 1780 takes as long as the range for 'down' begins.
    let meets = |estimate: &Estimate, from: f64, to: f64| {
        let interval = estimate.interval();
        interval.lower <= to && interval.upper >= from
    };
    for up in &found[..STAIRCASE] {
        assert!(meets(up, 0.019, 0.022), "{up:?}");
        // And narrowly, so that meeting is no accident.
        assert!(up.half_width() < 0.0025, "{up:?}");
    }
    for swing in &found[STAIRCASE..] {
        assert!(meets(swing, 0.026, 0.050), "{swing:?}");
        assert!(swing.half_width() < 0.008, "{swing:?}");
    }
    // The same swing down takes longer than up: the motor is driven up, but only coasts down.
    let (down, up) = (found[6].interval(), found[5].interval());
    assert!(down.lower > up.upper);
}
