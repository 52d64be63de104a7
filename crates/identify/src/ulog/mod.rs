//! Flights from PX4's ULog files, through the crate of the PX4 project.
//!
//! | topic, field | becomes |
//! | --- | --- |
//! | `sensor_combined.accelerometer_m_s2[0..3]` | specific force, m/s², forward-right-down |
//! | `sensor_combined.gyro_rad[0..3]` | rates, rad/s, forward-right-down |
//! | `actuator_motors.control[i]` | command, share of the motor's range, 0 to 1; held from message to message |
//! | `battery_status.voltage_v` | battery voltage, V; held from message to message; not needed |
//!
//! Times are the messages', s since the autopilot's start. Rows before the first command, and rows while a motor that is
//! wanted is not armed (NaN), are left out. Source: PX4's message definitions `SensorCombined.msg`, `ActuatorMotors.msg`
//! (since version 1.14; older logs have no `actuator_motors`).

mod structure;

use crate::input::{Part, Recorded};
use crate::output::Answer;
use nalgebra::Vector3;
use px4_ulog::stream_parser::{DataMessage, Message, SimpleCallbackResult, read_file_with_simple_callback};
use std::error::Error;
use std::fs::File;
use std::io::BufReader;
use std::ops::ControlFlow;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use sysid::recorded::InertialLog;

/// Microseconds to seconds.
const SECONDS: f64 = 1e-6;

/// Reads a flight; `motors` are the autopilot's numbers, from 1, of the vehicle's rotors in their order.
pub(crate) fn flight(
    path: &Path,
    motors: &[usize; 4],
    part: Part,
    answer: &mut Answer,
) -> Result<Recorded, Box<dyn Error>> {
    let name = path.display();
    let text = path.to_str().ok_or("the path of a ULog file must be UTF-8")?;
    let named = |error: String| format!("{name}: {error}");
    let file = File::open(path).map_err(|e| named(e.to_string()))?;
    if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
        return Err(named("a ULog is read twice, so it must be a file, not a stream".to_owned()).into());
    }
    structure::check(BufReader::new(file)).map_err(named)?;
    let mut gathered = Gathered::new(motors, part);
    let end = caught(|| {
        read_file_with_simple_callback(text, &mut |message| {
            if let Message::Data(data) = message {
                gathered.take(data);
            }
            match gathered.end {
                None => SimpleCallbackResult::KeepReading,
                Some(_) => SimpleCallbackResult::Stop,
            }
        })
    });
    let is_damaged = match end {
        Some(end) => end.map_err(|e| named(e.to_string()))?.is_incomplete(),
        None => true,
    };
    if is_damaged {
        answer.warnings.push(format!(
            "{name}: the log is cut off or damaged; the part before is used"
        ));
    }
    if let Some(Err(why)) = &gathered.end {
        return Err(named(why.clone()).into());
    }
    if gathered.backwards > 0 {
        answer.warnings.push(format!(
            "{name}: {} messages of sensor_combined are not later than the one before and are ignored",
            gathered.backwards
        ));
    }
    gathered.log(&name.to_string())
}

/// What a reading by the library gives; nothing if a message that is shorter than it should be makes the library panic, which ends the reading as the
/// end of the file would.
fn caught<T>(read: impl FnOnce() -> T) -> Option<T> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let read = panic::catch_unwind(AssertUnwindSafe(read));
    panic::set_hook(hook);
    read.ok()
}

/// What has been read.
struct Gathered {
    part: Part,
    /// Why no more is read.
    end: Option<Result<(), String>>,
    fields: [String; 4],
    commands: Option<[f64; 4]>,
    voltage: Option<f64>,
    log: InertialLog,
    voltages: Vec<f64>,
    sensors: usize,
    motors: usize,
    backwards: usize,
}

impl Gathered {
    fn new(motors: &[usize; 4], part: Part) -> Self {
        Self {
            part,
            end: None,
            fields: motors.map(|number| format!("control[{}]", number.saturating_sub(1))),
            commands: None,
            voltage: None,
            voltages: Vec::new(),
            log: InertialLog {
                time: Vec::new(),
                specific_force: Vec::new(),
                body_rates: Vec::new(),
                commands: Vec::new(),
                remarks: Vec::new(),
            },
            sensors: 0,
            motors: 0,
            backwards: 0,
        }
    }

    fn take(&mut self, data: &DataMessage<'_>) {
        match data.flattened_format.message_name() {
            "actuator_motors" => {
                self.motors += 1;
                let [a, b, c, d] = &self.fields;
                let read = [a, b, c, d].map(|field| number(data, field));
                let finite = read.iter().all(|c| c.is_some_and(f64::is_finite));
                self.commands = finite.then(|| read.map(Option::unwrap_or_default));
            }
            "battery_status" => {
                let read = number(data, "voltage_v").filter(|v| v.is_finite() && *v > 0.0);
                self.voltage = read.or(self.voltage);
            }
            "sensor_combined" => {
                self.sensors += 1;
                if let (Some(commands), Some((time, force, rates))) = (self.commands, inertial(data)) {
                    self.push(time, force, rates, commands);
                }
            }
            _ => {}
        }
    }

    fn push(&mut self, time: f64, force: Vector3<f64>, rates: Vector3<f64>, commands: [f64; 4]) {
        if self.log.time.last().is_some_and(|last| *last >= time) {
            self.backwards += 1;
            return;
        }
        match self.part.keeps(time, self.log.time.len()) {
            ControlFlow::Break(why) => {
                self.end.get_or_insert(why);
                return;
            }
            ControlFlow::Continue(false) => return,
            ControlFlow::Continue(true) => {}
        }
        self.log.time.push(time);
        self.log.specific_force.push(force);
        self.log.body_rates.push(rates);
        self.log.commands.push(commands);
        self.voltages.extend(self.voltage);
    }

    fn log(self, name: &str) -> Result<Recorded, Box<dyn Error>> {
        if self.log.time.is_empty() {
            return Err(format!(
                "{name}: no sample with inertial data and four motor commands ({} messages of sensor_combined, {} of \
                 actuator_motors with {} finite)",
                self.sensors,
                self.motors,
                self.fields.join(", ")
            )
            .into());
        }
        // Before the first message of the battery there is none: then the flight counts as one without.
        let complete = self.voltages.len() == self.log.time.len();
        Ok(Recorded {
            log: self.log,
            voltage: complete.then_some(self.voltages),
        })
    }
}

/// Time, s, specific force and rates of a message of `sensor_combined`; none if a number is missing or not finite.
fn inertial(data: &DataMessage<'_>) -> Option<(f64, Vector3<f64>, Vector3<f64>)> {
    let stamp = data.flattened_format.timestamp_field.as_ref()?;
    let micros = stamp.parse_timestamp(data.data);
    let vector = |name: &str| -> Option<Vector3<f64>> {
        let axis = |k: usize| number(data, &format!("{name}[{k}]")).filter(|x| x.is_finite());
        Some(Vector3::new(axis(0)?, axis(1)?, axis(2)?))
    };
    Some((
        micros as f64 * SECONDS,
        vector("accelerometer_m_s2")?,
        vector("gyro_rad")?,
    ))
}

/// A field of single precision, if the message has it.
fn number(data: &DataMessage<'_>, field: &str) -> Option<f64> {
    let parser = data.flattened_format.get_field_parser::<f32>(field).ok()?;
    let end = usize::from(parser.offset()) + size_of::<f32>();
    (end <= data.data.len()).then(|| f64::from(parser.parse(data.data)))
}
