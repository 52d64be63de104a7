//! Readers of the libraries, called as the programs call them.

use super::Target;
use coverage::RoomFile;
use ets::Station;
use ets::station::NOMINAL_TOML;
use quad_dynamics::Vehicle;
use scenario::{End, Keep, Scenario, VEHICLES};
use sifre::black_box::{CsvBox, JsonLinesBox, ParquetBox};
use sifre::{BlackBox, Engine, Progress, Recording, SimulationSnapshot};
use std::ops::ControlFlow;
use sysid::measurement::{Column, Layout, read};

/// Scenarios that are short and have something of everything.
const SCENARIOS: [&str; 8] = [
    "hover",
    "gust",
    "two-quadrotors",
    "level-change",
    "track-fixed",
    "waypoints",
    "helix",
    "estimator-in-the-loop",
];

/// Reports of progress after which a flight is left.
const PATIENCE: u32 = 4;

/// Longest flight of a case, s.
const LONGEST_S: f64 = 0.02;

const STAND: [Column; 5] = [
    Column::commanded("duty", "1", 0.0, 1.0),
    Column::new("battery_voltage_v", "V", 0.1, 100.0),
    Column::new("thrust_n", "N", -50.0, 500.0),
    Column::new("torque_n_m", "N m", -10.0, 50.0),
    Column::new("speed_rad_s", "rad/s", 0.0, 1e4),
];

pub(super) fn all() -> Vec<Target> {
    let texts = |texts: Vec<&str>| texts.into_iter().map(|text| text.as_bytes().to_vec()).collect();
    let target = |name, seeds, read| Target {
        name,
        seeds,
        read,
        is_program: false,
    };
    let ready = SCENARIOS.into_iter().filter_map(scenario::ready).collect();
    vec![
        target("scenario", texts(ready), fly),
        target("vehicle", texts(VEHICLES.map(|(_, text)| text).to_vec()), vehicle),
        target("station", texts(vec![NOMINAL_TOML]), station),
        target("room", texts(vec![RoomFile::TEMPLATE]), room),
        target(
            "recording-csv",
            vec![recording(CsvBox::new(Vec::new()), CsvBox::into_inner)],
            csv,
        ),
        target(
            "recording-jsonl",
            vec![recording(JsonLinesBox::new(Vec::new()), JsonLinesBox::into_inner)],
            json_lines,
        ),
        target(
            "parquet",
            vec![recording(ParquetBox::new(Vec::new()), ParquetBox::into_inner)],
            parquet,
        ),
        target(
            "measurements",
            texts(vec![include_str!("../../../identify/template/thrust-stand.csv")]),
            measurements,
        ),
        target("checkpoint", vec![checkpoint()], resume),
    ]
}

/// The text of a file, if it is one.
fn text(file: &[u8]) -> Option<&str> {
    std::str::from_utf8(file).ok()
}

/// Leaves a flight after a while.
fn patience() -> impl FnMut(&Progress) -> ControlFlow<()> + Send {
    let mut left = PATIENCE;
    move |_: &Progress| {
        left -= 1;
        match left {
            0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }
}

/// Flies the beginning; a flight that ends well has finite metrics.
fn fly(file: &[u8]) -> Result<(), String> {
    let Some(Ok(mut scenario)) = text(file).map(|text| Scenario::from_toml_str(text, "case")) else {
        return Ok(());
    };
    scenario.duration_s = scenario.duration_s.min(LONGEST_S);
    let Ok(mut run) = scenario.build(&()).and_then(scenario::Built::start) else {
        return Ok(());
    };
    let Ok(flown) = run.fly(&Keep::METRICS, &mut patience()) else {
        return Ok(());
    };
    // An axis that does not settle has no settling time.
    let wrong = |m: &&scenario::Metric| !m.value.is_finite() && !m.name.ends_with("settling_time_s");
    match flown.metrics.iter().find(wrong) {
        Some(metric) if flown.ending.end == End::Done => Err(format!("{} = {}", metric.name, metric.value)),
        _ => Ok(()),
    }
}

fn vehicle(file: &[u8]) -> Result<(), String> {
    drop(text(file).map(|text| Vehicle::from_toml_str(text, "case")));
    Ok(())
}

fn station(file: &[u8]) -> Result<(), String> {
    drop(text(file).map(|text| Station::from_toml_str(text, "case")));
    Ok(())
}

/// A room that is accepted has cameras that can be placed.
fn room(file: &[u8]) -> Result<(), String> {
    if let Some(Ok(file)) = text(file).map(|text| RoomFile::from_toml_str(text, "fuzz"))
        && file.task().is_ok()
    {
        drop(file.wall_rig().map(|rig| rig.first_guess()));
    }
    Ok(())
}

/// A recorded flight of a tenth of a second.
fn recording<B: BlackBox>(black_box: B, into: fn(B) -> Result<Vec<u8>, sifre::BlackBoxError>) -> Vec<u8> {
    let mut run = started();
    let step = run.metrics_step();
    let id = run.simulation.attach(step, black_box);
    let bytes = id.ok().and_then(|id| {
        run.simulation.run(0.1, &mut ()).ok()?;
        run.simulation.detach::<B>(id)?.ok()
    });
    bytes
        .and_then(|black_box| into(black_box).ok())
        .unwrap_or_default()
}

/// A scenario with a filter, gusts apart, ready to fly.
fn started() -> scenario::Run {
    let text = scenario::ready("estimator-in-the-loop").unwrap_or_default();
    let scenario = Scenario::from_toml_str(text, "seed");
    let run = scenario
        .and_then(|scenario| scenario.build(&()))
        .and_then(scenario::Built::start);
    run.unwrap_or_else(|error| panic!("a ready scenario flies: {error}"))
}

fn sound(recording: &Recording) -> Result<(), String> {
    match recording.times_s().find(|time_s| !time_s.is_finite()) {
        Some(time_s) => Err(format!("a row at {time_s} s")),
        None => Ok(()),
    }
}

fn csv(file: &[u8]) -> Result<(), String> {
    Recording::recover_csv(file).map_or(Ok(()), |recovered| sound(&recovered.recording))
}

fn json_lines(file: &[u8]) -> Result<(), String> {
    Recording::recover_json_lines(file).map_or(Ok(()), |recovered| sound(&recovered.recording))
}

fn parquet(file: &[u8]) -> Result<(), String> {
    let file = bytes::Bytes::copy_from_slice(file);
    Recording::recover_parquet(file).map_or(Ok(()), |recovered| sound(&recovered.recording))
}

/// What is read is within the columns' ranges.
fn measurements(file: &[u8]) -> Result<(), String> {
    let Ok(table) = read(file, &Layout::table(&STAND)) else {
        return Ok(());
    };
    for (k, column) in STAND.iter().enumerate() {
        let range = column.minimum..=column.maximum;
        if let Some(value) = table.column(k).iter().find(|value| !range.contains(value)) {
            return Err(format!("{} = {value}", column.name));
        }
    }
    Ok(())
}

/// A flight that was saved.
fn checkpoint() -> Vec<u8> {
    let mut run = started();
    let mut file = Vec::new();
    let saved = run
        .simulation
        .run(0.1, &mut ())
        .ok()
        .and_then(|_| run.simulation.save().ok());
    drop(saved.map(|saved| saved.write_json(&mut file)));
    file
}

/// A state that is taken up can be flown on with.
fn resume(file: &[u8]) -> Result<(), String> {
    let Ok(snapshot) = SimulationSnapshot::read_json(file) else {
        return Ok(());
    };
    let text = scenario::ready("estimator-in-the-loop").unwrap_or_default();
    let built = Scenario::from_toml_str(text, "seed").and_then(|scenario| scenario.build(&()));
    if let Ok(built) = built
        && let Ok(mut engine) = Engine::resume(built.members, &snapshot)
    {
        let end_s = engine.now_s() + LONGEST_S;
        drop(engine.run(end_s, &mut patience()));
    }
    Ok(())
}
