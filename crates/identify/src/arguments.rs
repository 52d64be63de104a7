//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Identify the parameters of a quadrotor from measurements.
///
/// Exit codes: 0 identified (read the warnings); 1 data or a file rejected, no vehicle file written; 2 bad usage; 3 an output
/// could not be written.
#[derive(Debug, Parser)]
#[command(name = "identify", version)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) what: What,
}

/// What all identifications take.
#[derive(Debug, Args)]
pub(crate) struct Common {
    /// Measurements: a CSV file, or `-` for standard input.
    pub(crate) data: PathBuf,
    /// Vehicle file with what the identification needs to know; --out adds the result to a copy of it.
    #[arg(long)]
    pub(crate) vehicle: Option<PathBuf>,
    /// Write the vehicle file with the identified numbers to this file; comments and other numbers are kept.
    #[arg(long, requires = "vehicle")]
    pub(crate) out: Option<PathBuf>,
    /// Plot data, fit and residuals to this file, .svg or .png.
    #[arg(long, value_name = "FILE", value_parser = crate::plot::path)]
    pub(crate) plot: Option<PathBuf>,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Axis {
    Roll,
    Pitch,
    Yaw,
}

/// How the airframe hung.
#[derive(Debug, Args)]
pub(crate) struct Hung {
    /// Body axis that was vertical.
    #[arg(long)]
    pub(crate) axis: Axis,
    /// Mass of the vehicle, kg.
    #[arg(long)]
    pub(crate) mass_kg: f64,
    /// Distance of each string from the axis, m.
    #[arg(long)]
    pub(crate) half_spacing_m: f64,
    /// Length of the strings, m.
    #[arg(long)]
    pub(crate) length_m: f64,
    /// Gravitational acceleration, m/s².
    #[arg(long, default_value_t = 9.81)]
    pub(crate) gravity_m_s2: f64,
}

/// Rated load of the cell, whose unit says what the cell measures.
#[derive(Clone, Copy, Debug, Args)]
#[group(required = true, multiple = false)]
pub(crate) struct Capacity {
    /// Rated load of a force cell, N; the file needs the column load_n.
    #[arg(long)]
    pub(crate) capacity_n: Option<f64>,
    /// Rated load of a torque cell, N m; the file needs the column load_n_m and one direction only.
    #[arg(long)]
    pub(crate) capacity_n_m: Option<f64>,
}

/// Which rows the line of the linear rotor goes through.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct LineRange {
    /// Lowest raw duty of the operating range [default: lowest in the file].
    #[arg(long)]
    pub(crate) line_from: Option<f64>,
    /// Highest raw duty of the operating range [default: highest in the file].
    #[arg(long)]
    pub(crate) line_to: Option<f64>,
}

/// Which part of a flight, and which motors.
#[derive(Clone, Debug, Args)]
pub(crate) struct Flown {
    /// Start of the part to use, s on the file's clock [default: one second after the first row].
    #[arg(long)]
    pub(crate) from: Option<f64>,
    /// End of the part to use, s [default: the last row].
    #[arg(long)]
    pub(crate) to: Option<f64>,
    /// Mass as flown, kg [default: the vehicle file's].
    #[arg(long)]
    pub(crate) mass_kg: Option<f64>,
    /// ULog only: the autopilot's numbers of the four motors, in the order of the vehicle file's rotors, as in 1,2,3,4.
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2, 3, 4])]
    pub(crate) motors: Vec<usize>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum What {
    /// Find the centre of mass and the weight from the forces on three supports, in two orientations or more.
    CentreOfMass(Common),
    /// Find a moment of inertia from the swing of a bifilar pendulum.
    Pendulum {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        hung: Hung,
    },
    /// Find the zero and sensitivity of a force or torque cell from loads and readings.
    LoadCell {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        capacity: Capacity,
    },
    /// Find propeller coefficients, cubics and linear gains from a static sweep; needs --vehicle for diameter, density, PWM range.
    ThrustStand {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        range: LineRange,
    },
    /// Find transfer functions of thrust and torque, and the bandwidth, from a step or pseudo-random sequence.
    RotorResponse(Common),
    /// Find the thrust curve, motor lag and moments of inertia from a flight log (CSV, or PX4's .ulg); needs --vehicle.
    Flight {
        #[command(flatten)]
        common: Common,
        #[command(flatten)]
        flown: Flown,
    },
    /// Print an example measurement file with its columns and units explained: `identify template pendulum > my.csv`.
    Template {
        /// Identification that reads the file.
        kind: Kind,
    },
}

impl What {
    /// The command's name, as the user writes it.
    pub(crate) fn command(&self) -> &'static str {
        match self {
            Self::CentreOfMass(_) => "centre-of-mass",
            Self::Pendulum { .. } => "pendulum",
            Self::LoadCell { .. } => "load-cell",
            Self::ThrustStand { .. } => "thrust-stand",
            Self::RotorResponse(_) => "rotor-response",
            Self::Flight { .. } => "flight",
            Self::Template { .. } => "template",
        }
    }
}

/// The kinds of file, by the names of their commands.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Kind {
    CentreOfMass,
    Pendulum,
    LoadCell,
    /// Of the command load-cell, for a torque cell.
    LoadCellTorque,
    ThrustStand,
    RotorResponse,
    Flight,
}

impl Kind {
    /// An example of the identification's file, from the virtual laboratory.
    pub(crate) fn template(self) -> &'static str {
        match self {
            Self::CentreOfMass => include_str!("../template/centre-of-mass.csv"),
            Self::Pendulum => include_str!("../template/pendulum.csv"),
            Self::LoadCell => include_str!("../template/load-cell.csv"),
            Self::LoadCellTorque => include_str!("../template/load-cell-torque.csv"),
            Self::ThrustStand => include_str!("../template/thrust-stand.csv"),
            Self::RotorResponse => include_str!("../template/rotor-response.csv"),
            Self::Flight => include_str!("../template/flight.csv"),
        }
    }
}
