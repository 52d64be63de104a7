//! The identified vehicle: the file, the list of its identified numbers, and what must be known about them.

use super::{DragFit, PipelineError};
use crate::estimate::{Estimate, Warning};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::file::{
    Number, PolynomialRotorFile, PropellerFile, RotorDynamicsFile, Triple, VehicleFile,
};
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

/// Where a number is in the file.
pub(super) type Place = fn(&mut VehicleFile) -> &mut Number;

/// A number of the propeller's group, which [`Identified::from_nominal`] makes sure of.
pub(super) fn propeller(file: &mut VehicleFile, of: fn(&mut PropellerFile) -> &mut Number) -> &mut Number {
    let none = || Number::new(f64::NAN, "");
    of(file.propeller.get_or_insert_with(|| PropellerFile {
        diameter_m: none(),
        thrust_coefficient: none(),
        torque_coefficient: none(),
    }))
}

fn source(bench: Bench) -> String {
    format!("identified: {bench}")
}

/// An identified number as the file takes it.
fn sourced(bench: Bench, estimate: Estimate) -> Number {
    Number {
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
        mark(&mut file);
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

    fn list(&mut self, bench: Bench, key: &'static str, unit: &'static str, estimate: Estimate) {
        self.parameters.push(Parameter {
            key,
            unit,
            estimate,
            bench,
        });
    }

    pub(super) fn number(
        &mut self,
        bench: Bench,
        key: &'static str,
        unit: &'static str,
        estimate: Estimate,
        place: Place,
    ) {
        *place(&mut self.file) = sourced(bench, estimate);
        self.list(bench, key, unit, estimate);
    }

    /// Components of a triple; those not identified keep their value, with standard error 0 and a word in the source.
    pub(super) fn triple(
        &mut self,
        bench: Bench,
        keys: [&'static str; 3],
        unit: &'static str,
        estimates: [Option<Estimate>; 3],
        place: fn(&mut VehicleFile) -> &mut Triple,
    ) {
        let triple = place(&mut self.file);
        let kept = triple.source.clone();
        let mut errors = [0.0; 3];
        for (i, estimate) in estimates.iter().enumerate() {
            if let Some(estimate) = estimate {
                (triple.value[i], errors[i]) = (estimate.value, estimate.standard_error);
            }
        }
        triple.standard_error = Some(errors);
        triple.source = if estimates.iter().all(Option::is_some) {
            source(bench)
        } else {
            format!("{}; components with standard error 0: {kept}", source(bench))
        };
        for (key, estimate) in keys.into_iter().zip(estimates) {
            if let Some(estimate) = estimate {
                self.list(bench, key, unit, estimate);
            }
        }
    }

    /// Coefficients `k_1, k_2, k_3` of both cubics.
    pub(super) fn polynomials(&mut self, thrust: [Estimate; 3], torque: [Estimate; 3]) {
        let bench = Bench::StaticSweep;
        let [t1, t2, t3] = thrust;
        let [q1, q2, q3] = torque;
        self.file.polynomial_rotor = Some(PolynomialRotorFile {
            thrust_k1_n_per_v: sourced(bench, t1),
            thrust_k2_n_per_v2: sourced(bench, t2),
            thrust_k3_n_per_v3: sourced(bench, t3),
            torque_k1_n_m_per_v: sourced(bench, q1),
            torque_k2_n_m_per_v2: sourced(bench, q2),
            torque_k3_n_m_per_v3: sourced(bench, q3),
        });
        self.list(bench, "polynomial_rotor.thrust_k1_n_per_v", "N/V", t1);
        self.list(bench, "polynomial_rotor.thrust_k2_n_per_v2", "N/V²", t2);
        self.list(bench, "polynomial_rotor.thrust_k3_n_per_v3", "N/V³", t3);
        self.list(bench, "polynomial_rotor.torque_k1_n_m_per_v", "N m/V", q1);
        self.list(bench, "polynomial_rotor.torque_k2_n_m_per_v2", "N m/V²", q2);
        self.list(bench, "polynomial_rotor.torque_k3_n_m_per_v3", "N m/V³", q3);
    }

    /// Coefficients in the order `c_T1, c_T2, c_Q1 .. c_Q4`.
    pub(super) fn dynamics(&mut self, coefficients: [Estimate; 6]) {
        let bench = Bench::Response;
        let [t1, t2, q1, q2, q3, q4] = coefficients;
        self.file.rotor_dynamics = Some(RotorDynamicsFile {
            thrust_c1_per_s: sourced(bench, t1),
            thrust_c2_per_s2: sourced(bench, t2),
            torque_c1_per_s: sourced(bench, q1),
            torque_c2_per_s2: sourced(bench, q2),
            torque_c3_per_s: sourced(bench, q3),
            torque_c4_per_s2: sourced(bench, q4),
        });
        self.list(bench, "rotor_dynamics.thrust_c1_per_s", "1/s", t1);
        self.list(bench, "rotor_dynamics.thrust_c2_per_s2", "1/s²", t2);
        self.list(bench, "rotor_dynamics.torque_c1_per_s", "1/s", q1);
        self.list(bench, "rotor_dynamics.torque_c2_per_s2", "1/s²", q2);
        self.list(bench, "rotor_dynamics.torque_c3_per_s", "1/s", q3);
        self.list(bench, "rotor_dynamics.torque_c4_per_s2", "1/s²", q4);
    }

    pub(super) fn drag(&mut self, fit: &DragFit) -> Result<(), PipelineError> {
        let Some(drag) = self.file.drag.as_mut() else {
            return Err(PipelineError::MissingGroup { group: "drag" });
        };
        let bench = Bench::Flight;
        let kept = std::mem::take(&mut drag.quadratic_n_s2_m2.source);
        let vertical = drag.quadratic_n_s2_m2.value[2];
        drag.quadratic_n_s2_m2 = Triple {
            value: [fit.forward.value, fit.right.value, vertical],
            source: format!("{} (x and y); z {kept}", source(bench)),
            standard_error: Some([fit.forward.standard_error, fit.right.standard_error, 0.0]),
        };
        self.list(bench, "drag.quadratic_n_s2_m2[0]", "N s²/m²", fit.forward);
        self.list(bench, "drag.quadratic_n_s2_m2[1]", "N s²/m²", fit.right);
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

/// Says of every number that it was not identified; those identified later lose the word with their source.
fn mark(file: &mut VehicleFile) {
    let mut texts: Vec<&mut String> = Vec::new();
    let VehicleFile {
        environment,
        airframe,
        rotors,
        pwm,
        linear_rotor,
        propeller,
        motor,
        battery,
        drag,
        arms,
        // Identified as whole groups.
        rotor_dynamics: _,
        polynomial_rotor: _,
        name: _,
        description: _,
    } = file;
    texts.extend([
        &mut environment.gravity_m_s2.source,
        &mut environment.air_density_kg_m3.source,
    ]);
    texts.extend([&mut airframe.arm_length_m.source]);
    let products = [
        &mut airframe.inertia_xy_kg_m2,
        &mut airframe.inertia_xz_kg_m2,
        &mut airframe.inertia_yz_kg_m2,
    ];
    texts.extend(products.into_iter().flatten().map(|n| &mut n.source));
    texts.extend(rotors.iter_mut().map(|r| &mut r.hub_position_m.source));
    texts.extend([&mut pwm.minimum.source, &mut pwm.maximum.source]);
    texts.extend([&mut linear_rotor.bandwidth_rad_s.source]);
    texts.extend(propeller.iter_mut().map(|p| &mut p.diameter_m.source));
    if let Some(m) = motor {
        texts.extend([
            &mut m.velocity_constant_rad_s_v.source,
            &mut m.resistance_ohm.source,
            &mut m.no_load_current_a.source,
            &mut m.rotor_inertia_kg_m2.source,
            &mut m.controller_lag_s.source,
            &mut m.full_voltage_duty.source,
        ]);
    }
    if let Some(b) = battery {
        texts.extend([
            &mut b.nominal_voltage_v.source,
            &mut b.full_voltage_v.source,
            &mut b.internal_resistance_ohm.source,
            &mut b.capacity_ah.source,
            &mut b.exponential_amplitude_v.source,
            &mut b.exponential_rate_per_ah.source,
        ]);
    }
    if let Some(d) = drag {
        texts.extend([&mut d.quadratic_n_s2_m2.source, &mut d.rate_damping_n_m_s.source]);
    }
    if let Some(a) = arms {
        texts.extend([
            &mut a.width_m.source,
            &mut a.drag_coefficient.source,
            &mut a.drop_m.source,
        ]);
    }
    for text in texts {
        *text = format!("not identified, taken from the nominal file: {text}");
    }
}
