//! Figures 7.8 to 7.13, tables 7.1 and 7.2: two variables, from rest to rest.

use super::optimisations::Case;
use super::solution_table::{ENDED, table};
use super::solutions::{NEVER_FALLS, PLOT, errors, minima, trajectories};
use crate::item::{Item, Kind, Make};

/// Errors and cost, 10 s.
pub(super) const FIGURE_7_8: Item = Item {
    id: "7.8",
    title: "Errors and cost of each level's two-variable solution, 10 s",
    description: "Errors of range, incidence and spot, each over its limit (8 m, 40°, 0.15 m), and the cost they add up to, while each level flies the \
                  crossing that the simplex found for it from [5, 5] m; variables are the north coordinates at both ends.",
    make: Make::Draw(|context| errors(context, Case::TwoIn10)),
    ..PLOT
};

/// Trajectories, 10 s.
pub(super) const FIGURE_7_9: Item = Item {
    id: "7.9",
    title: "Near-optimal trajectories of each level, two variables, 10 s",
    description: "The crossings of figure 7.8 in space and from above, with the station and its beam at six instants.",
    make: Make::Draw(|context| trajectories(context, Case::TwoIn10)),
    ..PLOT
};

/// Minima and run time, 10 s.
pub(super) const FIGURE_7_10: Item = Item {
    id: "7.10",
    title: "Least cost and run time per call of the cost, two variables, 10 s",
    description: "The minima of figure 7.8 and the time that one call of the cost takes on one thread, per level.",
    claims: &[NEVER_FALLS],
    make: Make::Draw(|context| minima(context, &[("10 s", Case::TwoIn10)])),
    ..PLOT
};

/// Errors and cost, 20 s.
pub(super) const FIGURE_7_11: Item = Item {
    id: "7.11",
    title: "Errors and cost of each level's two-variable solution, 20 s",
    description: "As figure 7.8 for a crossing in 20 s: errors over their limits and the cost they add up to, while each level flies its solution from [5, 5] m.",
    make: Make::Draw(|context| errors(context, Case::TwoIn20)),
    ..PLOT
};

/// Trajectories, 20 s.
pub(super) const FIGURE_7_12: Item = Item {
    id: "7.12",
    title: "Near-optimal trajectories of each level, two variables, 20 s",
    description: "The crossings of figure 7.11 in space and from above, with the station and its beam at six instants.",
    make: Make::Draw(|context| trajectories(context, Case::TwoIn20)),
    ..PLOT
};

/// Minima and run time, 20 s.
pub(super) const FIGURE_7_13: Item = Item {
    id: "7.13",
    title: "Least cost and run time per call of the cost, two variables, 20 s",
    description: "The minima of figure 7.11 and the processor time that one call of the cost takes on one thread, per level.",
    claims: &[NEVER_FALLS],
    make: Make::Draw(|context| minima(context, &[("20 s", Case::TwoIn20)])),
    ..PLOT
};

/// The searches, 10 s.
pub(super) const TABLE_7_1: Item = Item {
    id: "table-7.1",
    title: "Two-variable optimisation of a crossing in 10 s",
    description: "The simplex at each level from three starts: the study's [5, 5] m first, then its mirror image and a start at opposite sides, which show \
                  further minima.",
    kind: Kind::Table,
    claims: &[ENDED],
    make: Make::Draw(|context| table(context, Case::TwoIn10)),
    ..PLOT
};

/// The searches, 20 s.
pub(super) const TABLE_7_2: Item = Item {
    id: "table-7.2",
    title: "Two-variable optimisation of a crossing in 20 s",
    description: "The simplex at each level from the three starts of table 7.1, for a crossing in 20 s.",
    make: Make::Draw(|context| table(context, Case::TwoIn20)),
    ..TABLE_7_1
};
