//! The published measurements of the propeller.

use super::*;
use quad_dynamics::vehicle::derive::{self, rad_per_s};
use quad_rotor::tables::{APC_SF_10X4_7_ADVANCE_CSV as ADVANCE, APC_SF_10X4_7_STATIC_CSV as STATIC};
use serde::Deserialize;
use std::f64::consts::TAU;

#[derive(Deserialize)]
struct StaticRow {
    rpm: f64,
    thrust_coefficient: f64,
    power_coefficient: f64,
}

fn rows<T: serde::de::DeserializeOwned>(text: &str) -> Vec<T> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}

fn measured() -> Vec<PropellerSample> {
    rows::<StaticRow>(STATIC)
        .iter()
        .map(|row| {
            let speed_rad_s = rad_per_s(row.rpm);
            PropellerSample {
                speed_rad_s,
                thrust_n: row.thrust_coefficient * scale().unit(Quantity::Thrust, speed_rad_s),
                torque_n_m: row.power_coefficient / TAU * scale().unit(Quantity::Torque, speed_rad_s),
            }
        })
        .collect()
}

#[test]
fn agree_coefficients_of_the_published_table_with_the_vehicle_file() {
    let file = qball().propeller.unwrap();
    for (quantity, truth) in [
        (Quantity::Thrust, file.thrust_coefficient),
        (Quantity::Torque, file.torque_coefficient),
    ] {
        let fit = coefficient(&measured(), &scale(), quantity).unwrap();
        // The file's six digits.
        assert_relative_eq!(fit.values()[0], truth, max_relative = 5e-6);
        assert!(
            fit.warnings
                .iter()
                .any(|w| matches!(w, Warning::CorrelatedResiduals { .. })),
            "one coefficient cannot follow the table"
        );
    }
}

#[test]
fn data_published_coefficients_rise_with_the_speed() {
    let reference = rad_per_s(4505.0);
    for quantity in [Quantity::Thrust, Quantity::Torque] {
        for law in [SpeedLaw::Logarithmic, SpeedLaw::Linear] {
            let found = speed_dependence(&measured(), &scale(), quantity, law, reference).unwrap();
            assert!(
                found.is_significant(1e-6),
                "{quantity:?} {law:?}: p = {}",
                found.p_value
            );
            assert!(found.slope.interval().lower > 0.0);
        }
    }
    let fit = |law| speed_dependence(&measured(), &scale(), Quantity::Thrust, law, reference).unwrap();
    let thrust = fit(SpeedLaw::Linear);
    // The table's own rows at both ends and near hover: a law of the speed should leave less than a tenth of the rise by 23 %.
    for (rpm, published) in [(2377.0, 0.1059), (4590.0, 0.1200), (6528.0, 0.1299)] {
        assert_relative_eq!(thrust.at(rad_per_s(rpm)).value, published, max_relative = 0.02);
    }
    let constant = coefficient(&measured(), &scale(), Quantity::Thrust)
        .unwrap()
        .goodness
        .standard_deviation;
    let [linear, logarithmic] =
        [thrust, fit(SpeedLaw::Logarithmic)].map(|found| found.fit.goodness.standard_deviation);
    println!(
        "residual {constant:.3} N with one coefficient, {linear:.3} N linear, {logarithmic:.3} N logarithmic"
    );
    // Either law takes up most of what the constant leaves: a fifth at most stays.
    assert!(linear.max(logarithmic) < 0.2 * constant);
}

#[test]
fn agree_advance_slope_with_the_vehicle_files_derivation() {
    #[derive(Deserialize)]
    struct Row {
        run: String,
        #[serde(flatten)]
        sample: AdvanceSample,
    }
    let mut samples: Vec<AdvanceSample> = rows::<Row>(ADVANCE)
        .into_iter()
        .filter(|row| row.run == "kt0836" && row.sample.advance_ratio <= 0.3)
        .map(|row| row.sample)
        .collect();
    samples.push(AdvanceSample {
        advance_ratio: 0.0,
        thrust_coefficient: 0.1158,
    });
    let points: Vec<derive::AdvancePoint> = samples
        .iter()
        .map(|s| derive::AdvancePoint {
            advance_ratio: s.advance_ratio,
            thrust_coefficient: s.thrust_coefficient,
        })
        .collect();
    let fit = advance_slope(&samples).unwrap();
    // Singular values here, normal equations there.
    assert_relative_eq!(
        fit.values()[1],
        derive::advance_slope(&points).unwrap(),
        max_relative = 1e-12
    );
    assert!(fit.parameters[1].interval().upper < 0.0);
}
