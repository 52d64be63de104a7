//! The whole vehicle: from the measurements of every bench to a vehicle file that all levels fly.
//!
//! ```text
//! support forces         centre of mass, mass = weight / g                        crate::centre_of_mass
//! bifilar pendulum       I_xx, I_yy, I_zz                                         crate::pendulum
//! load cells             volts to thrust and torque                               crate::load_cell, cells
//! static sweep           C_T, C_Q; cubics in (ū − ū_min) V_b                      crate::rotor_static
//! operating sweep        K_T, K_Q, ū_0 at one voltage                             crate::rotor_static
//! PRBS about hover       c_T1, c_T2, c_Q1 .. c_Q4; ω_R is the slower pole of the thrust   crate::rotor_dynamics
//! flight                 drag along x_B, y_B: m f_i = −k_i |v_i| v_i + bias       drag
//! ```
//!
//! What is not identified is taken from a nominal file and marked so in its source: geometry, gravity, air density, PWM range,
//! motor, battery, and of the drag the part along `z_B` and the rate damping. Those two a flight under control cannot
//! give: along `z_B` the rotors' thrust, known to a few percent of 14 N by the polynomials, hides a drag of tenths of a newton;
//! the moment of rate damping is of the size of what the same few percent make of thrust differences.
//!
//! Intervals: cubics and line are the best ones over the settings measured; what they miss of the rotor is no matter of an interval but
//! of a remark ([`crate::rotor_static`]). Rotor dynamics is that of the record's mean duty: excite evenly about hover.
//!
//! Pure: measurements in, vehicle out; no files. The pendulum's suspension takes the mass that it was given, usually from
//! the support test. Assumptions are those of each identification; the accelerometer sits in the centre of mass.

mod cells;
mod drag;
mod result;
#[cfg(test)]
mod tests;
mod virtual_bench;

pub use cells::{CellTest, Cells, DynamicReading, StaticReading};
pub use drag::{DragFit, identify_drag};
pub use result::{Bench, Identified, Parameter, Remarked};
pub use virtual_bench::{LaboratoryError, VirtualLaboratory};

use crate::centre_of_mass::{CentreOfMassError, Placing, locate};
use crate::laboratory::flights::FlightSample;
use crate::load_cell::LoadCellError;
use crate::pendulum::{AngleSample, Damping, PendulumError, Suspension, fit_history};
use crate::regression::FitError;
use crate::rotor_dynamics::{
    Coefficients, DynamicSample, IdentificationError, Poles, Record, RecordError, Start, Structure,
    identify as respond,
};
use crate::rotor_static::{
    LinearGains, PropellerSample, PropellerScale, Quantity, StaticError, StaticSample, coefficient,
    linear_gains, polynomial,
};
use quad_dynamics::VehicleError;
use quad_dynamics::vehicle::VehicleFile;

/// A swing about one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct SwingTest {
    /// The suspension; its mass and gravity are replaced by the identified mass and the file's gravity.
    pub suspension: Suspension,
    /// The angle.
    pub samples: Vec<AngleSample>,
}

/// The raw measurements of one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// Placings on three supports.
    pub placings: Vec<Placing>,
    /// Swings about `x_B`, `y_B`, `z_B`.
    pub swings: [SwingTest; 3],
    /// Calibration of the stand's thrust cell, N.
    pub thrust_cell: CellTest,
    /// Calibration of the stand's torque cell, N m.
    pub torque_cell: CellTest,
    /// Static sweep over duties and voltages, each setting read several times.
    pub sweep: Vec<StaticReading>,
    /// Static sweep at one voltage, over the range in which the vehicle flies, each setting read several times.
    pub operating: Vec<StaticReading>,
    /// Small pseudo-random changes of the duty about hover.
    pub dynamic: Vec<DynamicReading>,
    /// A flight with fast sides.
    pub flight: Vec<FlightSample>,
}

/// Why a vehicle was not identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PipelineError {
    /// Centre of mass.
    #[error("centre of mass: {0}")]
    CentreOfMass(#[from] CentreOfMassError),
    /// Moment of inertia.
    #[error("pendulum: {0}")]
    Pendulum(#[from] PendulumError),
    /// Load cells.
    #[error("load cell: {0}")]
    LoadCell(#[from] LoadCellError),
    /// Rotor statics.
    #[error("static sweep: {0}")]
    Static(#[from] StaticError),
    /// Rotor dynamics: the record.
    #[error("rotor response: {0}")]
    Record(#[from] RecordError),
    /// Rotor dynamics: the fit.
    #[error("rotor response: {0}")]
    Dynamics(#[from] IdentificationError),
    /// Rotor dynamics: no slower pole to take as the bandwidth.
    #[error("rotor response: the thrust has a complex pair of poles, so level 3 has no bandwidth for it")]
    ComplexPoles,
    /// Drag.
    #[error("flight: {0}")]
    Drag(FitError),
    /// A group that the nominal file must have.
    #[error("the identification needs [{group}], which the nominal file does not have")]
    MissingGroup {
        /// The group.
        group: &'static str,
    },
    /// The identified vehicle is invalid.
    #[error("the identified vehicle is invalid: {0}")]
    Vehicle(Box<VehicleError>),
}

/// Identifies the vehicle; what is not identified is taken from the nominal file.
///
/// # Errors
/// Data that one of the identifications refuses, a nominal file without propeller or drag, a result that is no vehicle.
pub fn identify(measurements: &Measurements, nominal: &VehicleFile) -> Result<Identified, PipelineError> {
    let mut found = Identified::from_nominal(nominal)?;
    airframe(measurements, nominal, &mut found)?;
    let cells = Cells::calibrated(&measurements.thrust_cell, &measurements.torque_cell)?;
    rotor_statics(measurements, &cells, nominal, &mut found)?;
    rotor_dynamics(measurements, &cells, &mut found)?;
    drag(measurements, &mut found)?;
    found.finished()
}

fn airframe(m: &Measurements, nominal: &VehicleFile, found: &mut Identified) -> Result<(), PipelineError> {
    let gravity = nominal.environment.gravity.value;
    let centre = locate(&m.placings)?;
    found.remark(Bench::Supports, centre.warnings);
    let mass = centre.weight.mapped(centre.weight.value / gravity, 1.0 / gravity);
    found.number(Bench::Supports, "airframe.mass_kg", mass);
    let centre_keys = [
        "airframe.centre_of_mass_m[0]",
        "airframe.centre_of_mass_m[1]",
        "airframe.centre_of_mass_m[2]",
    ];
    for (key, coordinate) in centre_keys.into_iter().zip(centre.position) {
        found.number(Bench::Supports, key, coordinate);
    }
    let inertia_keys = [
        "airframe.inertia_xx_kg_m2",
        "airframe.inertia_yy_kg_m2",
        "airframe.inertia_zz_kg_m2",
    ];
    for (swing, key) in m.swings.iter().zip(inertia_keys) {
        let suspension = Suspension {
            mass_kg: mass.value,
            gravity_m_s2: gravity,
            ..swing.suspension
        };
        let fit = fit_history(&suspension, &swing.samples, Damping::ViscousAndQuadratic)?;
        found.remark(Bench::Pendulum, fit.warnings);
        // I is nearly proportional to the mass, whose error comes on top of the swing's.
        let per_mass = fit.inertia.value / mass.value;
        let inertia = fit
            .inertia
            .with_error(per_mass * mass.standard_error, mass.degrees_of_freedom);
        found.number(Bench::Pendulum, key, inertia);
    }
    Ok(())
}

fn rotor_statics(
    m: &Measurements,
    cells: &Cells,
    nominal: &VehicleFile,
    found: &mut Identified,
) -> Result<(), PipelineError> {
    let sweep = cells.steady(&m.sweep);
    let operating = cells.steady(&m.operating);
    found.remark(
        Bench::LoadCells,
        cells.warnings(&[&sweep[..], &operating].concat()),
    );
    propeller(m, cells, &sweep, nominal, found)?;
    polynomials(m, cells, &sweep, nominal.pwm.minimum.value, found)?;

    let gains = linear_gains(&operating)?;
    let bench = Bench::OperatingSweep;
    found.remark(bench, gains.warnings().copied().collect());
    let all = |g: &LinearGains| [g.zero_thrust, g.thrust_gain, g.torque_gain];
    let again = |samples: &[StaticSample]| linear_gains(samples).map(|g| all(&g));
    let [zero, thrust, torque] = cells.with_errors(all(&gains), &m.operating, again)?;
    found.number(bench, "pwm.zero_thrust", zero);
    found.number(bench, "linear_rotor.thrust_gain_n", thrust);
    found.number(bench, "linear_rotor.torque_gain_n_m", torque);
    Ok(())
}

fn propeller(
    m: &Measurements,
    cells: &Cells,
    sweep: &[StaticSample],
    nominal: &VehicleFile,
    found: &mut Identified,
) -> Result<(), PipelineError> {
    let propeller = nominal
        .propeller
        .as_ref()
        .ok_or(PipelineError::MissingGroup { group: "propeller" })?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter.value,
        air_density_kg_m3: nominal.environment.air_density.value,
    };
    let both = |samples: &[StaticSample]| {
        let samples: Vec<PropellerSample> = samples.iter().map(PropellerSample::from).collect();
        let thrust = coefficient(&samples, &scale, Quantity::Thrust)?;
        Ok((thrust, coefficient(&samples, &scale, Quantity::Torque)?))
    };
    let (thrust, torque) = both(sweep)?;
    let bench = Bench::StaticSweep;
    let estimates = [thrust.parameters[0], torque.parameters[0]];
    found.remark(bench, [thrust.warnings, torque.warnings].concat());
    let again = |samples: &[StaticSample]| both(samples).map(|(t, q)| [t.parameters[0], q.parameters[0]]);
    let [thrust, torque] = cells.with_errors(estimates, &m.sweep, again)?;
    found.number(bench, "propeller.thrust_coefficient", thrust);
    found.number(bench, "propeller.torque_coefficient", torque);
    Ok(())
}

fn polynomials(
    m: &Measurements,
    cells: &Cells,
    sweep: &[StaticSample],
    minimum_duty: f64,
    found: &mut Identified,
) -> Result<(), PipelineError> {
    let mut estimates = Vec::with_capacity(2);
    for quantity in [Quantity::Thrust, Quantity::Torque] {
        let fit = polynomial(sweep, minimum_duty, quantity)?;
        let again =
            |samples: &[StaticSample]| polynomial(samples, minimum_duty, quantity).map(|f| f.parameters);
        estimates.push(cells.with_errors(fit.parameters, &m.sweep, again)?);
        found.remark(Bench::StaticSweep, fit.warnings);
    }
    found.polynomials(estimates[0], estimates[1]);
    Ok(())
}

fn rotor_dynamics(m: &Measurements, cells: &Cells, found: &mut Identified) -> Result<(), PipelineError> {
    let samples = cells.moving(&m.dynamic);
    let record = |output: fn(&DynamicSample) -> f64| Record::of(&samples, |s| s.duty, output);
    let thrust = respond(
        &record(|s| s.thrust_n)?,
        Structure::SecondOrder,
        Start::Equilibrium,
    )?;
    let torque = respond(
        &record(|s| s.torque_n_m)?,
        Structure::SecondOrderWithZero,
        Start::Equilibrium,
    )?;
    let Poles::Real { slow, .. } = thrust.poles else {
        return Err(PipelineError::ComplexPoles);
    };
    found.number(Bench::Response, "linear_rotor.bandwidth_rad_s", slow);
    if let (
        Coefficients::SecondOrder { c1, c2 },
        Coefficients::SecondOrderWithZero {
            c1: q1,
            c2: q2,
            c3,
            c4,
        },
    ) = (thrust.coefficients, torque.coefficients)
    {
        found.dynamics([c1, c2, q1, q2, c3, c4]);
    }
    found.remark(Bench::Response, [thrust.warnings, torque.warnings].concat());
    Ok(())
}

fn drag(m: &Measurements, found: &mut Identified) -> Result<(), PipelineError> {
    let mass = found.file.airframe.mass.value;
    let fit = identify_drag(&m.flight, mass).map_err(PipelineError::Drag)?;
    found.remark(Bench::Flight, fit.warnings());
    found.drag(&fit)
}
