//! Keys by their path, and the schema.

use crate::support::ready;
use scenario::{KeyError, Scenario, get, set};
use toml::{Table, Value};

fn table() -> Table {
    toml::from_str(&ready("two-quadrotors")).expect("a ready scenario")
}

#[test]
fn exact_agents_are_found_by_number_and_by_name() {
    let mut table = table();
    set(&mut table, "quadrotor.bravo.level", 4).unwrap();
    assert_eq!(get(&table, "quadrotor.1.level"), Ok(&Value::from(4)));
    assert_eq!(get(&table, "quadrotor.bravo.level"), Ok(&Value::from(4)));
    // A table on the way is made where there is none.
    set(&mut table, "quadrotor.0.controller.height.settling_time_s", 1.5).unwrap();
    set(&mut table, "quadrotor.bravo.reference.waypoints.1.time_s", 8.0).unwrap();
    let scenario = Scenario::from_table(&table, "changed").unwrap();
    assert_eq!(scenario.quadrotor[0].controller.height.settling_time_s, Some(1.5));
    assert_eq!(scenario.quadrotor[1].level.number(), 4);
}

#[test]
fn exact_every_boundary_condition_of_a_pass_is_a_key() {
    let mut table: Table = toml::from_str(&ready("power-transmission-10s")).unwrap();
    for (key, value) in [
        ("x_0_m", 5.0),
        ("x_dot_0_m_s", -1.5),
        ("x_f_m", -8.0),
        ("x_dot_f_m_s", 1.5),
    ] {
        set(&mut table, &format!("quadrotor.alpha.reference.{key}"), value).unwrap();
    }
    let scenario = Scenario::from_table(&table, "changed").unwrap();
    let run = scenario.build(&()).unwrap().start().unwrap();
    let alpha = run.simulation.published("alpha").unwrap();
    // It starts as its reference does: position, velocity, nose towards the station at the origin.
    assert_eq!(alpha.position, nalgebra::Vector3::new(5.0, -5.0, -3.0));
    // The velocity goes into body axes and back.
    assert!((alpha.velocity - nalgebra::Vector3::new(-1.5, 0.0, 0.0)).norm() < 1e-15);
    let heading = alpha.rotation.euler_angles().yaw;
    assert!((heading - 5.0_f64.atan2(-5.0)).abs() < 1e-15);
}

#[test]
fn exact_wrong_paths_say_what_there_is() {
    let mut table = table();
    let mut refuse = |path: &str| set(&mut table, path, 1).unwrap_err();
    let missing = refuse("quadrotor.charlie.level");
    assert!(
        matches!(&missing, KeyError::NoEntry { entry, known, .. } if entry == "charlie" && known == "alpha, bravo")
    );
    assert!(matches!(refuse("quadrotor.2.level"), KeyError::NoEntry { .. }));
    assert!(matches!(refuse("name.first"), KeyError::NotATable { .. }));
    assert!(matches!(refuse("quadrotor..level"), KeyError::Empty { .. }));
    assert!(matches!(
        get(&self::table(), "quadrotor.0.mass"),
        Err(KeyError::NoKey { .. })
    ));
    // A key that scenarios don't have is refused when the table is read.
    set(&mut table, "quadrotor.alpha.mass", 1).unwrap();
    let error = Scenario::from_table(&table, "changed").unwrap_err().to_string();
    assert!(error.contains("unknown key `quadrotor[0].mass`"), "{error}");
}

/// The schema knows every key that a scenario with all its tables writes, and forbids others.
#[test]
fn agree_the_schema_and_the_types_know_the_same_keys() {
    let schema = Scenario::json_schema();
    assert_eq!(schema["additionalProperties"], false);
    let written = toml::Value::try_from(Scenario::from_table(&table(), "ready").unwrap()).unwrap();
    let properties = |schema: &serde_json::Value| -> Vec<String> {
        schema["properties"]
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect()
    };
    let estimator = toml::Value::try_from(scenario::EstimatorFile::default()).unwrap();
    let known = properties(&schema["$defs"]["EstimatorFile"]);
    for key in estimator.as_table().unwrap().keys() {
        assert!(known.contains(key), "EstimatorFile.{key}");
    }
    for (key, list) in written.as_table().unwrap() {
        assert!(properties(&schema).contains(key), "{key}");
        let definition = match key.as_str() {
            "quadrotor" => "QuadrotorFile",
            "ets" => "EtsFile",
            _ => continue,
        };
        let known = properties(&schema["$defs"][definition]);
        for key in list[0].as_table().unwrap().keys() {
            assert!(known.contains(key), "{definition}.{key}");
        }
    }
}
