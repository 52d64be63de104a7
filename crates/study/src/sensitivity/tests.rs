//! First order: closed forms, differentiation against differences at every level, and against Monte Carlo.

use super::*;
use nalgebra::Vector3;
use quad_dynamics::vehicle::{VehicleFile, builtin};
use quad_dynamics::{
    BuildError, Input, Level, Level1, Level2, Level3, Level4, Level5, MechanisticQuadrotor, Phenomenon,
    PhenomenonSet, QuadrotorModel,
};
use quad_math::{Real, constant, rk4_step};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// Standard error of every number as a share of it: small, so that first order is nearly all.
const RELATIVE: f64 = 1e-3;

/// Standard error of every element of a vector, in its unit. A millimetre of the centre of mass would tilt by 0.06 rad.
const ABSOLUTE: f64 = 1e-5;

/// Duty of the rotors over that of hover: climbing, rolling, pitching and yawing.
const COMMANDS: [f64; 4] = [1.05, 1.08, 1.10, 1.06];

const STEP_S: f64 = 0.005;
const STEPS: usize = 100;

/// The nominal Qball-X4 with standard errors of everything.
fn all_uncertain() -> UncertainVehicle {
    let mut file: toml::Value = toml::from_str(builtin::QBALL_X4_TOML).unwrap();
    add_errors(&mut file);
    let text = toml::to_string(&file).unwrap();
    let file = VehicleFile::parse(&text, "test").unwrap();
    UncertainVehicle::of(&file, "test").unwrap()
}

fn add_errors(value: &mut toml::Value) {
    let error = |value: &toml::Value| -> toml::Value {
        match value {
            toml::Value::Array(values) => vec![ABSOLUTE; values.len()].into(),
            value => (RELATIVE * value.as_float().unwrap().abs()).into(),
        }
    };
    match value {
        toml::Value::Table(table) => match table.get("value").map(error) {
            Some(error) => {
                table.insert("standard_error".to_owned(), error);
            }
            None => table.iter_mut().for_each(|(_, value)| add_errors(value)),
        },
        toml::Value::Array(entries) => entries.iter_mut().for_each(add_errors),
        _ => {}
    }
}

/// Position after half a second from the hover of `start`, under commands of its own.
fn flown<R: Real, M: QuadrotorModel<R>>(model: &M, start: &M) -> [R; 3] {
    let hover = start.hover(Vector3::new(R::zero(), R::zero(), constant(-0.4)), R::zero());
    let commands = std::array::from_fn(|i| hover.input.commands[i] * constant(COMMANDS[i]));
    let input = Input::in_wind(commands, Vector3::new(constant(1.0), constant(-2.0), R::zero()));
    let mut state = hover.state;
    for _ in 0..STEPS {
        state = rk4_step(model, &state, &input, constant(STEP_S));
    }
    model.flight(&state).position.into()
}

fn by_both<M: QuadrotorModel<f64>, D: QuadrotorModel<Dual64>>(
    phenomena: &PhenomenonSet,
) -> [[FirstOrder; 3]; 2] {
    let vehicle = all_uncertain();
    let start = M::build(vehicle.nominal(), phenomena).unwrap();
    let differences = by_differences(&vehicle, |moved| {
        Ok::<_, BuildError>(flown(&M::build(moved, phenomena)?, &start))
    });
    let constant_start = D::build(vehicle.nominal(), phenomena).unwrap();
    let derivatives = by_differentiation(&vehicle, |parameters| {
        let trim = D::trim(vehicle.nominal(), phenomena)?;
        let model = D::build_trimmed(parameters, phenomena, &trim)?;
        Ok::<_, BuildError>(flown(&model, &constant_start))
    });
    [differences.unwrap(), derivatives.unwrap()]
}

/// Differences are off by `h²/6` times a third derivative: with steps of 5·10⁻⁴ of each number some 10⁻⁷ of an effect times a power
/// law's factor of ten, and rounding, 10⁻¹⁶ of a metre over an effect of 10⁻³ m.
#[track_caller]
fn check<M: QuadrotorModel<f64>, D: QuadrotorModel<Dual64>>(phenomena: &PhenomenonSet, least: usize) {
    let [differences, derivatives] = by_both::<M, D>(phenomena);
    let keys = all_uncertain();
    let mut felt = vec![false; keys.numbers().len()];
    for (difference, derivative) in differences.iter().zip(&derivatives) {
        let whole = derivative.standard_deviation();
        assert!(whole > 0.0);
        for (k, (a, b)) in difference.effects.iter().zip(&derivative.effects).enumerate() {
            let key = &keys.numbers()[k].key;
            assert!(
                (a - b).abs() <= 1e-6 * whole,
                "{key}: {a} by differences, {b} by differentiation, {whole} in all"
            );
            felt[k] |= b.abs() > 1e-6 * whole;
        }
    }
    let felt = felt.iter().filter(|felt| **felt).count();
    assert!(felt >= least, "only {felt} numbers matter");
}

/// At every level. At least mass, gravity, the moments of inertia about x and y, the thrust gain, and both coordinates of hubs matter.
#[test]
fn agree_differentiation_with_differences() {
    check::<Level1<f64>, Level1<Dual64>>(&Level::One.phenomena(), 7);
    check::<Level2<f64>, Level2<Dual64>>(&Level::Two.phenomena(), 7);
    check::<Level3<f64>, Level3<Dual64>>(&Level::Three.phenomena(), 8);
    check::<Level4<f64>, Level4<Dual64>>(&Level::Four.phenomena(), 10);
    check::<Level5<f64>, Level5<Dual64>>(&Level::Five.phenomena(), 14);
}

/// With every phenomenon of the mechanistic vehicle that is not in its rotors anyway; near the ground.
#[test]
fn agree_differentiation_with_differences_of_all_phenomena() {
    use Phenomenon::{Blockage, Drag, GroundEffect, GyroscopicTorque, InputLimits, VoltageSag};
    let all = [
        Blockage,
        Drag,
        GroundEffect,
        GyroscopicTorque,
        InputLimits,
        VoltageSag,
    ];
    check::<MechanisticQuadrotor<f64>, MechanisticQuadrotor<Dual64>>(&all.into_iter().collect(), 20);
}

/// The spread of vehicles drawn is that of first order. A standard deviation of n draws errs by 1/√(2n) of itself: four of these.
#[test]
fn agree_first_order_with_monte_carlo() {
    const DRAWS: usize = 800;
    let vehicle = all_uncertain();
    let phenomena = Level::Five.phenomena();
    let start = Level5::<f64>::build(vehicle.nominal(), &phenomena).unwrap();
    let [_, first_order] = by_both::<Level5<f64>, Level5<Dual64>>(&phenomena);
    let mut generator = ChaCha8Rng::seed_from_u64(11);
    let mut normal = || StandardNormal.sample(&mut generator);
    let mut ends = Vec::new();
    for _ in 0..DRAWS {
        let drawn = vehicle.draw(&mut normal).unwrap().vehicle;
        ends.push(flown(&Level5::<f64>::build(&drawn, &phenomena).unwrap(), &start));
    }
    let n = DRAWS as f64;
    for (axis, first_order) in first_order.iter().enumerate() {
        let mean = ends.iter().map(|end| end[axis]).sum::<f64>() / n;
        let squares: f64 = ends.iter().map(|end| (end[axis] - mean).powi(2)).sum();
        let ratio = (squares / (n - 1.0)).sqrt() / first_order.standard_deviation();
        assert!(
            (ratio - 1.0).abs() < 4.0 / (2.0 * n).sqrt(),
            "axis {axis}: {ratio}"
        );
    }
}

/// The weight: `g σ_m` and `m σ_g`, and nothing else; its shares are one half each, the relative errors being equal.
#[test]
fn exact_effects_on_the_weight() {
    let vehicle = all_uncertain();
    let result = by_differences(&vehicle, |moved| Ok::<_, VehicleError>([moved.weight()]));
    let [weight] = result.unwrap();
    let expected = 1.4 * 9.81 * RELATIVE;
    for (number, (effect, share)) in vehicle
        .numbers()
        .iter()
        .zip(weight.effects.iter().zip(weight.shares()))
    {
        let (matters, half) = match number.key.as_str() {
            "airframe.mass_kg" | "environment.gravity_m_s2" => (expected, 0.5),
            _ => (0.0, 0.0),
        };
        // A difference of two numbers near 14 N.
        assert!(
            (effect - matters).abs() < 1e-14 && (share - half).abs() < 1e-11,
            "{}",
            number.key
        );
    }
}

/// What the reader derives has its derivatives: hubs move against the centre of mass, and the inverse inertia against the inertia.
#[test]
fn exact_derivatives_of_what_is_derived() {
    let vehicle = all_uncertain();
    let at = |key: &str| vehicle.numbers().iter().position(|n| n.key == key).unwrap();
    let moved = differentiable(&vehicle, at("airframe.centre_of_mass_m.y")).unwrap();
    for hub in &moved.hubs() {
        // A difference of two numbers near 0.2 m.
        assert!((hub.y.eps + ABSOLUTE).abs() < 1e-16, "{}", hub.y);
        assert_eq!(hub.x.eps, 0.0);
    }
    let moved = differentiable(&vehicle, at("airframe.inertia_zz_kg_m2")).unwrap();
    let phenomena = Level::Two.phenomena();
    let trim = Level2::<Dual64>::trim(vehicle.nominal(), &phenomena).unwrap();
    let body = Level2::<Dual64>::build_trimmed(&moved, &phenomena, &trim)
        .unwrap()
        .body;
    let inverse = body.inertia_inverse[(2, 2)];
    // 1/I, and −σ/I² with the roundings of a difference of σ.
    assert!((inverse.re - 25.0).abs() < 1e-13 && (inverse.eps + 25.0 * RELATIVE).abs() < 1e-12);
}
