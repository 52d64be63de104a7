//! One test per class of mistake in a vehicle file: the error has the file, the key and the number.

use super::super::builtin::{QBALL_X4_TOML, QBALL_X4_VENDOR_TOML};
use super::{Vehicle, VehicleError, VehicleFile};
use provenance::{NOT_STATED, Place, Position, RangeError, ReadError};

const FILE: &str = "broken.toml";

/// The error of the nominal file with one piece of text replaced.
fn broken(from: &str, to: &str) -> VehicleError {
    assert!(
        QBALL_X4_TOML.contains(from),
        "`{from}` is not in the file, so the test would prove nothing"
    );
    Vehicle::from_toml_str(&QBALL_X4_TOML.replacen(from, to, 1), FILE).expect_err(to)
}

/// The error of the nominal file with the value of a key replaced.
fn with_value(table: &str, key: &str, value: &str) -> VehicleError {
    let start = QBALL_X4_TOML.find(&format!("[{table}]")).expect("table");
    let (before, after) = QBALL_X4_TOML.split_at(start);
    let at = after.find(&format!("\n{key} = ")).expect("key");
    let (head, tail) = after.split_at(at + 1);
    let rest = &tail[tail.find('\n').unwrap_or(tail.len())..];
    let text = format!("{before}{head}{key} = {{ value = {value}, source = \"test\" }}{rest}");
    Vehicle::from_toml_str(&text, FILE).expect_err(value)
}

fn assert_out_of_range(error: &VehicleError, expected_key: &str, expected_value: f64) {
    let VehicleError::Range { place, key, error } = error else {
        panic!("expected a value out of range, got {error:?}")
    };
    let RangeError::Outside { value, .. } = **error else {
        panic!("{error:?}")
    };
    assert_eq!(
        (place.origin.as_str(), key.as_str(), value),
        (FILE, expected_key, expected_value)
    );
}

fn assert_not_finite(error: &VehicleError, expected_key: &str) {
    let VehicleError::Range { key, error, .. } = error else {
        panic!("expected a value that is not finite, got {error:?}")
    };
    assert!(matches!(**error, RangeError::NotFinite { .. }), "{error:?}");
    assert_eq!(key, expected_key);
}

/// What the text's reader says.
fn read(error: &VehicleError) -> &ReadError {
    match error {
        VehicleError::Read(error) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn exact_syntax_error_has_line_and_column() {
    let error = Vehicle::from_toml_str("name = \"x\"\nmass = = 2\n", FILE).expect_err("syntax");
    assert!(
        error.to_string().starts_with("broken.toml:2:8: not valid TOML: "),
        "{error}"
    );
}

#[test]
fn exact_missing_key_names_its_path() {
    for (line, expected) in [
        ("mass_kg = ", "airframe.mass_kg"),
        ("thrust_gain_n = ", "linear_rotor.thrust_gain_n"),
        ("diameter_m = ", "propeller.diameter_m"),
        ("name = \"Qball-X4 (nominal)\"", "name"),
        ("name = \"left\"", "rotors[2].name"),
    ] {
        let at = QBALL_X4_TOML.find(line).expect("line");
        let end = at + QBALL_X4_TOML[at..].find('\n').expect("end of line");
        let text = format!("{}{}", &QBALL_X4_TOML[..at], &QBALL_X4_TOML[end..]);
        let error = Vehicle::from_toml_str(&text, FILE).expect_err(expected);
        assert_eq!(read(&error).key(), Some(expected), "{error:?}");
        assert!(
            error.to_string().contains(&format!("missing key `{expected}`")),
            "{error}"
        );
    }
}

/// A number may stand without its source; one warning says so.
#[test]
fn exact_plain_numbers_have_no_stated_source() {
    let stated = "mass_kg = { value = 1.4, source = \"Quanser, vendor's value for the Qball-X4\" }";
    for plain in ["mass_kg = 1.4", "mass_kg = { value = 1.4 }"] {
        assert!(QBALL_X4_TOML.contains(stated));
        let text = QBALL_X4_TOML.replacen(stated, plain, 1);
        let file = VehicleFile::parse(&text, FILE).expect("plain");
        assert_eq!(file.airframe.mass.source, NOT_STATED);
        assert_eq!(file.unstated(), ["airframe.mass_kg"]);
        let warning = file.unstated_warning().expect("one");
        assert!(
            warning.contains("1 numbers without a source: `airframe.mass_kg`"),
            "{warning}"
        );
        assert_eq!(Vehicle::from_file(&file, FILE), Ok(Vehicle::qball_x4()));
    }
    let nominal = VehicleFile::parse(QBALL_X4_TOML, FILE).expect("nominal");
    assert_eq!(nominal.unstated_warning(), None);
}

/// Every mistake of a file comes at once, each with its place.
#[test]
fn exact_all_mistakes_are_reported_at_once() {
    let text = QBALL_X4_TOML
        .replacen("mass_kg = ", "mass_g = ", 1)
        .replacen("diameter_m = { value = 0.254", "diameter_m = { value = 254.0", 1)
        .replacen("[battery]", "[batery]", 1)
        .replacen("spin = \"clockwise\"", "spin = \"left\"", 1);
    let error = Vehicle::from_toml_str(&text, FILE).expect_err("four mistakes");
    let VehicleError::Several(faults) = &error else {
        panic!("{error:?}")
    };
    let message = error.to_string();
    for part in [
        "unknown key `airframe.mass_g`; expected one of mass_kg, inertia_xx_kg_m2",
        "missing key `airframe.mass_kg`",
        "`propeller.diameter_m` = 254 m is outside 0.001 to 10 m; is this in inches?",
        "unknown key `batery`",
        "`rotors[0].spin`",
    ] {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
    assert_eq!(faults.len(), 5, "{message}");
    assert!(
        message
            .lines()
            .skip(1)
            .all(|line| line.starts_with("  broken.toml:")),
        "{message}"
    );
}

#[test]
fn exact_unknown_key_names_its_path_and_line() {
    let error = broken("gravity_m_s2 = ", "gravity = 9.81\ngravity_m_s2 = ");
    let at = QBALL_X4_TOML.find("gravity_m_s2").expect("key");
    let position = Position {
        line: QBALL_X4_TOML[..at].matches('\n').count() + 1,
        column: 1,
    };
    let expected = Place {
        origin: FILE.to_owned(),
        position: Some(position),
    };
    assert_eq!(
        (read(&error).key(), read(&error).place()),
        (Some("environment.gravity"), &expected)
    );
    assert!(
        error
            .to_string()
            .ends_with("expected one of gravity_m_s2, air_density_kg_m3"),
        "{error}"
    );
    let top = broken("name = \"Qball-X4 (nominal)\"", "name = \"x\"\nwings = 2");
    assert_eq!(read(&top).key(), Some("wings"));
    let table = broken("[drag]", "[dragg]");
    assert_eq!(read(&table).key(), Some("dragg"));
}

#[test]
fn exact_wrong_type_names_its_path() {
    for value in ["\"heavy\"", "[1.4]"] {
        let error = with_value("airframe", "mass_kg", value);
        assert_eq!(read(&error).key(), Some("airframe.mass_kg.value"), "{error:?}");
    }
    let spin = broken("spin = \"clockwise\"", "spin = \"left\"");
    assert_eq!(read(&spin).key(), Some("rotors[0].spin"));
    let start = QBALL_X4_TOML.find("[drag]").expect("drag");
    let end = QBALL_X4_TOML.find("[arms]").expect("arms");
    let text = format!("drag = 3\n{}{}", &QBALL_X4_TOML[..start], &QBALL_X4_TOML[end..]);
    let group = Vehicle::from_toml_str(&text, FILE).expect_err("a number");
    assert_eq!(
        group.to_string(),
        "broken.toml:1:8: `drag`: found integer, expected a table"
    );
}

#[test]
fn exact_empty_source_is_refused() {
    let error = broken("source = \"APC slow flyer 10x4.7, 10 in\"", "source = \"  \"");
    assert_eq!(
        read(&error).key(),
        Some("propeller.diameter_m.source"),
        "{error:?}"
    );
    let mut file = VehicleFile::parse(QBALL_X4_TOML, FILE).expect("nominal");
    file.airframe.mass.source.clear();
    let key = "airframe.mass_kg".to_owned();
    let origin = FILE.to_owned();
    assert_eq!(
        Vehicle::from_file(&file, FILE),
        Err(VehicleError::EmptySource { origin, key })
    );
}

#[test]
fn exact_not_finite_is_refused_everywhere() {
    for (table, key) in [
        ("environment", "gravity_m_s2"),
        ("airframe", "mass_kg"),
        ("airframe", "inertia_yy_kg_m2"),
        ("pwm", "maximum"),
        ("linear_rotor", "torque_gain_n_m"),
        ("rotor_dynamics", "torque_c1_per_s"),
        ("polynomial_rotor", "thrust_k3_n_per_v3"),
        ("propeller", "torque_coefficient"),
        ("motor", "controller_lag_s"),
        ("battery", "capacity_ah"),
    ] {
        for value in ["nan", "inf", "-inf"] {
            let error = with_value(table, key, value);
            let expected = format!("{table}.{key}");
            assert_not_finite(&error, &expected);
        }
    }
    let hub = broken("value = [-0.2, 0.0, 0.0]", "value = [-0.2, nan, 0.0]");
    assert_not_finite(&hub, "rotors[0].hub_position_m[1]");
}

#[test]
fn exact_absurd_and_negative_values_are_refused() {
    for (table, key, value) in [
        ("environment", "gravity_m_s2", -9.81),
        ("environment", "gravity_m_s2", 981.0),
        ("environment", "air_density_kg_m3", 0.0),
        ("environment", "air_density_kg_m3", 1225.0),
        ("airframe", "mass_kg", 1400.0),
        ("airframe", "mass_kg", 0.0009),
        ("airframe", "mass_kg", -1.4),
        ("airframe", "arm_length_m", 20.0),
        ("airframe", "arm_length_m", 0.0),
        ("airframe", "inertia_xx_kg_m2", 30.0),
        ("airframe", "inertia_xx_kg_m2", -0.03),
        ("airframe", "inertia_zz_kg_m2", 4e-8),
        ("pwm", "minimum", -0.05),
        ("pwm", "maximum", 10.0),
        ("pwm", "zero_thrust", 0.04),
        ("pwm", "zero_thrust", 0.11),
        ("linear_rotor", "thrust_gain_n", 0.0),
        ("linear_rotor", "thrust_gain_n", -120.0),
        ("linear_rotor", "torque_gain_n_m", 4000.0),
        ("linear_rotor", "bandwidth_rad_s", 0.05),
        ("linear_rotor", "bandwidth_rad_s", 1500.0),
        ("rotor_dynamics", "thrust_c1_per_s", -114.0),
        ("rotor_dynamics", "torque_c4_per_s2", -1.0),
        ("propeller", "diameter_m", 254.0),
        ("propeller", "thrust_coefficient", 0.0),
        ("motor", "velocity_constant_rad_s_v", -106.8),
        ("motor", "rotor_inertia_kg_m2", 65.0),
        ("motor", "resistance_ohm", 126.0),
        ("battery", "full_voltage_v", 9.0),
        ("battery", "nominal_voltage_v", 0.0),
    ] {
        assert_out_of_range(
            &with_value(table, key, &format!("{value:?}")),
            &format!("{table}.{key}"),
            value,
        );
    }
}

#[test]
fn exact_message_names_file_key_value_range_and_hint() {
    let message = with_value("airframe", "mass_kg", "1400.0").to_string();
    let line = 1 + QBALL_X4_TOML[..QBALL_X4_TOML.find("mass_kg").expect("key")]
        .matches('\n')
        .count();
    let expected = format!(
        "broken.toml:{line}:11: `airframe.mass_kg` = 1400 kg is outside 0.001 to 1000 kg; is this in grams?"
    );
    assert_eq!(message, expected);
}

#[test]
fn exact_vectors_name_the_component() {
    let drag = with_value("drag", "quadratic_n_s2_m2", "[0.03, -0.03, 0.06]");
    assert_out_of_range(&drag, "drag.quadratic_n_s2_m2[1]", -0.03);
    let hub = broken("value = [0.2, 0.0, 0.0]", "value = [200.0, 0.0, 0.0]");
    assert_out_of_range(&hub, "rotors[1].hub_position_m[0]", 200.0);
    let centre = with_value("airframe", "centre_of_mass_m", "[0.0, 0.0, 50.0]");
    assert_out_of_range(&centre, "airframe.centre_of_mass_m[2]", 50.0);
}

#[test]
fn exact_hub_far_from_the_arm_length_is_refused() {
    assert_out_of_range(
        &broken("value = [0.2, 0.0, 0.0]", "value = [2.0, 0.0, 0.0]"),
        "rotors[1].hub_position_m",
        2.0,
    );
}

#[test]
fn exact_negative_standard_error_is_refused() {
    let error = broken("standard_error = 3e-6", "standard_error = -3e-6");
    assert_out_of_range(&error, "motor.rotor_inertia_kg_m2.standard_error", -3e-6);
}

#[test]
fn exact_pwm_order() {
    let error = with_value("pwm", "minimum", "0.1");
    let expected = VehicleError::PwmOrder {
        origin: FILE.to_owned(),
        minimum: 0.1,
        maximum: 0.1,
    };
    assert_eq!(error, expected);
}

#[test]
fn exact_rotor_count() {
    let at = QBALL_X4_TOML.find("[[rotors]]").expect("rotors");
    let text = format!(
        "{}[[rotors]]\nname = \"top\"\nhub_position_m = {{ value = [0.2, 0.0, 0.0], source = \"test\" }}\nspin = \"clockwise\"\n\n{}",
        &QBALL_X4_TOML[..at],
        &QBALL_X4_TOML[at..]
    );
    let error = Vehicle::from_toml_str(&text, FILE).expect_err("five rotors");
    assert_eq!(
        error,
        VehicleError::RotorCount {
            origin: FILE.to_owned(),
            count: 5
        }
    );
}

#[test]
fn exact_triangle_inequality() {
    let error = with_value("airframe", "inertia_zz_kg_m2", "0.07");
    let VehicleError::UnphysicalInertia { principal, .. } = error else {
        panic!("{error:?}")
    };
    // Eigenvalues of a diagonal matrix, to rounding.
    approx::assert_relative_eq!(principal[2], 0.07, max_relative = 1e-12);
    let products = broken(
        "arm_length_m = ",
        "inertia_xy_kg_m2 = { value = 0.035, source = \"test\" }\narm_length_m = ",
    );
    assert!(
        matches!(products, VehicleError::UnphysicalInertia { .. }),
        "{products:?}"
    );
}

/// All four rotors turning one way leave no yaw; two hubs at one place leave no roll.
#[test]
fn exact_singular_control_matrix() {
    for (from, to) in [
        ("spin = \"counter-clockwise\"", "spin = \"clockwise\""),
        ("[0.0, 0.2, 0.0]", "[0.0, -0.2, 0.0]"),
    ] {
        let error = Vehicle::from_toml_str(&QBALL_X4_TOML.replace(from, to), FILE).expect_err(to);
        let VehicleError::SingularControlMatrix { determinant, .. } = error else {
            panic!("{error:?}")
        };
        // Zero but for the roundings of the elimination.
        assert!(determinant.abs() < 1e-12, "{determinant}");
    }
}

#[test]
fn exact_torque_gain_must_be_one() {
    let error = with_value("rotor_dynamics", "torque_c2_per_s2", "1400.0");
    assert!(
        matches!(error, VehicleError::TorqueGainNotUnity { numerator, .. } if numerator == 1400.0),
        "{error:?}"
    );
}

#[test]
fn exact_too_weak_to_hover() {
    let text = QBALL_X4_VENDOR_TOML.replace("value = 120.0", "value = 60.0");
    let error = Vehicle::from_toml_str(&text, FILE).expect_err("3 N per rotor");
    let VehicleError::CannotHover {
        maximum_thrust_n,
        weight_n,
        ..
    } = error
    else {
        panic!("{error:?}")
    };
    // Few roundings.
    approx::assert_relative_eq!(maximum_thrust_n, 12.0, max_relative = 1e-12);
    approx::assert_relative_eq!(weight_n, 13.734, max_relative = 1e-12);
}

/// A vehicle changed by a program is checked as one from a file is.
#[test]
fn exact_changed_vehicle_is_checked_again() {
    let mut vehicle = Vehicle::qball_x4();
    vehicle.airframe.inertia[(1, 0)] = 0.001;
    let error = vehicle.validate("study").expect_err("asymmetric");
    assert_eq!(
        error,
        VehicleError::AsymmetricInertia {
            origin: "study".to_owned(),
            upper: 0.0,
            lower: 0.001
        }
    );
    let mut vehicle = Vehicle::qball_x4();
    vehicle.airframe.inertia[(2, 1)] = f64::NAN;
    assert!(vehicle.validate("study").is_err());
}
