//! The identified vehicle: the file, the list of its identified numbers, and what must be known about them.

use super::{DragFit, PipelineError};
use crate::estimate::{Estimate, Warning};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::{Sourced, VehicleFile};
use std::fmt;

/// Which measurement a number comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bench {
    /// Airframe on three supports.
    Supports,
    /// Bifilar pendulum.
    Pendulum,
    /// Load cells of the thrust stand under known loads.
    LoadCells,
    /// Thrust stand, duties and voltages.
    StaticSweep,
    /// Thrust stand at one voltage.
    OperatingSweep,
    /// Thrust stand, pseudo-random duties about hover.
    Response,
    /// Flight.
    Flight,
}

impl fmt::Display for Bench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Supports => "support forces",
            Self::Pendulum => "bifilar pendulum",
            Self::LoadCells => "load cells",
            Self::StaticSweep => "thrust stand, static sweep over duty and voltage",
            Self::OperatingSweep => "thrust stand, static sweep over the operating range",
            Self::Response => "thrust stand, pseudo-random duties about hover",
            Self::Flight => "flight",
        })
    }
}

/// An identified number of the vehicle file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its key in the file, such as `airframe.mass_kg`, `airframe.centre_of_mass_m[0]`.
    pub key: &'static str,
    /// Its unit; empty if it has none.
    pub unit: &'static str,
    /// The estimate.
    pub estimate: Estimate,
    /// Where it comes from.
    pub bench: Bench,
}

/// A warning and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remarked {
    /// The measurement.
    pub bench: Bench,
    /// The warning.
    pub warning: Warning,
}

/// An identified vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// The vehicle file: identified numbers with standard errors, the others from the nominal file.
    pub file: VehicleFile,
    /// The identified numbers, in the order of their identification.
    pub parameters: Vec<Parameter>,
    /// What must be known before the numbers are used.
    pub remarks: Vec<Remarked>,
}

fn source(bench: Bench) -> String {
    format!("identified: {bench}")
}

/// An identified number as the file takes it.
fn sourced(bench: Bench, estimate: Estimate) -> Sourced<f64> {
    Sourced {
        value: estimate.value,
        source: source(bench),
        standard_error: Some(estimate.standard_error),
    }
}

impl Identified {
    /// Nothing identified yet: the nominal file, whose numbers say that they were taken from it.
    pub(super) fn from_nominal(nominal: &VehicleFile) -> Result<Self, PipelineError> {
        if nominal.propeller.is_none() {
            return Err(PipelineError::MissingGroup { group: "propeller" });
        }
        let mut file = nominal.clone();
        file.name = format!("{} (identified)", nominal.name);
        file.description = format!(
            "Identified from bench and flight measurements; numbers whose source begins with \"not identified\" are those of {}.",
            nominal.name
        );
        // Those identified later lose the word with their source.
        file.for_each_number_mut(|_, number| {
            number.source = format!("not identified, taken from the nominal file: {}", number.source);
        });
        Ok(Self {
            file,
            parameters: Vec::new(),
            remarks: Vec::new(),
        })
    }

    pub(super) fn remark(&mut self, bench: Bench, warnings: Vec<Warning>) {
        self.remarks
            .extend(warnings.into_iter().map(|warning| Remarked { bench, warning }));
    }

    /// Puts an identified number into the file, and lists it with its unit.
    pub(super) fn number(&mut self, bench: Bench, key: &'static str, estimate: Estimate) {
        let quantity = self.file.set(key, &sourced(bench, estimate));
        let unit = quantity.expect("a number of the file").unit;
        self.parameters.push(Parameter {
            key,
            // Dimensions such as "(duty)" are no units.
            unit: if unit.starts_with('(') { "" } else { unit },
            estimate,
            bench,
        });
    }

    /// Coefficients `k_1, k_2, k_3` of both cubics.
    pub(super) fn polynomials(&mut self, thrust: [Estimate; 3], torque: [Estimate; 3]) {
        self.file.ensure_group("polynomial_rotor");
        let keys = [
            "polynomial_rotor.thrust_k1_n_per_v",
            "polynomial_rotor.thrust_k2_n_per_v2",
            "polynomial_rotor.thrust_k3_n_per_v3",
            "polynomial_rotor.torque_k1_n_m_per_v",
            "polynomial_rotor.torque_k2_n_m_per_v2",
            "polynomial_rotor.torque_k3_n_m_per_v3",
        ];
        for (key, estimate) in keys.into_iter().zip([thrust, torque].concat()) {
            self.number(Bench::StaticSweep, key, estimate);
        }
    }

    /// Coefficients in the order `c_T1, c_T2, c_Q1 .. c_Q4`.
    pub(super) fn dynamics(&mut self, coefficients: [Estimate; 6]) {
        self.file.ensure_group("rotor_dynamics");
        let keys = [
            "rotor_dynamics.thrust_c1_per_s",
            "rotor_dynamics.thrust_c2_per_s2",
            "rotor_dynamics.torque_c1_per_s",
            "rotor_dynamics.torque_c2_per_s2",
            "rotor_dynamics.torque_c3_per_s",
            "rotor_dynamics.torque_c4_per_s2",
        ];
        for (key, estimate) in keys.into_iter().zip(coefficients) {
            self.number(Bench::Response, key, estimate);
        }
    }

    pub(super) fn drag(&mut self, fit: &DragFit) -> Result<(), PipelineError> {
        if self.file.drag.is_none() {
            return Err(PipelineError::MissingGroup { group: "drag" });
        }
        self.number(Bench::Flight, "drag.quadratic_n_s2_m2[0]", fit.forward);
        self.number(Bench::Flight, "drag.quadratic_n_s2_m2[1]", fit.right);
        Ok(())
    }

    /// Checks that the file is a vehicle.
    pub(super) fn finished(self) -> Result<Self, PipelineError> {
        Vehicle::from_file(&self.file, &self.file.name).map_err(|e| PipelineError::Vehicle(Box::new(e)))?;
        Ok(self)
    }

    /// An identified number by its key.
    pub fn parameter(&self, key: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|p| p.key == key)
    }
}
