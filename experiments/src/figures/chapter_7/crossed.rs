//! Figures 7.26 and 7.27: the solution of one level flown at the others.

use super::optimisations::{Case, Effort};
use super::solutions::{Flown, SEARCHED, every, over_time, path_data, paths};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::panel::Cells;
use crate::plot::style::{ORANGE, mix};
use crate::plot::{Figure, Panel};
use quad_dynamics::Level;
use rayon::prelude::*;

/// The matrix.
pub(super) const FIGURE_7_26: Item = Item {
    id: "7.26",
    title: "Each level's solution flown at every level",
    description: "The six-variable solutions of figure 7.23, all on the bound *z*_{0} = *z*_{f} = −1 m. (a) The cost *Φ* of the solution of one level (row) flown at another \
                  (column). (b) How much higher the cost is there than for the column's own solution, in thousandths. Shades of both are the numbers of (b), white at zero.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[OWN_IS_BEST],
    make: Make::Draw(matrix),
};

/// Level 1's optimum.
pub(super) const FIGURE_7_27: Item = Item {
    id: "7.27",
    title: "Level 1's optimum flown at every level",
    description: "The six-variable solution of level 1 (figure 7.23) flown by all levels: its cost rate and how far each is from where level 1 is at the same time; \
                  the crossing in space and from above. It flies on the bound, 1 m high, and starts within the 10° about west that the pan axis doesn't reach (0.88 m at \
                  *y* = −5 m): the spike of (c) at *t* = 0.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[RISES],
    make: Make::Draw(draw),
};

/// The solutions that are flown.
const CASE: Case = Case::SixNarrowed;

const OWN_IS_BEST: Claim = Claim::holds("at every level its own solution costs least of the five");
const RISES: Claim = Claim::does_not_hold(
    "the cost rises with the distance between levels",
    "levels 2 to 4 follow the path as level 1 does, to centimetres, and level 5, whose rotors and battery give less thrust \
     than c3's inversion assumes, sinks below the path by up to a quarter of a metre: lower, and so nearer and less oblique to the beam, which the cost counts as a gain",
);

/// Costs of all solutions at all levels: rows are solutions.
fn costs(effort: Effort) -> Result<Vec<Vec<f64>>, ItemError> {
    let solved = CASE.solved(effort)?;
    solved
        .par_iter()
        .map(|solution| {
            let at = |level: &super::optimisations::Solved| -> Result<f64, ItemError> {
                Ok(level.problem.evaluate(solution.first().best())?.cost)
            };
            solved.iter().map(at).collect()
        })
        .collect()
}

/// White for the least value to orange for the greatest, so that numbers stay legible.
fn shaded(values: &[Vec<f64>]) -> Vec<Vec<String>> {
    let all = || values.iter().flatten().copied();
    let (low, high) = (
        all().fold(f64::INFINITY, f64::min),
        all().fold(f64::NEG_INFINITY, f64::max),
    );
    let shade = |value: &f64| mix("#ffffff", ORANGE, (value - low) / (high - low));
    values.iter().map(|row| row.iter().map(shade).collect()).collect()
}

/// A matrix with its numbers and the values that shade it, the first row at the bottom.
fn grid(caption: &str, values: &[Vec<f64>], shades: &[Vec<f64>], digits: i32) -> Panel {
    let edges: Vec<f64> = (0..=values.len()).map(|k| k as f64 + 0.5).collect();
    let mut panel = Panel::new("Flown at level", "Solution of level")
        .caption(caption)
        .x_categories(Level::ALL.map(|l| l.number().to_string()))
        .equal_aspect()
        .cells(Cells {
            x: edges.clone(),
            y: edges,
            fills: shaded(shades),
        })
        .x_range(0.5, 5.5)
        .y_range(0.5, 5.5)
        .y_step(1.0);
    for (row, values) in values.iter().enumerate() {
        for (column, value) in values.iter().enumerate() {
            // No minus before what rounds to zero.
            let scale = 10_f64.powi(digits);
            let value = (value * scale).round() / scale + 0.0;
            let places = digits.unsigned_abs() as usize;
            panel = panel.annotate(column as f64 + 1.0, row as f64 + 0.9, format!("{value:.places$}"));
        }
    }
    panel
}

fn matrix(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let costs = costs(effort)?;
    let own: Vec<f64> = (0..costs.len()).map(|k| costs[k][k]).collect();
    let dearer: Vec<Vec<f64>> = costs
        .iter()
        .map(|row| {
            row.iter()
                .zip(&own)
                .map(|(cost, own)| 1e3 * (cost / own - 1.0))
                .collect()
        })
        .collect();
    let figure = Figure::columns(2)
        .legends(Legends::None)
        .panel_size(300.0, 300.0)
        .panel(grid("cost *Φ*", &costs, &dearer, 4))
        .panel(grid(
            "excess over the level's own solution, 10^{−3}",
            &dearer,
            &dearer,
            2,
        ));
    let mut data = DataTable::new(["solution_of", "flown_at", "cost", "excess"]);
    for (i, row) in costs.iter().enumerate() {
        for (j, &cost) in row.iter().enumerate() {
            data.push([
                (i + 1).into(),
                (j + 1).into(),
                cost.into(),
                (1e-3 * dearer[i][j]).into(),
            ]);
        }
    }
    let (least, most) = dearer
        .iter()
        .flatten()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &e| {
            (f64::min(low, e), f64::max(high, e))
        });
    // What a search of this tolerance may miss, in thousandths of a cost of about 1.
    let tolerance = 1e3 * CASE.gain(effort);
    Ok(Drawing::picture(figure.draw())
        .data(data.with_tolerance(SEARCHED))
        .settings(&CASE.settings(effort)?)?
        .check(
            OWN_IS_BEST,
            least >= -tolerance,
            format!("the excess lies between {least:.2} and {most:.2} thousandths; −{tolerance:.2} would be within the searches' tolerance"),
        ))
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let solved = CASE.solved(effort)?;
    let optimum = solved[0].first().best();
    let fly = |level: &super::optimisations::Solved| -> Result<Flown, ItemError> {
        Ok(Flown {
            level: level.problem.level(),
            histories: level.problem.histories(optimum, every(&level.problem))?,
        })
    };
    let flown: Vec<Flown> = solved.par_iter().map(fly).collect::<Result<_, _>>()?;
    let costs: Vec<f64> = flown.iter().map(|f| f.histories.outcome.cost).collect();
    let rises = costs.windows(2).all(|pair| pair[1] >= pair[0]);
    let station = solved[0].problem.mission().station.pedestal.origin();
    let figure = paths(&flown, station.into())
        .panel(over_time("Cost rate d(*T Φ*)/d*t*", &flown, |h| h.cost).caption("cost"))
        .panel(apart(&flown));
    let words: Vec<_> = costs.iter().map(|c| format!("{c:.4}")).collect();
    let mut data = path_data(&flown);
    data.columns.push("cost_rate".into());
    let rates = flown.iter().flat_map(|f| &f.histories.instants).map(|h| h.cost);
    for (row, rate) in data.rows.iter_mut().zip(rates) {
        row.push(rate.into());
    }
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .settings(&CASE.settings(effort)?)?
        .check(
            RISES,
            rises,
            format!(
                "*Φ* = {} at levels 1 to 5; level 5 ends {:.2} m below level 1",
                words.join(", "),
                sunk(&flown)
            ),
        ))
}

/// How far the last level ends below the first, m.
fn sunk(flown: &[Flown]) -> f64 {
    let depth = |flight: Option<&Flown>| {
        let last = flight.and_then(|f| f.histories.instants.last());
        last.map_or(f64::NAN, |h| h.position_m[2])
    };
    depth(flown.last()) - depth(flown.first())
}

/// Distance of each level from level 1 at the same time.
fn apart(flown: &[Flown]) -> Panel {
    let panel = Panel::new("Time *t*, s", "Distance from level 1, mm").caption("distance");
    flown.iter().skip(1).fold(panel, |panel, flight| {
        let level = flight.level.number();
        let pairs = flown[0].histories.instants.iter().zip(&flight.histories.instants);
        let points = pairs.map(|(one, other)| {
            let square = |k: usize| (one.position_m[k] - other.position_m[k]).powi(2);
            (one.time_s, 1e3 * (0..3).map(square).sum::<f64>().sqrt())
        });
        panel.line(
            crate::plot::level_name(level),
            crate::plot::level_style(level),
            points,
        )
    })
}
