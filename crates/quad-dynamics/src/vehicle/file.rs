//! The vehicle file: the TOML schema as types, every number with its source beside it.
//!
//! The file is the only place where a number and its source live together; [`Vehicle`](super::Vehicle) holds bare
//! numbers, so that a study that changes one does not leave a source behind that never said so.

use serde::{Deserialize, Serialize};

use super::{Spin, VehicleError};

/// A value with the source that says where it comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sourced<T> {
    /// The value, in the unit that ends the key.
    pub value: T,
    /// Where the value comes from: citation, data file, derivation or, said plainly, an assumption.
    pub source: String,
    /// Standard error of the value in the same unit, where it was measured or identified.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<T>,
}

impl<T> Sourced<T> {
    /// A value and its source, no standard error.
    pub fn new(value: T, source: &str) -> Self {
        Self {
            value,
            source: source.to_owned(),
            standard_error: None,
        }
    }
}

/// A number with its source.
pub type Number = Sourced<f64>;
/// Three numbers with their common source.
pub type Triple = Sourced<[f64; 3]>;

/// A vehicle file as it is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VehicleFile {
    /// Name of the vehicle, as legends and messages print it.
    pub name: String,
    /// One or two sentences: what it is and where its numbers come from as a whole.
    pub description: String,
    /// Where it flies.
    pub environment: EnvironmentFile,
    /// Rigid body.
    pub airframe: AirframeFile,
    /// The four rotors, in the order of the commands.
    pub rotors: Vec<RotorFile>,
    /// Range of the raw PWM command.
    pub pwm: PwmFile,
    /// Linear rotor, levels 1 to 4.
    pub linear_rotor: LinearRotorFile,
    /// Transfer functions of the empirical rotor, levels 4 and 5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor_dynamics: Option<RotorDynamicsFile>,
    /// Static polynomials of the empirical rotor, level 5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polynomial_rotor: Option<PolynomialRotorFile>,
    /// Propeller, mechanistic rotor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub propeller: Option<PropellerFile>,
    /// Motor and speed controller, mechanistic rotor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motor: Option<MotorFile>,
    /// Battery.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub battery: Option<BatteryFile>,
    /// Drag and rate damping of the airframe.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drag: Option<DragFile>,
    /// Arms under the rotors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arms: Option<ArmsFile>,
}

impl VehicleFile {
    /// Reads the text of a vehicle file; `origin` is the file's name in messages.
    ///
    /// # Errors
    /// Not TOML, a missing or unknown key, or a value of the wrong type, each with line, column and key path.
    pub fn from_toml_str(text: &str, origin: &str) -> Result<Self, VehicleError> {
        let deserializer =
            toml::Deserializer::parse(text).map_err(|error| syntax_error(text, origin, &error))?;
        serde_path_to_error::deserialize(deserializer)
            .map_err(|error| schema_error(text, origin, &error.path().to_string(), error.inner()))
    }

    /// The file as TOML text, which [`VehicleFile::from_toml_str`] reads back unchanged.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("numbers, texts and tables are all representable in TOML")
    }
}

/// The TOML table `[environment]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnvironmentFile {
    /// Gravitational acceleration g, m/s².
    pub gravity_m_s2: Number,
    /// Air density ρ, kg/m³.
    pub air_density_kg_m3: Number,
}

/// The TOML table `[airframe]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirframeFile {
    /// Mass m, kg.
    pub mass_kg: Number,
    /// Moment of inertia about x_B, I_xx, kg·m².
    pub inertia_xx_kg_m2: Number,
    /// Moment of inertia about y_B, I_yy, kg·m².
    pub inertia_yy_kg_m2: Number,
    /// Moment of inertia about z_B, I_zz, kg·m².
    pub inertia_zz_kg_m2: Number,
    /// Off-diagonal element of the inertia matrix in row x, column y, kg·m² (`−∫xy dm`); 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_xy_kg_m2: Option<Number>,
    /// Off-diagonal element in row x, column z, kg·m² (`−∫xz dm`); 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_xz_kg_m2: Option<Number>,
    /// Off-diagonal element in row y, column z, kg·m² (`−∫yz dm`); 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_yz_kg_m2: Option<Number>,
    /// Arm length L from the geometric centre to a hub, m.
    pub arm_length_m: Number,
    /// Centre of mass in the airframe's geometric frame, body axes, m.
    pub centre_of_mass_m: Triple,
}

/// One entry of the TOML array `[[rotors]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotorFile {
    /// Name of the place, as in `rear`.
    pub name: String,
    /// Hub in the airframe's geometric frame, body axes, m.
    pub hub_position_m: Triple,
    /// Sense of rotation seen from above.
    pub spin: Spin,
}

/// The TOML table `[pwm]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PwmFile {
    /// Lower end of the raw duty ū_min.
    pub minimum: Number,
    /// Upper end of the raw duty ū_max.
    pub maximum: Number,
    /// Zero-thrust duty ū_0.
    pub zero_thrust: Number,
}

/// The TOML table `[linear_rotor]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinearRotorFile {
    /// Thrust gain K_T, N per unit of zeroed duty.
    pub thrust_gain_n: Number,
    /// Torque gain K_Q, N·m per unit of zeroed duty.
    pub torque_gain_n_m: Number,
    /// Bandwidth ω_R, rad/s.
    pub bandwidth_rad_s: Number,
}

/// The TOML table `[rotor_dynamics]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotorDynamicsFile {
    /// c_T1, 1/s.
    pub thrust_c1_per_s: Number,
    /// c_T2, 1/s².
    pub thrust_c2_per_s2: Number,
    /// c_Q1, 1/s.
    pub torque_c1_per_s: Number,
    /// c_Q2, 1/s².
    pub torque_c2_per_s2: Number,
    /// c_Q3, 1/s.
    pub torque_c3_per_s: Number,
    /// c_Q4, 1/s².
    pub torque_c4_per_s2: Number,
}

/// The TOML table `[polynomial_rotor]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PolynomialRotorFile {
    /// Thrust, linear term, N/V.
    pub thrust_k1_n_per_v: Number,
    /// Thrust, quadratic term, N/V².
    pub thrust_k2_n_per_v2: Number,
    /// Thrust, cubic term, N/V³.
    pub thrust_k3_n_per_v3: Number,
    /// Torque, linear term, N·m/V.
    pub torque_k1_n_m_per_v: Number,
    /// Torque, quadratic term, N·m/V².
    pub torque_k2_n_m_per_v2: Number,
    /// Torque, cubic term, N·m/V³.
    pub torque_k3_n_m_per_v3: Number,
}

/// The TOML table `[propeller]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PropellerFile {
    /// Diameter D, m.
    pub diameter_m: Number,
    /// Static thrust coefficient C_T, dimensionless.
    pub thrust_coefficient: Number,
    /// Static torque coefficient C_Q, dimensionless.
    pub torque_coefficient: Number,
}

/// The TOML table `[motor]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotorFile {
    /// Velocity constant K_v, rad/s per volt.
    pub velocity_constant_rad_s_v: Number,
    /// Resistance of motor and controller R, Ω.
    pub resistance_ohm: Number,
    /// No-load current I_0, A.
    pub no_load_current_a: Number,
    /// Inertia of everything that spins I_R, kg·m².
    pub rotor_inertia_kg_m2: Number,
    /// Time constant of the speed controller τ_ESC, s.
    pub controller_lag_s: Number,
    /// Duty above the minimum at which the controller applies the whole battery voltage.
    pub full_voltage_duty: Number,
}

/// The TOML table `[battery]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BatteryFile {
    /// Nominal voltage, V.
    pub nominal_voltage_v: Number,
    /// Open-circuit voltage when full, V.
    pub full_voltage_v: Number,
    /// Internal resistance, Ω.
    pub internal_resistance_ohm: Number,
    /// Capacity, A·h.
    pub capacity_ah: Number,
    /// Amplitude of the exponential zone A, V.
    pub exponential_amplitude_v: Number,
    /// Rate of the exponential zone B, 1/(A·h).
    pub exponential_rate_per_ah: Number,
}

/// The TOML table `[drag]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DragFile {
    /// Quadratic drag per body axis, N·s²/m².
    pub quadratic_n_s2_m2: Triple,
    /// Rate damping per body axis, N·m·s.
    pub rate_damping_n_m_s: Triple,
}

/// The TOML table `[arms]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmsFile {
    /// Width across the slipstream, m.
    pub width_m: Number,
    /// Drag coefficient C_D on the width, dimensionless.
    pub drag_coefficient: Number,
    /// Distance below the rotor disc, m.
    pub drop_m: Number,
}

/// Line and column, counted from 1, of a byte in the text.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1;
    (line, column)
}

fn position(text: &str, error: &toml::de::Error) -> (usize, usize) {
    line_and_column(text, error.span().map_or(0, |span| span.start))
}

fn syntax_error(text: &str, origin: &str, error: &toml::de::Error) -> VehicleError {
    let (line, column) = position(text, error);
    VehicleError::Syntax {
        origin: origin.to_owned(),
        line,
        column,
        message: error.message().to_owned(),
    }
}

/// Sorts serde's message into its three kinds. Serde tells them apart in its text only; a text that it does not
/// recognise keeps its words in [`VehicleError::WrongType`].
fn schema_error(text: &str, origin: &str, path: &str, error: &toml::de::Error) -> VehicleError {
    let (line, column) = position(text, error);
    let origin = origin.to_owned();
    let message = error.message();
    if let Some(field) = message
        .strip_prefix("missing field `")
        .and_then(|rest| rest.strip_suffix('`'))
    {
        return VehicleError::MissingKey {
            origin,
            key: join(path, field),
            line,
            column,
        };
    }
    if let Some((field, expected)) = message
        .strip_prefix("unknown field `")
        .and_then(|rest| rest.split_once("`, "))
    {
        // For an unknown key the path ends in the key itself.
        let key = if path.rsplit('.').next() == Some(field) {
            path.to_owned()
        } else {
            join(path, field)
        };
        return VehicleError::UnknownKey {
            origin,
            key,
            expected: expected.to_owned(),
            line,
            column,
        };
    }
    VehicleError::WrongType {
        origin,
        key: path.to_owned(),
        message: message.to_owned(),
        line,
        column,
    }
}

/// `table.key`, or `key` at the top of the file (where the path is `.`).
fn join(table: &str, key: &str) -> String {
    if table.is_empty() || table == "." {
        key.to_owned()
    } else {
        format!("{table}.{key}")
    }
}
