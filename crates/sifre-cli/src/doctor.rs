//! `sifre doctor`: does everything work here?

use crate::exit::{Exit, Failure};
use crate::new::known;
use crate::report;
use quad_dynamics::Vehicle;
use scenario::{Keep, Scenario, VEHICLES};
use serde_json::json;
use sifre::black_box::CsvBox;
use sifre::{ModelQuadrotor, Recording};
use std::error::Error;
use std::fs::File;

/// Level hover at level 3 in still air, half a second.
const HOVER: &str = r#"
    name = "hover"
    duration_s = 0.5
    [[quadrotor]]
    name = "alpha"
    level = 3
    reference = { kind = "hold", position_m = [0, 0, -1] }
"#;

/// Rounding of a hover of some hundred steps, relative to the duty.
const DUTY_TOLERANCE: f64 = 1e-9;

/// Whether something works, and what was seen.
#[derive(Debug)]
struct Check {
    what: &'static str,
    seen: Result<String, Box<dyn Error>>,
}

/// Checks everything.
pub(crate) fn run(json: bool) -> Result<Exit, Failure> {
    let checks = [
        Check {
            what: "vehicles and stations load",
            seen: files(),
        },
        Check {
            what: "ready scenarios can be built",
            seen: scenarios(),
        },
        Check {
            what: "hover duty is weight over thrust gain",
            seen: hover(),
        },
        Check {
            what: "recordings can be written and read",
            seen: recordings(),
        },
        Check {
            what: "threads",
            seen: Ok(rayon::current_num_threads().to_string()),
        },
    ];
    let sound = checks.iter().all(|check| check.seen.is_ok());
    if json {
        let entry = |check: &Check| match &check.seen {
            Ok(seen) => json!({ "check": check.what, "ok": true, "seen": seen }),
            Err(error) => json!({ "check": check.what, "ok": false, "seen": error.to_string() }),
        };
        report::print(&json!({ "sound": sound, "checks": checks.iter().map(entry).collect::<Vec<_>>() }))?;
    } else {
        for Check { what, seen } in &checks {
            match seen {
                Ok(seen) => report::say(format!("  ok    {what}: {seen}\n"))?,
                Err(error) => report::say(format!("  FAILS {what}: {error}\n"))?,
            }
        }
        report::say(if sound {
            "all checks passed\n"
        } else {
            "a check failed\n"
        })?;
    }
    Ok(if sound { Exit::Done } else { Exit::Early })
}

fn files() -> Result<String, Box<dyn Error>> {
    for (name, text) in VEHICLES {
        Vehicle::from_toml_str(text, name)?;
    }
    Ok(VEHICLES.map(|(name, _)| name).join(", "))
}

fn scenarios() -> Result<String, Box<dyn Error>> {
    for (name, text) in known() {
        Scenario::from_toml_str(text, name)?.build(&())?.start()?;
    }
    Ok(format!("{} of them", known().count()))
}

/// The engine agrees with `u = m g / (4 K_T)`, found without it.
fn hover() -> Result<String, Box<dyn Error>> {
    let mut run = Scenario::from_toml_str(HOVER, "hover")?.build(&())?.start()?;
    let flown = run.fly(&Keep::NOTHING, &mut ())?;
    let vehicle = Vehicle::qball_x4();
    let weight = vehicle.airframe.mass * vehicle.environment.gravity;
    let expected = weight / (4.0 * vehicle.linear_rotor.thrust_gain);
    let alpha: &ModelQuadrotor = run
        .simulation
        .agent("alpha")
        .ok_or("agent \"alpha\" is missing")?;
    let commands = alpha.input().commands;
    if commands
        .iter()
        .any(|duty| (duty / expected - 1.0).abs() > DUTY_TOLERANCE)
    {
        return Err(format!("duty must be {expected}, got {commands:?}").into());
    }
    let rate = flown.ending.report.time_s / flown.wall_s;
    Ok(format!(
        "{expected:.6}, flown {rate:.0} times faster than real time"
    ))
}

/// Writes a recording to the folder that temporary files go to, and reads it back.
fn recordings() -> Result<String, Box<dyn Error>> {
    let path = std::env::temp_dir().join(format!("sifre-doctor-{}.csv", std::process::id()));
    let write = || -> Result<usize, Box<dyn Error>> {
        let mut run = Scenario::from_toml_str(HOVER, "hover")?.build(&())?.start()?;
        let step = run.output.step_s;
        run.simulation
            .attach(step, CsvBox::new(File::create_new(&path)?))?;
        run.fly(&Keep::NOTHING, &mut ())?;
        run.simulation.finish_recordings()?;
        Ok(Recording::from_csv(File::open(&path)?)?.len())
    };
    let rows = write();
    // Whatever became of it, nothing is left behind.
    let _ = std::fs::remove_file(&path);
    match rows? {
        // Every 20 ms from 0 to 0.5 s.
        26 => Ok(format!("26 rows in {}", std::env::temp_dir().display())),
        other => Err(format!("expected 26 rows, got {other}").into()),
    }
}
