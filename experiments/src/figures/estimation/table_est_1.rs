//! Table est.1: the numbers behind figure est.1, consistency, the unscented filter, and the filter in the loop.

use super::study::{KindOfFilter, Row, Study};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Level;
use quad_estimation::sensor::Quality;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-est.1",
    title: "State estimation: errors and consistency by the filter's level and by the quality of its sensors",
    description: "Root mean square errors on flights of level 5; normalised estimation error squared (NEES) of the rigid body at the end, per \
                  degree of freedom, and normalised innovations squared (NIS) per reading: both 1 for a consistent filter. \
                  Factors are those on the truth's noise of rates and disturbance. Four flights; one for the unscented filter.",
    kind: Kind::Table,
    origin: Origin::Simulated,
    claims: &[MATCHED, IN_LOOP],
    make: Make::Draw(draw),
};

const MATCHED: Claim = Claim::holds(
    "the extended filter on the truth's own level is consistent: NEES and NIS within their central 99.9 % with every quality of sensors",
);
const IN_LOOP: Claim = Claim::holds(
    "the vehicle is flown by level 5's estimate with every quality of sensors, and tracks to within three times its estimate's error and the \
     truth's own tracking error together",
);

/// Errors of the rigid body.
const FREEDOM: f64 = 12.0;

/// Whether a sum of squares is within the central 99.9 % of χ².
fn within(sum: f64, freedom: f64) -> Result<bool, ItemError> {
    let chi = ChiSquared::new(freedom)?;
    Ok((chi.inverse_cdf(0.0005)..chi.inverse_cdf(0.9995)).contains(&sum))
}

fn nees(row: &Row) -> f64 {
    row.nees / (FREEDOM * row.flights as f64)
}

fn nis(row: &Row) -> f64 {
    row.told.nis / row.told.readings as f64
}

fn name(row: &Row) -> String {
    match row.kind {
        KindOfFilter::Extended => row.level.to_string(),
        KindOfFilter::Unscented => format!("{}, unscented", row.level),
    }
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let study = Study::of(context)?;
    let mut shown = DisplayTable::new([
        "Sensors",
        "Filter",
        "Position, m",
        "Velocity, m/s",
        "Tilt, °",
        "Heading, °",
        "NEES",
        "NIS",
        "Factors",
    ]);
    let mut data = DataTable::new([
        "sensors",
        "filter",
        "position_m",
        "velocity_m_s",
        "tilt_rad",
        "heading_rad",
        "nees",
        "nis",
        "factor_rates",
        "factor_disturbance",
    ]);
    for row in &study.rows {
        let [position, velocity, tilt, heading] = row.errors;
        shown.push([
            row.quality.name().to_owned(),
            name(row),
            format!("{position:.4}"),
            format!("{velocity:.4}"),
            format!("{:.3}", tilt.to_degrees()),
            format!("{:.3}", heading.to_degrees()),
            format!("{:.2}", nees(row)),
            format!("{:.3}", nis(row)),
            format!("{}, {}", row.factors[0], row.factors[1]),
        ]);
        data.push([
            row.quality.name().into(),
            name(row).as_str().into(),
            position.into(),
            velocity.into(),
            tilt.into(),
            heading.into(),
            nees(row).into(),
            nis(row).into(),
            row.factors[0].into(),
            row.factors[1].into(),
        ]);
    }
    let (mut consistent, mut words) = (true, Vec::new());
    for quality in Quality::ALL {
        let row = study.extended(quality, Level::Five)?;
        consistent &= within(row.nees, FREEDOM * row.flights as f64)?;
        consistent &= within(row.told.nis, row.told.readings as f64)?;
        words.push(format!(
            "{}: {:.2} and {:.3}",
            quality.name(),
            nees(row),
            nis(row)
        ));
    }
    let (mut flown, mut tracked) = (true, Vec::new());
    for t in &study.tracking {
        let error = study.extended(t.quality, Level::Five)?.errors[0];
        flown &= t.by_estimate < 3.0 * error.hypot(t.by_truth);
        tracked.push(format!(
            "{}: {:.3} m by the estimate, {:.3} m by the truth",
            t.quality.name(),
            t.by_estimate,
            t.by_truth
        ));
    }
    Ok(Drawing::table(shown)
        .data(data)
        .check(
            MATCHED,
            consistent,
            format!("NEES and NIS per degree of freedom, {}", words.join("; ")),
        )
        .check(IN_LOOP, flown, tracked.join("; ")))
}
