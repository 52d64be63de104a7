//! What is in the page.

use crate::support::{NASTY, column, flight, scene, station};
use animate::{Kind, Options, Scene, html};
use serde_json::Value;

/// The data that the page carries.
fn data(page: &str) -> Value {
    let (_, rest) = page
        .split_once(r#"<script type="application/json" id="data">"#)
        .expect("the data");
    let (text, _) = rest.split_once("</script>").expect("their end");
    serde_json::from_str(text).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("numbers");
    all.iter().map(|x| x.as_f64().expect("a number")).collect()
}

#[test]
fn prop_the_page_needs_nothing_else() {
    let page = html(&flight(), &scene(), &Options::default()).unwrap();
    // Whatever a page can load by itself: nothing of this is present, and its policy forbids the rest.
    for loads in ["src=\"", "href=\"", "@import", "url(", "import("] {
        let ours = page.split("var THREE=").next().expect("the page before three.js");
        assert!(!ours.contains(loads), "{loads}");
    }
    assert!(page.contains("default-src 'none'"));
    assert!(page.contains("The MIT License"), "the licence of three.js");
}

#[test]
fn prop_names_are_text() {
    let page = html(&flight(), &scene(), &Options::default()).unwrap();
    assert!(!page.contains(NASTY));
    assert!(page.contains("A &lt;short&gt; flight") && !page.contains("A <short> flight"));
    let data = data(&page);
    assert_eq!(data["agents"][2]["name"], NASTY);
}

#[test]
fn exact_positions_and_attitudes_are_those_recorded() {
    let flight = flight();
    let data = data(&html(&flight, &scene(), &Options::default()).unwrap());
    let (p, q) = (numbers(&data["agents"][0]["p"]), numbers(&data["agents"][0]["q"]));
    let [x, yaw, roll, pitch] = ["position.x", "attitude.yaw", "attitude.roll", "attitude.pitch"]
        .map(|name| column(&flight, &format!("alpha.{name}")));
    assert_eq!(numbers(&data["t"]).len(), flight.len());
    for k in 0..flight.len() {
        // Written to five decimals.
        assert!((p[3 * k] - x[k]).abs() <= 0.5e-5 + 1e-12);
        let quaternion = nalgebra::Quaternion::new(q[4 * k + 3], q[4 * k], q[4 * k + 1], q[4 * k + 2]);
        let written = nalgebra::UnitQuaternion::from_quaternion(quaternion);
        let recorded = nalgebra::UnitQuaternion::from_euler_angles(roll[k], pitch[k], yaw[k]);
        // Four components wrong by half a unit each: an angle of at most 2 · √4 · 0.5e-5.
        assert!(written.angle_to(&recorded) < 2.1e-5);
    }
    // Neighbours have the same sign, also where the yaw passes π.
    for pair in q.chunks_exact(4).collect::<Vec<_>>().windows(2) {
        assert!(pair[0].iter().zip(pair[1]).map(|(a, b)| a * b).sum::<f64>() > 0.9);
    }
}

#[test]
fn exact_long_recordings_are_thinned_and_say_so() {
    let flight = flight();
    let options = Options { max_frames: 16 };
    let page = html(&flight, &scene(), &options).unwrap();
    assert!(page.contains(&format!("16 of {} recorded rows", flight.len())));
    let t = numbers(&data(&page)["t"]);
    assert_eq!((t.len(), t[0], t[15]), (16, 0.0, 3.0));
}

#[test]
fn exact_a_scene_guessed_from_the_recording() {
    let guessed = Scene::from_recording(&flight());
    let kinds: Vec<(&str, &str)> = guessed
        .agents
        .iter()
        .map(|a| (a.name.as_str(), a.kind.name()))
        .collect();
    assert_eq!(
        kinds,
        [
            ("alpha", "quadrotor"),
            (NASTY, "target"),
            ("station", "ground station")
        ]
    );
    let Kind::Ets {
        tracks,
        station: found,
    } = &guessed.agents[2].kind
    else {
        panic!("the last is the station");
    };
    assert_eq!(tracks, "alpha");
    assert_eq!(found.pedestal, station().pedestal);
    assert!(html(&flight(), &guessed, &Options::default()).is_ok());
}
