//! The virtual laboratory's vehicle, identified: within its stated intervals, flown by all levels.

use super::*;
use nalgebra::Vector3;
use quad_dynamics::vehicle::Sourced;
use quad_dynamics::vehicle::derive::SteadyRotor;
use quad_dynamics::{AnyQuadrotor, Level, Phenomenon, Vehicle};
use quad_math::TimeGrid;
use quad_ndi::{
    AnyController, AttitudeSettings, C1, FlightPlan, FlightStatus, Flyer, LoopSettings, Reference, Settings,
};
use std::num::NonZeroU64;

/// Settling times that all levels take: 2 s in height and yaw, 5 s in position.
fn settings() -> Settings {
    let with = |settling_time_s| LoopSettings {
        settling_time_s,
        damping: 1.0,
        pole_ratio: 20.0,
    };
    Settings {
        height: with(2.0),
        yaw: with(2.0),
        position: with(5.0),
        attitude: AttitudeSettings {
            frequency_ratio: 10.0,
            damping: 1.0,
            pole_ratio: 5.0,
        },
    }
}

/// The true vehicle: the nominal one with its centre of mass moved by millimetres and drag and inertia unlike the nominal ones.
fn truth() -> VehicleFile {
    let mut file = nominal();
    let with = |number: &mut Sourced<f64>, value| number.value = value;
    with(&mut file.airframe.mass, 1.45);
    with(&mut file.airframe.inertia.m11, 0.032);
    let centre = file.airframe.centre_of_mass.iter_mut();
    centre
        .zip([0.004, -0.006, 0.012])
        .for_each(|(n, value)| n.value = value);
    let drag = file.drag.as_mut().unwrap().quadratic.iter_mut();
    drag.zip([0.045, 0.031, 0.061])
        .for_each(|(n, value)| n.value = value);
    file
}

fn nominal() -> VehicleFile {
    VehicleFile::parse(quad_dynamics::vehicle::builtin::QBALL_X4_TOML, "nominal").unwrap()
}

fn identified(seed: u64) -> Identified {
    let vehicle = Vehicle::from_file(&truth(), "truth").unwrap();
    let measurements = VirtualLaboratory::new(settings())
        .measure(&vehicle, seed)
        .unwrap();
    identify(&measurements, &nominal()).unwrap()
}

/// A number of a file by its key.
fn number(file: &VehicleFile, key: &str) -> f64 {
    file.get(key).unwrap().value
}

/// The truth of an identified number. Rotor dynamics: the closed form of the linearised rotor at the mean duty. Cubics and
/// gains: the nominal file's derivation, noise-free fits over the same duties and voltages. The others: the true file.
fn truth_of(key: &str, dynamic: &[DynamicReading]) -> f64 {
    let file = truth();
    let steady = SteadyRotor::of(&Vehicle::from_file(&file, "truth").unwrap()).unwrap();
    let mean = dynamic.iter().map(|s| s.duty).sum::<f64>() / dynamic.len() as f64;
    let speed = steady.speed(steady.effective_voltage(mean - 0.05, 11.1));
    let linear = steady.rotor_dynamics(speed);
    match key {
        "linear_rotor.bandwidth_rad_s" => steady.motor_pole(speed),
        "rotor_dynamics.thrust_c1_per_s" => linear.thrust_c1,
        "rotor_dynamics.thrust_c2_per_s2" => linear.thrust_c2,
        "rotor_dynamics.torque_c1_per_s" => linear.torque_c1,
        "rotor_dynamics.torque_c2_per_s2" => linear.torque_c2,
        "rotor_dynamics.torque_c3_per_s" => linear.torque_c3,
        "rotor_dynamics.torque_c4_per_s2" => linear.torque_c4,
        _ => number(&file, key),
    }
}

/// Every identified number lies within four standard errors of the truth: of 27 independent normal numbers, one in 600 runs
/// would not. Four of Student's t for the support test, which has 12 degrees of freedom or more, is one in 80 runs of its four.
#[test]
fn exact_identified_numbers_lie_within_four_standard_errors_of_the_truth() {
    let vehicle = Vehicle::from_file(&truth(), "truth").unwrap();
    let measurements = VirtualLaboratory::new(settings()).measure(&vehicle, 1).unwrap();
    let found = identify(&measurements, &nominal()).unwrap();
    assert_eq!(found.parameters.len(), 27);
    let mut outside = Vec::new();
    for p in &found.parameters {
        let truth = truth_of(p.key, &measurements.dynamic);
        let z = (p.estimate.value - truth) / p.estimate.standard_error;
        println!(
            "{:<40} {:>12.6} ± {:>10.2e}  truth {truth:>12.6}  z {z:>6.2}",
            p.key, p.estimate.value, p.estimate.standard_error
        );
        if z.is_nan() || z.abs() > 4.0 {
            outside.push(p.key);
        }
    }
    for r in &found.remarks {
        println!("{}: {}", r.bench, r.warning);
    }
    assert!(outside.is_empty(), "{outside:?}");
}

/// Seeds of the count, and the fewest hits of a number's intervals among them: of 40 intervals of 95 % fewer than 33 hit in one of
/// 1400 such counts, and there are 27 numbers.
const SEEDS: u64 = 40;
const FEWEST: usize = 33;

/// The numbers of curves that the rotor does not follow exactly: cubics and line.
fn is_of_a_curve(key: &str) -> bool {
    let curves = ["polynomial_rotor", "pwm", "linear_rotor.t"];
    curves.iter().any(|curve| key.starts_with(curve))
}

/// The whole identification's intervals contain the truth as often as they say, number by number, whatever the seed.
#[test]
fn prop_the_intervals_of_the_whole_identification_contain_the_truth() {
    let vehicle = Vehicle::from_file(&truth(), "truth").unwrap();
    let laboratory = VirtualLaboratory::new(settings());
    let mut hits: Vec<(&str, usize)> = Vec::new();
    for seed in 0..SEEDS {
        let measurements = laboratory.measure(&vehicle, seed).unwrap();
        let found = identify(&measurements, &nominal()).unwrap();
        for p in &found.parameters {
            let hit = p
                .estimate
                .interval()
                .contains(truth_of(p.key, &measurements.dynamic));
            match hits.iter_mut().find(|(key, _)| *key == p.key) {
                Some((_, sum)) => *sum += usize::from(hit),
                None => hits.push((p.key, usize::from(hit))),
            }
        }
    }
    assert_eq!(hits.len(), 27);
    println!("{hits:#?} of {SEEDS}");
    for (key, hits) in &hits {
        assert!(*hits >= FEWEST, "{key}: {hits} of {SEEDS}");
    }
    // 1026 ± 7 of 1080 if all were independent; the coefficients of a curve or a transfer function share their noise, which doubles
    // the deviation at most: three of those.
    let all: usize = hits.iter().map(|(_, hits)| hits).sum();
    assert!((983..=1069).contains(&all), "{all} of 1080");
    // Intervals as wide as what the curves miss would hit always: 342 of 360 are expected, and of the three curves or pairs of
    // curves that are independent of each other all 40 hit in one of 500 such counts.
    let curves: usize = hits
        .iter()
        .filter(|(key, _)| is_of_a_curve(key))
        .map(|(_, hits)| hits)
        .sum();
    assert!(curves < 360, "{curves} of 360");
}

/// The standard error of `C_T` has the noise of the readings and the error of the thrust cell's line, which moves all thrusts alike.
#[test]
fn exact_a_line_one_error_off_scales_the_thrust_coefficient() {
    let vehicle = Vehicle::from_file(&truth(), "truth").unwrap();
    let mut measurements = VirtualLaboratory::new(settings()).measure(&vehicle, 5).unwrap();
    measurements.thrust_cell.non_linearity = 0.0;
    let cells = Cells::calibrated(&measurements.thrust_cell, &measurements.torque_cell).unwrap();
    let found = identify(&measurements, &nominal()).unwrap();
    // C_T is linear in the thrusts, C_T = Σ w T: its change by the slope is −σ_s/s (C_T − x̄ Σ w), by the height −σ_ȳ/s Σ w,
    // with w = c/Σ c² and c = ρ n² D⁴ of each speed.
    let propeller = nominal().propeller.unwrap();
    let unit =
        |speed: f64| 1.225 * (speed / std::f64::consts::TAU).powi(2) * propeller.diameter.value.powi(4);
    let sum =
        |f: &dyn Fn(f64) -> f64| -> f64 { measurements.sweep.iter().map(|s| f(unit(s.speed_rad_s))).sum() };
    let weights = sum(&|c| c) / sum(&|c| c * c);
    let line = &cells.thrust.line;
    let [zero, slope] = line.parameters;
    let loads = &measurements.thrust_cell.samples;
    let n = loads.len() as f64;
    let mean = loads.iter().map(|s| s.load).sum::<f64>() / n;
    let number = found.parameter("propeller.thrust_coefficient").unwrap().estimate;
    let by_slope = slope.standard_error / slope.value * (number.value - mean * weights);
    let by_height = line.goodness.standard_deviation / n.sqrt() / slope.value * weights;
    let samples: Vec<PropellerSample> = cells.steady(&measurements.sweep).iter().map(Into::into).collect();
    let scale = PropellerScale {
        diameter_m: propeller.diameter.value,
        air_density_kg_m3: 1.225,
    };
    let noise = coefficient(&samples, &scale, Quantity::Thrust)
        .unwrap()
        .parameters[0]
        .standard_error;
    let by_hand = noise.hypot(by_slope).hypot(by_height);
    println!(
        "C_T {} noise {noise:.2e} slope {by_slope:.2e} height {by_height:.2e}; zero {zero:?}",
        number.value
    );
    // First order in a slope's error of 1e-4.
    assert!(
        (number.standard_error / by_hand - 1.0).abs() < 1e-3,
        "{} {by_hand}",
        number.standard_error
    );
    assert!(number.standard_error > 1.1 * noise);
}

#[test]
fn exact_sources_and_standard_errors_say_what_was_identified() {
    let found = identified(2);
    for p in &found.parameters {
        assert_eq!(number(&found.file, p.key), p.estimate.value, "{}", p.key);
    }
    let motor = found.file.motor.as_ref().unwrap();
    assert!(
        motor
            .resistance
            .source
            .starts_with("not identified, taken from the nominal file")
    );
    assert!(
        found
            .file
            .airframe
            .mass
            .source
            .starts_with("identified: support forces")
    );
    assert!(found.file.airframe.mass.standard_error.unwrap() > 0.0);
    let again = VehicleFile::parse(&found.file.to_toml(), "identified").unwrap();
    assert_eq!(again, found.file);
}

/// All five levels of the identified vehicle fly a step of one metre and come to rest there, within the error that the rotor's
/// line makes of the height at level 5 (some centimetres).
#[test]
fn agree_all_levels_of_the_identified_vehicle_fly_a_step() {
    let found = identified(3);
    let vehicle = Vehicle::from_file(&found.file, "identified").unwrap();
    for level in Level::ALL {
        let phenomena = level.phenomena().without(Phenomenon::VoltageSag);
        let quadrotor = AnyQuadrotor::hovering(level, &vehicle, &phenomena, Vector3::zeros(), 0.0).unwrap();
        let controller = AnyController::C1(C1::new(&vehicle, &settings()).unwrap().into());
        let plan = FlightPlan {
            grid: TimeGrid::from_seconds(1e-3, 15.0).unwrap(),
            record_every: NonZeroU64::new(100).unwrap(),
        };
        let flyer = Flyer::new(&vehicle, quadrotor, controller).unwrap();
        let log = flyer.fly(&plan, |_| Reference::hold(Vector3::new(1.0, 0.0, 0.0), 0.0));
        assert_eq!(log.status, FlightStatus::Completed);
        let end = log.records.last().unwrap().flight.position;
        println!("level {}: {end:?}", level.number());
        assert!(
            (end - Vector3::x()).norm() < 0.15,
            "level {}: {end:?}",
            level.number()
        );
    }
}

#[test]
fn exact_a_nominal_file_without_groups_is_refused() {
    let vehicle = Vehicle::from_file(&truth(), "truth").unwrap();
    let measurements = VirtualLaboratory::new(settings()).measure(&vehicle, 4).unwrap();
    for group in ["propeller", "drag"] {
        let mut file = nominal();
        match group {
            "propeller" => file.propeller = None,
            _ => file.drag = None,
        }
        let refused = identify(&measurements, &file);
        assert_eq!(refused, Err(PipelineError::MissingGroup { group }));
    }
}
