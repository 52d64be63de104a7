//! The ready scenarios: all fly to their end, and each does what it says.

use crate::support::{Flown, fly, ready};
use scenario::End;

fn done(name: &str) -> Flown {
    let flown = fly(&ready(name));
    assert_eq!(
        flown.ending.end,
        End::Done,
        "{name}: {}",
        flown.ending.report.status
    );
    flown
}

fn distance(flown: &Flown, one: &str, other: &str, time_s: f64) -> f64 {
    let square = |axis: &str| {
        let at = |agent: &str| flown.at(&format!("{agent}.position.{axis}"), time_s);
        (at(one) - at(other)).powi(2)
    };
    ["x", "y", "z"]
        .iter()
        .map(|axis| square(axis))
        .sum::<f64>()
        .sqrt()
}

/// Hover needs weight, no more: over five seconds the thrust in excess of it is the momentum that it gave.
#[test]
fn exact_hover_carries_the_weight() {
    let flown = done("hover");
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let (mass, gravity) = (vehicle.airframe.mass, vehicle.environment.gravity);
    let thrusts: Vec<Vec<f64>> = (1..=4)
        .map(|rotor| flown.column(&format!("alpha.thrust.{rotor}")))
        .collect();
    let excess = |k: usize| thrusts.iter().map(|thrust| thrust[k]).sum::<f64>() - mass * gravity;
    // It sinks as the battery does, and drag holds against that.
    let (sinking, drag) = (
        flown.column("alpha.velocity.z"),
        vehicle.drag.expect("it has drag").quadratic.z,
    );
    let excess = |k: usize| excess(k) + drag * sinking[k] * sinking[k].abs();
    // Rows every 10 ms from 5 s to 10 s; thrust changes over seconds, so that the trapezium is exact to 1e-6.
    let impulse: f64 = (500..1000).map(|k| 0.005 * (excess(k) + excess(k + 1))).sum();
    let gained = -mass * (flown.last("alpha.velocity.z") - flown.at("alpha.velocity.z", 5.0));
    assert!(
        (impulse - gained).abs() < 1e-6,
        "{impulse} N s and {gained} kg m/s"
    );
    assert!(excess(1000).abs() < 1e-3 * mass * gravity);
    // c3 believes in a linear rotor and a constant voltage, so it hangs off its set point; the ground is far.
    assert!((flown.last("alpha.position.z") + 2.0).abs() < 0.25);
}

/// c3 on its own model is its design: `e = p/(…)` of third order, whose second-order part settles to 2 % in 2 s.
#[test]
fn exact_step_in_height_settles_in_its_time() {
    let flown = done("step-in-height");
    // The extra pole at 20 ω and the held commands (1 ms) delay by some hundredths of a second.
    assert!((flown.at("alpha.position.z", 3.1) + 2.0).abs() < 0.02);
    assert!(
        (flown.at("alpha.position.z", 2.8) + 2.0).abs() > 0.02,
        "but not much earlier"
    );
    let highest = flown.column("alpha.position.z").into_iter().fold(0.0, f64::min);
    assert!(highest > -2.0 - 1e-6, "critically damped: no overshoot");
}

#[test]
fn prop_horizontal_step_arrives() {
    let flown = done("horizontal-step");
    assert!(
        (flown.last("alpha.position.x") - 2.0).abs() < 0.04,
        "2 % of the step"
    );
    // It leans towards where it goes: nose down for north at heading 0.
    assert!(flown.at("alpha.attitude.pitch", 1.3) < -0.01);
    assert!(flown.last("alpha.position.y").abs() < 1e-3);
}

/// On a helix of radius ρ with Ω the tilt is `atan(ρ Ω² / g)`, and the height follows the climb.
#[test]
fn exact_helix() {
    let flown = done("helix");
    let rate = std::f64::consts::TAU / 8.0;
    let tilt = (2.0 * rate * rate / 9.81_f64).atan().to_degrees();
    let last = |channel: &str| flown.last(&format!("alpha.{channel}"));
    let found = (last("attitude.roll").cos() * last("attitude.pitch").cos())
        .acos()
        .to_degrees();
    // The feed-forward is exact in continuous time; commands are held for 1 ms and g is given to three digits.
    assert!((found / tilt - 1.0).abs() < 0.01, "{found}° instead of {tilt}°");
    let radius = last("position.x").hypot(last("position.y"));
    assert!((radius - 2.0).abs() < 0.01, "{radius}");
    assert!((last("position.z") + 3.5).abs() < 0.01);
}

#[test]
fn prop_waypoints_home_before_the_end() {
    let flown = done("waypoints");
    let end = flown.ending.report.time_s;
    assert!((20.0..24.0).contains(&end), "{end}");
    assert!(distance_to(&flown, "alpha", [0.0, 0.0, -2.0]) < 0.1);
    // Each corner is met but for the drag that the references leave out.
    assert!((flown.at("alpha.position.x", 10.0) - 3.0).abs() < 0.1);
    assert!((flown.at("alpha.position.y", 10.0) - 3.0).abs() < 0.1);
}

fn distance_to(flown: &Flown, agent: &str, place: [f64; 3]) -> f64 {
    let axes = ["x", "y", "z"].iter().zip(place);
    let square = |(axis, at): (&&str, f64)| (flown.last(&format!("{agent}.position.{axis}")) - at).powi(2);
    axes.map(square).sum::<f64>().sqrt()
}

#[test]
fn prop_gust_pushes_south_and_it_comes_back() {
    let flown = done("gust");
    assert!(flown.at("alpha.position.x", 4.0) < -0.05);
    assert_eq!(flown.at("alpha.wind.x", 3.0), -6.0);
    assert!(flown.last("alpha.position.x").abs() < 0.02);
}

/// The wind drifts it south and shakes it; near the ground less thrust is asked for than in the free air.
#[test]
fn prop_near_the_ground_all_phenomena_act_together() {
    let flown = done("near-the-ground");
    // 201 to 2000: rows every 10 ms from 2 s on.
    let drift = flown.column("alpha.position.x")[200..].iter().sum::<f64>() / 1801.0;
    assert!(
        drift < 0.0,
        "the wind is from the north, the mean place is {drift} m"
    );
    // Without turbulence there is none.
    let calm = fly(&ready("near-the-ground")
        .replace("\"turbulence\"", "\"drag\"")
        .replace("turbulence = {", "# {"));
    // Then the wind is the logarithmic one, ln(h/z_0) / ln(20 ft / z_0), at the height h where it was decided.
    let height = -calm.last("alpha.position.z");
    let expected = -3.0 * (height / 0.046).ln() / (6.096_f64 / 0.046).ln();
    assert!((calm.last("alpha.wind.x") - expected).abs() < 1e-9);
    // Cheeseman and Bennett: thrust grows by 1 / (1 - (R / 4 h)²), so at level 4 commands shrink by (R / 4 h)².
    let radius = quad_dynamics::Vehicle::qball_x4()
        .propeller
        .expect("it has one")
        .diameter
        / 2.0;
    let commands = |time_s| {
        (1..=4)
            .map(|rotor| calm.at(&format!("alpha.command.{rotor}"), time_s))
            .sum::<f64>()
    };
    let saved = 1.0 - commands(20.0) / commands(0.5);
    let expected = (radius / (4.0 * height)).powi(2) - (radius / 12.0).powi(2);
    // The tilt against a wind of 1 m/s instead of 3 m/s changes the weight's share by less than 1e-4, the rest of the
    // landing 8 s after its end less than that.
    assert!((saved - expected).abs() < 3e-4, "{saved} instead of {expected}");
    assert!(calm.column("alpha.wind.y").iter().all(|wind| *wind == 0.0));
    assert!(flown.column("alpha.wind.y").iter().any(|wind| *wind != 0.0));
    // Gusts turn the air unless that is switched off, and push alike at the start.
    assert!(flown.column("alpha.air_rate.x").iter().any(|rate| *rate != 0.0));
    let linear = fly(&ready("near-the-ground").replace("w20_m_s = 7.7", "w20_m_s = 7.7, rotational = false"));
    assert_eq!(linear.at("alpha.wind.x", 0.0), flown.at("alpha.wind.x", 0.0));
    assert!(linear.recording.column("alpha.air_rate.x").is_none());
}

#[test]
fn prop_the_crazyflie_flies_with_gains_from_its_file() {
    let flown = done("crazyflie");
    assert!(distance_to(&flown, "cf", [0.0, 1.0, -1.0]) < 0.1);
    assert!((flown.last("cf.attitude.yaw") - std::f64::consts::FRAC_PI_2).abs() < 0.05);
    assert!(flown.metric("cf.position_error_max_m") < 0.3);
}

/// A surplus `Δm` hangs c3 off. It believes in mass m, so that at rest it takes the thrust for an acceleration `Δm g / m`
/// upwards; its law `0 = −(2 ζ ω + p) z̈ + ω² p e` then rests at `e = Δm g / (m ω²) (1 + 2 ζ ω / p)`. PID's integral
/// finds the weight, and with it the set point.
#[test]
fn exact_payload() {
    let flown = done("payload");
    // Height settles in 2 s: ω = 5.8339 / 2 s.
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let surplus = (1.6 - vehicle.airframe.mass) * vehicle.environment.gravity;
    // ζ = 1 and p = 20 ω.
    let sag = 1.1 * surplus / (vehicle.airframe.mass * (5.8339_f64 / 2.0).powi(2));
    let found = flown.last("ndi.position.z") + 2.0;
    // The frequency has five digits.
    assert!((found / sag - 1.0).abs() < 1e-4, "{found} m instead of {sag} m");
    // At rest PID's integral k_i ∫ e dt is what the surplus asks, Δm g / m, whatever lag and filters do on the way.
    let heights = flown.column("pid.position.z");
    let sags: Vec<f64> = heights.iter().map(|z| z + 2.0).collect();
    let times: Vec<f64> = flown.recording.times_s().collect();
    let pairs = times.windows(2).zip(sags.windows(2));
    let area: f64 = pairs.map(|(t, e)| 0.5 * (e[0] + e[1]) * (t[1] - t[0])).sum();
    let expected = surplus / (vehicle.airframe.mass * quad_ndi::PidSettings::default().height.integral);
    // Trapezoids of 20 ms under a curve of rates up to 7 rad/s: h² e'(0) / 12 and less.
    assert!(
        (area / expected - 1.0).abs() < 1e-3,
        "{area} m s instead of {expected} m s"
    );
    assert!(sags[sags.len() - 1].abs() < 1e-6);
}

#[test]
fn prop_level_changes_without_a_jump() {
    let flown = done("level-change");
    assert_eq!(flown.at("alpha.level", 3.9), 5.0);
    assert_eq!(flown.at("alpha.level", 5.0), 2.0);
    assert_eq!(flown.last("alpha.level"), 5.0);
    let (x, v) = (flown.column("alpha.position.x"), flown.column("alpha.velocity.x"));
    for k in 1..x.len() {
        // Trapezium over 10 ms: h³/12 times a jerk of some m/s³; a jump would be centimetres.
        let step = 0.005 * (v[k] + v[k - 1]);
        assert!((x[k] - x[k - 1] - step).abs() < 1e-4, "row {k}");
    }
    assert!(distance_to(&flown, "alpha", [0.0, 0.0, -2.0]) < 0.2);
}

/// A target that stands comes to the middle of the image and stays.
#[test]
fn exact_the_fixed_target_comes_to_the_middle() {
    let flown = done("track-fixed");
    // 6 s are thirty of the tracker's time constants.
    assert!(flown.last("station.image.x").abs() < 0.1 && flown.last("station.image.y").abs() < 0.1);
    // The receiver is 0.2 m towards the station of the target's position (5, 2, -1.5).
    let pan = 2.0_f64.atan2(5.0);
    let tilt = 1.5_f64.atan2(5.0_f64.hypot(2.0) - 0.2);
    assert!((flown.last("station.gimbal.pan") - pan).abs() < 1e-4);
    assert!((flown.last("station.gimbal.tilt") - tilt).abs() < 1e-4);
}

#[test]
fn prop_the_view_is_lost_and_found() {
    let flown = done("lost-view");
    let events: Vec<_> = flown.events.iter().map(|event| &event.what).collect();
    use sifre::AgentEvent::{TargetFound, TargetLost};
    assert_eq!(events.first(), Some(&&TargetFound));
    assert!(events.contains(&&TargetLost), "{events:?}");
    assert_eq!(events.last(), Some(&&TargetFound));
    assert!(flown.last("station.image.x").abs() < 20.0);
    // The cables' limit.
    let limit = 170.0_f64.to_radians();
    assert!(
        flown
            .column("station.gimbal.pan")
            .iter()
            .all(|pan| pan.abs() <= limit + 1e-9)
    );
}

/// The pass: energy in means tracked and within reach, and half the speed is about twice the energy.
#[test]
fn prop_power_transmission_passes() {
    let energy = ["power-transmission-10s", "power-transmission-20s"].map(|name| {
        let flown = done(name);
        assert!(distance_to(&flown, "alpha", [4.0, 5.0, -3.0]) < 0.1, "{name}");
        assert!(flown.metric("station.tracked_fraction") > 0.9, "{name}");
        // The nose follows the bearing of the station.
        let bearing = (-flown.last("alpha.position.y")).atan2(-flown.last("alpha.position.x"));
        let off = flown.last("alpha.attitude.yaw") - bearing;
        assert!((off.sin().atan2(off.cos())).abs() < 0.05, "{name}: {off}");
        flown.metric("station.received_energy_j")
    });
    // No more than the laser gives.
    assert!(energy[0] > 5.0 && energy[0] < 50.0, "{energy:?}");
    let ratio = energy[1] / energy[0];
    assert!((1.6..2.6).contains(&ratio), "{ratio}");
}

/// The pass that is to be optimised flies as it is, and every variable of it is a key with a value within its bounds.
#[test]
fn exact_the_pass_to_optimise_can_be_flown_and_varied() {
    let flown = done("optimise-transmission");
    assert!(flown.metric("station.tracked_fraction") > 0.9);
    let text = ready("optimise-transmission");
    let table: toml::Table = toml::from_str(&text).unwrap();
    let optimise = scenario::Scenario::from_toml_str(&text, "test").unwrap().optimise;
    for variable in optimise.expect("the table is there").variables {
        let value = scenario::get(&table, &variable.key).unwrap().as_float().unwrap();
        assert!(
            (variable.lower..=variable.upper).contains(&value),
            "{}",
            variable.key
        );
    }
}

#[test]
fn prop_two_quadrotors_are_tracked_alike() {
    let flown = done("two-quadrotors");
    for (agent, y) in [("alpha", 3.0), ("bravo", 15.0)] {
        // In height level 5 hangs as in hover.
        let z = flown.last(&format!("{agent}.position.z"));
        assert!(distance_to(&flown, agent, [4.0, y, z]) < 0.05, "{agent}");
        assert!((z + 2.0).abs() < 0.25, "{agent}");
    }
    for station in ["station-a", "station-b"] {
        assert!(flown.metric(&format!("{station}.tracked_fraction")) > 0.9);
        assert!(flown.metric(&format!("{station}.received_energy_j")) > 0.0);
    }
    assert_eq!((flown.last("alpha.level"), flown.last("bravo.level")), (1.0, 5.0));
}

/// Followers don't know the leader's acceleration, `ρ Ω²`: at their loop's frequency they cut its corner by about
/// `ρ Ω² / ω²`, 0.22 m, and keep their distance within that.
#[test]
fn prop_the_swarm_keeps_together() {
    let flown = done("swarm");
    for follower in ["north", "east", "south", "west"] {
        for time_s in [10.0, 15.0, 20.0] {
            let apart = distance(&flown, "leader", follower, time_s);
            assert!(
                (apart - 1.5).abs() < 0.25,
                "{follower} is {apart} m away at {time_s} s"
            );
        }
    }
}

/// What the filter says of its error is what its error is, within a factor of two either way. The controller holds the
/// estimate where without an estimator it holds the vehicle: the two errors add at most, but for what the estimate has wrong
/// of velocity and attitude, for which half as much again is allowed. Beside the loop nothing changes.
#[test]
fn prop_the_estimator_is_in_the_loop() {
    let text = ready("estimator-in-the-loop");
    let flown = done("estimator-in-the-loop");
    let (error, stated) = (
        flown.metric("alpha.estimate_error_rms_m"),
        flown.metric("alpha.estimate_sd_rms_m"),
    );
    assert!(
        error < 2.0 * stated && stated < 2.0 * error,
        "errs by {error} m and says {stated} m"
    );
    let (begin, end) = (text.find("[quadrotor.estimator]"), text.find("[output]"));
    let table = begin.expect("it has one")..end.expect("it comes after");
    let without = fly(&[&text[..table.start], &text[table.end..]].concat());
    let tracking = |flown: &Flown| flown.metric("alpha.position_error_rms_m");
    assert!(
        tracking(&flown) < 1.5 * (tracking(&without) + error),
        "tracks to {} m in the loop, to {} m without, and errs by {error} m",
        tracking(&flown),
        tracking(&without)
    );
    // It is flown by the estimate, not by the truth.
    assert_ne!(
        flown.column("alpha.position.x"),
        without.column("alpha.position.x")
    );
    let beside = fly(&text.replace("in_loop = true ", "in_loop = false "));
    for channel in [
        "position.x",
        "velocity.y",
        "attitude.pitch",
        "thrust.1",
        "command.4",
    ] {
        let channel = format!("alpha.{channel}");
        assert_eq!(beside.column(&channel), without.column(&channel), "{channel}");
    }
}

/// The filter begins at its initial estimate, 2 m to the north of the truth and 20 degrees to its right, and finds the truth to within
/// what it says of itself, which is better than a fix of 0.5 m.
#[test]
fn exact_a_wrong_start_is_found_out() {
    let flown = done("wrong-start");
    let error = |axis: &str, time_s: f64| {
        flown.at(&format!("alpha.estimate.{axis}"), time_s) - flown.at(&format!("alpha.{axis}"), time_s)
    };
    let heading = |time_s| error("attitude.yaw", time_s).to_degrees();
    // The first fix is still on its way: the estimate of the north is still the initial one.
    assert!((error("position.x", 0.0) - 2.0).abs() < 1e-9);
    assert!(error("position.y", 0.0).abs() < 1e-9);
    assert!((flown.at("alpha.estimate.sd.position.x", 0.0) - 2.0).abs() < 1e-9);
    let late: Vec<f64> = (1000..=2000).map(|k| f64::from(k) / 100.0).collect();
    for axis in ["position.x", "position.y", "position.z"] {
        let square: f64 = late.iter().map(|&t| error(axis, t).powi(2)).sum();
        let rms = (square / late.len() as f64).sqrt();
        let stated = flown.last(&format!("alpha.estimate.sd.{axis}"));
        // Ten seconds hold a few independent errors: by twice what it says, it would be wrong about itself.
        assert!(rms < 2.0 * stated && stated < 0.5, "{axis}: {rms} m, {stated} m");
    }
    let worst = late.iter().map(|&t| heading(t).abs()).fold(0.0, f64::max);
    assert!(worst < 5.0, "{worst} degrees");
    // It was flown by the wrong belief: the vehicle went away from where it was asked to be, and came back.
    let away = |t: f64| (flown.at("alpha.position.x", t)).hypot(flown.at("alpha.position.y", t));
    assert!(away(2.0) > 1.0, "{} m", away(2.0));
    assert!(away(20.0) < 0.6, "{} m", away(20.0));
    // With a right initial estimate the error in the north is 0.1 m.
    let told = ready("wrong-start")
        .replace("duration_s = 20.0", "duration_s = 0.1")
        .replace("initial_error = {", "# {")
        .replace("initial_deviation = {", "# {");
    let right = fly(&told);
    assert!((right.at("alpha.estimate.sd.position.x", 0.0) - 0.1).abs() < 1e-9);
    assert!((right.at("alpha.estimate.position.x", 0.0)).abs() < 1e-9);
}

/// An error that is drawn is stated unless something else is said; sensors may be listed in a line; a list of the sensors of a quality is
/// that quality.
#[test]
fn agree_estimators_said_in_other_words() {
    let text = |estimator: &str| {
        format!(
            "name = \"test\"\nduration_s = 0.2\n[[quadrotor]]\nname = \"alpha\"\nstep_s = 0.005\n\
             reference = {{ kind = \"hold\", position_m = [0, 0, -2] }}\nestimator = {{ {estimator} }}"
        )
    };
    let drawn = fly(&text("sensors = [], initial_error = { position_m = 3 }"));
    assert!((drawn.at("alpha.estimate.sd.position.y", 0.0) - 3.0).abs() < 1e-9);
    let error = drawn.at("alpha.estimate.position.y", 0.0) - drawn.at("alpha.position.y", 0.0);
    assert!(error.abs() > 1e-3 && error.abs() < 15.0, "{error}");
    let list = "[{ kind = \"accelerometer\", rate_hz = 100, noise = 0.2, turn_on_bias = 0.3, bias_drift = 0.005 }, \
         { kind = \"gyroscope\", rate_hz = 100, noise = 0.01, turn_on_bias = 0.03, bias_drift = 0.0005 }, \
         { kind = \"magnetometer\", rate_hz = 20, noise = 2 }, \
         { kind = \"sonar\", rate_hz = 10, noise = 0.03, dropout = 0.05, range = [0.2, 7.65] }, \
         { kind = \"position-fix\", rate_hz = 5, noise = 0.1, delay_s = 0.05, dropout = 0.05 }]";
    let (listed, named) = (
        fly(&text(&format!("sensors = {list}"))),
        fly(&text("sensors = \"poor\"")),
    );
    for channel in [
        "alpha.position.x",
        "alpha.estimate.velocity.z",
        "alpha.estimate.attitude.yaw",
    ] {
        assert_eq!(listed.column(channel), named.column(channel), "{channel}");
    }
    // A sensor that is too fast for the steps is reported.
    let fast = list.replace("rate_hz = 100, noise = 0.01", "rate_hz = 1000, noise = 0.01");
    let scenario =
        scenario::Scenario::from_toml_str(&text(&format!("sensors = {fast}")), "test").expect("read");
    let notes = scenario.build(&()).expect("built").notes.join("\n");
    assert!(
        notes.contains("sensors[1]") && !notes.contains("sensors[0]"),
        "{notes}"
    );
}
