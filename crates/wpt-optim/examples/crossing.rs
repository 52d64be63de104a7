//! A crossing of the station's field at every level: what it costs ideally and flown, and where each level would go.
//!
//! `cargo run -p wpt-optim --example crossing`

use quad_dynamics::Level;
use wpt_optim::{Choice, Grid, Problem, ProblemError};

/// Seconds that the crossing takes.
const DURATION_S: f64 = 10.0;

fn main() -> Result<(), ProblemError> {
    let x = [5.0, 5.0];
    println!("[x_0, x_f] = {x:?} m in {DURATION_S} s");
    for level in Level::ALL {
        let problem = Problem::nominal(Choice::Two, DURATION_S, level)?;
        let (ideal, flown) = (problem.ideal(&x)?, problem.evaluate(&x)?);
        let downhill = problem.gradient(&x)?.gradient;
        println!(
            "{level}: ideal {:.4}, flown {:.4} (range {:.4}, incidence {:.4}, spot {:.4}), slope [{:.4}, {:.4}] /m",
            ideal.cost,
            flown.cost,
            flown.means.range,
            flown.means.incidence,
            flown.means.spot,
            downhill[0],
            downhill[1]
        );
    }
    let level = Level::One;
    let problem = Problem::nominal(Choice::Two, DURATION_S, level)?;
    let surface = problem.surface(Grid {
        columns: 17,
        rows: 17,
    })?;
    for minimum in surface.minima() {
        println!("{level}: a minimum of {:.4} near {:?}", minimum.cost, minimum.at);
    }
    Ok(())
}
