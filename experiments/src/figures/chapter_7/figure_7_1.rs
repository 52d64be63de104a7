//! Figure 7.1: overfill of the sensor.

use super::growth;
use super::overfill::{self, Overfill};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::{glyphs, sweep};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::panel::Contours;
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, series_style};
use crate::station::{NOMINAL_STATION, load_station};
use ets::Station;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.1",
    title: "Overfill of the sensor",
    description: "Light that passes the sensor is a hazard. Above: the sensor seen along *e*_{2}, under a beam of radius *w* with spot offset *s* and \
                  incidence *α*. (a) Irradiance on the plane of the nominal sensor at the range limit, 8 m, *s* = [0.12, 0.03] m, \
                  *α* = 40°; contours at 1, 10, 30, 50, 70 and 90 % of the peak; what lies right of the edge is missed. (b) Missed power against the spot offset along *e*_{1} for several angles of incidence.",
    kind: Kind::Plot,
    origin: Origin::Derived,
    claims: &[GROWS],
    make: Make::Draw(draw),
};

const GROWS: Claim = Claim::holds("power missing the receiver grows with spot offset and incidence");

/// Angles of incidence drawn, degrees; the study's limit is 40.
const INCIDENCES_DEG: [f64; 4] = [0.0, 20.0, 40.0, 60.0];
/// Spot of the map, m, and its incidence, degrees.
const MAP_SPOT: [f64; 2] = [0.12, 0.03];
const MAP_INCIDENCE_DEG: f64 = 40.0;
/// Half the side of the map about the spot, m.
const MAP: f64 = 0.075;
/// Where words stand beside the edge, m.
const MISSED: [f64; 2] = [0.1725, 0.09];
const CAUGHT: [f64; 2] = [0.1, 0.09];
/// Contours of the map, shares of the peak.
const CONTOURS: [f64; 6] = [0.01, 0.1, 0.3, 0.5, 0.7, 0.9];
/// Colours of the bands between them, the faintest first.
const BANDS: [&str; 7] = [
    "#ffffff", "#fef3e2", "#fee3bd", "#fdc68c", "#fc9a63", "#ec5f42", "#b8241c",
];

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let station = load_station(context, NOMINAL_STATION)?;
    let missed = |offset: f64, deg: f64| {
        Overfill::new(&station, deg.to_radians(), [offset, 0.0])
            .budget(&station)
            .missed
    };
    let offsets = sweep(0.0, 0.25, 125);
    let mut columns = vec![("spot_offset_m".to_owned(), offsets.clone())];
    let mut lines = Panel::new("Spot offset *s*_{1}, m", "Missed power, W")
        .log_y()
        .x_range(0.0, 0.25)
        .y_range(1e-5, 10.0)
        .vertical(station.limits.spot, "limit, edge");
    for (i, &deg) in INCIDENCES_DEG.iter().enumerate() {
        let values: Vec<f64> = offsets.iter().map(|&e| missed(e, deg)).collect();
        // Below the promise of the quadrature there is only rounding.
        let floor = growth::QUADRATURE * station.beam.power;
        let seen = offsets
            .iter()
            .copied()
            .zip(values.iter().copied())
            .filter(|p| p.1 > floor);
        lines = lines.line(format!("*α* = {deg}°"), series_style(i), seen);
        columns.push((format!("missed_w_{deg}_deg"), values));
    }
    let figure = Figure::columns(2)
        .panel(map(&station))
        .panel(lines)
        .panel_size(250.0, 250.0)
        .legends(Legends::EachPanel);
    let data: Vec<(&str, &[f64])> = columns.iter().map(|(n, v)| (n.as_str(), v.as_slice())).collect();
    let check = growth::within_the_limits(&station, &missed);
    Ok(Drawing::picture(overfill::sketch().above(&figure.draw()))
        .data(DataTable::from_columns(&data))
        .settings(&toml::toml! { station = "stations/ets.toml" range = "limits.range_m" })?
        .check(GROWS, check.holds, check.measured)
        .note(
            "past the edge of the sensor, where the spot's centre itself misses, a more oblique sensor catches more of the spot's tail: \
             the curves cross at the edge, which is the study's limit",
        ))
}

/// The irradiance on the sensor's plane with the sensor's outline.
fn map(station: &Station) -> Panel {
    let scene = Overfill::new(station, MAP_INCIDENCE_DEG.to_radians(), MAP_SPOT);
    let [xs, ys] = MAP_SPOT.map(|centre| sweep(centre - MAP, centre + MAP, 120));
    let peak = scene.on_plane(station, MAP_SPOT);
    let grid: Vec<Vec<f64>> = ys
        .iter()
        .map(|&y| {
            xs.iter()
                .map(|&x| scene.on_plane(station, [x, y]) / peak)
                .collect()
        })
        .collect();
    let outline = glyphs::outline(&station.receiver.aperture)
        .into_iter()
        .map(|[x, y]| (x, y));
    Panel::new("Along *e*_{1}, m", "Along *e*_{2}, m")
        .contours(Contours {
            x: xs,
            y: ys,
            rows: grid,
            levels: CONTOURS.to_vec(),
            fills: BANDS.map(str::to_owned).to_vec(),
            line: Some(Look::solid(INK, 0.8)),
        })
        .line("edge of the sensor", Look::solid(INK, 2.4), outline)
        .x_range(MAP_SPOT[0] - MAP, MAP_SPOT[0] + MAP)
        .y_range(MAP_SPOT[1] - MAP, MAP_SPOT[1] + MAP)
        .x_step(0.05)
        .y_step(0.05)
        .annotate(MISSED[0], MISSED[1], "missed")
        .annotate(CAUGHT[0], CAUGHT[1], "on the sensor")
}
