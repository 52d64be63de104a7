//! System identification of a quadrotor: measurements in, parameters with their uncertainty out.
//!
//! Every identification returns [`Estimate`]s (value, standard error, degrees of freedom; a 95 % interval by Student's t), with
//! residuals and [`Goodness`], and with [`Warning`]s that say where an interval can't be trusted. Bad data are rejected with an
//! error that names the line or the sample. An interval covers noise only; what a model misses is a warning.
//!
//! | module | identifies, or holds | method |
//! | --- | --- | --- |
//! | [`centre_of_mass`] | centre of mass and weight | forces on three supports in two orientations or more; lines meet by least squares |
//! | [`pendulum`] | moments of inertia | bifilar pendulum: timed periods, or the damped large-angle equation fitted to the angle |
//! | [`load_cell`] | zero and sensitivity of a force or torque cell | calibration line, tests of straightness, inverse intervals |
//! | [`rotor_static`] | C_T, C_Q, cubics in duty and voltage, linear gains and the zero-thrust duty | least squares over a static sweep |
//! | [`rotor_dynamics`] | transfer functions of thrust and torque, bandwidth | output-error fit to steps or a pseudo-random sequence, order by the Bayesian criterion |
//! | [`flight`] | thrust curve, motor lag, I_xx, I_yy, yaw torque over I_zz | accelerometer and gyroscope of a flight, over short bins |
//! | [`pipeline`] | the whole vehicle, as a vehicle file with standard errors | all benches and a flight, one after the other |
//! | [`validation`] | how well levels 2 to 5 predict a recorded flight | replay; fit %, Theil's coefficient, residuals |
//! | [`measurement`] | the reader of every measurement file | streamed CSV, each column declared with unit and range |
//! | [`recorded`] | public data sets in the project's frames and units | |
//! | [`laboratory`] | virtual measurements of a vehicle whose numbers are known | sensors with noise, bias, quantisation, sampling |
//! | [`regression`], [`lack_of_fit`], [`residual`] | least squares (linear, non-linear, total), tests of what is left | singular values, Levenberg-Marquardt |
//! | [`estimate`] | the result of all of them | |
//!
//! The program `identify` has a command for each bench and for flights; it reads files, which nothing here does.
//!
//! # Example
//!
//! A propeller on a virtual thrust stand: its coefficient, and whether the interval contains the truth.
//!
//! ```
//! use quad_dynamics::Vehicle;
//! use sysid::laboratory::generator;
//! use sysid::laboratory::thrust_stand::{BenchSupply, StaticSweep, ThrustStand};
//! use sysid::rotor_static::{PropellerSample, PropellerScale, Quantity, coefficient, linear_gains};
//!
//! let vehicle = Vehicle::qball_x4();
//! let sweep = StaticSweep {
//!     duties: (0..20).map(|i| 0.062 + 0.001 * f64::from(i)).collect(),
//!     supplies: vec![BenchSupply::Regulated { voltage_v: 11.1 }],
//!     readings: 50,
//! };
//! let samples = ThrustStand::of(&vehicle)?.sweep(&sweep, &mut generator(7))?;
//!
//! let truth = vehicle.require_propeller("an example")?;
//! let scale = PropellerScale { diameter_m: truth.diameter, air_density_kg_m3: vehicle.environment.air_density };
//! let steady: Vec<PropellerSample> = samples.iter().map(PropellerSample::from).collect();
//! let fit = coefficient(&steady, &scale, Quantity::Thrust)?;
//! let [c_t] = fit.parameters;
//! // Three standard errors: one seed in four hundred misses.
//! assert!((c_t.value - truth.thrust_coefficient).abs() < 3.0 * c_t.standard_error);
//! assert!(c_t.standard_error < 1e-3 * c_t.value && fit.warnings.is_empty());
//!
//! // The linear rotor of levels 1 to 4: a line over the duties, whose zero is the zero-thrust duty.
//! let gains = linear_gains(&samples)?;
//! println!("K_T = {:.1} ± {:.1} N", gains.thrust_gain.value, gains.thrust_gain.half_width());
//! println!("u_0 = {:.4} ± {:.4}", gains.zero_thrust.value, gains.zero_thrust.half_width());
//! // The rotor's curve is not a line, and the fit reports it.
//! assert!(gains.warnings().count() > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod centre_of_mass;
pub mod estimate;
pub mod flight;
pub mod laboratory;
pub mod lack_of_fit;
pub mod load_cell;
pub mod measurement;
pub mod pendulum;
pub mod pipeline;
pub mod recorded;
pub mod regression;
pub mod residual;
pub mod rotor_dynamics;
pub mod rotor_static;
pub mod validation;

pub use estimate::{Convergence, Estimate, Fit, Goodness, Interval, Warning};

#[cfg(test)]
mod test_coverage;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
