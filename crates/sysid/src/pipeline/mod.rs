//! The whole vehicle: from the measurements of every bench to a vehicle file that all levels fly.
//!
//! ```text
//! support forces         centre of mass, mass = weight / g                        crate::centre_of_mass
//! bifilar pendulum       I_xx, I_yy, I_zz                                         crate::pendulum
//! static sweep           C_T, C_Q; cubics in (ū − ū_min) V_b                      crate::rotor_static
//! operating sweep        K_T, K_Q, ū_0 at one voltage                             crate::rotor_static
//! PRBS about hover       c_T1, c_T2, c_Q1 .. c_Q4; ω_R is the slower pole of the thrust   crate::rotor_dynamics
//! flight                 drag along x_B, y_B: m f_i = −k_i |v_i| v_i + bias       drag
//! ```
//!
//! What is not identified is taken from a nominal file and says so in its source: geometry, gravity, air density, PWM range,
//! motor, battery, and of the drag the part along `z_B` and the rate damping. Those two a flight under control cannot
//! give: along `z_B` the rotors' thrust, known to a few percent of 14 N by the polynomials, hides a drag of tenths of a newton;
//! the moment of rate damping is of the size of what the same few percent make of thrust differences.
//!
//! Pure: measurements in, vehicle out; no files. The pendulum's suspension takes the mass that it was given, usually from
//! the support test. Assumptions are those of each identification; the accelerometer sits in the centre of mass.

mod drag;
mod result;
#[cfg(test)]
mod tests;
mod virtual_bench;

pub use drag::{DragFit, identify_drag};
pub use result::{Bench, Identified, Parameter, Remarked};
pub use virtual_bench::{LaboratoryError, VirtualLaboratory};

use crate::centre_of_mass::{CentreOfMassError, Placing, locate};
use crate::laboratory::flights::FlightSample;
use crate::pendulum::{AngleSample, Damping, PendulumError, Suspension, fit_history};
use crate::regression::FitError;
use crate::rotor_dynamics::{
    Coefficients, DynamicSample, IdentificationError, Poles, Record, RecordError, Start, Structure,
    identify as respond,
};
use crate::rotor_static::{
    PropellerSample, PropellerScale, Quantity, StaticError, StaticSample, coefficient, linear_gains,
    polynomial,
};
use quad_dynamics::VehicleError;
use quad_dynamics::vehicle::file::VehicleFile;

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
    /// Static sweep over duties and voltages.
    pub sweep: Vec<StaticSample>,
    /// Static sweep at one voltage, over the range in which the vehicle flies.
    pub operating: Vec<StaticSample>,
    /// Small pseudo-random changes of the duty about hover.
    pub dynamic: Vec<DynamicSample>,
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
    #[error(
        "rotor response: the thrust answers with a complex pair of poles: level 3 has no bandwidth for it"
    )]
    ComplexPoles,
    /// Drag.
    #[error("flight: {0}")]
    Drag(FitError),
    /// A group that the nominal file must have.
    #[error("the nominal file has no [{group}], which the identification needs")]
    MissingGroup {
        /// The group.
        group: &'static str,
    },
    /// The identified vehicle is none.
    #[error("the identified vehicle is refused: {0}")]
    Vehicle(Box<VehicleError>),
}

/// Identifies the vehicle; what is not identified is taken from the nominal file.
///
/// # Errors
/// Data that one of the identifications refuses, a nominal file without propeller or drag, a result that is no vehicle.
pub fn identify(measurements: &Measurements, nominal: &VehicleFile) -> Result<Identified, PipelineError> {
    let mut found = Identified::from_nominal(nominal)?;
    airframe(measurements, nominal, &mut found)?;
    rotor_statics(measurements, nominal, &mut found)?;
    rotor_dynamics(measurements, &mut found)?;
    drag(measurements, &mut found)?;
    found.finished()
}

fn airframe(m: &Measurements, nominal: &VehicleFile, found: &mut Identified) -> Result<(), PipelineError> {
    let gravity = nominal.environment.gravity_m_s2.value;
    let centre = locate(&m.placings)?;
    found.remark(Bench::Supports, centre.warnings);
    let mass = centre.weight.mapped(centre.weight.value / gravity, 1.0 / gravity);
    found.number(Bench::Supports, "airframe.mass_kg", "kg", mass, |f| {
        &mut f.airframe.mass_kg
    });
    let names = [
        "airframe.centre_of_mass_m[0]",
        "airframe.centre_of_mass_m[1]",
        "airframe.centre_of_mass_m[2]",
    ];
    found.triple(Bench::Supports, names, "m", centre.position.map(Some), |f| {
        &mut f.airframe.centre_of_mass_m
    });

    let places: [(&'static str, result::Place); 3] = [
        ("airframe.inertia_xx_kg_m2", |f| &mut f.airframe.inertia_xx_kg_m2),
        ("airframe.inertia_yy_kg_m2", |f| &mut f.airframe.inertia_yy_kg_m2),
        ("airframe.inertia_zz_kg_m2", |f| &mut f.airframe.inertia_zz_kg_m2),
    ];
    for (swing, (key, place)) in m.swings.iter().zip(places) {
        let suspension = Suspension {
            mass_kg: mass.value,
            gravity_m_s2: gravity,
            ..swing.suspension
        };
        let fit = fit_history(&suspension, &swing.samples, Damping::ViscousAndQuadratic)?;
        found.remark(Bench::Pendulum, fit.warnings);
        // I is nearly proportional to the mass, whose error comes on top of the swing's.
        let per_mass = fit.inertia.value / mass.value;
        let mut inertia = fit.inertia;
        inertia.standard_error = inertia.standard_error.hypot(per_mass * mass.standard_error);
        found.number(Bench::Pendulum, key, "kg m²", inertia, place);
    }
    Ok(())
}

fn rotor_statics(
    m: &Measurements,
    nominal: &VehicleFile,
    found: &mut Identified,
) -> Result<(), PipelineError> {
    let propeller = nominal
        .propeller
        .as_ref()
        .ok_or(PipelineError::MissingGroup { group: "propeller" })?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter_m.value,
        air_density_kg_m3: nominal.environment.air_density_kg_m3.value,
    };
    let samples: Vec<PropellerSample> = m.sweep.iter().map(PropellerSample::from).collect();
    let thrust = coefficient(&samples, &scale, Quantity::Thrust)?;
    let torque = coefficient(&samples, &scale, Quantity::Torque)?;
    found.remark(Bench::StaticSweep, [thrust.warnings, torque.warnings].concat());
    let bench = Bench::StaticSweep;
    found.number(
        bench,
        "propeller.thrust_coefficient",
        "",
        thrust.parameters[0],
        |f| result::propeller(f, |p| &mut p.thrust_coefficient),
    );
    found.number(
        bench,
        "propeller.torque_coefficient",
        "",
        torque.parameters[0],
        |f| result::propeller(f, |p| &mut p.torque_coefficient),
    );
    found.polynomials(
        &polynomial(&m.sweep, nominal.pwm.minimum.value, Quantity::Thrust)?,
        &polynomial(&m.sweep, nominal.pwm.minimum.value, Quantity::Torque)?,
    );

    let gains = linear_gains(&m.operating)?;
    let bench = Bench::OperatingSweep;
    found.remark(bench, gains.warnings().copied().collect());
    found.number(bench, "pwm.zero_thrust", "", gains.zero_thrust, |f| {
        &mut f.pwm.zero_thrust
    });
    found.number(bench, "linear_rotor.thrust_gain_n", "N", gains.thrust_gain, |f| {
        &mut f.linear_rotor.thrust_gain_n
    });
    found.number(
        bench,
        "linear_rotor.torque_gain_n_m",
        "N m",
        gains.torque_gain,
        |f| &mut f.linear_rotor.torque_gain_n_m,
    );
    Ok(())
}

fn rotor_dynamics(m: &Measurements, found: &mut Identified) -> Result<(), PipelineError> {
    let record = |output: fn(&DynamicSample) -> f64| Record::of(&m.dynamic, |s| s.duty, output);
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
    found.number(
        Bench::Response,
        "linear_rotor.bandwidth_rad_s",
        "rad/s",
        slow,
        |f| &mut f.linear_rotor.bandwidth_rad_s,
    );
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
    let mass = found.file.airframe.mass_kg.value;
    let fit = identify_drag(&m.flight, mass).map_err(PipelineError::Drag)?;
    found.remark(Bench::Flight, fit.warnings());
    found.drag(&fit)
}
