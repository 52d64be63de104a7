//! `identify`: one command per identification, from a CSV of measurements to a printed table and a vehicle file.

mod input;
mod output;

use clap::{Args, Parser, Subcommand, ValueEnum};
use output::{Answer, Found};
use quad_dynamics::vehicle::file::VehicleFile;
use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use sysid::centre_of_mass::locate;
use sysid::load_cell::calibrate;
use sysid::pendulum::{Damping, Suspension, fit_history};
use sysid::rotor_dynamics::{Coefficients, Record, Start, Structure, identify as respond};
use sysid::rotor_static::{PropellerSample, PropellerScale, Quantity, coefficient, polynomial};

/// Exit code when the data or a file are refused.
const REFUSED: u8 = 1;

/// Identifies parts of a quadrotor from measurements in CSV files.
///
/// Exit codes: 0 identified (read the warnings); 1 data or a file refused, nothing is written; 2 bad usage.
#[derive(Debug, Parser)]
#[command(name = "identify", version)]
struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Args)]
struct Common {
    /// The measurements.
    data: PathBuf,
    /// Vehicle file that gives what the identification needs to know, and that --out completes.
    #[arg(long)]
    vehicle: Option<PathBuf>,
    /// Where to write the vehicle file with the identified numbers.
    #[arg(long, requires = "vehicle")]
    out: Option<PathBuf>,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Axis {
    Roll,
    Pitch,
    Yaw,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Centre of mass and weight from the forces on three supports, in two orientations or more.
    CentreOfMass(Common),
    /// Moment of inertia from the swing of a bifilar pendulum.
    Pendulum {
        #[command(flatten)]
        common: Common,
        /// Axis of the airframe that was vertical.
        #[arg(long)]
        axis: Axis,
        /// Mass of the vehicle, kg.
        #[arg(long)]
        mass_kg: f64,
        /// Distance of each string from the axis, m.
        #[arg(long)]
        half_spacing_m: f64,
        /// Length of the strings, m.
        #[arg(long)]
        length_m: f64,
        /// Gravitational acceleration, m/s².
        #[arg(long, default_value_t = 9.81)]
        gravity_m_s2: f64,
    },
    /// Zero and sensitivity of a thrust cell from loads and readings.
    LoadCell {
        #[command(flatten)]
        common: Common,
        /// Rated load of the cell, N.
        #[arg(long)]
        capacity_n: f64,
    },
    /// Propeller coefficients and cubics from a static sweep; needs --vehicle for diameter, density and PWM range.
    ThrustStand(Common),
    /// Transfer functions of thrust and torque from a step or pseudo-random sequence.
    RotorResponse(Common),
    /// Prints an example of a file, its columns and units explained: `identify template pendulum > my.csv`.
    Template {
        /// Which identification's file.
        kind: Kind,
    },
}

/// The identifications, by the names of their commands.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    CentreOfMass,
    Pendulum,
    LoadCell,
    ThrustStand,
    RotorResponse,
}

impl Kind {
    /// An example of the identification's file, from the virtual laboratory.
    fn template(self) -> &'static str {
        match self {
            Self::CentreOfMass => include_str!("../template/centre-of-mass.csv"),
            Self::Pendulum => include_str!("../template/pendulum.csv"),
            Self::LoadCell => include_str!("../template/load-cell.csv"),
            Self::ThrustStand => include_str!("../template/thrust-stand.csv"),
            Self::RotorResponse => include_str!("../template/rotor-response.csv"),
        }
    }
}

fn main() -> ExitCode {
    match run(&Arguments::parse().what) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(REFUSED)
        }
    }
}

fn run(what: &What) -> Result<(), Box<dyn Error>> {
    let (common, answer) = match what {
        What::CentreOfMass(common) => (common, centre_of_mass(common)?),
        What::Pendulum {
            common,
            axis,
            mass_kg,
            half_spacing_m,
            length_m,
            gravity_m_s2,
        } => {
            let suspension = Suspension {
                mass_kg: *mass_kg,
                half_spacing_m: *half_spacing_m,
                length_m: *length_m,
                gravity_m_s2: *gravity_m_s2,
            };
            (common, pendulum(common, *axis, &suspension)?)
        }
        What::LoadCell { common, capacity_n } => (common, load_cell(common, *capacity_n)?),
        What::ThrustStand(common) => (common, thrust_stand(common)?),
        What::RotorResponse(common) => (common, rotor_response(common)?),
        What::Template { kind } => {
            print!("{}", kind.template());
            return Ok(());
        }
    };
    if let (Some(vehicle), Some(out)) = (&common.vehicle, &common.out) {
        let text = output::updated(&input::text(vehicle)?, vehicle, &answer.found)?;
        fs::write(out, text).map_err(|e| format!("{}: {e}", out.display()))?;
    }
    for warning in &answer.warnings {
        eprintln!("warning: {warning}");
    }
    if common.json {
        println!("{}", output::json(&answer));
    } else {
        print!("{}", output::table(&answer));
    }
    Ok(())
}

fn centre_of_mass(common: &Common) -> Result<Answer, Box<dyn Error>> {
    let (placings, mut answer) = input::placings(&common.data)?;
    let fit = locate(&placings)?;
    answer.warn(&fit.warnings);
    let keys = [
        "airframe.centre_of_mass_m[0]",
        "airframe.centre_of_mass_m[1]",
        "airframe.centre_of_mass_m[2]",
    ];
    answer.found.extend(
        keys.iter()
            .zip(fit.position)
            .map(|(key, e)| Found::new(key, "m", e)),
    );
    answer.found.push(Found::new("weight", "N", fit.weight));
    Ok(answer)
}

fn pendulum(common: &Common, axis: Axis, suspension: &Suspension) -> Result<Answer, Box<dyn Error>> {
    let (samples, mut answer) = input::swing(&common.data)?;
    let fit = fit_history(suspension, &samples, Damping::ViscousAndQuadratic)?;
    answer.warn(&fit.warnings);
    let key = match axis {
        Axis::Roll => "airframe.inertia_xx_kg_m2",
        Axis::Pitch => "airframe.inertia_yy_kg_m2",
        Axis::Yaw => "airframe.inertia_zz_kg_m2",
    };
    answer.found.push(Found::new(key, "kg m²", fit.inertia));
    Ok(answer)
}

fn load_cell(common: &Common, capacity_n: f64) -> Result<Answer, Box<dyn Error>> {
    let (samples, mut answer) = input::loads(&common.data)?;
    let calibration = calibrate(&samples, capacity_n)?;
    answer.warn(&calibration.line.warnings);
    answer.found.push(Found::new("zero", "V", calibration.zero()));
    answer
        .found
        .push(Found::new("sensitivity", "V/N", calibration.sensitivity()));
    Ok(answer)
}

fn thrust_stand(common: &Common) -> Result<Answer, Box<dyn Error>> {
    let path = common
        .vehicle
        .as_ref()
        .ok_or("a thrust stand needs --vehicle: diameter, air density and PWM range")?;
    let vehicle = VehicleFile::from_toml_str(&input::text(path)?, &path.display().to_string())?;
    let propeller = vehicle
        .propeller
        .as_ref()
        .ok_or("the vehicle file has no [propeller] with its diameter")?;
    let scale = PropellerScale {
        diameter_m: propeller.diameter_m.value,
        air_density_kg_m3: vehicle.environment.air_density_kg_m3.value,
    };
    let (samples, mut answer) = input::sweep(&common.data)?;
    let steady: Vec<PropellerSample> = samples.iter().map(PropellerSample::from).collect();
    for (quantity, key) in [
        (Quantity::Thrust, "propeller.thrust_coefficient"),
        (Quantity::Torque, "propeller.torque_coefficient"),
    ] {
        let fit = coefficient(&steady, &scale, quantity)?;
        answer.warn(&fit.warnings);
        answer.found.push(Found::new(key, "", fit.parameters[0]));
    }
    for (quantity, name, unit) in [
        (Quantity::Thrust, "thrust", "n"),
        (Quantity::Torque, "torque", "n_m"),
    ] {
        let fit = polynomial(&samples, vehicle.pwm.minimum.value, quantity)?;
        answer.warn(&fit.warnings);
        for (power, estimate) in (1..).zip(fit.parameters) {
            let suffix = if power == 1 {
                String::new()
            } else {
                power.to_string()
            };
            let key = format!("polynomial_rotor.{name}_k{power}_{unit}_per_v{suffix}");
            answer.found.push(Found::new(&key, "", estimate));
        }
    }
    Ok(answer)
}

fn rotor_response(common: &Common) -> Result<Answer, Box<dyn Error>> {
    let (samples, mut answer) = input::response(&common.data)?;
    let thrust = Record::of(&samples, |s| s.duty, |s| s.thrust_n)?;
    let torque = Record::of(&samples, |s| s.duty, |s| s.torque_n_m)?;
    let thrust = respond(&thrust, Structure::SecondOrder, Start::Free)?;
    let torque = respond(&torque, Structure::SecondOrderWithZero, Start::Free)?;
    answer.warn(&thrust.warnings);
    answer.warn(&torque.warnings);
    let mut push = |key: &str, unit, estimate| answer.found.push(Found::new(key, unit, estimate));
    if let Coefficients::SecondOrder { c1, c2 } = thrust.coefficients {
        push("rotor_dynamics.thrust_c1_per_s", "1/s", c1);
        push("rotor_dynamics.thrust_c2_per_s2", "1/s²", c2);
    }
    if let Coefficients::SecondOrderWithZero { c1, c2, c3, c4 } = torque.coefficients {
        push("rotor_dynamics.torque_c1_per_s", "1/s", c1);
        push("rotor_dynamics.torque_c2_per_s2", "1/s²", c2);
        push("rotor_dynamics.torque_c3_per_s", "1/s", c3);
        push("rotor_dynamics.torque_c4_per_s2", "1/s²", c4);
    }
    Ok(answer)
}
