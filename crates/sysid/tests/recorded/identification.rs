//! The Crazyflie's numbers from the ARPL flights, against the published fit and on the parts that the fit did not see.

use crate::files::{ARPL_ROLL_PITCH, ARPL_THRUST, ARPL_YAW, arpl};
use quad_dynamics::Vehicle;
use std::sync::OnceLock;
use sysid::flight::{
    Axis, CrazyflieIdentification, FlightTests, LagOn, Part, RotationModel, SensorDelay, ThrustFit,
    ThrustSettings, identify_crazyflie, identify_inertia, identify_thrust, inertia_by_moment_regression,
};
use sysid::recorded::InertialLog;

/// The published fit (see data/README.md): thrust per motor, N, lag, s, inertia, kg m².
const REFERENCE_CURVE: [f64; 3] = [0.02248, -0.01143, 0.12828];
const REFERENCE_LAG: f64 = 0.074;
const REFERENCE_INERTIA: [f64; 2] = [1.10e-5, 1.17e-5];

const MASS: f64 = 0.027;

struct Logs {
    thrust: InertialLog,
    roll_pitch: InertialLog,
    yaw: InertialLog,
}

/// Read once for all tests.
fn logs() -> Option<&'static Logs> {
    static LOGS: OnceLock<Option<Logs>> = OnceLock::new();
    let read = || {
        Some(Logs {
            thrust: arpl(ARPL_THRUST)?,
            roll_pitch: arpl(ARPL_ROLL_PITCH)?,
            yaw: arpl(ARPL_YAW)?,
        })
    };
    LOGS.get_or_init(read).as_ref()
}

/// Identified once for all tests.
pub(crate) fn identified() -> Option<&'static CrazyflieIdentification> {
    static FOUND: OnceLock<CrazyflieIdentification> = OnceLock::new();
    let logs = logs()?;
    let tests = FlightTests {
        mass: MASS,
        thrust: Part {
            log: &logs.thrust,
            fit: 35.0..55.0,
            rest: 55.0..65.0,
        },
        roll_pitch: Part {
            log: &logs.roll_pitch,
            fit: 55.0..80.0,
            rest: 80.0..90.0,
        },
        yaw: Part {
            log: &logs.yaw,
            fit: 32.0..38.0,
            rest: 45.0..49.0,
        },
    };
    Some(FOUND.get_or_init(|| identify_crazyflie(&tests, &Vehicle::crazyflie()).expect("published flights")))
}

fn reference_form(log: &InertialLog) -> ThrustFit {
    let settings = ThrustSettings {
        mass: MASS,
        lag_on: LagOn::Command,
        delay_s: 0.0,
    };
    identify_thrust(log, &(35.0..65.0), settings).expect("published flight")
}

fn within(value: f64, reference: f64, part: f64, what: &str) {
    assert!(
        (value / reference - 1.0).abs() < part,
        "{what}: {value} against {reference}"
    );
}

#[test]
fn data_thrust_and_lag_in_the_published_form_agree_within_five_per_cent() {
    let Some(logs) = logs() else { return };
    let fit = reference_form(&logs.thrust);
    for (estimate, published) in fit.fit.parameters.iter().zip(REFERENCE_CURVE) {
        within(estimate.value, published, 0.05, "coefficient");
        assert!(estimate.interval().contains(published));
    }
    within(fit.lag().value, REFERENCE_LAG, 0.05, "lag");
    // Coefficients trade places; the curve itself is far better known: within 1 % from 0.3 to 0.9.
    for tenth in 3..=9 {
        let c = f64::from(tenth) / 10.0;
        let [k0, k1, k2] = REFERENCE_CURVE;
        within(fit.thrust(c).value, k0 + (k1 + k2 * c) * c, 0.01, "thrust");
    }
}

#[test]
fn data_inertia_in_the_published_way_agrees_within_five_per_cent() {
    let Some(logs) = logs() else { return };
    let thrust = reference_form(&logs.thrust);
    for (axis, published) in [Axis::Roll, Axis::Pitch].into_iter().zip(REFERENCE_INERTIA) {
        let model = simple(&thrust);
        let found = inertia_by_moment_regression(
            axis,
            &model,
            &Vehicle::crazyflie(),
            &logs.roll_pitch,
            &(55.0..90.0),
        );
        within(found.expect("published flight").value, published, 0.05, "inertia");
    }
}

/// Lag on the command, no delay: the structure of the published fit.
fn simple(thrust: &ThrustFit) -> RotationModel {
    RotationModel {
        curve: thrust.curve(),
        lag_on: LagOn::Command,
        lag_s: thrust.lag().value,
        delay: SensorDelay::Known(0.0),
        bin_s: 0.02,
        slowest_s: 0.5,
    }
}

/// Why ours is right where it differs from the published inertia: it predicts the part of the flight that neither saw better.
#[test]
fn data_inertia_with_the_delay_predicts_unseen_flight_better_than_the_published_one() {
    let (Some(found), Some(logs)) = (identified(), logs()) else {
        return;
    };
    let log = &logs.roll_pitch;
    let (vehicle, rest) = (Vehicle::crazyflie(), 80.0..90.0);
    let thrust = reference_form(&logs.thrust);
    for (fit, published) in [&found.roll, &found.pitch].into_iter().zip(REFERENCE_INERTIA) {
        let ours = fit.compare(&vehicle, log, &rest).unwrap().agreement().unwrap();
        let plain = identify_inertia(fit.axis, &simple(&thrust), &vehicle, log, &(55.0..80.0)).unwrap();
        let mut theirs = plain.compare(&vehicle, log, &rest).unwrap();
        for p in &mut theirs.predicted {
            *p *= plain.inertia.value / published;
        }
        let theirs = theirs.agreement().unwrap();
        println!(
            "{:?}: I = {:.3e} ± {:.1e} kg m², delay {:.1} ms, {:+.1} % of the published; unseen: fit {:.1} % against {:.1} %, U {:.3} against {:.3}",
            fit.axis,
            fit.inertia.value,
            fit.inertia.half_width(),
            1e3 * fit.delay.value,
            100.0 * (fit.inertia.value / published - 1.0),
            ours.fit_percent.unwrap(),
            theirs.fit_percent.unwrap(),
            ours.theil,
            theirs.theil
        );
        // Unseen data, so more freedom in the model does not by itself give a better fit; ten points are far beyond chance.
        assert!(ours.fit_percent > theirs.fit_percent.map(|f| f + 8.0));
        assert!(ours.theil < 0.1, "{}", ours.theil);
        // One delay, found on both axes.
        assert!((fit.delay.value - found.delay_s()).abs() < 1e-3);
        // Above the published value by up to a tenth: a lag without the delay must be taken too long, the inertia too small.
        assert!((1.0..1.12).contains(&(fit.inertia.value / published)));
    }
}

#[test]
fn data_thrust_and_yaw_predict_the_parts_that_were_not_fitted() {
    let (Some(found), Some(logs)) = (identified(), logs()) else {
        return;
    };
    let thrust = found
        .thrust
        .compare(&logs.thrust, &(55.0..65.0))
        .unwrap()
        .agreement()
        .unwrap();
    let yaw = found
        .yaw
        .compare(&Vehicle::crazyflie(), &logs.yaw, &(45.0..49.0))
        .unwrap()
        .agreement()
        .unwrap();
    println!(
        "unseen: thrust fit {:.1} %, U {:.3}; yaw fit {:.1} %, U {:.3}; ratio {:.0} ± {:.0} 1/(kg m), zero {:.1} ± {:.1} rad/s; curve {:?}, lag {:.4} ± {:.4} s, delay {:.4}",
        thrust.fit_percent.unwrap(),
        thrust.theil,
        yaw.fit_percent.unwrap(),
        yaw.theil,
        found.yaw.ratio().value,
        found.yaw.ratio().half_width(),
        found.yaw.zero().value,
        found.yaw.zero().half_width(),
        found.thrust.curve(),
        found.thrust.lag().value,
        found.thrust.lag().half_width(),
        found.delay_s(),
    );
    // Theil's coefficient below 0.25 counts as good agreement in flight dynamics (Jategaonkar 2006).
    assert!(thrust.theil < 0.25 && thrust.fit_percent.unwrap() > 70.0);
    assert!(yaw.theil < 0.25 && yaw.fit_percent.unwrap() > 70.0);
    // With the torque per thrust of Förster (2015), 5.96 mm, the inertia is that of the literature: 2.17e-5 (Luis and Le Ny
    // 2016) to 2.93e-5 (Förster 2015, with markers).
    let inertia = found.yaw.inertia_for(0.005_964_552).value;
    assert!((2.0e-5..3.0e-5).contains(&inertia), "{inertia}");
}

#[test]
fn data_intervals_are_widened_for_correlated_residuals() {
    let Some(logs) = logs() else { return };
    let fit = reference_form(&logs.thrust);
    let widened =
        |w: &sysid::Warning| matches!(w, sysid::Warning::IntervalsWidened { factor, .. } if *factor > 2.0);
    assert!(fit.fit.warnings.iter().any(widened), "{:?}", fit.fit.warnings);
}
