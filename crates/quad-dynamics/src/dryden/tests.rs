use super::*;
use approx::assert_relative_eq;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

/// The flight of the independent run: h = 20 ft, V = 30 ft/s, W_20 = 25 ft/s.
pub(super) const HEIGHT_FT: f64 = 20.0;
pub(super) const AIRSPEED_FT_S: f64 = 30.0;
pub(super) const W20_FT_S: f64 = 25.0;
/// Step, s: a hundredth of the shortest time L_w/V = 0.67 s.
pub(super) const STEP_S: f64 = 0.0067;

pub(super) fn reference() -> Dryden<f64> {
    Dryden::low_altitude(HEIGHT_FT * FOOT_M, W20_FT_S * FOOT_M)
}

pub(super) fn noise(generator: &mut ChaCha8Rng) -> DrydenNoise<f64> {
    let mut normal = || StandardNormal.sample(generator);
    DrydenNoise {
        along: normal(),
        across: [normal(), normal()],
        down: [normal(), normal()],
    }
}

/// Gusts in ft/s along, across and down, at steps of [`STEP_S`].
fn gusts(seed: u64, steps: usize) -> Vec<Vector3<f64>> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let dryden = reference();
    let mut state = DrydenState::stationary(&noise(&mut generator));
    (0..steps)
        .map(|_| {
            let noise = noise(&mut generator);
            state = dryden.step(&state, AIRSPEED_FT_S * FOOT_M, STEP_S, &noise);
            dryden.gust(&state) / FOOT_M
        })
        .collect()
}

/// Relative standard error of a standard deviation from T seconds, `√(∫ρ² dt / 2T)`: with the correlation e^−aτ along, ∫ρ² = 1/a;
/// with e^−aτ (1 − aτ/2) across and down, 5/(8a); a = V/L.
fn standard_error(axis: usize, duration_s: f64) -> f64 {
    let time_s = reference().length[axis] / FOOT_M / AIRSPEED_FT_S;
    let integral = if axis == 0 { time_s } else { 0.625 * time_s };
    (integral / (2.0 * duration_s)).sqrt()
}

/// Intensities of the formula, printed to four digits, and of an independent simulator's run of 3000 s (JSBSim 1.3.3).
#[test]
fn data_intensities_at_20_ft() {
    let intensity = reference().intensity / FOOT_M;
    let (formula, flown) = ([4.823, 4.823, 2.5], [4.794, 4.712, 2.515]);
    for axis in 0..3 {
        assert_relative_eq!(intensity[axis], formula[axis], max_relative = 2e-4);
        // Its run of 3000 s knows σ to 2.8 %, 2.2 % and 0.8 %; twice that on each axis.
        assert_relative_eq!(
            intensity[axis],
            flown[axis],
            max_relative = 2.0 * standard_error(axis, 3000.0)
        );
    }
    assert_relative_eq!(reference().length.z / FOOT_M, 20.0, max_relative = 1e-12);
}

/// Standard deviations of a flight of 20 000 s lie within three standard errors of the formula.
#[test]
fn exact_standard_deviations_over_a_long_flight() {
    let gusts = gusts(1, 3_000_000);
    let duration = STEP_S * 3e6;
    for axis in 0..3 {
        let square: f64 = gusts.iter().map(|g| g[axis] * g[axis]).sum();
        let measured = (square / gusts.len() as f64).sqrt();
        let expected = reference().intensity[axis] / FOOT_M;
        assert_relative_eq!(
            measured,
            expected,
            max_relative = 3.0 * standard_error(axis, duration)
        );
    }
}

/// The one-sided spectra of MIL-F-8785C in frequency, (ft/s)²/(rad/s), written out apart from the filters.
pub(super) fn spectrum(axis: usize, omega: f64) -> f64 {
    let base = 0.177 + 0.000_823 * HEIGHT_FT;
    let (sigma, length) = match axis {
        2 => (0.1 * W20_FT_S, HEIGHT_FT),
        _ => (0.1 * W20_FT_S / base.powf(0.4), HEIGHT_FT / base.powf(1.2)),
    };
    let square = (length * omega / AIRSPEED_FT_S).powi(2);
    let shape = match axis {
        0 => 2.0 / (1.0 + square),
        _ => (1.0 + 3.0 * square) / (1.0 + square).powi(2),
    };
    sigma * sigma * length / (PI * AIRSPEED_FT_S) * shape
}

/// Power of windowed (Hann) segments at one frequency, averaged: Welch's method, overlap a half.
pub(super) fn welch(samples: &[f64], omega: f64, segment: usize) -> f64 {
    let hann: Vec<f64> = (0..segment)
        .map(|k| (PI * k as f64 / segment as f64).sin().powi(2))
        .collect();
    let energy: f64 = hann.iter().map(|w| w * w).sum();
    let segments = samples.windows(segment).step_by(segment / 2);
    let count = segments.len() as f64;
    let power: f64 = segments
        .map(|part| {
            let (mut re, mut im) = (0.0, 0.0);
            for (k, (x, w)) in part.iter().zip(&hann).enumerate() {
                let (s, c) = (omega * STEP_S * k as f64).sin_cos();
                re += x * w * c;
                im += x * w * s;
            }
            re * re + im * im
        })
        .sum();
    // Two-sided density in ω is ∣X∣² h / (2π Σ w²); one-sided twice that.
    power / count * STEP_S / (PI * energy)
}

/// Spectra of a flight of 6700 s at five frequencies from a fifth of the corner to ten times the corner.
#[test]
fn exact_spectra_over_a_long_flight() {
    let gusts = gusts(2, 1_000_000);
    let segment = 8192;
    for axis in 0..3 {
        let samples: Vec<f64> = gusts.iter().map(|g| g[axis]).collect();
        for omega in [0.5, 1.5, 4.0, 10.0, 20.0] {
            let ratio = welch(&samples, omega, segment) / spectrum(axis, omega);
            // 243 half-overlapping Hann segments hold about 0.95/1.06 as many independent ones: a standard error of 6.8 %.
            // Four of them for fifteen numbers.
            assert!((ratio - 1.0).abs() < 0.27, "axis {axis}, {omega} rad/s: {ratio}");
        }
    }
}

/// Transition and noise of one step as matrices keep the stationary covariance, at any step: `Φ P Φᵀ + Q = P`.
#[test]
fn exact_covariance_at_any_step() {
    let p = nalgebra::Matrix2::new(1.0, 0.5, 0.5, 0.5);
    for tau in [1e-6, 1e-3, 0.1, 1.0, 3.0, 50.0] {
        let column = |x, n| nalgebra::Vector2::from(second_order(x, tau, n));
        let none = [0.0, 0.0];
        let phi = nalgebra::Matrix2::from_columns(&[column([1.0, 0.0], none), column([0.0, 1.0], none)]);
        let l = nalgebra::Matrix2::from_columns(&[column(none, [1.0, 0.0]), column(none, [0.0, 1.0])]);
        assert_relative_eq!(phi * p * phi.transpose() + l * l.transpose(), p, epsilon = 1e-14);
        // The transition itself: the Taylor series of exp([−1 0; 1 −1] τ).
        let a = nalgebra::Matrix2::new(-1.0, 0.0, 1.0, -1.0) * tau;
        assert_relative_eq!(phi, a.exp(), epsilon = 1e-13);
        let x = first_order(1.0, tau, 0.0);
        let n = first_order(0.0, tau, 1.0);
        assert_relative_eq!(x * x + n * n, 1.0, epsilon = 1e-14);
    }
}

/// Still air relative to a still vehicle: the frozen field is not flown through and the gust stays as it is.
#[test]
fn exact_no_airspeed_no_change() {
    let mut generator = ChaCha8Rng::seed_from_u64(3);
    let state = DrydenState::stationary(&noise(&mut generator));
    let next = reference().step(&state, 0.0, 0.01, &noise(&mut generator));
    // The floor of q_11 under the root leaves 1.5e-154.
    assert_relative_eq!(next.along, state.along);
    assert_relative_eq!(next.across[0], state.across[0], epsilon = 1e-150);
    assert!(next.down[1].is_finite());
}

/// Heights outside 10 to 1000 ft are held at the ends, below the ground too.
#[test]
fn exact_heights_are_held() {
    let at = |feet: f64| Dryden::low_altitude(feet * FOOT_M, 5.0);
    assert_eq!(at(-3.0), at(10.0));
    assert_eq!(at(5000.0), at(1000.0));
}

/// Four lanes are four flights.
#[test]
fn agree_lanes_with_scalars() {
    use simba::simd::WideF64x4;
    let mut generator = ChaCha8Rng::seed_from_u64(4);
    let heights = [2.0, 5.0, 20.0, 100.0];
    let draws: [[DrydenNoise<f64>; 2]; 4] =
        std::array::from_fn(|_| [noise(&mut generator), noise(&mut generator)]);
    let lanes = |pick: &dyn Fn(usize) -> f64| WideF64x4::from(std::array::from_fn::<f64, 4, _>(pick));
    let wide = |which: usize| DrydenNoise {
        along: lanes(&|k| draws[k][which].along),
        across: [0, 1].map(|i| lanes(&|k| draws[k][which].across[i])),
        down: [0, 1].map(|i| lanes(&|k| draws[k][which].down[i])),
    };
    let dryden = Dryden::low_altitude(lanes(&|k| heights[k]), lanes(&|_| 5.0));
    let state = DrydenState::stationary(&wide(0));
    let next = dryden.step(&state, lanes(&|_| 4.0), lanes(&|_| 0.02), &wide(1));
    let gust = dryden.gust(&next);
    for k in 0..4 {
        let alone = Dryden::low_altitude(heights[k], 5.0);
        let state = alone.step(&DrydenState::stationary(&draws[k][0]), 4.0, 0.02, &draws[k][1]);
        for axis in 0..3 {
            let lane = <[f64; 4]>::from(gust[axis].0)[k];
            // Exponentials of lanes and scalars may differ in the last bits.
            assert_relative_eq!(
                lane,
                alone.gust(&state)[axis],
                max_relative = 1e-13,
                epsilon = 1e-14
            );
        }
    }
}
