//! Dynamic resolution: fine near the station, coarse far from it.

use crate::support::{ms, vehicle};
use quad_dynamics::{Level, Resolution, Vehicle};
use quad_ndi::{AnyController, C1, LoopSettings, Settings, TiltLaw, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{LevelRule, QuadrotorError, Script, Setup, Start};
use sifre::{AgentEvent, Engine, Member, Mission, ModelQuadrotor, Recording, Schedule, Target};

const END_S: f64 = 40.0;
const FINE_WITHIN_M: f64 = 3.0;
const COARSE_BEYOND_M: f64 = 4.0;

/// c1 slow enough for level 5: with a settling time of 5 s the attitude loop keeps away from the rotors' lag.
fn pilot(vehicle: &Vehicle) -> AnyController<f64> {
    let position = LoopSettings {
        settling_time_s: 5.0,
        ..LoopSettings::default()
    };
    let settings = Settings {
        position,
        ..Settings::default()
    };
    AnyController::C1(C1::new(vehicle, &settings).expect("valid settings").into())
}

/// To the station and away again: 12 m, 1 m, 12 m from it.
fn mission() -> Mission {
    let waypoint = |time_s, x| Waypoint {
        time_s,
        position_m: [x, 0.0, -2.0],
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    };
    let points = [
        waypoint(0.0, -12.0),
        waypoint(16.0, -1.0),
        waypoint(24.0, -1.0),
        waypoint(END_S, -12.0),
    ];
    Mission::through(&points, 9.81, TiltLaw::SmallAngle).unwrap()
}

fn rule(fine: Level, coarse: Level) -> LevelRule {
    LevelRule {
        near: "station".into(),
        fine: fine.into(),
        coarse: coarse.into(),
        fine_within_m: FINE_WITHIN_M,
        coarse_beyond_m: COARSE_BEYOND_M,
    }
}

fn members(rule: Option<LevelRule>) -> Vec<Member> {
    let vehicle = vehicle();
    let setup = Setup {
        start: Start {
            position_m: [-12.0, 0.0, -2.0],
            yaw_rad: 0.0,
        },
        script: Script {
            rule,
            ..Script::default()
        },
        ..Setup::new("a", &vehicle, Level::Five, pilot(&vehicle), mission())
    };
    let station = Target::fixed("station", [0.0, 0.0, -2.0].into());
    vec![
        Member::new(ModelQuadrotor::new(setup).unwrap(), ms(2.0)),
        Member::new(station, ms(10.0)),
    ]
}

fn flown(rule: Option<LevelRule>) -> (Engine, Recording) {
    let mut simulation = Engine::new(members(rule)).unwrap();
    let id = simulation.attach(ms(2.0), MemoryBox::default()).unwrap();
    assert!(simulation.run(END_S, &mut ()).unwrap().status.is_completed());
    let recording = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;
    (simulation, recording)
}

fn column(recording: &Recording, name: &str) -> Vec<f64> {
    recording.column(&format!("a.{name}")).unwrap().collect()
}

/// Numbers of states that were integrated: four evaluations of the derivative a step, each of all states.
fn cost(recording: &Recording) -> f64 {
    let states = Level::ALL.map(|level| Resolution::of(level, &level.phenomena()).states as f64);
    column(recording, "level")
        .iter()
        .map(|&level| 4.0 * states[level as usize - 1])
        .sum()
}

fn largest(mut values: impl Iterator<Item = f64>) -> f64 {
    values
        .try_fold(0.0, |m: f64, x| x.is_finite().then(|| m.max(x.abs())))
        .unwrap_or(f64::NAN)
}

/// Coarse, fine, coarse; at the rule's distances; nothing seen of the flight jumps. Far from the station it keeps within 0.3 m of the
/// flight that is at level 5 throughout: what level 5's sagging battery moves it from its set point under a controller without
/// integral action, and what level 2 can't know. Near the station it keeps within a centimetre from 3 s after the change on, at less
/// than three quarters of the cost.
#[test]
fn agree_with_level_5_at_a_fraction_of_its_cost() {
    let (whole_simulation, whole) = flown(None);
    let (simulation, mixed) = flown(Some(rule(Level::Five, Level::Two)));
    assert!(whole_simulation.events().is_empty());
    let (five, two) = (Level::Five, Level::Two);
    let changes: Vec<_> = simulation.events().iter().map(|e| e.what.clone()).collect();
    let change = |from, to| AgentEvent::LevelChanged { from, to };
    assert_eq!(changes, [change(five, two), change(two, five), change(five, two)]);

    // At the instants of the changes the distance has just crossed the rule's.
    let [x, y, z] = ["x", "y", "z"].map(|axis| column(&mixed, &format!("position.{axis}")));
    let away = |k: usize| nalgebra::Vector3::new(x[k], y[k], z[k] + 2.0).norm();
    let at = |k: usize| (simulation.events()[k].time_ns / 2_000_000) as usize;
    assert_eq!(at(0), 0);
    assert!(away(at(1)) <= FINE_WITHIN_M && away(at(1) - 1) > FINE_WITHIN_M);
    assert!(away(at(2)) >= COARSE_BEYOND_M && away(at(2) - 1) < COARSE_BEYOND_M);

    // No jumps: each step moves by the trapezium of the velocities, to h³/12 times the jerk (1e-9 for 1 m/s³), and
    // velocities by no more than 2 g h.
    for axis in ["x", "y", "z"] {
        let (p, v) = (
            column(&mixed, &format!("position.{axis}")),
            column(&mixed, &format!("velocity.{axis}")),
        );
        let gaps = (1..p.len()).map(|k| p[k] - p[k - 1] - 1e-3 * (v[k] + v[k - 1]));
        assert!(largest(gaps) < 1e-6, "{axis}");
        assert!(
            largest((1..v.len()).map(|k| v[k] - v[k - 1])) < 2.0 * 9.81 * 2e-3,
            "{axis}"
        );
    }

    // Distance to level 5 throughout, near the station from three seconds after the change on, and anywhere.
    let apart = ["x", "y", "z"].map(|axis| {
        let whole = column(&whole, &format!("position.{axis}"));
        let mixed = column(&mixed, &format!("position.{axis}"));
        mixed.iter().zip(whole).map(|(a, b)| a - b).collect::<Vec<_>>()
    });
    let distance = |k: usize| nalgebra::Vector3::new(apart[0][k], apart[1][k], apart[2][k]).norm();
    let everywhere = largest((0..x.len()).map(distance));
    let settled = largest((at(1) + 1500..at(2)).map(distance));
    let share = cost(&mixed) / cost(&whole);
    assert!(everywhere < 0.3, "{everywhere}");
    assert!(settled < 0.01, "{settled}");
    assert!(share < 0.75, "{share}");
    // The battery discharges as in hover at level 2: it is within a twentieth of what level 5 drew, and never goes back.
    let (charge, drawn) = (column(&mixed, "charge_drawn"), column(&whole, "charge_drawn"));
    assert!(
        (charge[at(2)] / drawn[at(2)] - 1.0).abs() < 0.05,
        "{} {}",
        charge[at(2)],
        drawn[at(2)]
    );
    assert!(charge.windows(2).all(|pair| pair[1] >= pair[0]));
}

/// Saved in the middle of each part and resumed, the run is the one that was not interrupted.
#[test]
fn exact_a_rule_survives_a_snapshot() {
    let rule = || Some(rule(Level::Five, Level::One));
    let end = |simulation: &Engine| serde_json::to_string(&simulation.save().unwrap()).unwrap();
    let mut whole = Engine::new(members(rule())).unwrap();
    whole.run(END_S, &mut ()).unwrap();
    for pause in [5.0, 20.0, 35.0] {
        let mut first = Engine::new(members(rule())).unwrap();
        first.run(pause, &mut ()).unwrap();
        let mut second = Engine::resume(members(rule()), &first.save().unwrap()).unwrap();
        second.run(END_S, &mut ()).unwrap();
        assert_eq!(end(&whole), end(&second), "{pause} s");
    }
}

#[test]
fn exact_wrong_rules_are_refused() {
    let vehicle = vehicle();
    let with = |script| {
        ModelQuadrotor::new(Setup {
            script,
            ..Setup::new("a", &vehicle, Level::Five, pilot(&vehicle), mission())
        })
    };
    let rule = rule(Level::Five, Level::Two);
    let narrow = LevelRule {
        coarse_beyond_m: 1.0,
        ..rule.clone()
    };
    let error = with(Script {
        rule: Some(narrow),
        ..Script::default()
    })
    .unwrap_err();
    assert!(matches!(error, QuadrotorError::Rule { .. }), "{error}");
    let level = Schedule::new([(1.0, Level::Two.into())]).unwrap();
    let error = with(Script {
        rule: Some(rule.clone()),
        level,
        ..Script::default()
    })
    .unwrap_err();
    assert!(matches!(error, QuadrotorError::TwoMasters { .. }), "{error}");
    // A station that isn't there.
    let alone = with(Script {
        rule: Some(rule),
        ..Script::default()
    })
    .unwrap();
    let error = Engine::new(vec![Member::new(alone, ms(2.0))]).unwrap_err();
    assert!(error.to_string().contains("station"), "{error}");
}
