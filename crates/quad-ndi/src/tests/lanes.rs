//! Each lane of a closed loop flies as it would alone.

use super::bad_input::pid_settings;
use super::*;
use crate::{Airborne, C1, C2, C3, ClosedLoop, Controller, InCharge, Pid, Reference};
use nalgebra::SimdValue;
use quad_dynamics::{CommandLimits, Level1, Level3, PhenomenonSet};
use quad_math::{F32x8, F64x4, Real, constant};

/// Time step, s, and steps flown.
const STEP_S: f64 = 1e-3;
const STEPS: usize = 20;

/// State, memory and commands as numbers after some steps from numbers.
fn after<R: Real, M: QuadrotorModel<R>, C: Controller<R> + Copy>(
    model: &M,
    controller: &C,
    start: &[R],
    target: [R; 4],
) -> Vec<R> {
    let reference = Reference::hold(Vector3::new(target[0], target[1], target[2]), target[3]);
    let mut flying = ClosedLoop {
        plant: Airborne {
            model,
            state: StateOf::<R, M>::read(start),
        },
        feedback: InCharge::from(*controller),
    };
    let still = Input::still_air([R::zero(); 4]);
    let mut commands = [R::zero(); 4];
    for _ in 0..STEPS {
        commands = flying.step(&reference, &still, constant(STEP_S));
    }
    let mut out = vec![R::zero(); <StateOf<R, M> as Flat<R>>::LEN + C::Memory::LEN];
    flying.plant.state.write(&mut out);
    flying
        .feedback
        .memory
        .write(&mut out[<StateOf<R, M> as Flat<R>>::LEN..]);
    out.extend(commands);
    out
}

/// Runs starts side by side and each alone in double precision; the largest difference, relative to one or to
/// the number if it is larger.
fn worst<V, MV, M, CV, C>(
    models: (&MV, &M),
    controllers: (&CV, &C),
    starts: &[Vec<f64>],
    targets: &[[f64; 4]],
) -> f64
where
    V: Real + SimdValue<Element: Into<f64> + Real>,
    MV: QuadrotorModel<V>,
    M: QuadrotorModel<f64>,
    CV: Controller<V> + Copy,
    C: Controller<f64> + Copy,
{
    let lane = |i: usize| i % starts.len();
    let gather = |pick: &dyn Fn(usize) -> f64| {
        let mut wide = V::zero();
        for i in 0..V::LANES {
            wide.replace(i, constant(pick(lane(i))));
        }
        wide
    };
    let wide_start: Vec<V> = (0..starts[0].len()).map(|n| gather(&|i| starts[i][n])).collect();
    let wide_target = std::array::from_fn(|n| gather(&|i| targets[i][n]));
    let together = after(models.0, controllers.0, &wide_start, wide_target);
    let mut worst = 0.0_f64;
    for i in 0..V::LANES {
        let alone = after(models.1, controllers.1, &starts[lane(i)], targets[lane(i)]);
        for (wide, narrow) in together.iter().zip(&alone) {
            let in_lane: f64 = wide.extract(i).into();
            worst = worst.max((in_lane - narrow).abs() / narrow.abs().max(1.0));
        }
    }
    worst
}

/// Tilt and rates moderate, so that no branch of a select lies within rounding of its edge.
fn moments() -> impl Strategy<Value = Vec<Moment>> {
    prop::collection::vec(
        moment(Ranges {
            tilt: 0.6,
            rate: 1.0,
            share: 0.3,
        }),
        4,
    )
}

macro_rules! lanes {
    ($name:ident, $model:ident, $controller:ident, $settings:expr, $limited:expr) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(32))]
            #[test]
            fn $name(at in moments(), targets in prop::array::uniform4(prop::array::uniform4(-2.0..2.0))) {
                let (vehicle, none) = (Vehicle::qball_x4(), PhenomenonSet::none());
                let narrow = $model::<f64>::build(&vehicle, &none).unwrap();
                let starts: Vec<Vec<f64>> =
                    at.iter().map(|m| flat(&state_at(&narrow, &vehicle, m))).collect();
                let mut alone = $controller::<f64>::new(&vehicle, &$settings).unwrap();
                let mut double = $controller::<F64x4>::new(&vehicle, &$settings).unwrap();
                let mut single = $controller::<F32x8>::new(&vehicle, &$settings).unwrap();
                if $limited {
                    alone.limits = Some(CommandLimits::of(&vehicle));
                    double.limits = Some(CommandLimits::of(&vehicle));
                    single.limits = Some(CommandLimits::of(&vehicle));
                }
                let wide = $model::<F64x4>::build(&vehicle, &none).unwrap();
                // Elementary functions differ in the last place between lanes and scalars; the loop multiplies that by
                // gains up to 2000 1/s² in 20 ms, and differences of nearly equal numbers by some tens.
                let error = worst::<F64x4, _, _, _, _>((&wide, &narrow), (&double, &alone), &starts, &targets);
                prop_assert!(error < 1e5 * f64::EPSILON, "{error}");
                let wide = $model::<F32x8>::build(&vehicle, &none).unwrap();
                // The same in single precision, which also rounds the parameters.
                let error = worst::<F32x8, _, _, _, _>((&wide, &narrow), (&single, &alone), &starts, &targets);
                prop_assert!(error < 1e5 * f64::from(f32::EPSILON), "{error}");
            }
        }
    };
}

lanes!(agree_lanes_of_c1_with_scalars, Level1, C1, settings(), false);
lanes!(agree_lanes_of_c2_with_scalars, Level3, C2, settings(), true);
lanes!(agree_lanes_of_c3_with_scalars, Level3, C3, settings(), false);
lanes!(agree_lanes_of_pid_with_scalars, Level3, Pid, pid_settings(), true);
