//! Estimators on board.

use super::Built;
use super::quadrotor::choice;
use crate::error::{EstimatorFault, ScenarioError};
use crate::file::{
    ErrorFile, EstimatorFile, InitialDeviationFile, InitialErrorFile, QuadrotorFile, SensorFile, SensorKind,
    SensorsFile,
};
use quad_dynamics::Vehicle;
use quad_estimation::InitialUncertainty;
use quad_estimation::sensor::{SensorError, SensorSuite};
use sifre::quadrotor::{EstimateUse, Estimation, InitialError, VectorError};
use std::sync::Arc;

/// Sensors and filter of a quadrotor, if it has them.
pub(super) fn assemble(
    built: &mut Built,
    of: &QuadrotorFile,
    believed: Arc<Vehicle>,
    seed: u64,
) -> Result<Option<Estimation>, ScenarioError> {
    let Some(file) = &of.estimator else {
        return Ok(None);
    };
    let refuse = |fault: Fault| ScenarioError::Estimator {
        agent: of.name.clone(),
        key: fault.key,
        source: fault.source,
    };
    let sensors = suite(&file.sensors).map_err(refuse)?;
    note_fast_sensors(built, of, file);
    let error = error(&file.initial_error).map_err(refuse)?;
    let level = choice(file.level, file.phenomena.as_ref());
    let estimation = Estimation::new(level, sensors, seed);
    Ok(Some(Estimation {
        vehicle: Some(believed),
        filter: file.filter,
        used: match file.in_loop {
            true => EstimateUse::InLoop,
            false => EstimateUse::Beside,
        },
        uncertainty: uncertainty(estimation.uncertainty, &file.initial_deviation, &error).map_err(refuse)?,
        error,
        ..estimation
    }))
}

/// What is wrong, and at which key below `estimator`.
struct Fault {
    key: String,
    source: EstimatorFault,
}

impl Fault {
    fn at(key: impl Into<String>, source: EstimatorFault) -> Self {
        let key = key.into();
        Self { key, source }
    }
}

fn suite(file: &SensorsFile) -> Result<SensorSuite, Fault> {
    let list = match file {
        SensorsFile::Of(quality) => return Ok(quality.suite()),
        SensorsFile::List(list) => list,
    };
    for (place, sensor) in list.iter().enumerate() {
        let at = |key: &str, source| Err(Fault::at(format!("sensors[{place}].{key}"), source));
        if sensor.field_ut.is_some() && sensor.kind != SensorKind::Magnetometer {
            return at("field_ut", EstimatorFault::Field);
        }
        let is_biased = matches!(sensor.kind, SensorKind::Accelerometer | SensorKind::Gyroscope);
        if is_biased && list[..place].iter().any(|other| other.kind == sensor.kind) {
            return at("kind", EstimatorFault::Twice);
        }
        if let Err(error) = sensor.sensor().validate() {
            return at(key_of(&error), error.into());
        }
    }
    let sensors: Vec<_> = list.iter().map(SensorFile::sensor).collect();
    SensorSuite::new(sensors).map_err(|error| Fault::at("sensors", error.into()))
}

/// The key whose value a sensor is refused for.
fn key_of(error: &SensorError) -> &'static str {
    match error {
        SensorError::Rate { .. } => "rate_hz",
        SensorError::Imperfection { what, .. } => match *what {
            "turn-on bias" => "turn_on_bias",
            "bias drift" => "bias_drift",
            "quantum" => "quantum",
            "delay" => "delay_s",
            _ => "noise",
        },
        SensorError::Dropout { .. } => "dropout",
        SensorError::EmptyRange { .. } => "range",
        SensorError::Field { .. } => "field_ut",
        SensorError::Perfect { .. } => "noise",
    }
}

fn error(file: &InitialErrorFile) -> Result<InitialError, Fault> {
    let of = |key: &str, error: ErrorFile, unit: f64| {
        let wrong = |value| Fault::at(format!("initial_error.{key}"), EstimatorFault::Error { value });
        match error {
            ErrorFile::Fixed(error) => match error.into_iter().find(|e| !e.is_finite()) {
                Some(value) => Err(wrong(value)),
                None => Ok(VectorError::Fixed(error.map(|e| e * unit))),
            },
            ErrorFile::Drawn(deviation) if deviation.is_finite() && deviation >= 0.0 => {
                Ok(VectorError::Drawn(deviation * unit))
            }
            ErrorFile::Drawn(value) => Err(wrong(value)),
        }
    };
    Ok(InitialError {
        position_m: of("position_m", file.position_m, 1.0)?,
        velocity_m_s: of("velocity_m_s", file.velocity_m_s, 1.0)?,
        attitude_rad: of("attitude_deg", file.attitude_deg, DEGREE)?,
    })
}

/// A degree, rad.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// What the filter says of its first belief: what the file says, or else the deviation of errors that are drawn, or else `usual`.
fn uncertainty(
    usual: InitialUncertainty,
    file: &InitialDeviationFile,
    error: &InitialError,
) -> Result<InitialUncertainty, Fault> {
    let said = |key: &str, deviation: Option<f64>| match deviation {
        Some(value) if !(value.is_finite() && value > 0.0) => Err(Fault::at(
            format!("initial_deviation.{key}"),
            EstimatorFault::Deviation { value },
        )),
        _ => Ok(deviation),
    };
    let drawn = |error: VectorError| match error {
        VectorError::Drawn(deviation) if deviation > 0.0 => Some(deviation),
        _ => None,
    };
    let position = said("position_m", file.position_m)?.or(drawn(error.position_m));
    let velocity = said("velocity_m_s", file.velocity_m_s)?.or(drawn(error.velocity_m_s));
    let attitude_deg = said("attitude_deg", file.attitude_deg)?;
    let attitude = attitude_deg.map(|deviation| deviation * DEGREE);
    Ok(InitialUncertainty {
        position_m: position.unwrap_or(usual.position_m),
        velocity_m_s: velocity.unwrap_or(usual.velocity_m_s),
        attitude_rad: attitude
            .or(drawn(error.attitude_rad))
            .unwrap_or(usual.attitude_rad),
        ..usual
    })
}

/// Notes if sensors can't be as fast as requested.
fn note_fast_sensors(built: &mut Built, of: &QuadrotorFile, file: &EstimatorFile) {
    let SensorsFile::List(list) = &file.sensors else {
        return;
    };
    let step_s = of.step_s.seconds();
    // A period that is the step but for rounding to a nanosecond is no faster.
    for (place, sensor) in list.iter().enumerate() {
        if sensor.rate_hz * step_s > 1.0 + 1e-6 {
            built.notes.push(format!(
                "\"{}\": estimator.sensors[{place}] reads once per step of {step_s} s, not at its rate of {} Hz",
                of.name, sensor.rate_hz
            ));
        }
    }
}
