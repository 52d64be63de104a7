//! Flights that leave the validity of their models: where they end, and what is said of why.

use scenario::{End, Keep, Scenario};

/// Flies a quadrotor for 2 s; how it ends, in words.
fn early_end(quadrotor: &str) -> String {
    let text = format!("name = \"x\"\nduration_s = 2\n[[quadrotor]]\nname = \"a\"\n{quadrotor}");
    let scenario = Scenario::from_toml_str(&text, "test").unwrap();
    let flown = scenario.fly(&(), &Keep::METRICS).unwrap();
    assert_eq!(flown.ending.end, End::Early, "{}", flown.ending);
    flown.ending.to_string()
}

/// The rotors of the nominal vehicle have their fastest pole at some 100 rad/s, so that a second is a hundred times too long.
#[test]
fn exact_a_step_that_is_too_long_for_the_rotors_is_named_as_the_cause() {
    let end = early_end("level = 5\nstep_s = 1.0\nreference = { kind = \"hold\", position_m = [0, 0, -2] }");
    for part in [
        "\"a\" diverged after",
        "m/s",
        "its step of 1 s is too long",
        "rad/s",
    ] {
        assert!(end.contains(part), "`{part}` is missing in: {end}");
    }
}

/// A metre in a thousandth of a second is 4·10⁷ m/s² of centripetal acceleration.
#[test]
fn exact_a_reference_that_nothing_can_follow_is_named_as_the_cause() {
    let circle = "reference = { kind = \"circle\", centre_m = [0, 0, -2], radius_m = 1, period_s = 0.001 }";
    let end = early_end(&format!(
        "level = 1\nstart = {{ position_m = [1, 0, -2] }}\n{circle}"
    ));
    for part in [
        "\"a\" diverged after",
        "speed of sound",
        "its reference asks for an acceleration of 3.9e7 m/s²",
    ] {
        assert!(end.contains(part), "`{part}` is missing in: {end}");
    }
}
