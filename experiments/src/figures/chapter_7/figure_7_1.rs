//! Figure 7.1: overfill of the sensor.

use super::overfill::{self, Overfill};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::{glyphs, sweep};
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, series_style};
use crate::station::{NOMINAL_STATION, load_station};
use ets::Station;
use kuva::plot::{ColorMap, ContourPlot};
use kuva::render::plots::Plot;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.1",
    title: "Overfill of the sensor",
    description: "Light that passes the sensor is a hazard. Above: the sensor seen along *e*_{2}, under a beam of radius *w* with spot offset *e*_{s} and \
                  incidence *α*. (a) Irradiance on the plane of the nominal sensor (square) at the range limit, 8 m, *e*_{s} = [0.12, 0.03] m, \
                  *α* = 40°. (b) Missed power against the spot offset along *e*_{1} for several angles of incidence.",
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
/// Half the side of the map, m.
const MAP: f64 = 0.24;
/// Twice what the quadrature promises, per watt of the beam.
const QUADRATURE: f64 = 2e-7;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let station = load_station(context, NOMINAL_STATION)?;
    let missed = |offset: f64, deg: f64| {
        Overfill::new(&station, deg.to_radians(), [offset, 0.0])
            .budget(&station)
            .missed
    };
    let offsets = sweep(0.0, 0.25, 125);
    let mut columns = vec![("spot_offset_m".to_owned(), offsets.clone())];
    let mut lines = Panel::new("Spot offset *e*_{s1}, m", "Missed power, W")
        .log_y()
        .y_range(1e-6, 10.0)
        .vertical(station.limits.spot, "limit and edge");
    for (i, &deg) in INCIDENCES_DEG.iter().enumerate() {
        let values: Vec<f64> = offsets.iter().map(|&e| missed(e, deg)).collect();
        // Below the promise of the quadrature there is only rounding.
        let floor = QUADRATURE * station.beam.power;
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
    let check = growth(&station, &missed);
    Ok(Drawing::picture(overfill::sketch().above(&figure.draw()))
        .data(DataTable::from_columns(&data))
        .scenario(&toml::toml! { station = "stations/ets.toml" range = "limits.range_m" })?
        .check(GROWS, check.holds, check.measured)
        .note(
            "past the edge of the sensor, where the spot's centre itself misses, a more oblique sensor catches more of the spot's tail: \
             the curves cross at the edge",
        ))
}

struct Growth {
    holds: bool,
    measured: String,
}

/// Over the study's limits in steps of 3 mm and 1°: no step down beyond the quadrature, and a rise from each end to the other.
fn growth(station: &Station, missed: &impl Fn(f64, f64) -> f64) -> Growth {
    let limits = &station.limits;
    let (offsets, angles) = (
        sweep(0.0, limits.spot, 50),
        sweep(0.0, limits.incidence.to_degrees(), 40),
    );
    let grid: Vec<Vec<f64>> = angles
        .iter()
        .map(|&a| offsets.iter().map(|&e| missed(e, a)).collect())
        .collect();
    let mut least = f64::INFINITY;
    for i in 0..grid.len() {
        for j in 0..offsets.len() {
            if j > 0 {
                least = least.min(grid[i][j] - grid[i][j - 1]);
            }
            if i > 0 {
                least = least.min(grid[i][j] - grid[i - 1][j]);
            }
        }
    }
    // Offset 0.12 m: inside the sensor, where the spot's edge reaches past its own.
    let (square, oblique) = (
        missed(0.8 * limits.spot, 0.0),
        missed(0.8 * limits.spot, limits.incidence.to_degrees()),
    );
    let (centred, edge) = (grid[0][0], grid[0][offsets.len() - 1]);
    let noise = QUADRATURE * station.beam.power;
    Growth {
        holds: least >= -noise && oblique > square + noise && edge > centred + noise,
        measured: format!(
            "within the limits (0.15 m, 40°) no step falls by more than {:.0e} W; {centred:.1e} W centred, {edge:.2} W at the limit of offset; at 0.12 m \
             {square:.4} W at 0° and {oblique:.4} W at 40°",
            (-least).max(0.0)
        ),
    }
}

/// The irradiance on the sensor's plane with the sensor's outline.
fn map(station: &Station) -> Panel {
    let scene = Overfill::new(station, MAP_INCIDENCE_DEG.to_radians(), MAP_SPOT);
    let places = sweep(-MAP, MAP, 120);
    let grid: Vec<Vec<f64>> = places
        .iter()
        .map(|&y| {
            places
                .iter()
                .map(|&x| scene.on_plane(station, [x, y]) * 1e-3)
                .collect()
        })
        .collect();
    let outline = glyphs::outline(&station.receiver.aperture)
        .into_iter()
        .map(|[x, y]| (x, y));
    Panel::new("Along *e*_{1}, m", "Along *e*_{2}, m")
        .kuva(move || {
            let plot = ContourPlot::new()
                .with_grid(grid.clone(), places.clone(), places.clone())
                .with_n_levels(8)
                .with_filled()
                .with_colormap(ColorMap::YellowOrangeRed);
            Plot::Contour(plot)
        })
        .line("sensor", Look::solid(INK, 1.6), outline)
        .x_range(-MAP, MAP)
        .y_range(-MAP, MAP)
}
