use super::panel::ErrorBar;
use super::svg::Svg;
use super::*;

/// Largest SVG that a figure of the usual kind may make.
const LARGEST_SVG_BYTES: usize = 300_000;

fn five_levels(count: u32) -> Svg {
    let wave = |level: u8| {
        let times = (0..count).map(move |i| f64::from(i) * 20.0 / f64::from(count));
        times.map(move |t| (t, (t * f64::from(level)).sin() + 0.1 * (97.0 * t).sin()))
    };
    let panel = |label: &str| {
        let panel = Panel::new("Time *t*, s", label).horizontal(1.0, "limit");
        (1..=5).fold(panel, |panel, level| {
            panel.line(level_name(level), level_style(level), wave(level))
        })
    };
    Figure::columns(1)
        .panel(panel("Height *z*, m"))
        .panel(panel("Speed *ż*, m s⁻¹"))
        .share_x()
        .draw()
}

#[test]
fn prop_long_series_make_small_pictures() {
    let svg = five_levels(100_000).document();
    assert!(svg.len() < LARGEST_SVG_BYTES, "{} bytes", svg.len());
}

#[test]
fn prop_a_picture_does_not_depend_on_what_was_drawn_before() {
    assert_eq!(five_levels(500), five_levels(500));
}

#[test]
fn prop_every_level_keeps_its_colour_and_dash() {
    let svg = five_levels(500).document();
    for level in 1..=5 {
        let look = level_style(level);
        assert!(
            svg.contains(look.colour) && svg.contains(look.dash),
            "level {level}"
        );
    }
}

#[test]
fn prop_a_legend_names_each_series_once() {
    let svg = five_levels(50).document();
    for words in ["level 1", "level 5", "limit"] {
        assert_eq!(svg.matches(&format!(">{words}</text>")).count(), 1, "{words}");
    }
}

#[test]
fn prop_any_data_can_be_rasterised() {
    let rough = [
        (0.0, f64::NAN),
        (1.0, 2.0),
        (f64::INFINITY, 1.0),
        (-3.0, -1e9),
        (2.0, 1e-12),
    ];
    let bars = rough.map(|(x, y)| ErrorBar {
        x,
        y,
        half_width: 0.1,
    });
    let panel = || {
        Panel::new("*x*", "*y*")
            .line("a", level_style(1), rough)
            .error_bars("b", level_style(2), bars)
    };
    let empty = Panel::new("", "");
    let space =
        Space::new("*x*", "*y*", "*z*").line("c", level_style(3), [[0.0, f64::NAN, 1.0], [1.0, 1.0, 1.0]]);
    let figure = Figure::columns(2)
        .panel(panel())
        .panel(panel().log_x().log_y())
        .panel(empty)
        .panel(space);
    assert!(raster::png(&figure.draw()).is_ok());
}

#[test]
fn exact_one_unit_is_as_long_on_both_axes() {
    let circle = (0..=100)
        .map(|i| f64::from(i) * 0.062_84)
        .map(|a| (a.cos(), a.sin()));
    let square = Panel::new("*x*, m", "*y*, m")
        .line("", level_style(1), circle)
        .equal_aspect();
    let svg = Figure::columns(1)
        .panel(square)
        .panel_size(300.0, 200.0)
        .draw()
        .document();
    let path = svg
        .split("stroke=\"#0072b2\"")
        .next()
        .and_then(|head| head.rsplit("d=\"").next())
        .unwrap_or_default();
    let numbers: Vec<f64> = path
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|n| n.parse().ok())
        .collect();
    let extent = |first: usize| {
        let values = || numbers.iter().skip(first).step_by(2).copied();
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    // Coordinates are written with two decimals, and thinning moves the circle by less than a tenth of a pixel.
    assert!(
        extent(0) > 100.0 && (extent(0) - extent(1)).abs() < 0.2,
        "{} {}",
        extent(0),
        extent(1)
    );
}
