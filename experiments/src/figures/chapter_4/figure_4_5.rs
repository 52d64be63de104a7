//! Figure 4.5: the bifilar torsional pendulum, and its equation fitted to the history of the angle.

use super::{bench, pendulum_sketch, pendulums};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::style::{Look, VERMILION};
use crate::plot::svg::{Svg, at};
use crate::plot::{Figure, Panel, series_style};
use sysid::laboratory::pendulum::{Axis, PendulumRig};
use sysid::residual::Whiteness;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.5",
    title: "The bifilar torsional pendulum",
    description: "Left: the body hangs on two strings of length *L*, each *b* from the axis through its centre of mass; turned \
                  by *θ* it rises by *z*, and its weight drives it back. Right: (a) the angle about the yaw axis in the virtual laboratory, \
                  released from 40° (motion capture at 50 Hz, noise 2 mrad, every fifth sample drawn in both panels), with the non-linear equation \
                  fitted, viscous and quadratic damping included; (b) the residuals.",
    kind: Kind::Plot,
    origin: Origin::VirtualLaboratory,
    claims: &[INSIDE, WHITE],
    make: Make::Draw(draw),
};

const INSIDE: Claim = Claim::holds("the true moment of inertia lies inside the 95 % interval of the fit");
const WHITE: Claim = Claim::holds("the residuals are white");

/// Every how many samples are drawn.
const DRAWN: usize = 5;
fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let rig = PendulumRig::default();
    let vehicle = bench::vehicle(context)?;
    let test = pendulums::swing(&vehicle, &rig, Axis::Yaw, 0)?;
    let (fit, truth) = (&test.fit, Axis::Yaw.inertia(&vehicle));
    let time = |i: usize| test.samples[i].time_s;
    let angle = Panel::new("", "Angle *θ*, rad")
        .markers(
            "virtual measurement",
            series_style(0),
            test.samples
                .iter()
                .step_by(DRAWN)
                .map(|s| (s.time_s, s.angle_rad)),
        )
        .line(
            "fitted equation",
            Look::solid(VERMILION, 1.4),
            fit.fitted_rad.iter().enumerate().map(|(i, y)| (time(i), *y)),
        );
    let residual = Panel::new("Time *t*, s", "Residual, mrad")
        .markers(
            "",
            series_style(0),
            fit.residuals_rad
                .iter()
                .enumerate()
                .step_by(DRAWN)
                .map(|(i, r)| (time(i), 1e3 * r)),
        )
        .x_range(0.0, rig.duration_s)
        .horizontal(0.0, "");
    let charts = Figure::columns(1)
        .panel_size(400.0, 150.0)
        .share_x()
        .panel(angle)
        .panel(residual)
        .draw();
    let mut picture = Svg::new(pendulum_sketch::WIDTH + charts.width, charts.height);
    picture.place(&pendulum_sketch::draw(charts.height), at(0.0, 0.0));
    picture.place(&charts, at(pendulum_sketch::WIDTH, 0.0));
    let columns: Vec<f64> = test.samples.iter().map(|s| s.time_s).collect();
    let angles: Vec<f64> = test.samples.iter().map(|s| s.angle_rad).collect();
    let naive = rig.suspension(&vehicle);
    let naive = naive.inertia_of(naive.period(truth, rig.release_rad)) / truth - 1.0;
    let whiteness = Whiteness::test(&fit.residuals_rad, 20);
    Ok(Drawing::picture(picture)
        .data(DataTable::from_columns(&[
            ("time_s", &columns),
            ("angle_rad", &angles),
            ("fitted_rad", &fit.fitted_rad),
        ]))
        .settings(&Settings {
            seed: pendulums::seed(Axis::Yaw, 0),
            rig,
        })?
        .check(
            INSIDE,
            fit.inertia.interval().contains(truth),
            format!(
                "({:.4} ± {:.4})·10⁻² kg m², true {:.4}·10⁻²; the small-angle law would be {:+.1} % off at this amplitude",
                1e2 * fit.inertia.value,
                1e2 * fit.inertia.half_width(),
                1e2 * truth,
                100.0 * naive
            ),
        )
        .check(
            WHITE,
            whiteness.is_white(),
            format!("Ljung-Box p = {:.2} over 20 lags", whiteness.p_value),
        ))
}

#[derive(serde::Serialize)]
struct Settings {
    seed: u64,
    rig: PendulumRig,
}
