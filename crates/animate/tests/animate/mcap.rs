//! MCAP files read back.

use crate::support::{NASTY, column, flight, scene, station, with_value};
use animate::AnimateError;
use animate::foxglove::write_mcap;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use sifre::Recording;
use std::io::Cursor;

/// Topic, log time (ns) and content of each message.
fn written(recording: &Recording) -> Vec<(String, u64, Value)> {
    let mut file = Cursor::new(Vec::new());
    write_mcap(recording, &scene(), &mut file).unwrap();
    let messages = mcap::MessageStream::new(file.get_ref()).unwrap();
    messages
        .map(|message| {
            let message = message.unwrap();
            let schema = message.channel.schema.as_ref().expect("a schema");
            assert_eq!(
                (
                    schema.encoding.as_str(),
                    message.channel.message_encoding.as_str()
                ),
                ("jsonschema", "json")
            );
            let content = serde_json::from_slice(&message.data).unwrap();
            (message.channel.topic.clone(), message.log_time, content)
        })
        .collect()
}

fn rotation(transform: &Value) -> UnitQuaternion<f64> {
    let part = |key: &str| transform["rotation"][key].as_f64().expect(key);
    UnitQuaternion::from_quaternion(Quaternion::new(part("w"), part("x"), part("y"), part("z")))
}

#[test]
fn exact_every_number_of_every_row_comes_back() {
    let recording = flight();
    let messages = written(&recording);
    // One pose and one row per agent and instant, and the world's frame.
    assert_eq!(messages.len(), 1 + 6 * recording.len());
    for (topic, channel) in [
        ("alpha", "velocity.y"),
        ("station", "power.received"),
        (NASTY, "attitude.yaw"),
    ] {
        let of_topic = messages.iter().filter(|m| m.0 == format!("/{topic}"));
        let numbers = column(&recording, &format!("{topic}.{channel}"));
        for (((_, time_ns, content), number), expected_ns) in of_topic.zip(&numbers).zip(recording.times_ns())
        {
            let (outer, inner) = channel.split_once('.').unwrap();
            // Numbers go through JSON bit for bit.
            assert_eq!(content[outer][inner].as_f64(), Some(*number));
            assert_eq!(time_ns, expected_ns);
        }
    }
}

#[test]
fn exact_frames() {
    let recording = flight();
    let messages = written(&recording);
    let frames: Vec<&Value> = messages.iter().filter(|m| m.0 == "/tf").map(|m| &m.2).collect();
    // Down is against the z axis of viewers, east against their y axis.
    let to_map = rotation(frames[0]);
    assert_eq!(frames[0]["child_frame_id"], "W");
    assert!((to_map * Vector3::z() + Vector3::z()).norm() < 1e-15);
    assert!((to_map * Vector3::y() + Vector3::y()).norm() < 1e-15);
    // The beam of the station goes along its frame's x axis; by hand from pan and tilt.
    let last = frames
        .iter()
        .rev()
        .find(|f| f["child_frame_id"] == "station")
        .unwrap();
    let [pan, tilt] = ["pan", "tilt"].map(|axis| {
        *column(&recording, &format!("station.gimbal.{axis}"))
            .last()
            .unwrap()
    });
    let bearing = station().pedestal.heading + pan;
    let beam = Vector3::new(
        tilt.cos() * bearing.cos(),
        tilt.cos() * bearing.sin(),
        -tilt.sin(),
    );
    assert!((rotation(last) * Vector3::x() - beam).norm() < 1e-14);
    assert_eq!(last["translation"]["z"], -1.0);
}

#[test]
fn prop_bad_numbers_are_null_in_rows_and_errors_in_poses() {
    let gap = with_value(&flight(), "station.range", 0, f64::NAN);
    let messages = written(&gap);
    let first = messages.iter().find(|m| m.0 == "/station").unwrap();
    assert!(first.2["range"].is_null());
    let lost = with_value(&flight(), "alpha.attitude.yaw", 0, f64::NAN);
    let result = write_mcap(&lost, &scene(), Cursor::new(Vec::new()));
    assert!(matches!(result, Err(AnimateError::NotFinite { .. })));
}
