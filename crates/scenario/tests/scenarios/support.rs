//! Flying scenarios and looking at them.

use scenario::{Keep, Scenario, ScenarioError};
use sifre::StepSize;
use std::ops::Deref;

/// The text of a ready scenario.
pub(crate) fn ready(name: &str) -> String {
    let text = scenario::ready(name).unwrap_or_else(|| panic!("no ready scenario {name}"));
    text.to_owned()
}

/// A scenario flown to its end, and what was kept of it.
pub(crate) struct Flown(pub(crate) scenario::Flown);

impl Deref for Flown {
    type Target = scenario::Flown;

    fn deref(&self) -> &scenario::Flown {
        &self.0
    }
}

/// Flies a scenario; it is recorded every 10 ms.
pub(crate) fn fly(text: &str) -> Flown {
    let scenario = Scenario::from_toml_str(text, "test").unwrap_or_else(|error| panic!("{error}"));
    let keep = Keep {
        rows: Some(StepSize::from_seconds(0.01).expect("ten milliseconds")),
        ..Keep::METRICS
    };
    Flown(scenario.fly(&(), &keep).unwrap_or_else(|error| panic!("{error}")))
}

impl Flown {
    /// A column.
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let column = self.recording.column(name);
        column.unwrap_or_else(|| panic!("no channel {name}")).collect()
    }

    /// The last value of a column.
    pub(crate) fn last(&self, name: &str) -> f64 {
        *self.column(name).last().expect("there are rows")
    }

    /// The value of a column at a time, s.
    pub(crate) fn at(&self, name: &str, time_s: f64) -> f64 {
        let place = self.recording.times_s().position(|t| t >= time_s - 1e-9);
        self.column(name)[place.expect("within the flight")]
    }

    /// A metric, whether the flight ended early or not.
    pub(crate) fn metric(&self, name: &str) -> f64 {
        let metric = self.metrics.iter().find(|metric| metric.name == name);
        metric
            .unwrap_or_else(|| panic!("no metric {name} in {:?}", self.metrics))
            .value
    }
}

/// Why a scenario is refused, by the time it would fly.
pub(crate) fn refusal(text: &str) -> String {
    let flown = Scenario::from_toml_str(text, "test.toml")
        .and_then(|scenario| scenario.build(&()))
        .and_then(scenario::Built::start);
    let error: ScenarioError = flown
        .err()
        .unwrap_or_else(|| panic!("this should be refused:\n{text}"));
    error.to_string()
}
