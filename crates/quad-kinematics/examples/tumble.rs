//! A tumbling body integrated in three representations: where they agree, and where Euler angles give up.
//!
//! Prints a short report: `cargo run -p quad-kinematics --example tumble`.

use nalgebra::{Matrix3, SVector, Vector3};
use quad_kinematics::{Body, EulerAngles, EulerRates, Quaternion, Rotation, World};
use quad_math::{Flat, rk4};

/// Time step, s, and how often the report prints, in steps.
const STEP_S: f64 = 1e-3;
const PRINT_EVERY: u32 = 200;

/// Body rates, rad/s: a steady pitch up with a wobble, which leads through the vertical.
fn body_rates(t: f64) -> Vector3<f64> {
    Vector3::new(0.05 * (3.0 * t).sin(), 1.1, 0.05 * (2.0 * t).cos())
}

fn rotation_of(flat: &SVector<f64, 9>) -> Rotation<f64, Body, World> {
    Rotation::from_matrix(Matrix3::from_column_slice(flat.as_slice()))
}

fn main() {
    let start = EulerAngles::new(0.02, 0.05, 0.5);
    let (mut euler, mut quaternion) = (start, start.quaternion());
    let mut matrix: SVector<f64, 9> = SVector::read(start.rotation().matrix.as_slice());
    println!("Pitching up through the vertical; roll, pitch, yaw in degrees from the quaternion.\n");
    println!("  t, s     roll    pitch      yaw   |q − R|    |q − η|   |η̇|, rad/s");
    for k in 0..=2000_u32 {
        let t = f64::from(k) * STEP_S;
        if k % PRINT_EVERY == 0 {
            let r: Matrix3<f64> = quaternion.rotation().matrix;
            let angles = quaternion.euler_angles().vector().map(f64::to_degrees);
            let rates: EulerRates<f64> = quaternion.euler_angles().rates(&body_rates(t));
            println!(
                "{t:>6.1} {:>8.2} {:>8.2} {:>8.2} {:>9.1e} {:>10.1e} {:>12.2}",
                angles.x,
                angles.y,
                angles.z,
                (r - rotation_of(&matrix).matrix).norm(),
                (r - euler.rotation().matrix).norm(),
                rates.vector().norm(),
            );
        }
        euler = rk4(
            &|t, x: &EulerAngles<f64>| x.rates(&body_rates(t)),
            t,
            &euler,
            STEP_S,
        );
        quaternion = rk4(
            &|t, x: &Quaternion<f64>| x.derivative(&body_rates(t)),
            t,
            &quaternion,
            STEP_S,
        );
        let turn =
            |t, x: &SVector<f64, 9>| SVector::read(rotation_of(x).derivative(&body_rates(t)).as_slice());
        matrix = rk4(&turn, t, &matrix, STEP_S);
    }
    println!(
        "\nNear ±90° of pitch the rates of the Euler angles grow without bound; the others don't notice."
    );
}
