//! Hand-derived inversions against the generic one, and both where they are singular.

use super::*;
use crate::{C1, C2, C3, Decoupling, InversionError, LoopGains, stability};
use nalgebra::{Matrix3, Vector4};
use quad_dynamics::{Level1, Level2, Level3, PhenomenonSet};
use quad_math::Taylor3;

/// Tilt up to 70°, rates up to 5 rad/s, thrusts from half to one and a half of hover.
const RANGES: Ranges = Ranges {
    tilt: 1.22,
    rate: 5.0,
    share: 0.5,
};

/// Rounding of some hundred operations on either side, with room for trigonometry at 70° of pitch; what the
/// inverse makes of it is in [`amplified`].
const TOLERANCE: f64 = 2e4 * f64::EPSILON;

/// Any of the vehicles, made heavier, stiffer, skewer and faster by random factors.
fn vehicle() -> impl Strategy<Value = Vehicle> {
    let factor = || 0.5..2.0;
    (0..3_usize, factor(), factor(), factor(), factor(), -0.2..0.2).prop_map(|(which, m, i, k, w, skew)| {
        let mut vehicle = vehicles()[which].clone();
        let airframe = &mut vehicle.airframe;
        airframe.mass *= m;
        let least = airframe.inertia.diagonal().min();
        airframe.inertia *= i;
        airframe.inertia += Matrix3::new(0.0, skew, -skew, skew, 0.0, skew, -skew, skew, 0.0) * least * i;
        vehicle.linear_rotor.thrust_gain *= k;
        vehicle.linear_rotor.torque_gain *= k;
        vehicle.linear_rotor.bandwidth *= w;
        vehicle
    })
}

/// Demands on z and the three angles, of the size that steps make.
fn demand() -> impl Strategy<Value = Vector4<f64>> {
    prop::array::uniform4(-1.0..1.0)
        .prop_map(|v| Vector4::from(v).component_mul(&Vector4::new(5.0, 30.0, 30.0, 10.0)))
}

/// The generic inversion of a model at a moment.
fn generic<M: QuadrotorModel<f64>, T: QuadrotorModel<Taylor3>>(
    vehicle: &Vehicle,
    moment: &Moment,
    order: usize,
) -> Decoupling {
    let none = PhenomenonSet::none();
    let state = state_at(&M::build(vehicle, &none).unwrap(), vehicle, moment);
    Decoupling::of(&T::build(vehicle, &none).unwrap(), &flat(&state), order).unwrap()
}

fn flight<M: QuadrotorModel<f64>>(vehicle: &Vehicle, moment: &Moment) -> quad_dynamics::Flight<f64> {
    let model = M::build(vehicle, &PhenomenonSet::none()).unwrap();
    model.flight(&state_at(&model, vehicle, moment))
}

/// How rounding of the terms of `A u = v − b` reaches the commands: `|A⁻¹| (|v| + |b|)`, the largest of them
/// (Skeel's bound; Higham, *Accuracy and Stability of Numerical Algorithms*, chapter 7).
fn amplified(generic: &Decoupling, v: &Vector4<f64>) -> f64 {
    let inverse = generic.matrix.try_inverse().unwrap();
    (inverse.abs() * (v.abs() + generic.drift.abs())).max()
}

fn close(
    by_hand: &[f64; 4],
    generic: &Decoupling,
    v: &Vector4<f64>,
    scale: f64,
) -> Result<(), TestCaseError> {
    let theirs = generic.invert(v).unwrap();
    let size = amplified(generic, v).max(scale);
    for (ours, theirs) in by_hand.iter().zip(theirs) {
        prop_assert!(
            (ours - theirs).abs() <= TOLERANCE * size,
            "{by_hand:?} {theirs:?} {size}"
        );
    }
    Ok(())
}

/// The command that hovers, to measure commands by.
fn hover(vehicle: &Vehicle) -> f64 {
    vehicle.hover_thrust_per_rotor() / vehicle.linear_rotor.thrust_gain
}

proptest! {
    #[test]
    fn agree_c1_with_generic_inversion_of_level_1(v in vehicle(), at in moment(RANGES), d in demand()) {
        let c1 = C1::new(&v, &Settings::default()).unwrap();
        let ours = c1.allocation.commands(&c1.invert(d[0], &d.fixed_rows::<3>(1).into_owned()));
        let theirs = generic::<Level1<f64>, Level1<Taylor3>>(&v, &at, 2);
        close(&ours, &theirs, &d, hover(&v))?;
    }

    #[test]
    fn agree_c2_with_generic_inversion_of_level_2(v in vehicle(), at in moment(RANGES), d in demand()) {
        let c2 = C2::new(&v, &Settings::default()).unwrap();
        let flight = flight::<Level2<f64>>(&v, &at);
        let ours = c2.allocation.commands(&c2.invert(&flight, d[0], &d.fixed_rows::<3>(1).into_owned()));
        let theirs = generic::<Level2<f64>, Level2<Taylor3>>(&v, &at, 2);
        close(&ours, &theirs, &d, hover(&v))?;
    }

    #[test]
    fn agree_c3_with_generic_inversion_of_level_3(v in vehicle(), at in moment(RANGES), d in demand()) {
        let c3 = C3::new(&v, &Settings::default()).unwrap();
        let flight = flight::<Level3<f64>>(&v, &at);
        // Third derivatives are about a bandwidth larger than second ones.
        let d = d * c3.bandwidth;
        let ours = c3.invert(&flight, &thrusts(&v, &at), d[0], &d.fixed_rows::<3>(1).into_owned());
        let theirs = generic::<Level3<f64>, Level3<Taylor3>>(&v, &at, 3);
        close(&ours, &theirs, &d, hover(&v))?;
    }

    #[test]
    fn agree_c3_without_thrust(at in moment(Ranges { share: 0.0, ..RANGES }), d in demand()) {
        // The rotors' rates, not their thrusts, are the input of z⃛ and η⃛: still rotors are no singularity.
        let v = Vehicle::qball_x4();
        let at = Moment { thrust_shares: [0.0; 4], ..at };
        let c3 = C3::new(&v, &Settings::default()).unwrap();
        let ours = c3.invert(&flight::<Level3<f64>>(&v, &at), &[0.0; 4], d[0], &d.fixed_rows::<3>(1).into_owned());
        let theirs = generic::<Level3<f64>, Level3<Taylor3>>(&v, &at, 3);
        close(&ours, &theirs, &d, hover(&v))?;
    }
}

/// At rest with this attitude, in hover thrust.
fn resting(roll: f64, pitch: f64) -> Moment {
    let mut body = RigidBodyState::at_rest(Vector3::zeros(), 0.0);
    body.attitude = EulerAngles::new(roll, pitch, 0.3).quaternion();
    Moment {
        body,
        thrust_shares: [1.0; 4],
    }
}

#[test]
fn exact_generic_inversion_refuses_a_thrust_without_vertical_part() {
    let v = Vehicle::qball_x4();
    let right = std::f64::consts::FRAC_PI_2;
    // 1e-9 rad of a right angle leaves nine digits less than level flight has: beyond the limit of eight.
    for (roll, pitch) in [
        (right, 0.0),
        (0.0, right),
        (-right, 0.4),
        (0.2, -right),
        (right - 1e-9, 0.0),
    ] {
        let at = resting(roll, pitch);
        for decoupling in [
            generic::<Level2<f64>, Level2<Taylor3>>(&v, &at, 2),
            generic::<Level3<f64>, Level3<Taylor3>>(&v, &at, 3),
        ] {
            let refused = decoupling.invert(&Vector4::new(1.0, 0.0, 0.0, 0.0));
            let Err(InversionError::NearSingular { condition }) = refused else {
                panic!("{roll} {pitch}: {refused:?}")
            };
            assert!(condition > 1e8, "{condition}");
        }
    }
}

#[test]
fn exact_generic_inversion_refuses_a_wrong_relative_degree_and_bad_states() {
    let v = Vehicle::qball_x4();
    let at = resting(0.1, 0.2);
    // The commands of level 3 don't show in second derivatives.
    let blind = generic::<Level3<f64>, Level3<Taylor3>>(&v, &at, 2);
    assert!(matches!(
        blind.invert(&Vector4::zeros()),
        Err(InversionError::NearSingular { .. })
    ));
    let model = Level2::<Taylor3>::build(&v, &PhenomenonSet::none()).unwrap();
    for relative_degree in [0, 4] {
        let refused = Decoupling::of(&model, &[0.0; 13], relative_degree).unwrap_err();
        assert_eq!(refused, InversionError::RelativeDegree { relative_degree });
        assert!(refused.to_string().contains(&relative_degree.to_string()));
    }
    let nowhere = Decoupling::of(&model, &[f64::NAN; 13], 2).unwrap();
    assert!(matches!(
        nowhere.invert(&Vector4::zeros()),
        Err(InversionError::NearSingular { .. })
    ));
}

#[test]
fn agree_loop_gains_with_characteristic_polynomials() {
    let gains = LoopGains {
        natural_frequency: 3.0,
        damping: 0.7,
        pole: 11.0,
    };
    // One error at a time: the law returns the coefficient of its polynomial.
    let third = [
        1.0,
        gains.third_order(0.0, 0.0, 1.0, 0.0),
        gains.third_order(0.0, 1.0, 0.0, 0.0),
        gains.third_order(1.0, 0.0, 0.0, 0.0),
    ];
    let second = [
        1.0,
        gains.second_order(0.0, 1.0, 0.0),
        gains.second_order(1.0, 0.0, 0.0),
    ];
    let pair = stability::SecondOrder::new(3.0, 0.7).unwrap();
    let placed = stability::AttitudeLoop::ThirdOrder {
        pair,
        pole_rad_s: 11.0,
    }
    .characteristic();
    let plain = stability::AttitudeLoop::SecondOrder(pair).characteristic();
    for (ours, theirs) in third.iter().zip(&placed).chain(second.iter().zip(&plain)) {
        // A sum and two products in another order.
        approx::assert_relative_eq!(ours, theirs, max_relative = 4.0 * f64::EPSILON);
    }
    assert_eq!(gains.third_order(0.0, 0.0, 0.0, 2.5), 2.5);
    assert_eq!(gains.second_order(0.0, 0.0, 2.5), 2.5);
}
