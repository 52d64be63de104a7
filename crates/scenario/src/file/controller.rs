//! Controllers in a scenario file.

use quad_ndi::{AttitudeSettings, LoopSettings, PidGains, PidSettings, Settings};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

/// Which control law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// Dynamic inversion of level 1, for models of any level.
    C1,
    /// Dynamic inversion of level 2, for levels 2 to 5.
    C2,
    /// Dynamic inversion of level 3, for levels 3 to 5.
    C3,
    /// Conventional cascaded PID, for any level.
    Pid,
    /// The inversion that belongs to the level: c1 at level 1, c2 at level 2, c3 above.
    #[default]
    Paired,
}

/// A controller and how fast its loops are asked to be. The gains follow from the vehicle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ControllerFile {
    /// Which control law.
    pub kind: Law,
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
    /// Settings of an inversion: the defaults of the source's captions where the file is silent, but for the horizontal
    /// loop.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            height: self.height.or(LoopSettings::default()),
            yaw: self.yaw.or(LoopSettings::default()),
            position: self.position.or(POSITION),
            attitude: self.attitude.or(AttitudeSettings::default()),
        }
    }

    /// Gains of a PID cascade.
    pub(crate) fn pid(&self) -> PidSettings {
        self.pid.unwrap_or(PID)
    }
}

/// The horizontal loop unless the file says otherwise: 5 s, since the 2 s of the captions puts the attitude loop at
/// 29 rad/s, which the rotors of levels 4 and 5 don't follow (ARCHITECTURE.md).
pub const POSITION: LoopSettings = LoopSettings {
    settling_time_s: 5.0,
    damping: 1.0,
    pole_ratio: 20.0,
};

/// The PID gains that come with the project, rounded from what `quad_ndi::pid::tune` finds with seed 1 at level 5
/// of the Qball-X4 at constant voltage, commands limited. They are per unit of mass and inertia, so that they carry over to other vehicles.
pub const PID: PidSettings = PidSettings {
    height: gains(16.2, 13.0, 6.81),
    yaw: gains(32.2, 25.5, 12.0),
    position: gains(4.27, 1.32, 4.26),
    attitude: gains(72.5, 110.0, 15.1),
    filter_bandwidth_rad_s: 100.0,
    tilt_limit_rad: std::f64::consts::FRAC_PI_6,
    anti_windup_per_s: 2.0,
    set_point_weight: 0.5,
};

const fn gains(proportional: f64, integral: f64, derivative: f64) -> PidGains {
    PidGains {
        proportional,
        integral,
        derivative,
    }
}

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
