//! The example of each command's file goes through the command.

use super::{NOMINAL, file, identify, number, said};

const SWING: [&str; 8] = [
    "--axis",
    "yaw",
    "--mass-kg",
    "1.4",
    "--half-spacing-m",
    "0.2",
    "--length-m",
    "0.7",
];
/// Template, command, arguments.
const KINDS: [(&str, &str, &[&str]); 7] = [
    ("centre-of-mass", "centre-of-mass", &[]),
    ("pendulum", "pendulum", &SWING),
    ("load-cell", "load-cell", &["--capacity-n", "16"]),
    ("load-cell-torque", "load-cell", &["--capacity-n-m", "0.27"]),
    ("thrust-stand", "thrust-stand", &["--vehicle", NOMINAL]),
    ("rotor-response", "rotor-response", &[]),
    ("flight", "flight", &["--vehicle", NOMINAL]),
];

#[test]
fn agree_every_template_is_identified_and_drawn() {
    for (kind, command, more) in KINDS {
        let template = identify(&["template", kind]);
        assert_eq!(template.status.code(), Some(0), "{kind}");
        let data = file(&format!("template-{kind}.csv"), &template.stdout);
        let picture = data.with_extension("svg");
        let head = [
            command,
            data.to_str().unwrap(),
            "--json",
            "--plot",
            picture.to_str().unwrap(),
        ];
        let output = identify(&[&head, more].concat());
        assert_eq!(output.status.code(), Some(0), "{kind}: {}", said(&output));
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let numbers = answer["numbers"].as_array().unwrap();
        assert!(!numbers.is_empty(), "{kind}");
        for number in numbers {
            let error = number["standard_error"].as_f64().unwrap();
            assert!(error.is_finite() && error > 0.0, "{kind}: {number}");
            assert!(!number["unit"].as_str().unwrap().is_empty(), "{kind}: {number}");
        }
        let svg = std::fs::read_to_string(&picture).unwrap();
        assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"), "{kind}");
        assert!(svg.contains("esidual") || kind == "centre-of-mass", "{kind}");
    }
}

/// The table has a unit on every line of a number.
#[test]
fn exact_the_table_ends_every_number_with_its_unit() {
    let template = identify(&["template", "thrust-stand"]);
    let data = file("units.csv", &template.stdout);
    let output = identify(&["thrust-stand", data.to_str().unwrap(), "--vehicle", NOMINAL]);
    let table = String::from_utf8(output.stdout).unwrap();
    for (key, unit) in [
        ("propeller.thrust_coefficient", " 1"),
        ("polynomial_rotor.thrust_k2_n_per_v2", " N/V²"),
        ("polynomial_rotor.torque_k3_n_m_per_v3", " N m/V³"),
        ("linear_rotor.torque_gain_n_m", " N m"),
    ] {
        let line = table.lines().find(|line| line.starts_with(key)).unwrap();
        assert!(line.ends_with(unit), "{line}");
    }
}

/// Points on a line by hand: `T = 200 (ū − 0.06)`, `Q = 3 (ū − 0.06)`, a newton hundredth and a tenth of a millinewton metre to
/// either side by turns; another voltage and duties outside the range are left alone.
#[test]
fn exact_the_linear_gains_come_from_one_voltage_and_the_range() {
    let mut text = "duty,battery_voltage_v,thrust_n,torque_n_m,speed_rad_s\n".to_owned();
    for k in 0..40 {
        let duty = 0.065 + 5e-4 * f64::from(k);
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let (thrust, torque) = (
            200.0 * (duty - 0.06) + 0.01 * sign,
            3.0 * (duty - 0.06) + 1e-4 * sign,
        );
        let speed = (thrust / 1.6e-5).sqrt();
        text += &format!("{duty},11.1,{thrust},{torque},{speed}\n");
        text += &format!("{duty},12.0,{},{},{speed}\n", 1.2 * thrust, 1.2 * torque);
    }
    text += "0.095,11.1,9,0.2,800\n";
    let data = file("line.csv", text.as_bytes());
    let output = identify(&[
        "thrust-stand",
        data.to_str().unwrap(),
        "--vehicle",
        NOMINAL,
        "--line-to",
        "0.09",
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    for (key, truth) in [
        ("linear_rotor.thrust_gain_n", 200.0),
        ("linear_rotor.torque_gain_n_m", 3.0),
        ("pwm.zero_thrust", 0.06),
    ] {
        let (value, error) = number(&output, key);
        // The signs by turns hardly tilt the line: less than a standard error; all rows would be off by a tenth.
        assert!(
            (value - truth).abs() < error && error < 5e-3 * truth,
            "{key}: {value} ± {error}"
        );
    }
}
