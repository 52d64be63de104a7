//! Levels 2 to 5 driven by the NanoBench flights' motor commands and battery voltage.

use crate::files::{NANOBENCH, nanobench};
use crate::identification::identified;
use quad_dynamics::vehicle::{VehicleFile, builtin::CRAZYFLIE_TOML};
use quad_dynamics::{Level, Vehicle};
use sysid::flight::{Calibration, calibrate, vehicle_file};
use sysid::validation::{Prediction, ReplayAgreement, ReplayVehicle, moment_of_velocity, replay};

const WINDOW: std::ops::Range<f64> = 7.0..20.0;
/// The slow figure of eight is fitted; the fast one and the circle are not.
const CIRCLE: &str = NANOBENCH[0];
const FITTED: &str = NANOBENCH[1];
const UNSEEN: &str = NANOBENCH[2];

fn base() -> Option<(VehicleFile, Vehicle, sysid::flight::ThrustCurve)> {
    let found = identified()?;
    let base = VehicleFile::parse(CRAZYFLIE_TOML, "crazyflie.toml").unwrap();
    let file = vehicle_file(found, &base, "ARPL flights").unwrap();
    let vehicle = Vehicle::from_file(&file, "identified").unwrap();
    Some((file, vehicle, found.thrust.curve()))
}

fn calibration(name: &str) -> Option<Calibration> {
    let (_, vehicle, curve) = base()?;
    let flight = nanobench(name)?;
    Some(calibrate(&flight, &WINDOW, curve, &vehicle).expect("published flight"))
}

#[test]
fn data_calibrations_on_three_flights_agree() {
    let all: Option<Vec<Calibration>> = NANOBENCH.iter().map(|name| calibration(name)).collect();
    let Some(all) = all else { return };
    for c in &all {
        println!(
            "mass {:.2} ± {:.2} g, I_xx {:.2e}, I_yy {:.2e} kg m², lag {:.0} ms, delay {:.0} ms, trim {:?}",
            1e3 * c.mass().value,
            1e3 * c.mass().half_width(),
            c.roll.inertia.value,
            c.pitch.inertia.value,
            1e3 * c.lag_s,
            1e3 * c.delay_s(),
            c.trim
        );
        // Three flights of one vehicle: mass within 1 %, inertia, of which less is seen, within a quarter, trim within 2 % of duty.
        assert!((c.mass().value / all[0].mass().value - 1.0).abs() < 0.01);
        assert!((c.roll.inertia.value / all[1].roll.inertia.value - 1.0).abs() < 0.25);
        assert!((c.pitch.inertia.value / all[1].pitch.inertia.value - 1.0).abs() < 0.25);
        for (a, b) in c.trim.iter().zip(all[0].trim) {
            assert!((a - b).abs() < 0.02);
        }
    }
}

fn replayed() -> Option<ReplayVehicle> {
    let calibration = calibration(FITTED)?;
    let (file, ..) = base()?;
    let file = calibration.vehicle_file(&file, "fitted flight").unwrap();
    Some(ReplayVehicle {
        vehicle: Vehicle::from_file(&file, "calibrated").unwrap(),
        trim: calibration.trim,
        delay_s: calibration.delay_s(),
    })
}

fn agreement(name: &str, level: Level, prediction: Prediction) -> Option<ReplayAgreement> {
    let flight = nanobench(name)?;
    let replay = replay(&flight, &WINDOW, level, &replayed()?, prediction).expect("published flight");
    Some(replay.agreement().expect("not tumbled at once"))
}

/// The battery is what level 5 knows and the others don't: on flights at other voltages than the fitted one it has the vertical
/// acceleration, they have its bias.
#[test]
fn data_level_5_predicts_the_vertical_acceleration_of_unseen_flights_best() {
    for name in [UNSEEN, CIRCLE] {
        let Some(five) = agreement(name, Level::Five, Prediction::OneStep) else {
            return;
        };
        for level in [Level::Two, Level::Three, Level::Four] {
            let Some(other) = agreement(name, level, Prediction::OneStep) else {
                return;
            };
            let (five, other) = (five.acceleration[2], other.acceleration[2]);
            assert!(
                five.fit_percent > other.fit_percent.map(|f| f + 50.0),
                "{name} {level}"
            );
            assert!(
                other.shares.unwrap().bias > 0.5,
                "{name} {level}: {:?}",
                other.shares
            );
        }
    }
}

#[test]
fn data_predictions_fall_off_from_one_step_to_the_whole_flight() {
    let predictions = [
        Prediction::OneStep,
        Prediction::ShortHorizon(0.1),
        Prediction::ShortHorizon(0.5),
        Prediction::ShortHorizon(1.0),
        Prediction::WholeFlight,
    ];
    for level in [Level::Two, Level::Five] {
        let fit = |prediction| {
            let found = agreement(UNSEEN, level, prediction)?;
            let rates = found.body_rates[0].fit_percent?;
            println!("{level}, {prediction}: roll rate fit {rates:.0} %");
            Some(rates)
        };
        let fits: Vec<f64> = predictions.into_iter().map_while(fit).collect();
        if fits.is_empty() {
            return;
        }
        // Each horizon is worse than the shorter one; from 1 s on it is tumbling against tumbling.
        assert!(
            fits[..4].windows(2).all(|pair| pair[1] < pair[0]),
            "{level}: {fits:?}"
        );
        // A step of 10 ms says most of the rate; open loop to the end is far worse than saying nothing, as it must be without feedback.
        assert!(fits[0] > 50.0 && fits[4] < -100.0, "{level}: {fits:?}");
    }
}

#[test]
fn data_what_the_angular_accelerations_leave_over_goes_with_velocity() {
    let (Some(flight), Some(vehicle)) = (nanobench(UNSEEN), replayed()) else {
        return;
    };
    let run = replay(&flight, &WINDOW, Level::Five, &vehicle, Prediction::OneStep).unwrap();
    for axis in 0..2 {
        let fit = moment_of_velocity(&flight, &run.angular_acceleration[axis]).unwrap();
        println!("axis {axis}: {:?}, R² {:?}", fit.values(), fit.goodness.r_squared);
        // Roll turns against sideways velocity, pitch against forward velocity, as rotors above the centre of mass do: a flow from the right
        // (v > 0) lifts the right side (p < 0); one from ahead (u > 0) lifts the nose (q > 0).
        let slope = if axis == 0 {
            -fit.values()[2]
        } else {
            fit.values()[1]
        };
        assert!(slope > 0.0, "axis {axis}: {slope}");
        assert!(
            fit.goodness.r_squared.unwrap() > 0.5,
            "axis {axis}: {:?}",
            fit.goodness.r_squared
        );
    }
}
