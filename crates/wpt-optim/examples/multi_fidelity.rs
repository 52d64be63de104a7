//! Level 5 optimised with the help of levels 1 to 4: the nominal crossing in 10 s with two variables.
//!
//!     cargo run -p wpt-optim --example multi_fidelity
//!
//! Prints the optimum of each level on the way, and the flights of every level beside those of Nelder and Mead's simplex at level 5
//! alone. Figure beyond.4 does this from twenty starts.

use optim::multi_fidelity::{LevelCost, MultiFidelitySettings, multi_fidelity};
use optim::{Limits, NelderMead, SimplexSettings, minimise};
use quad_dynamics::Level;
use std::error::Error;
use std::ops::ControlFlow;
use wpt_optim::{Choice, Objective, Problem};

fn main() -> Result<(), Box<dyn Error>> {
    let at = |&level: &Level| Problem::nominal(Choice::Two, 10.0, level);
    let problems = Level::ALL.iter().map(at).collect::<Result<Vec<_>, _>>()?;
    let top = &problems[Level::ALL.len() - 1];
    let objectives: Vec<_> = problems.iter().map(Objective::new).collect();
    let costs: Vec<_> = objectives.iter().map(|o| move |x: &[f64]| o.cost(x)).collect();
    let costs: Vec<LevelCost> = costs.iter().map(|c| c as LevelCost).collect();

    // Two valleys are soon found.
    let settings = MultiFidelitySettings {
        generations: 10,
        searches: 0,
        ..MultiFidelitySettings::default()
    };
    let guided = multi_fidelity(top.variables(), &top.start(), &costs, &settings, &mut |_| {
        ControlFlow::Continue(())
    })?;
    for optimum in &guided.optima {
        let (level, x, cost) = (optimum.level, &optimum.values, optimum.cost);
        println!("level {level}: Phi = {cost:.5} at {x:.4?}; {}", optimum.stop);
    }

    // To 1e-4 of the box and 1e-6 of the cost.
    let modest = SimplexSettings {
        spread: 1e-4,
        cost_spread: 1e-6,
        ..SimplexSettings::default()
    };
    let mut simplex = NelderMead::new(top.variables(), &top.start(), modest)?;
    let alone = minimise(&mut simplex, costs[costs.len() - 1], Limits::evaluations(1000))?;
    println!("flights at levels 1 to 5: {:?}", guided.calls);
    println!(
        "level 5 alone: Phi = {:.5} with {} flights; {}",
        alone.best.cost, alone.evaluations, alone.stop
    );
    Ok(())
}
