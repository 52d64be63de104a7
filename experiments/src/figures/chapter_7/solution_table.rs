//! A case as a table: every level's search from every start.

use super::optimisations::{Case, Effort, basin};
use super::solutions::SEARCHED;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, ItemError};
use optim::StopReason;
use wpt_optim::{Decision, Problem};

/// The claim of every such table.
pub(super) const ENDED: Claim =
    Claim::holds("every search ends by its own criterion within its budget, below the cost of its start");

/// A vector in brackets.
pub(super) fn vector(values: &[f64]) -> String {
    let values: Vec<_> = values.iter().map(|x| format!("{x:.3}")).collect();
    format!("[{}]", values.join(", ")).replace('-', "−")
}

/// Marks what lies on a bound of the box searched.
pub(super) const ON_BOUND: &str = "†";
/// What [`ON_BOUND`] means, for readers.
pub(super) const BOUND_NOTE: &str = "†: on a bound of the box searched, not in a free minimum.";
/// Distance from a bound, as a share of the box, within which a solution lies on it: searches stop at a hundred times as much.
const TOUCHING: f64 = 1e-6;

/// Whether a variable's value lies on a bound of its box.
fn touches(decision: &Decision, value: f64) -> bool {
    let near = |bound: f64| (value - bound).abs() <= TOUCHING * (decision.upper - decision.lower);
    near(decision.lower) || near(decision.upper)
}

/// The variables whose values lie on a bound of the box.
pub(super) fn on_bounds<'a>(problem: &'a Problem, x: &'a [f64]) -> impl Iterator<Item = &'a Decision> {
    let pairs = problem.decisions().iter().zip(x);
    pairs
        .filter(|(decision, value)| touches(decision, **value))
        .map(|(decision, _)| decision)
}

/// A solution in brackets, with what lies on a bound marked.
pub(super) fn marked(problem: &Problem, x: &[f64]) -> String {
    let mark = |(decision, &value): (&Decision, &f64)| {
        let mark = if touches(decision, value) { ON_BOUND } else { "" };
        format!("{value:.3}{mark}")
    };
    let values: Vec<_> = problem.decisions().iter().zip(x).map(mark).collect();
    format!("[{}]", values.join(", ")).replace('-', "−")
}

/// The searches of a case.
pub(super) fn table(context: &Context, case: Case) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let mut shown = DisplayTable::new([
        "Level",
        "Start *X*_{0}",
        "*Φ*(*X*_{0})",
        "Solution *X*",
        "Minimum *Φ*",
        "Passes",
        "Evaluations",
        "Time, s",
        "Ended",
    ]);
    let mut data = DataTable::new([
        "level",
        "start",
        "start_cost",
        "variable",
        "solution",
        "minimum",
        "passes",
        "evaluations",
        "time_s",
    ]);
    let (mut searches, mut ended, mut north) = (0_usize, 0_usize, 0_usize);
    for solved in case.solved(effort)? {
        let level = solved.problem.level().number();
        for (k, found) in solved.searches.iter().enumerate() {
            let report = &found.report;
            let side = basin(&solved.problem, found.best())?;
            searches += 1;
            north += usize::from(side == "north");
            let by_itself = matches!(
                report.stop,
                StopReason::Converged { .. } | StopReason::ScheduleDone
            );
            ended += usize::from(by_itself && found.cost() < found.start_cost);
            shown.push([
                level.to_string(),
                vector(&found.start),
                format!("{:.4}", found.start_cost),
                marked(&solved.problem, found.best()),
                format!("{:.4}", found.cost()),
                side.to_owned(),
                report.evaluations.to_string(),
                format!("{:.1}", report.elapsed.as_secs_f64()),
                report.stop.to_string(),
            ]);
            for (decision, &value) in solved.problem.decisions().iter().zip(found.best()) {
                data.push([
                    level.into(),
                    (k + 1).into(),
                    found.start_cost.into(),
                    decision.condition.key().into(),
                    value.into(),
                    found.cost().into(),
                    side.into(),
                    (report.evaluations as f64).into(),
                    report.elapsed.as_secs_f64().into(),
                ]);
            }
        }
    }
    Ok(Drawing::table(shown)
        .data(data.with_tolerance(SEARCHED).with_volatile("time_s"))
        .settings(&case.settings(effort)?)?
        .note(format!(
            "{north} of {searches} searches end in minima whose crossing passes north of the station, {} south of it.",
            searches - north
        ))
        .check(ENDED, ended == searches, format!("{ended} of {searches}"))
        .note("Positions in m, velocities in m s^{−1}. A start and the solution are the decision vectors; *passes* is the side of the station on which the vehicle crosses *y* = 0, which distinguishes the basins.")
        .note(BOUND_NOTE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quad_dynamics::Level;
    use wpt_optim::Choice;

    #[test]
    fn exact_what_lies_on_a_bound_is_marked() {
        let problem = Problem::nominal(Choice::Four, 20.0, Level::One).unwrap();
        // Bounds of ±10 m and ±2 m/s; a ten-thousandth of the box away is not on the bound.
        let x = [10.0, -2.0, 9.998, 0.5];
        assert_eq!(marked(&problem, &x), "[10.000†, −2.000†, 9.998, 0.500]");
        assert_eq!(on_bounds(&problem, &x).count(), 2);
    }
}
