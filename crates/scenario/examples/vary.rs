//! Varies a key of a scenario by its path: how much does a gust matter at each level?
//!
//! `cargo run -p scenario --example vary`

use scenario::{MetricsBox, Scenario, set};
use std::error::Error;

const GUST: &str = r#"
    name = "gust"
    duration_s = 6.0

    [[quadrotor]]
    name = "alpha"
    level = 4
    reference = { kind = "hold", position_m = [0, 0, -2] }
    wind = { steps = [{ from_s = 1, velocity_m_s = [-6, 0, 0] }, { from_s = 2, velocity_m_s = [0, 0, 0] }] }
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let mut table: toml::Table = toml::from_str(GUST)?;
    println!("level  largest error, m");
    for level in [4, 5] {
        set(&mut table, "quadrotor.alpha.level", level)?;
        let mut flight = Scenario::from_table(&table, "gust")?.build(&())?.fly()?;
        let id = flight
            .simulation
            .attach(flight.metrics_step(), MetricsBox::default())?;
        flight.run(&mut ())?;
        let Some(metrics) = flight.simulation.detach::<MetricsBox>(id).transpose()? else {
            continue;
        };
        let metrics = metrics.metrics();
        let error = metrics
            .iter()
            .find(|metric| metric.name == "alpha.position_error_max_m");
        println!(
            "{level:5}  {:16.4}",
            error.map_or(f64::NAN, |metric| metric.value)
        );
    }
    Ok(())
}
