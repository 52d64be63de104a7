//! Through a file and back; and no number, however wild, brings the reader down.

use proptest::prelude::*;

use super::{ALL, Vehicle, VehicleFile};

#[test]
fn exact_file_survives_its_text() {
    for text in ALL {
        let file = VehicleFile::from_toml_str(text, "builtin").expect("valid");
        let again =
            VehicleFile::from_toml_str(&file.to_toml(), "written").expect("what was written reads back");
        assert_eq!(file, again);
    }
}

#[test]
fn exact_try_from_uses_the_name_as_origin() {
    let mut file = VehicleFile::from_toml_str(ALL[0], "builtin").expect("valid");
    assert!(Vehicle::try_from(file.clone()).is_ok());
    file.airframe.mass_kg.value = 1400.0;
    let message = Vehicle::try_from(file).expect_err("1.4 t").to_string();
    assert!(
        message.starts_with("Qball-X4 (nominal): `airframe.mass_kg`"),
        "{message}"
    );
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
            for rotor in &mut vehicle.rotors {
                rotor.position -= vehicle.airframe.centre_of_mass;
            }
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

/// Puts numbers into a file in turn, a bounded number of keys apart.
fn poison(file: &mut VehicleFile, places: &[usize], numbers: &[f64]) {
    let mut all = vec![
        &mut file.environment.gravity_m_s2.value,
        &mut file.environment.air_density_kg_m3.value,
        &mut file.airframe.mass_kg.value,
        &mut file.airframe.inertia_xx_kg_m2.value,
        &mut file.airframe.inertia_yy_kg_m2.value,
        &mut file.airframe.inertia_zz_kg_m2.value,
        &mut file.airframe.arm_length_m.value,
        &mut file.pwm.minimum.value,
        &mut file.pwm.maximum.value,
        &mut file.pwm.zero_thrust.value,
        &mut file.linear_rotor.thrust_gain_n.value,
        &mut file.linear_rotor.torque_gain_n_m.value,
        &mut file.linear_rotor.bandwidth_rad_s.value,
    ];
    all.extend(&mut file.airframe.centre_of_mass_m.value);
    all.extend(
        file.rotors
            .iter_mut()
            .flat_map(|rotor| &mut rotor.hub_position_m.value),
    );
    if let Some(group) = &mut file.rotor_dynamics {
        all.extend([
            &mut group.thrust_c1_per_s.value,
            &mut group.torque_c2_per_s2.value,
        ]);
    }
    if let Some(group) = &mut file.motor {
        all.extend([&mut group.resistance_ohm.value, &mut group.controller_lag_s.value]);
    }
    if let Some(group) = &mut file.drag {
        all.extend(&mut group.quadratic_n_s2_m2.value);
    }
    let count = all.len();
    for (place, number) in places.iter().zip(numbers) {
        *all[place % count] = *number;
    }
}

proptest! {
    #[test]
    fn prop_vehicle_survives_its_file(vehicle in scaled_vehicle()) {
        prop_assume!(vehicle.validate("scaled").is_ok());
        let again = Vehicle::from_toml_str(&vehicle.to_toml("test"), "written").expect("what was written reads back");
        // Hubs are written in the geometric frame: one addition and one subtraction of lengths under a metre.
        for (a, b) in vehicle.rotors.iter().zip(&again.rotors) {
            prop_assert!((a.position - b.position).norm() < 1e-15);
        }
        prop_assert_eq!(Vehicle { rotors: again.rotors.clone(), ..vehicle }, again);
    }

    #[test]
    fn prop_garbage_is_refused_or_sound(
        which in 0..ALL.len(),
        places in prop::collection::vec(any::<usize>(), 1..8),
        numbers in prop::collection::vec(garbage(), 8),
    ) {
        let mut file = VehicleFile::from_toml_str(ALL[which], "builtin").expect("valid");
        poison(&mut file, &places, &numbers);
        if let Ok(vehicle) = Vehicle::try_from(file) {
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
