//! What the engine adds to a closed-loop step of level 3 under c3, and a thousand of them at once.
//!
//! `cargo bench -p sifre`; results and machine stand in BENCHMARKS.md. Rows of `step` fly [`STEPS`] steps per agent:
//! microseconds are nanoseconds per step, to be divided by the number of agents. `thousand` flies 10 s.

use divan::{Bencher, black_box};
use nalgebra::Vector3;
use quad_dynamics::{Input, Level, Level3, QuadrotorModel, Vehicle};
use quad_ndi::{Airborne, AnyController, C3, ClosedLoop, InCharge, Reference, Settings};
use sifre::black_box::CsvBox;
use sifre::quadrotor::Setup;
use sifre::{Engine, Execution, Member, ModelQuadrotor, StepSize};
use std::sync::Arc;

fn main() {
    divan::main();
}

/// Steps that each agent of a row flies.
const STEPS: usize = 1000;

/// Step, s.
const STEP_S: f64 = 1e-3;

fn reference() -> Reference<f64> {
    Reference::hold(Vector3::new(0.3, -0.2, -0.5), 0.2)
}

fn c3(vehicle: &Vehicle) -> C3<f64> {
    C3::new(vehicle, &Settings::default()).expect("default settings are valid")
}

fn simulation(agents: usize) -> Engine {
    let vehicle = Arc::new(Vehicle::qball_x4());
    let step = StepSize::from_seconds(STEP_S).expect("a millisecond");
    let member = |i| {
        let pilot = AnyController::C3(c3(&vehicle).into());
        let setup = Setup::new(format!("agent-{i}"), &vehicle, Level::Three, pilot, reference());
        Member::new(
            ModelQuadrotor::new(setup).expect("the nominal vehicle flies"),
            step,
        )
    };
    Engine::new((0..agents).map(member).collect()).expect("names differ")
}

/// The physics alone: the pure step, as rollouts repeat it.
#[divan::bench]
fn step_bare(bencher: Bencher<'_, '_>) {
    let vehicle = Vehicle::qball_x4();
    let model = Level3::<f64>::build(&vehicle, &Level::Three.phenomena()).expect("the nominal vehicle flies");
    let controller = c3(&vehicle);
    let hover = model.hover(Vector3::zeros(), 0.0);
    let start = ClosedLoop {
        plant: Airborne {
            model: &model,
            state: hover.state,
        },
        feedback: InCharge::from(controller),
    };
    let still = Input::still_air([0.0; 4]);
    let reference = reference();
    bencher.bench_local(|| {
        let mut now = black_box(start);
        for _ in 0..STEPS {
            now.step(black_box(&reference), &still, STEP_S);
        }
        now
    });
}

/// The same in the engine, for some numbers of agents.
#[divan::bench(args = [1, 10, 100])]
fn step_engine(bencher: Bencher<'_, '_>, agents: usize) {
    bencher
        .with_inputs(|| simulation(agents))
        .bench_local_refs(|simulation| {
            simulation
                .run(STEPS as f64 * STEP_S, &mut ())
                .expect("an end after the present")
        });
}

/// The same, recorded every 10 ms as CSV.
#[divan::bench(args = [1, 10])]
fn step_engine_recorded(bencher: Bencher<'_, '_>, agents: usize) {
    let recorded = || {
        let mut simulation = simulation(agents);
        let every = StepSize::from_seconds(1e-2).expect("ten milliseconds");
        simulation
            .attach(every, CsvBox::new(std::io::sink()))
            .expect("at the start");
        simulation
    };
    bencher.with_inputs(recorded).bench_local_refs(|simulation| {
        simulation
            .run(STEPS as f64 * STEP_S, &mut ())
            .expect("an end after the present")
    });
}

/// A thousand quadrotors for 10 s.
#[divan::bench(args = [Execution::OneThread, Execution::Parallel], sample_count = 3, sample_size = 1)]
fn thousand(bencher: Bencher<'_, '_>, execution: Execution) {
    let thousand = || {
        let mut simulation = simulation(1000);
        simulation.execute(execution);
        simulation
    };
    bencher.with_inputs(thousand).bench_local_refs(|simulation| {
        rayon::scope(|_| simulation.run(10.0, &mut ()).expect("an end after the present"))
    });
}
