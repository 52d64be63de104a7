//! Table B.1: specification of a motion-capture camera.

use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};

/// The table.
pub(super) const ITEM: Item = Item {
    id: "table-B.1",
    title: "Specification of the motion-capture system",
    description: "Values of a camera of the time, OptiTrack V100:R2 (NaturalPoint; later sold as Flex 3), from memory of its data sheet, which is no longer \
                  public, so that they could not be checked. A substitute: the source's \
                  laboratory had a system of this maker, but its model and values are not available. The last two rows follow from the ones above.",
    kind: Kind::Table,
    origin: Origin::DataSheet,
    claims: &[],
    make: Make::Draw(draw),
};

/// Pixels across, and the horizontal field of view, degrees.
const PIXELS: f64 = 640.0;
const FIELD_DEG: f64 = 46.0;
/// Where a value comes from.
const UNCHECKED: &str = "data sheet, not verified";
const DERIVED: &str = "resolution and field of view";
/// A distance in a laboratory, m.
const DISTANCE_M: f64 = 4.0;

fn draw(_context: &Context) -> Result<Drawing, ItemError> {
    let half = (0.5 * FIELD_DEG).to_radians().tan();
    let width_m = 2.0 * DISTANCE_M * half;
    let rows = [
        ("Resolution", "640 × 480".to_owned(), "pixels", UNCHECKED),
        ("Frame rate", "100".to_owned(), "frames/s", UNCHECKED),
        ("Latency", "10".to_owned(), "ms", UNCHECKED),
        (
            "Horizontal field of view, standard lens",
            format!("{FIELD_DEG:.0}"),
            "°",
            UNCHECKED,
        ),
        ("Shutter", "global".to_owned(), "–", UNCHECKED),
        ("Illumination", "850".to_owned(), "nm, infrared", UNCHECKED),
        ("Interface", "USB 2.0".to_owned(), "–", UNCHECKED),
        ("Width seen at 4 m", format!("{width_m:.2}"), "m", DERIVED),
        (
            "Width of a pixel at 4 m",
            format!("{:.1}", 1e3 * width_m / PIXELS),
            "mm",
            DERIVED,
        ),
    ];
    let mut shown = DisplayTable::new(["Property", "Value", "Unit", "From"]);
    let mut data = DataTable::new(["property", "value", "unit", "from"]);
    for (name, value, unit, from) in rows {
        data.push([name.into(), value.as_str().into(), unit.into(), from.into()]);
        shown.push([name.to_owned(), value, unit.to_owned(), from.to_owned()]);
    }
    Ok(Drawing::table(shown).data(data))
}
