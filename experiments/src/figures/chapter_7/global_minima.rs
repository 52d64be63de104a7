//! Table 7.6: bounds and global minima by simulated annealing at level 1.

use super::annealed::{Global, Minimum, minimum, settings};
use super::optimisations::{Effort, basin};
use super::solution_table::{BOUND_NOTE, marked, vector};
use super::solutions::SEARCHED;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use std::thread;

/// The table.
pub(super) const TABLE_7_6: Item = Item {
    id: "table-7.6",
    title: "Bounds and global minima of level 1 by simulated annealing",
    description: "Simulated annealing over the box of each problem, then a simplex from where it ended, which annealing alone reaches only slowly; the best of three walks \
                  with seeds of their own. Beside it the \
                  least minimum that any local search of level 1 found in the same problem.",
    kind: Kind::Table,
    origin: Origin::Simulated,
    claims: &[NOT_WORSE],
    make: Make::Draw(draw),
};

const NOT_WORSE: Claim = Claim::holds("not worse than the local minima found from any start");

/// Least local minimum of level 1 in a problem.
fn least_local(global: Global, effort: Effort) -> Result<f64, ItemError> {
    let mut least = f64::INFINITY;
    for case in global.local() {
        let costs = case.solved(effort)?[0].searches.iter().map(|found| found.cost());
        least = costs.fold(least, f64::min);
    }
    Ok(least)
}

/// Walks run side by side.
fn minima(effort: Effort) -> Result<Vec<&'static Minimum>, ItemError> {
    thread::scope(|scope| {
        let walks = Global::ALL.map(|global| scope.spawn(move || minimum(global, effort)));
        let join = |walk: thread::ScopedJoinHandle<'_, _>| {
            walk.join()
                .unwrap_or_else(|_| Err(ItemError::new("an annealing panicked")))
        };
        walks.into_iter().map(join).collect()
    })
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let minima = minima(effort)?;
    let tolerance = settings(effort).simplex.cost_spread;
    let mut shown = DisplayTable::new([
        "Variables",
        "Lower bounds",
        "Upper bounds",
        "Solution *X*",
        "Minimum *Φ*",
        "Passes",
        "Least local minimum",
        "Walks ended at",
        "Evaluations of all",
        "Time, s",
        "Walk ended",
        "Simplex ended",
    ]);
    let mut data = DataTable::new([
        "problem",
        "variable",
        "lower",
        "upper",
        "solution",
        "minimum",
        "annealed",
        "least_local",
        "evaluations",
        "time_s",
    ]);
    let (mut worst, mut words) = (f64::NEG_INFINITY, Vec::new());
    for (global, found) in Global::ALL.into_iter().zip(minima) {
        let problem = global.problem(effort)?;
        let local = least_local(global, effort)?;
        worst = worst.max(found.cost() - local);
        words.push(format!("{:+.1e} ({})", found.cost() - local, global.name()));
        let (walk, polish) = (&found.walk.report, &found.polish);
        let (time, evaluations) = (found.all.time_s, found.all.evaluations);
        let ends: Vec<_> = found.all.costs.iter().map(|c| format!("{c:.5}")).collect();
        let side = basin(&problem, found.best())?;
        let bounds = |pick: fn(&wpt_optim::Decision) -> f64| {
            vector(&problem.decisions().iter().map(pick).collect::<Vec<_>>())
        };
        shown.push([
            global.name().to_owned(),
            bounds(|d| d.lower),
            bounds(|d| d.upper),
            marked(&problem, found.best()),
            format!("{:.5}", found.cost()),
            side.to_owned(),
            format!("{local:.5}"),
            ends.join(", "),
            evaluations.to_string(),
            format!("{time:.1}"),
            walk.stop.to_string(),
            polish.stop.to_string(),
        ]);
        for (decision, &value) in problem.decisions().iter().zip(found.best()) {
            data.push([
                global.name().into(),
                decision.condition.key().into(),
                decision.lower.into(),
                decision.upper.into(),
                value.into(),
                found.cost().into(),
                found.walk.cost().into(),
                local.into(),
                (evaluations as f64).into(),
                time.into(),
            ]);
        }
    }
    Ok(Drawing::table(shown)
        .note(BOUND_NOTE)
        .data(data.with_tolerance(SEARCHED).with_volatile("time_s"))
        .settings(&settings(effort))?
        .check(
            NOT_WORSE,
            worst <= tolerance,
            format!(
                "above the least local minimum by {}; {tolerance:.0e} count as none",
                words.join(", ")
            ),
        ))
}
