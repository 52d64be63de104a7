//! The readers of the data sets on files made here: conversion by hand, and mutated files that never pass a NaN on.

use super::*;
use crate::measurement::ReadError;
use proptest::prelude::*;

const ARPL_HEADER: &str =
    "t[s],acc_x[g],acc_y[g],acc_z[g],gyro_x[deg/s],gyro_y[deg/s],gyro_z[deg/s],m1[0..65535],m2,m3,m4\n";
const NANOBENCH_HEADER: &str = "t,px,py,pz,qx,qy,qz,qw,vx,vy,vz,wx_vicon,wy_vicon,wz_vicon,imu_acc_x,imu_acc_y,imu_acc_z,\
imu_gyro_x,imu_gyro_y,imu_gyro_z,motor_motor_m1,motor_motor_m2,motor_motor_m3,motor_motor_m4,sp_ctrltarget_x,\
sp_ctrltarget_y,sp_ctrltarget_z,pwr_pm_vbat\n";

fn arpl_file() -> String {
    let mut text = String::from(ARPL_HEADER);
    for k in 0..20 {
        text += &format!(
            "{:.3},0.1,0.2,1.0,90,-180,45,{},65535,0,13107\n",
            0.001 * f64::from(k),
            1000 * k
        );
    }
    text
}

fn nanobench_file() -> String {
    let mut text = String::from(NANOBENCH_HEADER);
    for k in 0..20 {
        let t = 1_772_422_003.76 + 0.01 * f64::from(k);
        text += &format!(
            "{t:.6},1,2,3,0,0,0.6,0.8,4,5,6,0.1,0.2,0.3,0.1,0.2,1,7,8,9,13107,0,0,65535,1,2,3,3.9\n"
        );
    }
    text
}

#[test]
fn exact_arpl_in_forward_right_down_and_si() {
    let log = read_arpl(arpl_file().as_bytes()).unwrap();
    let near = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).amax() < 1e-12, "{a:?}");
    near(log.specific_force[3], [0.981, -1.962, -9.81]);
    let half_turn = std::f64::consts::PI;
    near(log.body_rates[3], [half_turn / 2.0, half_turn, -half_turn / 4.0]);
    assert_eq!(log.commands[3], [3000.0 / 65535.0, 1.0, 0.0, 0.2]);
    assert_eq!(log.window(0.0045, 0.0075), 5..8);
    assert_eq!(log.window(9.0, 8.0), 20..20);
}

#[test]
fn exact_nanobench_in_north_east_down() {
    let flight = read_nanobench(nanobench_file().as_bytes()).unwrap();
    let k = 4;
    assert!((flight.inertial.time[k] - 0.04).abs() < 1e-6);
    assert_eq!(flight.position[k], Vector3::new(1.0, -2.0, -3.0));
    assert_eq!(flight.velocity[k], Vector3::new(4.0, -5.0, -6.0));
    assert_eq!(flight.captured_rates[k], Vector3::new(0.1, -0.2, -0.3));
    assert_eq!(flight.inertial.body_rates[k], Vector3::new(7.0, -8.0, -9.0));
    assert_eq!(flight.set_point[k], Vector3::new(1.0, -2.0, -3.0));
    assert_eq!(flight.voltage[k], 3.9);
    // Turned left by 2 atan2(0.6, 0.8).
    let yaw = flight.attitude[k].euler_angles().yaw;
    assert!((yaw + 2.0 * 0.6_f64.atan2(0.8)).abs() < 1e-12, "{yaw}");
}

#[test]
fn exact_a_quaternion_that_is_none_is_refused_with_its_line() {
    let text = nanobench_file().replacen("0,0,0.6,0.8", "0,0,0,0", 1);
    match read_nanobench(text.as_bytes()) {
        Err(ReadError::NoAttitude { line: 2, length: 0.0 }) => {}
        other => panic!("{other:?}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prop_mutated_flights_never_panic_nor_pass_a_nan(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), prop::sample::select(b"0179.,-e\n#nai\xff".to_vec()), 0..3_u8), 1..6),
    ) {
        let mutated = |text: String| {
            let mut bytes = text.into_bytes();
            for (index, byte, kind) in &edits {
                let place = index.index(bytes.len());
                match kind {
                    0 => bytes[place] = *byte,
                    1 => bytes.insert(place, *byte),
                    _ => { bytes.remove(place); }
                }
            }
            bytes
        };
        if let Ok(log) = read_arpl(mutated(arpl_file()).as_slice()) {
            prop_assert!(finite(&log));
        }
        if let Ok(flight) = read_nanobench(mutated(nanobench_file()).as_slice()) {
            prop_assert!(finite(&flight.inertial));
            for vectors in [&flight.position, &flight.velocity, &flight.captured_rates, &flight.set_point] {
                prop_assert!(vectors.iter().all(|v| v.iter().all(|x| x.is_finite())));
            }
            prop_assert!(flight.attitude.iter().all(|q| (q.norm_squared() - 1.0).abs() < 1e-9));
            prop_assert!(flight.voltage.iter().all(|v| v.is_finite()));
        }
        let _ = read_motor_steps(mutated(arpl_file()).as_slice());
        let _ = read_motor_table(mutated(nanobench_file()).as_slice());
    }
}

fn finite(log: &InertialLog) -> bool {
    let vectors = log.specific_force.iter().chain(&log.body_rates);
    vectors.clone().all(|v| v.iter().all(|x| x.is_finite()))
        && log.commands.iter().flatten().all(|c| (0.0..=1.0).contains(c))
        && log.time.windows(2).all(|t| t[0] < t[1])
}
