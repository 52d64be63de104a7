//! What can be wrong with a vehicle file or a vehicle, each with the file, the key, the value and its range.

use provenance::{Place, RangeError, ReadError};

/// Why a vehicle was refused. `origin` is the name of the file (or of the vehicle, where there is no file).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VehicleError {
    /// Not TOML, a missing or unknown key, a value of the wrong type.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// More than one mistake; each is one of the others.
    #[error("{} mistakes:{}", .0.len(), lines(.0))]
    Several(Vec<VehicleError>),
    /// A number without a word on where it comes from, in a file that a program made.
    #[error("{origin}: `{key}` has an empty source: state where the number comes from")]
    EmptySource {
        /// Name of the file.
        origin: String,
        /// Full path of the key.
        key: String,
    },
    /// Not finite, negative or dimensionally absurd: outside what any quadrotor could have.
    #[error("{place}: `{key}` = {error}")]
    Range {
        /// Where, with line and column if it was read from a text.
        place: Place,
        /// Full path of the key; the index is that of a rotor, or of an axis.
        key: String,
        /// Value, range and what may have happened.
        error: Box<RangeError>,
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

impl VehicleError {
    /// Nothing wrong, one mistake, or several.
    pub(super) fn all(mut faults: Vec<Self>) -> Result<(), Self> {
        match (faults.pop(), faults.is_empty()) {
            (None, _) => Ok(()),
            (Some(only), true) => Err(only),
            (Some(last), false) => {
                faults.push(last);
                Err(Self::Several(faults))
            }
        }
    }

    /// A number outside its range; `place` is the file's name, and the line where it is known.
    pub(super) fn range(place: Place, key: String) -> impl FnOnce(RangeError) -> Self {
        move |error| Self::Range {
            place,
            key,
            error: Box::new(error),
        }
    }
}

/// One line for each mistake.
fn lines(faults: &[VehicleError]) -> String {
    faults.iter().map(|fault| format!("\n  {fault}")).collect()
}
