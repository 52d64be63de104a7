//! What is kept of a flight: metrics by name, costs, rows.

use crate::support::ready;
use scenario::{End, Flown, Keep, MetricError, Scenario, Setting, Template};

fn flown(name: &str, settings: &[Setting], keep: &Keep) -> Flown {
    let template = Template::from_toml_str(&ready(name), name).unwrap();
    template.with(settings).unwrap().fly(&(), keep).unwrap()
}

#[test]
fn exact_nothing_is_kept_unless_asked_for() {
    let flown = flown("hover", &[], &Keep::NOTHING);
    assert_eq!(flown.ending.end, End::Done);
    assert!(flown.metrics.is_empty() && flown.costs.is_empty() && flown.recording.is_empty());
}

/// A critically damped loop of second order with an extra pole far away, designed to settle in 2 s: it does, and has no overshoot.
#[test]
fn exact_metrics_of_a_step() {
    let flown = flown("step-in-height", &[], &Keep::METRICS);
    let settled_s = flown.metric("z.settling_time_s").unwrap();
    // Rows are 20 ms apart, and the extra pole adds 1/20 of a time constant.
    assert!((settled_s - 2.0).abs() < 0.05, "{settled_s}");
    // Of a loop that is linear there is nothing beyond but rounding and the hold of the commands.
    assert!(flown.metric("alpha.z.overshoot").unwrap() < 1e-3);
    // The last 5 % of 4 s, two settling times after the step: below (1 + ωt) e^(−ωt) of a metre at ω = 2.9 rad/s.
    assert!(flown.metric("z.steady_state_error_m").unwrap().abs() < 2e-4);
    // The other axes are asked for no step.
    assert!(flown.metrics.iter().all(|m| !m.name.starts_with("alpha.x.")));
}

/// Of several steps the last one counts: the first one up is undone by one down.
#[test]
fn prop_the_last_step_counts() {
    let at_end = flown(
        "step-in-height",
        &[Setting::new("duration_s", 12.0)],
        &Keep::METRICS,
    );
    let first_only = flown(
        "step-in-height",
        &[Setting::new("duration_s", 5.5)],
        &Keep::METRICS,
    );
    let overshoot = |flown: &Flown| flown.metric("z.overshoot").unwrap();
    assert!((overshoot(&at_end) - overshoot(&first_only)).abs() < 1e-3);
    // A flight that ends right after a step has no rows to say anything of it.
    let too_short = flown(
        "step-in-height",
        &[Setting::new("duration_s", 6.1)],
        &Keep::METRICS,
    );
    assert!(matches!(
        too_short.metric("z.overshoot"),
        Err(MetricError::Unknown { .. })
    ));
}

#[test]
fn exact_metrics_are_found_by_name_and_by_short_name() {
    let flown = flown("two-quadrotors", &[], &Keep::METRICS);
    let names: Vec<&str> = flown.metrics.iter().map(|m| m.name.as_str()).collect();
    let full = names.iter().find(|name| name.ends_with(".tilt_max_deg")).unwrap();
    assert!(flown.metric(full).unwrap().is_finite());
    let ambiguous = flown.metric("tilt_max_deg").unwrap_err();
    assert!(matches!(&ambiguous, MetricError::Ambiguous { candidates, .. } if candidates.contains(full)));
    let unknown = flown.metric("tilt").unwrap_err().to_string();
    assert!(
        unknown.contains("no such metric `tilt`") && unknown.contains(full),
        "{unknown}"
    );
}

/// A metric of a flight that ended early is not finite, whether it exists or not.
#[test]
fn exact_a_flight_that_ends_early_has_no_metrics() {
    let down = Setting::new("quadrotor.alpha.reference.position_m", vec![0.0, 0.0, 5.0]);
    let flown = flown("hover", &[down], &Keep::METRICS);
    assert_eq!(flown.ending.end, End::Early);
    assert!(flown.metric("alpha.tilt_max_deg").unwrap().is_nan());
    assert!(flown.metric("z.overshoot").unwrap().is_nan());
}

/// The metric is the cost, and the cost is that of the weights in the file.
#[test]
fn agree_the_metric_phi_is_the_cost_that_is_optimised() {
    let keep = Keep {
        costs: true,
        ..Keep::METRICS
    };
    let name = "optimise-transmission";
    let short = Setting::new("duration_s", 2.0);
    let once = flown(name, std::slice::from_ref(&short), &keep);
    let [cost] = &once.costs[..] else {
        panic!("one station: {:?}", once.costs);
    };
    assert_eq!(once.metric("phi").unwrap(), cost.outcome.cost);
    let scenario = Scenario::from_toml_str(&ready(name), name).unwrap();
    assert_eq!(scenario.optimised_pair().unwrap(), cost.pair);
    // Φ is linear in its weights: twice the weight of the range adds the range's term once more.
    let twice = flown(name, &[short, Setting::new("optimise.weights.range", 2.0)], &keep);
    let added = twice.metric("phi").unwrap() - once.metric("phi").unwrap();
    let term = cost.outcome.means.range;
    assert!(
        (added - term).abs() <= 1e-12 * cost.outcome.cost,
        "{added} {term}"
    );
}

/// Scenarios that follow from a template are those of the changed file.
#[test]
fn agree_a_template_is_the_file_with_its_keys_changed() {
    let text = ready("hover");
    let template = Template::from_toml_str(&text, "hover").unwrap();
    assert_eq!(
        template.scenario(),
        &Scenario::from_toml_str(&text, "hover").unwrap()
    );
    assert_eq!(&template.with([]).unwrap(), template.scenario());
    let level = [Setting::new("quadrotor.alpha.level", 5)];
    let changed = template.with(&level).unwrap();
    assert_eq!(changed.quadrotor[0].level, quad_dynamics::Level::Five);
    let kept = template.set(&level).unwrap();
    assert_eq!(kept.scenario(), &changed);
    assert_eq!(kept.get("quadrotor.alpha.level"), Some(&toml::Value::from(5)));
    assert_eq!(kept.get("quadrotor.alpha.levels"), None);
    let replaced = kept.clone().replaced(changed.clone()).unwrap();
    assert_eq!(&replaced.with([]).unwrap(), &changed);
    assert_eq!(
        &Scenario::from_table(replaced.table(), "replaced").unwrap(),
        &changed
    );
}

/// The message names the key and what was set.
#[test]
fn exact_a_key_that_does_not_exist_is_named() {
    let template = Template::from_toml_str(&ready("hover"), "hover.toml").unwrap();
    let refusal = |key: &str| {
        let error = template.with(&[Setting::new(key, 1)]).unwrap_err();
        error.to_string()
    };
    assert!(refusal("quadrotor.bravo.level").contains("bravo"));
    let unknown = refusal("quadrotor.alpha.levle");
    assert!(
        unknown.contains("levle") && unknown.contains("hover.toml with quadrotor.alpha.levle = 1"),
        "{unknown}"
    );
}

/// The station begins to look along the plane of the receiver, where the footprint of its beam is endless.
#[test]
fn exact_energies_are_numbers_where_the_beam_is_along_the_receiver() {
    let text = "name = 'x'\nduration_s = 0.1\n\
                [[quadrotor]]\nname = 'a'\nfacing = 'st'\nreference = { kind = 'hold', position_m = [5, 0, -2] }\n\
                [[ets]]\nname = 'st'\ntracks = 'a'\npan_deg = -90\n";
    let scenario = Scenario::from_toml_str(text, "test").unwrap();
    let flown = scenario.fly(&(), &Keep::METRICS).unwrap();
    let metric = |name: &str| flown.metric(name).unwrap();
    // The beam passes 5 m beside it.
    assert_eq!(
        (metric("received_energy_j"), metric("electrical_energy_j")),
        (0.0, 0.0)
    );
    assert!(metric("missed_energy_j") > 0.0);
}
