//! Searches by simplex on Himmelblau's function.

use crate::item::ItemError;
use optim::test_functions::{HIMMELBLAU_MINIMA, himmelblau};
use optim::{Limits, NelderMead, Optimiser, Report, SimplexSettings, Variable, minimise};

/// Half the side of the box searched and drawn.
pub(super) const HALF: f64 = 6.0;

/// Corners of a simplex, closed.
pub(super) type Triangle = Vec<(f64, f64)>;

fn search(start: [f64; 2]) -> Result<NelderMead, ItemError> {
    let axis = |name: &str| Variable {
        name: name.into(),
        unit: "1".into(),
        lower: -HALF,
        upper: HALF,
    };
    let variables = vec![axis("x"), axis("y")];
    Ok(NelderMead::new(variables, &start, SimplexSettings::default())?)
}

/// A search to its end.
pub(super) fn solve(start: [f64; 2]) -> Result<Report, ItemError> {
    let limits = Limits::evaluations(1000);
    Ok(minimise(&mut search(start)?, himmelblau, limits)?)
}

/// Every simplex of a search, closed.
pub(super) fn simplices(start: [f64; 2]) -> Result<Vec<Triangle>, ItemError> {
    let mut search = search(start)?;
    let (mut triangles, mut drawn) = (Vec::new(), 0);
    while let Some(candidate) = search.ask() {
        let cost = himmelblau(&candidate.values);
        search.tell(&candidate, cost)?;
        let simplex = search.rule();
        if simplex.iterations() > drawn {
            drawn = simplex.iterations();
            let corners = simplex.vertices().iter().cycle().take(4);
            triangles.push(corners.map(|v| (v.values[0], v.values[1])).collect());
        }
    }
    Ok(triangles)
}

/// Distance of a search's end from the nearest of the known minima.
pub(super) fn distance(report: &Report) -> f64 {
    let x = &report.best.candidate.values;
    let from = |m: &[f64; 2]| (x[0] - m[0]).hypot(x[1] - m[1]);
    HIMMELBLAU_MINIMA.iter().map(from).fold(f64::INFINITY, f64::min)
}
