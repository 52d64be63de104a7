//! Flying scenarios and looking at them.

use scenario::{Ending, Flight, MetricsBox, Scenario, ScenarioError};
use sifre::black_box::MemoryBox;
use sifre::{Recording, StepSize};

/// The text of a ready scenario.
pub(crate) fn ready(name: &str) -> String {
    let text = scenario::ready(name).unwrap_or_else(|| panic!("no ready scenario {name}"));
    text.to_owned()
}

/// A scenario flown to its end, and its recording.
pub(crate) struct Flown {
    pub(crate) flight: Flight,
    pub(crate) ending: Ending,
    pub(crate) recording: Recording,
    metrics: MetricsBox,
}

/// Flies a scenario; it is recorded every 10 ms.
pub(crate) fn fly(text: &str) -> Flown {
    let scenario = Scenario::from_toml_str(text, "test").unwrap_or_else(|error| panic!("{error}"));
    let built = scenario.build(&()).unwrap_or_else(|error| panic!("{error}"));
    let mut flight = built.fly().unwrap_or_else(|error| panic!("{error}"));
    let step = StepSize::from_seconds(0.01).expect("ten milliseconds");
    let rows = flight
        .simulation
        .attach(step, MemoryBox::default())
        .expect("at the start");
    let sums = flight
        .simulation
        .attach(step, MetricsBox::default())
        .expect("at the start");
    let ending = flight.run(&mut ()).expect("a time of the clock");
    let memory = flight
        .simulation
        .detach::<MemoryBox>(rows)
        .expect("attached")
        .expect("memory");
    let metrics = flight
        .simulation
        .detach::<MetricsBox>(sums)
        .expect("attached")
        .expect("memory");
    Flown {
        flight,
        ending,
        recording: memory.recording,
        metrics,
    }
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

    /// A metric.
    pub(crate) fn metric(&self, name: &str) -> f64 {
        let all = self.metrics.metrics();
        let metric = all.iter().find(|metric| metric.name == name);
        metric
            .unwrap_or_else(|| panic!("no metric {name} in {all:?}"))
            .value
    }
}

/// Why a scenario is refused, by the time it would fly.
pub(crate) fn refusal(text: &str) -> String {
    let flown = Scenario::from_toml_str(text, "test.toml")
        .and_then(|scenario| scenario.build(&()))
        .and_then(scenario::Built::fly);
    let error: ScenarioError = flown
        .err()
        .unwrap_or_else(|| panic!("this should be refused:\n{text}"));
    error.to_string()
}
