//! Pictures of the solutions of a case: errors and cost, trajectories, minima and run times.

use super::optimisations::{Case, Effort, Solved, basin};
use super::run_time::{MARGIN, least_times, never_falls};
use super::solution_table::{BOUND_NOTE, ON_BOUND, on_bounds, vector};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::panel;
use crate::plot::space::View;
use crate::plot::style::{GREY, INK, Look, Marker};
use crate::plot::{Figure, Panel, Space, level_name, level_style};
use quad_dynamics::Level;
use std::num::NonZeroU64;
use wpt_optim::{Histories, History, Problem};

/// What the plots of solutions share.
pub(super) const PLOT: Item = Item {
    id: "",
    title: "",
    description: "",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[],
    make: Make::NotReproducible("a template"),
};

/// The run-time claim of the bar plots.
pub(super) const NEVER_FALLS: Claim = Claim::holds("run time does not fall with level");

/// Time between instants drawn, s.
const SAMPLE_S: f64 = 0.04;
/// Time between the beams drawn, as a share of the flight.
const BEAMS: usize = 5;

/// Least height of the picture, m.
const HEIGHT_M: f64 = 3.5;
/// Solutions whose variables all differ by less than this, in m and m/s, lie in one valley.
const VALLEY: f64 = 0.5;

/// A flight that is drawn.
pub(super) struct Flown {
    /// The level.
    pub(super) level: Level,
    /// Its instants.
    pub(super) histories: Histories,
}

/// How many of the station's steps lie between the instants drawn.
pub(super) fn every(problem: &Problem) -> NonZeroU64 {
    let steps = SAMPLE_S / problem.mission().station_step.seconds();
    NonZeroU64::new(steps.round() as u64).unwrap_or(NonZeroU64::MIN)
}

/// The flights of a case's solutions.
fn flown(case: Case, effort: Effort) -> Result<Vec<Flown>, ItemError> {
    let fly = |solved: &Solved| -> Result<Flown, ItemError> {
        let problem = &solved.problem;
        Ok(Flown {
            level: problem.level(),
            histories: problem.histories(solved.first().best(), every(problem))?,
        })
    };
    case.solved(effort)?.iter().map(fly).collect()
}

/// Whether a solution lies in the valley of level 1's, in words.
fn valley(x: &[f64], first: &[f64]) -> &'static str {
    let near = x.iter().zip(first).all(|(a, b)| (a - b).abs() < VALLEY);
    if near {
        ", in level 1's valley"
    } else {
        ", in another valley than level 1"
    }
}

/// Which variables of a solution lie on the bounds of the box, how far it flies beyond the range limit, and whether the pan axis is at
/// its stop at the start, in words.
fn excesses(problem: &Problem, x: &[f64]) -> Result<String, ItemError> {
    let mut words = String::new();
    let bound: Vec<_> = on_bounds(problem, x).map(|d| d.condition.key()).collect();
    if !bound.is_empty() {
        words += &format!(", on the bound of {}", bound.join(", ").replace('_', "\\_"));
    }
    let instants = problem.histories(x, every(problem))?.instants;
    let limit = problem.mission().station.limits.range;
    let farthest = instants.iter().map(|h| h.range_m / limit).fold(0.0, f64::max);
    if farthest > 1.0 {
        words += &format!(", at up to {farthest:.2} times the range limit");
    }
    let pan = &problem.mission().station.gimbal.pan;
    let turned = instants.first().map_or(0.0, |h| h.gimbal_rad[0]);
    if turned <= pan.minimum || turned >= pan.maximum {
        words += ", starting with the pan axis at its stop";
    }
    Ok(words)
}

/// What each level found, in words.
fn remarks(case: Case, effort: Effort) -> Result<Vec<String>, ItemError> {
    let first = case.solved(effort)?[0].first().best();
    let remark = |solved: &Solved| -> Result<String, ItemError> {
        let (problem, found) = (&solved.problem, solved.first());
        Ok(format!(
            "Level {}: *Φ* = {:.4} at {}, passing {} of the station{}{}; {} evaluations, {:.1} s; {}.",
            problem.level().number(),
            found.cost(),
            vector(found.best()),
            basin(problem, found.best())?,
            valley(found.best(), first),
            excesses(problem, found.best())?,
            found.report.evaluations,
            found.report.elapsed.as_secs_f64(),
            found.report.stop
        ))
    };
    case.solved(effort)?.iter().map(remark).collect()
}

fn noted(mut drawing: Drawing, case: Case, effort: Effort) -> Result<Drawing, ItemError> {
    for remark in remarks(case, effort)? {
        drawing = drawing.note(remark);
    }
    Ok(drawing.settings(&case.settings(effort)?)?)
}

/// A panel of one quantity over time, a line per level.
pub(super) fn over_time(label: &str, flown: &[Flown], quantity: impl Fn(&History) -> f64) -> Panel {
    flown
        .iter()
        .fold(Panel::new("Time *t*, s", label), |panel, flight| {
            let level = flight.level.number();
            let points = flight.histories.instants.iter().map(|h| (h.time_s, quantity(h)));
            panel.line(level_name(level), level_style(level), points)
        })
}

/// The errors and the cost of each level's solution over time.
pub(super) fn errors(context: &Context, case: Case) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let flown = flown(case, effort)?;
    let solved = case.solved(effort)?;
    let limits = &solved[0].problem.mission().station.limits;
    let spot = |h: &History| h.spot_m[0].hypot(h.spot_m[1]) / limits.spot;
    let figure = Figure::columns(2)
        .panel(over_time("Range error *e*_{R}", &flown, |h| {
            h.range_m / limits.range
        }))
        .panel(over_time("Incidence error *e*_{α}", &flown, |h| {
            h.incidence_rad / limits.incidence
        }))
        .panel(over_time("Spot error *e*_{s}", &flown, spot))
        .panel(over_time("Cost rate d(*T Φ*)/d*t*", &flown, |h| h.cost))
        .share_x();
    let mut data = DataTable::new(["level", "t_s", "e_range", "e_incidence", "e_spot", "cost_rate"]);
    for flight in &flown {
        for h in &flight.histories.instants {
            data.push([
                flight.level.number().into(),
                h.time_s.into(),
                (h.range_m / limits.range).into(),
                (h.incidence_rad / limits.incidence).into(),
                spot(h).into(),
                h.cost.into(),
            ]);
        }
    }
    noted(
        Drawing::picture(figure.draw()).data(data.with_tolerance(SEARCHED)),
        case,
        effort,
    )
}

/// Tolerance of what follows from a search that stops at 1e-4 of its box: the last bits of another platform's sine may turn one of its
/// decisions, and the answer then differs by as much.
pub(super) const SEARCHED: f64 = 1e-3;

/// North, west, up: right-handed, as the eye expects of a box.
fn pictured(p: &[f64; 3]) -> [f64; 3] {
    [p[0], -p[1], -p[2]]
}

/// The flights in space and from above, with the station and its beam.
pub(super) fn paths(flown: &[Flown], station: [f64; 3]) -> Figure {
    let thin = Look::solid(GREY, 0.7);
    // Starts of levels lie within a hand's breadth of each other: one small mark for all of them, so that none hides another.
    let begin = Look::solid(INK, 1.0).marked(Marker::Dot);
    let mut space = Space::new("north *x*, m", "west −*y*, m", "height, m")
        .equal_aspect()
        .view(View {
            azimuth_deg: -35.0,
            elevation_deg: 26.0,
        });
    let mut plan = Panel::new("East *y*, m", "North *x*, m").equal_aspect();
    let heights = flown
        .iter()
        .flat_map(|f| &f.histories.instants)
        .map(|h| -h.position_m[2]);
    // Down to the ground, and high enough for the ticks to stand apart.
    space = space.range(2, 0.0, heights.fold(HEIGHT_M, f64::max));
    if let Some(flight) = flown.last() {
        let instants = &flight.histories.instants;
        for k in 0..=BEAMS {
            let p = instants[k * (instants.len() - 1) / BEAMS].position_m;
            let label = if k == 0 { "beam at level 5" } else { "" };
            space = space.line(label, thin, [pictured(&station), pictured(&p)]);
            plan = plan.line(label, thin, [(station[1], station[0]), (p[1], p[0])]);
        }
    }
    for flight in flown {
        let (level, instants) = (flight.level.number(), &flight.histories.instants);
        let (name, look) = (level_name(level), level_style(level));
        space = space.line(
            name.clone(),
            look,
            instants.iter().map(|h| pictured(&h.position_m)),
        );
        plan = plan.line(
            name,
            look,
            instants.iter().map(|h| (h.position_m[1], h.position_m[0])),
        );
    }
    let starts: Vec<[f64; 3]> = flown
        .iter()
        .filter_map(|flight| flight.histories.instants.first().map(|h| h.position_m))
        .collect();
    space = space.markers("start", begin, starts.iter().map(pictured));
    plan = plan.markers("start", begin, starts.iter().map(|p| (p[1], p[0])));
    let mark = Look::solid(INK, 1.0).marked(Marker::Square);
    space = space.markers("station", mark, [pictured(&station)]);
    plan = plan.markers("station", mark, [(station[1], station[0])]);
    Figure::columns(2)
        .panel_size(360.0, 270.0)
        .panel(space.caption("in space; grey: projection on the ground"))
        .panel(plan.caption("from above"))
}

/// Positions as data.
pub(super) fn path_data(flown: &[Flown]) -> DataTable {
    let mut data = DataTable::new(["level", "t_s", "x_m", "y_m", "z_m"]);
    for flight in flown {
        for h in &flight.histories.instants {
            let [x, y, z] = h.position_m.map(Into::into);
            data.push([flight.level.number().into(), h.time_s.into(), x, y, z]);
        }
    }
    data.with_tolerance(SEARCHED)
}

/// The trajectories of each level's solution.
pub(super) fn trajectories(context: &Context, case: Case) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let flown = flown(case, effort)?;
    let station = case.solved(effort)?[0]
        .problem
        .mission()
        .station
        .pedestal
        .origin();
    let figure = paths(&flown, station.into());
    noted(
        Drawing::picture(figure.draw()).data(path_data(&flown)),
        case,
        effort,
    )
}

/// A bar of a level.
struct Bar {
    height: f64,
    /// The words above it.
    words: String,
}

/// A bar per level, in the level's colour, with its words above, on an axis for bars up to `top`.
fn bars(label: &str, bars: &[Bar], top: f64) -> Panel {
    let coloured = Level::ALL.iter().zip(bars).map(|(level, bar)| panel::Bar {
        x: f64::from(level.number()),
        height: bar.height,
        colour: level_style(level.number()).colour,
    });
    let panel = Panel::new("Level", label)
        .x_categories(Level::ALL.map(|l| l.number().to_string()))
        .bars("", 0.65, coloured)
        .x_range(0.4, 5.6)
        .y_range(0.0, 1.15 * top);
    bars.iter().enumerate().fold(panel, |panel, (i, bar)| {
        panel.annotate(i as f64 + 1.0, bar.height, bar.words.clone())
    })
}

/// The bar of a minimum, marked if it lies on a bound of its box.
fn minimum_bar(solved: &Solved) -> Bar {
    let found = solved.first();
    let mark = on_bounds(&solved.problem, found.best())
        .next()
        .map_or("", |_| ON_BOUND);
    Bar {
        height: found.cost(),
        words: format!("{:.3}{mark}", found.cost()),
    }
}

/// Minima of some cases and the run time per call of the cost, per level.
pub(super) fn minima(context: &Context, cases: &[(&'static str, Case)]) -> Result<Drawing, ItemError> {
    let effort = Effort::of(context.quick);
    let timed = cases[cases.len() - 1].1;
    let times = least_times(timed, effort)?;
    let mut figure = Figure::columns(cases.len() + 1)
        .legends(Legends::None)
        .panel_size(230.0, 190.0);
    let mut data =
        DataTable::new(["case", "level", "minimum", "evaluations", "call_s"]).with_tolerance(SEARCHED);
    let mut minima = Vec::new();
    for (name, case) in cases {
        let bars: Vec<Bar> = case.solved(effort)?.iter().map(minimum_bar).collect();
        minima.push((name, bars));
    }
    // One scale for all cases.
    let heights = minima.iter().flat_map(|(_, bars)| bars).map(|bar| bar.height);
    let top = heights.fold(0.0, f64::max);
    for (name, minima) in &minima {
        figure = figure.panel(bars("Least cost *Φ*", minima, top).caption(format!("least cost, {name}")));
    }
    for (name, case) in cases {
        let solved = case.solved(effort)?;
        for (solved, &time) in solved.iter().zip(&times) {
            let found = solved.first();
            let evaluations = found.report.evaluations as f64;
            let level = solved.problem.level().number();
            data.push([
                (*name).into(),
                level.into(),
                found.cost().into(),
                evaluations.into(),
                time.into(),
            ]);
        }
    }
    let milliseconds: Vec<f64> = times.iter().map(|t| 1e3 * t).collect();
    let run_times: Vec<Bar> = milliseconds
        .iter()
        .map(|&height| Bar {
            height,
            words: format!("{height:.1}"),
        })
        .collect();
    let slowest = milliseconds.iter().copied().fold(0.0, f64::max);
    figure = figure.panel(bars("Run time per cost call, ms", &run_times, slowest).caption("run time"));
    let measured = milliseconds
        .iter()
        .map(|t| format!("{t:.2}"))
        .collect::<Vec<_>>()
        .join(", ");
    let drawing = Drawing::picture(figure.draw())
        .data(data.with_volatile("call_s"))
        .check(
            NEVER_FALLS,
            never_falls(&times),
            format!("{measured} ms for levels 1 to 5, the least of repeated calls; a fall of up to {:.0} % would count as none", 1e2 * MARGIN),
        )
        .note(BOUND_NOTE)
        .note("Run times hold for this machine and build; each is the shortest of interleaved calls, repeated until no call is faster. Levels differ by what a derivative costs: steps and derivatives per flight are the same.");
    noted(drawing, timed, effort)
}
