//! Figure 7.7: the Nelder-Mead simplex on Himmelblau's function.

use super::himmelblau::{HALF, Triangle, distance, simplices, solve};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::sweep;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::panel::Contours;
use crate::plot::style::{BLUE, GREY, INK, Look, Marker, VERMILION};
use crate::plot::{Figure, Panel, series_style};
use optim::Report;
use optim::test_functions::{HIMMELBLAU_MINIMA, himmelblau};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.7",
    title: "Nelder-Mead simplex on Himmelblau's function",
    description: "(a) Contours of *f*(*x*, *y*) = (*x*² + *y* − 11)² + (*x* + *y*² − 7)² at 2, 10, 25, 50, 90, 140, 200, 350 and 600, and all simplices of one search. \
                  (b) Least cost so far of searches from four starts, one for each minimum.",
    kind: Kind::Plot,
    origin: Origin::Derived,
    claims: &[ENDS],
    make: Make::Draw(draw),
};

const ENDS: Claim = Claim::holds("ends in one of the four known minima (value 0)");

/// Start of the search whose simplices are drawn.
const START: [f64; 2] = [-1.0, -1.0];
/// Starts of the histories, in the order of the known minima.
const STARTS: [[f64; 2]; 4] = [[1.0, 1.0], START, [-4.0, -1.0], [2.0, -2.0]];
/// Values of the contours drawn.
const CONTOURS: [f64; 9] = [2.0, 10.0, 25.0, 50.0, 90.0, 140.0, 200.0, 350.0, 600.0];
/// Steps between starts along each axis for the claim.
const GRID: u32 = 20;
/// Farthest a search may end from a minimum: ten times the simplex' last size.
const NEAR: f64 = 1e-4;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let triangles = simplices(START)?;
    let reports = STARTS.iter().map(|s| solve(*s)).collect::<Result<Vec<_>, _>>()?;
    let mut histories = Panel::new("Evaluations", "Least cost *f*")
        .log_y()
        .y_range(1e-10, 1e3);
    let mut long: [Vec<f64>; 3] = Default::default();
    for (i, (start, report)) in STARTS.iter().zip(&reports).enumerate() {
        let points = (1..).map(f64::from).zip(report.history.iter().copied());
        for (evaluation, cost) in points.clone() {
            for (column, value) in long.iter_mut().zip([i as f64 + 1.0, evaluation, cost]) {
                column.push(value);
            }
        }
        histories = histories.line(
            format!("from [{}, {}]", start[0], start[1]),
            series_style(i),
            points,
        );
    }
    let grid = sweep(-HALF, HALF, GRID);
    let (mut farthest, mut costliest) = (0.0_f64, 0.0_f64);
    for &x in &grid {
        for &y in &grid {
            let report = solve([x, y])?;
            farthest = farthest.max(distance(&report));
            costliest = costliest.max(report.best.cost);
        }
    }
    let figure = Figure::columns(2)
        .panel(map(&triangles))
        .panel(histories)
        .panel_size(270.0, 270.0)
        .legends(Legends::EachPanel);
    let rows = triangles.iter().flatten();
    let corners = [
        rows.clone().map(|p| p.0).collect(),
        rows.map(|p| p.1).collect::<Vec<f64>>(),
    ];
    let names = ["start", "evaluation", "least_cost"];
    let histories_table = DataTable::from_columns(&std::array::from_fn::<_, 3, _>(|k| {
        (names[k], long[k].as_slice())
    }));
    let drawing = Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&[("simplex_x", &corners[0]), ("simplex_y", &corners[1])]))
        .named_data("histories", histories_table)
        .settings(&toml::toml! { start = [-1.0, -1.0] box = [-6.0, 6.0] step = 0.1 })?
        .check(
            ENDS,
            farthest < NEAR,
            format!(
                "from {} starts all over the box at most {farthest:.1e} from a minimum, at most f = {costliest:.1e}",
                grid.len().pow(2)
            ),
        );
    let note = |drawing: Drawing, (i, report): (usize, &Report)| {
        let [x, y] = STARTS[i];
        drawing.note(format!(
            "from [{x}, {y}] to [{:.2}, {:.2}]: {} evaluations, {:.2} ms, {}",
            report.best.candidate.values[0],
            report.best.candidate.values[1],
            report.evaluations,
            1e3 * report.elapsed.as_secs_f64(),
            report.stop
        ))
    };
    Ok(reports.iter().enumerate().fold(drawing, note))
}

/// Contours, minima and simplices.
fn map(triangles: &[Triangle]) -> Panel {
    let axis = sweep(-HALF, HALF, 240);
    let row = |&y: &f64| axis.iter().map(|&x| himmelblau(&[x, y])).collect::<Vec<f64>>();
    let mut panel = Panel::new("*x*", "*y*").contours(Contours {
        rows: axis.iter().map(row).collect(),
        x: axis.clone(),
        y: axis.clone(),
        levels: CONTOURS.to_vec(),
        fills: Vec::new(),
        line: Some(Look::solid(GREY, 0.7)),
    });
    for (i, triangle) in triangles.iter().enumerate() {
        let (label, look) = match i {
            0 => ("first simplex", Look::solid(VERMILION, 2.0)),
            1 => ("later ones", Look::solid(BLUE, 1.1)),
            _ => ("", Look::solid(BLUE, 1.1)),
        };
        panel = panel.line(label, look, triangle.iter().copied());
    }
    let minima = HIMMELBLAU_MINIMA.map(|[x, y]| (x, y));
    panel
        .markers(
            "minima, *f* = 0",
            Look::solid(INK, 1.0).marked(Marker::Cross),
            minima,
        )
        .x_range(-HALF, HALF)
        .y_range(-HALF, HALF)
        .x_step(2.0)
        .y_step(2.0)
        .equal_aspect()
}
