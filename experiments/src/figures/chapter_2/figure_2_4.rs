//! Figure 2.4: transmittance of a laser wave through the atmosphere.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::figures::sweep;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::{Figure, Panel, series_style};
use crate::station::{NOMINAL_STATION, load_station};
use ets::{Atmosphere, VisibilityLaw};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "2.4",
    title: "Transmittance of a laser wave through the atmosphere",
    description: "Share of a 532 nm wave that is left after a range *R*, for several visibilities *V* (Kim's law), and the \
                  attenuation *β* against visibility in units of that at 550 nm, where Kruse's law and Kim's part. Beer-Lambert: \
                  *τ* = exp(−*β R*), *β* = (3.912/*V*)(*λ*/550 nm)^{−*q*(*V*)}.",
    kind: Kind::Plot,
    origin: Origin::Derived,
    claims: &[MONOTONE, BEER_LAMBERT, EVERYWHERE],
    make: Make::Draw(draw),
};

const MONOTONE: Claim = Claim::holds("monotone in range and visibility");
const BEER_LAMBERT: Claim = Claim::holds("agrees with the Beer-Lambert law");
const EVERYWHERE: Claim = Claim::does_not_hold(
    "both laws are monotone in visibility at every visibility",
    "their exponents are piecewise fits and step up at 50 km (both) and 6 km (Kruse), which at wavelengths below 550 nm raises the attenuation",
);

/// Visibilities drawn, km, from fog to clear air.
const VISIBILITIES_KM: [f64; 6] = [0.3, 1.0, 3.0, 6.0, 23.0, 50.0];

/// Attenuation at 532 nm by visibility, 1/km, worked out by hand from Kim, McArthur, Korevaar (2001), to six digits.
const BY_HAND: [(f64, f64); 3] = [(23.0, 0.177_606), (5.0, 0.812_649), (0.3, 13.04)];
/// Last digit of [`BY_HAND`], relative.
const PRINTED: f64 = 5e-6;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let wavelength = load_station(context, NOMINAL_STATION)?.beam.wavelength;
    let left = |km: f64, law, range_km: f64| {
        let visibility = 1e3 * km;
        Atmosphere { visibility, law }.transmittance(wavelength, 1e3 * range_km)
    };
    let ranges: Vec<f64> = sweep(0.01_f64.ln(), 50.0_f64.ln(), 200)
        .iter()
        .map(|r| r.exp())
        .collect();
    let mut by_range = Panel::new("Range *R*, km", "Transmittance *τ*")
        .y_range(0.0, 1.0)
        .x_range(0.01, 50.0)
        .log_x()
        .caption("Kim's law");
    let mut columns = vec![("range_km".to_owned(), ranges.clone())];
    for (i, &km) in VISIBILITIES_KM.iter().enumerate() {
        let tau: Vec<f64> = ranges.iter().map(|&r| left(km, VisibilityLaw::Kim, r)).collect();
        let points = ranges.iter().copied().zip(tau.iter().copied());
        by_range = by_range.line(format!("*V* = {km} km"), series_style(i), points);
        columns.push((format!("transmittance_v_{km}_km"), tau));
    }
    let visibilities: Vec<f64> = sweep(0.2_f64.ln(), 100.0_f64.ln(), 600)
        .iter()
        .map(|v| v.exp())
        .collect();
    let colour = |law| -> Vec<f64> {
        visibilities
            .iter()
            .map(|&v| -left(v, law, 1.0).ln() * v / 3.912)
            .collect()
    };
    let laws =
        [("Kruse", VisibilityLaw::Kruse), ("Kim", VisibilityLaw::Kim)].map(|(name, law)| (name, colour(law)));
    let mut by_law = Panel::new("Visibility *V*, km", "*β V* / 3.912")
        .log_x()
        .caption("attenuation, both laws");
    for (i, (name, values)) in laws.iter().enumerate() {
        by_law = by_law.line(
            *name,
            series_style(i),
            visibilities.iter().copied().zip(values.iter().copied()),
        );
    }
    let data: Vec<(&str, &[f64])> = columns.iter().map(|(n, v)| (n.as_str(), v.as_slice())).collect();
    let by_visibility = DataTable::from_columns(&[
        ("visibility_km", &visibilities),
        ("kruse", &laws[0].1),
        ("kim", &laws[1].1),
    ]);
    let figure = Figure::columns(2)
        .panel(by_range)
        .panel(by_law)
        .panel_size(290.0, 230.0)
        .legends(Legends::EachPanel);

    // Up to the last visibility drawn.
    let fine = sweep(0.2, 50.0, 5000);
    let in_visibility = rises(&fine, |v| left(v, VisibilityLaw::Kim, 1.0));
    let in_range = VISIBILITIES_KM.map(|km| rises(&ranges, |r| -left(km, VisibilityLaw::Kim, r)));
    let off = BY_HAND.map(|(km, beta)| (-left(km, VisibilityLaw::Kim, 2.0).ln() / 2.0 / beta - 1.0).abs());
    // The attenuation just above a step of the exponent over that just below it.
    let rise = |law, km: f64| 100.0 * (left(km * 1.000_001, law, 1.0).ln() / left(km, law, 1.0).ln() - 1.0);
    let rises_at = [
        rise(VisibilityLaw::Kruse, 6.0),
        rise(VisibilityLaw::Kruse, 50.0),
        rise(VisibilityLaw::Kim, 50.0),
    ];
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&data))
        .named_data("visibility", by_visibility)
        .settings(&toml::toml! { station = "stations/ets.toml" wavelength = "laser.wavelength_m" law = "kim" })?
        .check(
            MONOTONE,
            in_visibility && in_range.iter().all(|&r| r),
            "Kim's law from 0.2 to 50 km in 5000 steps, every curve over the range in 200 steps: never the wrong way",
        )
        .check(
            BEER_LAMBERT,
            off.iter().all(|&o| o < PRINTED),
            format!("−ln τ / R differs from the coefficients worked out by hand at 23, 5 and 0.3 km by {:.1e}, {:.1e}, {:.1e}", off[0], off[1], off[2]),
        )
        .check(
            EVERYWHERE,
            rises_at.iter().all(|&rise| rise <= 0.0),
            format!(
                "with growing visibility the attenuation steps up by {:.2} % at 6 km and {:.2} % at 50 km (Kruse), {:.2} % at 50 km (Kim)",
                rises_at[0], rises_at[1], rises_at[2]
            ),
        ))
}

/// Whether a function grows strictly from each point to the next.
fn rises(at: &[f64], f: impl Fn(f64) -> f64) -> bool {
    at.windows(2).all(|pair| f(pair[1]) > f(pair[0]))
}
