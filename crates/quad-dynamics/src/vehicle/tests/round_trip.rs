//! Through a file and back; and no number, however wild, brings the reader down.

use proptest::prelude::*;

use super::{ALL, Vehicle, VehicleFile};

#[test]
fn exact_file_survives_its_text() {
    for text in ALL {
        let file = VehicleFile::parse(text, "builtin").expect("valid");
        let again = VehicleFile::parse(&file.to_toml(), "written").expect("what was written reads back");
        assert_eq!(file, again);
    }
}

/// Every number of a file, through one random factor each, as a random but mostly valid vehicle.
fn scaled_vehicle() -> impl Strategy<Value = Vehicle> {
    let factor = 0.9..1.1_f64;
    (
        0..ALL.len(),
        prop::array::uniform12(factor),
        prop::array::uniform3(-0.002..0.002_f64),
    )
        .prop_map(|(which, f, shift)| {
            let mut vehicle = Vehicle::from_toml_str(ALL[which], "builtin").expect("valid");
            vehicle.airframe.mass *= f[0];
            vehicle.airframe.arm_length *= f[1];
            vehicle.airframe.inertia *= f[2];
            vehicle.airframe.inertia[(0, 1)] = 0.01 * f[3] * vehicle.airframe.inertia[(0, 0)];
            vehicle.airframe.inertia[(1, 0)] = vehicle.airframe.inertia[(0, 1)];
            vehicle.airframe.centre_of_mass = shift.into();
            vehicle.linear_rotor.thrust_gain *= f[4];
            vehicle.linear_rotor.torque_gain *= f[5];
            vehicle.linear_rotor.bandwidth *= f[6];
            vehicle.environment.air_density *= f[7];
            if let Some(battery) = &mut vehicle.battery {
                battery.full_voltage *= f[8].max(1.0);
            }
            if let Some(drag) = &mut vehicle.drag {
                drag.quadratic *= f[9];
                drag.rate_damping *= f[10];
            }
            if let Some(motor) = &mut vehicle.motor {
                motor.resistance *= f[11];
            }
            vehicle
        })
}

/// Doubles of every size and sign, zero, infinities and NaN among them.
fn garbage() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>(),
        -10.0..10.0_f64,
        Just(0.0),
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::MIN_POSITIVE),
        Just(f64::MAX),
    ]
}

/// Puts numbers into a file at places counted around.
fn poison(file: &mut VehicleFile, places: &[usize], numbers: &[f64]) {
    let mut count = 0;
    file.for_each_number(|_, _| count += 1);
    for (place, &to) in places.iter().zip(numbers) {
        let mut k = 0;
        file.for_each_number_mut(|_, number| {
            if k == place % count {
                number.value = to;
            }
            k += 1;
        });
    }
}

proptest! {
    #[test]
    fn prop_vehicle_survives_its_file(vehicle in scaled_vehicle()) {
        prop_assume!(vehicle.validate("scaled").is_ok());
        let again = Vehicle::from_toml_str(&vehicle.to_toml("test"), "written").expect("what was written reads back");
        prop_assert_eq!(vehicle, again);
    }

    #[test]
    fn prop_garbage_is_refused_or_sound(
        which in 0..ALL.len(),
        places in prop::collection::vec(any::<usize>(), 1..8),
        numbers in prop::collection::vec(garbage(), 8),
    ) {
        let mut file = VehicleFile::parse(ALL[which], "builtin").expect("valid");
        poison(&mut file, &places, &numbers);
        if let Ok(vehicle) = Vehicle::from_file(&file, "garbage") {
            prop_assert!(vehicle.control_matrix_inverse().expect("validated").iter().all(|c| c.is_finite()));
            prop_assert!(vehicle.hover_thrust_per_rotor().is_finite());
        }
    }

    #[test]
    fn prop_any_text_is_read_without_panic(text in "\\PC{0,200}") {
        let _ = Vehicle::from_toml_str(&text, "noise");
    }

    #[test]
    fn prop_torn_file_is_refused_without_panic(which in 0..ALL.len(), share in 0.0..1.0_f64) {
        let text = ALL[which];
        let mut end = (share * text.len() as f64) as usize;
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let _ = Vehicle::from_toml_str(&text[..end], "torn");
    }
}
