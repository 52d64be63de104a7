//! Figure 4.7: thrust and torque against rotor speed, measured, with the fitted static law.

use super::propeller::{self, Fit, Row};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, Panel, series_style};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.7",
    title: "Thrust and torque against rotor speed at steady state",
    description: "Wind-tunnel measurements of the Qball-X4's propeller, APC slow flyer 10×4.7 (UIUC Propeller Data Site; Brandt \
                  and Selig, AIAA 2011-1255), at *ρ* = 1.225 kg m^{−3}, with *T* = *k*_{T} *Ω*^{2} and \
                  *Q* = *k*_{Q} *Ω*^{2} fitted by least squares. The measured coefficients rise with speed, so one constant \
                  overstates slow rotors and understates fast ones.",
    kind: Kind::Plot,
    origin: Origin::Measured,
    claims: &[RESIDUALS, QUADRATIC, INTERVALS],
    make: Make::Draw(draw),
};

const RESIDUALS: Claim = Claim::holds("fit residuals are stated");
const QUADRATIC: Claim = Claim::does_not_hold(
    "the law with one constant meets every point within 3 % of the largest value",
    "the measured coefficients rise by a fifth from 2400 to 6500 rpm (Reynolds number), which one constant cannot follow",
);
const INTERVALS: Claim = Claim::holds("coefficients carry 95 % intervals, narrower than ±3 %");

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let rows = propeller::read(context)?;
    let thrust = propeller::fit(&rows, Row::thrust)?;
    let torque = propeller::fit(&rows, Row::torque)?;
    let figure = Figure::columns(2)
        .panel(panel("Thrust *T*, N", &rows, Row::thrust, &thrust))
        .panel(panel("Torque *Q*, N m", &rows, Row::torque, &torque));
    let mut data = DataTable::new([
        "speed_rpm",
        "thrust_n",
        "torque_n_m",
        "fitted_thrust_n",
        "fitted_torque_n_m",
    ]);
    for r in &rows {
        let square = r.speed().powi(2);
        data.push([
            r.rpm.into(),
            r.thrust().into(),
            r.torque().into(),
            (thrust.slope * square).into(),
            (torque.slope * square).into(),
        ]);
    }
    let largest = |y: fn(&Row) -> f64| rows.iter().map(y).fold(0.0, f64::max);
    let off =
        (thrust.largest_residual / largest(Row::thrust)).max(torque.largest_residual / largest(Row::torque));
    let width = (thrust.half_width / thrust.slope).max(torque.half_width / torque.slope);
    Ok(Drawing::picture(figure.draw())
        .data(data)
        .scenario(&toml::toml! {
            measurements = "propellers/apc_sf_10x4.7_static.csv"
            diameter_m = 0.254
            air_density_kg_m3 = 1.225
            law = "T = k_T Ω², Q = k_Q Ω², least squares without weights"
        })?
        .check(
            RESIDUALS,
            [thrust, torque]
                .iter()
                .all(|f| f.rms_residual.is_finite() && f.rms_residual > 0.0),
            format!(
                "RMS {:.3} N and {:.2} mN m; largest {:.3} N and {:.2} mN m",
                thrust.rms_residual,
                1e3 * torque.rms_residual,
                thrust.largest_residual,
                1e3 * torque.largest_residual
            ),
        )
        .check(
            QUADRATIC,
            off < 0.03,
            format!("furthest point {:.1} % of the largest value", 100.0 * off),
        )
        .check(
            INTERVALS,
            width < 0.03,
            format!(
                "k_T = ({:.3} ± {:.3})·10⁻⁵ N s², k_Q = ({:.3} ± {:.3})·10⁻⁷ N m s²",
                1e5 * thrust.slope,
                1e5 * thrust.half_width,
                1e7 * torque.slope,
                1e7 * torque.half_width
            ),
        ))
}

fn panel(label: &str, rows: &[Row], y: fn(&Row) -> f64, fit: &Fit) -> Panel {
    let fastest = rows.iter().map(|r| r.rpm).fold(0.0, f64::max);
    let curve = (0..=100).map(|k| {
        let rpm = fastest * f64::from(k) / 100.0;
        (
            rpm / 1e3,
            fit.slope * quad_dynamics::vehicle::derive::rad_per_s(rpm).powi(2),
        )
    });
    Panel::new("Rotor speed, 1000 rpm", label)
        .line("fit", series_style(0), curve)
        .markers(
            "measured",
            series_style(1),
            rows.iter().map(|r| (r.rpm / 1e3, y(r))),
        )
}
