//! What is refused, and how it is said.

use crate::support::refusal;

/// A scenario of one quadrotor: what is at the top, and what is added to it.
fn one(top: &str, quadrotor: &str, rest: &str) -> String {
    format!(
        "name = \"test\"\n{top}\n[[quadrotor]]\nname = \"alpha\"\n\
         reference = {{ kind = \"hold\", position_m = [0, 0, -1] }}\n{quadrotor}\n{rest}"
    )
}

const SECOND: &str = "duration_s = 1.0";

/// The message has all these parts.
fn says(text: &str, parts: &[&str]) {
    let message = refusal(text);
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn exact_files_that_are_wrong_are_told_with_line_and_key() {
    says("name = ", &["test.toml:1:", "not valid TOML"]);
    says("name = \"x\"", &["missing key `duration_s`"]);
    says(
        &one(SECOND, "levle = 3", ""),
        &["test.toml:6:1", "unknown key `quadrotor[0].levle`", "level"],
    );
    says(
        &one(SECOND, "level = 6", ""),
        &["test.toml:6:", "`quadrotor[0].level`", "6"],
    );
    says(
        &one(SECOND, "phenomena = [\"rain\"]", ""),
        &["`quadrotor[0].phenomena", "rain", "drag"],
    );
    // Inside a table that is distinguished by its kind.
    let helix = "name = \"x\"\nduration_s = 1\n[[quadrotor]]\nname = \"a\"\n\
                 reference = { kind = \"hold\", position_m = [0, 0, -1], radius_m = 2 }";
    says(
        helix,
        &["test.toml:5:", "unknown key `quadrotor[0].reference.radius_m`"],
    );
    says(&helix.replace("hold", "hover"), &["hover", "polynomial"]);
}

#[test]
fn exact_missing_vehicles_and_stations() {
    says(
        &one(SECOND, "vehicle = \"tello\"", ""),
        &["\"alpha\"", "\"tello\"", "qball-x4, qball-x4-vendor, crazyflie"],
    );
    let ets = "[[ets]]\nname = \"station\"\ntracks = \"alpha\"\nstation = \"moon.toml\"";
    says(&one(SECOND, "", ets), &["\"station\"", "moon.toml", "nominal"]);
    // A vehicle that lacks what a level needs.
    says(
        &one(SECOND, "vehicle = \"qball-x4-vendor\"\nlevel = 5", ""),
        &["\"alpha\""],
    );
}

/// Places so far away that the square of a distance is not finite.
#[test]
fn exact_numbers_that_are_too_large_are_told_with_their_key() {
    let limit = "finite and at most 1e9 in magnitude";
    let target =
        |path: &str| format!("name = \"x\"\nduration_s = 1\n[[target]]\nname = \"t\"\npath = {path}");
    says(
        &target("{ kind = \"fixed\", position_m = [1e308, 0, 0] }"),
        &["target \"t\": path.position_m must be", limit, "got 1e308"],
    );
    let way = "{ time_s = 0, position_m = [0, 0, 0] }, { time_s = 1, position_m = [0, 1e200, 0] }";
    says(
        &target(&format!("{{ kind = \"waypoints\", waypoints = [{way}] }}")),
        &["path.waypoints[1].position_m must be", limit, "got 1e200"],
    );
    says(
        &one(SECOND, "start = { position_m = [2e9, 0, 0] }", ""),
        &["\"alpha\"", "2000000000", "at most 1e9"],
    );
    let ets = "[[ets]]\nname = \"station\"\ntracks = \"alpha\"\nposition_m = [0, 0, -1e300]";
    says(
        &one(SECOND, "", ets),
        &["ets \"station\": position_m must be", limit, "got -1e300"],
    );
}

/// The nominal gimbal pans 170 degrees to either side.
#[test]
fn exact_gimbals_start_inside_their_travel() {
    let ets = |angle: &str| {
        let ets = format!("[[ets]]\nname = \"station\"\ntracks = \"alpha\"\n{angle}");
        one(SECOND, "", &ets)
    };
    says(
        &ets("pan_deg = 171"),
        &["ets \"station\"", "`pan_deg`", "-170.0 to 170.0 degrees, got 171"],
    );
    says(&ets("tilt_deg = -500"), &["`tilt_deg`", "travel", "got -500"]);
    says(&ets("pan_deg = 1e308"), &["`pan_deg`", "travel", "got 1"]);
}

#[test]
fn exact_recordings_have_a_form() {
    let output = |path: &str| one(SECOND, "", &format!("[output]\npath = \"{path}\""));
    says(
        &output("flight.json"),
        &["flight.json", ".csv, .parquet or .jsonl"],
    );
    says(&output("a.b/flight.toml"), &["flight.toml", "output.format"]);
}

#[test]
fn exact_parameters_that_the_vehicle_does_not_have() {
    let parameter = |key: &str| one(SECOND, &format!("parameters = {{ {key} }}"), "");
    says(
        &parameter("airframe = { colour = 3 }"),
        &["parameters.airframe.colour", "mass_kg"],
    );
    says(&parameter("airframe = { mass_kg = -1 }"), &["mass", "-1"]);
    says(
        &parameter("airframe = 3"),
        &["parameters.airframe", "no such number"],
    );
    says(&parameter("rotors = 3"), &["parameters.rotors"]);
}

#[test]
fn exact_agents_that_look_at_nobody_or_at_themselves() {
    let ets = |tracks: &str| {
        one(
            SECOND,
            "",
            &format!("[[ets]]\nname = \"station\"\ntracks = \"{tracks}\""),
        )
    };
    says(&ets("station"), &["\"station\"", "is itself", "alpha"]);
    says(
        &ets("bravo"),
        &["\"station\"", "\"bravo\"", "not in the simulation", "alpha"],
    );
    says(
        &one(SECOND, "facing = \"bravo\"", ""),
        &["\"bravo\"", "not in the simulation"],
    );
    let follow = |agent: &str| {
        one(SECOND, "", "").replace(
            "{ kind = \"hold\", position_m = [0, 0, -1] }",
            &format!("{{ kind = \"follow\", agent = \"{agent}\", offset_m = [1, 0, 0] }}"),
        )
    };
    says(&follow("alpha"), &["\"alpha\"", "start"]);
    says(&follow("nobody"), &["\"nobody\"", "start"]);
}

#[test]
fn exact_names() {
    let twice = "[[target]]\nname = \"alpha\"\npath = { kind = \"fixed\", position_m = [0, 0, 0] }";
    says(&one(SECOND, "", twice), &["two agents", "\"alpha\""]);
    says(
        &one(SECOND, "", &twice.replace("alpha", "a.b")),
        &["\"a.b\"", "none of them a dot"],
    );
    says(
        &one(SECOND, "", &twice.replace("alpha", "")),
        &["1 to 100 characters"],
    );
    says("name = \"x\"\nduration_s = 1", &["at least one agent"]);
    // A terminal's escape, a C1 control, a bidirectional override, a line separator; of an agent and of the scenario.
    for hostile in [
        "\\u001b[2J",
        "\\u009b2J",
        "\\u202egnp.exe",
        "a\\u2028b",
        "a\\nb",
        &"n".repeat(101),
    ] {
        says(
            &one(SECOND, "", &twice.replace("alpha", hostile)),
            &["an agent's name must have"],
        );
        let titled = one(SECOND, "", "").replace("name = \"test\"", &format!("name = \"{hostile}\""));
        says(&titled, &["`name` must have", "none of them a line break"]);
    }
}

#[test]
fn exact_times_and_steps() {
    says(
        &one("duration_s = -1.0", "", ""),
        &["`duration_s` = -1", "must be positive"],
    );
    says(
        &one("duration_s = 0", "", ""),
        &["`duration_s` = 0", "must be positive"],
    );
    says(
        &one("duration_s = nan", "", ""),
        &["`duration_s` = NaN", "finite"],
    );
    says(&one("duration_s = 1e99", "", ""), &["duration_s"]);
    // Two steps have a common tick as long as both are whole nanoseconds; a third of a millisecond is none.
    says(
        &one(SECOND, "step_s = 0.0003333333333", ""),
        &["`quadrotor[0].step_s`", "whole number of nanoseconds"],
    );
    says(
        &one(SECOND, "step_s = 0", ""),
        &["`quadrotor[0].step_s`", "positive"],
    );
    says(
        &one(SECOND, "", "[output]\nstep_s = -1"),
        &["`output.step_s`", "positive"],
    );
    // A frame every 33 ms can't be had at a step of a tenth of a second.
    let slow = "[[ets]]\nname = \"station\"\ntracks = \"alpha\"\nstep_s = 0.1";
    says(&one(SECOND, "", slow), &["\"station\"", "0.1 s"]);
    says(
        &one(
            SECOND,
            "wind = { steps = [{ from_s = 2, velocity_m_s = [0, 0, 0] }, { from_s = 1, velocity_m_s = [0, 0, 0] }] }",
            "",
        ),
        &["wind.steps", "later"],
    );
    says(
        &one(SECOND, "level_changes = [{ from_s = -1, level = 2 }]", ""),
        &["level_changes"],
    );
}

#[test]
fn exact_controllers_and_references() {
    says(
        &one(SECOND, "level = 2\ncontroller = { kind = \"c3\" }", ""),
        &["\"alpha\"", "3"],
    );
    says(
        &one(SECOND, "controller = { height = { settling_time_s = 0 } }", ""),
        &["height.settling_time_s", "positive"],
    );
    let reference =
        |text: &str| one(SECOND, "", "").replace("{ kind = \"hold\", position_m = [0, 0, -1] }", text);
    says(
        &reference("{ kind = \"hold\", position_m = [0, nan, 0] }"),
        &["\"alpha\"", "NaN", "finite"],
    );
    says(
        &reference("{ kind = \"steps\", steps = [] }"),
        &["reference.steps", "at least one"],
    );
    says(
        &reference("{ kind = \"waypoints\", waypoints = [{ time_s = 0, position_m = [0, 0, 0] }] }"),
        &["at least 2"],
    );
    says(
        &reference("{ kind = \"circle\", centre_m = [0, 0, -1], radius_m = 1, period_s = 0 }"),
        &["period_s", "zero"],
    );
}

#[test]
fn exact_estimators_that_are_wrong_are_refused() {
    let with = |keys: &str| one(SECOND, &format!("estimator = {{ {keys} }}"), "");
    says(
        &with("sensor = \"good\""),
        &["unknown key `quadrotor[0].estimator.sensor`", "sensors"],
    );
    says(
        &with("sensors = \"worst\""),
        &["estimator.sensors", "worst", "very-poor"],
    );
    says(
        &with("filter = \"particle\""),
        &["estimator.filter", "particle", "unscented"],
    );
    // c3 flies by thrusts, which a filter on level 2 does not know.
    says(
        &with("level = 2"),
        &["\"alpha\"", "estimator", "in the loop", "2", "3"],
    );
    // Beside the loop any level will do.
    let beside = with("level = 2, in_loop = false");
    let scenario =
        scenario::Scenario::from_toml_str(&beside, "test").unwrap_or_else(|error| panic!("{error}"));
    assert!(scenario.build(&()).is_ok());
}

#[test]
fn exact_sensors_and_starts_that_are_wrong_are_told_with_their_key() {
    let with = |keys: &str| one(SECOND, &format!("estimator = {{ {keys} }}"), "");
    let sensor = |keys: &str| {
        let gyroscope = "{ kind = \"gyroscope\", rate_hz = 100, noise = 0.01 }";
        with(&format!("sensors = [{gyroscope}, {{ {keys} }}]"))
    };
    let good = "kind = \"sonar\", rate_hz = 10, noise = 0.03";
    let wrong = |from: &str, to: &str| sensor(&good.replace(from, to));
    for (text, key, said) in [
        (wrong("rate_hz = 10", "rate_hz = 0"), "rate_hz", "0 Hz"),
        (wrong("rate_hz = 10", "rate_hz = -5"), "rate_hz", "-5 Hz"),
        (wrong("0.03", "-0.03"), "noise", "got -0.03"),
        (wrong("0.03", "0"), "noise", "needs noise or a quantum"),
        (wrong("0.03", "nan"), "noise", "NaN"),
        (
            sensor(&format!("{good}, turn_on_bias = -1")),
            "turn_on_bias",
            "got -1",
        ),
        (sensor(&format!("{good}, bias_drift = inf")), "bias_drift", "inf"),
        (sensor(&format!("{good}, quantum = -1")), "quantum", "got -1"),
        (sensor(&format!("{good}, delay_s = -0.1")), "delay_s", "got -0.1"),
        (
            sensor(&format!("{good}, dropout = 1")),
            "dropout",
            "below 1, got 1",
        ),
        (sensor(&format!("{good}, range = [3, 3]")), "range", "empty"),
        (
            sensor(&format!("{good}, field_ut = [1, 0, 0]")),
            "field_ut",
            "only a magnetometer",
        ),
        (
            sensor("kind = \"magnetometer\", rate_hz = 10, noise = 1, field_ut = [0, 0, 0]"),
            "field_ut",
            "not zero",
        ),
        (wrong("sonar", "gyroscope"), "kind", "given twice"),
    ] {
        says(
            &text,
            &["\"alpha\"", &format!("`estimator.sensors[1].{key}`"), said],
        );
    }
    // What is no list of sensors says so in its own words, at its key.
    says(
        &wrong("sonar", "lidar"),
        &["quadrotor[0].estimator.sensors[1].kind", "lidar", "position-fix"],
    );
    says(
        &wrong("noise", "nose"),
        &["quadrotor[0].estimator.sensors[1].nose"],
    );
    says(
        &wrong(", noise = 0.03", ""),
        &["quadrotor[0].estimator.sensors[1].noise", "missing"],
    );
    says(&with("sensors = 3"), &["estimator.sensors", "a list of sensors"]);

    for (keys, key, said) in [
        (
            "initial_error = { position_m = -1 }",
            "initial_error.position_m",
            "got -1",
        ),
        (
            "initial_error = { velocity_m_s = [0, nan, 0] }",
            "initial_error.velocity_m_s",
            "NaN",
        ),
        (
            "initial_error = { attitude_deg = inf }",
            "initial_error.attitude_deg",
            "inf",
        ),
        (
            "initial_deviation = { position_m = 0 }",
            "initial_deviation.position_m",
            "got 0",
        ),
        (
            "initial_deviation = { velocity_m_s = -1 }",
            "initial_deviation.velocity_m_s",
            "got -1",
        ),
        (
            "initial_deviation = { attitude_deg = nan }",
            "initial_deviation.attitude_deg",
            "NaN",
        ),
    ] {
        says(&with(keys), &["\"alpha\"", &format!("`estimator.{key}`"), said]);
    }
    says(
        &with("initial_error = { position_m = [1, 2] }"),
        &["estimator.initial_error.position_m"],
    );
    says(
        &with("initial_error = { position_m = \"far\" }"),
        &["estimator.initial_error.position_m", "three numbers"],
    );
}
