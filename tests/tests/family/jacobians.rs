//! The battery, part two: derivatives by dual numbers against central differences, for state, commands and
//! wind of every model.

use family_tests::{
    Draw, Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, draw, join,
    phenomena, rate, vehicle,
};
use num_dual::Dual64;
use proptest::prelude::*;
use quad_dynamics::{PhenomenonSet, QuadrotorModel};
use quad_math::constant;

/// Step of the differences, relative to the size of what is moved.
const RELATIVE_STEP: f64 = 3e-4;

/// The derivative of all rates by one number, by dual numbers.
fn dual_column<F: Family>(model: &F::Over<Dual64>, at: &[f64], moving: usize) -> Vec<f64> {
    let mut at: Vec<Dual64> = at.iter().map(|&x| constant(x)).collect();
    at[moving].eps = 1.0;
    rate(model, &at).iter().map(|r| r.eps).collect()
}

/// The same by the central difference of fourth order, `(8 Δ(h) − Δ(2h)) / 12h`.
fn difference_column<F: Family>(model: &F::Over<f64>, at: &[f64], moving: usize, h: f64) -> Vec<f64> {
    let shifted = |steps: f64| {
        let mut at = at.to_vec();
        at[moving] += steps * h;
        rate(model, &at)
    };
    let [l2, l1, r1, r2] = [-2.0, -1.0, 1.0, 2.0].map(shifted);
    let slope = |i: usize| (8.0 * (r1[i] - l1[i]) - (r2[i] - l2[i])) / (12.0 * h);
    (0..l1.len()).map(slope).collect()
}

fn check<F: Family>(draw: &Draw, on: &PhenomenonSet) -> Result<(), TestCaseError> {
    let model = F::Over::<f64>::build(&draw.vehicle, on).unwrap();
    let dual = F::Over::<Dual64>::build(&draw.vehicle, on).unwrap();
    let at = join(&model.adopt(&draw.snapshot, &draw.input), &draw.input);
    let columns: Vec<Vec<f64>> = (0..at.len()).map(|j| dual_column::<F>(&dual, &at, j)).collect();
    // The terms that a rate is the sum of: they may cancel, their rounding does not.
    let terms = |i: usize| {
        columns
            .iter()
            .zip(&at)
            .map(|(c, x)| (c[i] * x).abs())
            .sum::<f64>()
    };
    for (moving, exact) in columns.iter().enumerate() {
        let h = RELATIVE_STEP * at[moving].abs().max(1e-3);
        let differences = difference_column::<F>(&model, &at, moving, h);
        for (i, (exact, difference)) in exact.iter().zip(&differences).enumerate() {
            // Rounding: some tens of ulps of the terms over h. Truncation: h⁴ f⁽⁵⁾ / 30, where each derivative of
            // roots and exponentials brings a factor of ten at most over the size of what moves (the battery's
            // exponent): (3e-4 · 10)⁴ / 30 = 3e-12, times what the powers behind it bring.
            let tolerance = 1e-14 * (terms(i) + 10.0) / h + 1e-9 * exact.abs();
            prop_assert!(
                (exact - difference).abs() <= tolerance,
                "rate {i} by number {moving} ({on}): {exact} against {difference}, tolerance {tolerance}"
            );
        }
    }
    Ok(())
}

macro_rules! jacobian_of {
    ($($name:ident: $model:ident;)*) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(48))]
            $(
                #[test]
                fn $name(draw in draw(vehicle()), on in phenomena::<$model>()) {
                    check::<$model>(&draw, &on)?;
                }
            )*
        }
    };
}

jacobian_of! {
    agree_jacobian_of_level_1: FamilyOne;
    agree_jacobian_of_level_2: FamilyTwo;
    agree_jacobian_of_level_3: FamilyThree;
    agree_jacobian_of_level_4: FamilyFour;
    agree_jacobian_of_level_5: FamilyFive;
    agree_jacobian_of_the_mechanistic_vehicle: FamilyMechanistic;
}
