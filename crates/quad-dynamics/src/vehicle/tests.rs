//! Every class of bad value is refused with its key; what is accepted survives the way through a file.

mod bad_input;
mod derivation;
mod round_trip;
mod uncertain;

use super::{Vehicle, VehicleError, VehicleFile, builtin};

const ALL: [&str; 3] = [
    builtin::QBALL_X4_TOML,
    builtin::QBALL_X4_VENDOR_TOML,
    builtin::CRAZYFLIE_TOML,
];

#[test]
fn exact_builtin_vehicles_are_valid() {
    assert_eq!(Vehicle::qball_x4().name, "Qball-X4 (nominal)");
    assert_eq!(Vehicle::qball_x4_vendor().name, "Qball-X4 (vendor)");
    assert_eq!(Vehicle::crazyflie().name, "Crazyflie 2");
}

/// Two arms of 0.2 m and a propeller of 10 inches, from tip to tip; from hub to hub without it.
#[test]
fn exact_span_of_the_qball() {
    let mut vehicle = Vehicle::qball_x4();
    approx::assert_relative_eq!(vehicle.span(), 0.4 + 0.254, max_relative = 1e-12);
    vehicle.propeller = None;
    approx::assert_relative_eq!(vehicle.span(), 0.4, max_relative = 1e-12);
}

/// `M_x = L (T_3 − T_4)`, `M_y = L (T_2 − T_1)`, rotors 1, 2 clockwise, 3, 4 counter-clockwise.
#[test]
#[rustfmt::skip]
fn exact_control_matrix_of_the_plus_layout() {
    let expected = nalgebra::Matrix4::new(
         1.0,  1.0,  1.0,  1.0,
         0.0,  0.0,  1.0, -1.0,
        -1.0,  1.0,  0.0,  0.0,
        -1.0, -1.0,  1.0,  1.0,
    );
    assert_eq!(Vehicle::qball_x4().control_matrix(), expected);
}

/// On the X layout every rotor acts on every axis, with the arm's share `1/√2`; signs from the mixer of the firmware in
/// forward-left-up axes, pitch and yaw turned to forward-right-down.
#[test]
#[rustfmt::skip]
fn exact_control_matrix_of_the_x_layout() {
    let a = std::f64::consts::FRAC_1_SQRT_2;
    let expected = nalgebra::Matrix4::new(
        1.0,  1.0,  1.0,  1.0,
         -a,   -a,    a,    a,
          a,   -a,   -a,    a,
        1.0, -1.0,  1.0, -1.0,
    );
    // The arm length in the file has six digits.
    approx::assert_relative_eq!(Vehicle::crazyflie().control_matrix(), expected, max_relative = 1e-6);
}

#[test]
fn exact_inverse_undoes_the_control_matrix() {
    for vehicle in [Vehicle::qball_x4(), Vehicle::crazyflie()] {
        let product = vehicle.control_matrix() * vehicle.control_matrix_inverse().expect("validated");
        // A handful of roundings of numbers of order one.
        approx::assert_abs_diff_eq!(product, nalgebra::Matrix4::identity(), epsilon = 1e-14);
    }
}

#[test]
fn exact_hover_thrust_and_zeroed_range() {
    let vehicle = Vehicle::qball_x4_vendor();
    // One rounding each.
    approx::assert_relative_eq!(
        vehicle.hover_thrust_per_rotor(),
        1.4 * 9.81 / 4.0,
        max_relative = 1e-15
    );
    approx::assert_relative_eq!(*vehicle.zeroed_range().end(), 0.05, max_relative = 1e-15);
    assert_eq!(*vehicle.zeroed_range().start(), 0.0);
}

/// The centre of mass shifts the hubs, and with them roll and pitch of the control matrix.
#[test]
fn exact_centre_of_mass_shifts_the_hubs() {
    let text = builtin::QBALL_X4_TOML.replace(
        "centre_of_mass_m = { value = [0.0, 0.0, 0.0]",
        "centre_of_mass_m = { value = [0.05, 0.0, 0.01]",
    );
    let vehicle = Vehicle::from_toml_str(&text, "shifted.toml").expect("valid");
    // One rounding of a difference.
    approx::assert_relative_eq!(vehicle.hubs()[1].x, 0.15, max_relative = 1e-15);
    approx::assert_relative_eq!(vehicle.hubs()[0].z, -0.01, max_relative = 1e-15);
    approx::assert_relative_eq!(vehicle.control_matrix()[(2, 0)], -1.25, max_relative = 1e-15);
}

#[test]
fn exact_missing_group_names_vehicle_group_and_model() {
    let vehicle = Vehicle::qball_x4_vendor();
    let error = vehicle
        .require_motor("the mechanistic rotor")
        .expect_err("the vendor gives no motor");
    assert_eq!(
        error.to_string(),
        "vehicle `Qball-X4 (vendor)` has no [motor] parameters, which the mechanistic rotor needs"
    );
    let missing = [
        vehicle.require_rotor_dynamics("x").map(|_| ()),
        vehicle.require_polynomial_rotor("x").map(|_| ()),
        vehicle.require_propeller("x").map(|_| ()),
        vehicle.require_battery("x").map(|_| ()),
        vehicle.require_drag("x").map(|_| ()),
    ];
    assert!(
        missing
            .iter()
            .all(|result| matches!(result, Err(VehicleError::MissingGroup { .. })))
    );
    let full = Vehicle::crazyflie();
    assert!(full.require_motor("x").is_ok() && full.require_drag("x").is_ok());
}
