//! What the identification of a response answers.

use super::model::{GAIN, Model, OFFSET, ZERO};
use super::{Start, Structure};
use crate::estimate::{Convergence, Estimate, Fit, Goodness, Warning};
use crate::residual::Whiteness;
use quad_math::{Dual, Real, constant, jacobian};

/// The coefficients of a transfer function, with their uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficients {
    /// `a / (s + a)`.
    FirstOrder {
        /// Bandwidth `ω_R = a`, rad/s.
        bandwidth: Estimate,
    },
    /// `c_2 / (s² + c_1 s + c_2)`.
    SecondOrder {
        /// `c_1`, 1/s.
        c1: Estimate,
        /// `c_2`, 1/s².
        c2: Estimate,
    },
    /// `(c_1 s + c_2) / (s² + c_3 s + c_4)`.
    SecondOrderWithZero {
        /// `c_1`, 1/s.
        c1: Estimate,
        /// `c_2`, 1/s²; equal to `c_4`, as the gain at rest stands apart.
        c2: Estimate,
        /// `c_3`, 1/s.
        c3: Estimate,
        /// `c_4`, 1/s².
        c4: Estimate,
    },
}

/// The poles of a transfer function, as rates of decay (positive: stable).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Poles {
    /// One pole at `−rate`.
    One {
        /// Rate, rad/s.
        rate: Estimate,
    },
    /// Two real poles.
    Real {
        /// Rate of the slow one, rad/s.
        slow: Estimate,
        /// Rate of the fast one, rad/s.
        fast: Estimate,
    },
    /// A complex pair.
    Complex {
        /// Natural frequency `ω_n`, rad/s.
        natural_frequency: Estimate,
        /// Damping ratio ζ, between 0 and 1.
        damping: Estimate,
    },
}

/// An identified response.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseFit {
    /// The form.
    pub structure: Structure,
    /// The coefficients; standard errors by the delta method from those of their logarithms.
    pub coefficients: Coefficients,
    /// The poles.
    pub poles: Poles,
    /// Gain K at rest, in the output's unit per input's unit.
    pub gain: Estimate,
    /// Offset of the output, in its unit; it takes up a sensor's bias.
    pub offset: Estimate,
    /// Simulated output at the record's times.
    pub simulated: Vec<f64>,
    /// Measured minus simulated.
    pub residuals: Vec<f64>,
    /// How well the fit describes the data.
    pub goodness: Goodness,
    /// Fit in percent: 100 for a perfect one, 0 for one no better than the mean.
    pub fit_percent: f64,
    /// Bayesian information criterion `n ln(Σ r²/n) + k ln n`: lower is better among fits to the same data.
    pub bic: f64,
    /// Whether the residuals are white.
    pub whiteness: Whiteness,
    /// How the iteration ended.
    pub convergence: Option<Convergence>,
    /// What a reader must know before using the numbers.
    pub warnings: Vec<Warning>,
    parameters: Vec<f64>,
}

/// Lags of the whiteness test.
const LAGS: usize = 20;

/// Relative standard error from which a coefficient counts as not excited: its 95 % interval then reaches zero.
const UNDETERMINED: f64 = 0.5;

impl ResponseFit {
    pub(super) fn of<const N: usize>(model: &Model, fit: Fit<N>) -> Self {
        let whiteness = Whiteness::test(&fit.residuals, LAGS);
        let n = fit.residuals.len() as f64;
        let mean_square = fit.residuals.iter().map(|r| r * r).sum::<f64>() / n;
        // The residuals' variance is a parameter too.
        let bic = n * mean_square.ln() + (N + 1) as f64 * n.ln();
        let mut warnings = model.record.warnings.clone();
        warnings.extend(undetermined(model, &fit));
        warnings.extend(&fit.warnings);
        if !whiteness.is_white() {
            warnings.push(Warning::CorrelatedResiduals {
                p_value: whiteness.p_value,
                lags: whiteness.autocorrelation.len(),
            });
        }
        Self {
            structure: model.structure,
            coefficients: coefficients(model, &fit),
            poles: poles(model, &fit),
            gain: fit.parameters[GAIN],
            offset: fit.parameters[OFFSET],
            simulated: measured_less(&model.record.outputs, &fit.residuals),
            fit_percent: fit.goodness.fit_percent().unwrap_or(f64::NAN),
            goodness: fit.goodness,
            bic,
            whiteness,
            convergence: fit.convergence,
            warnings,
            parameters: fit.values().to_vec(),
            residuals: fit.residuals,
        }
    }

    /// The output simulated over another record from rest under its first input: a validation on data the fit has not seen.
    pub fn simulate(&self, record: &super::Record) -> Vec<f64> {
        let model = Model {
            record,
            structure: self.structure,
            start: Start::Equilibrium,
        };
        // A free initial state belongs to the record it was fitted to.
        let linear = self.structure.linear_parameters();
        let mut parameters = self.parameters[..linear].to_vec();
        parameters.extend(&self.parameters[self.parameters.len() - self.structure.order()..]);
        model.output(&parameters)
    }

    /// Fit in percent of the output simulated over another record; `None` for one with constant output.
    pub fn validate(&self, record: &super::Record) -> Option<f64> {
        let residuals = measured_less(&record.outputs, &self.simulate(record));
        Goodness::of(&residuals, &record.outputs, 0).fit_percent()
    }
}

fn measured_less(measured: &[f64], other: &[f64]) -> Vec<f64> {
    measured.iter().zip(other).map(|(y, r)| y - r).collect()
}

/// Names of the denominator's coefficients.
const fn names(structure: Structure) -> &'static [&'static str] {
    match structure {
        Structure::FirstOrder => &["the bandwidth"],
        Structure::SecondOrder => &["the coefficient c_1", "the coefficient c_2"],
        Structure::SecondOrderWithZero => &["the coefficient c_3", "the coefficient c_4"],
    }
}

fn undetermined<const N: usize>(model: &Model, fit: &Fit<N>) -> Vec<Warning> {
    let logarithms = &fit.parameters[model.linear_count()..];
    let pairs = names(model.structure).iter().zip(logarithms);
    pairs
        .filter(|(_, ln)| ln.standard_error > UNDETERMINED)
        .map(|(parameter, ln)| Warning::Undetermined {
            parameter,
            relative_error: ln.standard_error,
        })
        .collect()
}

fn coefficients<const N: usize>(model: &Model, fit: &Fit<N>) -> Coefficients {
    // A coefficient's relative error is its logarithm's error.
    let exponential = |i: usize| {
        let value = fit.parameters[i].value.exp();
        fit.parameters[i].mapped(value, value)
    };
    let m = model.linear_count();
    match model.structure {
        Structure::FirstOrder => Coefficients::FirstOrder {
            bandwidth: exponential(m),
        },
        Structure::SecondOrder => Coefficients::SecondOrder {
            c1: exponential(m),
            c2: exponential(m + 1),
        },
        Structure::SecondOrderWithZero => {
            let (gain, kappa) = (fit.parameters[GAIN].value, fit.parameters[ZERO].value);
            let mut gradient = [0.0; N];
            gradient[GAIN] = -kappa / (gain * gain);
            gradient[ZERO] = 1.0 / gain;
            Coefficients::SecondOrderWithZero {
                c1: fit.propagated(kappa / gain, &gradient),
                c2: exponential(m + 1),
                c3: exponential(m),
                c4: exponential(m + 1),
            }
        }
    }
}

fn poles<const N: usize>(model: &Model, fit: &Fit<N>) -> Poles {
    let m = model.linear_count();
    if model.structure.order() == 1 {
        let value = fit.parameters[m].value.exp();
        return Poles::One {
            rate: fit.parameters[m].mapped(value, value),
        };
    }
    let at = [fit.parameters[m].value, fit.parameters[m + 1].value];
    let estimate = |of: fn(&[Dual<2>; 2]) -> Dual<2>| {
        let slopes = jacobian(|x| [of(x)], at);
        let mut gradient = [0.0; N];
        gradient[m..m + 2].copy_from_slice(&[slopes[0], slopes[1]]);
        fit.propagated(of(&at.map(Dual::<2>::from_re)).re, &gradient)
    };
    let [a1, a2] = at.map(f64::exp);
    if a1 * a1 > 4.0 * a2 {
        Poles::Real {
            slow: estimate(slow),
            fast: estimate(fast),
        }
    } else {
        Poles::Complex {
            natural_frequency: estimate(natural_frequency),
            damping: estimate(damping),
        }
    }
}

/// Rate of the faster of two real poles, `a_1/2 + √(a_1²/4 − a_2)`, from the logarithms of the coefficients.
fn fast<R: Real>(ln: &[R; 2]) -> R {
    let half = ln[0].simd_exp() * constant(0.5);
    half + (half * half - ln[1].simd_exp()).simd_sqrt()
}

/// Rate of the slower one, `a_2` over the faster: the difference would cancel.
fn slow<R: Real>(ln: &[R; 2]) -> R {
    ln[1].simd_exp() / fast(ln)
}

/// `ω_n = √a_2`.
fn natural_frequency<R: Real>(ln: &[R; 2]) -> R {
    (ln[1] * constant(0.5)).simd_exp()
}

/// `ζ = a_1 / (2 √a_2)`.
fn damping<R: Real>(ln: &[R; 2]) -> R {
    (ln[0] - ln[1] * constant(0.5)).simd_exp() * constant(0.5)
}
