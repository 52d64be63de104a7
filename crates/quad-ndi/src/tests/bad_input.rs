//! What controllers refuse, and that the message names it.

use super::*;
use crate::{AnyController, C1, C2, C3, ControllerError, Flyer, Pid, PidGains, PidSettings};
use quad_dynamics::{AnyQuadrotor, Level, PhenomenonSet};

/// Gains that are no more than valid.
pub(super) fn pid_settings() -> PidSettings {
    let gains = |omega: f64| PidGains {
        proportional: omega * omega,
        integral: 0.1 * omega.powi(3),
        derivative: 2.0 * omega,
    };
    PidSettings {
        height: gains(2.9),
        yaw: gains(2.9),
        position: gains(1.2),
        attitude: gains(9.0),
        filter_bandwidth_rad_s: 100.0,
        tilt_limit_rad: 0.5,
        anti_windup_per_s: 2.0,
        set_point_weight: 1.0,
    }
}

#[test]
fn exact_bad_settings_are_named() {
    let good = Settings::default();
    assert!(good.gains::<f64>().is_ok());
    let mut cases: Vec<(&str, f64, Settings)> = Vec::new();
    for value in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        let slow = |s: LoopSettings| LoopSettings {
            settling_time_s: value,
            ..s
        };
        let loose = |s: LoopSettings| LoopSettings { damping: value, ..s };
        let far = |s: LoopSettings| LoopSettings {
            pole_ratio: value,
            ..s
        };
        let (height, yaw, position) = (good.height, good.yaw, good.position);
        let a = good.attitude;
        cases.extend([
            (
                "height.settling_time_s",
                value,
                Settings {
                    height: slow(height),
                    ..good
                },
            ),
            (
                "height.damping",
                value,
                Settings {
                    height: loose(height),
                    ..good
                },
            ),
            (
                "height.pole_ratio",
                value,
                Settings {
                    height: far(height),
                    ..good
                },
            ),
            (
                "yaw.settling_time_s",
                value,
                Settings {
                    yaw: slow(yaw),
                    ..good
                },
            ),
            (
                "yaw.damping",
                value,
                Settings {
                    yaw: loose(yaw),
                    ..good
                },
            ),
            (
                "yaw.pole_ratio",
                value,
                Settings {
                    yaw: far(yaw),
                    ..good
                },
            ),
            (
                "position.settling_time_s",
                value,
                Settings {
                    position: slow(position),
                    ..good
                },
            ),
            (
                "position.damping",
                value,
                Settings {
                    position: loose(position),
                    ..good
                },
            ),
            (
                "position.pole_ratio",
                value,
                Settings {
                    position: far(position),
                    ..good
                },
            ),
            (
                "attitude.frequency_ratio",
                value,
                Settings {
                    attitude: AttitudeSettings {
                        frequency_ratio: value,
                        ..a
                    },
                    ..good
                },
            ),
            (
                "attitude.damping",
                value,
                Settings {
                    attitude: AttitudeSettings { damping: value, ..a },
                    ..good
                },
            ),
            (
                "attitude.pole_ratio",
                value,
                Settings {
                    attitude: AttitudeSettings {
                        pole_ratio: value,
                        ..a
                    },
                    ..good
                },
            ),
        ]);
    }
    let vehicle = Vehicle::qball_x4();
    for (key, value, settings) in &cases {
        for refused in [
            C1::<f64>::new(&vehicle, settings).map(|_| ()).unwrap_err(),
            C2::<f64>::new(&vehicle, settings).map(|_| ()).unwrap_err(),
            C3::<f64>::new(&vehicle, settings).map(|_| ()).unwrap_err(),
        ] {
            let message = refused.to_string();
            assert!(
                message.contains(key) && message.contains(&value.to_string()),
                "{message}"
            );
        }
    }
}

#[test]
fn exact_bad_pid_settings_are_named() {
    let vehicle = Vehicle::qball_x4();
    let good = pid_settings();
    assert!(Pid::<f64>::new(&vehicle, &good).is_ok());
    let bad_gain = PidGains {
        derivative: -1.0,
        ..good.attitude
    };
    let cases = [
        (
            "height",
            "NaN",
            PidSettings {
                height: PidGains {
                    integral: f64::NAN,
                    ..good.height
                },
                ..good
            },
        ),
        (
            "attitude",
            "-1",
            PidSettings {
                attitude: bad_gain,
                ..good
            },
        ),
        (
            "filter_bandwidth_rad_s",
            "0",
            PidSettings {
                filter_bandwidth_rad_s: 0.0,
                ..good
            },
        ),
        (
            "anti_windup_per_s",
            "inf",
            PidSettings {
                anti_windup_per_s: f64::INFINITY,
                ..good
            },
        ),
        (
            "tilt_limit_rad",
            "1.6",
            PidSettings {
                tilt_limit_rad: 1.6,
                ..good
            },
        ),
        (
            "set_point_weight",
            "1.5",
            PidSettings {
                set_point_weight: 1.5,
                ..good
            },
        ),
        (
            "tilt_limit_rad",
            "-0.1",
            PidSettings {
                tilt_limit_rad: -0.1,
                ..good
            },
        ),
    ];
    for (key, value, settings) in &cases {
        let message = Pid::<f64>::new(&vehicle, settings).unwrap_err().to_string();
        assert!(message.contains(key) && message.contains(value), "{message}");
    }
}

#[test]
fn exact_a_singular_control_matrix_is_an_error() {
    let mut vehicle = Vehicle::qball_x4();
    vehicle.name = "four in a row".into();
    for (rotor, x) in vehicle.rotors.iter_mut().zip([-0.2, -0.1, 0.1, 0.2]) {
        rotor.hub_position = Vector3::new(x, 0.0, 0.0);
    }
    let refused = C2::<f64>::new(&vehicle, &Settings::default()).unwrap_err();
    assert_eq!(
        refused,
        ControllerError::SingularControlMatrix {
            vehicle: "four in a row".into()
        }
    );
    let message = refused.to_string();
    assert!(
        message.contains("four in a row") && message.contains("singular"),
        "{message}"
    );
    let mut torqueless = Vehicle::qball_x4();
    torqueless.linear_rotor.torque_gain = 0.0;
    assert!(matches!(
        Pid::<f64>::new(&torqueless, &pid_settings()),
        Err(ControllerError::SingularControlMatrix { .. })
    ));
}

#[test]
fn exact_a_controller_above_its_model_is_refused() {
    let vehicle = Vehicle::qball_x4();
    let s = Settings::default();
    let controllers: [(AnyController<f64>, u8); 4] = [
        (AnyController::C1(C1::new(&vehicle, &s).unwrap().into()), 1),
        (AnyController::C2(C2::new(&vehicle, &s).unwrap().into()), 2),
        (AnyController::C3(C3::new(&vehicle, &s).unwrap().into()), 3),
        (
            AnyController::Pid(Pid::new(&vehicle, &pid_settings()).unwrap().into()),
            1,
        ),
    ];
    for (controller, lowest) in controllers {
        for level in Level::ALL {
            let on = PhenomenonSet::none();
            let model = AnyQuadrotor::hovering(level, &vehicle, &on, Vector3::zeros(), 0.0).unwrap();
            let pairing = Flyer::new(&vehicle, model, controller.clone());
            assert_eq!(
                pairing.is_ok(),
                level.number() >= lowest,
                "{controller:?} {level}"
            );
            if let Err(refused) = pairing {
                let message = refused.to_string();
                assert!(
                    message.contains(&format!("controller for level {lowest}")),
                    "{message}"
                );
                assert!(message.contains(&format!("model of {level}")), "{message}");
            }
        }
    }
}
