//! The nominal file, and one test per class of mistake: the error has the file, the key and the number.

use super::{NOMINAL_TOML, Station, StationError, StationFile};
use crate::{Aperture, ErrorDynamics, VisibilityLaw};
use provenance::RangeError;

const FILE: &str = "broken.toml";

/// The error of the nominal file with one piece of text replaced.
fn broken(from: &str, to: &str) -> StationError {
    assert!(
        NOMINAL_TOML.contains(from),
        "`{from}` is not in the file, so the test would prove nothing"
    );
    Station::from_toml_str(&NOMINAL_TOML.replacen(from, to, 1), FILE).expect_err(to)
}

/// The error of the nominal file with the value of a key in a table replaced.
fn with_value(table: &str, key: &str, value: &str) -> StationError {
    let start = NOMINAL_TOML.find(&format!("[{table}]")).expect("table");
    let (before, after) = NOMINAL_TOML.split_at(start);
    let at = after.find(&format!("\n{key} = ")).expect("key") + 1;
    let (head, tail) = after.split_at(at);
    let rest = &tail[tail.find('\n').unwrap_or(tail.len())..];
    Station::from_toml_str(
        &format!("{before}{head}{key} = {{ value = {value}, source = \"test\" }}{rest}"),
        FILE,
    )
    .expect_err(value)
}

#[test]
fn exact_the_nominal_station_is_read_in_si_units_and_rad() {
    let station = Station::nominal();
    assert_eq!(station.beam.wavelength, 532e-9);
    assert_eq!(station.atmosphere.law, VisibilityLaw::Kim);
    assert!((station.gimbal.pan.rate_limit - 120.0 * std::f64::consts::PI / 180.0).abs() < 1e-15);
    assert!((station.camera.focal_length - 4000.0 / 6.0).abs() < 1e-9);
    // The kinematic study's limits.
    let limits = station.limits;
    assert_eq!(
        (limits.range, limits.incidence, limits.spot),
        (8.0, 40.0_f64.to_radians(), 0.15)
    );
    assert_eq!(
        station.receiver.aperture,
        Aperture::Rectangle {
            half_width: 0.15,
            half_height: 0.15
        }
    );
    let ErrorDynamics::SecondOrder {
        natural_frequency,
        damping,
    } = station.tracker.dynamics
    else {
        panic!()
    };
    assert_eq!((natural_frequency, damping), (5.0, 1.0));
}

#[test]
fn prop_the_file_survives_a_round_trip() {
    let file = StationFile::from_toml_str(NOMINAL_TOML, FILE).unwrap();
    let text = toml::to_string(&file).unwrap();
    assert_eq!(StationFile::from_toml_str(&text, FILE).unwrap(), file);
}

#[test]
fn exact_a_disc_and_first_order_are_read() {
    let text = NOMINAL_TOML
        .replace("width_m = { value = 0.3", "radius_m = { value = 0.1")
        .lines()
        .filter(|line| !line.starts_with("height_m"))
        .collect::<Vec<_>>()
        .join("\n")
        .replace("value = \"second\"", "value = \"first\"");
    let station = Station::from_toml_str(&text, FILE).unwrap();
    assert_eq!(station.receiver.aperture, Aperture::Disc { radius: 0.1 });
    assert_eq!(
        station.tracker.dynamics,
        ErrorDynamics::FirstOrder { time_constant: 0.2 }
    );
}

#[test]
fn exact_mistakes_of_the_text_name_file_line_and_key() {
    let line_of = |words: &str| {
        NOMINAL_TOML[..NOMINAL_TOML.find(words).unwrap()]
            .matches('\n')
            .count()
            + 1
    };
    for (from, to, expected_key, words) in [
        ("power_w = ", "power_kw = ", "laser.power_kw", "unknown key"),
        (
            "frame_rate_hz = { value = 30.0",
            "frame_rate_hz = { value = \"fast\"",
            "camera.frame_rate_hz.value",
            "invalid type",
        ),
        (
            "law = { value = \"kim\"",
            "law = { value = \"mie\"",
            "atmosphere.law.value",
            "unknown variant",
        ),
        (
            "source = \"choice: zero pan looks north\"",
            "source = \" \"",
            "pedestal.heading_deg.source",
            "source is empty",
        ),
    ] {
        let error = broken(from, to);
        let StationError::Read(error) = &error else {
            panic!("{error:?}")
        };
        let position = error.place().position.unwrap();
        assert_eq!(
            (error.place().origin.as_str(), error.key(), position.line),
            (FILE, Some(expected_key), line_of(from))
        );
        assert!(error.to_string().contains(words), "{error}");
    }
    let missing = broken(
        "power_w = { value = 5.0, source = \"assumption: a compact continuous 532 nm module\" }",
        "",
    );
    assert!(
        missing.to_string().contains("missing key `laser.power_w`"),
        "{missing}"
    );
    let syntax = Station::from_toml_str("name = \"x\"\npower = = 2\n", FILE).unwrap_err();
    assert!(syntax.to_string().contains(":2:9: not valid TOML"), "{syntax}");
}

#[test]
fn exact_numbers_out_of_range_name_file_key_and_value() {
    for (table, key, value, expected) in [
        ("pan", "time_constant_s", "-0.05", -0.05),
        ("tilt", "rate_limit_deg_s", "0.0", 0.0),
        ("camera", "focal_length_m", "-0.004", -0.004 / 6e-6),
        ("camera", "frame_rate_hz", "0.0", 0.0),
        ("camera", "noise_px", "-1.0", -1.0),
        ("tracker", "time_constant_s", "0.0", 0.0),
        ("tracker", "fading", "1.0", 1.0),
        ("tracker", "hold_s", "-0.5", -0.5),
        ("laser", "power_w", "0.0", 0.0),
        ("laser", "wavelength_m", "532.0", 532.0),
        ("laser", "waist_radius_m", "inf", f64::INFINITY),
        ("atmosphere", "visibility_m", "0.0", 0.0),
        ("receiver", "width_m", "0.0", 0.0),
        ("receiver", "efficiency", "20.0", 20.0),
        ("limits", "incidence_deg", "0.0", 0.0),
    ] {
        let error = with_value(table, key, value);
        let StationError::Range {
            origin,
            key: found,
            error: range,
        } = &error
        else {
            panic!("{table}.{key}: {error:?}")
        };
        let (RangeError::NotFinite { value: number, .. } | RangeError::Outside { value: number, .. }) = range;
        assert_eq!(
            (origin.as_str(), *found),
            (FILE, format!("{table}.{key}").as_str())
        );
        // Degrees pass through rad and back, a length through a quotient.
        assert!(
            *number == expected || (number / expected - 1.0).abs() < 1e-12,
            "{number} {expected}"
        );
        assert!(
            error.to_string().contains(FILE) && error.to_string().contains(found),
            "{error}"
        );
    }
    let nan = with_value("laser", "power_w", "nan");
    assert!(
        matches!(nan, StationError::Range { error: RangeError::NotFinite { value, .. }, .. } if value.is_nan()),
        "{nan:?}"
    );
    let hint = with_value("laser", "wavelength_m", "532.0").to_string();
    assert!(hint.ends_with("is this in nanometres?"), "{hint}");
}

#[test]
fn exact_numbers_that_contradict_each_other_are_refused() {
    let travel = with_value("tilt", "minimum_deg", "91.0");
    assert!(
        matches!(travel, StationError::NoTravel { axis: "tilt", .. }),
        "{travel:?}"
    );
    let point = with_value("camera", "principal_point_px", "[320, 500]");
    assert!(
        matches!(
            point,
            StationError::PrincipalPoint {
                point: [320.0, 500.0],
                ..
            }
        ),
        "{point:?}"
    );
    let wide = with_value("camera", "focal_length_m", "0.0009");
    assert!(
        matches!(wide, StationError::TooWide { slope, .. } if (slope - 320.0 / 150.0).abs() < 1e-12),
        "{wide:?}"
    );
    let late = with_value("camera", "latency_s", "0.05");
    assert!(
        matches!(late, StationError::Frames { .. }) && late.to_string().contains("one frame"),
        "{late}"
    );
    let hold = with_value("tracker", "hold_s", "0.09");
    // 2/30 s and 30 ms.
    assert!(
        matches!(hold, StationError::HoldTooShort { least_s, .. } if (least_s - (2.0 / 30.0 + 0.03)).abs() < 1e-12),
        "{hold:?}"
    );
    let gaps = with_value("tracker", "search_pitch_deg", "41.0");
    assert!(
        matches!(gaps, StationError::SearchGaps { pitch_deg, .. } if (pitch_deg - 41.0).abs() < 1e-9),
        "{gaps:?}"
    );
    let tight = with_value("laser", "divergence_rad", "1e-6");
    // λ/(πw_0) = 532 nm/(π 10 mm).
    assert!(
        matches!(tight, StationError::BelowDiffraction { limit_rad, .. } if (limit_rad - 1.693_408_6e-5).abs() < 1e-11),
        "{tight:?}"
    );
    let normal = with_value("receiver", "normal", "[1.0, 1.0, 0.0]");
    assert!(
        matches!(normal, StationError::NotUnit { length, .. } if (length - 2.0_f64.sqrt()).abs() < 1e-12),
        "{normal:?}"
    );
    let both = broken(
        "width_m = ",
        "radius_m = { value = 0.1, source = \"test\" }\nwidth_m = ",
    );
    assert!(matches!(both, StationError::Aperture { .. }), "{both:?}");
}
