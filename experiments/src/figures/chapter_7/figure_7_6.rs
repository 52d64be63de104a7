//! Figure 7.6: rotation of the energy transmission system with visual feedback.

use super::tracking::{self, Row, START, track};
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::style::{INK, Look};
use crate::plot::{Figure, Panel, reference_style, series_style};
use crate::station::{NOMINAL_STATION, load_station};
use ets::{ErrorDynamics, Ets, FrameClock};
use nalgebra::Vector2;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "7.6",
    title: "ETS rotation with visual feedback",
    description: "The target is at rest, [200, 100] px right of and below the image centre at the start; the nominal station turns to it: camera at 30 Hz with \
                  30 ms latency, gimbal with lag and limits, tracking error with two poles at −1/*T*, *T* = 0.2 s. (a) Path of the image, rows down as \
                  in the image; (b) image coordinates with the designed response; (c) angles of the platform; (d) its rates.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[ENDS],
    make: Make::Draw(draw),
};

const ENDS: Claim = Claim::holds("target ends at the image centre");

/// Within this the target is at the centre, px: what the designed response leaves, (1 + t/T) e^(−t/T) of 224 px at 15 T is 1e-3 px.
const AT_CENTRE_PX: f64 = 0.01;

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let station = load_station(context, NOMINAL_STATION)?;
    let ets = Ets::<f64>::new(&station);
    let clock = FrameClock::new(tracking::STEP_S, station.frames.rate, station.frames.latency)?;
    let rows = track(&ets, &clock);
    let column = |f: fn(&Row) -> f64| rows.iter().map(f).collect::<Vec<f64>>();
    let t = column(|r| r.t);
    let series = |f: fn(&Row) -> f64| t.iter().copied().zip(column(f)).collect::<Vec<_>>();
    let ErrorDynamics::SecondOrder {
        natural_frequency: w, ..
    } = station.tracker.dynamics
    else {
        return Err(ItemError::new(
            "figure 7.6 is described for second-order error dynamics",
        ));
    };
    let designed = |i: usize| {
        // The first frame arrives after the latency.
        let since = |t: f64| (t - station.frames.latency).max(0.0);
        t.iter()
            .map(move |&t| (t, START[i] * (1.0 + w * since(t)) * (-w * since(t)).exp()))
            .collect::<Vec<_>>()
    };
    let path = Panel::new("Image *r*_{1}, px", "Image −*r*_{2}, px")
        .line(
            "path",
            Look::solid(INK, 1.6),
            rows.iter().map(|r| (r.image.x, -r.image.y)),
        )
        .markers("start", series_style(1), [(START[0], -START[1])])
        .markers(
            "end",
            series_style(0),
            rows.last().map(|r| (r.image.x, -r.image.y)),
        )
        .horizontal(0.0, "")
        .vertical(0.0, "")
        .x_range(-320.0, 320.0)
        .y_range(-240.0, 240.0);
    let image = Panel::new("Time *t*, s", "Image *r*_{C}, px")
        .line("*r*_{1}", series_style(0), series(|r| r.image.x))
        .line("*r*_{2}", series_style(1), series(|r| r.image.y))
        .line("designed", reference_style(), designed(0))
        .line("", reference_style(), designed(1));
    let angles = Panel::new("Time *t*, s", "Angle, deg")
        .line(
            "pan *ψ*_{E}",
            series_style(0),
            series(|r| r.state.gimbal.pan.to_degrees()),
        )
        .line(
            "tilt *θ*_{E}",
            series_style(1),
            series(|r| r.state.gimbal.tilt.to_degrees()),
        );
    let rates = Panel::new("Time *t*, s", "Rate, deg s^{−1}")
        .line(
            "pan",
            series_style(0),
            series(|r| r.state.gimbal.pan_rate.to_degrees()),
        )
        .line(
            "tilt",
            series_style(1),
            series(|r| r.state.gimbal.tilt_rate.to_degrees()),
        );
    let figure = Figure::columns(2)
        .panel(path)
        .panel(image)
        .panel(angles)
        .panel(rates)
        .panel_size(280.0, 210.0)
        .legends(Legends::EachPanel);
    let end = rows.last().map_or(f64::NAN, |r| r.image.norm());
    let visible = rows.iter().all(|r| r.visible);
    Ok(Drawing::picture(figure.draw())
        .data(DataTable::from_columns(&[
            ("t_s", &t),
            ("r1_px", &column(|r| r.image.x)),
            ("r2_px", &column(|r| r.image.y)),
            ("pan_rad", &column(|r| r.state.gimbal.pan)),
            ("tilt_rad", &column(|r| r.state.gimbal.tilt)),
            ("pan_rate_rad_s", &column(|r| r.state.gimbal.pan_rate)),
            ("tilt_rate_rad_s", &column(|r| r.state.gimbal.tilt_rate)),
        ]))
        .settings(&toml::toml! { station = "stations/ets.toml" start_px = [200.0, 100.0] range_m = 5.0 step_s = 0.001 duration_s = 3.0 })?
        .check(
            ENDS,
            visible && end < AT_CENTRE_PX,
            format!("{end:.1e} px from the centre after 3 s, from {:.0} px", Vector2::from(START).norm()),
        ))
}
