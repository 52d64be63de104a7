//! Recorded flights played back, and the station that always points exactly.

use crate::support::{c3, ms, vehicle};
use ets::Station;
use nalgebra::Vector3;
use quad_dynamics::Level;
use quad_kinematics::EulerAngles;
use quad_ndi::{Reference, TiltLaw, Trajectory, Waypoint};
use sifre::black_box::MemoryBox;
use sifre::quadrotor::{Pose, RecordedFlightError, Setup, Start};
use sifre::{
    Agent, Engine, EtsSetup, Facing, GimballedEts, IdealEts, Member, Mission, ModelQuadrotor, Published,
    Quadrotor, RecordedQuadrotor, Recording,
};

fn pose(time_s: f64, position: [f64; 3], velocity: [f64; 3], yaw: f64) -> Pose {
    Pose {
        time_s,
        published: Published {
            position: position.into(),
            velocity: velocity.into(),
            rotation: EulerAngles::level(yaw).rotation(),
            body_rates: Vector3::new(0.0, 0.0, 0.5),
        },
    }
}

/// `p(t) = [t³ − t, 2 t², −1]`, turning with 0.5 rad/s, from 1 s to 3 s.
fn cubic(time_s: f64) -> Pose {
    let t = time_s;
    let velocity = [3.0 * t * t - 1.0, 4.0 * t, 0.0];
    pose(t, [t.powi(3) - t, 2.0 * t * t, -1.0], velocity, 0.5 * t)
}

/// Runs a flight alone at 10 ms steps and gives what it published at a time, s.
fn published_at(flight: &RecordedQuadrotor, time_s: f64) -> Published {
    let mut engine = Engine::new(vec![Member::new(flight.clone(), ms(10.0))]).unwrap();
    engine.run(time_s, &mut ()).unwrap();
    *engine.published(flight.name()).unwrap()
}

/// A cubic in time and a constant turn are played back to rounding, whatever the distance of the poses.
#[test]
fn exact_a_cubic_is_played_back() {
    let flight = RecordedQuadrotor::new("alpha", [1.0, 1.7, 3.0].map(cubic).to_vec()).unwrap();
    assert_eq!(flight.span_s(), [1.0, 3.0]);
    for time_s in [1.0, 1.01, 1.36, 1.7, 2.5, 3.0] {
        let (got, want) = (published_at(&flight, time_s), cubic(time_s).published);
        // Positions up to 24 m: some ten roundings.
        assert!((got.position - want.position).norm() < 1e-13, "{time_s}");
        assert!((got.velocity - want.velocity).norm() < 1e-12, "{time_s}");
        assert!(
            (got.rotation.matrix - want.rotation.matrix).norm() < 1e-14,
            "{time_s}"
        );
    }
}

#[test]
fn exact_it_rests_before_and_after() {
    let flight = RecordedQuadrotor::new("alpha", [1.0, 3.0].map(cubic).to_vec()).unwrap();
    for (time_s, end_s) in [(0.0, 1.0), (0.5, 1.0), (3.01, 3.0), (4.0, 3.0)] {
        let (got, want) = (published_at(&flight, time_s), cubic(end_s).published);
        assert_eq!(got.position, want.position);
        assert_eq!(
            (got.velocity, got.body_rates),
            (Vector3::zeros(), Vector3::zeros())
        );
    }
    assert_eq!(flight.model_level(), None);
}

#[test]
fn exact_bad_recordings_are_refused() {
    let new = |poses: Vec<Pose>| RecordedQuadrotor::new("alpha", poses).unwrap_err();
    assert_eq!(new(vec![cubic(1.0)]), RecordedFlightError::TooShort { found: 1 });
    let back = new(vec![cubic(1.0), cubic(2.0), cubic(2.0)]);
    assert_eq!(
        back.to_string(),
        "times of a recorded flight must increase: pose 3 is at 2 s, the one before at 2 s"
    );
    let nan = pose(2.0, [f64::NAN, 0.0, 0.0], [0.0; 3], 0.0);
    assert_eq!(
        new(vec![cubic(1.0), nan]),
        RecordedFlightError::NotFinite { row: 2 }
    );
    let recording = crossing(true).0;
    let error = RecordedQuadrotor::from_recording("x", &recording, "bravo").unwrap_err();
    assert_eq!(
        error.to_string(),
        "the recording has no channel `bravo.position.x`; its agents: alpha, station, ideal"
    );
}

/// A flight across the field of two stations, one real and one ideal; or the recorded flight instead.
fn crossing(by_model: bool) -> (Recording, f64, f64) {
    let waypoint = |time_s, position_m| Waypoint {
        time_s,
        position_m,
        velocity_m_s: [0.0; 3],
        yaw_rad: 0.0,
        yaw_rate_rad_s: 0.0,
    };
    let vehicle = vehicle();
    let ends = [[4.0, -2.0, -1.0], [4.0, 2.0, -1.5]];
    let path = Trajectory::through(&[waypoint(0.0, ends[0]), waypoint(8.0, ends[1])]).unwrap();
    let mission = Mission {
        trajectory: path,
        gravity: vehicle.environment.gravity,
        tilt_law: TiltLaw::Exact,
    };
    let setup = Setup {
        start: Start {
            position_m: ends[0],
            yaw_rad: 2.678,
        },
        ..Setup::new(
            "alpha",
            &vehicle,
            Level::Five,
            c3(&vehicle),
            Facing::agent(mission, "station"),
        )
    };
    let model = Member::new(ModelQuadrotor::new(setup).unwrap(), ms(1.0));
    let alpha = if by_model {
        model
    } else {
        let recording = crossing(true).0;
        let flight = RecordedQuadrotor::from_recording("alpha", &recording, "alpha").unwrap();
        Member::new(flight, ms(1.0))
    };
    let setup = |name: &str| EtsSetup {
        pan_rad: -0.46,
        tilt_rad: 0.2,
        ..EtsSetup::nominal(name, "alpha")
    };
    let mut engine = Engine::new(vec![
        alpha,
        Member::new(GimballedEts::new(setup("station")), ms(1.0)),
        Member::new(IdealEts::new(setup("ideal")), ms(1.0)),
    ])
    .unwrap();
    let id = engine.attach(ms(20.0), MemoryBox::default()).unwrap();
    assert!(engine.run(8.0, &mut ()).unwrap().status.is_completed());
    let recording = engine.detach::<MemoryBox>(id).unwrap().unwrap().recording;
    let energy = |name: &str| {
        let power = recording.column(&format!("{name}.power.received")).unwrap();
        power.sum::<f64>() * 0.02
    };
    let (real, ideal) = (energy("station"), energy("ideal"));
    (recording, real, ideal)
}

/// A station that tracks the recording of a flight receives what it received from the flight. Recorded every 20 ms, the
/// cubic's error is `h⁴/384` of the fourth derivative of a path whose fastest loop has some 8 rad/s and
/// moves centimetres: micrometres, of a spot of centimetres.
#[test]
fn agree_with_the_flight_that_was_recorded() {
    let (flown, real, ideal) = crossing(true);
    let (played, real_again, ideal_again) = crossing(false);
    assert!((real_again / real - 1.0).abs() < 1e-4, "{real} J, {real_again} J");
    assert!(
        (ideal_again / ideal - 1.0).abs() < 1e-4,
        "{ideal} J, {ideal_again} J"
    );
    let far = flown
        .column("alpha.position.y")
        .unwrap()
        .zip(played.column("alpha.position.y").unwrap())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    // At the recorded instants the poses are those recorded.
    assert!(far < 1e-14, "{far}");
}

/// Ideal pointing bounds the real station at every instant, its spot is centred, and it publishes where it looks.
#[test]
fn prop_ideal_pointing_is_the_bound() {
    let (recording, real, ideal) = crossing(true);
    let column = |name: &str| recording.column(name).unwrap().collect::<Vec<_>>();
    let (bound, got) = (column("ideal.power.received"), column("station.power.received"));
    let (right, up) = (column("ideal.spot.right"), column("ideal.spot.up"));
    for k in 0..bound.len() {
        // Divergence over the receiver's width makes the far half a little darker: the centre is the best point to a few ppm.
        assert!(
            got[k] <= bound[k] * (1.0 + 1e-5),
            "{k}: {} > {}",
            got[k],
            bound[k]
        );
        assert!(right[k].abs() < 1e-12 && up[k].abs() < 1e-12);
    }
    assert!(ideal > real && real > 0.5 * ideal, "{real} J of {ideal} J");
    let pan = column("ideal.gimbal.pan");
    let heading = Station::nominal().pedestal.heading;
    assert!(pan.iter().all(|pan| (pan + heading).abs() < 1.0));
    let reference = Reference::hold([0.0; 3].into(), 0.0);
    assert_eq!(reference.flat.yaw, 0.0);
}

/// Saved and resumed in the middle, the played-back flight and the ideal station continue as if uninterrupted.
#[test]
fn prop_both_survive_saving() {
    let members = || {
        let flight = RecordedQuadrotor::new("alpha", [0.0, 1.0, 3.0].map(cubic).to_vec()).unwrap();
        vec![
            Member::new(flight, ms(3.0)),
            Member::new(IdealEts::new(EtsSetup::nominal("ideal", "alpha")), ms(2.0)),
        ]
    };
    let mut straight = Engine::new(members()).unwrap();
    straight.run(2.0, &mut ()).unwrap();
    let mut first = Engine::new(members()).unwrap();
    first.run(1.001, &mut ()).unwrap();
    let mut second = Engine::resume(members(), &first.save().unwrap()).unwrap();
    second.run(2.0, &mut ()).unwrap();
    for name in ["alpha", "ideal"] {
        assert_eq!(straight.published(name), second.published(name));
    }
}
