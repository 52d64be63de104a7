//! Oracles of this crate alone: signs and sizes by hand, closed-form motions, refusals. Laws between the
//! levels are tested in the workspace's `tests`.

use crate::*;
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3};
use quad_math::{Flat, System, rk4};
use quad_rotor::{RotorOutput, ThrustState};

mod air_rates;
mod kicks;

/// A handful of roundings of numbers of order ten.
const ROUNDING: f64 = 1e-13;

fn qball() -> Vehicle {
    Vehicle::qball_x4()
}

fn level_2(on: &PhenomenonSet) -> Level2<f64> {
    Level2::build(&qball(), on).expect("the nominal vehicle has every group")
}

/// Rate of the body of level 2 at hover with the commands and the state changed.
fn body_rate(
    on: &PhenomenonSet,
    change: impl Fn(&mut RigidBodyState<f64>, &mut Input<f64>),
) -> RigidBodyRate<f64> {
    let model = level_2(on);
    let mut hover = model.hover(Vector3::zeros(), 0.0);
    change(&mut hover.state.body, &mut hover.input);
    model.derivative(&hover.state, &hover.input).body
}

/// `M_x = L (T_3 − T_4)`, `M_y = L (T_2 − T_1)`, `M_z = −Σ s_i Q_i` and `F_z = −Σ T_i`, one rotor at a time.
#[test]
fn exact_signs_of_one_rotor_at_a_time() {
    let step = 0.001;
    let (m, l, ixx, iyy, izz) = (1.4, 0.2, 0.03, 0.03, 0.04);
    let gains = qball().linear_rotor;
    let (thrust, torque) = (gains.thrust_gain * step, gains.torque_gain * step);
    let (roll, pitch, yaw) = (l * thrust / ixx, l * thrust / iyy, torque / izz);
    let expected = [
        (
            "rear, clockwise: nose down, yaws left",
            Vector3::new(0.0, -pitch, -yaw),
        ),
        (
            "front, clockwise: nose up, yaws left",
            Vector3::new(0.0, pitch, -yaw),
        ),
        (
            "left, counter-clockwise: right side down, yaws right",
            Vector3::new(roll, 0.0, yaw),
        ),
        (
            "right, counter-clockwise: left side down, yaws right",
            Vector3::new(-roll, 0.0, yaw),
        ),
    ];
    for (rotor, (what, angular)) in expected.into_iter().enumerate() {
        let rate = body_rate(&PhenomenonSet::none(), |_, input| input.commands[rotor] += step);
        assert_relative_eq!(rate.body_rates, angular, epsilon = ROUNDING);
        // Up is −z: every rotor lifts, none pushes.
        let lift = Vector3::new(0.0, 0.0, -thrust / m);
        assert_relative_eq!(rate.velocity, lift, epsilon = ROUNDING);
        assert!(what.contains("yaws left") == (rate.body_rates.z < 0.0), "{what}");
    }
}

/// Roll to the right with net momentum down (clockwise rotors faster): the nose goes up.
#[test]
fn exact_gyroscopic_torque_by_hand() {
    // −ω × h e_z with ω = (2, 3, 5) and h = 0.1: −(3 · 0.1, −2 · 0.1, 0).
    let moment = gyroscopic_torque(&Vector3::new(2.0, 3.0, 5.0), 0.1);
    assert_relative_eq!(moment, Vector3::new(-0.3, 0.2, 0.0), epsilon = 1e-16);

    // Rotors 1, 2 at a third more, 3, 4 at a third less thrust than hover, 3.4335 N.
    let on = PhenomenonSet::none().with(Phenomenon::GyroscopicTorque);
    let rolling = |on: &PhenomenonSet| {
        body_rate(on, |body, input| {
            body.body_rates.x = 2.0;
            let factors = [4.0 / 3.0, 4.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
            input.commands.iter_mut().zip(factors).for_each(|(u, f)| *u *= f);
        })
        .body_rates
    };
    let propeller = qball().propeller.expect("nominal");
    let speed = |thrust: f64| (thrust / propeller.law(1.225).thrust_per_speed_squared).sqrt();
    let weight = 1.4 * 9.81 / 4.0;
    let momentum = 6.5e-5 * 2.0 * (speed(weight * 4.0 / 3.0) - speed(weight * 2.0 / 3.0));
    let pitch = 2.0 * momentum / 0.03;
    assert!(pitch > 0.0);
    let difference = rolling(&on) - rolling(&PhenomenonSet::none());
    assert_relative_eq!(difference, Vector3::new(0.0, pitch, 0.0), epsilon = ROUNDING);
}

/// A clockwise rotor that spins up turns the airframe to the left, by `I_R Ω̇` with `Ω̇ = Ṫ / (2 k_T Ω)`.
#[test]
fn exact_spin_up_reaction_by_hand() {
    let yaw_rate = |on: &PhenomenonSet| {
        let model = Level3::<f64>::build(&qball(), on).expect("nominal");
        let mut hover = model.hover(Vector3::zeros(), 0.0);
        hover.input.commands[0] += 0.001;
        model.derivative(&hover.state, &hover.input).body.body_rates.z
    };
    let on = PhenomenonSet::none().with(Phenomenon::SpinUpReaction);
    let gains = qball().linear_rotor;
    let k_t = qball()
        .propeller
        .expect("nominal")
        .law(1.225)
        .thrust_per_speed_squared;
    let speed = (1.4 * 9.81 / 4.0 / k_t).sqrt();
    let spin = gains.bandwidth * gains.thrust_gain * 0.001 / (2.0 * k_t * speed);
    // Thrust and torque have not changed yet: the reaction stands alone.
    assert_relative_eq!(yaw_rate(&PhenomenonSet::none()), 0.0, epsilon = ROUNDING);
    assert_relative_eq!(yaw_rate(&on), -6.5e-5 * spin / 0.04, epsilon = ROUNDING);
}

/// `F_i = −k_i |v_i| v_i` against the air, `M_i = −d_i ω_i`; wind from behind pushes.
#[test]
fn exact_drag_by_hand() {
    let drag = Drag {
        quadratic: Vector3::new(0.1, 0.2, 0.3),
        rate_damping: Vector3::new(0.01, 0.02, 0.03),
    };
    let wrench = drag.wrench(&Vector3::new(2.0, -3.0, 0.0), &Vector3::new(1.0, -2.0, 3.0));
    assert_relative_eq!(wrench.force, Vector3::new(-0.4, 1.8, 0.0), epsilon = 1e-15);
    assert_relative_eq!(wrench.moment, Vector3::new(-0.01, 0.04, -0.09), epsilon = 1e-15);

    let on = PhenomenonSet::none().with(Phenomenon::Drag);
    let in_wind = body_rate(&on, |_, input| input.wind = Vector3::new(4.0, 0.0, 0.0));
    let k = qball().drag.expect("nominal").quadratic.x;
    assert_relative_eq!(in_wind.velocity.x, k * 16.0 / 1.4, epsilon = ROUNDING);
    // Facing east, the same wind from the south comes from the right and pushes to the left.
    let from_the_side = body_rate(&on, |body, input| {
        *body = RigidBodyState::at_rest(Vector3::zeros(), std::f64::consts::FRAC_PI_2);
        input.wind = Vector3::new(4.0, 0.0, 0.0);
    });
    assert!(from_the_side.velocity.y < 0.0 && from_the_side.velocity.x.abs() < ROUNDING);
}

/// Commands beyond the limits act as the limits when these are on.
#[test]
fn exact_limits_clamp_the_commands() {
    let on = PhenomenonSet::none().with(Phenomenon::InputLimits);
    let at = |on: &PhenomenonSet, u: f64| body_rate(on, |_, input| input.commands = [u; 4]).velocity.z;
    let range = qball().zeroed_range();
    assert_eq!(at(&on, 1.0), at(&on, *range.end()));
    assert_eq!(at(&on, -1.0), at(&on, *range.start()));
    assert!(at(&PhenomenonSet::none(), 1.0) < at(&on, 1.0));
}

/// Torque-free symmetric top (Goldstein, section 5.6): the transverse rate turns at `(I_3 − I_1)/I_1 ω_3`.
#[test]
fn exact_torque_free_precession() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.03, 0.03, 0.04));
    let body = RigidBody {
        mass: 1.4,
        inertia,
        inertia_inverse: inertia.try_inverse().expect("diagonal"),
        gravity: 9.81,
    };
    let spin = 6.0;
    let f = |_, w: &Vector3<f64>| body.angular_acceleration(w, &Vector3::zeros());
    let (h, steps) = (1e-3, 1000);
    let end = (0..steps).fold(Vector3::new(0.5, 0.0, spin), |w, _| rk4(&f, 0.0, &w, h));
    let turned = (0.04 - 0.03) / 0.03 * spin;
    let expected = Vector3::new(0.5 * turned.cos(), 0.5 * turned.sin(), spin);
    // 1000 steps of (h · 2 rad/s)⁵/120.
    assert_relative_eq!(end, expected, epsilon = 1e-12);
}

/// Level 3 under a step: `T = T_∞ + (T_0 − T_∞) e^(−ω_R t)` inside the vehicle as alone.
#[test]
fn exact_thrust_rate_of_level_3() {
    let model = Level3::<f64>::build(&qball(), &PhenomenonSet::none()).expect("nominal");
    let mut hover = model.hover(Vector3::zeros(), 0.0);
    hover.state.rotors = [1.0, 2.0, 3.0, 4.0].map(|thrust| ThrustState { thrust });
    let rate = model.derivative(&hover.state, &hover.input);
    let gains = qball().linear_rotor;
    for (rotor, thrust) in [1.0, 2.0, 3.0, 4.0].into_iter().enumerate() {
        let expected = gains.bandwidth * (1.4 * 9.81 / 4.0 - thrust);
        assert_relative_eq!(rate.rotors[rotor].thrust, expected, epsilon = 1e-12);
    }
    let flight = model.flight(&hover.state);
    assert_eq!(flight.thrusts, Some([1.0, 2.0, 3.0, 4.0]));
}

/// Centre of mass 2 cm ahead of the centre on arms of 20 cm: by the lever rule the front rotor carries a tenth
/// of the weight more than the rear one, and left and right share the other half.
#[test]
fn exact_hover_with_the_centre_of_mass_ahead() {
    let mut vehicle = qball();
    vehicle.airframe.centre_of_mass.x = 0.02;
    let model = Level2::<f64>::build(&vehicle, &PhenomenonSet::none()).expect("nominal");
    let thrusts = model
        .hover(Vector3::zeros(), 0.0)
        .input
        .commands
        .map(|u| u * vehicle.linear_rotor.thrust_gain);
    let w = 1.4 * 9.81;
    let expected = [w * (0.25 - 0.05), w * (0.25 + 0.05), w * 0.25, w * 0.25];
    for (thrust, expected) in thrusts.into_iter().zip(expected) {
        assert_relative_eq!(thrust, expected, epsilon = 1e-12);
    }
}

/// In hover the battery gives what motors of this torque draw, and its voltage is what that leaves of it.
#[test]
fn exact_hover_voltage_of_level_5() {
    let on = PhenomenonSet::none().with(Phenomenon::VoltageSag);
    let model = Level5::<f64>::build(&qball(), &on).expect("nominal");
    let hover = model.hover(Vector3::zeros(), 0.0);
    let (current, inputs) =
        model
            .rotor_set
            .rotor_inputs(&hover.state.rotors, &hover.state.supply, &hover.input);
    let torque = hover.state.rotors[0].torque;
    let duty = (hover.input.commands[0] + 0.0598654 - 0.05) / 0.05;
    let by_hand = 4.0 * duty * (106.8142 * torque + 1.1);
    assert_relative_eq!(current, by_hand, max_relative = 1e-12);
    assert_relative_eq!(inputs[0].voltage, 12.59 - 0.061 * by_hand, max_relative = 1e-12);
    // Ampere-seconds to ampere-hours.
    let rate = model.derivative(&hover.state, &hover.input);
    assert_relative_eq!(rate.supply.charge_drawn, by_hand / 3600.0, max_relative = 1e-12);
}

#[test]
fn exact_wrench_of_unequal_rotors() {
    let geometry = RotorGeometry::<f64>::of(&qball());
    let rotor = |thrust, torque| RotorOutput { thrust, torque };
    let wrench = geometry.wrench(&[rotor(1.0, 0.1), rotor(2.0, 0.2), rotor(4.0, 0.4), rotor(3.0, 0.3)]);
    assert_relative_eq!(wrench.force, Vector3::new(0.0, 0.0, -10.0), epsilon = 1e-15);
    // L (4 − 3), L (2 − 1), −(0.1 + 0.2) + (0.4 + 0.3).
    assert_relative_eq!(wrench.moment, Vector3::new(0.2, 0.2, 0.4), epsilon = 1e-15);
}

#[test]
fn exact_unmet_prerequisites_name_both() {
    let refused = |error: Option<BuildError>| error.expect("refused").to_string();
    let with = |phenomenon| PhenomenonSet::none().with(phenomenon);
    assert_eq!(
        refused(Level1::<f64>::build(&qball(), &with(Phenomenon::Drag)).err()),
        "level 1 can't have drag: it needs a non-linear rigid body (levels 2 to 5)"
    );
    assert_eq!(
        refused(Level3::<f64>::build(&qball(), &with(Phenomenon::VoltageSag)).err()),
        "level 3 can't have voltage-sag: it needs rotors that depend on the battery voltage (level 5)"
    );
    for refused in [
        Level2::<f64>::build(&qball(), &with(Phenomenon::SpinUpReaction)).is_err(),
        Level4::<f64>::build(&qball(), &with(Phenomenon::SpinUpReaction)).is_err(),
        MechanisticQuadrotor::<f64>::build(&qball(), &with(Phenomenon::SpinUpReaction)).is_err(),
    ] {
        assert!(refused);
    }
    let vendor = Level4::<f64>::build(&Vehicle::qball_x4_vendor(), &PhenomenonSet::none());
    let message = refused(vendor.err());
    assert!(
        message.contains("rotor_dynamics") && message.contains("level 4"),
        "{message}"
    );
}

#[test]
fn exact_hover_out_of_range_names_the_rotor() {
    let mut vehicle = qball();
    vehicle.airframe.mass *= 4.0;
    let on = PhenomenonSet::none().with(Phenomenon::InputLimits);
    let error = Level2::<f64>::build(&vehicle, &on).expect_err("too heavy");
    assert!(
        matches!(
            error,
            BuildError::HoverOutOfRange {
                rotor: 1,
                maximum: 0.1,
                ..
            }
        ),
        "{error}"
    );
    // Without limits there is no range to leave.
    assert!(Level2::<f64>::build(&vehicle, &PhenomenonSet::none()).is_ok());
}

#[test]
fn exact_levels_and_their_numbers() {
    for level in Level::ALL {
        assert_eq!(Level::try_from(level.number()), Ok(level));
        let vehicle = qball();
        let any = AnyQuadrotor::<f64>::hovering(level, &vehicle, &level.phenomena(), Vector3::zeros(), 0.0);
        let any = any.expect("nominal");
        assert_eq!(any.level(), level);
        assert_eq!(any.phenomena(), &level.phenomena());
        let mut numbers = vec![f64::NAN; any.state_len()];
        any.write_state(&mut numbers);
        assert!(numbers.iter().all(|x| x.is_finite()));
    }
    let number = Level::HIGHEST.number() + 1;
    assert_eq!(Level::try_from(number), Err(NoSuchLevel { number }));
    assert_eq!(
        NoSuchLevel { number }.to_string(),
        "unknown level 6; the family has levels 1 to 5"
    );
    assert_eq!((Level::One.below(), Level::Two.below()), (None, Some(Level::One)));
    assert_eq!(
        (Level::Five.above(), Level::Four.above()),
        (None, Some(Level::Five))
    );
    assert!(Level::Three.phenomena().is_subset(&Level::Four.phenomena()));
    assert!(!Level::Five.phenomena().is_subset(&Level::Four.phenomena()));
}

/// The model without its switches is the model: the same numbers, bit for bit, and none while a part is on.
#[test]
fn agree_bare_model_with_the_switched_one() {
    let vehicle = qball();
    let model = crate::Level3::<f64>::build(&vehicle, &PhenomenonSet::none()).unwrap();
    let hover = model.hover(Vector3::new(1.0, -2.0, -3.0), 0.7);
    let mut state = hover.state;
    state.body.velocity = Vector3::new(0.5, -0.4, 0.3);
    state.body.body_rates = Vector3::new(1.0, -2.0, 0.5);
    let mut input = hover.input;
    input.commands[1] += 1e-3;
    let bare = model.bare().unwrap();
    assert_eq!(bare.derivative(&state, &input), model.derivative(&state, &input));
    let limited = PhenomenonSet::none().with(crate::Phenomenon::InputLimits);
    assert!(
        crate::Level3::<f64>::build(&vehicle, &limited)
            .unwrap()
            .bare()
            .is_none()
    );
}

/// Every phenomenon by itself at every level: the declaration and the model agree on whether it can be built, and
/// a refusal names both.
#[test]
fn agree_prerequisites_with_what_builds() {
    let vehicle = qball();
    for level in Level::ALL {
        for phenomenon in Phenomenon::ALL {
            let on = PhenomenonSet::none().with(phenomenon);
            let built = AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, Vector3::zeros(), 0.0);
            let admitted = on.admitted_by(level.capabilities()) == on;
            match built {
                Ok(_) => assert!(admitted, "{level}, {phenomenon}"),
                Err(error) => {
                    assert!(!admitted, "{level}, {phenomenon}");
                    let text = error.to_string();
                    let prerequisite = phenomenon.prerequisite().to_string();
                    assert!(
                        text.contains(phenomenon.name()) && text.contains(&prerequisite),
                        "{text}"
                    );
                }
            }
        }
    }
    // What needs drag comes with it, and goes with it.
    let windy = PhenomenonSet::none()
        .with(Phenomenon::Drag)
        .with(Phenomenon::Turbulence);
    assert!(Level2::<f64>::build(&vehicle, &windy).is_ok());
    assert_eq!(
        windy.admitted_by(Level::One.capabilities()),
        PhenomenonSet::none()
    );
    let message = Level2::<f64>::build(&vehicle, &windy.without(Phenomenon::Drag)).unwrap_err();
    assert_eq!(
        message.to_string(),
        "level 2 can't have turbulence: it needs the phenomenon drag, through which the air is felt"
    );
}

/// What a model says of itself and what it is: its name, where its rigid body is, and a natural size for each state of its own.
fn check_row<M: LevelModel<f64>>(level: Level) {
    assert_eq!((M::LEVEL, M::NAME), (level, level.to_string().as_str()));
    let any = AnyQuadrotor::<f64>::hovering(level, &qball(), &level.phenomena(), Vector3::zeros(), 0.0);
    let mut any = any.expect("nominal");
    let is_rigid_body = level.capabilities().non_linear_rigid_body;
    assert_eq!(any.rigid_body().is_some(), is_rigid_body, "{level}");
    let shared = if is_rigid_body { 13 } else { 12 };
    let scales = any.own_scales();
    assert_eq!(any.state_len(), shared + scales.len(), "{level}");
    assert!(
        scales.iter().all(|scale| scale.is_finite() && *scale > 0.0),
        "{level}"
    );
    let snapshot = any.snapshot(&any.hover_input());
    assert_eq!(
        snapshot.charge_drawn.is_some(),
        level.capabilities().has_battery,
        "{level}"
    );
}

/// Every row of the table of levels.
struct Check(Level);

impl WithLevel<f64> for Check {
    type Out = ();

    fn with<M: LevelModel<f64>>(self) {
        check_row::<M>(self.0);
    }
}

#[test]
fn exact_rows_of_the_table_of_levels() {
    for level in Level::ALL {
        level.visit(Check(level));
    }
}

/// The declared fastest pole bounds the rotor's response: thrust after a step of the command relaxes no faster. The decay
/// of the last per cent of a step is that of the slowest pole, its beginning that of the sum of all; so the rate of any state, over its
/// distance to the new equilibrium, bounds nothing for two poles. Instead the Jacobian's eigenvalues are found, by central
/// differences of one rotor's states about hover.
#[test]
fn agree_fastest_pole_with_eigenvalues() {
    fn check<M: QuadrotorModel<f64>>(size: usize, on: &PhenomenonSet) {
        let model = M::build(&qball(), on).expect("nominal");
        let hover = model.hover(Vector3::zeros(), 0.0);
        let rate = |x: &[f64]| {
            let rate = model.derivative(&Flat::read(x), &hover.input);
            let mut numbers = vec![0.0; <quad_math::RateOf<f64, M> as Flat<f64>>::LEN];
            rate.write(&mut numbers);
            numbers
        };
        let mut at = vec![0.0; <StateOf<f64, M> as Flat<f64>>::LEN];
        hover.state.write(&mut at);
        // The body's 13 numbers come first; its rate has 13 too.
        let jacobian = nalgebra::DMatrix::from_fn(size, size, |row, column| {
            let h = 1e-4 * at[13 + column].abs().max(1e-3);
            let moved = |h: f64| {
                let mut x = at.clone();
                x[13 + column] += h;
                rate(&x)[13 + row]
            };
            (moved(h) - moved(-h)) / (2.0 * h)
        });
        let fastest = jacobian
            .complex_eigenvalues()
            .iter()
            .map(|e| e.norm())
            .fold(0.0, f64::max);
        let declared = model.fastest_pole();
        // Never below the true one; the sum of two poles is less than twice the faster. A thousandth for the differences.
        assert!(
            fastest < 1.001 * declared && declared < 2.0 * fastest,
            "{}: {fastest} of {declared}",
            M::NAME
        );
    }
    let none = PhenomenonSet::none();
    check::<Level3<f64>>(1, &none);
    check::<Level4<f64>>(4, &none);
    check::<Level5<f64>>(4, &none);
    check::<MechanisticQuadrotor<f64>>(2, &none);
}
