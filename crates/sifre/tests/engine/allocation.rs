//! No heap in the loop: counted by the allocator itself.
//!
//! Counted for the measuring thread alone, so tests beside it change nothing.

use allocation_counter::measure;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, C1, Reference, Settings};
use sifre::black_box::CsvBox;
use sifre::quadrotor::{Gusts, ProcessNoiseSource, Script, Setup, Turbulence, Wind};
use sifre::{
    Engine, EtsSetup, Facing, Follow, GimballedEts, Member, ModelQuadrotor, Schedule, StepSize,
    StopCondition, Target,
};
use std::sync::Arc;

/// A quadrotor at every level in wind, gusts and noise, each facing the next, a follower, a target and a station; steps of 1, 2 and 3 ms.
fn simulation() -> Engine {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let c1 = || AnyController::C1(C1::new(&vehicle, &Settings::default()).unwrap().into());
    let step = |ns| StepSize::from_ns(ns).unwrap();
    let mut members = vec![Member::new(
        Target::fixed("target", [2.0, 0.0, -1.0].into()),
        step(3_000_000),
    )];
    for level in Level::ALL {
        let hold = Facing::agent(Reference::hold([0.2, 0.1, -1.0].into(), 0.0), "target");
        let turbulence = Turbulence {
            w20_m_s: 8.0,
            seed: 1,
            gusts: Gusts::All,
        };
        let script = Script {
            wind: Wind {
                turbulence: (level >= Level::Four).then_some(turbulence),
                ..Wind::default()
            },
            process_noise: Some(ProcessNoiseSource {
                acceleration_m_s2_sqrt_hz: 0.01,
                angular_acceleration_rad_s2_sqrt_hz: 0.01,
                seed: 1,
            }),
            wind_m_s: Schedule::new([(0.05, [1.0, 0.0, 0.0])]).unwrap(),
            command_offset: Schedule::new([(0.05, [1e-5, 0.0, 0.0, 0.0])]).unwrap(),
            ..Script::default()
        };
        let setup = Setup {
            script,
            ..Setup::new(level.to_string(), &vehicle, level, c1(), hold)
        };
        members.push(Member::new(ModelQuadrotor::new(setup).unwrap(), step(1_000_000)));
    }
    let follow = Follow::agent("target", [-1.0, 0.0, 0.0], 0.0);
    let setup = Setup::new("follower", &vehicle, Level::Three, c1(), follow);
    members.push(Member::new(ModelQuadrotor::new(setup).unwrap(), step(2_000_000)));
    let mut setup = EtsSetup::nominal("station", "follower");
    setup.station.pedestal.position = [-4.0, 0.0, 0.0];
    let station = GimballedEts::new(setup);
    members.push(Member::new(station, step(2_000_000)));
    let mut simulation = Engine::new(members).unwrap();
    let fast = |scene: &sifre::Scene<'_>| scene.of("follower").is_some_and(|f| f.velocity.norm() > 100.0);
    simulation.stop_when(StopCondition::when("fast", fast)).unwrap();
    simulation
}

/// The station has found its target by then; what happens is noted, and notes are on the heap.
const SETTLED_S: f64 = 0.04;

#[test]
fn exact_no_allocation_in_the_loop() {
    let mut simulation = simulation();
    simulation.run(SETTLED_S, &mut ()).unwrap();
    let counted = measure(|| {
        assert!(simulation.run(1.0, &mut ()).unwrap().status.is_completed());
    });
    assert_eq!(counted.count_total, 0);
}

#[test]
fn exact_no_allocation_in_a_csv_row() {
    let mut simulation = simulation();
    let every = StepSize::from_ns(2_000_000).unwrap();
    simulation.attach(every, CsvBox::new(std::io::sink())).unwrap();
    simulation.run(SETTLED_S, &mut ()).unwrap();
    let counted = measure(|| {
        assert!(simulation.run(0.5, &mut ()).unwrap().status.is_completed());
    });
    assert_eq!(counted.count_total, 0);
}

/// The counter counts: without this the tests above could not fail.
#[test]
fn exact_the_counter_counts() {
    assert_eq!(
        measure(|| drop(std::hint::black_box(vec![1.0_f64; 8]))).count_total,
        1
    );
}
