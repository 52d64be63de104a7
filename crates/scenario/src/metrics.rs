//! A flight in a few numbers, summed up while it flies.
//!
//! | metric of a quadrotor | what |
//! | --- | --- |
//! | `position_error_rms_m`, `_max_m`, `_final_m` | distance from the reference, `√(1/N Σ |r − r_d|²)` over the rows, largest, last |
//! | `tilt_max_deg` | largest `acos(cos φ cos θ)` |
//! | `height_min_m` | least height above the world's origin |
//! | `estimate_error_rms_m` | distance of an estimate from the flight, `√(1/N Σ |r̂ − r|²)` |
//! | `estimate_sd_rms_m` | what its estimator reports, `√(1/N Σ σ_x² + σ_y² + σ_z²)` |
//! | `x.settling_time_s` (`y`, `z`) | time from the last jump of the set point until the axis stays within 2 % of the step |
//! | `x.overshoot` | largest excursion beyond the set point, as a fraction of the step |
//! | `x.steady_state_error_m` | set point minus mean of the last 5 % of the response |
//!
//! | metric of a station | what |
//! | --- | --- |
//! | `received_energy_j`, `missed_`, `electrical_` | `Σ ½ (P_k + P_k−1) (t_k − t_k−1)`, trapezium |
//! | `tracked_fraction` | share of the rows in which it tracks |
//! | `phi` | cost Φ of the power transmission ([`StationCost`](crate::StationCost)) |
//!
//! Step metrics exist for axes that are asked to jump, once or for the last time, to a place and stay there.

use crate::step::StepResponse;
use sifre::black_box::Channel;
use sifre::{BlackBox, BlackBoxError};
use std::collections::HashMap;

/// A number that sums up a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// Name with its agent's before and the unit at its end: `alpha.position_error_rms_m`.
    pub name: String,
    /// The number.
    pub value: f64,
}

/// Why a flight has no metric of a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MetricError {
    /// No metric has that name.
    #[error("no such metric `{name}`; available: {known}")]
    Unknown {
        /// The name.
        name: String,
        /// Those of the flight.
        known: String,
    },
    /// Several agents have it.
    #[error("several agents have the metric `{name}`; choose one of {candidates}")]
    Ambiguous {
        /// The name.
        name: String,
        /// Those that it fits.
        candidates: String,
    },
}

/// The metric of a name, or of a name without its agent's where only one agent has it.
pub(crate) fn find<'a>(metrics: &'a [Metric], name: &str) -> Result<&'a Metric, MetricError> {
    let exact = |m: &&Metric| m.name == name;
    let short = |m: &&Metric| m.name.split_once('.').is_some_and(|(_, what)| what == name);
    let mut found: Vec<&Metric> = metrics.iter().filter(exact).collect();
    if found.is_empty() {
        found = metrics.iter().filter(short).collect();
    }
    match found[..] {
        [metric] => Ok(metric),
        [] => Err(MetricError::Unknown {
            name: name.to_owned(),
            known: names(metrics),
        }),
        _ => Err(MetricError::Ambiguous {
            name: name.to_owned(),
            candidates: names(found),
        }),
    }
}

fn names<'a>(metrics: impl IntoIterator<Item = &'a Metric>) -> String {
    let names: Vec<&str> = metrics.into_iter().map(|m| m.name.as_str()).collect();
    names.join(", ")
}

/// A black box that keeps sums instead of rows.
#[derive(Debug, Default)]
pub struct MetricsBox {
    quadrotors: Vec<Quadrotor>,
    stations: Vec<Station>,
    last_s: Option<f64>,
    rows: u32,
}

/// Columns and sums of a quadrotor.
#[derive(Debug)]
struct Quadrotor {
    name: String,
    position: [usize; 3],
    reference: [usize; 3],
    tilt: [usize; 2],
    squares: f64,
    largest_error: f64,
    final_error: f64,
    largest_tilt: f64,
    least_height: f64,
    steps: [StepResponse; 3],
    estimate: Option<Estimate>,
}

/// Columns and sums of an estimator.
#[derive(Debug)]
struct Estimate {
    position: [usize; 3],
    deviation: [usize; 3],
    squares: f64,
    variances: f64,
}

/// Columns and sums of a station.
#[derive(Debug)]
struct Station {
    name: String,
    powers: [usize; POWERS.len()],
    mode: usize,
    last: [f64; POWERS.len()],
    energies: [f64; POWERS.len()],
    tracked_rows: u32,
}

/// Powers of a station's recording that are integrated, and what their integrals are called.
const POWERS: [(&str, &str); 3] = [
    ("power.received", "received_energy_j"),
    ("power.missed", "missed_energy_j"),
    ("power.electrical", "electrical_energy_j"),
];

/// A station's mode while it tracks, in recordings.
const TRACKING: f64 = 2.0;

impl MetricsBox {
    /// The numbers, agent by agent.
    #[must_use]
    pub fn metrics(&self) -> Vec<Metric> {
        let mut all = Vec::new();
        let mut push = |agent: &str, what: &str, value: f64| {
            let name = format!("{agent}.{what}");
            all.push(Metric { name, value });
        };
        let rows = f64::from(self.rows.max(1));
        for q in &self.quadrotors {
            push(&q.name, "position_error_rms_m", (q.squares / rows).sqrt());
            push(&q.name, "position_error_max_m", q.largest_error);
            push(&q.name, "position_error_final_m", q.final_error);
            push(&q.name, "tilt_max_deg", q.largest_tilt.to_degrees());
            push(&q.name, "height_min_m", q.least_height);
            if let Some(e) = &q.estimate {
                push(&q.name, "estimate_error_rms_m", (e.squares / rows).sqrt());
                push(&q.name, "estimate_sd_rms_m", (e.variances / rows).sqrt());
            }
            for (axis, step) in ["x", "y", "z"].into_iter().zip(&q.steps) {
                let Some(found) = step.metrics() else {
                    continue;
                };
                let mut push = |what: &str, value| push(&q.name, &format!("{axis}.{what}"), value);
                push("settling_time_s", found.settling_time_s.unwrap_or(f64::NAN));
                push("overshoot", found.overshoot);
                push("steady_state_error_m", found.steady_state_error);
            }
        }
        for s in &self.stations {
            for ((_, energy), value) in POWERS.iter().zip(s.energies) {
                push(&s.name, energy, value);
            }
            push(&s.name, "tracked_fraction", f64::from(s.tracked_rows) / rows);
        }
        all
    }
}

impl BlackBox for MetricsBox {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), BlackBoxError> {
        let places: HashMap<&str, usize> = (channels.iter().enumerate())
            .map(|(place, channel)| (channel.name.as_str(), place))
            .collect();
        let place = |name: String| places.get(name.as_str()).copied();
        for channel in channels {
            if let Some(name) = channel.name.strip_suffix(".reference.position.x") {
                self.quadrotors.extend(Quadrotor::of(name, &place));
            }
            if let Some(name) = channel.name.strip_suffix(".power.received") {
                self.stations.extend(Station::of(name, &place));
            }
        }
        Ok(())
    }

    fn record(&mut self, time_ns: u64, row: &[f64]) -> Result<(), BlackBoxError> {
        let time_s = time_ns as f64 * 1e-9;
        let since_s = self.last_s.map(|last| time_s - last);
        self.quadrotors.iter_mut().for_each(|q| q.add(time_s, row));
        self.stations.iter_mut().for_each(|s| s.add(row, since_s));
        self.last_s = Some(time_s);
        self.rows += 1;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(())
    }
}

/// The greater of two numbers; NaN if either is NaN.
fn greater(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

impl Quadrotor {
    fn of(name: &str, place: &impl Fn(String) -> Option<usize>) -> Option<Self> {
        let xyz = |what: &str| {
            let [x, y, z] = ["x", "y", "z"].map(|axis| place(format!("{name}.{what}.{axis}")));
            Some([x?, y?, z?])
        };
        Some(Self {
            name: name.to_owned(),
            position: xyz("position")?,
            reference: xyz("reference.position")?,
            tilt: [
                place(format!("{name}.attitude.roll"))?,
                place(format!("{name}.attitude.pitch"))?,
            ],
            squares: 0.0,
            largest_error: 0.0,
            final_error: 0.0,
            largest_tilt: 0.0,
            least_height: f64::INFINITY,
            steps: Default::default(),
            estimate: xyz("estimate.position").zip(xyz("estimate.sd.position")).map(
                |(position, deviation)| Estimate {
                    position,
                    deviation,
                    squares: 0.0,
                    variances: 0.0,
                },
            ),
        })
    }

    fn add(&mut self, time_s: f64, row: &[f64]) {
        let difference = |i: usize| row[self.position[i]] - row[self.reference[i]];
        let square: f64 = (0..3).map(|i| difference(i).powi(2)).sum();
        self.squares += square;
        self.final_error = square.sqrt();
        self.largest_error = greater(self.largest_error, self.final_error);
        let [roll, pitch] = self.tilt.map(|place| row[place]);
        self.largest_tilt = greater(self.largest_tilt, (roll.cos() * pitch.cos()).acos());
        self.least_height = -greater(-self.least_height, row[self.position[2]]);
        for (axis, step) in self.steps.iter_mut().enumerate() {
            step.add(time_s, row[self.position[axis]], row[self.reference[axis]]);
        }
        if let Some(e) = &mut self.estimate {
            let missed = |i: usize| row[e.position[i]] - row[self.position[i]];
            e.squares += (0..3).map(|i| missed(i).powi(2)).sum::<f64>();
            e.variances += e.deviation.map(|place| row[place].powi(2)).iter().sum::<f64>();
        }
    }
}

impl Station {
    fn of(name: &str, place: &impl Fn(String) -> Option<usize>) -> Option<Self> {
        let [received, missed, electrical] = POWERS.map(|(power, _)| place(format!("{name}.{power}")));
        Some(Self {
            name: name.to_owned(),
            powers: [received?, missed?, electrical?],
            mode: place(format!("{name}.mode"))?,
            last: [0.0; POWERS.len()],
            energies: [0.0; POWERS.len()],
            tracked_rows: 0,
        })
    }

    fn add(&mut self, row: &[f64], since_s: Option<f64>) {
        for (k, place) in self.powers.into_iter().enumerate() {
            let power = row[place];
            self.energies[k] += 0.5 * (power + self.last[k]) * since_s.unwrap_or(0.0);
            self.last[k] = power;
        }
        self.tracked_rows += u32::from(row[self.mode] == TRACKING);
    }
}
