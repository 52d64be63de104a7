//! Engine and rollout agree bit for bit.

use crate::nominal;
use quad_dynamics::Level;
use sifre::black_box::MemoryBox;
use sifre::{Recording, StepSize};
use std::num::NonZeroU64;
use wpt_optim::{Choice, CostBox, FAILURE, History, Pair, Penalties, Problem, Span, Weights};

/// Instants of the station between two that are compared: 20 ms.
const EVERY: u64 = 10;

/// A crossing north of the station that starts and ends in motion.
const NORTH: [f64; 4] = [5.0, -0.7, 3.5, 0.4];

fn fly(problem: &Problem, x: &[f64]) -> Recording {
    let mut simulation = problem.simulation(x).unwrap();
    let every = problem.mission().station_step.ns() * EVERY;
    let id = simulation
        .attach(StepSize::from_ns(every).unwrap(), MemoryBox::default())
        .unwrap();
    let report = simulation.run(problem.mission().duration_s, &mut ()).unwrap();
    assert!(report.status.is_completed());
    simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording
}

/// What the two have in common, by the engine's channels.
fn numbers(h: &History) -> [(&'static str, f64); 14] {
    [
        ("quadrotor.position.x", h.position_m[0]),
        ("quadrotor.position.y", h.position_m[1]),
        ("quadrotor.position.z", h.position_m[2]),
        ("quadrotor.velocity.y", h.velocity_m_s[1]),
        ("quadrotor.attitude.roll", h.attitude_rad[0]),
        ("quadrotor.attitude.pitch", h.attitude_rad[1]),
        ("quadrotor.attitude.yaw", h.attitude_rad[2]),
        ("quadrotor.reference.position.x", h.reference_m[0]),
        ("ets.gimbal.pan", h.gimbal_rad[0]),
        ("ets.gimbal.tilt", h.gimbal_rad[1]),
        ("ets.range", h.range_m),
        ("ets.incidence", h.incidence_rad),
        ("ets.spot.right", h.spot_m[0]),
        ("ets.spot.up", h.spot_m[1]),
    ]
}

fn assert_same_bits(problem: &Problem, x: &[f64]) {
    let recording = fly(problem, x);
    let flown = problem
        .histories(x, NonZeroU64::new(EVERY).unwrap())
        .unwrap()
        .instants;
    assert_eq!(flown.len(), recording.len());
    for (i, (name, _)) in numbers(&flown[0]).into_iter().enumerate() {
        let column = recording
            .column(name)
            .unwrap_or_else(|| panic!("no channel {name}"));
        for (instant, engine) in flown.iter().zip(column) {
            let rollout = numbers(instant)[i].1;
            let (t, level) = (instant.time_s, problem.level());
            assert!(
                rollout.to_bits() == engine.to_bits(),
                "{level}: {name} at {t} s: {rollout} and {engine}"
            );
        }
    }
}

#[test]
fn agree_engine_and_rollout() {
    for level in Level::ALL {
        assert_same_bits(&nominal(Choice::Four, 10.0, level), &NORTH);
    }
}

/// Over the station, where the bearing turns by half a turn, the target is lost and found, and commands saturate.
#[test]
fn agree_engine_and_rollout_over_the_station() {
    for level in [Level::One, Level::Three, Level::Five] {
        assert_same_bits(&nominal(Choice::Two, 10.0, level), &[4.0, -4.0]);
    }
}

/// Φ of the engine's flight, from its recording at the station's step, cut off after `duration_s`.
fn recorded_cost(problem: &Problem, x: &[f64], duration_s: f64) -> CostBox {
    let mut simulation = problem.simulation(x).unwrap();
    let mission = problem.mission();
    let pair = Pair {
        quadrotor: wpt_optim::QUADROTOR.to_owned(),
        station: wpt_optim::STATION.to_owned(),
    };
    let (weights, penalties) = (Weights::default(), Penalties::default());
    let cost = CostBox::new(pair, &mission.station, &mission.vehicle, &weights, &penalties).unwrap();
    let id = simulation.attach(mission.station_step, cost).unwrap();
    simulation.run(duration_s, &mut ()).unwrap();
    simulation.detach::<CostBox>(id).unwrap().unwrap()
}

/// The same terms at the same instants. Sums differ in their order over 5000 instants, 5000 ε, and the recording gives the attitude
/// as angles, some ε more. A row has the commands of the step that begins, a rollout's instant those of the step that
/// ended: the mean of one term shifts by no more than its variation times the station's step over the duration.
#[test]
fn agree_the_cost_of_a_recording_and_of_the_rollout() {
    for (choice, level, x) in [
        (Choice::Four, Level::One, &NORTH[..]),
        (Choice::Four, Level::Three, &NORTH[..]),
        (Choice::Two, Level::Five, &[4.0, -4.0][..]),
    ] {
        let problem = nominal(choice, 10.0, level);
        let rollout = problem.evaluate(x).unwrap();
        let recorded = recorded_cost(&problem, x, 10.0).outcome(Span::Recorded);
        assert_eq!(recorded.failure, None);
        let mut means = recorded.means.array().into_iter().zip(rollout.means.array());
        let shift = means.next_back().map(|(a, b)| (a - b).abs()).unwrap();
        for (term, (a, b)) in means.enumerate() {
            assert!(
                (a - b).abs() <= 1e-11 * b.abs(),
                "{level}, term {term}: {a} and {b}"
            );
        }
        let flown = problem.histories(x, NonZeroU64::MIN).unwrap().instants;
        let step = |w: &[History]| (w[1].terms.saturation - w[0].terms.saturation).abs();
        let variation: f64 = flown.windows(2).map(step).sum();
        let bound = variation * problem.mission().station_step.seconds() / 10.0;
        assert!(
            shift <= bound,
            "{level}: saturation differs by {shift}, at most {bound}"
        );
        assert!(level != Level::Five || variation > 0.0, "nothing saturates");
    }
}

/// Half a flight of a planned whole: half of the failure's cost, and half of the mean over what was flown.
#[test]
fn exact_what_was_not_flown_costs_its_share_of_a_failure() {
    let problem = nominal(Choice::Four, 10.0, Level::Three);
    let half = recorded_cost(&problem, &NORTH, 5.0);
    let (flown, planned) = (half.outcome(Span::Recorded), half.outcome(Span::Planned(10.0)));
    assert!((planned.cost - 0.5 * (FAILURE + flown.cost)).abs() < 1e-9);
    assert_eq!(planned.failure.map(|failure| failure.time_s), Some(5.0));
}
