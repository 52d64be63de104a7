//! The laws of the engine, bit for bit: order, threads, resuming.

use crate::support::{
    Plan, c1, in_order, members, ms, name, plans, run_recorded, sorted_bits, sorted_snapshot,
};
use proptest::prelude::*;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::Reference;
use sifre::black_box::MemoryBox;
use sifre::quadrotor::Setup;
use sifre::{
    Engine, Execution, Guidance, Member, ModelQuadrotor, Moment, Progress, Recording, RunStatus,
    SimulationSnapshot,
};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Length of a flight, s: no multiple of most steps.
const END_S: f64 = 0.12;

/// Plans and an order of their agents, the target's included.
fn shuffled() -> impl Strategy<Value = (Vec<Plan>, Vec<usize>)> {
    plans().prop_flat_map(|plans| {
        let order = Just(in_order(&plans)).prop_shuffle();
        (Just(plans), order)
    })
}

fn simulation(plans: &[Plan]) -> Engine {
    Engine::new(members(plans, &in_order(plans))).expect("valid plans")
}

/// By way of a file, as one would.
fn through_json(snapshot: &SimulationSnapshot) -> SimulationSnapshot {
    let mut file = Vec::new();
    snapshot.write_json(&mut file).expect("memory doesn't fail");
    SimulationSnapshot::read_json(&file[..]).expect("what was written")
}

/// Instants and bits.
fn bits(recordings: &[&Recording]) -> Vec<(u64, Vec<u64>)> {
    let rows = recordings.iter().flat_map(|recording| recording.rows());
    rows.map(|row| (row.time_ns, row.values.iter().map(|x| x.to_bits()).collect()))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn prop_the_order_of_agents_does_not_matter((plans, order) in shuffled()) {
        let mut given = simulation(&plans);
        let (_, first) = run_recorded(&mut given, END_S);
        let mut shuffled = Engine::new(members(&plans, &order)).expect("valid plans");
        let (_, second) = run_recorded(&mut shuffled, END_S);
        prop_assert_eq!(first.times_ns(), second.times_ns());
        prop_assert_eq!(sorted_bits(&first), sorted_bits(&second));
        prop_assert_eq!(sorted_snapshot(&given), sorted_snapshot(&shuffled));
    }

    /// Stopped at any nanosecond, saved, read back, resumed: the same states, the same rows, the same events.
    #[test]
    fn prop_resumed_equals_uninterrupted(plans in plans(), pause_ns in 0..120_000_000_u64) {
        let mut whole = simulation(&plans);
        let (_, uninterrupted) = run_recorded(&mut whole, END_S);

        let mut first = simulation(&plans);
        let (report, before) = run_recorded(&mut first, pause_ns as f64 / 1e9);
        prop_assert!(report.status.is_completed());
        let snapshot = through_json(&first.save().expect("states are JSON"));
        drop(first);
        let mut second = Engine::resume(members(&plans, &in_order(&plans)), &snapshot).expect("the same agents");
        let (_, after) = run_recorded(&mut second, END_S);
        prop_assert_eq!(sorted_snapshot(&second), sorted_snapshot(&whole));
        prop_assert_eq!(bits(&[&before, &after]), bits(&[&uninterrupted]));
    }

    /// Interrupted in mid-run by whoever watches, then continued.
    #[test]
    fn prop_interrupted_and_continued_equals_uninterrupted(plans in plans()) {
        let mut whole = simulation(&plans);
        let (_, uninterrupted) = run_recorded(&mut whole, END_S);

        let mut other = simulation(&plans);
        let id = other.attach(ms(2.0), MemoryBox::default()).expect("at the start");
        let report = other.run(END_S, &mut |_: &Progress| ControlFlow::Break(())).expect("a later end");
        prop_assert!(matches!(report.status, RunStatus::Interrupted));
        prop_assert!(report.time_s < END_S && report.agent_steps > 0);
        prop_assert!(other.run(END_S, &mut ()).expect("a later end").status.is_completed());
        let memory = other.detach::<MemoryBox>(id).expect("it is there").expect("memory doesn't fail");
        prop_assert_eq!(sorted_snapshot(&other), sorted_snapshot(&whole));
        prop_assert_eq!(bits(&[&memory.recording]), bits(&[&uninterrupted]));
    }
}

proptest! {
    // Each case flies a hundred agents four times.
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn prop_threads_do_not_matter(plans in prop::collection::vec(plans(), 40)) {
        // One step for all: agents of one instant are shared out among threads from 64 on, and these are 80 or more.
        let mut plans = plans.concat();
        for plan in &mut plans {
            plan.step = ms(1.0);
        }
        let flown = |execution, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let mut simulation = simulation(&plans);
            simulation.execute(execution);
            let (_, recording) = pool.install(|| run_recorded(&mut simulation, 0.02));
            (sorted_snapshot(&simulation), bits(&[&recording]))
        };
        let one = flown(Execution::OneThread, 1);
        for threads in [1, 2, 5] {
            prop_assert!(flown(Execution::Parallel, threads) == one, "{threads} threads");
        }
    }
}

/// Holds its place, and at the start waits until the other of its kind is asked, too: on another thread.
#[derive(Debug)]
struct Meeting {
    mine: Arc<AtomicBool>,
    other: Arc<AtomicBool>,
    missed: Arc<AtomicBool>,
}

/// How long they wait for each other: for ever, if there is one thread only.
const PATIENCE: Duration = Duration::from_secs(60);

impl Guidance for Meeting {
    fn reference(&self, now: &Moment<'_>) -> Reference<f64> {
        self.mine.store(true, Ordering::SeqCst);
        let begin = Instant::now();
        while now.time_ns == 0 && !self.other.load(Ordering::SeqCst) {
            if begin.elapsed() > PATIENCE {
                self.missed.store(true, Ordering::SeqCst);
                break;
            }
            std::thread::yield_now();
        }
        Reference::hold([0.0, 0.0, -1.0].into(), 0.0)
    }
}

/// The first and the last of 64 agents are asked for their references at the same time on two threads.
#[test]
fn exact_many_agents_are_shared_out() {
    let [first, last, missed] = [0, 1, 2].map(|_| Arc::new(AtomicBool::new(false)));
    let vehicle = Arc::new(Vehicle::qball_x4());
    let member = |i: usize| {
        let pilot = c1(&vehicle);
        let meeting = |mine, other| Meeting {
            mine: Arc::clone(mine),
            other: Arc::clone(other),
            missed: Arc::clone(&missed),
        };
        let setup = match i {
            0 => Setup::new(name(i), &vehicle, Level::Two, pilot, meeting(&first, &last)),
            63 => Setup::new(name(i), &vehicle, Level::Two, pilot, meeting(&last, &first)),
            _ => {
                let hold: Reference<f64> = Reference::hold([0.0, 0.0, -1.0].into(), 0.0);
                Setup::new(name(i), &vehicle, Level::Two, pilot, hold)
            }
        };
        Member::new(
            ModelQuadrotor::new(setup).expect("the nominal vehicle flies"),
            ms(1.0),
        )
    };
    let mut simulation = Engine::new((0..64).map(member).collect()).expect("names differ");
    simulation.execute(Execution::Parallel);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let run = || simulation.run(0.002, &mut ()).expect("a later end");
    assert!(pool.expect("threads").install(run).status.is_completed());
    assert!(!missed.load(Ordering::SeqCst), "one thread did it all");
}
