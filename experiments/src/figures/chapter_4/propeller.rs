//! The published wind-tunnel measurements of the propeller, as the identification takes them.

use crate::item::{Context, ItemError};
use quad_dynamics::vehicle::derive::rad_per_s;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::f64::consts::TAU;
use sysid::rotor_static::{
    AdvanceSample, PropellerSample, PropellerScale, Quantity, SpeedDependence, SpeedLaw, coefficient,
    speed_dependence,
};
use sysid::{Fit, Goodness};

/// The measurements, below `data/`.
pub(super) const STATIC_TABLE: &str = "propellers/apc_sf_10x4.7_static.csv";
/// The measurements in an axial stream, below `data/`.
pub(super) const ADVANCE_TABLE: &str = "propellers/apc_sf_10x4.7_advance.csv";

/// Diameter of the propeller and the air density that dimensions the coefficients.
pub(super) const SCALE: PropellerScale = PropellerScale {
    diameter_m: 0.254,
    air_density_kg_m3: 1.225,
};

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

/// One row of the table in an axial stream.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct AdvanceRow {
    /// The source's name of the run.
    pub(super) run: String,
    /// Nominal rotor speed of the run, revolutions per minute.
    pub(super) rpm: f64,
    /// J and `C_T`.
    #[serde(flatten)]
    pub(super) sample: AdvanceSample,
    /// `C_P`.
    pub(super) power_coefficient: f64,
}

impl Row {
    /// Ω, rad/s.
    pub(super) fn speed(&self) -> f64 {
        rad_per_s(self.rpm)
    }

    /// `C_T`, or `C_Q = C_P / 2π`.
    pub(super) fn coefficient(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Thrust => self.thrust_coefficient,
            Quantity::Torque => self.power_coefficient / TAU,
        }
    }

    /// Thrust, N, or torque, N m.
    pub(super) fn value(&self, quantity: Quantity) -> f64 {
        self.coefficient(quantity) * SCALE.unit(quantity, self.speed())
    }
}

/// Reads the static table.
pub(super) fn read(context: &Context) -> Result<Vec<Row>, ItemError> {
    table(context, STATIC_TABLE)
}

/// Reads the table in an axial stream.
pub(super) fn read_advance(context: &Context) -> Result<Vec<AdvanceRow>, ItemError> {
    table(context, ADVANCE_TABLE)
}

fn table<T: DeserializeOwned>(context: &Context, relative: &str) -> Result<Vec<T>, ItemError> {
    let path = context.data(relative);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path)?;
    Ok(reader.deserialize().collect::<Result<Vec<T>, _>>()?)
}

/// The identification of one coefficient from the static table.
pub(super) struct Identified {
    /// `C_T` or `C_Q` with one constant.
    pub(super) constant: Fit<1>,
    /// The same with a line over the speed. A logarithm leaves less residual in thrust and more in torque, but is further off at
    /// hover and misses the slow end by more than 2 %.
    pub(super) varying: SpeedDependence,
}

/// Identifies a coefficient; the reference speed of its dependence is in rad/s.
pub(super) fn identify(
    rows: &[Row],
    quantity: Quantity,
    reference_rad_s: f64,
) -> Result<Identified, ItemError> {
    let samples: Vec<PropellerSample> = rows
        .iter()
        .map(|row| PropellerSample {
            speed_rad_s: row.speed(),
            thrust_n: row.value(Quantity::Thrust),
            torque_n_m: row.value(Quantity::Torque),
        })
        .collect();
    Ok(Identified {
        constant: coefficient(&samples, &SCALE, quantity)?,
        varying: speed_dependence(&samples, &SCALE, quantity, SpeedLaw::Linear, reference_rad_s)?,
    })
}

/// Root mean square residual `√(Σ r²/n)`, in the unit of the data.
pub(super) fn rms(goodness: &Goodness, points: usize) -> f64 {
    goodness.standard_deviation * (goodness.degrees_of_freedom / points as f64).sqrt()
}

/// The coefficient of the table at a speed, rpm, by linear interpolation.
pub(super) fn at_speed(rows: &[Row], rpm: f64, quantity: Quantity) -> Option<f64> {
    let pair = rows.windows(2).find(|p| p[0].rpm <= rpm && rpm <= p[1].rpm)?;
    let share = (rpm - pair[0].rpm) / (pair[1].rpm - pair[0].rpm);
    Some(pair[0].coefficient(quantity) * (1.0 - share) + pair[1].coefficient(quantity) * share)
}
