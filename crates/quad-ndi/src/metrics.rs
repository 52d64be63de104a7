//! What a step response and a flight are judged by.

use quad_dynamics::CommandLimits;

/// Band around the final value that counts as settled, as a fraction of the step.
const SETTLED: f64 = 0.02;

/// Share of the end of a response that its steady state is averaged over.
const TAIL: f64 = 0.05;

/// How a response went from its start to its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepMetrics {
    /// Time after which the response stays within 2 % of the step around the target, s; `None` if it never
    /// does.
    pub settling_time_s: Option<f64>,
    /// Largest excursion beyond the target as a fraction of the step; 0 if there is none.
    pub overshoot: f64,
    /// Target minus mean of the last 5 % of the response, in the response's unit.
    pub steady_state_error: f64,
    /// Root mean square of target minus response, in the response's unit.
    pub rms_error: f64,
}

impl StepMetrics {
    /// The metrics of a response `y(t)`, given as points `(t, y)` in order of time, to a step from its first
    /// value to `target`; `None` without points or without a step.
    ///
    /// The error is integrated by the trapezoidal rule, so samples need not be even.
    pub fn of(response: &[(f64, f64)], target: f64) -> Option<Self> {
        let (&(start_s, start), &(end_s, _)) = (response.first()?, response.last()?);
        let step = target - start;
        if step == 0.0 || !step.is_finite() {
            return None;
        }
        let last_outside = response
            .iter()
            .rposition(|&(_, y)| (target - y).abs() > SETTLED * step.abs());
        let settling_time_s = match last_outside {
            None => Some(0.0),
            Some(i) => response.get(i + 1).map(|&(t, _)| t - start_s),
        };
        let overshoot = response
            .iter()
            .map(|&(_, y)| (y - target) / step)
            .fold(0.0, f64::max);
        let tail_from = end_s - TAIL * (end_s - start_s);
        let tail: Vec<f64> = response
            .iter()
            .filter(|(t, _)| *t >= tail_from)
            .map(|(_, y)| *y)
            .collect();
        let steady_state_error = target - tail.iter().sum::<f64>() / tail.len() as f64;
        Some(Self {
            settling_time_s,
            overshoot,
            steady_state_error,
            rms_error: rms(response, |_| target),
        })
    }
}

/// Root mean square over time of `target(t) − y(t)`, for points `(t, y)` in order of time.
pub fn rms(response: &[(f64, f64)], target: impl Fn(f64) -> f64) -> f64 {
    let square = |&(t, y): &(f64, f64)| (target(t) - y).powi(2);
    let span = match (response.first(), response.last()) {
        (Some(first), Some(last)) if last.0 > first.0 => last.0 - first.0,
        _ => return response.first().map_or(0.0, |point| square(point).sqrt()),
    };
    let area: f64 = response
        .windows(2)
        .map(|p| (p[1].0 - p[0].0) * (square(&p[0]) + square(&p[1])) / 2.0)
        .sum();
    (area / span).sqrt()
}

/// What a flight cost in control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Root mean square of the commands' distance from hover, over time and rotors, duty.
    pub rms_command: f64,
    /// Time during which at least one command is at a limit, s; 0 without limits.
    pub saturation_time_s: f64,
}

impl Effort {
    /// The effort of commands `(t, u)` in order of time, measured from the hover commands.
    pub fn of(commands: &[(f64, [f64; 4])], hover: &[f64; 4], limits: Option<&CommandLimits<f64>>) -> Self {
        let distance = |commands: &[f64; 4]| {
            let squares = commands.iter().zip(hover).map(|(u, h)| (u - h).powi(2));
            (squares.sum::<f64>() / 4.0).sqrt()
        };
        let points: Vec<(f64, f64)> = commands.iter().map(|(t, u)| (*t, distance(u))).collect();
        let saturated =
            |u: &[f64; 4]| limits.is_some_and(|l| u.iter().any(|&u| u <= l.minimum || u >= l.maximum));
        let saturation_time_s = commands
            .windows(2)
            .filter(|w| saturated(&w[0].1))
            .map(|w| w[1].0 - w[0].0)
            // Not `sum`, which of nothing is −0.
            .fold(0.0, |total, held| total + held);
        Self {
            rms_command: rms(&points, |_| 0.0),
            saturation_time_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_first_order_response() {
        // y = 1 − e^(−t): inside 2 % from t = ln 50 on, RMS error over [0, T] = √((1 − e^(−2T)) / 2T).
        let end = 10.0_f64;
        let response: Vec<(f64, f64)> = (0..=10_000)
            .map(|k| f64::from(k) * 1e-3)
            .map(|t| (t, 1.0 - (-t).exp()))
            .collect();
        let m = StepMetrics::of(&response, 1.0).expect("a step");
        // One sample of 1 ms late at most.
        assert!((m.settling_time_s.expect("settled") - 50.0_f64.ln()).abs() <= 1e-3);
        assert_eq!(m.overshoot, 0.0);
        // Trapezoidal rule: h²/12 · (largest second derivative 4) · T.
        assert!((m.rms_error - ((1.0 - (-2.0 * end).exp()) / (2.0 * end)).sqrt()).abs() < 1e-5);
        // Mean of e^(−t) over the last half second is at most e^(−9.5).
        assert!(m.steady_state_error > 0.0 && m.steady_state_error < (-9.5_f64).exp());
    }

    #[test]
    fn exact_downward_step_with_overshoot() {
        let response = [(0.0, 1.0), (1.0, -0.25), (2.0, 0.0), (3.0, 0.0)];
        let m = StepMetrics::of(&response, 0.0).expect("a step");
        assert_eq!(
            (m.settling_time_s, m.overshoot, m.steady_state_error),
            (Some(2.0), 0.25, 0.0)
        );
        assert_eq!(StepMetrics::of(&response, 1.0), None);
        assert_eq!(StepMetrics::of(&[], 1.0), None);
        let never = StepMetrics::of(&[(0.0, 0.0), (1.0, 0.5)], 1.0).expect("a step");
        assert_eq!(never.settling_time_s, None);
    }
}
