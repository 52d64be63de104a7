use super::*;
use crate::Estimate;
use crate::laboratory::generator;
use crate::laboratory::thrust_stand::{BenchSupply, Instruments, StaticSweep, ThrustStand};
use approx::assert_relative_eq;
use quad_dynamics::Vehicle;

mod coverage;
mod exact;
mod propeller;

/// Seeds of a coverage test.
const SEEDS: u64 = 200;

/// One estimate of a coverage test beside the truth.
pub(crate) struct Judged {
    pub(crate) name: &'static str,
    pub(crate) estimate: Estimate,
    pub(crate) truth: f64,
}

/// Checks that 95 % intervals contain the truth in 90 to 99 % of the seeds: a binomial count of 200 at 95 % has a standard
/// deviation of 1.5 %, so the bounds lie three deviations below and two and a half above.
pub(crate) fn assert_covered(experiment: impl Fn(u64) -> Vec<Judged>) {
    let mut counts: Vec<(&str, u64)> = Vec::new();
    for seed in 0..SEEDS {
        for (i, judged) in experiment(seed).iter().enumerate() {
            if counts.len() <= i {
                counts.push((judged.name, 0));
            }
            counts[i].1 += u64::from(judged.estimate.interval().contains(judged.truth));
        }
    }
    assert!(!counts.is_empty());
    for (name, count) in counts {
        let share = count as f64 / SEEDS as f64;
        println!(
            "{name}: {:.1} % of {SEEDS} intervals contain the truth",
            100.0 * share
        );
        assert!((0.90..=0.99).contains(&share), "{name}: {share}");
    }
}

fn qball() -> Vehicle {
    Vehicle::qball_x4()
}

fn scale() -> PropellerScale {
    PropellerScale {
        diameter_m: 0.254,
        air_density_kg_m3: 1.225,
    }
}

/// A stand that tells the truth.
fn perfect() -> ThrustStand {
    ThrustStand {
        instruments: Instruments::PERFECT,
        ..ThrustStand::of(&qball()).unwrap()
    }
}

/// Values evenly over a range, ends included.
fn evenly(start: f64, end: f64, count: u32) -> Vec<f64> {
    let step = (end - start) / f64::from(count - 1);
    (0..count).map(|i| start + step * f64::from(i)).collect()
}

fn at_volts(voltages: &[f64]) -> Vec<BenchSupply> {
    voltages
        .iter()
        .map(|&voltage_v| BenchSupply::Regulated { voltage_v })
        .collect()
}

fn sweep(duties: Vec<f64>, voltages: &[f64], readings: usize) -> StaticSweep {
    StaticSweep {
        duties,
        supplies: at_volts(voltages),
        readings,
    }
}
