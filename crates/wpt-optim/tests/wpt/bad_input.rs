//! Questions that can't be asked.

use crate::nominal;
use quad_dynamics::Level;
use wpt_optim::{Choice, Decision, Mission, Penalties, Problem, ProblemError, Weights};

fn posed(
    change: impl FnOnce(&mut Mission, &mut Vec<Decision>, &mut Weights),
) -> Result<Problem, ProblemError> {
    let (mut mission, mut decisions) = (Mission::nominal(2.0), Choice::Two.decisions());
    let mut weights = Weights::default();
    change(&mut mission, &mut decisions, &mut weights);
    Problem::new(mission, Level::Three, decisions, &weights, &Penalties::default())
}

/// The message of the refusal.
fn refusal(change: impl FnOnce(&mut Mission, &mut Vec<Decision>, &mut Weights)) -> String {
    posed(change).expect_err("it must be refused").to_string()
}

#[test]
fn exact_errors_of_variables() {
    assert!(refusal(|_, d, _| d.clear()).contains("at least one"));
    assert!(refusal(|_, d, _| d[1] = d[0]).contains("variable \"x_0\" is listed twice"));
    for (lower, upper) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let message = refusal(|_, d, _| (d[0].lower, d[0].upper) = (lower, upper));
        assert!(
            message.contains("variable \"x_0\": bounds must be finite"),
            "{message}"
        );
    }
    assert!(refusal(|_, d, _| d[1].start = 9.0).contains("variable \"x_f\": the start must lie within"));
    assert!(refusal(|_, d, _| d[1].start = f64::NAN).contains("got NaN"));
}

#[test]
fn exact_errors_of_the_mission_and_weights() {
    assert!(
        refusal(|m, _, _| m.start.velocity_m_s[1] = f64::NAN).contains("y_dot_0_m_s must be finite, got NaN")
    );
    assert!(refusal(|m, _, _| m.duration_s = 2.001).contains("got 2.001 s"));
    assert!(refusal(|m, _, _| m.duration_s = -2.0).contains("-2"));
    assert!(
        refusal(|m, _, _| m.step = m.station_step.times(2)).contains("must be a multiple of the vehicle's")
    );
    assert!(refusal(|m, _, _| m.station.frames.noise = 1.0).contains("got 1 px"));
    assert!(
        refusal(|m, _, _| m.station.limits.range = 0.0)
            .contains("limits.range must be finite and positive, got 0")
    );
    assert!(
        refusal(|_, _, w| w.spot = -1.0).contains("weights.spot must be finite and not negative, got -1")
    );
    assert!(
        refusal(|_, _, w| w.range = f64::NAN)
            .contains("weights.range must be finite and not negative, got NaN")
    );
    assert!(refusal(|_, _, w| w.range = 1e308).contains("weights.range must be at most 100"));
}

#[test]
fn exact_errors_of_decisions() {
    let problem = nominal(Choice::Two, 2.0, Level::One);
    assert!(matches!(
        problem.evaluate(&[1.0]),
        Err(ProblemError::WrongLength {
            expected: 2,
            found: 1
        })
    ));
    let message = problem.evaluate(&[1.0, f64::NAN]).unwrap_err().to_string();
    assert!(message.contains("x_f_m must be finite, got NaN"));
    assert!(problem.gradient(&[f64::INFINITY, 0.0]).is_err());
    assert!(problem.ideal(&[0.0; 3]).is_err());
    assert!(problem.evaluate_all(&[vec![1.0, 2.0], vec![1.0]]).is_err());
}
