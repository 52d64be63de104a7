use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;
use quad_dynamics::Phenomenon;
use std::convert::Infallible;

/// Random games of five players.
const PLAYERS: usize = 5;

fn game() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-10.0..10.0_f64, 1 << PLAYERS)
}

/// By the definition over orders of arrival: the mean of what each adds when it comes, over all 120 orders.
fn by_permutations(game: &[f64]) -> Vec<f64> {
    fn arrive(order: &mut Vec<usize>, game: &[f64], sums: &mut [f64], count: &mut f64) {
        if order.len() == PLAYERS {
            let mut set = 0;
            for &i in order.iter() {
                sums[i] += game[set | 1 << i] - game[set];
                set |= 1 << i;
            }
            *count += 1.0;
        }
        for i in 0..PLAYERS {
            if !order.contains(&i) {
                order.push(i);
                arrive(order, game, sums, count);
                order.pop();
            }
        }
    }
    let (mut sums, mut count) = (vec![0.0; PLAYERS], 0.0);
    arrive(&mut Vec::new(), game, &mut sums, &mut count);
    sums.iter().map(|s| s / count).collect()
}

// Sums of 32 numbers of size ten.
const ROUNDING: f64 = 1e-12;

proptest! {
    #[test]
    fn agree_with_the_mean_over_orders(game in game()) {
        let values = shapley_values(PLAYERS, |s| game[s]);
        for (a, b) in values.iter().zip(by_permutations(&game)) {
            prop_assert!((a - b).abs() < ROUNDING);
        }
    }

    #[test]
    fn prop_efficiency(game in game()) {
        let sum: f64 = shapley_values(PLAYERS, |s| game[s]).iter().sum();
        prop_assert!((sum - (game[31] - game[0])).abs() < ROUNDING);
    }

    /// Players 1 and 3, whose exchange changes no coalition's value, get the same.
    #[test]
    fn prop_symmetry(game in game()) {
        let exchanged = |s: usize| s & !0b1010 | (s & 0b0010) << 2 | (s & 0b1000) >> 2;
        let values = shapley_values(PLAYERS, |s| game[s] + game[exchanged(s)]);
        prop_assert!((values[1] - values[3]).abs() < ROUNDING);
    }

    /// Player 2, who adds the same 3 to every coalition, gets 3; who adds nothing gets nothing.
    #[test]
    fn prop_dummy(game in game(), adds in prop::sample::select(vec![0.0, 3.0])) {
        let values = shapley_values(PLAYERS, |s| game[s & !0b100] + if s & 0b100 != 0 { adds } else { 0.0 });
        prop_assert!((values[2] - adds).abs() < ROUNDING);
    }

    #[test]
    fn prop_additivity(a in game(), b in game()) {
        let sum = shapley_values(PLAYERS, |s| a[s] + b[s]);
        let (a, b) = (shapley_values(PLAYERS, |s| a[s]), shapley_values(PLAYERS, |s| b[s]));
        for i in 0..PLAYERS {
            prop_assert!((sum[i] - a[i] - b[i]).abs() < ROUNDING);
        }
    }
}

/// The glove game: players 0 and 1 have a left glove, 2 the right one; a pair is worth 1. Values 1/6, 1/6, 2/3.
#[test]
fn exact_glove_game() {
    let values = shapley_values(3, |s| f64::from(s & 0b100 != 0 && s & 0b011 != 0));
    for (value, expected) in values.iter().zip([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]) {
        assert_relative_eq!(*value, expected, epsilon = 1e-15);
    }
}

/// From level 4 to 5: non-linear rotor (and with it the dependence on voltage), limits, sag. Sag without the rotors is not built.
#[test]
fn exact_models_between_levels_4_and_5() {
    let parts = Parts::between_levels(Level::Four, Level::Five);
    let place = |f: Feature| 1 << parts.parts().iter().position(|p| *p == f).unwrap();
    let sag = place(Feature::Phenomenon(Phenomenon::VoltageSag));
    let limits = place(Feature::Phenomenon(Phenomenon::InputLimits));
    let rotor = place(Feature::NonLinearRotor);
    assert_eq!(parts.parts().len(), 3);
    assert_eq!(parts.model(0), (Level::Four, Level::Four.phenomena()));
    assert_eq!(parts.model(sag), parts.model(0));
    assert_eq!(
        parts.model(limits | sag),
        (Level::Four, Level::Four.phenomena().with(Phenomenon::InputLimits))
    );
    assert_eq!(
        parts.model(sag | limits | rotor),
        (Level::Five, Level::Five.phenomena())
    );
    let vehicle = quad_dynamics::Vehicle::qball_x4();
    let mut runs = 0;
    for set in 0..1 << parts.parts().len() {
        let (level, on) = parts.model(set);
        let origin = nalgebra::Vector3::zeros();
        assert!(quad_dynamics::AnyQuadrotor::<f64>::hovering(level, &vehicle, &on, origin, 0.0).is_ok());
    }
    let count = parts.attribute(|_, _| {
        runs += 1;
        Ok::<_, Infallible>(0.0)
    });
    // Two of the eight are the same as without sag.
    assert!(count.is_ok());
    assert_eq!(runs, 6);
}

#[test]
fn exact_wrong_questions_are_errors() {
    let of = |level: Level, on: &PhenomenonSet| Resolution::of(level, on);
    let drag = PhenomenonSet::none().with(Phenomenon::Drag);
    let error =
        Parts::between::<Infallible>(&of(Level::Two, &drag), &of(Level::Three, &PhenomenonSet::none()));
    let text = error.unwrap_err().to_string();
    assert!(text.contains("has no drag"), "{text}");
    let parts = Parts::between_levels(Level::Three, Level::Four);
    let error = parts.attribute(|_, _| Ok::<_, Infallible>(f64::NAN)).unwrap_err();
    assert!(matches!(
        error,
        AttributionError::NotFinite {
            level: Level::Three,
            ..
        }
    ));
    let error = parts.attribute(|_, _| Err::<f64, _>("no")).unwrap_err();
    assert_eq!(error, AttributionError::Run("no"));
}
