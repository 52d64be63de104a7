use super::super::tests::{AIRSPEED_FT_S, HEIGHT_FT, STEP_S, W20_FT_S, noise, reference, spectrum, welch};
use super::super::{FOOT_M, second_order};
use super::*;
use approx::assert_relative_eq;
use nalgebra::{Matrix3, RowVector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// Span, ft: a tenth of L_w.
const SPAN_FT: f64 = 2.0;

fn rotation() -> DrydenRotation<f64> {
    reference().rotation(SPAN_FT * FOOT_M)
}

fn own_noise(generator: &mut ChaCha8Rng) -> DrydenRotationNoise<f64> {
    let mut normal = || StandardNormal.sample(generator);
    DrydenRotationNoise {
        roll: normal(),
        pitch: normal(),
        yaw: normal(),
    }
}

/// Gusts and rotation after each of some steps.
struct Flown {
    gusts: Vec<Vector3<f64>>,
    rates: Vec<Vector3<f64>>,
}

fn flown(seed: u64, steps: usize) -> Flown {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let (dryden, rotation) = (reference(), rotation());
    let first = noise(&mut generator);
    let mut state = rotation.stationary(&first, &own_noise(&mut generator));
    let mut gusts = DrydenState::stationary(&first);
    let airspeed = AIRSPEED_FT_S * FOOT_M;
    let mut flown = Flown {
        gusts: Vec::with_capacity(steps),
        rates: Vec::with_capacity(steps),
    };
    for _ in 0..steps {
        let noise = noise(&mut generator);
        let step = GustStep {
            before: &gusts,
            noise: &noise,
            way: airspeed * STEP_S,
        };
        state = rotation.step(&state, &step, &own_noise(&mut generator));
        gusts = dryden.step(&gusts, airspeed, STEP_S, &noise);
        flown.gusts.push(dryden.gust(&gusts));
        flown.rates.push(rotation.rates(&state, &gusts));
    }
    flown
}

/// The one-sided spectra of MIL-F-8785C in frequency, (rad/s)²/(rad/s), written out apart from the filters in feet.
fn rotation_spectrum(axis: usize, omega: f64) -> f64 {
    let space = omega / AIRSPEED_FT_S;
    let filtered = |n: f64| 1.0 / (1.0 + (n * SPAN_FT * space / PI).powi(2));
    match axis {
        0 => {
            let sigma = 0.1 * W20_FT_S;
            let slender = (PI * HEIGHT_FT / (4.0 * SPAN_FT)).cbrt();
            sigma * sigma / (AIRSPEED_FT_S * HEIGHT_FT) * 0.8 * slender * filtered(4.0)
        }
        1 => space * space * filtered(4.0) * spectrum(2, omega),
        _ => space * space * filtered(3.0) * spectrum(1, omega),
    }
}

/// `∫_0^∞ f(ω) dω` by the midpoint rule in `ω = ω_0 tan u`, whose integrands here are smooth up to both ends.
fn over_all_frequencies(f: impl Fn(f64) -> f64) -> f64 {
    let (corner, n) = (5.0, 20_000);
    let du = PI / 2.0 / f64::from(n);
    let at = |k: i32| (f64::from(k) + 0.5) * du;
    (0..n)
        .map(|k| f(corner * at(k).tan()) * corner / at(k).cos().powi(2) * du)
        .sum()
}

/// Standard deviations of the module's head, rad/s.
fn closed_form(axis: usize) -> f64 {
    let (dryden, rotation) = (reference(), rotation());
    let slope = |sigma: f64, scale: f64, length: f64| {
        let a = length / scale;
        sigma * (a * (3.0 + 2.0 * a) / 2.0).sqrt() / ((1.0 + a) * length)
    };
    match axis {
        0 => rotation.roll_intensity,
        1 => slope(dryden.intensity.z, dryden.length.z, rotation.length.y),
        _ => slope(dryden.intensity.y, dryden.length.y, rotation.length.z),
    }
}

/// The closed forms are the integrals of the specification's spectra.
#[test]
fn exact_deviations_are_the_spectra_s_integrals() {
    for axis in 0..3 {
        let variance = over_all_frequencies(|omega| rotation_spectrum(axis, omega));
        // Second order in du = 8e-5 on integrands that vary over some tenths of a radian.
        assert_relative_eq!(closed_form(axis), variance.sqrt(), max_relative = 1e-6);
    }
}

/// Standard deviations of a flight of 6700 s lie within three standard errors of the closed forms.
#[test]
fn exact_standard_deviations_over_a_long_flight() {
    let flown = flown(11, 1_000_000);
    let duration_s = 1e6 * STEP_S;
    for axis in 0..3 {
        let square: f64 = flown.rates.iter().map(|w| w[axis] * w[axis]).sum();
        let measured = (square / 1e6).sqrt();
        // Relative standard error √(∫ρ² dt / 2T), and ∫ρ² dt = π ∫Φ² dω / σ⁴ by Parseval.
        let squares = over_all_frequencies(|omega| rotation_spectrum(axis, omega).powi(2));
        let error = (PI * squares / closed_form(axis).powi(4) / (2.0 * duration_s)).sqrt();
        assert!(error < 0.02, "{error}");
        assert_relative_eq!(measured, closed_form(axis), max_relative = 3.0 * error);
    }
}

/// Spectra of a flight of 6700 s at five frequencies from a third of the gusts' corner to four times the span's.
#[test]
fn exact_spectra_over_a_long_flight() {
    let flown = flown(12, 1_000_000);
    for axis in 0..3 {
        let samples: Vec<f64> = flown.rates.iter().map(|w| w[axis]).collect();
        for omega in [0.6, 1.5, 4.0, 12.0, 45.0] {
            let ratio = welch(&samples, omega, 8192) / rotation_spectrum(axis, omega);
            // As for the gusts: four standard errors of 6.8 % for fifteen numbers.
            assert!((ratio - 1.0).abs() < 0.27, "axis {axis}, {omega} rad/s: {ratio}");
        }
    }
}

/// A downdraught that has grown along the way lies upwind: the air's tail goes down, `q > 0` on average at `w > 0`, and
/// with v to the right growing the air ahead (down the wind) still goes left of it: `r < 0`. p has nothing to do with either.
/// `E[q w] = σ_w² (1 − (2 + a)/(2 (1 + a)²))/ℓ_q`, from the covariance of w and w̄.
#[test]
fn exact_turns_go_with_the_gusts_that_make_them() {
    let flown = flown(13, 1_000_000);
    let (dryden, rotation) = (reference(), rotation());
    let mean = |turn: usize, gust: usize| -> f64 {
        let pairs = flown.rates.iter().zip(&flown.gusts);
        pairs.map(|(w, g)| w[turn] * g[gust]).sum::<f64>() / 1e6
    };
    let expected = |sigma: f64, scale: f64, length: f64| {
        let a = length / scale;
        sigma * sigma * (1.0 - (2.0 + a) / (2.0 * (1.0 + a).powi(2))) / length
    };
    let q = expected(dryden.intensity.z, dryden.length.z, rotation.length.y);
    let r = expected(dryden.intensity.y, dryden.length.y, rotation.length.z);
    // A product of two has the standard error √(τ/T) σ σ at most, τ = L/V the longer correlation: 1 %, and r's v 2.6 %,
    // against E[q w] of a third of σ_q σ_w. Three of them.
    for (turn, gust, length, expected) in [
        (1, 2, dryden.length.z, q),
        (2, 1, dryden.length.y, -r),
        (0, 2, dryden.length.z, 0.0),
        (1, 1, dryden.length.y, 0.0),
    ] {
        let duration = 1e6 * STEP_S * AIRSPEED_FT_S * FOOT_M;
        let scatter = closed_form(turn) * dryden.intensity[gust] * (length / duration).sqrt();
        assert!(
            (mean(turn, gust) - expected).abs() < 3.0 * scatter,
            "{turn} {gust}"
        );
        assert!(expected == 0.0 || expected.abs() > 5.0 * scatter);
    }
}

/// Transition and noise of one step keep the stationary covariance at any step, `Φ P Φᵀ + Q = P`; the transition is the
/// exponential of the equations, and P solves their Lyapunov equation.
#[test]
fn exact_covariance_at_any_step() {
    let (alpha, beta) = (1.5_f64.sqrt(), (1.0 - 3.0_f64.sqrt()) / 2.0_f64.sqrt());
    for c in [2.0, 5.0, 40.0] {
        #[rustfmt::skip]
        let a = Matrix3::new(
            -1.0, 0.0, 0.0,
            1.0, -1.0, 0.0,
            c * alpha, c * beta, -c,
        );
        let rows = |tau: f64| {
            let lag = Lag::new(tau, 1.0, 1.0 / c);
            let column = |x, n| second_order(x, tau, n);
            let none = [0.0, 0.0];
            let linear = |x, y| (column(x, none), column(y, none));
            let ([f_11, f_21], [f_12, f_22]) = linear([1.0, 0.0], [0.0, 1.0]);
            let ([l_11, l_21], [_, l_22]) = (column(none, [1.0, 0.0]), column(none, [0.0, 1.0]));
            let phi = Matrix3::from_rows(&[
                RowVector3::new(f_11, f_12, 0.0),
                RowVector3::new(f_21, f_22, 0.0),
                RowVector3::from(lag.transition),
            ]);
            let l = Matrix3::from_rows(&[
                RowVector3::new(l_11, 0.0, 0.0),
                RowVector3::new(l_21, l_22, 0.0),
                RowVector3::from(lag.noise),
            ]);
            (phi, l)
        };
        // After a long way only noise is left, and its covariance is the stationary one.
        let (_, l) = rows(1000.0);
        let p = l * l.transpose();
        let drive = Matrix3::from_diagonal(&Vector3::new(2.0, 0.0, 0.0));
        // The zero of 1 to 40 times numbers of one; a division by the variance of rounding leaves 1e-15 of them.
        assert_relative_eq!(
            a * p + p * a.transpose() + drive,
            Matrix3::zeros(),
            epsilon = 1e-12
        );
        for tau in [1e-9, 1e-6, 1e-4, 1e-2, 0.3, 3.0, 50.0] {
            let (phi, l) = rows(tau);
            assert_relative_eq!(phi * p * phi.transpose() + l * l.transpose(), p, epsilon = 1e-13);
            assert_relative_eq!(phi, (a * tau).exp(), epsilon = 1e-12);
        }
    }
}

/// No way, no change; a span of nearly nothing and one far too large give numbers, the latter as π L_w/8.
#[test]
fn exact_limits() {
    let mut generator = ChaCha8Rng::seed_from_u64(14);
    let first = noise(&mut generator);
    let gusts = DrydenState::stationary(&first);
    let state = rotation().stationary(&first, &own_noise(&mut generator));
    for way in [0.0, 1e-300, 1e-17, 1e-16] {
        let step = GustStep {
            before: &gusts,
            noise: &noise(&mut generator),
            way,
        };
        let next = rotation().step(&state, &step, &own_noise(&mut generator));
        // Rounding of the variances to 1e-16 leaves its root.
        assert_relative_eq!(next.roll, state.roll, epsilon = 1e-6);
        assert_relative_eq!(next.lagged_down, state.lagged_down, epsilon = 1e-6);
        assert_relative_eq!(next.lagged_across, state.lagged_across, epsilon = 1e-6);
    }
    let dryden = reference();
    assert_eq!(dryden.rotation(1e6), dryden.rotation(dryden.length.z * PI / 8.0));
    let tiny = dryden.rotation(1e-6);
    let state = tiny.stationary(&first, &own_noise(&mut generator));
    assert!(tiny.rates(&state, &gusts).iter().all(|w| w.is_finite()));
}

/// Four lanes are four flights.
#[test]
fn agree_lanes_with_scalars() {
    use simba::simd::WideF64x4;
    let mut generator = ChaCha8Rng::seed_from_u64(15);
    let (first, own) = (noise(&mut generator), own_noise(&mut generator));
    let (spans, ways): ([f64; 4], [f64; 4]) = ([0.1, 0.6, 1.0, 3.0], [0.001, 0.1, 2.0, 40.0]);
    fn rates<R: Real>(
        span: R,
        way: R,
        first: &DrydenNoise<f64>,
        own: &DrydenRotationNoise<f64>,
    ) -> Vector3<R> {
        let lifted = |n: [f64; 2]| n.map(constant::<R>);
        let noise = DrydenNoise {
            along: constant::<R>(first.along),
            across: lifted(first.across),
            down: lifted(first.down),
        };
        let own = DrydenRotationNoise {
            roll: constant::<R>(own.roll),
            pitch: constant(own.pitch),
            yaw: constant(own.yaw),
        };
        let dryden = Dryden::low_altitude(constant::<R>(5.0), constant(8.0));
        let rotation = dryden.rotation(span);
        let gusts = DrydenState::stationary(&noise);
        let state = rotation.stationary(&noise, &own);
        let step = GustStep {
            before: &gusts,
            noise: &noise,
            way,
        };
        let state = rotation.step(&state, &step, &own);
        rotation.rates(&state, &dryden.step(&gusts, way, R::one(), &noise))
    }
    let lanes = rates(WideF64x4::from(spans), WideF64x4::from(ways), &first, &own);
    for k in 0..4 {
        let alone = rates(spans[k], ways[k], &first, &own);
        for axis in 0..3 {
            let lane = <[f64; 4]>::from(lanes[axis].0)[k];
            // Exponentials of lanes and scalars may differ in the last bits, which the root of a small variance makes more of.
            assert_relative_eq!(lane, alone[axis], max_relative = 1e-9, epsilon = 1e-9);
        }
    }
}
