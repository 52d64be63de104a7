//! Time per derivative, per RK4 step and per closed-loop step of each level, on f64, 4 × f64 and 8 × f32.
//!
//! Every row flies [`STEPS`] steps, so microseconds are nanoseconds per step of the whole scalar: divide by
//! four or eight for SIMD lanes and by [`VEHICLES`] for batches to get time per vehicle. `cargo bench -p
//! family-tests`; results and machine stand in BENCHMARKS.md.

use divan::{Bencher, black_box};
use nalgebra::Vector3;
use quad_dynamics::{
    Input, Level, Level1, Level2, Level3, Level4, Level5, LevelModel, Phenomenon, PhenomenonSet,
    QuadrotorModel, Vehicle,
};
use quad_math::{Batch, F32x8, F64x4, Real, constant, rk4_step};
use quad_ndi::{Airborne, C1, C3, ClosedLoop, Controller, InCharge, Reference, Settings};

fn main() {
    println!("batches run on {}", quad_math::instruction_set());
    divan::main();
}

/// Steps a row flies.
const STEPS: usize = 1000;

/// Vehicles in a batch.
const VEHICLES: usize = 64;

/// Step, s.
const STEP_S: f64 = 1e-3;

/// What belongs to a level by default, but for voltage sag: level 5 as the figures fly it.
fn parts(level: Level) -> PhenomenonSet {
    level.phenomena().without(Phenomenon::VoltageSag)
}

fn model<R: Real, M: LevelModel<R>>() -> M {
    M::build(&Vehicle::qball_x4(), &parts(M::LEVEL)).expect("the nominal vehicle flies at every level")
}

/// Input near hover that keeps the vehicle moving.
fn input<R: Real, M: LevelModel<R>>(model: &M) -> Input<R> {
    let hover = model.hover(Vector3::zeros(), R::zero()).input;
    let nudge = [1e-5, -1e-5, 2e-5, -1e-5];
    Input {
        commands: std::array::from_fn(|i| hover.commands[i] + constant(nudge[i])),
        ..hover
    }
}

fn derivative<R: Real, M: LevelModel<R>>(bencher: Bencher) {
    let model: M = model();
    let input = input(&model);
    let start = model.hover(Vector3::zeros(), constant(0.3)).state;
    bencher.bench_local(|| {
        // A chain, so that the time is that of one derivative after another.
        let mut state = black_box(start);
        for _ in 0..STEPS {
            let rate = model.derivative(&state, black_box(&input));
            state = quad_math::State::advanced(&state, constant(1e-9), &rate);
        }
        state
    });
}

fn step<R: Real, M: LevelModel<R>>(bencher: Bencher) {
    let model: M = model();
    let input = input(&model);
    let start = model.hover(Vector3::zeros(), constant(0.3)).state;
    bencher.bench_local(|| {
        let mut state = black_box(start);
        for _ in 0..STEPS {
            state = rk4_step(&model, &state, black_box(&input), constant(STEP_S));
        }
        state
    });
}

fn closed_loop<R: Real, M: LevelModel<R>, C: Controller<R> + Copy>(bencher: Bencher, controller: C) {
    let model: M = model();
    let hover = model.hover(Vector3::zeros(), R::zero());
    let start = ClosedLoop {
        plant: Airborne {
            model: &model,
            state: hover.state,
        },
        feedback: InCharge::from(controller),
    };
    let still = Input::still_air([R::zero(); 4]);
    let reference = Reference::hold(
        Vector3::new(constant(0.3), constant(-0.2), constant(-0.5)),
        constant(0.2),
    );
    bencher.bench_local(|| {
        let mut now = black_box(start);
        for _ in 0..STEPS {
            now.step(black_box(&reference), &still, constant(STEP_S));
        }
        now
    });
}

/// One benchmark of each kind for a level over a scalar.
macro_rules! rows {
    ($($module:ident: $level:ident, $scalar:ty, $controller:ident;)*) => {$(
        mod $module {
            use super::*;

            #[divan::bench]
            fn derivative(bencher: Bencher) {
                super::derivative::<$scalar, $level<$scalar>>(bencher);
            }

            #[divan::bench]
            fn rk4_step(bencher: Bencher) {
                super::step::<$scalar, $level<$scalar>>(bencher);
            }

            #[divan::bench]
            fn closed_loop(bencher: Bencher) {
                let controller = $controller::<$scalar>::new(&Vehicle::qball_x4(), &Settings::default());
                let controller = controller.expect("default settings are valid");
                super::closed_loop::<$scalar, $level<$scalar>, _>(bencher, controller);
            }
        }
    )*};
}

rows! {
    level_1_f64: Level1, f64, C1;
    level_1_f64x4: Level1, F64x4, C1;
    level_1_f32x8: Level1, F32x8, C1;
    level_2_f64: Level2, f64, C1;
    level_2_f64x4: Level2, F64x4, C1;
    level_2_f32x8: Level2, F32x8, C1;
    level_3_f64: Level3, f64, C3;
    level_3_f64x4: Level3, F64x4, C3;
    level_3_f32x8: Level3, F32x8, C3;
    level_4_f64: Level4, f64, C3;
    level_4_f64x4: Level4, F64x4, C3;
    level_4_f32x8: Level4, F32x8, C3;
    level_5_f64: Level5, f64, C3;
    level_5_f64x4: Level5, F64x4, C3;
    level_5_f32x8: Level5, F32x8, C3;
}

/// RK4 steps of 64 vehicles at level 3, chosen for this processor at run time.
fn batch<R: Real>(bencher: Bencher) {
    let model: Level3<R> = model();
    let bare = model.bare().expect("level 3 has no parts switched on");
    let start = model.hover(Vector3::zeros(), constant(0.3)).state;
    let inputs = vec![input(&model); VEHICLES];
    let mut states = Batch::new(&[start; VEHICLES]);
    bencher.bench_local(|| {
        for _ in 0..STEPS {
            states.rk4_step(&bare, black_box(&inputs), constant(STEP_S));
        }
    });
}

#[divan::bench]
fn level_3_batch_f64(bencher: Bencher) {
    batch::<f64>(bencher);
}

#[divan::bench]
fn level_3_batch_f32(bencher: Bencher) {
    batch::<f32>(bencher);
}
