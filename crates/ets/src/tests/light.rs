use crate::{Atmosphere, Beam, Light, Station, VisibilityLaw};
use proptest::prelude::*;

const GREEN: f64 = 532e-9;

fn attenuation_per_km(visibility_km: f64, law: VisibilityLaw) -> f64 {
    let air = Atmosphere {
        visibility: 1e3 * visibility_km,
        law,
    };
    1e3 * air.attenuation(GREEN)
}

/// The laws of Kim, McArthur, Korevaar (2001) at 532 nm, worked out by hand, to the printed digits.
#[test]
fn exact_attenuation_by_visibility_at_532_nm() {
    use VisibilityLaw::{Kim, Kruse};
    for (visibility, law, expected, digit) in [
        (23.0, Kim, 0.177_606, 5e-7),
        (23.0, Kruse, 0.177_606, 5e-7),
        (5.0, Kim, 0.812_649, 5e-7),
        (5.0, Kruse, 0.808_881, 5e-7),
        (0.8, Kim, 4.939_059, 5e-7),
        (0.8, Kruse, 4.979_167, 5e-7),
        (0.3, Kim, 13.040, 5e-4),
        (0.3, Kruse, 13.211, 5e-4),
    ] {
        let found = attenuation_per_km(visibility, law);
        assert!(
            (found - expected).abs() < digit,
            "{visibility} km {law:?}: {found}"
        );
    }
    let clear = Atmosphere {
        visibility: 23e3,
        law: Kim,
    };
    assert!((clear.transmittance(GREEN, 100.0) - 0.982_396).abs() < 5e-7);
}

/// By definition, 2 % of the contrast is left at the distance of the visibility, at 550 nm, whatever the law.
#[test]
fn exact_two_per_cent_at_the_visibility() {
    for law in [VisibilityLaw::Kim, VisibilityLaw::Kruse] {
        for visibility in [100.0, 800.0, 3e3, 20e3, 80e3] {
            let left: f64 = Atmosphere { visibility, law }.transmittance(550e-9, visibility);
            // 3.912 is −ln 0.02 to four digits.
            assert!((left / 0.02 - 1.0).abs() < 1e-4);
        }
    }
}

/// The steps of the laws' exponents: attenuation *rises* with visibility there, by `(λ_0/λ)^Δq`.
#[test]
fn exact_steps_of_the_laws() {
    let rise = |at: f64, law| attenuation_per_km(at * (1.0 + 1e-9), law) / attenuation_per_km(at, law) - 1.0;
    let by_exponent = |step: f64| (550.0_f64 / 532.0).powf(step) - 1.0;
    let kruse_at_6 = 1.3 - 0.585 * 6.0_f64.cbrt();
    // 1e-9 of the visibility, and rounding.
    assert!((rise(50.0, VisibilityLaw::Kim) - by_exponent(0.3)).abs() < 2e-9);
    assert!((rise(6.0, VisibilityLaw::Kruse) - by_exponent(kruse_at_6)).abs() < 2e-9);
    assert!(rise(6.0, VisibilityLaw::Kim).abs() < 2e-9);
}

proptest! {
    /// Beer-Lambert: `τ(R_1 + R_2) = τ(R_1) τ(R_2)`.
    #[test]
    fn exact_transmittance_of_two_legs(v in 100.0..50e3_f64, legs in prop::array::uniform2(0.0..5e3_f64)) {
        let air = Atmosphere { visibility: v, law: VisibilityLaw::Kim };
        let of = |range| air.transmittance(GREEN, range);
        // Exponents up to 400 lose two digits.
        prop_assert!((of(legs[0]) * of(legs[1]) / of(legs[0] + legs[1]) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn prop_kim_is_monotone_up_to_50_km(v in 50.0..49e3_f64, more in 1.0..1e3_f64, range in 1.0..1e3_f64) {
        let of = |visibility, range| Atmosphere { visibility, law: VisibilityLaw::Kim }.transmittance(GREEN, range);
        prop_assert!(of(v + more, range) > of(v, range) && of(v, range + 1.0) < of(v, range));
    }

    /// Energy: the flux through the whole plane is the power left at that distance. Polar, `∫ 2πρ I dρ` by Simpson's rule.
    #[test]
    fn exact_flux_through_a_plane(z in 0.0..50.0_f64) {
        let light = nominal_light();
        let w = light.radius_squared(z).sqrt();
        let (n, reach) = (2000, 6.0 * w);
        let flux: f64 = (0..=n).map(|i| {
            let rho = reach * f64::from(i) / f64::from(n);
            let weight = if i == 0 || i == n { 1.0 } else if i % 2 == 1 { 4.0 } else { 2.0 };
            weight * std::f64::consts::TAU * rho * light.irradiance(rho * rho, z)
        }).sum::<f64>() * reach / f64::from(n) / 3.0;
        // Simpson (h/w)⁴ = 8e-11 of the power; outside 6 w there is e^−72.
        prop_assert!((flux / light.power_at(z) - 1.0).abs() < 1e-9);
    }
}

fn nominal_light() -> Light<f64> {
    let station = Station::nominal();
    station.beam.through(&station.atmosphere)
}

/// Far from a perfect beam's waist the radius grows as `λz/(πw_0)`.
#[test]
fn exact_diffraction_limited_divergence() {
    let beam = Beam {
        divergence: GREEN / (std::f64::consts::PI * 1e-3),
        waist_radius: 1e-3,
        ..Station::nominal().beam
    };
    assert!((beam.quality() - 1.0).abs() < 1e-14);
    let far = beam
        .through(&Station::nominal().atmosphere)
        .radius_squared(1e4)
        .sqrt();
    // Next to the waist's 1 mm in quadrature: (w_0/θz)²/2 = 2e-7.
    assert!((far / (1.693_408_6e-4 * 1e4) - 1.0).abs() < 5e-7, "{far}");
}
