//! The adaptive run itself: error norm, starting step, step control.

use super::{AdaptiveOptions, AdaptiveRun, AdaptiveStatistics, AdaptiveStatus, dormand_prince_step};
use crate::{Flat, Rate, Sample, State};

/// Part of the step that the optimum is multiplied with, so that the next step rarely fails.
const SAFETY: f64 = 0.9;
/// A step shrinks to this fraction of itself at most.
const LARGEST_SHRINK: f64 = 0.2;
/// A step grows by this factor at most.
const LARGEST_GROWTH: f64 = 10.0;
/// Exponent of the previous step's error (the integral part).
const BETA: f64 = 0.04;
/// Exponent of this step's error: 1/5 for the local error `O(h⁵)`, less what the integral part takes over.
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// The previous error counts as no less than this.
const SMALLEST_PREVIOUS_ERROR: f64 = 1e-4;
/// A step whose numbers are not finite is repeated with this fraction of it.
const NOT_FINITE_SHRINK: f64 = 0.1;
/// Steps below this many units in the last place of time no longer advance it reliably.
const STEP_FLOOR_ULPS: f64 = 4.0;

/// Weighted norms of rates, with their scratch space.
struct Norm {
    absolute: f64,
    relative: f64,
    scale: Vec<f64>,
    flat: Vec<f64>,
}

impl Norm {
    fn new<X: Flat<f64>>(options: &AdaptiveOptions) -> Self {
        Self {
            absolute: options.absolute_tolerance,
            relative: options.relative_tolerance,
            scale: vec![options.absolute_tolerance; X::LEN],
            flat: vec![0.0; X::LEN],
        }
    }

    /// Sets `scale = atol + rtol max(|a|, |b|)`; false if `a` or `b` is not finite.
    fn scale_to<X: Flat<f64>>(&mut self, a: &X, b: &X) -> bool {
        a.write(&mut self.flat);
        b.write(&mut self.scale);
        let mut finite = true;
        for (scale, &a) in self.scale.iter_mut().zip(&self.flat) {
            finite &= a.is_finite() && scale.is_finite();
            *scale = self.absolute + self.relative * a.abs().max(scale.abs());
        }
        finite
    }

    /// Root mean square of the numbers over their scale; NaN or infinite if one of them is.
    fn of<F: Flat<f64>>(&mut self, numbers: &F) -> f64 {
        numbers.write(&mut self.flat);
        let squares = self
            .flat
            .iter()
            .zip(&self.scale)
            .map(|(value, scale)| (value / scale).powi(2));
        (squares.sum::<f64>() / F::LEN.max(1) as f64).sqrt()
    }
}

/// A run in progress.
pub(super) struct Stepper<'a, F, X: State<f64>> {
    f: &'a F,
    options: &'a AdaptiveOptions,
    end_s: f64,
    norm: Norm,
    run: AdaptiveRun<X>,
}

impl<'a, F, X> Stepper<'a, F, X>
where
    F: Fn(f64, &X) -> X::Rate,
    X: State<f64> + Flat<f64>,
    X::Rate: Flat<f64>,
{
    pub(super) fn new(options: &'a AdaptiveOptions, f: &'a F, start_s: f64, end_s: f64, initial: X) -> Self {
        let start = Sample {
            time_s: start_s,
            state: initial,
        };
        let run = AdaptiveRun {
            initial: start,
            steps: Vec::new(),
            last: start,
            status: AdaptiveStatus::Completed,
            statistics: AdaptiveStatistics::default(),
        };
        Self {
            f,
            options,
            end_s,
            norm: Norm::new::<X>(options),
            run,
        }
    }

    pub(super) fn run(mut self) -> AdaptiveRun<X> {
        self.run.status = self.advance();
        self.run
    }

    /// `f`, counted.
    fn rate(&mut self, t: f64, x: &X) -> X::Rate {
        self.run.statistics.evaluations += 1;
        (self.f)(t, x)
    }

    /// Steps to the end or to a failure.
    fn advance(&mut self) -> AdaptiveStatus<X> {
        let Sample {
            mut time_s,
            mut state,
        } = self.run.initial;
        let mut rate = self.rate(time_s, &state);
        if !(self.norm.scale_to(&state, &state) && self.norm.of(&rate).is_finite()) {
            return AdaptiveStatus::NotFinite { time_s, state };
        }
        if time_s == self.end_s {
            return AdaptiveStatus::Completed;
        }
        let estimate = self
            .options
            .initial_step_s
            .unwrap_or_else(|| self.starting_step(&rate));
        let mut step_s = estimate.min(self.options.maximum_step_s);
        let smallest_s = STEP_FLOOR_ULPS * f64::EPSILON * time_s.abs().max(self.end_s.abs());
        let mut previous_error = SMALLEST_PREVIOUS_ERROR;
        let mut was_rejected = false;
        let mut was_finite = true;

        for _ in 0..self.options.maximum_steps {
            let remaining_s = self.end_s - time_s;
            let is_last = remaining_s <= step_s;
            if step_s <= smallest_s && !is_last {
                return if was_finite {
                    AdaptiveStatus::StepTooSmall { time_s, step_s }
                } else {
                    AdaptiveStatus::NotFinite { time_s, state }
                };
            }
            // Two equal steps to the end rather than a whole one and a sliver.
            let h = if is_last {
                remaining_s
            } else {
                step_s.min(remaining_s / 2.0)
            };
            let trial = dormand_prince_step(self.f, time_s, &state, rate, h);
            self.run.statistics.evaluations += 6;
            let is_finite = self.norm.scale_to(&state, &trial.dense.end);
            let error = h * self.norm.of(&trial.error_rate);

            if is_finite && error <= 1.0 {
                let factor = SAFETY * error.powf(-ALPHA) * previous_error.powf(BETA);
                let growth = if was_rejected { 1.0 } else { LARGEST_GROWTH };
                step_s = (h * factor.clamp(LARGEST_SHRINK, growth)).min(self.options.maximum_step_s);
                previous_error = error.max(SMALLEST_PREVIOUS_ERROR);
                (was_rejected, was_finite) = (false, true);
                time_s = if is_last { self.end_s } else { time_s + h };
                (state, rate) = (trial.dense.end, trial.dense.end_rate);
                self.run.statistics.accepted += 1;
                self.run.steps.push(trial.dense);
                self.run.last = Sample { time_s, state };
                if is_last {
                    return AdaptiveStatus::Completed;
                }
            } else {
                was_finite = is_finite && error.is_finite();
                let optimum = (SAFETY * error.powf(-ALPHA)).max(LARGEST_SHRINK);
                step_s = h * if was_finite { optimum } else { NOT_FINITE_SHRINK };
                was_rejected = true;
                self.run.statistics.rejected += 1;
            }
        }
        AdaptiveStatus::TooManySteps { time_s }
    }

    /// First step from the sizes of `x`, `ẋ` and an estimate of `ẍ` (Hairer, Nørsett, Wanner, II.4): about
    /// a hundredth of the tolerance in the local error. `norm` must be scaled to the initial state.
    fn starting_step(&mut self, rate: &X::Rate) -> f64 {
        /// Norms below this say nothing about a scale of time.
        const NEGLIGIBLE: f64 = 1e-5;
        /// First guess where they do not, s.
        const BLIND_GUESS_S: f64 = 1e-6;
        /// An explicit Euler step changes the state by this part of itself.
        const EULER_PART: f64 = 0.01;

        let Sample { time_s, state } = self.run.initial;
        let span_s = self.end_s - time_s;
        let (size, speed) = (self.norm.of(&state), self.norm.of(rate));
        let guess = if size < NEGLIGIBLE || speed < NEGLIGIBLE {
            BLIND_GUESS_S
        } else {
            EULER_PART * size / speed
        }
        .min(span_s);
        let ahead = self.rate(time_s + guess, &state.advanced(guess, rate));
        let acceleration = self.norm.of(&ahead.add_scaled(-1.0, rate)) / guess;
        let steepest = speed.max(acceleration);
        // 1e-15 and 1e-3: no information at all; take a cautious multiple of the guess (as DOPRI5).
        let by_order = if steepest <= 1e-15 {
            BLIND_GUESS_S.max(guess * 1e-3)
        } else {
            (EULER_PART / steepest).powf(0.2)
        };
        // If the step ahead was not finite, the loop below will find out by itself.
        let step_s = (100.0 * guess).min(by_order);
        if step_s.is_finite() && step_s > 0.0 {
            step_s.min(span_s)
        } else {
            guess
        }
    }
}
