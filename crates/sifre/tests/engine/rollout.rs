//! The pure batch rollout against the engine.

use crate::support::{c3, ms, vehicle};
use nalgebra::Vector3;
use quad_dynamics::{Level, Level3, QuadrotorModel};
use quad_ndi::{C3, Reference, Settings};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Setup, Start};
use sifre::{
    Engine, Execution, Member, ModelQuadrotor, Recording, Rollout, RunStatus, Simulation, SimulationError,
};

/// Set points of three flights.
fn to(k: usize) -> Reference<f64> {
    Reference::hold([0.5 * k as f64, -0.3, -1.0].into(), 0.1 * k as f64)
}

fn start(k: usize) -> [f64; 3] {
    [k as f64, 0.0, -0.5]
}

fn rollout(count: usize) -> Rollout<Level3<f64>, C3<f64>> {
    let vehicle = vehicle();
    let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena()).unwrap();
    let controller = C3::new(&vehicle, &Settings::default()).unwrap();
    let mut rollout = Rollout::new(model, controller, ms(2.0)).unwrap();
    for k in 0..count {
        rollout
            .add(format!("agent-{k}"), (start(k).into(), 0.0), move |_| to(k))
            .unwrap();
    }
    rollout
}

fn engine(count: usize) -> Engine {
    let vehicle = vehicle();
    let member = |k| {
        let setup = Setup::new(format!("agent-{k}"), &vehicle, Level::Three, c3(&vehicle), to(k));
        let start = Start {
            position_m: start(k),
            yaw_rad: 0.0,
        };
        Member::new(ModelQuadrotor::new(Setup { start, ..setup }).unwrap(), ms(2.0))
    };
    Engine::new((0..count).map(member).collect()).unwrap()
}

/// Runs in two parts, recorded every 7 ms, which no step divides.
fn recorded(simulation: &mut dyn Simulation) -> Recording {
    let id = simulation
        .attach_box(ms(7.0), Box::new(MemoryBox::default()))
        .unwrap();
    for end_s in [0.3011, 1.0] {
        assert!(simulation.run(end_s, &mut ()).unwrap().status.is_completed());
        assert_eq!(simulation.now_s(), end_s);
    }
    let black_box: Box<dyn std::any::Any> = simulation.detach_box(id).unwrap().unwrap();
    black_box.downcast::<MemoryBox>().unwrap().recording
}

#[test]
fn agree_with_the_engine_bit_for_bit() {
    let (mut engine, mut rollout) = (engine(3), rollout(3));
    let (by_engine, by_rollout) = (recorded(&mut engine), recorded(&mut rollout));
    assert_eq!(by_engine.times_ns(), by_rollout.times_ns());
    for channel in by_rollout.channels() {
        assert!(by_engine.channels().contains(channel), "{}", channel.name);
        let same = by_engine
            .column(&channel.name)
            .unwrap()
            .eq(by_rollout.column(&channel.name).unwrap());
        assert!(same, "{}", channel.name);
    }
    for name in by_rollout_names(&rollout) {
        assert_eq!(Engine::published(&engine, &name), rollout.published(&name));
    }
}

fn by_rollout_names(rollout: &dyn Simulation) -> Vec<String> {
    rollout.names().to_vec()
}

#[test]
fn agree_on_one_thread_and_on_all() {
    let (mut one, mut all) = (rollout(5), rollout(5));
    all.execute(Execution::Parallel);
    assert_eq!(recorded(&mut one), recorded(&mut all));
}

/// A set point that becomes infinite: the engine and the rollout end at the same instant with the same last pose.
#[test]
fn agree_where_a_flight_diverges() {
    let vehicle = vehicle();
    let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena()).unwrap();
    let controller = C3::new(&vehicle, &Settings::default()).unwrap();
    let mut rollout = Rollout::new(model, controller, ms(2.0)).unwrap();
    let far = Reference::hold(Vector3::new(f64::MAX, 0.0, 0.0), 0.0);
    rollout
        .add("still", (Vector3::zeros(), 0.0), |_| {
            Reference::hold(Vector3::zeros(), 0.0)
        })
        .unwrap();
    rollout.add("far", (Vector3::zeros(), 0.0), move |_| far).unwrap();
    let report = rollout.run(1.0, &mut ()).unwrap();

    let setup = Setup::new("far", &vehicle, Level::Three, c3(&vehicle), far);
    let mut engine = Engine::new(vec![Member::new(ModelQuadrotor::new(setup).unwrap(), ms(2.0))]).unwrap();
    let by_engine = engine.run(1.0, &mut ()).unwrap();
    let last = |status: &RunStatus| match status {
        RunStatus::Diverged { agent, last, .. } => (agent.clone(), **last.as_ref().unwrap()),
        other => panic!("{other}"),
    };
    assert_eq!(last(&report.status), last(&by_engine.status));
    assert_eq!(report.time_s, by_engine.time_s);
    // Asked again it says so again, and moves nothing.
    let again = rollout.run(1.0, &mut ()).unwrap();
    assert_eq!(last(&again.status), last(&report.status));
    assert_eq!(again.agent_steps, 0);
}

#[test]
fn exact_flights_are_added_before_the_first_run() {
    let mut batch = rollout(2);
    let at = (Vector3::zeros(), 0.0);
    let twice = batch.add("agent-1", at, |_| to(0)).unwrap_err();
    assert!(matches!(twice, SimulationError::DuplicateName { .. }));
    batch.run(0.1, &mut ()).unwrap();
    let late = batch.add("late", at, |_| to(0)).unwrap_err();
    assert!(matches!(late, SimulationError::AlreadyBegun { .. }), "{late}");
    assert!(matches!(
        rollout(0).run(0.1, &mut ()).unwrap_err(),
        SimulationError::Empty
    ));
    let back = batch.run(0.05, &mut ()).unwrap_err();
    assert!(matches!(back, SimulationError::EndBeforeNow { .. }));
}
