//! Recordings as MCAP files, the log format that Foxglove and rerun open.
//!
//! | topic | message, JSON with a JSON schema | what |
//! | --- | --- | --- |
//! | `/tf` | `foxglove.FrameTransform` | once `map` to `W`, then every agent's pose in W at every row |
//! | `/name` | the agent's own | all channels of the agent `name` at every row, nested at their dots |
//!
//! Viewers have z up: their frame `map` is north-west-up, W below it is north-east-down, and an agent's frame is its own,
//! forward-right-down; of a station it is the moving platform. Log times are the recording's, ns. Every row is written,
//! numbers as they are; JSON has no NaN, so a non-finite number is `null`.

use crate::columns::Columns;
use crate::error::AnimateError;
use crate::page::check;
use crate::scene::{Kind, Scene, SceneAgent};
use ::mcap::records::MessageHeader;
use ::mcap::{WriteOptions, Writer};
use quad_kinematics::{EulerAngles, Quaternion};
use serde_json::{Map, Value, json};
use sifre::Recording;
use std::collections::BTreeMap;
use std::io::{Seek, Write};

/// Writes a recording as an MCAP file, uncompressed.
///
/// # Errors
/// A recording without rows, a scene that doesn't fit it, poses that aren't finite; a destination that can't be written.
pub fn write_mcap<W: Write + Seek>(recording: &Recording, scene: &Scene, to: W) -> Result<(), AnimateError> {
    check(recording, scene)?;
    let columns = Columns::thinned(recording, recording.len());
    let poses: Vec<Poses> = scene
        .agents
        .iter()
        .map(|agent| Poses::of(agent, &columns))
        .collect::<Result<_, _>>()?;
    let options = WriteOptions::new().compression(None).library("animate");
    let mut log = Log {
        writer: Writer::with_options(to, options)?,
        sequence: 0,
    };
    let frames = log.channel("/tf", "foxglove.FrameTransform", &frame_transform_schema())?;
    let topics: Vec<Topic> = scene
        .agents
        .iter()
        .map(|agent| Topic::of(agent, recording, &mut log))
        .collect::<Result<_, _>>()?;
    // Half a turn about north takes up to down and west to east.
    let half_turn = Quaternion {
        w: 0.0,
        v: nalgebra::Vector3::x(),
    };
    let first = recording.times_ns()[0];
    log.put(
        frames,
        first,
        &transform(first, ["map", "W"], [0.0; 3], &half_turn),
    )?;
    for (k, row) in recording.rows().enumerate() {
        for (agent, poses) in scene.agents.iter().zip(&poses) {
            let pose = transform(
                row.time_ns,
                ["W", &agent.name],
                poses.positions[k],
                &poses.attitudes[k].quaternion(),
            );
            log.put(frames, row.time_ns, &pose)?;
        }
        for topic in &topics {
            log.put(topic.channel, row.time_ns, &topic.message(row.values))?;
        }
    }
    log.writer.finish()?;
    Ok(())
}

/// The file being written.
struct Log<W: Write + Seek> {
    writer: Writer<W>,
    sequence: u32,
}

impl<W: Write + Seek> Log<W> {
    fn channel(&mut self, topic: &str, schema_name: &str, schema: &Value) -> Result<u16, AnimateError> {
        let text = serde_json::to_vec(schema)?;
        let schema = self.writer.add_schema(schema_name, "jsonschema", &text)?;
        Ok(self.writer.add_channel(schema, topic, "json", &BTreeMap::new())?)
    }

    fn put(&mut self, channel_id: u16, time_ns: u64, message: &Value) -> Result<(), AnimateError> {
        let header = MessageHeader {
            channel_id,
            sequence: self.sequence,
            log_time: time_ns,
            publish_time: time_ns,
        };
        self.sequence = self.sequence.wrapping_add(1);
        self.writer
            .write_to_known_channel(&header, &serde_json::to_vec(message)?)?;
        Ok(())
    }
}

/// Where an agent is and how it is turned, at every row.
struct Poses {
    /// In W, m.
    positions: Vec<[f64; 3]>,
    attitudes: Vec<EulerAngles<f64>>,
}

impl Poses {
    fn of(agent: &SceneAgent, columns: &Columns<'_>) -> Result<Self, AnimateError> {
        let kind = agent.kind.name();
        let rows = columns.times_s.len();
        let positions = || -> Result<Vec<[f64; 3]>, AnimateError> {
            let [x, y, z] = columns.pose(&agent.name, kind, ["position.x", "position.y", "position.z"])?;
            Ok((0..rows).map(|k| [x[k], y[k], z[k]]).collect())
        };
        match &agent.kind {
            Kind::Quadrotor { .. } => {
                let angles = ["attitude.roll", "attitude.pitch", "attitude.yaw"];
                let [roll, pitch, yaw] = columns.pose(&agent.name, kind, angles)?;
                Ok(Self {
                    positions: positions()?,
                    attitudes: (0..rows)
                        .map(|k| EulerAngles::new(roll[k], pitch[k], yaw[k]))
                        .collect(),
                })
            }
            Kind::Ets { station, .. } => {
                let [pan, tilt] = columns.pose(&agent.name, kind, ["gimbal.pan", "gimbal.tilt"])?;
                let heading = station.pedestal.heading;
                Ok(Self {
                    positions: vec![station.pedestal.position; rows],
                    attitudes: (0..rows)
                        .map(|k| EulerAngles::new(0.0, tilt[k], heading + pan[k]))
                        .collect(),
                })
            }
            Kind::Target => Ok(Self {
                positions: positions()?,
                attitudes: vec![EulerAngles::level(0.0); rows],
            }),
        }
    }
}

/// All that is recorded of one agent.
struct Topic {
    channel: u16,
    /// Each number's place in a row, and the keys to it in a message.
    numbers: Vec<(usize, Vec<String>)>,
}

impl Topic {
    fn of<W: Write + Seek>(
        agent: &SceneAgent,
        recording: &Recording,
        log: &mut Log<W>,
    ) -> Result<Self, AnimateError> {
        let mut schema = json!({ "type": "object", "properties": {} });
        let mut numbers = Vec::new();
        for (place, channel) in recording.channels().iter().enumerate() {
            let Some(own) = channel
                .name
                .strip_prefix(&agent.name)
                .and_then(|n| n.strip_prefix('.'))
            else {
                continue;
            };
            let keys: Vec<String> = own.split('.').map(str::to_owned).collect();
            describe(&mut schema, &keys, &channel.unit);
            numbers.push((place, keys));
        }
        let topic = format!("/{}", agent.name);
        let channel = log.channel(&topic, &format!("sifre.{}", agent.name), &schema)?;
        Ok(Self { channel, numbers })
    }

    fn message(&self, row: &[f64]) -> Value {
        let mut message = Map::new();
        for (place, keys) in &self.numbers {
            insert(&mut message, keys, json!(row[*place]));
        }
        Value::Object(message)
    }
}

/// Puts a value where the keys lead, making objects on the way.
fn insert(object: &mut Map<String, Value>, keys: &[String], value: Value) {
    match keys {
        [] => {}
        [last] => {
            object.insert(last.clone(), value);
        }
        [first, rest @ ..] => {
            let inner = object.entry(first.clone()).or_insert_with(|| json!({}));
            if let Value::Object(inner) = inner {
                insert(inner, rest, value);
            }
        }
    }
}

/// Adds a number to a JSON schema where the keys lead.
fn describe(schema: &mut Value, keys: &[String], unit: &str) {
    let mut at = &mut schema["properties"];
    for (depth, key) in keys.iter().enumerate() {
        if depth + 1 == keys.len() {
            at[key] = json!({ "type": "number", "description": unit });
        } else {
            if at[key].is_null() {
                at[key] = json!({ "type": "object", "properties": {} });
            }
            at = &mut at[key]["properties"];
        }
    }
}

/// A `foxglove.FrameTransform`: the pose of a child frame in its parent.
fn transform(
    time_ns: u64,
    [parent, child]: [&str; 2],
    [x, y, z]: [f64; 3],
    rotation: &Quaternion<f64>,
) -> Value {
    json!({
        "timestamp": { "sec": time_ns / 1_000_000_000, "nsec": time_ns % 1_000_000_000 },
        "parent_frame_id": parent,
        "child_frame_id": child,
        "translation": { "x": x, "y": y, "z": z },
        "rotation": { "x": rotation.v.x, "y": rotation.v.y, "z": rotation.v.z, "w": rotation.w },
    })
}

/// The JSON schema of `foxglove.FrameTransform` (Foxglove, *Message schemas*).
fn frame_transform_schema() -> Value {
    let object = |keys: &[&str]| {
        let properties: Map<String, Value> = keys
            .iter()
            .map(|key| ((*key).to_owned(), json!({ "type": "number" })))
            .collect();
        json!({ "type": "object", "properties": properties })
    };
    json!({
        "title": "foxglove.FrameTransform",
        "description": "A transform between two reference frames in 3D space",
        "type": "object",
        "properties": {
            "timestamp": {
                "type": "object",
                "title": "time",
                "properties": { "sec": { "type": "integer", "minimum": 0 }, "nsec": { "type": "integer", "minimum": 0 } }
            },
            "parent_frame_id": { "type": "string" },
            "child_frame_id": { "type": "string" },
            "translation": object(&["x", "y", "z"]),
            "rotation": object(&["x", "y", "z", "w"]),
        }
    })
}
