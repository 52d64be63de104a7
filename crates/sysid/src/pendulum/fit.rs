//! The full equation of motion fitted to the angle history.

use super::history::{History, look};
use super::{AngleSample, Pendulum, PendulumError, Suspension, Swing};
use crate::estimate::{Convergence, Estimate, Goodness, Warning};
use crate::regression::{Predictor, nonlinear};
use quad_math::{Real, constant, rk4_step};
use serde::{Deserialize, Serialize};

/// Which damping is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Damping {
    /// A moment proportional to the rate.
    Viscous,
    /// That and one proportional to its square, as of a bluff body in air.
    ViscousAndQuadratic,
}

/// The fitted pendulum.
#[derive(Clone, Debug, PartialEq)]
pub struct SwingFit {
    /// Moment of inertia I about the vertical axis, kg m².
    pub inertia: Estimate,
    /// Viscous damping c, N m s/rad.
    pub viscous: Estimate,
    /// Quadratic damping d, N m s²/rad², if sought.
    pub quadratic: Option<Estimate>,
    /// Angle θ at the first sample, from rest, rad.
    pub angle: Estimate,
    /// Rate θ̇ at the first sample, rad/s.
    pub rate: Estimate,
    /// Reading at rest, rad: the sensor's bias and the origin of its angle.
    pub offset: Estimate,
    /// Periods seen.
    pub periods: f64,
    /// Fitted reading, rad, at each sample.
    pub fitted_rad: Vec<f64>,
    /// Measured minus fitted, rad.
    pub residuals_rad: Vec<f64>,
    /// How well the fit describes the history, rad.
    pub goodness: Goodness,
    /// Condition number of the scaled problem.
    pub condition_number: f64,
    /// How the iteration ended.
    pub convergence: Option<Convergence>,
    /// What a reader must know before using the numbers.
    pub warnings: Vec<Warning>,
}

/// Steps of the integration per period of the record. The phase error of RK4 is `(2π/50)⁴/120` of a period each period, 2e-6,
/// so that of I is 4e-6.
const STEPS_PER_PERIOD: f64 = 50.0;
/// Lags of the whiteness test.
const LAGS: usize = 20;

/// Fits moment of inertia, damping, start and offset to a history of the angle.
///
/// # Errors
/// A history that cannot be used: see [`PendulumError`].
pub fn fit_history(
    suspension: &Suspension,
    samples: &[AngleSample],
    damping: Damping,
) -> Result<SwingFit, PendulumError> {
    suspension.validate()?;
    let history = look(suspension, samples)?;
    match damping {
        Damping::Viscous => fit::<5>(suspension, samples, history),
        Damping::ViscousAndQuadratic => fit::<6>(suspension, samples, history),
    }
}

/// Order of the parameters; the last is left out where quadratic damping is not sought.
const INERTIA: usize = 0;
const VISCOUS: usize = 1;
const ANGLE: usize = 2;
const RATE: usize = 3;
const OFFSET: usize = 4;
const QUADRATIC: usize = 5;

fn fit<const N: usize>(
    suspension: &Suspension,
    samples: &[AngleSample],
    history: History,
) -> Result<SwingFit, PendulumError> {
    let angles: Vec<f64> = samples.iter().map(|s| s.angle_rad).collect();
    let record = Record {
        suspension,
        samples,
        longest_step_s: history.period_s / STEPS_PER_PERIOD,
    };
    let start = start(suspension, samples, &history);
    let found = nonlinear(&angles, &record, std::array::from_fn::<f64, N, _>(|i| start[i]))?
        .with_whiteness_checked(LAGS);
    let mut warnings = history.warnings;
    warnings.extend(found.warnings);
    Ok(SwingFit {
        inertia: found.parameters[INERTIA],
        viscous: found.parameters[VISCOUS],
        quadratic: found.parameters.get(QUADRATIC).copied(),
        angle: found.parameters[ANGLE],
        rate: found.parameters[RATE],
        offset: found.parameters[OFFSET],
        periods: history.periods,
        fitted_rad: angles.iter().zip(&found.residuals).map(|(y, r)| y - r).collect(),
        residuals_rad: found.residuals,
        goodness: found.goodness,
        condition_number: found.condition_number,
        convergence: found.convergence,
        warnings,
    })
}

/// Where the iteration starts: inertia from the mean period at the mean amplitude, damping from the decrement.
fn start(suspension: &Suspension, samples: &[AngleSample], history: &History) -> [f64; 6] {
    let amplitudes = &history.amplitudes;
    let mean = amplitudes.iter().sum::<f64>() / amplitudes.len() as f64;
    let mut inertia = suspension.inertia_of(history.period_s);
    // The period is nearly proportional to √I: a fixed point in a few rounds.
    for _ in 0..8 {
        inertia *= (history.period_s / suspension.period(inertia, mean)).powi(2);
    }
    let half_swings = (amplitudes.len() - 1).max(1) as f64;
    let decrement = (amplitudes[0] / amplitudes[amplitudes.len() - 1]).ln() / half_swings;
    let viscous = (4.0 * inertia * decrement / history.period_s).max(0.0);
    let first = samples[0].time_s;
    let window: Vec<&AngleSample> = samples
        .iter()
        .take_while(|s| s.time_s - first <= 0.1 * history.period_s)
        .collect();
    let (begin, end) = (samples[0], window[window.len() - 1]);
    let span = end.time_s - begin.time_s;
    let rate = if span > 0.0 {
        (end.angle_rad - begin.angle_rad) / span
    } else {
        0.0
    };
    [
        inertia,
        viscous,
        begin.angle_rad - history.middle,
        rate,
        history.middle,
        0.0,
    ]
}

/// The pendulum's reading at the times of a record.
struct Record<'a> {
    suspension: &'a Suspension,
    samples: &'a [AngleSample],
    /// Longest step of the integration, s.
    longest_step_s: f64,
}

impl<const N: usize> Predictor<N> for Record<'_> {
    fn predict<R: Real>(&self, p: &[R; N]) -> Vec<R> {
        let pendulum = Pendulum {
            suspension: *self.suspension,
            inertia: p[INERTIA],
            viscous: p[VISCOUS],
            quadratic: p.get(QUADRATIC).copied().unwrap_or_else(R::zero),
        };
        let mut swing = Swing {
            angle: p[ANGLE],
            rate: p[RATE],
        };
        let mut readings = vec![swing.angle + p[OFFSET]];
        for pair in self.samples.windows(2) {
            let span_s = pair[1].time_s - pair[0].time_s;
            let steps = (span_s / self.longest_step_s).ceil().max(1.0);
            let step: R = constant(span_s / steps);
            for _ in 0..steps as usize {
                swing = rk4_step(&pendulum, &swing, &(), step);
            }
            readings.push(swing.angle + p[OFFSET]);
        }
        readings
    }
}
