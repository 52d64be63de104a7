//! Small random simulations: quadrotors that follow and face one another, at steps that don't divide each other.

use nalgebra::Vector3;
use proptest::prelude::*;
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{AnyController, C1, C3, Pid, PidGains, PidSettings, Reference, Settings};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Gusts, LevelChoice, ProcessNoiseSource, Script, Setup, Start, Turbulence, Wind};
use sifre::{
    Engine, EtsSetup, Facing, Follow, GimballedEts, Member, ModelQuadrotor, Path, Recording, RunReport,
    Schedule, StepSize, Target,
};
use std::sync::Arc;

/// Milliseconds as a step.
pub(crate) fn ms(milliseconds: f64) -> StepSize {
    StepSize::from_seconds(1e-3 * milliseconds).expect("a whole number of nanoseconds")
}

/// The vehicle of all tests.
pub(crate) fn vehicle() -> Arc<Vehicle> {
    Arc::new(Vehicle::qball_x4())
}

/// c3 with default settings.
pub(crate) fn c3(vehicle: &Vehicle) -> AnyController<f64> {
    AnyController::C3(
        C3::new(vehicle, &Settings::default())
            .expect("valid settings")
            .into(),
    )
}

/// c1 with default settings.
pub(crate) fn c1(vehicle: &Vehicle) -> AnyController<f64> {
    AnyController::C1(
        C1::new(vehicle, &Settings::default())
            .expect("valid settings")
            .into(),
    )
}

/// A PID cascade, for its memory rather than its manners.
pub(crate) fn pid(vehicle: &Vehicle) -> AnyController<f64> {
    let gains = |proportional, integral, derivative| PidGains {
        proportional,
        integral,
        derivative,
    };
    let settings = PidSettings {
        height: gains(8.0, 1.0, 5.0),
        yaw: gains(4.0, 0.5, 4.0),
        position: gains(2.0, 0.2, 2.5),
        attitude: gains(60.0, 5.0, 12.0),
        filter_bandwidth_rad_s: 100.0,
        tilt_limit_rad: 0.4,
        anti_windup_per_s: 1.0,
        set_point_weight: 0.5,
    };
    AnyController::Pid(Pid::new(vehicle, &settings).expect("valid gains").into())
}

/// Which controller.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Law {
    C1,
    C3,
    Pid,
}

/// What a random quadrotor does.
#[derive(Clone, Debug)]
pub(crate) enum Task {
    Hold([f64; 3], f64),
    Follow(usize, [f64; 3]),
    HoldFacing([f64; 3], usize),
}

/// A random quadrotor.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) level: Level,
    pub(crate) law: Law,
    pub(crate) step: StepSize,
    pub(crate) start: [f64; 3],
    pub(crate) task: Task,
    pub(crate) gust: (f64, [f64; 3]),
    pub(crate) switch: Option<(f64, Level)>,
}

/// Name of the quadrotor of this number.
pub(crate) fn name(i: usize) -> String {
    format!("agent-{i}")
}

impl Plan {
    fn member(&self, i: usize, count: usize, vehicle: &Arc<Vehicle>) -> Member {
        let pilot = match self.law {
            Law::C1 => c1(vehicle),
            Law::C3 => c3(vehicle),
            Law::Pid => pid(vehicle),
        };
        // Another existing agent, not itself.
        let other = |k: usize| name((i + 1 + k % (count - 1)) % count);
        let setup = match &self.task {
            Task::Hold(at, yaw) => {
                let at = Reference::hold((*at).into(), *yaw);
                Setup::new(name(i), vehicle, self.level, pilot, at)
            }
            Task::Follow(k, offset) => {
                let follow = Follow::agent(other(*k), *offset, 0.1);
                Setup::new(name(i), vehicle, self.level, pilot, follow)
            }
            Task::HoldFacing(at, k) => {
                let facing = Facing::agent(Reference::hold((*at).into(), 0.0), other(*k));
                Setup::new(name(i), vehicle, self.level, pilot, facing)
            }
        };
        let levels = [Some(self.level), self.switch.map(|(_, level)| level)];
        let all_have_drag = levels.into_iter().flatten().all(|level| level >= Level::Four);
        let seed = i as u64;
        let script = Script {
            wind: Wind {
                turbulence: all_have_drag.then_some(Turbulence {
                    w20_m_s: 8.0,
                    seed,
                    gusts: Gusts::All,
                }),
                ..Wind::default()
            },
            process_noise: Some(ProcessNoiseSource {
                acceleration_m_s2_sqrt_hz: 0.01,
                angular_acceleration_rad_s2_sqrt_hz: 0.01,
                seed,
            }),
            wind_m_s: Schedule::new([(self.gust.0, self.gust.1)]).expect("a time of the clock"),
            level: Schedule::new(self.switch.map(|(time, to)| (time, LevelChoice::from(to))))
                .expect("a time"),
            ..Script::default()
        };
        let start = Start {
            position_m: self.start,
            yaw_rad: 0.2,
        };
        let quadrotor = ModelQuadrotor::new(Setup {
            start,
            script,
            ..setup
        })
        .expect("a valid plan");
        Member::new(quadrotor, self.step)
    }
}

/// A station that tracks the first quadrotor, its image noisy.
fn station() -> GimballedEts {
    let mut setup = EtsSetup::nominal("station", name(0));
    setup.station.frames.noise = 2.0;
    setup.seed = 7;
    GimballedEts::new(setup)
}

/// The quadrotors of these plans, a target and a station, in the order of `order`.
pub(crate) fn members(plans: &[Plan], order: &[usize]) -> Vec<Member> {
    let vehicle = vehicle();
    let count = plans.len();
    let member = |&i: &usize| match plans.get(i) {
        Some(plan) => plan.member(i, count, &vehicle),
        None if i == count => Member::new(Target::new("target", lap()), ms(3.0)),
        None => Member::new(station(), ms(4.0)),
    };
    order.iter().map(member).collect()
}

/// There and back.
fn lap() -> Path {
    let waypoint = |time_s, position_m, yaw_rad| quad_ndi::Waypoint {
        time_s,
        position_m,
        velocity_m_s: [0.0; 3],
        yaw_rad,
        yaw_rate_rad_s: 0.0,
    };
    let points = [
        waypoint(0.0, [3.0, 0.0, -1.0], 0.0),
        waypoint(0.2, [3.0, 1.0, -2.0], 1.0),
    ];
    Path::Scripted(quad_ndi::Trajectory::through(&points).expect("two waypoints"))
}

/// Everybody in the order of their numbers; target and station last.
pub(crate) fn in_order(plans: &[Plan]) -> Vec<usize> {
    (0..plans.len() + 2).collect()
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [-1.0..1.0_f64, -1.0..1.0_f64, -3.0..-1.0_f64]
}

fn plan() -> impl Strategy<Value = Plan> {
    let law_and_levels = prop_oneof![
        (Just(Law::C1), 1..=5_u8, 1..=5_u8),
        (Just(Law::C3), 3..=5_u8, 3..=5_u8),
        (Just(Law::Pid), 1..=5_u8, 1..=5_u8),
    ];
    let task = prop_oneof![
        (point(), -3.0..3.0_f64).prop_map(|(at, yaw)| Task::Hold(at, yaw)),
        (0..9_usize, point()).prop_map(|(k, offset)| Task::Follow(k, offset)),
        (point(), 0..9_usize).prop_map(|(at, k)| Task::HoldFacing(at, k)),
    ];
    let step = prop::sample::select(vec![1_000_000_u64, 2_500_000, 700_000, 1_234_567]);
    let times = (0..100_u64, 0..100_u64);
    (law_and_levels, step, point(), task, point(), times, any::<bool>()).prop_map(
        |((law, from, to), step, start, task, wind, (gust, switch), switches)| {
            let level = |number| Level::try_from(number).expect("1 to 5");
            let time = |milliseconds: u64| milliseconds as f64 / 1000.0;
            Plan {
                level: level(from),
                law,
                step: StepSize::from_ns(step).expect("positive"),
                start,
                task,
                gust: (time(gust), wind),
                switch: switches.then(|| (time(switch), level(to))),
            }
        },
    )
}

/// Two to five quadrotors.
pub(crate) fn plans() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec(plan(), 2..=5)
}

/// Runs with a black box every 2 ms and gives its recording.
pub(crate) fn run_recorded(simulation: &mut Engine, end_s: f64) -> (RunReport, Recording) {
    let id = simulation
        .attach(ms(2.0), MemoryBox::default())
        .expect("attached at the start or where it was");
    let report = simulation.run(end_s, &mut ()).expect("an end after the present");
    let memory = simulation
        .detach::<MemoryBox>(id)
        .expect("it is there")
        .expect("memory doesn't fail");
    (report, memory.recording)
}

/// The columns of a recording as bits, sorted by name.
pub(crate) fn sorted_bits(recording: &Recording) -> Vec<(String, Vec<u64>)> {
    let column = |name: &String| -> Vec<u64> {
        let column = recording.column(name).expect("it has this channel");
        column.map(f64::to_bits).collect()
    };
    let mut names: Vec<String> = recording.channels().iter().map(|c| c.name.clone()).collect();
    names.sort();
    names
        .into_iter()
        .map(|name| (name.clone(), column(&name)))
        .collect()
}

/// A snapshot as text, its agents sorted by name.
pub(crate) fn sorted_snapshot(simulation: &Engine) -> String {
    let mut snapshot = simulation.save().expect("states are JSON");
    snapshot.agents.sort_by(|a, b| a.name.cmp(&b.name));
    serde_json::to_string(&snapshot).expect("a snapshot is JSON")
}

/// Position of an agent.
pub(crate) fn position(simulation: &Engine, name: &str) -> Vector3<f64> {
    simulation.published(name).expect("it is there").position
}
