//! Ends of runs other than their end time.

use crate::support::{c3, ms, position, vehicle};
use quad_dynamics::Level;
use quad_ndi::Reference;
use sifre::quadrotor::{OpenLoop, Script, Setup, Start};
use sifre::{
    Engine, Event, Member, ModelQuadrotor, Observer, RunStatus, Schedule, StopCondition, Target, Who,
};

/// A stone: a vehicle at 5 m without thrust, and a target beside it.
fn stone() -> Engine {
    let vehicle = vehicle();
    let start = Start {
        position_m: [0.0, 0.0, -5.0],
        yaw_rad: 0.0,
    };
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let setup = Setup {
        start,
        ..Setup::new("stone", &vehicle, Level::Two, OpenLoop::default(), hold)
    };
    let target = Target::fixed("target", [1.0, 0.0, 0.0].into());
    Engine::new(vec![
        Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0)),
        Member::new(target, ms(10.0)),
    ])
    .unwrap()
}

/// Free fall reaches the ground after √(2 h / g).
#[test]
fn exact_a_stone_stops_the_run_at_the_ground() {
    let mut simulation = stone();
    simulation.stop_when(StopCondition::below_ground()).unwrap();
    let report = simulation.run(10.0, &mut ()).unwrap();
    let RunStatus::Below { agent, height_m } = &report.status else {
        panic!("{:?}", report.status)
    };
    assert_eq!(agent, "stone");
    let g = vehicle().environment.gravity;
    let impact_s = (2.0 * 5.0 / g).sqrt();
    assert!(
        (0.0..1e-3).contains(&(report.time_s - impact_s)),
        "the first instant after impact"
    );
    let fallen = 0.5 * g * report.time_s * report.time_s;
    // RK4 is exact for a parabola; a thousand roundings of numbers up to ten.
    assert!((height_m - (5.0 - fallen)).abs() < 1e-11);
    assert_eq!(position(&simulation, "stone").z, -height_m);

    // It can continue once nobody minds.
    simulation.clear_stop_conditions();
    assert!(simulation.run(1.5, &mut ()).unwrap().status.is_completed());
}

#[test]
fn exact_conditions_on_one_agent_and_of_the_users_own() {
    let mut simulation = stone();
    let who = Who::Agent("target".into());
    simulation
        .stop_when(StopCondition::Below { who, height_m: 0.0 })
        .unwrap();
    let fast = |scene: &sifre::Scene<'_>| scene.of("stone").is_some_and(|stone| stone.velocity.z > 3.0);
    simulation.stop_when(StopCondition::when("fast", fast)).unwrap();
    let report = simulation.run(10.0, &mut ()).unwrap();
    assert!(matches!(&report.status, RunStatus::Condition { name } if name == "fast"));
    // v = g t: the first millisecond beyond 3 m/s.
    let expected = (3.0 / vehicle().environment.gravity * 1e3).ceil() / 1e3;
    assert_eq!(report.time_s, expected);
}

/// A disturbance that is not bearable: the run ends, with the time and the last finite state.
#[test]
fn exact_divergence_keeps_the_last_state() {
    let vehicle = vehicle();
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let script = Script {
        command_offset: Schedule::new([(0.1, [f64::MAX, 0.0, 0.0, 0.0])]).unwrap(),
        ..Script::default()
    };
    let setup = Setup {
        script,
        ..Setup::new("alpha", &vehicle, Level::Three, c3(&vehicle), hold)
    };
    let mut simulation =
        Engine::new(vec![Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0))]).unwrap();
    for _ in 0..2 {
        // Asked again it says the same again.
        let report = simulation.run(1.0, &mut ()).unwrap();
        let RunStatus::Diverged {
            agent,
            last: Some(last),
            ..
        } = &report.status
        else {
            panic!("{:?}", report.status)
        };
        assert_eq!(agent, "alpha");
        assert_eq!((last.time_s, report.time_s), (0.1, 0.101));
        assert!(last.published.is_finite());
        assert_eq!(simulation.published("alpha").unwrap(), &last.published);
    }
}

/// Events reach the observer as they happen.
#[test]
fn exact_events_are_observed() {
    #[derive(Default)]
    struct Seen(Vec<Event>);
    impl Observer for Seen {
        fn event(&mut self, event: &Event) {
            self.0.push(event.clone());
        }
    }
    let vehicle = vehicle();
    let hold = Reference::hold([0.0; 3].into(), 0.0);
    let script = Script {
        level: Schedule::new([(0.05, Level::Five.into())]).unwrap(),
        ..Script::default()
    };
    let quadrotor = |name: &str| {
        let setup = Setup::new(name, &vehicle, Level::Three, c3(&vehicle), hold);
        let script = script.clone();
        Member::new(ModelQuadrotor::new(Setup { script, ..setup }).unwrap(), ms(1.0))
    };
    let mut simulation = Engine::new(vec![quadrotor("b"), quadrotor("a")]).unwrap();
    let mut seen = Seen::default();
    simulation.run(0.1, &mut seen).unwrap();
    let names: Vec<_> = seen
        .0
        .iter()
        .map(|event| (event.time_ns, event.agent.as_str()))
        .collect();
    assert_eq!(names, [(50_000_000, "a"), (50_000_000, "b")]);
    assert_eq!(simulation.events(), seen.0);
}
