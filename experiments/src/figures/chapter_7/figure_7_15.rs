//! Figure 7.15: the cost manifolds, and the slope at the same start.

use super::mission::{CEILING, MAPPED_S, problem, surfaces};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::figures::sweep;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::space::View;
use crate::plot::style::{INK, Look, Marker};
use crate::plot::{Figure, Panel, Space, level_name, level_style};
use quad_dynamics::Level;
use wpt_optim::{Choice, Gradient, Surface};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.15",
    title: "Cost manifolds at every level, two variables, 20 s",
    description: "(a) to (e) The surfaces whose contours are figure 7.14, as log_{10} *Φ* over *x*_{0} and *x*_{f}, with the start *X*_{0} = [5, 5] m. Between \
                  the two valleys the path leads over the station; on the plateaus it leads through the west, where the pan axis stops: ±170° from the pedestal's heading, which the \
                  optimisation turns to 90°, east, from the 0° of table G.2. (f) The cuts *x*_{f} = 5 m through the surfaces; levels 1 to 4 differ by less than a line's width. Beneath: cost and slope at \
                  the start, the slope by dual numbers through the whole flight.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[SLOPES],
    make: Make::Draw(draw),
};

const SLOPES: Claim = Claim::holds("the slope at the same start differs between levels");

/// What the derivative is good for, 1/m: ten times its distance from central differences (tested to 1e-6 there, and 1e-8 here).
const ACCURACY: f64 = 1e-7;

/// From where both valleys are seen.
const VIEW: View = View {
    azimuth_deg: -70.0,
    elevation_deg: 42.0,
};

/// Faces along each variable.
const FACES: usize = 20;
/// Their fill, so that they hide what lies behind.
const FACE: &str = "#ffffff";

/// The cut's part of the valley, m, and its intervals.
const VALLEY_M: [f64; 2] = [1.0, 8.0];
const INTERVALS: u32 = 35;

const START: Look = Look::solid(INK, 1.6).marked(Marker::Circle);

/// The surface as its faces. Drawn from the farthest on, as seen from [`VIEW`]: each hides what lies behind it.
fn space(level: Level, surface: &Surface, start: [f64; 3]) -> Space {
    let (columns, rows) = (surface.first.len(), surface.second.len());
    let every = (columns - 1).div_ceil(FACES);
    let corner = |column: usize, row: usize| {
        let cost = surface.cost(column, row).min(CEILING);
        [surface.first[column], surface.second[row], cost.log10()]
    };
    let look = Look::solid(level_style(level.number()).colour, 0.8);
    let mut space = Space::new("*x*_{0}, m", "*x*_{f}, m", "log_{10} *Φ*")
        .caption(level.to_string())
        .view(VIEW)
        .without_shadows()
        .range(2, 0.0, 2.0);
    for row in (0..rows - 1).step_by(every).rev() {
        for column in (0..columns - 1).step_by(every) {
            let (right, far) = ((column + every).min(columns - 1), (row + every).min(rows - 1));
            let [a, b, c, d] =
                [(column, row), (right, row), (right, far), (column, far)].map(|(c, r)| corner(c, r));
            space = space
                .surface(FACE, 1.0, [a, b, c, d])
                .line("", look, [a, b, c, d, a]);
        }
    }
    space.markers("", START, [start])
}

/// The costs along the cut x_f = x_f(X_0), a line per level.
struct Cut {
    x_0: Vec<f64>,
    costs: Vec<Vec<f64>>,
}

impl Cut {
    fn panel(&self, start: &[f64], costs: impl Iterator<Item = f64>) -> Panel {
        let panel = Panel::new("*x*_{0}, m", "*Φ*").caption("cuts *x*_{f} = 5 m");
        let panel = Level::ALL
            .into_iter()
            .zip(&self.costs)
            .fold(panel, |panel, (level, costs)| {
                let n = level.number();
                let points = self.x_0.iter().copied().zip(costs.iter().copied());
                panel.line(level_name(n), level_style(n), points)
            });
        panel.markers(
            "start *X*_{0}",
            START.marked(Marker::Dot),
            costs.map(|cost| (start[0], cost)),
        )
    }

    fn data(&self) -> DataTable {
        let mut columns = vec![("x_0_m".to_owned(), self.x_0.as_slice())];
        for (level, costs) in Level::ALL.into_iter().zip(&self.costs) {
            columns.push((format!("cost_{}", level.number()), costs));
        }
        let columns: Vec<_> = columns
            .iter()
            .map(|(name, values)| (name.as_str(), *values))
            .collect();
        DataTable::from_columns(&columns)
    }
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let surfaces = surfaces(context)?;
    let mut figure = Figure::columns(3);
    let mut shown = DisplayTable::new(["Level", "*Φ*", "∂*Φ*/∂*x*_{0}, m^{−1}", "∂*Φ*/∂*x*_{f}, m^{−1}"]);
    let mut slopes: Vec<(u8, Gradient)> = Vec::new();
    let mut cut = Cut {
        x_0: sweep(VALLEY_M[0], VALLEY_M[1], INTERVALS),
        costs: Vec::new(),
    };
    let start = problem(context, Choice::Two, MAPPED_S, Level::One)?.start();
    for (level, surface) in Level::ALL.into_iter().zip(surfaces.iter()) {
        let problem = problem(context, Choice::Two, MAPPED_S, level)?;
        let slope = problem.gradient(&start)?;
        let along: Vec<_> = cut.x_0.iter().map(|&x_0| vec![x_0, start[1]]).collect();
        let outcomes = problem.evaluate_all(&along)?;
        cut.costs
            .push(outcomes.iter().map(|outcome| outcome.cost).collect());
        figure = figure.panel(space(level, surface, [start[0], start[1], slope.cost.log10()]));
        shown.push([
            level.to_string(),
            format!("{:.5}", slope.cost),
            format!("{:.6}", slope.gradient[0]),
            format!("{:.6}", slope.gradient[1]),
        ]);
        slopes.push((level.number(), slope));
    }
    figure = figure.panel(cut.panel(&start, slopes.iter().map(|(_, slope)| slope.cost)));
    let distance = |a: &Gradient, b: &Gradient| {
        let d = |i: usize| a.gradient[i] - b.gradient[i];
        d(0).hypot(d(1))
    };
    let norm = slopes[0].1.gradient[0].hypot(slopes[0].1.gradient[1]);
    let mut distances = Vec::new();
    for (i, (_, a)) in slopes.iter().enumerate() {
        distances.extend(slopes[..i].iter().map(|(_, b)| distance(a, b)));
    }
    let [least, most] = [f64::min, f64::max].map(|f| distances.iter().copied().reduce(f).unwrap_or(f64::NAN));
    let column = |f: fn(&(u8, Gradient)) -> f64| slopes.iter().map(f).collect::<Vec<f64>>();
    Ok(Drawing::picture(figure.panel_size(230.0, 200.0).draw())
        .beneath(shown)
        .data(DataTable::from_columns(&[
            ("level", &column(|(level, _)| f64::from(*level))),
            ("cost", &column(|(_, slope)| slope.cost)),
            ("slope_x_0_per_m", &column(|(_, slope)| slope.gradient[0])),
            ("slope_x_f_per_m", &column(|(_, slope)| slope.gradient[1])),
        ]))
        .named_data("cut", cut.data())
        .settings(&toml::toml! { vehicle = "vehicles/qball-x4.toml" station = "stations/ets.toml" pedestal_heading_deg = 90.0 duration_s = 20.0 height_m = 3.0 position_settling_s = 5.0 start_m = [5.0, 5.0] })?
        .check(
            SLOPES,
            least > ACCURACY,
            format!(
                "slopes of any two levels differ by {:.4} % to {:.1} % of level 1's {norm:.4} per metre",
                100.0 * least / norm,
                100.0 * most / norm
            ),
        ))
}
