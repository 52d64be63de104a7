//! What a flight did, for people and for machines.

use crate::exit::{Exit, Failure};
use scenario::{Flown, Metric};
use serde_json::{Map, Value, json};
use sifre::Event;
use std::io::Write;
use std::path::PathBuf;

/// What a flight did.
#[derive(Debug)]
pub(crate) struct Report {
    /// Name of the scenario.
    pub(crate) scenario: String,
    /// What became of it.
    pub(crate) flown: Flown,
    /// Where it is recorded.
    pub(crate) output: Option<String>,
    /// Where the flight as it is was saved.
    pub(crate) saved: Option<PathBuf>,
}

/// Prints a value on standard output.
pub(crate) fn print(value: &Value) -> Result<(), Failure> {
    say(format!("{value:#}\n"))
}

/// Prints a text on standard output, with what a terminal would obey written out. A pipe that is closed is no error of ours, a disk that is
/// full is one.
pub(crate) fn say(text: impl AsRef<str>) -> Result<(), Failure> {
    output::print(&output::escaped(text.as_ref())).map_err(|source| Failure::Write {
        path: "standard output".into(),
        source,
    })
}

/// Prints a line on standard error, long words shortened; a stream that is closed is no error of ours.
pub(crate) fn complain(line: impl AsRef<str>) {
    let _ = writeln!(std::io::stderr(), "{}", output::message(line.as_ref()));
}

/// Metrics as a JSON object.
pub(crate) fn object(metrics: &[Metric]) -> Value {
    let entries = metrics.iter().map(|m| (m.name.clone(), Value::from(m.value)));
    Value::Object(entries.collect::<Map<_, _>>())
}

impl Report {
    /// How the program is to end.
    pub(crate) fn exit(&self) -> Exit {
        self.flown.ending.end.into()
    }

    /// For machines.
    pub(crate) fn json(&self) -> Value {
        let flown = &self.flown;
        let report = &flown.ending.report;
        json!({
            "scenario": self.scenario,
            "end": report.status.to_string(),
            "time_s": report.time_s,
            "agent_steps": report.agent_steps,
            "wall_s": flown.wall_s,
            "events": flown.events,
            "metrics": object(&flown.metrics),
            "notes": flown.notes,
            "output": self.output,
            "from_s": flown.from_s,
            "saved": self.saved.as_ref().map(|path| path.display().to_string()),
            "exit_code": self.exit().code(),
        })
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        let flown = &self.flown;
        let rate = if flown.wall_s > 0.0 {
            (flown.ending.report.time_s - flown.from_s) / flown.wall_s
        } else {
            0.0
        };
        let mut text = format!(
            "{}: {} ({:.3} s of computing, {rate:.0} times real time)\n",
            self.scenario, flown.ending, flown.wall_s
        );
        for event in &flown.events {
            let time_s = event.time_ns as f64 * 1e-9;
            text += &format!("  {time_s:9.3} s  {}\n", in_words(event));
        }
        for metric in &flown.metrics {
            text += &format!("  {:40} {:>12.6}\n", metric.name, metric.value);
        }
        if let Some(output) = &self.output {
            text += &format!("recorded in {output}\n");
        }
        if let Some(saved) = &self.saved {
            text += &format!("saved in {}; continue with --resume\n", saved.display());
        }
        text
    }
}

/// What happened, and to whom.
pub(crate) fn in_words(event: &Event) -> String {
    let what = match &event.what {
        sifre::AgentEvent::LevelChanged { from, to } => {
            format!("level {} to level {}", from.number(), to.number())
        }
        sifre::AgentEvent::TargetLost => "target lost".to_owned(),
        sifre::AgentEvent::TargetFound => "target found".to_owned(),
        sifre::AgentEvent::EstimatorFailed { reason } => format!("the estimator failed: {reason}"),
        sifre::AgentEvent::Note { text } => text.to_string(),
    };
    format!("{}: {what}", event.agent)
}
