use super::SUSPENSION;
use crate::estimate::Warning;
use crate::laboratory::generator;
use crate::laboratory::pendulum::{Axis, PendulumRig};
use crate::pendulum::{
    AngleSample, Damping, PendulumError, Suspension, SwingFit, Timing, fit_history, from_timings,
};
use crate::regression::FitError;
use quad_dynamics::Vehicle;

fn record(rig: &PendulumRig) -> Vec<AngleSample> {
    rig.swing(&Vehicle::qball_x4(), Axis::Roll, &mut generator(5))
        .unwrap()
}

fn fitted(samples: &[AngleSample]) -> Result<SwingFit, PendulumError> {
    fit_history(&SUSPENSION, samples, Damping::ViscousAndQuadratic)
}

#[test]
fn exact_refusals_of_histories() {
    let good = record(&PendulumRig::default());
    let changed = |change: fn(&mut Vec<AngleSample>)| {
        let mut bad = good.clone();
        change(&mut bad);
        fitted(&bad)
    };
    assert!(matches!(
        changed(|s| s[7].angle_rad = f64::NAN),
        Err(PendulumError::NotFinite { index: 7 })
    ));
    assert!(matches!(
        changed(|s| s[7].time_s = s[6].time_s),
        Err(PendulumError::TimeNotIncreasing { index: 7, .. })
    ));
    assert!(matches!(
        changed(|s| s.iter_mut().for_each(|s| s.angle_rad = s.angle_rad.to_degrees())),
        Err(PendulumError::Angle { .. })
    ));
    assert!(matches!(
        changed(|s| s.iter_mut().for_each(|s| s.angle_rad = 0.2)),
        Err(PendulumError::NoOscillation { .. })
    ));
    assert!(matches!(
        changed(Vec::clear),
        Err(PendulumError::NoOscillation { .. })
    ));
    assert!(matches!(
        changed(|s| s.truncate(60)),
        Err(PendulumError::TooFewPeriods { .. })
    ));
    let still = PendulumRig {
        release_rad: 1e-6,
        ..PendulumRig::default()
    };
    // Noise alone: von Neumann's ratio is 2.
    let Err(PendulumError::NoOscillation { roughness }) = fitted(&record(&still)) else {
        panic!("noise is no oscillation");
    };
    assert!((roughness - 2.0).abs() < 0.3);
    let short = Suspension {
        length_m: 0.1,
        ..SUSPENSION
    };
    assert!(matches!(
        fit_history(&short, &good, Damping::Viscous),
        Err(PendulumError::BeyondStrings { .. })
    ));
    let millimetres = Suspension {
        length_m: 700.0,
        ..SUSPENSION
    };
    assert!(matches!(
        fit_history(&millimetres, &good, Damping::Viscous),
        Err(PendulumError::Suspension {
            what: "string length",
            ..
        })
    ));
}

#[test]
fn exact_refusals_of_timings() {
    let timing = |periods, duration_s| Timing { periods, duration_s };
    for bad in [
        timing(0, 13.0),
        timing(20, -1.0),
        timing(20, f64::NAN),
        timing(20, 13_312.0),
    ] {
        assert!(matches!(
            from_timings(&SUSPENSION, &[timing(20, 13.0), bad]),
            Err(PendulumError::Timing { index: 1, .. })
        ));
    }
    assert!(matches!(
        from_timings(&SUSPENSION, &[timing(20, 13.0)]),
        Err(PendulumError::Fit(FitError::TooFewPoints { .. }))
    ));
}

#[test]
fn exact_warnings_of_histories() {
    let warnings = |samples: &[AngleSample]| fitted(samples).unwrap().warnings;
    let good = record(&PendulumRig::default());
    assert_eq!(warnings(&good), []);
    let few = warnings(&good[..200]);
    assert!(
        few.iter().any(|w| matches!(w, Warning::FewPeriods { .. })),
        "{few:?}"
    );
    let mut gap = good.clone();
    gap.drain(300..340);
    let gap = warnings(&gap);
    assert!(
        gap.iter().any(
            |w| matches!(w, Warning::MissingSamples { gaps: 1, longest_s } if (longest_s - 0.82).abs() < 1e-9)
        ),
        "{gap:?}"
    );
    let mut clipped = PendulumRig::default();
    clipped.angle_rad.maximum = 0.5;
    let clipped = warnings(&record(&clipped));
    assert!(
        clipped
            .iter()
            .any(|w| matches!(w, Warning::Saturated { limit, .. } if *limit == 0.5)),
        "{clipped:?}"
    );
    // A damping that is not sought leaves its trace in the residuals.
    let strong = record(&PendulumRig {
        quadratic_n_m_s2: 4e-3,
        ..PendulumRig::default()
    });
    let missed = fit_history(&SUSPENSION, &strong, Damping::Viscous)
        .unwrap()
        .warnings;
    assert!(
        missed
            .iter()
            .any(|w| matches!(w, Warning::CorrelatedResiduals { .. })),
        "{missed:?}"
    );
}
