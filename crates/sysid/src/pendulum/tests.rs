use super::*;
use crate::laboratory::pendulum::{Axis, PendulumRig};
use crate::laboratory::{Sensor, generator};
use crate::test_coverage::assert_covers;
use approx::assert_relative_eq;
use nalgebra::Vector2;
use proptest::prelude::*;
use quad_dynamics::Vehicle;
use quad_math::{Flat, Rate, State, System, constant, jacobian, rk4_step};

const SUSPENSION: Suspension = Suspension {
    mass_kg: 1.4,
    half_spacing_m: 0.2,
    length_m: 0.7,
    gravity_m_s2: 9.81,
};

fn free(suspension: Suspension, inertia: f64) -> Pendulum<f64> {
    Pendulum {
        suspension,
        inertia,
        viscous: 0.0,
        quadratic: 0.0,
    }
}

/// Timings of a quadcopter of 0.958 kg on strings 0.235 m from its axis: marcv81, *Moment of inertia*, 2014-10-09.
fn published(length_m: f64, durations_s: &[f64]) -> TimedInertia {
    let suspension = Suspension {
        mass_kg: 0.958,
        half_spacing_m: 0.235,
        length_m,
        gravity_m_s2: 9.81,
    };
    let timings: Vec<Timing> = durations_s
        .iter()
        .map(|&duration_s| Timing {
            periods: 20,
            duration_s,
        })
        .collect();
    from_timings(&suspension, &timings).unwrap()
}

#[test]
fn data_roll_and_pitch_inertia_of_a_quadcopter() {
    let found = published(0.51, &[13.312, 13.143, 13.144, 13.077]);
    // Published: 0.0112 kg m²; half a unit of its last digit.
    assert_relative_eq!(found.inertia.value, 0.0112, epsilon = 5e-5);
    // By hand: mean 13.169 s, standard deviation 0.10036 s, of the mean 0.05018 s, 0.381 % of it; twice that of I.
    assert_relative_eq!(
        found.inertia.standard_error / found.inertia.value,
        0.00762,
        epsilon = 5e-6
    );
    assert_eq!(found.inertia.degrees_of_freedom, 3.0);
    assert!(found.inertia.interval().contains(0.0112));
}

#[test]
fn data_yaw_inertia_of_a_quadcopter() {
    let found = published(0.70, &[20.638, 20.570, 20.574]);
    assert_relative_eq!(found.inertia.value, 0.0199, epsilon = 5e-5);
    // By hand: mean 20.594 s, standard deviation 0.038158 s, of the mean 0.022030 s.
    assert_relative_eq!(
        found.inertia.standard_error / found.inertia.value,
        2.0 * 0.022_030 / 20.594,
        max_relative = 1e-4
    );
    assert!(found.inertia.interval().contains(0.0199));
}

#[test]
fn exact_small_angles_give_the_small_angle_law() {
    let inertia = 0.03;
    let period = SUSPENSION.small_angle_period(inertia);
    assert_relative_eq!(SUSPENSION.inertia_of(period), inertia, epsilon = 1e-16);
    // The whole equation, linearised at rest by automatic differentiation: θ̈ = −(2π/T)² θ − c/I θ̇.
    let j = jacobian(
        |x: &[_; 2]| {
            let pendulum = Pendulum {
                suspension: SUSPENSION,
                inertia: constant(inertia),
                viscous: constant(1e-3),
                quadratic: constant(2e-3),
            };
            let rate = pendulum.derivative(
                &Swing {
                    angle: x[0],
                    rate: x[1],
                },
                &(),
            );
            [rate.rate, rate.acceleration]
        },
        [0.0, 0.0],
    );
    assert_relative_eq!(j[(1, 0)], -(TAU / period).powi(2), epsilon = 1e-12);
    assert_relative_eq!(j[(1, 1)], -1e-3 / inertia, epsilon = 1e-15);
    // The period differs from it by a term in A².
    let departure = |amplitude| SUSPENSION.period(inertia, amplitude) / period - 1.0;
    assert_relative_eq!(departure(0.02) / departure(0.01), 4.0, epsilon = 1e-3);
}

#[test]
fn exact_long_strings_make_it_a_simple_pendulum() {
    // z → b² (1 − cos θ)/L and m z'² → 0 as L/b grows: θ̈ = −ω² sin θ, T = T_0 / agm(1, cos(A/2)).
    let long = Suspension {
        half_spacing_m: 0.02,
        length_m: 40.0,
        ..SUSPENSION
    };
    for amplitude in [0.3, 1.0, 2.5_f64] {
        let (mut a, mut g) = (1.0, (0.5 * amplitude).cos());
        for _ in 0..8 {
            (a, g) = (0.5 * (a + g), f64::sqrt(a * g));
        }
        // What is neglected is of the order (b/L)² = 2.5e-7 times m b²/I = 0.02 or one.
        assert_relative_eq!(
            long.period(0.03, amplitude),
            long.small_angle_period(0.03) / a,
            max_relative = 1e-6
        );
    }
}

#[test]
fn exact_geometry_of_the_strings() {
    // Ends of a string: (b, 0, 0) above, (b cos θ, b sin θ, −h) below; its length is L at any angle.
    let angle = 1.3_f64;
    let rise = SUSPENSION.rise(angle);
    let b = SUSPENSION.half_spacing_m;
    let string = nalgebra::Vector3::new(
        b * angle.cos() - b,
        b * angle.sin(),
        SUSPENSION.length_m - rise.height,
    );
    assert_relative_eq!(string.norm(), SUSPENSION.length_m, epsilon = 1e-15);
    // z' and z'' are the derivatives of z by automatic differentiation.
    let by_ad = jacobian(
        |x: &[_; 1]| {
            let rise = SUSPENSION.rise(x[0]);
            [rise.height, rise.slope]
        },
        [angle],
    );
    assert_relative_eq!(by_ad[0], rise.slope, epsilon = 1e-14);
    assert_relative_eq!(by_ad[1], rise.curvature, epsilon = 1e-14);
    // At half a turn the chord is 2 b: h = √(L² − 4 b²).
    let top = SUSPENSION.rise(PI).height;
    assert_relative_eq!(top, 0.7 - f64::sqrt(0.49 - 0.16), epsilon = 1e-15);
}

#[test]
fn prop_energy_is_kept_without_damping_and_lost_with_it() {
    let mut swing = Swing {
        angle: 1.2,
        rate: 0.5,
    };
    let pendulum = free(SUSPENSION, 0.03);
    let before = pendulum.energy(&swing);
    let damped = Pendulum {
        viscous: 1e-3,
        quadratic: 1e-3,
        ..pendulum
    };
    let mut losing = swing;
    let mut last = before;
    for _ in 0..4000 {
        swing = rk4_step(&pendulum, &swing, &(), 0.005);
        losing = rk4_step(&damped, &losing, &(), 0.005);
        let energy = damped.energy(&losing);
        assert!(energy < last);
        last = energy;
    }
    // RK4 loses (ωh)⁶/144 of the energy per step: ω = 5.1 rad/s, (0.026)⁶/144 = 2e-12, 4000 steps: 8e-9; ten times
    // that for the larger rates of a large swing.
    assert_relative_eq!(pendulum.energy(&swing), before, max_relative = 1e-7);
}

#[test]
fn agree_lagrange_with_hamilton() {
    let rig = PendulumRig {
        release_rad: 1.5,
        quadratic_n_m_s2: 1e-3,
        angle_rad: Sensor::PERFECT,
        duration_s: 8.0,
        ..PendulumRig::default()
    };
    let vehicle = Vehicle::qball_x4();
    let samples = rig.swing(&vehicle, Axis::Yaw, &mut generator(0)).unwrap();
    let pendulum = Pendulum {
        suspension: rig.suspension(&vehicle),
        inertia: vehicle.airframe.inertia[(2, 2)],
        viscous: rig.viscous_n_m_s,
        quadratic: rig.quadratic_n_m_s2,
    };
    let mut swing = Swing {
        angle: 1.5,
        rate: 0.0,
    };
    for sample in &samples[1..] {
        for _ in 0..20 {
            swing = rk4_step(&pendulum, &swing, &(), 0.001);
        }
        // RK4: phase error (ωh)⁴/120 of each step's ωh, with ω = 5 rad/s: 2e-13 in 8000 steps; the kink of the
        // quadratic damping costs up to d h³ per turning point. Adaptive steps: 1e-11 each, 800 of them.
        assert!((sample.angle_rad - swing.angle).abs() < 2e-8, "{}", sample.time_s);
    }
    assert_eq!(samples.len(), 401);
}

proptest! {
    #[test]
    fn agree_quadrature_with_integration(inertia in 0.005..0.2_f64, amplitude in 0.05..2.2_f64, length in 0.45..2.0_f64) {
        let suspension = Suspension { length_m: length, ..SUSPENSION };
        let period = suspension.period(inertia, amplitude);
        let pendulum = free(suspension, inertia);
        let mut swing = Swing { angle: amplitude, rate: 0.0 };
        const STEPS: usize = 2000;
        for _ in 0..STEPS {
            swing = rk4_step(&pendulum, &swing, &(), period / STEPS as f64);
        }
        // Back at the turning point. RK4 with 2000 steps: (2π/2000)⁴/120 · 2π = 5e-12 for a harmonic swing; near the limit of
        // short strings it is stiffer by two decades in h⁴.
        prop_assert!((swing.angle - amplitude).abs() < 1e-8, "{} {amplitude}", swing.angle);
        // An error of the period by 1e-7 would show in the rate at the end.
        let pull = pendulum.derivative(&swing, &()).acceleration.abs() * period;
        prop_assert!(swing.rate.abs() < 1e-7 * pull, "{}", swing.rate);
    }

    #[test]
    fn prop_swing_round_trip_and_moves(angle in -3.0..3.0_f64, rate in -9.0..9.0_f64) {
        let swing = Swing { angle, rate };
        let mut flat = [0.0; 2];
        swing.write(&mut flat);
        prop_assert_eq!(Swing::read(&flat), swing);
        let slope = SwingRate { rate, acceleration: angle };
        slope.write(&mut flat);
        prop_assert_eq!(SwingRate::read(&flat), slope);
        let doubled = SwingRate::zero().add_scaled(2.0, &slope);
        prop_assert_eq!(Vector2::new(doubled.rate, doubled.acceleration), Vector2::new(2.0 * rate, 2.0 * angle));
        prop_assert_eq!(swing.advanced(0.0, &slope), swing);
    }
}

#[test]
fn exact_perfect_record_is_fitted_exactly() {
    let vehicle = Vehicle::qball_x4();
    let rig = PendulumRig {
        release_rad: 1.2,
        duration_s: 10.0,
        angle_rad: Sensor {
            bias: 0.02,
            ..Sensor::PERFECT
        },
        ..PendulumRig::default()
    };
    let samples = rig.swing(&vehicle, Axis::Roll, &mut generator(0)).unwrap();
    let fit = fit_history(&rig.suspension(&vehicle), &samples, Damping::ViscousAndQuadratic).unwrap();
    assert!(fit.convergence.unwrap().converged);
    // Fixed steps of a fiftieth of a period: 4e-6 of I, and ten times that for a swing that is not harmonic.
    assert_relative_eq!(fit.inertia.value, 0.03, max_relative = 4e-5);
    assert_relative_eq!(fit.viscous.value, rig.viscous_n_m_s, max_relative = 2e-3);
    assert_relative_eq!(
        fit.quadratic.unwrap().value,
        rig.quadratic_n_m_s2,
        max_relative = 2e-3
    );
    assert_relative_eq!(fit.offset.value, 0.02, epsilon = 1e-5);
    assert_relative_eq!(fit.angle.value, 1.2, epsilon = 1e-4);
    assert!(fit.rate.value.abs() < 1e-3);
    // The small-angle law would be wrong by the square of the period's departure.
    let suspension = rig.suspension(&vehicle);
    let naive = suspension.inertia_of(suspension.period(0.03, 1.2));
    assert!((naive / 0.03 - 1.0).abs() > 0.01, "{naive}");
}

#[test]
fn prop_95_percent_intervals_of_the_fit_cover_the_truth() {
    let vehicle = Vehicle::qball_x4();
    let rig = PendulumRig {
        rate_hz: 20.0,
        duration_s: 12.0,
        ..PendulumRig::default()
    };
    let fits: Vec<SwingFit> = (0..200)
        .map(|seed| {
            let samples = rig.swing(&vehicle, Axis::Yaw, &mut generator(seed)).unwrap();
            fit_history(&rig.suspension(&vehicle), &samples, Damping::ViscousAndQuadratic).unwrap()
        })
        .collect();
    let covers = |estimate: &dyn Fn(&SwingFit) -> Estimate, truth: f64| {
        assert_covers(|seed| estimate(&fits[seed as usize]).interval().contains(truth));
    };
    covers(&|f| f.inertia, vehicle.airframe.inertia[(2, 2)]);
    covers(&|f| f.viscous, rig.viscous_n_m_s);
    covers(&|f| f.quadratic.unwrap(), rig.quadratic_n_m_s2);
    covers(&|f| f.offset, rig.angle_rad.bias);
}

#[test]
fn prop_95_percent_intervals_of_timings_cover_the_truth() {
    let vehicle = Vehicle::qball_x4();
    let rig = PendulumRig {
        release_rad: 0.05,
        ..PendulumRig::default()
    };
    assert_covers(|seed| {
        let timings = rig
            .timings(&vehicle, Axis::Pitch, 20, 4, &mut generator(seed))
            .unwrap();
        let found = from_timings(&rig.suspension(&vehicle), &timings).unwrap();
        found
            .inertia
            .interval()
            .contains(vehicle.airframe.inertia[(1, 1)])
    });
}

#[test]
fn data_columns_of_a_csv_file_are_read() {
    let csv = "time_s,angle_rad\n0,0.5\n0.02,0.49\n";
    let rows: Result<Vec<AngleSample>, _> = csv::Reader::from_reader(csv.as_bytes()).deserialize().collect();
    assert_eq!(rows.unwrap()[1].angle_rad, 0.49);
    let csv = "periods,duration_s\n20,13.312\n";
    let rows: Result<Vec<Timing>, _> = csv::Reader::from_reader(csv.as_bytes()).deserialize().collect();
    assert_eq!(rows.unwrap()[0].periods, 20);
}

mod bad_input;
