//! The plot style on sample data: `cargo run -p quad-plot --example plot_style [folder]`.
//!
//! Draws step responses of five levels with errors beneath, a phase plane, measured points with a fit, and a
//! trajectory in space, as PNG and SVG.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use quad_plot::figure::Legends;
use quad_plot::panel::{BandPoint, ErrorBar};
use quad_plot::style::{BLUE, Marker};
use quad_plot::svg::Svg;
use quad_plot::{Figure, Look, Panel, Space, level_name, level_style, series_style};
use quad_plot::{raster, reference_style};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from("target/plot-style"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    save(&folder, "levels", &levels())?;
    save(&folder, "phase", &phase_plane())?;
    save(&folder, "points", &points())?;
    save(&folder, "space", &space())?;
    save(&folder, "grid", &grid())?;
    println!("drawn in {}", folder.display());
    Ok(())
}

fn save(folder: &Path, name: &str, svg: &Svg) -> Result<(), Box<dyn Error>> {
    std::fs::write(folder.join(format!("{name}.svg")), svg.document())?;
    std::fs::write(folder.join(format!("{name}.png")), raster::png(svg)?)?;
    Ok(())
}

fn times() -> impl Iterator<Item = f64> + Clone {
    (0..=4_000).map(|i| f64::from(i) * 1e-3)
}

/// A second-order step response whose damping falls with the level.
fn step(level: u8, t: f64) -> f64 {
    let (frequency, damping) = (4.0, 1.05 - 0.13 * f64::from(level));
    let damped = frequency * (1.0 - damping * damping).abs().sqrt();
    1.0 - (-damping * frequency * t).exp()
        * ((damped * t).cos() + damping * frequency / damped * (damped * t).sin())
}

fn levels() -> Svg {
    let mut height =
        Panel::new("", "Height *z*, m").line("reference", reference_style(), [(0.0, 1.0), (4.0, 1.0)]);
    let mut error = Panel::new("Time *t*, s", "Error *e*_{z}, m");
    for level in 1..=5 {
        height = height.line(
            level_name(level),
            level_style(level),
            times().map(|t| (t, step(level, t))),
        );
        error = error.line(
            level_name(level),
            level_style(level),
            times().map(|t| (t, step(level, t) - step(1, t))),
        );
    }
    Figure::columns(1).panel(height).panel(error).share_x().draw()
}

fn phase_plane() -> Svg {
    let mut panel = Panel::new("Height *z*, m", "Vertical speed *ż*, m s⁻¹").vertical(1.0, "set point");
    for level in [1, 3, 5] {
        let speed = |t: f64| (step(level, t + 1e-4) - step(level, t)) / 1e-4;
        panel = panel.line(
            level_name(level),
            level_style(level),
            times().map(|t| (step(level, t), speed(t))),
        );
    }
    Figure::columns(1).panel(panel).panel_size(330.0, 260.0).draw()
}

fn points() -> Svg {
    let measured = (2..=12).map(f64::from).map(|x| ErrorBar {
        x,
        y: x * x * 0.09 + 0.2 * (x * 2.0).sin(),
        half_width: 0.4,
    });
    let fit = |x: f64| 0.09 * x * x;
    let curve = (0..=130).map(|i| f64::from(i) * 0.1);
    let band = curve.clone().map(|x| BandPoint {
        x,
        lower: 0.94 * fit(x),
        upper: 1.06 * fit(x),
    });
    let linear = Panel::new("Rotor speed *Ω*, 10³ rpm", "Thrust *T*, N")
        .caption("linear axes")
        .band("95 % interval", Look::solid(BLUE, 1.0), band)
        .line(
            "fit *T* = *k*_{T} *Ω*^{2}",
            level_style(1),
            curve.clone().map(|x| (x, fit(x))),
        )
        .error_bars(
            "measured",
            level_style(2).marked(Marker::Circle),
            measured.clone(),
        );
    let log = Panel::new("Rotor speed *Ω*, 10³ rpm", "Thrust *T*, N")
        .caption("logarithmic axes")
        .log_x()
        .log_y()
        .line(
            "fit *T* = *k*_{T} *Ω*^{2}",
            level_style(1),
            curve.map(|x| (x, fit(x))),
        )
        .error_bars("measured", level_style(2).marked(Marker::Circle), measured);
    Figure::columns(2).panel(linear).panel(log).draw()
}

fn path(phase: f64) -> impl Iterator<Item = [f64; 3]> {
    (0..=2_000).map(|i| f64::from(i) / 2_000.0).map(move |s| {
        [
            4.0 * (TAU * s).cos() - 1.0,
            3.0 * (TAU * s + phase).sin(),
            1.0 + 2.0 * s + 0.1 * (9.0 * TAU * s).sin(),
        ]
    })
}

fn space() -> Svg {
    Space::new("North *x*, m", "West −*y*, m", "Height −*z*, m")
        .line("reference", reference_style(), path(0.0))
        .line("NDI", series_style(0), path(0.1))
        .line("PID", series_style(1), path(0.25))
        .markers("start", level_style(3), path(0.0).take(1))
        .draw()
}

fn grid() -> Svg {
    let panel = |level: u8| {
        let wave = times().map(move |t| (t, 1e-5 * f64::from(level) * (t * f64::from(level)).sin()));
        Panel::new("Time *t*, s", "Rate *θ̇*, rad s⁻¹")
            .caption(level_name(level))
            .line("*θ̇*_{c}", level_style(level), wave)
    };
    let space = Space::new("*x*, m", "*y*, m", "*h*, m")
        .line("", level_style(1), path(0.0))
        .caption("in space");
    let figure = (1..=5).fold(Figure::columns(3), |figure, level| figure.panel(panel(level)));
    figure.panel(space).legends(Legends::EachPanel).draw()
}
