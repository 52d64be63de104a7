//! Bad input: errors that say what to do.

use crate::support::{c1, c3, in_order, members, ms, plans, vehicle};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::Reference;
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Estimation, QuadrotorError, Script, Setup, Start};
use sifre::{
    BindError, Engine, Follow, GridError, Member, ModelQuadrotor, ResumeError, RunStatus, Schedule,
    SimulationError, SimulationSnapshot, SnapshotError, StepSize, StopCondition, Target, Who,
};
use std::sync::Arc;

fn target(name: &str) -> Member {
    Member::new(Target::fixed(name, [0.0; 3].into()), ms(1.0))
}

fn setup(name: &str) -> Setup {
    let vehicle = vehicle();
    Setup::new(
        name,
        &vehicle,
        Level::Three,
        c3(&vehicle),
        Reference::hold([0.0; 3].into(), 0.0),
    )
}

fn quadrotor(name: &str) -> Member {
    Member::new(ModelQuadrotor::new(setup(name)).unwrap(), ms(1.0))
}

fn follower(name: &str, leader: &str) -> Member {
    let vehicle = vehicle();
    let follow = Follow::agent(leader, [0.0; 3], 0.0);
    let setup = Setup::new(name, &vehicle, Level::Three, c3(&vehicle), follow);
    Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0))
}

#[test]
fn exact_an_empty_simulation() {
    let error = Engine::new(Vec::new()).unwrap_err();
    assert!(matches!(error, SimulationError::Empty));
    assert!(error.to_string().contains("add a quadrotor"));
}

#[test]
fn exact_duplicate_names() {
    let error = Engine::new(vec![target("a"), target("b"), quadrotor("a")]).unwrap_err();
    assert!(matches!(&error, SimulationError::DuplicateName { name } if name == "a"));
}

#[test]
fn exact_unknown_agents() {
    let error = Engine::new(vec![follower("a", "c"), target("b")]).unwrap_err();
    assert!(
        matches!(&error, SimulationError::Bind(BindError::UnknownAgent(unknown)) if unknown.wanted == "c" && unknown.known == ["b"])
    );
    assert_eq!(
        error.to_string(),
        "agent \"a\" refers to \"c\", which is not in the simulation: add it, or name one of b"
    );
    let error = Engine::new(vec![follower("a", "a")]).unwrap_err();
    assert!(error.to_string().contains("is itself"), "{error}");
    let mut simulation = Engine::new(vec![target("a")]).unwrap();
    let who = Who::Agent("b".into());
    let error = simulation
        .stop_when(StopCondition::Below { who, height_m: 0.0 })
        .unwrap_err();
    assert!(matches!(error, SimulationError::UnknownInCondition { .. }));
}

#[test]
fn exact_times() {
    assert_eq!(
        StepSize::from_seconds(0.0),
        Err(GridError::BadStep { step_s: 0.0 })
    );
    let mut simulation = Engine::new(vec![target("a")]).unwrap();
    simulation.run(0.5, &mut ()).unwrap();
    let error = simulation.run(0.25, &mut ()).unwrap_err();
    assert!(matches!(
        error,
        SimulationError::EndBeforeNow {
            end_s: 0.25,
            now_s: 0.5
        }
    ));
    for end_s in [-1.0, f64::NAN, f64::INFINITY, 1e9, 1.0 / 3.0] {
        assert!(
            matches!(simulation.run(end_s, &mut ()), Err(SimulationError::Time(_))),
            "{end_s}"
        );
    }
    // The present itself is an end like any other.
    assert!(simulation.run(0.5, &mut ()).unwrap().status.is_completed());
}

#[test]
fn exact_quadrotors() {
    let vehicle = vehicle();
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let low = ModelQuadrotor::new(Setup::new("a", &vehicle, Level::Two, c3(&vehicle), hold)).unwrap_err();
    assert!(matches!(&low, QuadrotorError::Controller { name, .. } if name == "a"));

    let start = Start {
        position_m: [0.0, f64::NAN, 0.0],
        yaw_rad: 0.0,
    };
    let error = ModelQuadrotor::new(Setup { start, ..setup("a") }).unwrap_err();
    assert!(matches!(error, QuadrotorError::BadStart { .. }));

    let script = Script {
        wind_m_s: Schedule::new([(0.0, [f64::INFINITY, 0.0, 0.0])]).unwrap(),
        ..Script::default()
    };
    let error = ModelQuadrotor::new(Setup { script, ..setup("a") }).unwrap_err();
    assert!(matches!(error, QuadrotorError::Script { .. }));

    let bare = Arc::new(Vehicle {
        rotor_dynamics: None,
        ..Vehicle::qball_x4()
    });
    let error = ModelQuadrotor::new(Setup::new("a", &bare, Level::Four, c1(&bare), hold)).unwrap_err();
    assert!(matches!(error, QuadrotorError::Build { .. }));
}

#[test]
fn exact_snapshots_of_something_else() {
    let mut simulation = Engine::new(vec![quadrotor("a"), target("b")]).unwrap();
    simulation.run(0.01, &mut ()).unwrap();
    let saved = simulation.save().unwrap();
    let resume = |members, snapshot: &SimulationSnapshot| match Engine::resume(members, snapshot) {
        Err(ResumeError::Snapshot(error)) => error,
        other => panic!("{other:?}"),
    };
    let error = resume(vec![quadrotor("a"), target("c")], &saved);
    assert!(matches!(error, SnapshotError::OtherAgents { .. }));
    let error = resume(vec![target("a"), target("b")], &saved);
    assert!(matches!(error, SnapshotError::OtherKind { .. }));
    let slow = Member::new(Target::fixed("b", [0.0; 3].into()), ms(2.0));
    let error = resume(vec![quadrotor("a"), slow], &saved);
    assert!(matches!(
        error,
        SnapshotError::OtherStep {
            expected_s: 0.002,
            found_s: 0.001,
            ..
        }
    ));

    // A c3 has four numbers to remember, a c1 none.
    let vehicle = vehicle();
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let other = Setup::new("a", &vehicle, Level::Three, c1(&vehicle), hold);
    let other = Member::new(ModelQuadrotor::new(other).unwrap(), ms(1.0));
    let error = resume(vec![other, target("b")], &saved);
    assert!(
        error
            .to_string()
            .contains("was it saved with another model or controller?"),
        "{error}"
    );

    let mut newer = saved.clone();
    newer.sifre_snapshot = 2;
    let error = resume(vec![quadrotor("a"), target("b")], &newer);
    assert!(matches!(
        error,
        SnapshotError::Version {
            expected: 1,
            found: 2
        }
    ));
    let mut late = saved.clone();
    late.time_ns = u64::MAX;
    let error = resume(vec![quadrotor("a"), target("b")], &late);
    assert!(matches!(error, SnapshotError::Time { .. }));
    let mut short = saved;
    short.agents[0].published.pop();
    let error = resume(vec![quadrotor("a"), target("b")], &short);
    assert!(matches!(
        error,
        SnapshotError::Length {
            expected: 18,
            found: 17,
            ..
        }
    ));
    assert!(matches!(
        SimulationSnapshot::read_json(&b"{\"sifre_snapshot\":1}"[..]),
        Err(SnapshotError::Format(_))
    ));
}

/// A black box that would have to record what an agent no longer knows.
#[test]
fn exact_a_black_box_attached_between_instants() {
    let slow = Member::new(Target::fixed("slow", [0.0; 3].into()), ms(10.0));
    let mut simulation = Engine::new(vec![target("fast"), slow]).unwrap();
    simulation.run(0.005, &mut ()).unwrap();
    let error = simulation.attach(ms(1.0), MemoryBox::default()).unwrap_err();
    let SimulationError::AttachedMidStep { agent, now_s, due_s } = &error else {
        panic!("{error}")
    };
    assert_eq!((agent.as_str(), *now_s, *due_s), ("slow", 0.005, 0.01));
    // One whose first sample comes later has nothing to miss.
    simulation.attach(ms(10.0), MemoryBox::default()).unwrap();
    simulation.run(0.01, &mut ()).unwrap();
    assert!(simulation.attach(ms(20.0), MemoryBox::default()).is_ok());
}

/// Random agents never make a panic out of a run that ends at once.
#[test]
fn exact_a_run_of_no_time_is_a_run() {
    let plans = plans()
        .new_tree(&mut TestRunner::deterministic())
        .expect("a plan")
        .current();
    let mut simulation = Engine::new(members(&plans, &in_order(&plans))).unwrap();
    let report = simulation.run(0.0, &mut ()).unwrap();
    assert!(report.status.is_completed());
    assert_eq!((report.agent_steps, report.time_s), (0, 0.0));
}

/// A saved state of which one number was changed.
fn with(saved: &SimulationSnapshot, change: impl Fn(&mut serde_json::Value)) -> SimulationSnapshot {
    let mut changed = saved.clone();
    change(&mut changed.agents[0].memory);
    changed
}

/// States that no run leads to, and an estimator's clock that would keep a core busy for years.
#[test]
fn exact_states_that_no_run_leads_to_are_refused() {
    let members = || {
        let suite = quad_estimation::sensor::Quality::Poor.suite();
        let estimation = Some(Estimation::new(Level::Three, suite, 1));
        let setup = Setup {
            level: Level::Five.into(),
            estimation,
            ..setup("a")
        };
        vec![Member::new(ModelQuadrotor::new(setup).unwrap(), ms(5.0))]
    };
    let mut simulation = Engine::new(members()).unwrap();
    simulation.run(0.1, &mut ()).unwrap();
    let saved = simulation.save().unwrap();
    let refusal = |snapshot: &SimulationSnapshot| match Engine::resume(members(), snapshot) {
        Err(ResumeError::Snapshot(error)) => error.to_string(),
        other => panic!("{other:?}"),
    };
    Engine::resume(members(), &saved).unwrap();
    // Position, velocity, attitude from the seventh number on, body rates, rotors.
    let states = [
        (6, 5.0, "quaternion of length 5"),
        (0, 1e300, "the model's state has 1e300"),
        (3, 1e5, "speed of sound"),
        (14, 1e300, "the model's state has 1e300"),
    ];
    for (place, value, says) in states {
        let error = refusal(&with(&saved, |memory| memory["state"][place] = value.into()));
        assert!(error.contains(says), "{error}");
    }
    let error = refusal(&with(&saved, |memory| memory["entry"] = 7.into()));
    assert!(error.contains("entry 7"), "{error}");
    let error = refusal(&with(&saved, |memory| {
        let instants = memory["estimating"]["estimator"]["instants"]
            .as_array_mut()
            .unwrap();
        instants.last_mut().unwrap()["time_ns"] = (1_u64 << 49).into();
    }));
    assert!(error.contains("must be 5000000 ns apart"), "{error}");
    // All of its instants are long ago: seen at the first step, which it can't predict to.
    let late = SimulationSnapshot {
        time_ns: 1 << 49,
        ..saved.clone()
    };
    let mut resumed = Engine::resume(members(), &late).unwrap();
    let end = resumed.run(resumed.now_s() + 0.1, &mut ()).unwrap();
    assert!(
        matches!(end.status, RunStatus::EstimatorFailed { .. }),
        "{}",
        end.status
    );
    let mut skewed = saved;
    skewed.agents[0].published[6] = sifre::Exact(2.0);
    assert!(refusal(&skewed).contains("attitude that others see"));
}
