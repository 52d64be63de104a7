//! No heap in a step: derivative and RK4 step of every model and scalar, counted by the allocator itself.
//!
//! Counted for the measuring thread alone, so tests beside it change nothing.

use allocation_counter::measure;
use family_tests::{Family, FamilyFive, FamilyFour, FamilyMechanistic, FamilyOne, FamilyThree, FamilyTwo};
use nalgebra::Vector3;
use quad_dynamics::{AnyQuadrotor, Level, PhenomenonSet, QuadrotorModel, Vehicle};
use quad_math::{F32x8, F64x4, FixedStep, Real, constant};
use std::hint::black_box;

/// Number of allocations in a derivative, an RK4 step, an Euler step and the outputs.
fn allocations<R: Real, M: QuadrotorModel<R>>(vehicle: &Vehicle, on: &PhenomenonSet) -> u64 {
    let model = M::build(vehicle, on).unwrap();
    let hover = model.hover(Vector3::zeros(), constant(0.1));
    let counted = measure(|| {
        let input = black_box(hover.input);
        black_box(model.derivative(&hover.state, &input));
        let x = FixedStep::Rk4.step(&model, &hover.state, &input, constant(1e-3));
        let x = FixedStep::Euler.step(&model, &x, &input, constant(1e-3));
        black_box(model.flight(&x));
        black_box(model.adopt(&model.snapshot(&x, &input), &input));
    });
    counted.count_total
}

fn check<F: Family>() {
    let vehicle = Vehicle::qball_x4();
    let on = F::PHENOMENA.iter().copied().collect();
    assert_eq!(allocations::<f64, F::Over<f64>>(&vehicle, &on), 0);
    assert_eq!(allocations::<F64x4, F::Over<F64x4>>(&vehicle, &on), 0);
    assert_eq!(allocations::<F32x8, F::Over<F32x8>>(&vehicle, &on), 0);
}

#[test]
fn exact_no_allocation_in_a_step() {
    check::<FamilyOne>();
    check::<FamilyTwo>();
    check::<FamilyThree>();
    check::<FamilyFour>();
    check::<FamilyFive>();
    check::<FamilyMechanistic>();
}

#[test]
fn exact_no_allocation_in_a_step_of_any_level() {
    let vehicle = Vehicle::qball_x4();
    for level in Level::ALL {
        let on = level.phenomena();
        let mut any = AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, Vector3::zeros(), 0.0).unwrap();
        let counted = measure(|| {
            let input = any.hover_input();
            any.step(FixedStep::Rk4, &input, 1e-3);
            black_box(any.flight());
        });
        assert_eq!(counted.count_total, 0, "{level}");
    }
}

/// The counter counts: without this the tests above could not fail.
#[test]
fn exact_the_counter_counts() {
    assert_eq!(measure(|| drop(black_box(vec![1.0_f64; 8]))).count_total, 1);
}
