//! Table 4.1: basic properties of the Qball-X4.

use super::supports;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use quad_dynamics::Vehicle;
use sysid::estimate::Estimate;
use sysid::laboratory::supports::SupportRig;

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-4.1",
    title: "Basic properties of the Qball-X4",
    description: "Mass and centre of mass as the support test of the virtual laboratory measures them, with 95 % intervals, \
                  beside the vehicle's true values; then the given data: the vendor's dimensions, the parts fitted and the ranges of \
                  the command and the battery, from the nominal parameter file. The thesis measured its own values, which are not available.",
    kind: Kind::Table,
    origin: Origin::VirtualLaboratory,
    claims: &[INSIDE],
    make: Make::Draw(draw),
};

const INSIDE: Claim =
    Claim::holds("the true mass lies inside at least 88 of the 95 % intervals of 100 tests with other noise");

struct Line {
    name: &'static str,
    unit: &'static str,
    value: f64,
    half_width: Option<f64>,
    truth: f64,
    from: &'static str,
}

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let test = supports::test(context, SupportRig::default())?;
    let gravity = test.vehicle.environment.gravity;
    let mass = test
        .found
        .weight
        .mapped(test.found.weight.value / gravity, 1.0 / gravity);
    let truth = test.vehicle.airframe.centre_of_mass;
    let measured = |name, unit, estimate: Estimate, truth, scale: f64| Line {
        name,
        unit,
        value: scale * estimate.value,
        half_width: Some(scale * estimate.half_width()),
        truth: scale * truth,
        from: "virtual support test",
    };
    let [x, y, z] = test.found.position;
    let mut lines = vec![
        measured("Mass *m*", "kg", mass, test.vehicle.airframe.mass, 1.0),
        measured("Centre of mass, forward", "mm", x, truth.x, 1e3),
        measured("Centre of mass, right", "mm", y, truth.y, 1e3),
        measured("Centre of mass, down", "mm", z, truth.z, 1e3),
    ];
    lines.extend(given(&test.vehicle)?);
    let mut shown = DisplayTable::new([
        "Property",
        "Value",
        "True value of the virtual vehicle",
        "Unit",
        "From",
    ]);
    let mut data = DataTable::new(["property", "value", "half_width", "truth", "unit", "from"]);
    for line in &lines {
        let value = line.half_width.map_or_else(
            || line.value.to_string(),
            |half| format!("{:.3} ± {half:.3}", line.value),
        );
        let truth = line
            .half_width
            .map_or_else(String::new, |_| format!("{:.3}", line.truth));
        let [value, truth] = [value, truth].map(|words| words.replace('-', "−"));
        shown.push([
            line.name.to_owned(),
            value,
            truth,
            line.unit.to_owned(),
            line.from.to_owned(),
        ]);
        data.push([
            line.name.replace('*', "").into(),
            line.value.into(),
            line.half_width.map_or_else(|| "".into(), Into::into),
            line.truth.into(),
            line.unit.into(),
            line.from.into(),
        ]);
    }
    let share = supports::coverage(context)?.weight;
    Ok(Drawing::table(shown).data(data).check(
        INSIDE,
        supports::EXPECTED.contains(&share),
        format!(
            "{:.0} of 100; here {:.4} ± {:.4} kg, true {:.4} kg",
            100.0 * share,
            mass.value,
            mass.half_width(),
            test.vehicle.airframe.mass
        ),
    ))
}

/// What is not measured here.
fn given(vehicle: &Vehicle) -> Result<Vec<Line>, ItemError> {
    let propeller = vehicle.require_propeller("table 4.1")?;
    let battery = vehicle.require_battery("table 4.1")?;
    let motor = vehicle.require_motor("table 4.1")?;
    let line = |name, value: f64, unit, from| Line {
        name,
        unit,
        value,
        half_width: None,
        truth: value,
        from,
    };
    let rpm = |rad_s: f64| (rad_s * 60.0 / std::f64::consts::TAU).round();
    Ok(vec![
        line(
            "Distance of a hub from the centre *L*",
            vehicle.airframe.arm_length,
            "m",
            "vendor",
        ),
        line(
            "Diameter of the propellers, APC slow flyer 10×4.7",
            propeller.diameter,
            "m",
            "manufacturer",
        ),
        line(
            "Velocity constant of the motors, E-flite Park 480",
            rpm(motor.velocity_constant),
            "rpm/V",
            "catalogue",
        ),
        line("Least command *ū*_{min}", vehicle.pwm.minimum, "–", "vendor"),
        line("Largest command *ū*_{max}", vehicle.pwm.maximum, "–", "vendor"),
        line(
            "Battery, 3S lithium-polymer, nominal voltage",
            battery.nominal_voltage,
            "V",
            "3.7 V per cell",
        ),
    ])
}
