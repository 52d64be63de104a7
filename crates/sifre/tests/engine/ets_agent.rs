//! The energy transmission system in the engine.

use crate::support::ms;
use ets::{Ets as Physics, EtsInput, FrameClock, Mode, Station};
use nalgebra::{Vector2, Vector3};
use quad_ndi::{Trajectory, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::{
    AgentEvent, BindError, Engine, Ets as _, EtsSetup, GimballedEts, Member, Path, SimulationError, Target,
};

fn waypoint(time_s: f64, position_m: [f64; 3]) -> Waypoint {
    Waypoint {
        time_s,
        position_m,
        velocity_m_s: [0.0; 3],
        yaw_rad: 3.0,
        yaw_rate_rad_s: 0.0,
    }
}

/// A crossing of the station's field from left to right in a given time, s, at a distance, m.
fn crossing(duration_s: f64, distance_m: f64) -> Trajectory {
    let points = [
        waypoint(0.0, [distance_m, -2.0, -1.0]),
        waypoint(duration_s, [distance_m, 2.0, -1.5]),
    ];
    Trajectory::through(&points).unwrap()
}

fn simulation(path: &Trajectory, pan_rad: f64, tilt_rad: f64) -> Engine {
    let target = Target::new("target", Path::Scripted(path.clone()));
    let setup = EtsSetup {
        pan_rad,
        tilt_rad,
        ..EtsSetup::nominal("station", "target")
    };
    Engine::new(vec![
        Member::new(target, ms(1.0)),
        Member::new(GimballedEts::new(setup), ms(1.0)),
    ])
    .unwrap()
}

#[test]
fn agree_with_the_pure_step() {
    let path = crossing(4.0, 4.0);
    let mut simulation = simulation(&path, -0.5, 0.2);
    let id = simulation.attach(ms(1.0), MemoryBox::default()).unwrap();
    simulation.run(3.0, &mut ()).unwrap();
    let recording = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;
    let column = |name: &str| recording.column(name).unwrap().collect::<Vec<_>>();
    let (pan, power, image) = (
        column("station.gimbal.pan"),
        column("station.power.received"),
        column("station.image.x"),
    );
    let pan_command = column("station.command.pan");

    let station = Station::nominal();
    let physics = Physics::<f64>::new(&station);
    let clock = FrameClock::new(1e-3, station.frames.rate, station.frames.latency).unwrap();
    let mut state = physics.at_rest(-0.5, 0.2);
    let r_wb = quad_kinematics::EulerAngles::level(3.0).rotation().matrix;
    for n in 0..3000 {
        let at = path.flat_output(n as f64 / 1000.0).position;
        let face = physics.receiver.on(&at, &r_wb);
        let input = EtsInput {
            target: face.centre,
            noise: Vector2::zeros(),
        };
        let k = n as usize;
        assert_eq!(state.gimbal.pan, pan[k]);
        assert_eq!(physics.view(&state.gimbal, &face.centre).point.x, image[k]);
        assert_eq!(physics.link(&state.gimbal, &face).power.received, power[k]);
        let decided = physics.look(&clock, n, &state, &input);
        assert_eq!(physics.command(&decided).pan_rate, pan_command[k]);
        state = physics.step(&clock, n, &state, &input);
    }
    let agent: &GimballedEts = simulation.agent("station").unwrap();
    // At the end it has looked once more, and not turned yet.
    assert_eq!(agent.state().gimbal, state.gimbal);
    assert_eq!(agent.mode(), Mode::Tracking);
}

/// Found when the first frame is delivered; lost when the target is faster than the gimbal; found again by the search.
#[test]
fn exact_events_of_sight() {
    let mut slow = simulation(&crossing(4.0, 4.0), -0.5, 0.2);
    slow.run(4.0, &mut ()).unwrap();
    let events: Vec<_> = slow
        .events()
        .iter()
        .map(|e| (e.time_ns, e.what.clone()))
        .collect();
    // The frame of instant zero, 30 ms later.
    assert_eq!(events, [(30_000_000, AgentEvent::TargetFound)]);

    // At 1.5 m and nearly 10 m/s (4 m in 1 s, peak 2.46 times the mean) the bearing turns by 6 rad/s, the gimbal by 2.
    let mut fast = simulation(&crossing(1.0, 1.5), -0.8, 0.35);
    fast.run(8.0, &mut ()).unwrap();
    let events: Vec<_> = fast.events().iter().map(|e| e.what.clone()).collect();
    let expected = [
        AgentEvent::TargetFound,
        AgentEvent::TargetLost,
        AgentEvent::TargetFound,
    ];
    assert_eq!(events, expected);
    assert_eq!(
        fast.agent::<GimballedEts>("station").unwrap().mode(),
        Mode::Tracking
    );
}

/// What others see of it: the moving platform, which points at what it tracks.
#[test]
fn exact_its_pose_is_the_platforms() {
    let path = crossing(4.0, 4.0);
    let mut simulation = simulation(&path, -0.5, 0.2);
    simulation.run(5.0, &mut ()).unwrap();
    let (station, target) = (
        *simulation.published("station").unwrap(),
        *simulation.published("target").unwrap(),
    );
    assert_eq!(
        station.position,
        Vector3::from(Station::nominal().pedestal.position)
    );
    let receiver = Station::nominal().receiver;
    let centre = target.position + target.rotation.matrix * Vector3::from(receiver.offset);
    let axis = station.rotation.matrix.column(0).into_owned();
    // A second after the target came to rest at 4.5 m; the image error decays with some 7 rad/s from a few px.
    assert!(axis.angle(&(centre - station.position)) < 1e-3);
    assert!(station.body_rates.norm() < 1e-2);
}

#[test]
fn exact_a_step_longer_than_a_frame_is_refused() {
    let target = Target::fixed("target", [4.0, 0.0, 0.0].into());
    let station = GimballedEts::new(EtsSetup::nominal("station", "target"));
    let members = vec![Member::new(target, ms(1.0)), Member::new(station, ms(50.0))];
    let error = Engine::new(members).unwrap_err();
    assert!(matches!(
        &error,
        SimulationError::Bind(BindError::Step { step_s: 0.05, .. })
    ));
    assert!(
        error.to_string().contains("must not exceed the camera's period"),
        "{error}"
    );
}
