//! Table 4.3: identified thrust and torque coefficients against the published ones.

use super::advance::{damping_error, small_advance};
use super::propeller::{self, Identified};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::vehicle::derive::{SteadyRotor, rad_per_s};
use sysid::Estimate;
use sysid::rotor_static::{Quantity, advance_slope};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.3",
    title: "Thrust and torque coefficients against Brandt and Selig",
    description: "Coefficients of *T* = *C*_{T} *ρ* *n*^{2} *D*^{4} and *Q* = *C*_{Q} *ρ* *n*^{2} *D*^{5} identified over the \
                  whole measured range as one constant and as a line over the speed taken at hover, and the slope of *C*_{T} over \
                  the advance ratio, with 95 % intervals, beside the published values of the same propeller at hover speed and at \
                  the ends of the range.",
    kind: Kind::Table,
    origin: Origin::Measured,
    claims: &[AGREES, FOLLOWS, VEHICLE, SLOPE],
    make: Make::Draw(draw),
};

const AGREES: Claim = Claim::does_not_hold(
    "the published value at hover speed lies inside the identified interval",
    "the published coefficients rise by a fifth over the range, and least squares on thrust weighs fast rotors most, so one constant is 5 % high at hover",
);
const FOLLOWS: Claim =
    Claim::holds("a coefficient that follows the speed meets the published value at hover within 1 %");
const VEHICLE: Claim = Claim::holds("the vehicle file holds the identified coefficients");
const SLOPE: Claim = Claim::holds(
    "the slope of C_T over the advance ratio is negative and gives the vehicle file's rate damping",
);

/// Digits of the vehicle file: six for `C_T`, six for `C_Q`, four for the damping.
const PRINTED: f64 = 1e-5;
const PRINTED_DAMPING: f64 = 5e-4;

/// What is compared for one coefficient.
struct Compared {
    name: &'static str,
    column: &'static str,
    quantity: Quantity,
    in_file: f64,
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let rows = propeller::read(context)?;
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let steady = SteadyRotor::of(&vehicle)?;
    let hover = steady.speed_at_thrust(vehicle.hover_thrust_per_rotor());
    let hover_rpm = hover / rad_per_s(1.0);
    let (first, last) = match (rows.first(), rows.last()) {
        (Some(first), Some(last)) => (first.rpm, last.rpm),
        _ => return Err(ItemError::new("the propeller's static table is empty")),
    };
    let mut shown = DisplayTable::new([
        "Coefficient".to_owned(),
        "One constant".to_owned(),
        format!("Following the speed, at {hover_rpm:.0} rpm (hover)"),
        format!("Published at {first:.0} rpm"),
        format!("Published at {hover_rpm:.0} rpm"),
        format!("Published at {last:.0} rpm"),
    ]);
    let mut data = DataTable::new([
        "coefficient",
        "identified",
        "half_width",
        "following_speed_at_hover",
        "half_width_at_hover",
        "published_slowest",
        "published_hover",
        "published_fastest",
    ]);
    let file = vehicle.require_propeller("table 4.3")?;
    let compared = [
        Compared {
            name: "*C*_{T}",
            column: "C_T",
            quantity: Quantity::Thrust,
            in_file: file.thrust_coefficient,
        },
        Compared {
            name: "*C*_{Q}",
            column: "C_Q",
            quantity: Quantity::Torque,
            in_file: file.torque_coefficient,
        },
    ];
    let (mut constant, mut following, mut worst_file) = (Vec::new(), Vec::new(), 0.0_f64);
    for one in &compared {
        let Identified {
            constant: fit,
            varying,
        } = propeller::identify(&rows, one.quantity, hover)?;
        let published = [first, hover_rpm, last]
            .map(|rpm| propeller::at_speed(&rows, rpm, one.quantity).unwrap_or(f64::NAN));
        let (whole, at_hover) = (fit.parameters[0], varying.at_reference);
        let [slow, middle, fast] = published.map(|c| format!("{c:.5}"));
        shown.push([
            one.name.to_owned(),
            words(&whole),
            words(&at_hover),
            slow,
            middle,
            fast,
        ]);
        data.push([
            one.column.into(),
            whole.value.into(),
            whole.half_width().into(),
            at_hover.value.into(),
            at_hover.half_width().into(),
            published[0].into(),
            published[1].into(),
            published[2].into(),
        ]);
        constant.push((whole.value - published[1]) / whole.half_width());
        following.push(at_hover.value / published[1] - 1.0);
        worst_file = worst_file.max((whole.value / one.in_file - 1.0).abs());
    }
    let slope = advance_slope(&small_advance(&propeller::read_advance(context)?, &rows))?.parameters[1];
    shown.push([
        "d*C*_{T}/d*J*, *J* ≤ 0.3, 4014 rpm",
        &words(&slope),
        "",
        "",
        "",
        "",
    ]);
    let damping = damping_error(&vehicle, &steady, slope.value, hover)?;
    Ok(Drawing::table(shown)
        .data(data)
        .check(
            AGREES,
            constant.iter().all(|widths| widths.abs() <= 1.0),
            format!(
                "C_T and C_Q lie {:.1} and {:.1} half widths above",
                constant[0], constant[1]
            ),
        )
        .check(
            FOLLOWS,
            following.iter().all(|off| off.abs() < 0.01),
            format!(
                "C_T {:+.2} %, C_Q {:+.2} %",
                100.0 * following[0],
                100.0 * following[1]
            ),
        )
        .check(
            VEHICLE,
            worst_file < PRINTED,
            format!("largest relative difference {worst_file:.1e}"),
        )
        .check(
            SLOPE,
            slope.interval().upper < 0.0 && damping < PRINTED_DAMPING,
            format!(
                "dC_T/dJ = {}; damping of the file differs by {damping:.1e} of its value",
                words(&slope)
            ),
        ))
}

fn words(estimate: &Estimate) -> String {
    format!("{:.5} ± {:.5}", estimate.value, estimate.half_width()).replace('-', "−")
}
