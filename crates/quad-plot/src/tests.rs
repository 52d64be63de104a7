use super::panel::{BandPoint, Bar, Cells, Contours, ErrorBar};
use super::svg::Svg;
use super::*;
use proptest::prelude::*;

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

/// Numbers as a careless caller has them: huge, tiny, equal, not finite.
fn rough() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>(),
        -10.0..10.0_f64,
        Just(1e308),
        Just(-f64::MAX),
        Just(5e-324),
        Just(0.0),
        Just(f64::NAN),
        Just(f64::INFINITY)
    ]
}

/// A panel with every kind of layer, from the same numbers.
fn everything(words: &str, data: &[f64]) -> Panel {
    let pairs = data.windows(2).map(|p| (p[0], p[1]));
    let look = level_style(1);
    let rows: Vec<Vec<f64>> = data.chunks(3).map(<[f64]>::to_vec).collect();
    let axis: Vec<f64> = data.iter().copied().take(3).collect();
    Panel::new(words, words)
        .caption(words)
        .line(words, look, pairs.clone())
        .markers(words, look, pairs.clone())
        .error_bars(
            words,
            look,
            pairs.clone().map(|(x, y)| ErrorBar { x, y, half_width: y }),
        )
        .band(
            words,
            look,
            pairs.clone().map(|(x, y)| BandPoint {
                x,
                lower: y,
                upper: x,
            }),
        )
        .bars(
            words,
            0.5,
            pairs.clone().map(|(x, height)| Bar {
                x,
                height,
                colour: style::BLUE,
            }),
        )
        .cells(Cells {
            x: axis.clone(),
            y: axis.clone(),
            fills: vec![vec![words.to_owned(); 3]; 3],
        })
        .contours(Contours {
            x: axis.clone(),
            y: axis.clone(),
            rows,
            levels: axis,
            fills: vec![words.to_owned(); 4],
            line: Some(look),
        })
        .horizontal(data[0], words)
        .vertical(data[0], words)
        .annotate(data[0], data[1], words)
}

/// Whether every number that a picture draws with is one that a renderer can read.
fn is_drawable(svg: &Svg) -> bool {
    let document = svg.document();
    !document.contains("NaN")
        && !document.contains("inf")
        && resvg::usvg::roxmltree::Document::parse(&document).is_ok()
}

proptest! {
    // Each case draws eight panels.
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn prop_any_numbers_and_words_make_a_valid_picture(
        words in "\\PC{0,12}",
        data in prop::collection::vec(rough(), 2..12),
        range in (rough(), rough()),
        step in rough(),
    ) {
        // The words NaN and inf are looked for below.
        let words = words.replace("NaN", "").replace("inf", "");
        let panel = || everything(&words, &data);
        let ranged = || panel().x_range(range.0, range.1).y_range(range.0, range.1).x_step(step).y_step(step);
        let points = data.windows(3).map(|p| [p[0], p[1], p[2]]);
        let space = Space::new(words.as_str(), "", "up").line(words.as_str(), level_style(2), points.clone()).markers("", level_style(3), points);
        let svg = Figure::columns(2)
            .panel(panel())
            .panel(panel().log_x().log_y())
            .panel(ranged())
            .panel(ranged().log_x().log_y())
            .panel(panel().equal_aspect())
            .panel(panel().x_categories([words.as_str(), "b"]))
            .panel(space.clone())
            .panel(space.equal_aspect().range(2, range.0, range.1))
            .draw();
        prop_assert!(is_drawable(&svg), "{}", svg.document());
    }

    #[test]
    fn prop_words_of_any_characters_stay_valid(words in prop::collection::vec(any::<char>(), 0..20)) {
        let words: String = words.into_iter().collect();
        let panel = Panel::new(words.as_str(), "").caption(words.as_str());
        let panel = panel.line(words, level_style(1), [(0.0, 0.0), (1.0, 1.0)]);
        let svg = Figure::columns(1).panel(panel).draw();
        prop_assert!(resvg::usvg::roxmltree::Document::parse(&svg.document()).is_ok());
    }
}

#[test]
fn prop_no_legend_is_wider_than_its_picture() {
    let names = [
        "a name",
        "a name that is much longer than the panel below it, which is narrow, but has to be read",
    ];
    for legends in [figure::Legends::Common, figure::Legends::EachPanel] {
        let panel = names
            .iter()
            .zip(1..)
            .fold(Panel::new("", ""), |panel, (name, level)| {
                panel.line(*name, level_style(level), [(0.0, 0.0), (1.0, 1.0)])
            });
        let svg = Figure::columns(1)
            .panel_size(200.0, 100.0)
            .panel(panel)
            .legends(legends)
            .draw();
        let widest = font::width(names[1], 11.0);
        assert!(svg.width > widest, "{} {widest}", svg.width);
    }
}
