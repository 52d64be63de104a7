//! Makes the example files in the virtual laboratory: `cargo run -p identify --example make_templates`.

use quad_dynamics::Vehicle;
use quad_ndi::{AttitudeSettings, LoopSettings, Settings};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use sysid::laboratory::flights::FlightTest;
use sysid::laboratory::generator;
use sysid::laboratory::load_cells::{Channel, LoadCell};
use sysid::laboratory::pendulum::{Axis, PendulumRig};
use sysid::laboratory::supports::{SupportRig, icosahedral_cage};
use sysid::laboratory::thrust_stand::{BenchSupply, Prbs, StaticSweep, ThrustStand, uniform_times};

/// Seed of all examples.
const SEED: u64 = 1;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("template");
    std::fs::write(folder.join("centre-of-mass.csv"), centre_of_mass()?)?;
    std::fs::write(folder.join("pendulum.csv"), pendulum()?)?;
    std::fs::write(folder.join("load-cell.csv"), load_cell()?)?;
    std::fs::write(folder.join("load-cell-torque.csv"), torque_cell()?)?;
    std::fs::write(folder.join("thrust-stand.csv"), thrust_stand()?)?;
    std::fs::write(folder.join("rotor-response.csv"), rotor_response()?)?;
    std::fs::write(folder.join("flight.csv"), flight()?)?;
    Ok(())
}

fn centre_of_mass() -> Result<String, Box<dyn Error>> {
    let cage = icosahedral_cage(0.35);
    let rig = SupportRig::default();
    let mut text = String::from(
        "# A Qball-X4 standing on three scales in three orientations: an example from the virtual laboratory, not measured.\n\
         # orientation: number of the triangle stood on; x, y, z: each support along the airframe's axes (forward, right, down)\n\
         # from its geometric centre, m; force: what the scale shows, N, tared.\n\
         orientation,x_1_m,y_1_m,z_1_m,force_1_n,x_2_m,y_2_m,z_2_m,force_2_n,x_3_m,y_3_m,z_3_m,force_3_n\n",
    );
    let faces = [cage[0], cage[3], cage[7]];
    for p in rig.measure(&Vehicle::qball_x4(), &faces, &mut generator(SEED))? {
        write!(text, "{}", p.orientation)?;
        for (point, force) in p.points().iter().zip(p.forces()) {
            write!(text, ",{:.4},{:.4},{:.4},{force:.3}", point.x, point.y, point.z)?;
        }
        text.push('\n');
    }
    Ok(text)
}

fn pendulum() -> Result<String, Box<dyn Error>> {
    let mut text = String::from(
        "# A Qball-X4 swinging about z_B on two strings: an example from the virtual laboratory, not measured.\n\
         # time_s: s, rising; angle_rad: angle about the vertical, rad, from any origin within half a turn.\n\
         # This one: --axis yaw --mass-kg 1.4 --half-spacing-m 0.2 --length-m 0.7\n\
         time_s,angle_rad\n",
    );
    for s in PendulumRig::default().swing(&Vehicle::qball_x4(), Axis::Yaw, &mut generator(SEED))? {
        writeln!(text, "{:.3},{:.4}", s.time_s, s.angle_rad)?;
    }
    Ok(text)
}

fn load_cell() -> Result<String, Box<dyn Error>> {
    let cell = LoadCell::of(&Vehicle::qball_x4(), Channel::Thrust);
    let mut text = format!(
        "# Known loads on a thrust cell, up and down three times: an example from the virtual laboratory, not measured.\n\
         # load_n: hung load, N; reading_v: what the cell shows, V. Three loads or more, each more than once.\n\
         # This one: --capacity-n {:.1}\n\
         load_n,reading_v\n",
        cell.capacity
    );
    for s in cell.calibrate(11, 3, &mut generator(SEED))? {
        writeln!(text, "{:.3},{:.5}", s.load, s.reading_v)?;
    }
    Ok(text)
}

fn torque_cell() -> Result<String, Box<dyn Error>> {
    let cell = LoadCell::of(&Vehicle::qball_x4(), Channel::TorqueClockwise);
    let mut text = format!(
        "# Known loads on a torque cell, clockwise, up and down three times: an example from the virtual laboratory, not measured.\n\
         # load_n_m: weight times arm, N m, positive clockwise seen from above; reading_v: what the cell shows, V. Calibrate the\n\
         # directions in files of their own. Three loads or more, each more than once.\n\
         # This one: --capacity-n-m {:.2}\n\
         load_n_m,reading_v\n",
        cell.capacity
    );
    for s in cell.calibrate(11, 3, &mut generator(SEED))? {
        writeln!(text, "{:.5},{:.5}", s.load, s.reading_v)?;
    }
    Ok(text)
}

fn thrust_stand() -> Result<String, Box<dyn Error>> {
    let sweep = StaticSweep {
        duties: (0..12).map(|i| 0.064 + 0.002 * f64::from(i)).collect(),
        supplies: [10.5, 11.1, 11.7]
            .map(|voltage_v| BenchSupply::Regulated { voltage_v })
            .into(),
        readings: 200,
    };
    let mut text = String::from(
        "# Steady readings of one rotor on a thrust stand: an example from the virtual laboratory, not measured.\n\
         # duty: raw PWM duty, 0 to 1; battery_voltage_v: at the motor controller, V; thrust_n: N, positive up;\n\
         # torque_n_m: reaction torque, N m, positive against the spin; speed_rad_s: rotor speed, rad/s.\n\
         # Each row is the mean of readings at rest. Use two voltages or more.\n\
         duty,battery_voltage_v,thrust_n,torque_n_m,speed_rad_s\n",
    );
    for s in ThrustStand::of(&Vehicle::qball_x4())?.sweep(&sweep, &mut generator(SEED))? {
        writeln!(
            text,
            "{:.4},{:.4},{:.5},{:.6},{:.3}",
            s.duty, s.battery_voltage_v, s.thrust_n, s.torque_n_m, s.speed_rad_s
        )?;
    }
    Ok(text)
}

fn rotor_response() -> Result<String, Box<dyn Error>> {
    let signal = Prbs {
        centre: 0.0727,
        amplitude: 0.001,
        hold_s: 0.04,
        skipped_bits: 0,
    };
    let supply = BenchSupply::Regulated { voltage_v: 11.1 };
    let times = uniform_times(0.005, 5.0)?;
    let mut text = String::from(
        "# One rotor under a pseudo-random binary duty about hover: an example from the virtual laboratory, not measured.\n\
         # time_s: s, rising; duty: raw PWM duty, held to the next row; the other columns as for thrust-stand.\n\
         # A few steps of the duty do as well. Start at rest under the first duty.\n\
         time_s,duty,battery_voltage_v,thrust_n,torque_n_m,speed_rad_s\n",
    );
    let stand = ThrustStand::of(&Vehicle::qball_x4())?;
    for s in stand.record(&times, signal.signal(), supply, &mut generator(SEED))? {
        writeln!(
            text,
            "{:.3},{:.4},{:.3},{:.4},{:.5},{:.2}",
            s.time_s, s.duty, s.battery_voltage_v, s.thrust_n, s.torque_n_m, s.speed_rad_s
        )?;
    }
    Ok(text)
}

/// Settling times of the controller of the flight, s: slow enough to leave the excitation to the rotors.
fn settings() -> Settings {
    let with = |settling_time_s| LoopSettings {
        settling_time_s,
        damping: 1.0,
        pole_ratio: 20.0,
    };
    Settings {
        height: with(3.0),
        yaw: with(3.0),
        position: with(5.0),
        attitude: AttitudeSettings {
            frequency_ratio: 10.0,
            damping: 1.0,
            pole_ratio: 5.0,
        },
    }
}

fn flight() -> Result<String, Box<dyn Error>> {
    let test = FlightTest {
        half_side_m: 0.5,
        sides: 4,
        side_s: 4.0,
        sample_every_ms: 10,
        excitation: 0.0012,
        ..FlightTest::default()
    };
    let mut text = String::from(
        "# A Qball-X4 flying a small square while its rotors are shaken: an example from the virtual laboratory, not measured.\n\
         # time_s: s, rising; force_x, force_y, force_z: specific force of an accelerometer in the centre of mass along the\n\
         # body's axes (forward, right, down), m/s2, [0, 0, -9.81] in hover; rate_x, rate_y, rate_z: p, q, r, rad/s;\n\
         # duty_1 .. duty_4: raw PWM duties in the order of the vehicle file's rotors, held to the next row;\n\
         # battery_voltage_v: V (if it was not measured: the nominal one in every row).\n\
         # Keep what was logged on the ground out by --from and --to. 100 rows a second or more; move all three of thrust, roll\n\
         # and pitch, up to 5 Hz.\n\
         time_s,force_x_m_s2,force_y_m_s2,force_z_m_s2,rate_x_rad_s,rate_y_rad_s,rate_z_rad_s,duty_1,duty_2,duty_3,duty_4,battery_voltage_v\n",
    );
    for s in test.fly(&Vehicle::qball_x4(), &settings(), &mut generator(SEED))? {
        write!(text, "{:.2}", s.time_s)?;
        for force in [s.force_x_m_s2, s.force_y_m_s2, s.force_z_m_s2] {
            write!(text, ",{force:.3}")?;
        }
        for rate in [s.rate_x_rad_s, s.rate_y_rad_s, s.rate_z_rad_s] {
            write!(text, ",{rate:.3}")?;
        }
        for duty in [s.duty_1, s.duty_2, s.duty_3, s.duty_4] {
            write!(text, ",{duty:.5}")?;
        }
        writeln!(text, ",{:.2}", s.battery_voltage_v)?;
    }
    Ok(text)
}
