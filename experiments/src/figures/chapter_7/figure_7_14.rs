//! Figure 7.14: contours of the cost of two variables, at every level.

use super::mission::{CEILING, MAPPED_S, problem, surfaces};
use crate::claim::Claim;
use crate::data::{Cell, DataTable};
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::panel::Contours;
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Figure, Panel};
use quad_dynamics::Level;
use wpt_optim::{Choice, Minimum, Surface};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.14",
    title: "Cost contours at every level, two variables, 20 s",
    description: "The cost *Φ* of crossing the station's field from [*x*_{0}, −5 m] to [*x*_{f}, 5 m] in 20 s, 3 m high, from rest to rest, \
                  over both variables: the ideal cost of a vehicle and a beam that are exactly where they should be, and the cost flown at each \
                  level. Contours at 1.15, 1.2, 1.3, 1.5, 2, 3, 10 and 30; dots are minima of the grid with their costs. The station stands at the origin: paths of \
                  the falling diagonal pass over it. Grey corners are a plateau near 100: there the vehicle starts on one side and passes the station on \
                  the other, through the west, where the cables stop the pan axis and the target is lost. The stop, ±170° of pan, lies in the west because the optimisation \
                  turns the pedestal to 90°, zero pan to the east; with the heading of table G.2, 0°, it would lie in the south.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[SEVERAL],
    make: Make::Draw(draw),
};

const SEVERAL: Claim = Claim::holds("several local minima");

/// Contours of the cost.
const CONTOURS: [f64; 8] = [1.15, 1.2, 1.3, 1.5, 2.0, 3.0, 10.0, 30.0];

/// Names and fills of the bands between contours, the cheapest first; the last is the plateau.
const BANDS: [(&str, &str); 9] = [
    ("*Φ* below 1.15", "#fffbd6"),
    ("to 1.2", "#f1f7b5"),
    ("to 1.3", "#cbe8b2"),
    ("to 1.5", "#94d3ba"),
    ("to 2", "#5bbdc2"),
    ("to 3", "#379fc3"),
    ("to 10", "#3579b3"),
    ("to 30", "#3a5594"),
    ("above", "#a6a6a6"),
];

/// Where a minimum's number stands, from its dot, m: where the valley is wide.
const LABEL_M: [f64; 2] = [0.4, -1.75];

const DOT: Look = Look::solid(INK, 1.4).marked(Marker::Circle);

/// The costs of a surface's nodes.
fn costs(surface: &Surface) -> Vec<f64> {
    surface.outcomes.iter().map(|o| o.cost).collect()
}

/// A panel of costs over the two variables, with their minima.
fn panel(name: &str, surface: &Surface) -> Panel {
    let minima = surface.minima();
    let (xs, ys) = (surface.first.clone(), surface.second.clone());
    let [low, high] = [xs[0], xs[xs.len() - 1]];
    let contours = Contours {
        rows: costs(surface)
            .chunks(xs.len())
            .map(|row| row.iter().map(|cost| cost.min(CEILING).log10()).collect())
            .collect(),
        x: xs,
        y: ys,
        levels: CONTOURS.map(f64::log10).to_vec(),
        fills: BANDS.map(|(_, fill)| fill.to_owned()).to_vec(),
        line: Some(Look::solid(INK, 0.5)),
    };
    let panel = Panel::new("*x*_{0}, m", "*x*_{f}, m")
        .contours(contours)
        .markers("", DOT, minima.iter().map(|m| (m.at[0], m.at[1])))
        .x_range(low, high)
        .y_range(low, high)
        .x_step(4.0)
        .y_step(4.0)
        .caption(name);
    minima.iter().fold(panel, |panel, m| {
        panel.annotate(
            m.at[0] + LABEL_M[0],
            m.at[1] + LABEL_M[1],
            format!("{:.3}", m.cost),
        )
    })
}

/// The bands in the legend.
fn with_legend(panel: Panel) -> Panel {
    BANDS.iter().fold(panel, |panel, (name, fill)| {
        panel.markers(*name, Look::solid(fill, 1.0).marked(Marker::Square), [])
    })
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let surfaces = surfaces(context)?;
    let ideal = ideal(context, &surfaces[0])?;
    let (first, second) = (&surfaces[0].first, &surfaces[0].second);
    let mut figure = Figure::columns(3).panel(with_legend(panel("ideal", &ideal)));
    let mut columns = vec![
        (
            "x_0_m".to_owned(),
            second.iter().flat_map(|_| first.clone()).collect::<Vec<_>>(),
        ),
        (
            "x_f_m".to_owned(),
            second.iter().flat_map(|&b| vec![b; first.len()]).collect(),
        ),
        ("cost_ideal".to_owned(), costs(&ideal)),
    ];
    let mut shown = DisplayTable::new([
        "Level",
        "Minima of the grid: *x*_{0}, *x*_{f}, m: *Φ*",
        "Failed flights",
    ]);
    let mut counts = Vec::new();
    for (level, surface) in Level::ALL.into_iter().zip(surfaces.iter()) {
        let minima = surface.minima();
        figure = figure.panel(panel(&level.to_string(), surface));
        columns.push((format!("cost_{}", level.number()), costs(surface)));
        let words = |m: &Minimum| format!("{:.1}, {:.1}: {:.4}", m.at[0], m.at[1], m.cost).replace('-', "−");
        shown.push([
            level.to_string(),
            minima.iter().map(words).collect::<Vec<_>>().join("; "),
            surface.failures().to_string(),
        ]);
        counts.push(minima.len());
    }
    let data: Vec<(&str, &[f64])> = columns.iter().map(|(n, v)| (n.as_str(), v.as_slice())).collect();
    let least = counts.iter().min().copied().unwrap_or(0);
    Ok(Drawing::picture(figure.panel_size(200.0, 200.0).draw())
        .beneath(shown)
        .data(DataTable::from_columns(&data))
        .named_data("minima", minima_table(&surfaces))
        .settings(&toml::toml! { vehicle = "vehicles/qball-x4.toml" station = "stations/ets.toml" pedestal_heading_deg = 90.0 duration_s = 20.0 height_m = 3.0 position_settling_s = 5.0 })?
        .check(
            SEVERAL,
            least >= 2,
            format!("{least} or more at every level on {} by {} nodes", first.len(), second.len()),
        ))
}

/// The ideal cost at the nodes of a surface.
fn ideal(context: &Context, surface: &Surface) -> Result<Surface, ItemError> {
    let problem = problem(context, Choice::Two, MAPPED_S, Level::Two)?;
    let mut outcomes = Vec::with_capacity(surface.outcomes.len());
    for &b in &surface.second {
        for &a in &surface.first {
            outcomes.push(problem.ideal(&[a, b])?);
        }
    }
    Ok(Surface {
        outcomes,
        ..surface.clone()
    })
}

fn minima_table(surfaces: &[Surface]) -> DataTable {
    let mut table = DataTable::new(["level", "x_0_m", "x_f_m", "cost"]);
    for (level, surface) in Level::ALL.into_iter().zip(surfaces) {
        for minimum in surface.minima() {
            let row: [Cell; 4] = [
                level.number().into(),
                minimum.at[0].into(),
                minimum.at[1].into(),
                minimum.cost.into(),
            ];
            table.push(row);
        }
    }
    table
}
