//! Physics that must be right whatever the scenario: wind, ground, inertia.

use crate::support::{fly, ready};
use scenario::{End, Scenario};
use sifre::RunStatus;

/// Who hovers at level `level`, with more lines to it.
fn hover(level: u8, more: &str, rest: &str) -> String {
    format!(
        "name = \"hover\"\nduration_s = 4.0\n[[quadrotor]]\nname = \"alpha\"\nlevel = {level}\n\
         reference = {{ kind = \"hold\", position_m = [0, 0, -2] }}\n{more}\n{rest}"
    )
}

/// Air that moves south pushes south, air that moves east pushes east, and the response is odd in the wind.
#[test]
fn prop_wind_pushes_where_the_air_goes() {
    for level in [4, 5] {
        let pushed = |x: i32, y: i32| {
            let wind = format!("wind = {{ velocity_m_s = [{x}, {y}, 0] }}");
            let flown = fly(&hover(level, &wind, ""));
            [flown.last("alpha.position.x"), flown.last("alpha.position.y")]
        };
        let (south, north, east) = (pushed(-5, 0), pushed(5, 0), pushed(0, 5));
        assert!(
            south[0] < -0.01,
            "wind from the north must push south, not to x = {}",
            south[0]
        );
        assert!(north[0] > 0.01 && east[1] > 0.01, "{north:?} {east:?}");
        // Drag is k |v| v, the same either way, and the controller is odd about hover.
        assert!(
            (south[0] + north[0]).abs() < 1e-3 * north[0],
            "{south:?} {north:?}"
        );
    }
}

/// Steady wind against c3, which has no integral: at rest the tilt balances drag, `m g tan θ = k w²` with the air at
/// w minus the tilted body's part, and the position loop asks for that tilt by its offset, `ω² e = g tan θ`.
#[test]
fn exact_offset_in_steady_wind() {
    let wind = "phenomena = [\"drag\"]\nwind = { velocity_m_s = [-4, 0, 0] }";
    let flown = fly(&hover(3, wind, "").replace("duration_s = 4.0", "duration_s = 40.0"));
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let drag = vehicle.drag.expect("it has drag").quadratic.x;
    // The loop's frequency for 5 s to 2 %, critically damped: (1 + x) e^-x = 0.02 at x = 5.8339.
    let frequency = 5.8339_f64 / 5.0;
    let offset = drag * 16.0 / vehicle.airframe.mass / frequency.powi(2);
    // Tilt is some degrees: cosines between body and world are left out, 1 - cos(0.1) = 0.5 %, twice.
    let found = -flown.last("alpha.position.x");
    assert!(
        (found / offset - 1.0).abs() < 0.02,
        "{found} m instead of {offset} m"
    );
}

/// Without rotors that lift, a fall ends at the ground, at the time that Galilei gives it.
#[test]
fn exact_nothing_falls_under_the_ground() {
    // Commands u at hover minus themselves: no thrust at all at level 2, so a free fall from 2 m.
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let g = vehicle.environment.gravity;
    let duty = vehicle.airframe.mass * g / (4.0 * vehicle.linear_rotor.thrust_gain);
    let drop = format!(
        "command_offsets = [{{ from_s = 0, duty = [{0}, {0}, {0}, {0}] }}]",
        -40.0 * duty
    );
    let flown = fly(&hover(2, &drop, ""));
    assert_eq!(flown.ending.end, End::Early);
    let RunStatus::Below { agent, height_m } = &flown.ending.report.status else {
        panic!("{:?}", flown.ending.report.status);
    };
    assert_eq!(agent, "alpha");
    // Stopped within a step of the ground.
    assert!(*height_m < 0.0 && *height_m > -0.2, "{height_m}");
    assert!(flown.metric("alpha.height_min_m") > -0.2);
    // On request it continues.
    let through = fly(&hover(2, &drop, "[stop]\nground = false"));
    assert_eq!(through.ending.end, End::Done);
    assert!(through.last("alpha.position.z") > 10.0);
}

/// A constant difference of left and right thrust turns the vehicle in roll with `p = M t / I`: twice the inertia, half
/// the rate, at first, when the controller has not answered yet.
#[test]
fn exact_inertia_matters() {
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let (gain, arm) = (vehicle.linear_rotor.thrust_gain, vehicle.airframe.arm_length);
    let duty = 1e-3;
    // Rotor 3 is left, 4 is right (towards +y): more on the left rolls to the right, positive.
    let offset = format!("command_offsets = [{{ from_s = 0, duty = [0, 0, {duty}, -{duty}] }}]");
    for factor in [1.0, 2.0] {
        let inertia = factor * vehicle.airframe.inertia[(0, 0)];
        let more = format!(
            "parameters = {{ airframe = {{ inertia_xx_kg_m2 = {inertia}, inertia_yy_kg_m2 = {inertia} }} }}\n{offset}"
        );
        let flown = fly(&hover(2, &more, "").replace("duration_s = 4.0", "duration_s = 0.01"));
        let expected = 2.0 * gain * duty * arm / inertia * 0.01;
        let found = flown.last("alpha.body_rate.p");
        // c2 answers with up to 2 ζ ω = 23 /s times the rate, on average half of it in 10 ms: a tenth.
        assert!(
            (found / expected - 1.0).abs() < 0.15,
            "{found} rad/s instead of {expected} rad/s"
        );
        assert!(found > 0.0);
    }
}

/// The conditions that end a run, and which of them are failures.
#[test]
fn exact_ends() {
    let boxed = "[stop]\noutside = { from_m = [-1, -1, -2.5], to_m = [1, 1, 0] }";
    let away = hover(
        3,
        "start = { position_m = [0, 0, -2], velocity_m_s = [4, 0, 0] }",
        boxed,
    );
    let flown = fly(&away);
    assert_eq!(flown.ending.end, End::Early);
    let x = flown.last("alpha.position.x");
    // Critically damped from 4 m/s it would get to v / (ω e) = 1.26 m; the last row is up to 10 ms before the wall.
    assert!((0.95..1.01).contains(&x), "{x}");
    assert!(flown.ending.report.status.to_string().contains("left its box"));

    let arrived = fly(&hover(3, "", "[stop]\narrived_within_m = 0.01"));
    assert_eq!(arrived.ending.end, End::Done);
    assert_eq!(arrived.ending.report.time_s, 0.0, "it begins where it is to be");
    let circle = "reference = { kind = \"circle\", centre_m = [0, 0, -2], radius_m = 1, period_s = 9 }";
    let hold = "reference = { kind = \"hold\", position_m = [0, 0, -2] }";
    let never = hover(3, "", "[stop]\narrived_within_m = 0.01").replace(hold, circle);
    let notes = Scenario::from_toml_str(&never, "test")
        .unwrap()
        .build(&())
        .unwrap()
        .notes;
    assert!(notes[0].contains("never met"), "{notes:?}");

    let lost = ready("lost-view") + "\n[stop]\nlost_target = true";
    let flown = fly(&lost);
    let found = flown.events.last().unwrap();
    assert_eq!(flown.ending.end, End::Early);
    assert_eq!(found.what, sifre::AgentEvent::TargetLost);
    // Seen at the next instant of anyone: the target's step of a millisecond.
    assert!(flown.ending.report.time_s - found.time_ns as f64 * 1e-9 <= 1.001e-3);
}

/// The same scenario gives the same recording, and another seed another one.
#[test]
fn prop_the_seed_decides() {
    let noisy = |seed: u64| {
        let ets = "[[ets]]\nname = \"station\"\ntracks = \"alpha\"\ntilt_deg = 20\nheading_deg = 0\nposition_m = [-4, 0, 0]\nnoise_px = 2";
        let text = hover(1, "", ets).replace("name = \"hover\"", &format!("name = \"hover\"\nseed = {seed}"));
        fly(&text.replace("duration_s = 4.0", "duration_s = 1.0"))
            .0
            .recording
    };
    assert_eq!(noisy(1), noisy(1));
    assert_ne!(noisy(1), noisy(2));
}
