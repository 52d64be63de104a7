//! Stated intervals contain the truth as often as they say, over 200 seeds.

use super::*;
use crate::laboratory::Sensor;
use quad_dynamics::vehicle::derive::rad_per_s;
use quad_rotor::Cubic;

#[test]
fn prop_coverage_of_coefficients() {
    let vehicle = qball();
    let truth = vehicle.propeller.unwrap();
    let stand = ThrustStand::of(&vehicle).unwrap();
    let duties = sweep(evenly(0.06, 0.09, 25), &[11.1], 1);
    assert_covered(|seed| {
        let samples = stand.sweep(&duties, &mut generator(seed)).unwrap();
        let samples: Vec<PropellerSample> = samples.iter().map(Into::into).collect();
        let fit = |quantity| coefficient(&samples, &scale(), quantity).unwrap().parameters[0];
        let dependence = speed_dependence(
            &samples,
            &scale(),
            Quantity::Thrust,
            SpeedLaw::Logarithmic,
            rad_per_s(4500.0),
        )
        .unwrap();
        vec![
            Judged {
                name: "C_T",
                estimate: fit(Quantity::Thrust),
                truth: truth.thrust_coefficient,
            },
            Judged {
                name: "C_Q",
                estimate: fit(Quantity::Torque),
                truth: truth.torque_coefficient,
            },
            Judged {
                name: "C_T at the reference",
                estimate: dependence.at_reference,
                truth: truth.thrust_coefficient,
            },
            Judged {
                name: "slope of C_T",
                estimate: dependence.slope,
                truth: 0.0,
            },
        ]
    });
}

/// Readings of a rotor with these static laws, duty to thrust and torque, on the usual instruments.
fn readings(
    seed: u64,
    duties: &[f64],
    voltages: &[f64],
    thrust: impl Fn(f64, f64) -> f64,
    torque: impl Fn(f64, f64) -> f64,
) -> Vec<StaticSample> {
    let (mut random, stand) = (generator(seed), Instruments::default());
    let mut samples = Vec::new();
    for &voltage in voltages {
        for &duty in duties {
            samples.push(StaticSample {
                duty,
                battery_voltage_v: voltage,
                thrust_n: stand.thrust.read(thrust(duty, voltage), &mut random),
                torque_n_m: stand.torque.read(torque(duty, voltage), &mut random),
                speed_rad_s: 0.0,
            });
        }
    }
    samples
}

#[test]
fn prop_coverage_of_the_polynomials() {
    let rotor = qball().polynomial_rotor.unwrap();
    let (thrust, torque) = (rotor.thrust, rotor.torque);
    let (duties, voltages) = (evenly(0.055, 0.095, 15), [9.9, 11.1, 12.6]);
    let of = |cubic: Cubic<f64>| move |duty: f64, volt: f64| cubic.value((duty - 0.05) * volt);
    assert_covered(|seed| {
        let samples = readings(seed, &duties, &voltages, of(thrust), of(torque));
        let judged = |quantity, names: [&'static str; 3], truth: Cubic<f64>| {
            let fit = polynomial(&samples, 0.05, quantity).unwrap();
            (0..3).map(move |i| Judged {
                name: names[i],
                estimate: fit.parameters[i],
                truth: truth.coefficients()[i],
            })
        };
        judged(Quantity::Thrust, ["k_T1", "k_T2", "k_T3"], rotor.thrust)
            .chain(judged(Quantity::Torque, ["k_Q1", "k_Q2", "k_Q3"], rotor.torque))
            .collect()
    });
}

#[test]
fn prop_coverage_of_the_linear_gains() {
    let (k_t, k_q, u_0) = (265.8, 4.36, 0.0599);
    let duties = evenly(0.062, 0.086, 25);
    assert_covered(|seed| {
        let line = |k: f64| move |duty: f64, _: f64| k * (duty - u_0);
        let samples = readings(seed, &duties, &[11.1], line(k_t), line(k_q));
        let gains = linear_gains(&samples).unwrap();
        vec![
            Judged {
                name: "K_T",
                estimate: gains.thrust_gain,
                truth: k_t,
            },
            Judged {
                name: "K_Q",
                estimate: gains.torque_gain,
                truth: k_q,
            },
            Judged {
                name: "u_0",
                estimate: gains.zero_thrust,
                truth: u_0,
            },
            Judged {
                name: "thrust of the line at a duty",
                estimate: gains.thrust_at(0.0735),
                truth: k_t * (0.0735 - u_0),
            },
        ]
    });
}

/// The mechanistic rotor is neither a line nor a cubic: what the models miss is not noise, and is announced.
#[test]
fn prop_model_error_of_the_mechanistic_rotor_is_announced() {
    let stand = ThrustStand::of(&qball()).unwrap();
    let settings = sweep(evenly(0.055, 0.095, 21), &[9.9, 11.1, 12.6], 20);
    let grid = sweep(settings.duties.clone(), &[9.9, 11.1, 12.6], 1);
    let truth = perfect().sweep(&grid, &mut generator(0)).unwrap();
    let best = polynomial(&truth, 0.05, Quantity::Thrust).unwrap();
    let samples = stand.sweep(&settings, &mut generator(3)).unwrap();
    let fit = polynomial(&samples, 0.05, Quantity::Thrust).unwrap();
    let announced = |warnings: &[Warning]| {
        warnings
            .iter()
            .any(|w| matches!(w, Warning::CorrelatedResiduals { .. }))
    };
    assert!(announced(&fit.warnings), "{:?}", fit.warnings);
    // The interval is about the best cubic over the same points, and the model error about it is what no noise explains.
    for (estimate, best) in fit.parameters.iter().zip(best.values()) {
        assert!(estimate.interval().contains(best), "{estimate:?} {best}");
    }
    let noise = Sensor::noisy(0.03).noise / 20f64.sqrt();
    assert!(best.goodness.standard_deviation > 2.0 * noise);

    let operating = sweep(evenly(0.0617, 0.087, 26), &[11.1], 20);
    let samples = stand.sweep(&operating, &mut generator(3)).unwrap();
    assert!(announced(&linear_gains(&samples).unwrap().thrust.warnings));
}
