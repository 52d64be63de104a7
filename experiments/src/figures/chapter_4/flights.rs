//! What figures 4.12 and 4.13 share: a Crazyflie identified on the ARPL flights, calibrated on one NanoBench flight, replayed.

use crate::item::{Context, ItemError};
use crate::recordings::{arpl, nanobench};
use crate::vehicle::load_vehicle;
use quad_dynamics::vehicle::VehicleFile;
use quad_dynamics::{Level, Vehicle};
use std::ops::Range;
use sysid::flight::{
    Calibration, CrazyflieIdentification, FlightTests, Part, Unseen, calibrate, identify_crazyflie,
    vehicle_file,
};
use sysid::recorded::MotionCaptureFlight;
use sysid::validation::{Prediction, Replay, ReplayAgreement, ReplayVehicle, replay};

/// The vehicle file that gives what the flights can't: hubs, spins, propeller, battery, drag.
pub(super) const VEHICLE: &str = "vehicles/crazyflie.toml";
/// The flight that the individual vehicle is calibrated on.
pub(super) const FITTED: &str = "B3_figure8_slow_rep1.csv";
/// A flight that nothing was fitted on: the same figure at twice the speed.
pub(super) const UNSEEN: &str = "B3_figure8_fast_rep1.csv";
/// From after take-off to before landing, s.
pub(super) const WINDOW: Range<f64> = 7.0..20.0;
/// Mass of the Crazyflie of the ARPL flights, kg, as their source states.
const MASS: f64 = 0.027;

/// Levels driven by recordings.
pub(super) const LEVELS: [Level; 4] = [Level::Two, Level::Three, Level::Four, Level::Five];
/// From where predictions start.
pub(super) const PREDICTIONS: [Prediction; 5] = [
    Prediction::OneStep,
    Prediction::ShortHorizon(0.1),
    Prediction::ShortHorizon(0.5),
    Prediction::ShortHorizon(1.0),
    Prediction::WholeFlight,
];

/// A level's replay of a flight.
pub(super) struct Run {
    pub(super) level: Level,
    pub(super) prediction: Prediction,
    pub(super) replay: Replay,
    pub(super) agreement: ReplayAgreement,
}

/// A flight and what the levels make of it.
pub(super) struct Study {
    pub(super) flight: MotionCaptureFlight,
    pub(super) calibrated_on: MotionCaptureFlight,
    pub(super) identified: CrazyflieIdentification,
    /// On the parts of the ARPL flights that were kept back.
    pub(super) unseen: Unseen,
    pub(super) calibration: Calibration,
    pub(super) runs: Vec<Run>,
}

/// Identifies on the parts of the ARPL flights that their source names, less what is kept for validation.
fn identify(context: &Context, vehicle: &Vehicle) -> Result<(CrazyflieIdentification, Unseen), ItemError> {
    let [up_down, roll_pitch, yaw] = [
        arpl(context, "log10.csv")?,
        arpl(context, "log15.csv")?,
        arpl(context, "log16.csv")?,
    ];
    let tests = FlightTests {
        mass: MASS,
        thrust: Part {
            log: &up_down,
            fit: 35.0..55.0,
            rest: 55.0..65.0,
        },
        roll_pitch: Part {
            log: &roll_pitch,
            fit: 55.0..80.0,
            rest: 80.0..90.0,
        },
        yaw: Part {
            log: &yaw,
            fit: 32.0..38.0,
            rest: 45.0..49.0,
        },
    };
    let found = identify_crazyflie(&tests, vehicle)?;
    let unseen = found.validate(&tests, vehicle)?;
    Ok((found, unseen))
}

/// Replays a flight at all levels with all predictions.
pub(super) fn study(context: &Context, name: &str) -> Result<Study, ItemError> {
    let base_vehicle = load_vehicle(context, VEHICLE)?;
    let text = std::fs::read_to_string(context.data(VEHICLE))?;
    let base = VehicleFile::parse(&text, VEHICLE)?;
    let (identified, unseen) = identify(context, &base_vehicle)?;
    let file = vehicle_file(&identified, &base, "identified on the ARPL flights")?;
    let calibrated_on = nanobench(context, FITTED)?;
    let vehicle = Vehicle::from_file(&file, VEHICLE)?;
    let calibration = calibrate(&calibrated_on, &WINDOW, identified.thrust.curve(), &vehicle)?;
    let file = calibration.vehicle_file(&file, "calibrated on a NanoBench flight")?;
    let replayed = ReplayVehicle {
        vehicle: Vehicle::from_file(&file, VEHICLE)?,
        trim: calibration.trim,
        delay_s: calibration.delay_s(),
    };
    let flight = nanobench(context, name)?;
    let mut runs = Vec::new();
    for level in LEVELS {
        for prediction in PREDICTIONS {
            let replay = replay(&flight, &WINDOW, level, &replayed, prediction)?;
            let agreement = replay.agreement()?;
            runs.push(Run {
                level,
                prediction,
                replay,
                agreement,
            });
        }
    }
    Ok(Study {
        flight,
        calibrated_on,
        identified,
        unseen,
        calibration,
        runs,
    })
}

impl Study {
    /// The replay of a level with a prediction.
    pub(super) fn run(&self, level: Level, prediction: Prediction) -> Result<&Run, ItemError> {
        let found = self
            .runs
            .iter()
            .find(|r| r.level == level && r.prediction == prediction);
        found.ok_or_else(|| ItemError::new(format!("{level}, {prediction} was not run")))
    }
}

/// Agreement of levels 2 to 5 with the flight that nothing was fitted on, one-step: one less the mean of Theil's coefficients of the six
/// accelerations.
pub(crate) fn agreement_with_a_recorded_flight(context: &Context) -> Result<Vec<(Level, f64)>, ItemError> {
    let study = study(context, UNSEEN)?;
    let mean = |level| -> Result<(Level, f64), ItemError> {
        let agreement = &study.run(level, Prediction::OneStep)?.agreement;
        let axes = agreement
            .acceleration
            .iter()
            .chain(&agreement.angular_acceleration);
        Ok((level, 1.0 - axes.map(|axis| axis.theil).sum::<f64>() / 6.0))
    };
    LEVELS.into_iter().map(mean).collect()
}
