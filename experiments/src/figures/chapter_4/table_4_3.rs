//! Table 4.3: identified thrust and torque coefficients against the published ones.

use super::propeller::{self, Row};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::flight::{NOMINAL_VEHICLE, load_vehicle};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.3",
    title: "Thrust and torque coefficients against Brandt and Selig",
    description: "Coefficients of *T* = *C*_{T} *ρ* *n*^{2} *D*^{4} and *Q* = *C*_{Q} *ρ* *n*^{2} *D*^{5} identified over the \
                  whole measured range, with 95 % intervals, beside the published values of the same propeller at the \
                  rotor speeds where the identified ones say hover is and at the ends of the range.",
    kind: Kind::Table,
    origin: Origin::Measured,
    claims: &[AGREES, VEHICLE],
    make: Make::Draw(draw),
};

const AGREES: Claim = Claim::does_not_hold(
    "the published value at hover speed lies inside the identified interval",
    "the published coefficients rise by a fifth over the range, and least squares on thrust weighs fast rotors most, so one constant is 5 % high at hover",
);
const VEHICLE: Claim = Claim::holds("the vehicle file holds the identified coefficients");

/// Digits of the vehicle file: six for `C_T`, six for `C_Q`.
const PRINTED: f64 = 1e-5;

/// A coefficient: how it is named, measured and stored.
struct Quantity {
    name: &'static str,
    column: &'static str,
    /// Thrust, N, or torque, N m.
    value: fn(&Row) -> f64,
    /// The published coefficient.
    coefficient: fn(&Row) -> f64,
    /// Power of the diameter in the law.
    power: i32,
    /// The coefficient in the vehicle file.
    in_file: f64,
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let rows = propeller::read(context)?;
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let hover_rpm = {
        let k_t = propeller::fit(&rows, Row::thrust)?.slope;
        (vehicle.hover_thrust_per_rotor() / k_t).sqrt() * 60.0 / std::f64::consts::TAU
    };
    let (first, last) = match (rows.first(), rows.last()) {
        (Some(first), Some(last)) => (first.rpm, last.rpm),
        _ => return Err(ItemError::new("the propeller's static table is empty")),
    };
    let mut shown = DisplayTable::new([
        "Coefficient".to_owned(),
        "Identified, 95 % interval".to_owned(),
        format!("Published at {first:.0} rpm"),
        format!("Published at {hover_rpm:.0} rpm (hover)"),
        format!("Published at {last:.0} rpm"),
    ]);
    let mut data = DataTable::new([
        "coefficient",
        "identified",
        "half_width",
        "published_slowest",
        "published_hover",
        "published_fastest",
    ]);
    let mut findings = Vec::new();
    let in_file = vehicle.require_propeller("table 4.3")?;
    let quantities = [
        Quantity {
            name: "*C*_{T}",
            column: "C_T",
            value: Row::thrust,
            coefficient: |r| r.thrust_coefficient,
            power: 4,
            in_file: in_file.thrust_coefficient,
        },
        Quantity {
            name: "*C*_{Q}",
            column: "C_Q",
            value: Row::torque,
            coefficient: Row::torque_coefficient,
            power: 5,
            in_file: in_file.torque_coefficient,
        },
    ];
    for Quantity {
        name,
        column,
        value,
        coefficient,
        power,
        in_file,
    } in quantities
    {
        let fit = propeller::fit(&rows, value)?;
        let (identified, half_width) = (
            fit.slope / propeller::scale(power),
            fit.half_width / propeller::scale(power),
        );
        let published = |rpm| propeller::at_speed(&rows, rpm, coefficient).unwrap_or(f64::NAN);
        shown.push([
            name.to_owned(),
            format!("{identified:.5} ± {half_width:.5}"),
            format!("{:.5}", published(first)),
            format!("{:.5}", published(hover_rpm)),
            format!("{:.5}", published(last)),
        ]);
        data.push([
            column.into(),
            identified.into(),
            half_width.into(),
            published(first).into(),
            published(hover_rpm).into(),
            published(last).into(),
        ]);
        findings.push((
            (identified - published(hover_rpm)).abs() / half_width,
            identified / published(hover_rpm) - 1.0,
            (identified / in_file - 1.0).abs(),
        ));
    }
    let widths: Vec<String> = findings
        .iter()
        .map(|f| format!("{:.1} half widths ({:+.1} %)", f.0, 100.0 * f.1))
        .collect();
    let file = findings.iter().map(|f| f.2).fold(0.0, f64::max);
    Ok(Drawing::table(shown)
        .data(data)
        .check(
            AGREES,
            findings.iter().all(|f| f.0 <= 1.0),
            format!("C_T and C_Q differ by {}", widths.join(" and ")),
        )
        .check(
            VEHICLE,
            file < PRINTED,
            format!("largest relative difference {file:.1e}"),
        ))
}
