//! What a black box of a whole simulation writes is what it reads back.

use crate::support::{Plan, in_order, members, ms, plans, run_recorded};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use sifre::black_box::{Channel, CsvBox, JsonLinesBox, MemoryBox, Role};
use sifre::{BlackBox, BlackBoxError, Engine, Recording, RunStatus};
use std::io::Write;
use std::sync::{Arc, Mutex};

/// A file in memory that others can look at.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Shared {
    fn bytes(&self) -> Vec<u8> {
        self.0.lock().unwrap().clone()
    }
}

fn some_plans() -> Vec<Plan> {
    let mut runner = TestRunner::deterministic();
    plans()
        .new_tree(&mut runner)
        .expect("a strategy that always succeeds")
        .current()
}

fn simulation(plans: &[Plan]) -> Engine {
    Engine::new(members(plans, &in_order(plans))).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn prop_every_form_is_the_recording(plans in plans()) {
        let (csv, json) = (Shared::default(), Shared::default());
        let mut simulation = simulation(&plans);
        simulation.attach(ms(2.0), CsvBox::new(csv.clone())).unwrap();
        simulation.attach(ms(2.0), JsonLinesBox::new(json.clone())).unwrap();
        #[cfg(feature = "parquet")]
        let parquet = {
            let file = Shared::default();
            simulation.attach(ms(2.0), sifre::black_box::ParquetBox::new(file.clone())).unwrap();
            file
        };
        let (_, memory) = run_recorded(&mut simulation, 0.05);
        simulation.finish_recordings().unwrap();
        prop_assert_eq!(memory.len(), 26);
        prop_assert_eq!(&Recording::from_csv(&csv.bytes()[..]).unwrap(), &memory);
        prop_assert_eq!(&Recording::from_json_lines(&json.bytes()[..]).unwrap(), &memory);
        #[cfg(feature = "parquet")]
        prop_assert_eq!(&Recording::from_parquet(bytes::Bytes::from(parquet.bytes())).unwrap(), &memory);
    }
}

#[test]
fn exact_channels_say_what_they_are() {
    let plans = some_plans();
    let mut simulation = simulation(&plans);
    let (_, recording) = run_recorded(&mut simulation, 0.01);
    let of = |name: &str| recording.channels().iter().find(|c| c.name == name).unwrap();
    assert_eq!(of("agent-0.position.x").unit, "m");
    assert_eq!(of("agent-0.command.1").role, Role::Input);
    assert_eq!(of("agent-1.reference.yaw").role, Role::Reference);
    assert_eq!(of("target.velocity.z").unit, "m/s");
    let mut names: Vec<_> = recording.channels().iter().map(|c| &c.name).collect();
    let all = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), all, "names are unique");
}

/// Fails at its third row.
#[derive(Debug, Default)]
struct Failing(u32);

impl BlackBox for Failing {
    fn begin(&mut self, _channels: &[Channel]) -> Result<(), BlackBoxError> {
        Ok(())
    }

    fn record(&mut self, _time_ns: u64, _row: &[f64]) -> Result<(), BlackBoxError> {
        self.0 += 1;
        if self.0 == 3 {
            return Err(std::io::Error::from(std::io::ErrorKind::StorageFull).into());
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<(), BlackBoxError> {
        Ok(())
    }
}

/// The run stops, everything is kept, other black boxes lose nothing, and the run can continue.
#[test]
fn exact_a_failing_black_box_loses_nothing_else() {
    let plans = some_plans();
    let mut whole = simulation(&plans);
    let (_, expected) = run_recorded(&mut whole, 0.05);

    let mut simulation = simulation(&plans);
    let failing = simulation.attach(ms(10.0), Failing::default()).unwrap();
    let sound = simulation.attach(ms(2.0), MemoryBox::default()).unwrap();
    let report = simulation.run(0.05, &mut ()).unwrap();
    assert!(matches!(report.status, RunStatus::RecordingFailed { .. }));
    assert_eq!(report.time_s, 0.02);
    assert_eq!(simulation.detach::<Failing>(failing).unwrap().unwrap().0, 3);
    assert!(simulation.run(0.05, &mut ()).unwrap().status.is_completed());
    assert_eq!(
        simulation.detach::<MemoryBox>(sound).unwrap().unwrap().recording,
        expected
    );
}

/// A file is complete even if the simulation is dropped without a word.
#[test]
fn exact_dropping_a_simulation_completes_its_files() {
    let plans = some_plans();
    let csv = Shared::default();
    let mut simulation = simulation(&plans);
    simulation.attach(ms(2.0), CsvBox::new(csv.clone())).unwrap();
    simulation.run(0.05, &mut ()).unwrap();
    drop(simulation);
    assert_eq!(Recording::from_csv(&csv.bytes()[..]).unwrap().len(), 26);
}
