//! No heap in a step of the station and in the light on a receiver, on every kind of scalar, counted by the allocator itself.
//!
//! A test binary of its own, since the counting allocator replaces the global one.

use allocation_counter::measure;
use ets::{Aperture, Ets, EtsInput, FrameClock, Station};
use nalgebra::{Matrix3, Vector2, Vector3};
use quad_math::{F32x8, F64x4, Real, constant};
use std::hint::black_box;

fn allocations<R: Real>(station: &Station) -> u64 {
    let ets = Ets::<R>::new(station);
    let clock = FrameClock::new(0.01, 50.0, 0.0).expect("a clock");
    let input = EtsInput {
        target: Vector3::new(constant(4.0), constant(0.5), constant(-1.0)),
        noise: Vector2::zeros(),
    };
    let counted = measure(|| {
        let mut state = ets.at_rest(R::zero(), constant(0.2));
        for n in 0..10 {
            state = ets.step(&clock, n, &state, black_box(&input));
        }
        let face = ets.receiver.on(&input.target, &-Matrix3::identity());
        black_box(ets.link(&state.gimbal, &face));
    });
    counted.count_total
}

#[test]
fn exact_no_allocation_in_a_step() {
    let mut station = Station::nominal();
    for aperture in [station.receiver.aperture, Aperture::Disc { radius: 0.1 }] {
        station.receiver.aperture = aperture;
        assert_eq!(allocations::<f64>(&station), 0);
        assert_eq!(allocations::<F64x4>(&station), 0);
        assert_eq!(allocations::<F32x8>(&station), 0);
    }
}

/// The counter counts: without this the test above could not fail.
#[test]
fn exact_the_counter_counts() {
    assert_eq!(measure(|| drop(black_box(vec![1.0_f64; 8]))).count_total, 1);
}
