//! Figures 7.16 to 7.20, tables 7.3 and 7.4: four variables, position and velocity along north at both ends.

use super::optimisations::Case;
use super::solution_table::{ENDED, table};
use super::solutions::{NEVER_FALLS, PLOT, errors, minima, trajectories};
use crate::item::{Item, Kind, Make};

/// Errors and cost, from rest.
pub(super) const FIGURE_7_16: Item = Item {
    id: "7.16",
    title: "Errors and cost of each level's four-variable solution from *X*_{0} = [5, 0, −5, 0]",
    description: "Errors over their limits and the cost, while each level flies the crossing in 20 s that the simplex found for it. Variables are position \
                  and velocity along north at both ends, in m and m s^{−1}. The pan axis stops 10° short of west: at \
                  |*x*_{0}| < 0.88 m, as levels 1 and 4 start, the beam begins beside the receiver's centre, the spike of (c) and (d) at *t* = 0. The lower one of the \
                  others is the tracker, at rest, catching up with a vehicle that moves.",
    make: Make::Draw(|context| errors(context, Case::Four)),
    ..PLOT
};

/// Trajectories, from rest.
pub(super) const FIGURE_7_17: Item = Item {
    id: "7.17",
    title: "Near-optimal trajectories of each level, four variables from *X*_{0} = [5, 0, −5, 0]",
    description: "The crossings of figure 7.16 in space and from above, with the station and its beam at six instants.",
    make: Make::Draw(|context| trajectories(context, Case::Four)),
    ..PLOT
};

/// Errors and cost, from the other start.
pub(super) const FIGURE_7_18: Item = Item {
    id: "7.18",
    title: "Errors and cost of each level's four-variable solution from *X*_{0} = [5, −1.5, −8, 1.5]",
    description: "As figure 7.16 for the crossings that the simplex found from another start, which lies farther from the station and moves. \
                  Levels 1 to 3 end on the bound of the box, *x*_{0} = 10 m, beyond the range limit of 8 m and in a poorer minimum than figure 7.16's; their spike at the start is the \
                  tracker at rest catching up with a vehicle that moves. Level 5 starts at |*x*_{0}| < 0.88 m, out of the pan axis's reach as in figure 7.16.",
    make: Make::Draw(|context| errors(context, Case::FourMoving)),
    ..PLOT
};

/// Trajectories, from the other start.
pub(super) const FIGURE_7_19: Item = Item {
    id: "7.19",
    title: "Near-optimal trajectories of each level, four variables from *X*_{0} = [5, −1.5, −8, 1.5]",
    description: "The crossings of figure 7.18 in space and from above, with the station and its beam at six instants. Those of levels 1 to 3 start on the bound \
                  of the box, *x*_{0} = 10 m, beyond the range limit of 8 m.",
    make: Make::Draw(|context| trajectories(context, Case::FourMoving)),
    ..PLOT
};

/// Minima and run time.
pub(super) const FIGURE_7_20: Item = Item {
    id: "7.20",
    title: "Least cost and run time per call of the cost, four variables",
    description: "The minima found from both starts and the time that one call of the cost takes on one thread, per level. †: on a bound of the box, \
                  here *x*_{0} = 10 m, beyond the range limit of 8 m.",
    claims: &[NEVER_FALLS],
    make: Make::Draw(|context| {
        minima(
            context,
            &[
                ("from [5, 0, −5, 0]", Case::Four),
                ("from [5, −1.5, −8, 1.5]", Case::FourMoving),
            ],
        )
    }),
    ..PLOT
};

/// The searches, from rest.
pub(super) const TABLE_7_3: Item = Item {
    id: "table-7.3",
    title: "Four-variable optimisation from *X*_{0} = [5, 0, −5, 0]",
    description: "The simplex at each level for a crossing in 20 s, from a start at rest on opposite sides of the station.",
    kind: Kind::Table,
    claims: &[ENDED],
    make: Make::Draw(|context| table(context, Case::Four)),
    ..PLOT
};

/// The searches, from the other start.
pub(super) const TABLE_7_4: Item = Item {
    id: "table-7.4",
    title: "Four-variable optimisation from *X*_{0} = [5, −1.5, −8, 1.5]",
    description: "The simplex at each level for a crossing in 20 s, as table 7.3, from another start. †: on a bound of the box; there levels 1 to 3 \
                  start beyond the range limit of 8 m.",
    make: Make::Draw(|context| table(context, Case::FourMoving)),
    ..TABLE_7_3
};
