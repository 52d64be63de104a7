//! Figure 6.17: the reference trajectory.

use super::paths;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, Space, reference_style, series_style};
use crate::scenarios;
use quad_ndi::Trajectory;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "6.17",
    title: "Reference trajectory",
    description: "The smooth trajectory *y*_{t,d}(*t*) that the controllers follow in figures 6.18 to 6.20, 6.24 \
                  and 6.25: a climbing loop of 12 s through five waypoints, turning the heading once around. \
                  Polynomials of degree 9 in position and 7 in heading join the waypoints; the fifth derivative of the position, which c3 alone feeds forward, exists everywhere \
                  and jumps at the waypoints. Grey: projection on the ground.",
    kind: Kind::Plot,
    origin: Origin::Derived,
    claims: &[SMOOTH],
    make: Make::Draw(draw),
};

const SMOOTH: Claim = Claim::holds(
    "smooth to the order that the controllers need: position to its fourth derivative, heading to its third",
);

/// Distance from a waypoint at which the two sides are compared, s.
const NEAR_S: f64 = 1e-6;

/// A jump stands out against what a continuous derivative changes within 2 µs: its own derivative, below
/// 1e3 m/s⁵ here, times that time.
const JUMP: f64 = 2e-3;

fn draw(_: &Context) -> Result<Drawing, ItemError> {
    let trajectory = Trajectory::through(&paths::waypoints()?)?;
    let times: Vec<f64> = (0..=480).map(|k| f64::from(k) * 0.025).collect();
    let points: Vec<_> = times.iter().map(|&t| trajectory.flat_output(t)).collect();
    let column = |f: fn(&quad_ndi::FlatOutput<f64>) -> f64| points.iter().map(f).collect::<Vec<f64>>();
    let columns = [
        column(|p| p.position.x),
        column(|p| p.position.y),
        column(|p| p.position.z),
        column(|p| p.yaw),
    ];
    let acceleration = column(|p| p.acceleration.norm());
    let dots = trajectory
        .waypoints()
        .iter()
        .map(|w| w.position_m)
        .map(|[x, y, z]| Space::of_z_down(x, y, z));
    let space = paths::empty_space()
        .line(
            "reference",
            reference_style().dashed(""),
            points
                .iter()
                .map(|p| Space::of_z_down(p.position.x, p.position.y, p.position.z)),
        )
        .markers("waypoints", series_style(1), dots);
    let over_time = |values: &[f64]| times.iter().copied().zip(values.to_vec()).collect::<Vec<_>>();
    let panel = |label: &str, values: &[f64]| {
        Panel::new("Time *t*, s", label).line("", reference_style().dashed(""), over_time(values))
    };
    let figure = Figure::columns(1)
        .panel(space)
        .panel(panel("Heading *ψ*, rad", &columns[3]))
        .panel(panel("Acceleration |*r̈*|, m s^{−2}", &acceleration))
        .panel_size(470.0, 250.0);
    let jump = largest_jump(&trajectory);
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&[
            ("t_s", &times),
            ("x_m", &columns[0]),
            ("y_m", &columns[1]),
            ("z_m", &columns[2]),
            ("yaw_rad", &columns[3]),
            ("acceleration_m_s2", &acceleration),
        ]))
        .scenario(scenarios::find("6.18")?)
        .check(
            SMOOTH,
            jump < JUMP,
            format!("largest jump of any of these derivatives at a waypoint: {jump:.1e}"),
        )
        .note(format!(
            "the fifth derivative of the position jumps by up to {:.0} m/s⁵ at a waypoint",
            crackle_jump(&trajectory)
        )))
}

/// Largest jump of the fifth derivative of the position at a waypoint, m/s⁵.
fn crackle_jump(trajectory: &Trajectory) -> f64 {
    let jump = |t: f64| {
        let crackle = |t: f64| trajectory.flat_output(t).crackle;
        (crackle(t + NEAR_S) - crackle(t - NEAR_S)).norm()
    };
    trajectory
        .waypoints()
        .iter()
        .map(|w| jump(w.time_s))
        .fold(0.0, f64::max)
}

/// Largest change of position to snap and heading to jerk across the waypoints, ends included.
fn largest_jump(trajectory: &Trajectory) -> f64 {
    let across = |t: f64| {
        let (a, b) = (
            trajectory.flat_output(t - NEAR_S),
            trajectory.flat_output(t + NEAR_S),
        );
        [
            (a.position - b.position).norm(),
            (a.velocity - b.velocity).norm(),
            (a.acceleration - b.acceleration).norm(),
            (a.jerk - b.jerk).norm(),
            (a.snap - b.snap).norm(),
            (a.yaw - b.yaw).abs(),
            (a.yaw_rate - b.yaw_rate).abs(),
            (a.yaw_acceleration - b.yaw_acceleration).abs(),
            (a.yaw_jerk - b.yaw_jerk).abs(),
        ]
    };
    trajectory
        .waypoints()
        .iter()
        .flat_map(|w| across(w.time_s))
        .fold(0.0, f64::max)
}
