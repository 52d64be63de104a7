//! Figures 7.21 to 7.25, tables 7.5 and 7.7: six variables by line search, over the whole box and over a narrowed one.

use super::optimisations::{Case, Effort};
use super::solution_table::{ENDED, table};
use super::solutions::{NEVER_FALLS, PLOT, errors, minima, trajectories};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make};

const NOT_WORSE: Claim = Claim::holds("no level's minimum is worse than with the arbitrary space");

/// Errors and cost, arbitrary space.
pub(super) const FIGURE_7_21: Item = Item {
    id: "7.21",
    title: "Errors and cost of each level's six-variable solution, arbitrary search space",
    description: "Errors over their limits and the cost, while each level flies the crossing in 20 s that the line search found for it from [5, 0, −5, 0, −3, −3] \
                  over the whole box. Variables are position and velocity along north, and *z*, at both ends. All solutions lie on the bound *z*_{0} = *z*_{f} = −1 m: a lower flight is \
                  nearer and less oblique to a station on the ground, and the bound, a height of 1 m, is the safety height. They start at |*x*_{0}| < 0.88 m, within the 10° about west that the \
                  pan axis doesn't reach, so the beam starts beside the receiver's centre: the spike of (c) and (d) at *t* = 0.",
    make: Make::Draw(|context| errors(context, Case::SixArbitrary)),
    ..PLOT
};

/// Trajectories, arbitrary space.
pub(super) const FIGURE_7_22: Item = Item {
    id: "7.22",
    title: "Near-optimal trajectories of each level, six variables, arbitrary search space",
    description: "The crossings of figure 7.21 in space and from above, with the station and its beam at six instants. Heights end on their bound, 1 m.",
    make: Make::Draw(|context| trajectories(context, Case::SixArbitrary)),
    ..PLOT
};

/// Errors and cost, narrowed space.
pub(super) const FIGURE_7_23: Item = Item {
    id: "7.23",
    title: "Errors and cost of each level's six-variable solution, narrowed search space",
    description: "As figure 7.21, with a box a quarter as wide about level 1's global minimum (table 7.6), from there. Again *z*_{0} = *z*_{f} = −1 m, the bound, \
                  and starts lie in the 10° about west that the pan axis doesn't reach.",
    claims: &[NOT_WORSE],
    make: Make::Draw(narrowed_errors),
    ..PLOT
};

/// Trajectories, narrowed space.
pub(super) const FIGURE_7_24: Item = Item {
    id: "7.24",
    title: "Near-optimal trajectories of each level, six variables, narrowed search space",
    description: "The crossings of figure 7.23 in space and from above, with the station and its beam at six instants. Heights end on their bound, 1 m.",
    make: Make::Draw(|context| trajectories(context, Case::SixNarrowed)),
    ..PLOT
};

/// Minima and run time.
pub(super) const FIGURE_7_25: Item = Item {
    id: "7.25",
    title: "Least cost and run time per call of the cost, six variables",
    description: "The minima found in both boxes and the time that one call of the cost takes on one thread, per level. †: on a bound of the box, here \
                  the safety height, *z*_{0} = *z*_{f} = −1 m.",
    claims: &[NEVER_FALLS],
    make: Make::Draw(|context| {
        minima(
            context,
            &[
                ("arbitrary space", Case::SixArbitrary),
                ("narrowed space", Case::SixNarrowed),
            ],
        )
    }),
    ..PLOT
};

/// The searches, arbitrary space.
pub(super) const TABLE_7_5: Item = Item {
    id: "table-7.5",
    title: "Six-variable line search over an arbitrary space",
    description: "At each level for a crossing in 20 s: scans and golden sections along one variable after the other, over the whole box. †: on a bound of the box, \
                  here the safety height.",
    kind: Kind::Table,
    claims: &[ENDED],
    make: Make::Draw(|context| table(context, Case::SixArbitrary)),
    ..PLOT
};

/// The searches, narrowed space.
pub(super) const TABLE_7_7: Item = Item {
    id: "table-7.7",
    title: "Six-variable line search over a narrowed space",
    description: "As table 7.5, over a box a quarter as wide about level 1's global minimum (table 7.6), from there. †: on a bound of the box.",
    claims: &[ENDED, NOT_WORSE],
    make: Make::Draw(|context| judged(table(context, Case::SixNarrowed)?, context)),
    ..TABLE_7_5
};

fn narrowed_errors(context: &Context) -> Result<Drawing, ItemError> {
    judged(errors(context, Case::SixNarrowed)?, context)
}

/// Checks the claim that compares the two boxes. Searches end when a sweep gains less than their tolerance, so minima that differ by
/// less count as equal.
fn judged(drawing: Drawing, context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let (arbitrary, narrowed) = (
        Case::SixArbitrary.solved(effort)?,
        Case::SixNarrowed.solved(effort)?,
    );
    let gains: Vec<f64> = arbitrary
        .iter()
        .zip(narrowed)
        .map(|(a, n)| a.first().cost() - n.first().cost())
        .collect();
    let worst = gains.iter().copied().fold(f64::INFINITY, f64::min);
    let words: Vec<_> = gains.iter().map(|g| format!("{g:.4}")).collect();
    let tolerance = Case::SixNarrowed.gain(effort);
    Ok(drawing.check(
        NOT_WORSE,
        worst >= -tolerance,
        format!(
            "levels 1 to 5 gain {} of cost by narrowing; differences below {tolerance:.0e} count as none",
            words.join(", ")
        ),
    ))
}
