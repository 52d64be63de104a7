//! The battery, part three: each lane of a SIMD vector flies as a scalar of the same precision would, and
//! single precision follows double precision.

use crate::support::worst_over;
use family_tests::{
    Draw, Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo, draw, flat,
    join, phenomena, rate, split, vehicle,
};
use nalgebra::SimdValue;
use proptest::prelude::*;
use quad_dynamics::{PhenomenonSet, QuadrotorModel, StateOf, Vehicle};
use quad_math::{F32x8, F64x4, FixedStep, Real, constant};

/// Step of the flights, s.
const STEP: f64 = 2e-3;

/// Derivative and one RK4 step at a joined vector, one after the other.
fn derivative_and_step<R: Real, M: QuadrotorModel<R>>(model: &M, all: &[R]) -> Vec<R> {
    let (state, input) = split::<R, StateOf<R, M>>(all);
    let mut both = rate(model, all);
    both.extend(flat(&FixedStep::Rk4.step(model, &state, &input, constant(STEP))));
    both
}

/// The joined vectors of several draws of one vehicle, one per lane.
fn starts<F: Family>(vehicle: &Vehicle, draws: &[Draw], on: &PhenomenonSet) -> Vec<Vec<f64>> {
    let model = F::Over::<f64>::build(vehicle, on).unwrap();
    let start = |draw: &Draw| join(&model.adopt(&draw.snapshot, &draw.input), &draw.input);
    draws.iter().map(start).collect()
}

/// Runs all draws as lanes of `V` and each alone as its element, and checks them against one another.
fn lanes_as_scalars<F: Family, V>(
    vehicle: &Vehicle,
    draws: &[Draw],
    on: &PhenomenonSet,
    ulps: f64,
) -> Result<(), TestCaseError>
where
    V: Real + SimdValue<Element: Real + SimdValue<Element = V::Element> + Into<f64>>,
{
    let wide = F::Over::<V>::build(vehicle, on).unwrap();
    let narrow = F::Over::<V::Element>::build(vehicle, on).unwrap();
    let starts = starts::<F>(vehicle, draws, on);
    let mut lanes: Vec<V> = vec![V::zero(); starts[0].len()];
    for (lane, start) in starts.iter().enumerate() {
        for (number, &x) in lanes.iter_mut().zip(start) {
            number.replace(lane, constant(x));
        }
    }
    let together = derivative_and_step(&wide, &lanes);
    for (lane, start) in starts.iter().enumerate() {
        let start: Vec<V::Element> = start.iter().map(|&x| constant(x)).collect();
        let alone: Vec<f64> = derivative_and_step(&narrow, &start)
            .into_iter()
            .map(Into::into)
            .collect();
        let lane: Vec<f64> = together.iter().map(|x| x.extract(lane).into()).collect();
        let largest = alone.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        // The same operations in the same order: lanes differ where a library of elementary functions (level
        // 1's sine, the battery's exponential) differs in the last place, and by what cancels afterwards.
        let worst = worst_over(&lane, &alone, |i| ulps * (alone[i].abs() + 1e-3 * largest));
        prop_assert!(worst <= 1.0, "{worst} ({on})");
    }
    Ok(())
}

/// Several moments of flight of the same vehicle.
fn flock(count: usize) -> impl Strategy<Value = (Vehicle, Vec<Draw>)> {
    vehicle().prop_flat_map(move |vehicle| {
        let draws = prop::collection::vec(draw(Just(vehicle.clone())), count);
        (Just(vehicle), draws)
    })
}

fn check<F: Family>(vehicle: &Vehicle, draws: &[Draw], on: &PhenomenonSet) -> Result<(), TestCaseError> {
    lanes_as_scalars::<F, F64x4>(vehicle, &draws[..4], on, 8.0 * f64::EPSILON)?;
    lanes_as_scalars::<F, F32x8>(vehicle, draws, on, 8.0 * f64::from(f32::EPSILON))?;
    single_precision_follows::<F>(vehicle, draws, on)
}

/// Ten steps in single precision against the same in double precision.
fn single_precision_follows<F: Family>(
    vehicle: &Vehicle,
    draws: &[Draw],
    on: &PhenomenonSet,
) -> Result<(), TestCaseError> {
    let single = F::Over::<f32>::build(vehicle, on).unwrap();
    let double = F::Over::<f64>::build(vehicle, on).unwrap();
    for start in starts::<F>(vehicle, draws, on) {
        let coarse: Vec<f32> = start.iter().map(|&x| x as f32).collect();
        let (mut x, input) = split::<f32, StateOf<f32, F::Over<f32>>>(&coarse);
        let (mut y, input_64) = split::<f64, StateOf<f64, F::Over<f64>>>(&start);
        for _ in 0..10 {
            x = FixedStep::Rk4.step(&single, &x, &input, STEP as f32);
            y = FixedStep::Rk4.step(&double, &y, &input_64, STEP);
        }
        let x: Vec<f64> = flat(&x).into_iter().map(f64::from).collect();
        let y = flat(&y);
        let largest = y.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
        // Ten steps of some ulps (6e-8) each, which a tumbling flight spreads about tenfold.
        let worst = worst_over(&x, &y, |_| 2e-5 * largest);
        prop_assert!(worst <= 1.0, "{worst} ({on})");
    }
    Ok(())
}

macro_rules! lanes_of {
    ($($name:ident: $model:ident;)*) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(24))]
            $(
                #[test]
                fn $name((vehicle, draws) in flock(8), on in phenomena::<$model>()) {
                    check::<$model>(&vehicle, &draws, &on)?;
                }
            )*
        }
    };
}

lanes_of! {
    agree_lanes_of_level_1: FamilyOne;
    agree_lanes_of_level_2: FamilyTwo;
    agree_lanes_of_level_3: FamilyThree;
    agree_lanes_of_level_4: FamilyFour;
    agree_lanes_of_level_5: FamilyFive;
    agree_lanes_of_the_mechanistic_vehicle: FamilyMechanistic;
}
