//! Figure 4.7: thrust, torque and their coefficients against rotor speed, measured, with the fitted laws.

use super::advance::{SMALL_ADVANCE, small_advance};
use super::propeller::{self, SCALE};
use super::propeller_panels::{coefficient_panel, force_panel, stream_panel, table};
use crate::claim::Claim;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::{Figure, reference_style};
use quad_dynamics::vehicle::derive::rad_per_s;
use sysid::rotor_static::{Quantity, advance_slope};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "4.7",
    title: "Thrust and torque against rotor speed at steady state",
    description: "Wind-tunnel measurements of the Qball-X4's propeller, APC slow flyer 10×4.7 (UIUC Propeller Data Site; Brandt \
                  and Selig, AIAA 2011-1255), at *ρ* = 1.225 kg m^{−3}: thrust, torque and their coefficients against speed, with \
                  one constant coefficient and with one that follows the speed (bands: 95 %); right, the coefficients in an axial \
                  stream against the advance ratio, with the line at small ratios whose slope damps a climbing rotor: through the points \
                  up to *J* = 0.3 at 4000 rpm, about hover, and the static one at that speed, which is its point at *J* = 0.",
    kind: Kind::Plot,
    origin: Origin::Measured,
    claims: &[RESIDUALS, QUADRATIC, INTERVALS, DEPENDENCE],
    make: Make::Draw(draw),
};

const RESIDUALS: Claim = Claim::holds("fit residuals are stated");
const QUADRATIC: Claim = Claim::does_not_hold(
    "the law with one constant meets every point within 3 % of the largest value",
    "the measured coefficients rise by a fifth from 2400 to 6500 rpm (Reynolds number), which one constant cannot follow",
);
const INTERVALS: Claim = Claim::holds("coefficients carry 95 % intervals, narrower than ±3 %");
const DEPENDENCE: Claim =
    Claim::holds("the coefficients depend on the speed: a constant one is rejected at p < 10⁻⁶");

/// Reference speed of the dependence, rpm: about hover.
const REFERENCE_RPM: f64 = 4500.0;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let rows = propeller::read(context)?;
    let stream = propeller::read_advance(context)?;
    let reference = rad_per_s(REFERENCE_RPM);
    let thrust = propeller::identify(&rows, Quantity::Thrust, reference)?;
    let torque = propeller::identify(&rows, Quantity::Torque, reference)?;
    let slope = advance_slope(&small_advance(&stream, &rows))?;
    let figure = Figure::columns(3)
        .panel(force_panel("Thrust *T*, N", &rows, Quantity::Thrust, &thrust))
        .panel(coefficient_panel(
            "Coefficient *C*_{T}",
            &rows,
            Quantity::Thrust,
            &thrust,
        ))
        .panel(
            stream_panel("Coefficient *C*_{T}", &stream, |row| {
                row.sample.thrust_coefficient
            })
            .line(
                "line, *J* ≤ 0.3",
                reference_style(),
                [0.0, SMALL_ADVANCE].map(|j| (j, slope.values()[0] + slope.values()[1] * j)),
            ),
        )
        .panel(force_panel("Torque *Q*, N m", &rows, Quantity::Torque, &torque))
        .panel(coefficient_panel(
            "Coefficient *C*_{Q}",
            &rows,
            Quantity::Torque,
            &torque,
        ))
        .panel(stream_panel("Coefficient *C*_{Q}", &stream, |row| {
            row.power_coefficient / std::f64::consts::TAU
        }));
    let both = [&thrust, &torque];
    let k = [Quantity::Thrust, Quantity::Torque]
        .map(|quantity| SCALE.unit(quantity, reference) / reference.powi(2));
    let largest = |quantity| rows.iter().map(|r| r.value(quantity)).fold(0.0, f64::max);
    let off = (thrust.constant.goodness.largest_residual / largest(Quantity::Thrust))
        .max(torque.constant.goodness.largest_residual / largest(Quantity::Torque));
    let constants = both.map(|i| i.constant.parameters[0]);
    let width = constants
        .map(|c| c.half_width() / c.value)
        .into_iter()
        .fold(0.0, f64::max);
    let rms = both.map(|i| propeller::rms(&i.constant.goodness, rows.len()));
    let varying = both.map(|i| propeller::rms(&i.varying.fit.goodness, rows.len()));
    let p_values = both.map(|i| i.varying.p_value);
    Ok(Drawing::picture(figure.draw())
        .data(table(&rows, &thrust, &torque))
        .settings(&toml::toml! {
            measurements = "propellers/apc_sf_10x4.7_static.csv, propellers/apc_sf_10x4.7_advance.csv"
            diameter_m = 0.254
            air_density_kg_m3 = 1.225
            law = "T = C_T ρ n² D⁴, Q = C_Q ρ n² D⁵, least squares without weights; C = c_0 + c_1 (Ω/Ω_ref − 1), Ω_ref at 4500 rpm"
        })?
        .check(
            RESIDUALS,
            rms.iter().chain(&varying).all(|r| r.is_finite() && *r > 0.0),
            format!(
                "RMS {:.3} N and {:.2} mN m with one constant; {:.3} N and {:.2} mN m with the dependence on speed",
                rms[0],
                1e3 * rms[1],
                varying[0],
                1e3 * varying[1]
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
                "k_T = ({:.3} ± {:.3})·10⁻⁵ N s², k_Q = ({:.3} ± {:.3})·10⁻⁷ N m s²; the residuals follow the speed, so that \
                 these intervals, made for noise, are too narrow for a rotor at one speed",
                1e5 * k[0] * constants[0].value,
                1e5 * k[0] * constants[0].half_width(),
                1e7 * k[1] * constants[1].value,
                1e7 * k[1] * constants[1].half_width()
            ),
        )
        .check(
            DEPENDENCE,
            both.iter().all(|i| i.varying.is_significant(1e-6)),
            format!("p = {:.0e} for C_T, {:.0e} for C_Q", p_values[0], p_values[1]),
        ))
}
