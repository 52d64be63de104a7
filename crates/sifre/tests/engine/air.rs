//! Wind, shear, gusts and process noise about a quadrotor.

use crate::support::{c3, ms, run_recorded, vehicle};
use quad_dynamics::{Level, Phenomenon, Shear, ShearProfile};
use quad_ndi::Reference;
use sifre::quadrotor::{
    AirError, Gusts, LevelChoice, ProcessNoiseSource, QuadrotorError, Script, Setup, Start, Turbulence, Wind,
};
use sifre::{Engine, Member, ModelQuadrotor, Schedule};

const HEIGHT_M: f64 = 5.0;

pub(crate) fn setup(choice: LevelChoice, script: Script) -> Setup {
    let vehicle = vehicle();
    let at = [0.0, 0.0, -HEIGHT_M];
    let start = Start {
        position_m: at,
        yaw_rad: 0.0,
    };
    Setup {
        start,
        script,
        ..Setup::new(
            "a",
            &vehicle,
            choice,
            c3(&vehicle),
            Reference::hold(at.into(), 0.0),
        )
    }
}

fn flying(choice: impl Into<LevelChoice>, script: Script) -> Engine {
    let quadrotor = ModelQuadrotor::new(setup(choice.into(), script)).unwrap();
    Engine::new(vec![Member::new(quadrotor, ms(2.0))]).unwrap()
}

fn refused(choice: impl Into<LevelChoice>, script: Script) -> QuadrotorError {
    ModelQuadrotor::new(setup(choice.into(), script)).unwrap_err()
}

pub(crate) fn turbulent(seed: u64) -> Script {
    let turbulence = Some(Turbulence {
        w20_m_s: 8.0,
        seed,
        gusts: Gusts::All,
    });
    Script {
        wind: Wind {
            constant_m_s: [3.0, -4.0, 0.0],
            turbulence,
            ..Wind::default()
        },
        ..Script::default()
    }
}

fn noisy(seed: u64) -> Script {
    Script {
        process_noise: Some(ProcessNoiseSource {
            acceleration_m_s2_sqrt_hz: 0.05,
            angular_acceleration_rad_s2_sqrt_hz: 0.1,
            seed,
        }),
        ..turbulent(seed)
    }
}

/// A wind to the south pushes to the south; its step comes when it says; at a level without drag nothing is felt.
#[test]
fn exact_wind_pushes_where_it_blows() {
    let script = || Script {
        wind: Wind {
            constant_m_s: [-2.0, 0.0, 0.0],
            steps_m_s: Schedule::new([(1.0, [0.0, 3.0, 0.0])]).unwrap(),
            ..Wind::default()
        },
        ..Script::default()
    };
    let mut simulation = flying(Level::Five, script());
    let (_, recording) = run_recorded(&mut simulation, 2.0);
    let column = |name: &str| -> Vec<f64> { recording.column(&format!("a.{name}")).unwrap().collect() };
    let (x, y) = (column("position.x"), column("position.y"));
    let (wind_x, wind_y) = (column("wind.x"), column("wind.y"));
    assert!(
        x[400] < -1e-3 && y[400].abs() < 1e-3 * x[400].abs(),
        "{} {}",
        x[400],
        y[400]
    );
    assert!(y[900] > 1e-4, "{}", y[900]);
    assert_eq!(
        (wind_x[499], wind_y[499], wind_x[500], wind_y[500]),
        (-2.0, 0.0, -2.0, 3.0)
    );

    let mut indifferent = flying(Level::Three, script());
    let (_, recording) = run_recorded(&mut indifferent, 2.0);
    assert!(recording.column("a.position.x").unwrap().all(|x| x.abs() < 1e-12));
}

/// At 5 m the logarithmic wind over 2 ft of roughness is ln(5/0.6096)/ln(10) = 0.91392 of that at 20 ft.
#[test]
fn exact_wind_grows_with_height() {
    let shear = Some(Shear {
        profile: ShearProfile::Logarithmic { roughness_m: 0.6096 },
        reference_height_m: 6.096,
    });
    let script = Script {
        wind_m_s: Schedule::new([(0.0, [5.0, 0.0, 0.0])]).unwrap(),
        wind: Wind {
            shear,
            ..Wind::default()
        },
        ..Script::default()
    };
    let first_wind = |choice: LevelChoice| {
        let mut simulation = flying(choice, script.clone());
        let (_, recording) = run_recorded(&mut simulation, 0.002);
        recording.column("a.wind.x").unwrap().next().unwrap()
    };
    assert!((first_wind(Level::Five.into()) - 5.0 * 0.913_92).abs() < 5e-5);
    // A set of your own leaves it out where it says so.
    let without = LevelChoice {
        level: Level::Five,
        phenomena: Some(Level::Five.phenomena()),
    };
    assert_eq!(first_wind(without), 5.0);
}

/// Gusts of a flight of ten minutes: mean and standard deviations, turned into the mean wind's direction, are the formula's.
#[test]
fn exact_gusts_lie_along_and_across_the_wind() {
    let mut simulation = flying(Level::Five, turbulent(5));
    simulation.run(1.0, &mut ()).unwrap();
    let (report, recording) = run_recorded(&mut simulation, 600.0);
    assert!(report.status.is_completed());
    let column = |name: &str| -> Vec<f64> { recording.column(&format!("a.wind.{name}")).unwrap().collect() };
    let (mut sums, mut squares, mut n) = ([0.0; 3], [0.0; 3], 0.0);
    for ((x, y), z) in column("x").into_iter().zip(column("y")).zip(column("z")) {
        // Along (0.6, −0.8), across to its right (0.8, 0.6), down.
        let gust = [0.6 * x - 0.8 * y - 5.0, 0.8 * x + 0.6 * y, z];
        for axis in 0..3 {
            sums[axis] += gust[axis];
            squares[axis] += gust[axis] * gust[axis];
        }
        n += 1.0;
    }
    // 5 m = 16.404 ft: base 0.1905, σ_w 0.8, σ_u = 0.8/0.1905^0.4 = 1.5526 m/s, L_u = 16.404/0.1905^1.2 ft = 36.55 m.
    let expected = [1.5526, 1.5526, 0.8];
    let lengths: [f64; 3] = [36.55, 36.55, 5.0];
    for axis in 0..3 {
        let deviation: f64 = f64::sqrt(squares[axis] / n);
        // Standard errors over T at 5 m/s: of the deviation √(L/2VT), of the mean σ √(2L/VT), at most. Three of them.
        let lengths_flown = 5.0 * 599.0 / lengths[axis];
        assert!(
            (deviation / expected[axis] - 1.0).abs() < 3.0 / (2.0 * lengths_flown).sqrt(),
            "axis {axis}: {deviation}"
        );
        assert!(
            (sums[axis] / n).abs() < 3.0 * expected[axis] * (2.0 / lengths_flown).sqrt(),
            "axis {axis}: {}",
            sums[axis] / n
        );
    }
}

/// The same seed is the same flight; another seed is another. Saved and resumed it continues bit for bit.
#[test]
fn exact_noise_is_seeded_and_survives_a_snapshot() {
    let end = |simulation: &mut Engine| {
        simulation.run(3.0, &mut ()).unwrap();
        serde_json::to_string(&simulation.save().unwrap()).unwrap()
    };
    let whole = end(&mut flying(Level::Five, noisy(1)));
    assert_eq!(whole, end(&mut flying(Level::Five, noisy(1))));
    assert_ne!(whole, end(&mut flying(Level::Five, noisy(2))));

    let mut first = flying(Level::Five, noisy(1));
    first.run(1.234, &mut ()).unwrap();
    let saved = first.save().unwrap();
    let quadrotor = ModelQuadrotor::new(setup(Level::Five.into(), noisy(1))).unwrap();
    let mut resumed = Engine::resume(vec![Member::new(quadrotor, ms(2.0))], &saved).unwrap();
    assert_eq!(whole, end(&mut resumed));
}

#[test]
fn exact_an_unmet_prerequisite_names_both() {
    let error = refused(Level::Three, turbulent(1));
    let text = error.to_string();
    assert!(
        text.contains("\"a\"") && text.contains("turbulence") && text.contains("drag"),
        "{text}"
    );
    // With drag it is welcome at level 3.
    let choice = LevelChoice {
        level: Level::Three,
        phenomena: Some([Phenomenon::Drag, Phenomenon::Turbulence].into_iter().collect()),
    };
    assert!(ModelQuadrotor::new(setup(choice.clone(), turbulent(1))).is_ok());
    let error = refused(choice, Script::default());
    assert!(matches!(
        error,
        QuadrotorError::Air {
            source: AirError::NoSource {
                phenomenon: Phenomenon::Turbulence,
                ..
            },
            ..
        }
    ));
}

#[test]
fn exact_impossible_air_is_refused() {
    let wind = |wind| Script {
        wind,
        ..Script::default()
    };
    let gale = [0.0, 1000.0, 0.0];
    let too_strong = [
        wind(Wind {
            constant_m_s: gale,
            ..Wind::default()
        }),
        wind(Wind {
            steps_m_s: Schedule::new([(1.0, gale)]).unwrap(),
            ..Wind::default()
        }),
        wind(Wind {
            constant_m_s: [f64::NAN; 3],
            ..Wind::default()
        }),
        wind(Wind {
            turbulence: Some(Turbulence {
                w20_m_s: 1000.0,
                seed: 0,
                gusts: Gusts::All,
            }),
            ..Wind::default()
        }),
        wind(Wind {
            turbulence: Some(Turbulence {
                w20_m_s: -1.0,
                seed: 0,
                gusts: Gusts::All,
            }),
            ..Wind::default()
        }),
        Script {
            wind_m_s: Schedule::new([(0.0, gale)]).unwrap(),
            ..Script::default()
        },
    ];
    for script in too_strong {
        let error = refused(Level::Five, script);
        assert!(
            matches!(
                error,
                QuadrotorError::Air {
                    source: AirError::TooStrong { .. },
                    ..
                }
            ),
            "{error}"
        );
    }
    let text = refused(
        Level::Five,
        wind(Wind {
            constant_m_s: gale,
            ..Wind::default()
        }),
    )
    .to_string();
    assert!(text.contains("1000 m/s") && text.contains("120 m/s"), "{text}");

    let noise = ProcessNoiseSource {
        acceleration_m_s2_sqrt_hz: -1.0,
        angular_acceleration_rad_s2_sqrt_hz: 0.0,
        seed: 0,
    };
    let error = refused(
        Level::Five,
        Script {
            process_noise: Some(noise),
            ..Script::default()
        },
    );
    assert!(matches!(
        error,
        QuadrotorError::Air {
            source: AirError::Intensity { value: -1.0 },
            ..
        }
    ));
}

#[test]
fn exact_a_start_below_the_ground_is_refused() {
    let choice = LevelChoice {
        level: Level::Five,
        phenomena: Some(Level::Five.phenomena().with(Phenomenon::GroundEffect)),
    };
    let start = Start {
        position_m: [0.0, 0.0, 3.0],
        yaw_rad: 0.0,
    };
    let below = |choice: LevelChoice| {
        ModelQuadrotor::new(Setup {
            start,
            ..setup(choice, Script::default())
        })
    };
    let text = below(choice).unwrap_err().to_string();
    assert!(text.contains("-3 m") && text.contains("ground-effect"), "{text}");
    // Without a ground there is no below.
    assert!(below(Level::Five.into()).is_ok());
}

/// A script with all of it survives its file, and one without any of it names none of it.
#[test]
fn exact_scripts_survive_a_file() {
    let mut script = noisy(3);
    script.wind.shear = Some(Shear {
        profile: ShearProfile::Power { exponent: 0.143 },
        reference_height_m: Shear::USUAL_REFERENCE_HEIGHT_M,
    });
    let text = serde_json::to_string(&script).unwrap();
    assert_eq!(serde_json::from_str::<Script>(&text).unwrap(), script);
    let short = r#"{"wind": {"shear": {"profile": {"law": "power", "exponent": 0.143}}}}"#;
    assert_eq!(
        serde_json::from_str::<Script>(short).unwrap().wind.shear,
        script.wind.shear
    );
    let plain = serde_json::to_string(&Script::default()).unwrap();
    assert!(!plain.contains("wind\"") && !plain.contains("rule"), "{plain}");
}
