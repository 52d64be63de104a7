//! What can be wrong with a vehicle file or a vehicle, each with the file, the key, the value and its range.

/// Why a vehicle was refused. `origin` is the name of the file (or of the vehicle, where there is no file).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VehicleError {
    /// The text is not TOML at all.
    #[error("{origin}:{line}:{column}: not valid TOML: {message}")]
    Syntax {
        /// Name of the file.
        origin: String,
        /// Line of the mistake, counted from 1.
        line: usize,
        /// Column of the mistake in characters, counted from 1.
        column: usize,
        /// What the parser says.
        message: String,
    },
    /// A key that every vehicle needs is absent.
    #[error("{origin}:{line}:{column}: missing key `{key}`")]
    MissingKey {
        /// Name of the file.
        origin: String,
        /// Full path of the absent key, as in `airframe.mass_kg`.
        key: String,
        /// Line of the table that lacks it, counted from 1.
        line: usize,
        /// Column of that table, counted from 1.
        column: usize,
    },
    /// A key that the schema does not know, most often a slip of the pen.
    #[error("{origin}:{line}:{column}: unknown key `{key}`, {expected}")]
    UnknownKey {
        /// Name of the file.
        origin: String,
        /// Full path of the unknown key.
        key: String,
        /// The keys that would be known there.
        expected: String,
        /// Line, counted from 1.
        line: usize,
        /// Column, counted from 1.
        column: usize,
    },
    /// A value of another type than the schema's (a text for a number, a plain number without its source, ...).
    #[error("{origin}:{line}:{column}: key `{key}`: {message}")]
    WrongType {
        /// Name of the file.
        origin: String,
        /// Full path of the key.
        key: String,
        /// What was found and what was expected.
        message: String,
        /// Line, counted from 1.
        line: usize,
        /// Column, counted from 1.
        column: usize,
    },
    /// A number without a word on where it comes from.
    #[error("{origin}: `{key}` has an empty source: every number says where it comes from")]
    EmptySource {
        /// Name of the file.
        origin: String,
        /// Full path of the key.
        key: String,
    },
    /// NaN or infinite.
    #[error("{origin}: `{key}` = {value} {unit} is not a finite number")]
    NotFinite {
        /// Name of the file.
        origin: String,
        /// Full path of the key.
        key: String,
        /// The value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Negative or dimensionally absurd: outside what any quadrotor could have.
    #[error("{origin}: `{key}` = {value} {unit} is {}{}", outside(*.minimum, *.maximum, .unit), remark(.hint))]
    OutOfRange {
        /// Name of the file.
        origin: String,
        /// Full path of the key.
        key: String,
        /// The value.
        value: f64,
        /// Smallest value accepted.
        minimum: f64,
        /// Largest value accepted.
        maximum: f64,
        /// Unit of the three.
        unit: &'static str,
        /// What may have happened; empty if there is nothing to add.
        hint: &'static str,
    },
    /// The family is of quadrotors: four rotors.
    #[error("{origin}: `rotors` has {count} entries; a quadrotor has 4")]
    RotorCount {
        /// Name of the file.
        origin: String,
        /// Number of rotors found.
        count: usize,
    },
    /// The inertia matrix differs from its transpose, which a file cannot write but a program can.
    #[error(
        "{origin}: the inertia matrix is not symmetric: {upper} kg·m² above the diagonal, {lower} kg·m² below it"
    )]
    AsymmetricInertia {
        /// Name of the vehicle.
        origin: String,
        /// Element above the diagonal, kg·m².
        upper: f64,
        /// Its mirror image, kg·m².
        lower: f64,
    },
    /// The inertia matrix belongs to no distribution of mass.
    #[error(
        "{origin}: the inertia matrix has principal moments {principal:?} kg·m²: each must be positive and none larger than the sum of the other two"
    )]
    UnphysicalInertia {
        /// Name of the file.
        origin: String,
        /// Principal moments, kg·m², in ascending order.
        principal: [f64; 3],
    },
    /// The rotors cannot produce thrust, roll, pitch and yaw independently of each other.
    #[error(
        "{origin}: the control matrix of `rotors` is singular (determinant {determinant}, condition number {condition}, at most {limit} accepted): check hub positions and spins"
    )]
    SingularControlMatrix {
        /// Name of the file.
        origin: String,
        /// Determinant of the control matrix, dimensionless.
        determinant: f64,
        /// Ratio of its largest to its smallest singular value.
        condition: f64,
        /// Largest condition number accepted.
        limit: f64,
    },
    /// The lower end of the PWM range is not below the upper end.
    #[error("{origin}: `pwm.minimum` = {minimum} must be below `pwm.maximum` = {maximum}")]
    PwmOrder {
        /// Name of the file.
        origin: String,
        /// Lower end of the raw duty.
        minimum: f64,
        /// Upper end of the raw duty.
        maximum: f64,
    },
    /// The torque transfer function does not pass a constant command unchanged.
    #[error(
        "{origin}: `rotor_dynamics.torque_c2_per_s2` = {numerator} and `torque_c4_per_s2` = {denominator} must be equal: the steady gain is `linear_rotor.torque_gain_n_m`"
    )]
    TorqueGainNotUnity {
        /// Name of the file.
        origin: String,
        /// Constant term of the numerator c_Q2, 1/s².
        numerator: f64,
        /// Constant term of the denominator c_Q4, 1/s².
        denominator: f64,
    },
    /// Full PWM on all rotors does not carry the weight.
    #[error(
        "{origin}: full PWM gives {maximum_thrust_n} N in all by `linear_rotor.thrust_gain_n`, but the weight is {weight_n} N"
    )]
    CannotHover {
        /// Name of the file.
        origin: String,
        /// Thrust of the four rotors at full PWM by the linear rotor, N.
        maximum_thrust_n: f64,
        /// Weight m g, N.
        weight_n: f64,
    },
    /// A model needs parameters that this vehicle does not have.
    #[error("vehicle `{vehicle}` has no [{group}] parameters, which {needed_by} needs")]
    MissingGroup {
        /// Name of the vehicle.
        vehicle: String,
        /// The table absent from its file.
        group: &'static str,
        /// The model that asked for it.
        needed_by: &'static str,
    },
}

/// The range that a value is not in; one-sided where there is no upper bound.
fn outside(minimum: f64, maximum: f64, unit: &str) -> String {
    if maximum == f64::MAX {
        format!("below {minimum} {unit}")
    } else {
        format!("outside {minimum} to {maximum} {unit}")
    }
}

/// A hint as the tail of a sentence, nothing if there is none.
fn remark(hint: &str) -> String {
    if hint.is_empty() {
        String::new()
    } else {
        format!("; {hint}")
    }
}
