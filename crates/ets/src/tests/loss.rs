//! Loss of the target, search and re-acquisition.

use super::{nominal, run};
use crate::{Mode, Search, Sight};
use nalgebra::Vector3;
use proptest::prelude::*;
use quad_math::Flat;

/// Somewhere no camera looks: below the tilt's travel.
const HIDDEN: Vector3<f64> = Vector3::new(0.1, 0.0, 50.0);

/// Hidden for less than the hold time, moving steadily: coasting at the last rate keeps it near the centre.
#[test]
fn exact_coasting_holds_the_last_rate() {
    let (station, ets, clock) = nominal();
    let target = |t: f64| Vector3::new(4.0, -2.0 + t, -1.0);
    let seen = |t: f64| {
        if (2.0..2.4).contains(&t) {
            HIDDEN
        } else {
            target(t)
        }
    };
    let start = ets.at_rest((-2.0_f64).atan2(4.0), 0.2);
    let mut modes = Vec::new();
    run(&ets, &clock, start, 3500, seen, |t, state| {
        let mode = state.sight.mode(&station.tracker);
        if modes.last() != Some(&mode) {
            modes.push(mode);
        }
        if t > 2.0 {
            // The line of sight turns at up to 0.25 rad/s with accelerations up to 0.04 rad/s² here: after 0.45 s without a frame the held
            // rate is off by 0.04 · 0.45²/2 = 4 mrad, 2.7 px, beside the tracking error of 2 px.
            let off = ets.view(&state.gimbal, &target(t)).point.norm();
            assert!(off < 4.7, "{t}: {off}");
        }
    });
    use Mode::{Coasting, Searching, Tracking};
    // The first frame arrives after the latency: until then there is nothing but the search's first steps.
    assert_eq!(modes, [Searching, Tracking, Coasting, Tracking]);
}

/// Never seen at the start: the search finds a target anywhere within its radius, in one sweep.
#[test]
fn exact_search_finds_a_target_within_its_radius() {
    let (station, ets, clock) = nominal();
    let sweep = station.tracker.search.sweep_time();
    for pan_deg in [-44.0_f64, -30.0, 30.0, 44.0] {
        let pan = pan_deg.to_radians();
        let target = Vector3::new(6.0 * pan.cos(), 6.0 * pan.sin(), -1.0);
        let mut found_at = None;
        let end = run(
            &ets,
            &clock,
            ets.at_rest(0.0, 0.3),
            12_000,
            |_| target,
            |t, state| {
                if state.sight.mode(&station.tracker) == Mode::Tracking && found_at.is_none() {
                    found_at = Some(t);
                }
            },
        );
        assert!(
            found_at.is_some_and(|t| t < sweep + 0.1),
            "{pan_deg}: {found_at:?}, sweep {sweep}"
        );
        // Found, and brought to the centre: seconds after, far more than ten time constants.
        assert!(ets.view(&end.gimbal, &target).point.norm() < 0.1);
    }
}

/// Out of sight for longer than the hold time, and somewhere else after: coasting, search, re-acquisition.
#[test]
fn prop_lost_and_found_again() {
    let (station, ets, clock) = nominal();
    let target = |t: f64| {
        if t < 1.0 {
            Vector3::new(5.0, 0.0, -1.0)
        } else if t < 3.0 {
            HIDDEN
        } else {
            Vector3::new(4.5, 2.5, -1.0)
        }
    };
    let mut modes = vec![];
    let end = run(&ets, &clock, ets.at_rest(0.0, 0.2), 12_000, target, |_, state| {
        let mode = state.sight.mode(&station.tracker);
        if modes.last() != Some(&mode) {
            modes.push(mode);
        }
    });
    use Mode::{Coasting, Searching, Tracking};
    assert_eq!(modes, [Searching, Tracking, Coasting, Searching, Tracking]);
    assert!(ets.view(&end.gimbal, &target(12.0)).point.norm() < 0.1);
}

proptest! {
    /// Turns of the spiral are at most a pitch apart and its speed is at most the design's (far from the zenith).
    #[test]
    fn prop_search_has_no_gaps(radius in 0.2..0.8_f64, share in 0.1..0.5_f64, speed in 0.3..2.0_f64, azimuth in -3.0..3.0_f64) {
        let search = Search { radius, pitch: share * radius, speed };
        let centre = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let turn = std::f64::consts::TAU * radius / speed;
        let rho = |t: f64| {
            let d = search.direction(&centre, t);
            // Offsets in azimuth and elevation, about the horizon.
            let aside = (centre.x * d.y - centre.y * d.x).atan2(centre.x * d.x + centre.y * d.y);
            aside.hypot((-d.z).asin())
        };
        let sweep = search.sweep_time();
        prop_assert!((rho(sweep) - radius).abs() < 1e-9 && rho(0.0) < 1e-9);
        for k in 0..20 {
            let t = sweep * f64::from(k) / 20.0;
            prop_assert!((rho(t + turn) - rho(t)).abs() < search.pitch * (1.0 + 1e-9));
            let dt = 1e-5;
            let moved = (search.direction(&centre, t + dt) - search.direction(&centre, t)).norm() / dt;
            // Along the turns at most v, across them at most p v/(2πρ_max).
            prop_assert!(moved < speed * (1.0 + share / std::f64::consts::TAU).powi(2) + 1e-4);
        }
    }

    #[test]
    fn prop_flat_round_trip(values in prop::array::uniform17(-10.0..10.0_f64)) {
        let mut out = [0.0; 17];
        <crate::EtsState<f64> as Flat<f64>>::read(&values).write(&mut out);
        prop_assert_eq!(out, values);
        prop_assert_eq!(<Sight<f64> as Flat<f64>>::LEN, 13);
    }
}
