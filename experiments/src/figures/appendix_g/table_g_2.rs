//! Table G.2: properties of the energy transmission system and its sensor, from the parameter file.

use super::table_g_1::{collect, escaped};
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::station::{NOMINAL_STATION, load_station};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-G.2",
    title: "Properties of the energy transmission system and its sensor",
    description: "Every number of the nominal station file with its unit in the key and its source, and derived values at the end. \
                  The thesis' own values are not available; these are the project's. The heading of 0° puts the stop of the pan axis, ±170°, in the south; the \
                  optimisations of chapter 7 turn the pedestal to 90° and so the stop to the west.",
    kind: Kind::Table,
    origin: Origin::Derived,
    claims: &[],
    make: Make::Draw(draw),
};

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    // Validate first: a table of a wrong file helps nobody.
    let station = load_station(context, NOMINAL_STATION)?;
    let text = std::fs::read_to_string(context.data(NOMINAL_STATION))?;
    let mut rows = Vec::new();
    collect("", &toml::Value::Table(text.parse::<toml::Table>()?), &mut rows);
    let light = station.beam.through(&station.atmosphere);
    let range = station.limits.range;
    let [wide, high] = station.camera.field_of_view().map(f64::to_degrees);
    for (key, value, source) in [
        (
            "focal_length_px",
            station.camera.focal_length,
            "focal length over pixel pitch",
        ),
        (
            "field_of_view_horizontal_deg",
            wide,
            "pixels, principal point and focal length",
        ),
        (
            "field_of_view_vertical_deg",
            high,
            "pixels, principal point and focal length",
        ),
        ("beam_quality", station.beam.quality(), "π w_0 θ / λ"),
        (
            "spot_radius_at_range_limit_m",
            light.radius_squared(range).sqrt(),
            "√(w_0² + θ² R²)",
        ),
        ("attenuation_per_km", 1e3 * light.attenuation, "visibility law"),
        (
            "sensor_area_m2",
            station.receiver.aperture.area(),
            "sides of the sensor",
        ),
    ] {
        rows.push((
            format!("derived.{key}"),
            format!("{value:.5}"),
            format!("derived: {source}"),
        ));
    }
    let mut shown = DisplayTable::new(["Property", "Value", "Source"]);
    let mut data = DataTable::new(["property", "value", "source"]);
    for (key, value, source) in rows {
        data.push([key.as_str().into(), value.as_str().into(), source.as_str().into()]);
        shown.push([escaped(&key), escaped(&value), escaped(&source)]);
    }
    Ok(Drawing::table(shown).data(data))
}
