//! Recordings and scenes that can't be animated are errors that say why.

use crate::support::{flight, scene, with_value};
use animate::{AnimateError, Options, Scene, html};
use ets::Station;
use sifre::Recording;

fn error(recording: &Recording, scene: &Scene) -> AnimateError {
    html(recording, scene, &Options::default()).expect_err("this can't be animated")
}

#[test]
fn prop_what_cannot_be_drawn_is_an_error() {
    let flight = flight();
    let empty = Recording::new(flight.channels().to_vec());
    assert!(matches!(error(&empty, &scene()), AnimateError::EmptyRecording));
    assert!(matches!(
        error(&flight, &Scene::new("nothing")),
        AnimateError::NoAgents { .. }
    ));
    let twice = scene().target("alpha");
    assert!(matches!(error(&flight, &twice), AnimateError::SameName { name } if name == "alpha"));
    let unknown = scene().quadrotor("bravo", 0.2);
    assert!(matches!(
        error(&flight, &unknown),
        AnimateError::MissingChannel { channel, .. } if channel == "bravo.position.x"
    ));
    let flat = Scene::new("").quadrotor("alpha", 0.0);
    assert!(matches!(error(&flight, &flat), AnimateError::NotPositive { value, .. } if value == 0.0));
    let stranger = Scene::new("")
        .quadrotor("alpha", 0.2)
        .ets("station", "bravo", &Station::nominal());
    assert!(matches!(
        error(&flight, &stranger),
        AnimateError::UnknownTarget { wanted, known, .. } if wanted == "bravo" && known == ["alpha", "station"]
    ));
}

#[test]
fn prop_numbers_that_are_none_are_errors_in_poses_and_gaps_in_curves() {
    let flight = flight();
    let lost = with_value(&flight, "alpha.position.y", 7, f64::NAN);
    assert!(matches!(
        error(&lost, &scene()),
        AnimateError::NotFinite { channel, time_s, .. } if channel == "alpha.position.y" && time_s == 0.14
    ));
    let between = with_value(&flight, "alpha.level", 3, 2.5);
    assert!(matches!(error(&between, &scene()), AnimateError::BadLevel { value, .. } if value == 2.5));
    let gap = with_value(&flight, "station.incidence", 7, f64::INFINITY);
    assert!(html(&gap, &scene(), &Options::default()).is_ok());
}

#[test]
fn prop_a_station_that_stands_elsewhere_is_refused() {
    let nominal = Scene::new("")
        .quadrotor("alpha", 0.2)
        .ets("station", "alpha", &Station::nominal());
    let error = error(&flight(), &nominal);
    assert!(
        matches!(error, AnimateError::StationElsewhere { distance_m, range_m, .. } if distance_m != range_m),
        "{error}"
    );
}

#[test]
fn prop_options_are_checked() {
    let flight = flight();
    let still = Options { max_frames: 1 };
    assert!(matches!(
        html(&flight, &scene(), &still),
        Err(AnimateError::TooFewFrames { max_frames: 1 })
    ));
}
