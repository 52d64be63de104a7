//! Varies a key of a scenario by its path: how much does a gust matter at each level?
//!
//! `cargo run -p scenario --example vary`

use scenario::{Keep, Setting, Template};
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
    let gust = Template::from_toml_str(GUST, "gust")?;
    println!("level  largest error, m");
    for level in [4, 5] {
        let scenario = gust.with(&[Setting::new("quadrotor.alpha.level", level)])?;
        let flown = scenario.fly(&(), &Keep::METRICS)?;
        println!("{level:5}  {:16.4}", flown.metric("position_error_max_m")?);
    }
    Ok(())
}
