//! Controllers in a scenario file.

use quad_dynamics::Level;
use quad_ndi::{AttitudeSettings, Law, LoopDesign, LoopSettings, PidSettings, Settings};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// Which control law: one by its name, or the inversion that belongs to the level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LawChoice {
    /// This one.
    Given(Law),
    /// The inversion that belongs to the level.
    #[default]
    Paired,
}

impl LawChoice {
    /// What stands for the inversion that belongs to the level.
    const PAIRED: &str = "paired";

    /// All names that a file may use.
    const NAMES: [&str; Law::ALL.len() + 1] = {
        let mut names = [Self::PAIRED; Law::ALL.len() + 1];
        let mut i = 0;
        while i < Law::ALL.len() {
            names[i] = Law::ALL[i].name();
            i += 1;
        }
        names
    };

    /// The law at a level.
    #[must_use]
    pub const fn at(self, level: Level) -> Law {
        match self {
            Self::Given(law) => law,
            Self::Paired => Law::paired(level),
        }
    }

    /// The name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Given(law) => law.name(),
            Self::Paired => Self::PAIRED,
        }
    }
}

impl From<Law> for LawChoice {
    fn from(law: Law) -> Self {
        Self::Given(law)
    }
}

impl Serialize for LawChoice {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for LawChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        if name == Self::PAIRED {
            return Ok(Self::Paired);
        }
        let law = Law::ALL.into_iter().find(|law| law.name() == name);
        law.map(Self::Given)
            .ok_or_else(|| D::Error::unknown_variant(&name, &Self::NAMES))
    }
}

impl JsonSchema for LawChoice {
    fn schema_name() -> Cow<'static, str> {
        "Law".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let one = |name: &str, description: &str| json_schema!({ "type": "string", "const": name, "description": description });
        let laws = Law::ALL.map(|law| one(law.name(), law.summary()));
        let pairs = Level::ALL.map(|level| format!("{} at {level}", Law::paired(level)));
        let paired = format!("The inversion that belongs to the level: {}.", pairs.join(", "));
        let all: Vec<Schema> = laws.into_iter().chain([one(Self::PAIRED, &paired)]).collect();
        json_schema!({ "description": "Which control law.", "oneOf": all })
    }
}

/// A controller and how fast its loops are asked to be. The gains follow from the vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ControllerFile {
    /// Which control law.
    pub kind: LawChoice,
    /// The vehicle that it believes it flies, if not the one that it does fly: a name or a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<String>,
    /// Height loop of an inversion.
    pub height: LoopFile,
    /// Yaw loop of an inversion.
    pub yaw: LoopFile,
    /// Horizontal position loop of an inversion.
    pub position: LoopFile,
    /// Attitude loop of an inversion, relative to its position loop.
    pub attitude: AttitudeFile,
    /// All gains of a PID cascade; those that come with the project if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "pid_settings")]
    pub pid: Option<PidSettings>,
}

/// A loop of an inversion; what is absent is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LoopFile {
    /// Settling time to 2 % of a step, s; 2 s, of the horizontal loop 5 s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settling_time_s: Option<f64>,
    /// Damping ratio; 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Extra real pole of c3's loop over the natural frequency; 20.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pole_ratio: Option<f64>,
}

/// The attitude loop of an inversion; what is absent is the default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AttitudeFile {
    /// Natural frequency over that of the horizontal loop; 10.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_ratio: Option<f64>,
    /// Damping ratio; 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Extra real pole of c3's loop over the natural frequency; 5.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pole_ratio: Option<f64>,
}

impl LoopFile {
    fn or(&self, default: LoopSettings) -> LoopSettings {
        LoopSettings {
            settling_time_s: self.settling_time_s.unwrap_or(default.settling_time_s),
            damping: self.damping.unwrap_or(default.damping),
            pole_ratio: self.pole_ratio.unwrap_or(default.pole_ratio),
        }
    }
}

impl AttitudeFile {
    fn or(&self, default: AttitudeSettings) -> AttitudeSettings {
        AttitudeSettings {
            frequency_ratio: self.frequency_ratio.unwrap_or(default.frequency_ratio),
            damping: self.damping.unwrap_or(default.damping),
            pole_ratio: self.pole_ratio.unwrap_or(default.pole_ratio),
        }
    }
}

impl ControllerFile {
    /// What its loops are asked to achieve: the defaults of the source's captions where the file is silent, but for the horizontal
    /// loop of an inversion.
    #[must_use]
    pub fn design(&self) -> LoopDesign {
        LoopDesign {
            inversion: Settings {
                height: self.height.or(LoopSettings::default()),
                yaw: self.yaw.or(LoopSettings::default()),
                position: self.position.or(POSITION),
                attitude: self.attitude.or(AttitudeSettings::default()),
            },
            pid: self.pid.unwrap_or_default(),
        }
    }
}

/// The horizontal loop unless the file says otherwise: 5 s, since the 2 s of the captions puts the attitude loop at
/// 29 rad/s, which the rotors of levels 4 and 5 don't follow (ARCHITECTURE.md).
pub const POSITION: LoopSettings = LoopSettings {
    settling_time_s: 5.0,
    damping: 1.0,
    pole_ratio: 20.0,
};

/// A positive number with its description.
fn positive(description: &str) -> Schema {
    json_schema!({ "type": "number", "exclusiveMinimum": 0, "description": description })
}

fn not_negative(description: &str) -> Schema {
    json_schema!({ "type": "number", "minimum": 0, "description": description })
}

fn pid_settings(_: &mut SchemaGenerator) -> Schema {
    let gains = json_schema!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "proportional": not_negative("Proportional gain, 1/s²."),
            "integral": not_negative("Integral gain, 1/s³."),
            "derivative": not_negative("Derivative gain, 1/s."),
        },
        "required": ["proportional", "integral", "derivative"],
    });
    json_schema!({
        "type": "object",
        "additionalProperties": false,
        "properties": {
            "height": gains,
            "yaw": gains,
            "position": gains,
            "attitude": gains,
            "filter_bandwidth_rad_s": positive("Bandwidth of the derivative filters, rad/s."),
            "tilt_limit_rad": positive("Largest demanded tilt, rad."),
            "anti_windup_per_s": positive("Rate of the back-calculation, 1/s."),
            "set_point_weight": {
                "type": "number", "exclusiveMinimum": 0, "maximum": 1, "default": 1,
                "description": "Share of a step of the set point that the proportional action of loops with an integral sees at once.",
            },
        },
        "required": [
            "height", "yaw", "position", "attitude", "filter_bandwidth_rad_s", "tilt_limit_rad", "anti_windup_per_s",
        ],
    })
}
