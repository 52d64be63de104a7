//! The wind-tunnel measurements of the propeller and the fit of its static law, with intervals.

use crate::item::{Context, ItemError};
use quad_dynamics::vehicle::derive::rad_per_s;
use serde::Deserialize;
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::f64::consts::TAU;

/// The measurements, below `data/`.
pub(super) const STATIC_TABLE: &str = "propellers/apc_sf_10x4.7_static.csv";

/// Diameter of the propeller, m, and the air density that dimensions the coefficients, kg/m³.
pub(super) const DIAMETER_M: f64 = 0.254;
pub(super) const AIR_DENSITY: f64 = 1.225;

/// One row of the static table.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Row {
    /// Rotor speed, revolutions per minute.
    pub(super) rpm: f64,
    /// `C_T`.
    pub(super) thrust_coefficient: f64,
    /// `C_P`.
    pub(super) power_coefficient: f64,
}

impl Row {
    /// Ω, rad/s.
    pub(super) fn speed(&self) -> f64 {
        rad_per_s(self.rpm)
    }

    /// `C_Q = C_P / 2π`.
    pub(super) fn torque_coefficient(&self) -> f64 {
        self.power_coefficient / TAU
    }

    /// Thrust, N.
    pub(super) fn thrust(&self) -> f64 {
        self.thrust_coefficient * scale(4) * self.speed().powi(2)
    }

    /// Torque, N m.
    pub(super) fn torque(&self) -> f64 {
        self.torque_coefficient() * scale(5) * self.speed().powi(2)
    }
}

/// `ρ D^k / (2π)²`: from a coefficient to newtons (k = 4) or newton metres (k = 5) per squared rad/s.
pub(super) fn scale(power: i32) -> f64 {
    AIR_DENSITY * DIAMETER_M.powi(power) / (TAU * TAU)
}

/// Reads the static table.
pub(super) fn read(context: &Context) -> Result<Vec<Row>, ItemError> {
    let path = context.data(STATIC_TABLE);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path)?;
    Ok(reader.deserialize().collect::<Result<Vec<Row>, _>>()?)
}

/// A line through the origin, `y = k x`, fitted by least squares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// `k`.
    pub(super) slope: f64,
    /// Half width of its 95 % interval (Student's t, residuals taken as independent).
    pub(super) half_width: f64,
    /// Root mean square residual, in the unit of y.
    pub(super) rms_residual: f64,
    /// Largest residual, in the unit of y.
    pub(super) largest_residual: f64,
}

/// Fits `y = k Ω²`.
pub(super) fn fit(rows: &[Row], y: fn(&Row) -> f64) -> Result<Fit, ItemError> {
    let points: Vec<(f64, f64)> = rows.iter().map(|r| (r.speed().powi(2), y(r))).collect();
    let xx: f64 = points.iter().map(|(x, _)| x * x).sum();
    let slope = points.iter().map(|(x, y)| x * y).sum::<f64>() / xx;
    let residuals: Vec<f64> = points.iter().map(|(x, y)| y - slope * x).collect();
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let freedom = points.len() as f64 - 1.0;
    let quantile = StudentsT::new(0.0, 1.0, freedom)?.inverse_cdf(0.975);
    Ok(Fit {
        slope,
        half_width: quantile * (squares / freedom / xx).sqrt(),
        rms_residual: (squares / points.len() as f64).sqrt(),
        largest_residual: residuals.iter().fold(0.0_f64, |m, r| m.max(r.abs())),
    })
}

/// The coefficient of the table at a speed, rpm, by linear interpolation.
pub(super) fn at_speed(rows: &[Row], rpm: f64, coefficient: fn(&Row) -> f64) -> Option<f64> {
    let pair = rows.windows(2).find(|p| p[0].rpm <= rpm && rpm <= p[1].rpm)?;
    let share = (rpm - pair[0].rpm) / (pair[1].rpm - pair[0].rpm);
    Some(coefficient(&pair[0]) * (1.0 - share) + coefficient(&pair[1]) * share)
}
