//! The laws of the engine, bit for bit: order, threads, resuming.

use crate::support::{Plan, in_order, members, ms, plans, run_recorded, sorted_bits, sorted_snapshot};
use proptest::prelude::*;
use sifre::black_box::MemoryBox;
use sifre::{Execution, Progress, Recording, RunStatus, Simulation, SimulationSnapshot};
use std::ops::ControlFlow;

/// Length of a flight, s: no multiple of most steps.
const END_S: f64 = 0.12;

/// Plans and an order of their agents, the target's included.
fn shuffled() -> impl Strategy<Value = (Vec<Plan>, Vec<usize>)> {
    plans().prop_flat_map(|plans| {
        let order = Just(in_order(&plans)).prop_shuffle();
        (Just(plans), order)
    })
}

fn simulation(plans: &[Plan]) -> Simulation {
    Simulation::new(members(plans, &in_order(plans))).expect("valid plans")
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
        let mut shuffled = Simulation::new(members(&plans, &order)).expect("valid plans");
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
        let mut second = Simulation::resume(members(&plans, &in_order(&plans)), &snapshot).expect("the same agents");
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
        let plans = plans.concat();
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
