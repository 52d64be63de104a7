//! Table 4.2: measured moments of inertia against the vendor's.

use super::{bench, pendulums};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::vehicle::load_vehicle;
use sysid::estimate::Estimate;
use sysid::laboratory::pendulum::Axis;

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.2",
    title: "Measured moments of inertia against the vendor's",
    description: "Moments of inertia by the bifilar pendulum in the virtual laboratory, with 95 % intervals: the non-linear equation \
                  fitted to a swing from 40°, and the small-angle law with four timings of 20 periods from 3°. The virtual vehicle has \
                  the vendor's values, so that agreement tests the method, not the vendor. The intervals hold the scatter alone: strings that are a millimetre farther \
                  apart on either side than the 0.2 m believed make 1 % more. The last two rows are real timings of **another** \
                  quadcopter (0.958 kg; marcv81, 'Moment of inertia', 2014), its published values in the vendor's column.",
    kind: Kind::Table,
    origin: Origin::VirtualLaboratory,
    claims: &[FITTED, TIMED, PUBLISHED],
    make: Make::Draw(draw),
};

const FITTED: Claim = Claim::holds(
    "the vendor's value lies inside 90 to 99 % of the 95 % intervals of 120 tests with other noise: fitted equation",
);
const TIMED: Claim = Claim::holds(
    "the vendor's value lies inside 90 to 99 % of the 95 % intervals of 120 tests with other noise: small-angle law",
);
const PUBLISHED: Claim = Claim::holds(
    "the real timings give the published moments of inertia of the other quadcopter, to their last digit",
);

const VENDOR_VEHICLE: &str = "vehicles/qball-x4-vendor.toml";
/// Tests about each axis that are counted. Of 120 intervals of 95 %, 90 to 99 % hit in 98 of 100 such counts.
const REPETITIONS: u64 = 40;

fn printed(estimate: &Estimate) -> String {
    format!("{:.4} ± {:.4}", 1e2 * estimate.value, 1e2 * estimate.half_width())
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = bench::vehicle(context)?;
    let vendor = load_vehicle(context, VENDOR_VEHICLE)?;
    let mut shown = DisplayTable::new([
        "Moment of inertia, 10^{−2} kg m^{2}",
        "Fitted equation",
        "Small-angle law",
        "Vendor",
        "Fitted less vendor",
    ]);
    let mut data = DataTable::new([
        "quantity",
        "fitted_kg_m2",
        "fitted_half_width_kg_m2",
        "timed_kg_m2",
        "timed_half_width_kg_m2",
        "stated_kg_m2",
    ]);
    for (axis, name) in Axis::ALL.into_iter().zip(["*I*_{xx}", "*I*_{yy}", "*I*_{zz}"]) {
        let fitted = pendulums::fitted(&vehicle, axis, 0)?;
        let timed = pendulums::timed(&vehicle, axis, 0)?;
        let stated = axis.inertia(&vendor);
        shown.push([
            format!("{name}, virtual Qball-X4"),
            printed(&fitted),
            printed(&timed),
            format!("{:.3}", 1e2 * stated),
            format!("{:+.3} %", 100.0 * (fitted.value / stated - 1.0)).replace('-', "−"),
        ]);
        data.push([
            name.replace('*', "").into(),
            fitted.value.into(),
            fitted.half_width().into(),
            timed.value.into(),
            timed.half_width().into(),
            stated.into(),
        ]);
    }
    let mut digits_off = 0.0_f64;
    for other in &pendulums::PUBLISHED {
        let timed = other.timed()?;
        shown.push([
            other.name.to_owned(),
            "–".to_owned(),
            printed(&timed),
            format!("{:.2}", 1e2 * other.inertia),
            "–".to_owned(),
        ]);
        data.push([
            other.name.replace('*', "").into(),
            "".into(),
            "".into(),
            timed.value.into(),
            timed.half_width().into(),
            other.inertia.into(),
        ]);
        digits_off = digits_off.max((timed.value - other.inertia).abs());
    }
    let within = |share: f64| (0.90..=0.99).contains(&share);
    let words = |share: f64| format!("{:.1} % of the intervals", 100.0 * share);
    let by_fit = pendulums::coverage(&vehicle, pendulums::fitted, REPETITIONS)?;
    let by_timing = pendulums::coverage(&vehicle, pendulums::timed, REPETITIONS)?;
    Ok(Drawing::table(shown)
        .data(data)
        .check(FITTED, within(by_fit), words(by_fit))
        .check(TIMED, within(by_timing), words(by_timing))
        // Half a unit of the last digit published.
        .check(
            PUBLISHED,
            digits_off < 5e-5,
            format!("furthest {:.1}·10⁻⁵ kg m² away", 1e5 * digits_off),
        ))
}
