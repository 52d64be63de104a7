//! The empirical parameters of a vehicle, derived from its propeller, motor and battery.
//!
//! The mechanistic rotor in steady state and linearised about it, in closed form, and least-squares fits to it:
//!
//! ```text
//! I = (V − Ω/K_v)/R,   I_R dΩ/dt = (I − I_0)/K_v − k_Q Ω²,   T = k_T Ω²,   Q = k_Q Ω²
//! steady:      K_v k_Q R Ω² + Ω/K_v = V − R I_0
//! linearised:  ω_m = (1/(K_v² R) + 2 k_Q Ω_0) / I_R
//! ```
//!
//! Assumptions: torque constant `1/K_v`, constant no-load current, static thrust (no inflow), coefficients independent
//! of the speed. Valid where the propeller was measured; beyond, an extrapolation. These functions make the numbers
//! of the project's own vehicle files, and tests hold the files to them; the models take the numbers from the files.
//!
//! Source: first-order motor model, M. Drela, *First-order DC electric motor model*, MIT, 2007; propeller convention of
//! the UIUC Propeller Data Site.

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use nalgebra::{SMatrix, SVector, Vector3};

use quad_rotor::{Cubic, MechanisticRotor, RotorDynamics};

use super::{PolynomialRotorParameters, PropellerParameters, Vehicle, VehicleError};

/// Points of a fit over a continuous range: so many that their number no longer shows in four digits.
const SAMPLES: usize = 1001;

/// Why a fit was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// The points do not determine the unknowns.
    #[error("{points} points do not determine {unknowns} unknowns")]
    Underdetermined {
        /// Number of points given.
        points: usize,
        /// Number of unknowns sought.
        unknowns: usize,
    },
}

/// One row of a static propeller test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticPoint {
    /// Rotor speed, revolutions per minute.
    pub speed_rpm: f64,
    /// Thrust coefficient `C_T = T / (ρ n² D⁴)`.
    pub thrust_coefficient: f64,
    /// Power coefficient `C_P = P / (ρ n³ D⁵)`.
    pub power_coefficient: f64,
}

/// One row of a propeller test in an axial stream.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdvancePoint {
    /// Advance ratio `J = V / (n D)`.
    pub advance_ratio: f64,
    /// Thrust coefficient `C_T = T / (ρ n² D⁴)`.
    pub thrust_coefficient: f64,
}

/// Rotor speed in rad/s from revolutions per minute.
#[must_use]
pub fn rad_per_s(rpm: f64) -> f64 {
    rpm * PI / 30.0
}

/// Constant C_T and `C_Q = C_P / 2π` by least squares on thrust and torque, `T = k_T Ω²` and `Q = k_Q Ω²`.
///
/// Fitting the forces and not the coefficients weights the fast, loaded rows as `n⁴`; the density cancels.
///
/// # Errors
/// [`FitError`] without a row at a speed other than zero.
pub fn fit_propeller(points: &[StaticPoint], diameter: f64) -> Result<PropellerParameters, FitError> {
    let fit = |coefficient: fn(&StaticPoint) -> f64| {
        let rows = points.iter().map(|point| {
            let speed_squared = point.speed_rpm.powi(2);
            ([speed_squared], coefficient(point) * speed_squared)
        });
        least_squares(rows)
    };
    let [thrust_coefficient] = fit(|point| point.thrust_coefficient)?;
    let [power_coefficient] = fit(|point| point.power_coefficient)?;
    Ok(PropellerParameters {
        diameter,
        thrust_coefficient,
        torque_coefficient: power_coefficient / TAU,
    })
}

/// Slope `dC_T/dJ` of the line through the rows, dimensionless; negative on a working propeller.
///
/// # Errors
/// [`FitError`] with fewer than two advance ratios.
pub fn advance_slope(points: &[AdvancePoint]) -> Result<f64, FitError> {
    let rows = points
        .iter()
        .map(|point| ([1.0, point.advance_ratio], point.thrust_coefficient));
    least_squares(rows).map(|[_, slope]| slope)
}

/// Loss of thrust per axial speed `−dT/dV = −ρ n D³ dC_T/dJ`, N·s/m, at rotor speed Ω in rad/s.
#[must_use]
pub fn axial_damping(advance_slope: f64, air_density: f64, diameter: f64, speed: f64) -> f64 {
    -air_density * (speed / TAU) * diameter.powi(3) * advance_slope
}

/// A propeller on its motor: steady state and linearisation, of which [`MechanisticRotor`] has the physics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyRotor {
    /// Propeller, motor and controller.
    pub rotor: MechanisticRotor<f64>,
}

/// A straight line through the steady states of a rotor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearFit {
    /// Thrust gain K_T, N per unit of duty.
    pub thrust_gain: f64,
    /// Torque gain K_Q, N·m per unit of duty, with the same zero as the thrust.
    pub torque_gain: f64,
    /// Duty above ū_min where the thrust line is zero, `ū_0 − ū_min`.
    pub zero_thrust: f64,
}

impl SteadyRotor {
    /// The rotor of a vehicle with a propeller and a motor.
    ///
    /// # Errors
    /// [`VehicleError::MissingGroup`] if it lacks either.
    pub fn of(vehicle: &Vehicle) -> Result<Self, VehicleError> {
        const NEEDED_BY: &str = "the steady rotor";
        let propeller = vehicle.require_propeller(NEEDED_BY)?;
        let rotor = MechanisticRotor {
            propeller: propeller.law(vehicle.environment.air_density),
            motor: *vehicle.require_motor(NEEDED_BY)?,
            zero_thrust_offset: vehicle.pwm.zero_thrust - vehicle.pwm.minimum,
        };
        Ok(Self { rotor })
    }

    /// Thrust constant k_T, N·s²: `T = k_T Ω²`.
    #[must_use]
    pub fn thrust_constant(&self) -> f64 {
        self.rotor.propeller.thrust_per_speed_squared
    }

    /// Torque constant k_Q, N·m·s²: `Q = k_Q Ω²`.
    #[must_use]
    pub fn torque_constant(&self) -> f64 {
        self.rotor.propeller.torque_per_speed_squared
    }

    /// Torque per thrust `k_Q / k_T`, m.
    fn torque_per_thrust(&self) -> f64 {
        self.torque_constant() / self.thrust_constant()
    }

    /// Effective motor voltage V, V, at a duty above ū_min and a battery voltage.
    #[must_use]
    pub fn effective_voltage(&self, duty: f64, battery_voltage: f64) -> f64 {
        self.rotor.motor.duty_fraction(duty) * battery_voltage
    }

    /// Steady speed Ω, rad/s, at a motor voltage; 0 below the voltage that overcomes the no-load current (a kink).
    #[must_use]
    pub fn speed(&self, voltage: f64) -> f64 {
        self.rotor.steady_speed(voltage)
    }

    /// Motor voltage, V, that holds a speed Ω, rad/s.
    #[must_use]
    pub fn voltage(&self, speed: f64) -> f64 {
        self.rotor.steady_voltage(speed)
    }

    /// Duty above ū_min that holds a speed Ω, rad/s, at a battery voltage, V.
    #[must_use]
    pub fn duty(&self, speed: f64, battery_voltage: f64) -> f64 {
        self.voltage(speed) / battery_voltage * self.rotor.motor.full_voltage_duty
    }

    /// Speed Ω, rad/s, that gives a thrust, N.
    #[must_use]
    pub fn speed_at_thrust(&self, thrust: f64) -> f64 {
        self.rotor.propeller.speed_for_thrust(thrust)
    }

    /// Steady thrust T, N, at a duty above ū_min and a battery voltage, V.
    #[must_use]
    pub fn thrust(&self, duty: f64, battery_voltage: f64) -> f64 {
        let speed = self.speed(self.effective_voltage(duty, battery_voltage));
        self.rotor.propeller.thrust(speed)
    }

    /// Slope of the steady thrust over the duty, N per unit: `2 k_T Ω (dΩ/dV) V_b / full_voltage_duty`, where the linearised
    /// motor gives `dV/dΩ = K_v R I_R ω_m`.
    #[must_use]
    pub fn thrust_slope(&self, speed: f64, battery_voltage: f64) -> f64 {
        let motor = &self.rotor.motor;
        let voltage_per_speed =
            motor.velocity_constant * motor.resistance * motor.rotor_inertia * self.motor_pole(speed);
        2.0 * self.thrust_constant() * speed / voltage_per_speed * battery_voltage / motor.full_voltage_duty
    }

    /// Pole of the motor linearised at a speed, rad/s, positive when stable: `ω_m = (1/(K_v² R) + 2 k_Q Ω_0) / I_R`.
    #[must_use]
    pub fn motor_pole(&self, speed: f64) -> f64 {
        self.rotor.bandwidth(speed)
    }

    /// Bandwidth ω_R, rad/s: the slower of the poles of motor and controller at a speed.
    #[must_use]
    pub fn bandwidth(&self, speed: f64) -> f64 {
        self.motor_pole(speed).min(1.0 / self.rotor.motor.controller_lag)
    }

    /// Transfer functions of thrust and reaction torque, linearised at a speed.
    ///
    /// Both have the poles of motor and controller, `(s + ω_m)(s + 1/τ_ESC)`. The reaction torque `Q + I_R dΩ/dt`
    /// has the zero `2 k_Q Ω_0 / I_R` besides: spinning up takes torque before there is speed.
    #[must_use]
    pub fn rotor_dynamics(&self, speed: f64) -> RotorDynamics<f64> {
        let (motor, controller) = (self.motor_pole(speed), 1.0 / self.rotor.motor.controller_lag);
        let (sum, product) = (motor + controller, motor * controller);
        let zero = 2.0 * self.torque_constant() * speed / self.rotor.motor.rotor_inertia;
        RotorDynamics {
            thrust_c1: sum,
            thrust_c2: product,
            torque_c1: product / zero,
            torque_c2: product,
            torque_c3: sum,
            torque_c4: product,
        }
    }

    /// Least-squares line through the steady thrust over a range of speeds, rad/s, evenly in duty, at a battery voltage.
    ///
    /// The torque line keeps the thrust's zero; as `Q = (k_Q/k_T) T`, its gain is in the same ratio.
    ///
    /// # Errors
    /// [`FitError`] on an empty range.
    pub fn linear_fit(
        &self,
        speeds: RangeInclusive<f64>,
        battery_voltage: f64,
    ) -> Result<LinearFit, FitError> {
        let duties = self.duty(*speeds.start(), battery_voltage)..=self.duty(*speeds.end(), battery_voltage);
        let rows = evenly(&duties, SAMPLES).map(|duty| ([1.0, duty], self.thrust(duty, battery_voltage)));
        let [intercept, thrust_gain] = least_squares(rows)?;
        Ok(LinearFit {
            thrust_gain,
            torque_gain: thrust_gain * self.torque_per_thrust(),
            zero_thrust: -intercept / thrust_gain,
        })
    }

    /// Least-squares cubics without constant term in `x = (ū − ū_min) V_b`, over a grid of duty and battery voltage.
    ///
    /// # Errors
    /// [`FitError`] if the grid has fewer than three values of x.
    pub fn polynomial_fit(&self, grid: &FitGrid) -> Result<PolynomialRotorParameters, FitError> {
        let points = grid.points();
        let thrust = fit_cubic(points.map(|(duty, volt)| (duty * volt, self.thrust(duty, volt))))?;
        Ok(PolynomialRotorParameters {
            thrust,
            torque: thrust.scaled(self.torque_per_thrust()),
        })
    }

    /// Rate damping of four rotors about a hover speed, N·m·s per body axis, from the axial damping of one, N·s/m.
    ///
    /// Roll and pitch: a hub at y climbs at `p y`, so `d_x = Σ y_i² (−dT/dV)`, and likewise in x. Yaw: the speed
    /// through the air is the rotor's plus the airframe's, `d_z = 4 · 2 k_Q Ω_0`, at constant speed against the airframe.
    #[must_use]
    pub fn rate_damping(&self, vehicle: &Vehicle, axial_damping: f64, speed: f64) -> Vector3<f64> {
        let hubs = vehicle.hubs().into_iter();
        let (yy, xx) = hubs.fold((0.0, 0.0), |(yy, xx), r| (yy + r.y.powi(2), xx + r.x.powi(2)));
        let rotors = vehicle.rotors.len() as f64;
        Vector3::new(
            yy * axial_damping,
            xx * axial_damping,
            rotors * 2.0 * self.torque_constant() * speed,
        )
    }
}

/// Grid of duty above ū_min and battery voltage that a polynomial is fitted over.
#[derive(Debug, Clone, PartialEq)]
pub struct FitGrid {
    /// Duty above ū_min.
    pub duties: RangeInclusive<f64>,
    /// Number of duties, ends included.
    pub duty_count: usize,
    /// Battery voltage, V.
    pub voltages: RangeInclusive<f64>,
    /// Number of voltages, ends included.
    pub voltage_count: usize,
}

impl FitGrid {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        evenly(&self.duties, self.duty_count)
            .flat_map(|duty| evenly(&self.voltages, self.voltage_count).map(move |voltage| (duty, voltage)))
    }
}

/// Least-squares cubic `k_1 x + k_2 x² + k_3 x³` without constant term, through points (x, y).
///
/// # Errors
/// [`FitError`] with fewer than three different x.
pub fn fit_cubic(points: impl Iterator<Item = (f64, f64)> + Clone) -> Result<Cubic<f64>, FitError> {
    // Scaled to the largest |x|, the normal equations of a cubic lose few digits.
    let scale = points.clone().map(|(x, _)| x.abs()).fold(0.0, f64::max);
    let rows = points.map(|(x, y)| {
        let s = x / scale;
        ([s, s * s, s * s * s], y)
    });
    least_squares(rows).map(|[k1, k2, k3]| Cubic {
        k1: k1 / scale,
        k2: k2 / scale.powi(2),
        k3: k3 / scale.powi(3),
    })
}

/// Values evenly over a range, ends included.
fn evenly(range: &RangeInclusive<f64>, count: usize) -> impl Iterator<Item = f64> + Clone + use<> {
    let (start, end) = (*range.start(), *range.end());
    let steps = count.saturating_sub(1).max(1) as f64;
    (0..count).map(move |i| start + (end - start) * (i as f64 / steps))
}

/// Minimises `Σ (a_i · k − y_i)²` by the normal equations; for a handful of well-scaled unknowns.
fn least_squares<const N: usize>(rows: impl Iterator<Item = ([f64; N], f64)>) -> Result<[f64; N], FitError> {
    let mut normal = SMatrix::<f64, N, N>::zeros();
    let mut right = SVector::<f64, N>::zeros();
    let mut points = 0;
    for (row, value) in rows {
        let row = SVector::<f64, N>::from(row);
        normal += row * row.transpose();
        right += row * value;
        points += 1;
    }
    let underdetermined = FitError::Underdetermined { points, unknowns: N };
    let solution = normal.cholesky().ok_or(underdetermined)?.solve(&right);
    if solution.iter().all(|unknown| unknown.is_finite()) {
        Ok(solution.into())
    } else {
        Err(underdetermined)
    }
}
