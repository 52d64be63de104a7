//! Changing the level in flight.

use crate::support::{c1, c3, ms, vehicle};
use approx_eq as close;
use proptest::prelude::*;
use quad_dynamics::{Flight, Level};
use quad_ndi::Reference;
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{LevelChoice, QuadrotorError, Script, Setup};
use sifre::{AgentEvent, Engine, Event, Member, ModelQuadrotor, Schedule};

/// Largest difference of what can be seen of two flights: m, m/s, 1, rad/s.
fn approx_eq(a: &Flight<f64>, b: &Flight<f64>) -> f64 {
    let differences = [
        (a.position - b.position).amax(),
        (a.velocity - b.velocity).amax(),
        (a.rotation.matrix - b.rotation.matrix).amax(),
        (a.body_rates - b.body_rates).amax(),
    ];
    differences.into_iter().fold(0.0, f64::max)
}

fn level() -> impl Strategy<Value = Level> {
    prop::sample::select(Level::ALL.to_vec())
}

fn flying(level: Level, script: Script) -> Engine {
    let vehicle = vehicle();
    let to = Reference::hold([0.6, -0.4, -1.0].into(), 0.8);
    let setup = Setup {
        script,
        ..Setup::new("alpha", &vehicle, level, c1(&vehicle), to)
    };
    Engine::new(vec![Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0))]).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// From any level to any other, in the middle of a manoeuvre.
    #[test]
    fn prop_nothing_seen_of_a_flight_jumps(from in level(), to in level(), time_ms in 1..800_u32) {
        let mut simulation = flying(from, Script::default());
        simulation.run(f64::from(time_ms) / 1000.0, &mut ()).unwrap();
        let alpha: &mut ModelQuadrotor = simulation.agent_mut("alpha").unwrap();
        let before = alpha.flight();
        let event = alpha.change_level(&to.into()).unwrap();
        prop_assert_eq!(event, AgentEvent::LevelChanged { from, to });
        // Roundings of conversions between quaternion and Euler angles, on numbers up to ten.
        let jump = close(&before, &alpha.flight());
        prop_assert!(jump < 1e-13, "{from} to {to}: {jump}");
        prop_assert!(simulation.run(1.0, &mut ()).unwrap().status.is_completed());
        prop_assert_eq!(simulation.agent::<ModelQuadrotor>("alpha").unwrap().level(), to);
    }
}

/// A scripted climb through all levels and back: exact times, events, and a flight that arrives.
#[test]
fn exact_a_script_changes_levels_when_it_says() {
    let order = [
        Level::Two,
        Level::Three,
        Level::Four,
        Level::Five,
        Level::Three,
        Level::One,
    ];
    let entries = order
        .iter()
        .enumerate()
        .map(|(k, &level)| (0.25 * (k + 1) as f64, LevelChoice::from(level)));
    let script = Script {
        level: Schedule::new(entries).unwrap(),
        ..Script::default()
    };
    let mut simulation = flying(Level::One, script);
    let id = simulation.attach(ms(1.0), MemoryBox::default()).unwrap();
    assert!(simulation.run(2.0, &mut ()).unwrap().status.is_completed());
    let mut from = Level::One;
    for (k, event) in simulation.events().iter().enumerate() {
        let expected = Event {
            time_ns: 250_000_000 * (k as u64 + 1),
            agent: "alpha".into(),
            what: AgentEvent::LevelChanged { from, to: order[k] },
        };
        assert_eq!(*event, expected);
        from = order[k];
    }
    assert_eq!(simulation.events().len(), order.len());

    let recording = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;
    let columns = ["position.x", "position.y", "position.z"].map(|name| {
        recording
            .column(&format!("alpha.{name}"))
            .unwrap()
            .collect::<Vec<_>>()
    });
    let speeds = ["velocity.x", "velocity.y", "velocity.z"].map(|name| {
        recording
            .column(&format!("alpha.{name}"))
            .unwrap()
            .collect::<Vec<_>>()
    });
    for (x, v) in columns.iter().zip(&speeds) {
        for k in 1..x.len() {
            // The trapezium's rest is h³/12 times the jerk, at most some hundred m/s³ here: 1e-8. A jump of level
            // would be metres.
            let trapezium = 0.5e-3 * (v[k] + v[k - 1]);
            assert!((x[k] - x[k - 1] - trapezium).abs() < 1e-7, "step {k}");
        }
    }
}

/// What acts on the airframe continues too where the new level has states for it: thrusts.
#[test]
fn exact_thrusts_go_on_where_there_are_states_for_them() {
    let up = [
        (Level::Two, Level::Three),
        (Level::Three, Level::Four),
        (Level::Four, Level::Five),
    ];
    for (from, to) in up {
        let mut simulation = flying(from, Script::default());
        let id = simulation.attach(ms(50.0), MemoryBox::default()).unwrap();
        simulation.run(0.15, &mut ()).unwrap();
        let before = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;
        let alpha: &mut ModelQuadrotor = simulation.agent_mut("alpha").unwrap();
        alpha.change_level(&to.into()).unwrap();
        let input = *alpha.input();
        let after = alpha.model().snapshot(&input);
        for rotor in 0..4 {
            let name = format!("alpha.thrust.{}", rotor + 1);
            let last = before.column(&name).unwrap().last().unwrap();
            // A rounding or two.
            assert!(
                (last - after.rotors[rotor].output.thrust).abs() < 1e-13,
                "{from} to {to}"
            );
        }
    }
}

#[test]
fn exact_a_level_below_the_pilot_is_refused_and_the_flight_goes_on() {
    let vehicle = vehicle();
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let below = |script| {
        ModelQuadrotor::new(Setup {
            script,
            ..Setup::new("alpha", &vehicle, Level::Three, c3(&vehicle), hold)
        })
    };
    let script = Script {
        level: Schedule::new([(1.0, Level::Two.into())]).unwrap(),
        ..Script::default()
    };
    let error = below(script).unwrap_err();
    assert!(matches!(error, QuadrotorError::Controller { .. }));
    assert!(
        error.to_string().contains("use a model of level 3 or higher"),
        "{error}"
    );

    let mut alpha = below(Script::default()).unwrap();
    assert!(alpha.change_level(&Level::One.into()).is_err());
    assert_eq!(alpha.level(), Level::Three);
}
