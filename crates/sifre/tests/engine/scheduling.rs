//! Who sees whom when: probes that publish the time and write down what they see.

use proptest::prelude::*;
use quad_kinematics::Rotation;
use sifre::black_box::{Frame, MemoryBox, Role};
use sifre::{
    Agent, AgentEvent, AgentId, BindError, Channel, Directory, Engine, Member, MemoryError, Moment,
    Published, StepSize,
};

/// Publishes the time of its latest instant as its x, and notes what it sees of another.
#[derive(Debug)]
struct Probe {
    name: &'static str,
    other: &'static str,
    looks_at: Option<AgentId>,
    x: f64,
    seen: Vec<(u64, f64)>,
}

impl Probe {
    fn new(name: &'static str, other: &'static str) -> Self {
        Self {
            name,
            other,
            looks_at: None,
            x: 0.0,
            seen: Vec::new(),
        }
    }
}

impl Agent for Probe {
    fn name(&self) -> &str {
        self.name
    }

    fn kind(&self) -> &'static str {
        "probe"
    }

    fn bind(&mut self, directory: &Directory<'_>) -> Result<(), BindError> {
        self.looks_at = Some(directory.find(self.other)?);
        Ok(())
    }

    fn published(&self) -> Published {
        Published::at_rest([self.x, 0.0, 0.0].into(), Rotation::identity())
    }

    fn decide(&mut self, now: &Moment<'_>) -> Option<AgentEvent> {
        assert_eq!(self.x, now.time_s, "it is where it should be in time");
        assert_eq!(now.own().position.x, now.time_s);
        let seen = now.published(self.looks_at.expect("bound")).position.x;
        self.seen.push((now.time_ns, seen));
        None
    }

    fn advance(&mut self, now: &Moment<'_>) {
        self.x = now.next_s();
    }

    fn channels(&self) -> Vec<Channel> {
        vec![Channel::new("x", Role::State, "s", Frame::Scalar)]
    }

    fn record(&self, row: &mut [f64]) {
        row[0] = self.x;
    }

    fn save(&self) -> Result<serde_json::Value, serde_json::Error> {
        serde_json::to_value(self.x)
    }

    fn restore(&mut self, memory: &serde_json::Value) -> Result<(), MemoryError> {
        self.x = serde_json::from_value(memory.clone())?;
        Ok(())
    }
}

/// The latest multiple of a step not after an instant, s: what is held there.
fn held(time_ns: u64, step: StepSize) -> f64 {
    (time_ns / step.ns() * step.ns()) as f64 / 1e9
}

proptest! {
    /// Three rates that don't divide each other: a, b and the black box.
    #[test]
    fn exact_everyone_sees_what_is_held(
        a_ns in 1..40_u64, b_ns in 1..40_u64, box_ns in 1..40_u64, end_ns in 1..400_u64,
    ) {
        let step = |ns| StepSize::from_ns(ns * 100_000).unwrap();
        let (a, b, every) = (step(a_ns), step(b_ns), step(box_ns));
        let end_ns = end_ns * 77_777;
        let mut simulation = Engine::new(vec![
            Member::new(Probe::new("a", "b"), a),
            Member::new(Probe::new("b", "a"), b),
        ]).unwrap();
        let id = simulation.attach(every, MemoryBox::default()).unwrap();
        let report = simulation.run(end_ns as f64 / 1e9, &mut ()).unwrap();
        prop_assert_eq!(simulation.now_ns(), end_ns);

        for (name, own, other) in [("a", a, b), ("b", b, a)] {
            let probe: &Probe = simulation.agent(name).unwrap();
            let expected: Vec<_> = (0..=end_ns / own.ns())
                .map(|k| (k * own.ns(), held(k * own.ns(), other)))
                .collect();
            prop_assert_eq!(&probe.seen, &expected);
        }
        // Every instant before the end is left with a move.
        let moves = end_ns.div_ceil(a.ns()) + end_ns.div_ceil(b.ns());
        prop_assert_eq!(report.agent_steps, moves);

        let recording = simulation.detach::<MemoryBox>(id).unwrap().unwrap().recording;
        prop_assert_eq!(recording.len() as u64, end_ns / every.ns() + 1);
        for (k, row) in recording.rows().enumerate() {
            let time_ns = k as u64 * every.ns();
            prop_assert_eq!(row.time_ns, time_ns);
            prop_assert_eq!(row.values, &[held(time_ns, a), held(time_ns, b)]);
        }
    }
}
