//! Three standard suites, from good to very poor.

use super::{Instrument, Sensor, SensorSuite};
use serde::{Deserialize, Serialize};

/// The Earth's magnetic field along W, µT: about 50 µT at 65° of inclination, as in the middle of the northern latitudes, with
/// north taken as magnetic north.
pub const EARTH_FIELD_UT: [f64; 3] = [21.0, 0.0, 45.0];

/// How good the sensors of a suite are. Numbers are assumed, typical of their class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quality {
    /// Consumer-grade inertial sensors by their data sheets (noise of an MPU-6050 at a bandwidth of 100 Hz: 0.05 °/s,
    /// 4 mg), fixes to a centimetre at 20 Hz.
    Good,
    /// The same on a vibrating airframe, half calibrated; fixes to a decimetre, 5 Hz, 50 ms late.
    Poor,
    /// What still flies: two to five times worse again; fixes to half a metre, 1 Hz, 200 ms late, every fifth lost.
    VeryPoor,
}

/// Numbers of a suite.
struct Numbers {
    accelerometer: [f64; 3],
    gyroscope: [f64; 3],
    magnetometer: f64,
    sonar: Sensor,
    fix: Sensor,
}

/// Inertial unit and magnetometer, Hz.
const INERTIAL_RATE_HZ: f64 = 100.0;
const MAGNETOMETER_RATE_HZ: f64 = 20.0;
/// Range of a sonar, m, as the vendor of the Qball gives it.
const SONAR_RANGE: [f64; 2] = [0.2, 7.65];

impl Quality {
    /// All, best first.
    pub const ALL: [Self; 3] = [Self::Good, Self::Poor, Self::VeryPoor];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Poor => "poor",
            Self::VeryPoor => "very poor",
        }
    }

    fn numbers(self) -> Numbers {
        let sonar = |noise, rate_hz, dropout| Sensor {
            range: Some(SONAR_RANGE),
            dropout,
            ..Sensor::noisy(Instrument::Sonar, noise, rate_hz)
        };
        let fix = |noise, rate_hz, delay_s, dropout| Sensor {
            delay_s,
            dropout,
            ..Sensor::noisy(Instrument::PositionFix, noise, rate_hz)
        };
        match self {
            Self::Good => Numbers {
                accelerometer: [0.04, 0.1, 1e-3],
                gyroscope: [1e-3, 5e-3, 1e-4],
                magnetometer: 0.5,
                sonar: sonar(0.01, 20.0, 0.0),
                fix: fix(0.01, 20.0, 0.0, 0.0),
            },
            Self::Poor => Numbers {
                accelerometer: [0.2, 0.3, 5e-3],
                gyroscope: [0.01, 0.03, 5e-4],
                magnetometer: 2.0,
                sonar: sonar(0.03, 10.0, 0.05),
                fix: fix(0.1, 5.0, 0.05, 0.05),
            },
            Self::VeryPoor => Numbers {
                accelerometer: [1.0, 0.5, 0.02],
                gyroscope: [0.05, 0.1, 2e-3],
                magnetometer: 6.0,
                sonar: sonar(0.1, 5.0, 0.2),
                fix: fix(0.5, 1.0, 0.2, 0.2),
            },
        }
    }

    /// Accelerometer, gyroscope, magnetometer, sonar, position fixes.
    pub fn sensors(self) -> [Sensor; 5] {
        let numbers = self.numbers();
        let inertial = |instrument, [noise, turn_on_bias, bias_drift]: [f64; 3]| Sensor {
            turn_on_bias,
            bias_drift,
            ..Sensor::noisy(instrument, noise, INERTIAL_RATE_HZ)
        };
        let field_ut = EARTH_FIELD_UT;
        [
            inertial(Instrument::Accelerometer, numbers.accelerometer),
            inertial(Instrument::Gyroscope, numbers.gyroscope),
            Sensor::noisy(
                Instrument::Magnetometer { field_ut },
                numbers.magnetometer,
                MAGNETOMETER_RATE_HZ,
            ),
            numbers.sonar,
            numbers.fix,
        ]
    }

    /// The suite.
    pub fn suite(self) -> SensorSuite {
        SensorSuite {
            sensors: self.sensors().to_vec(),
        }
    }
}
