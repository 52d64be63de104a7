//! `identify rotor-response`.

use super::Done;
use crate::arguments::Common;
use crate::input;
use crate::output::Answer;
use crate::plot;
use quad_plot::{Figure, Panel};
use sysid::rotor_dynamics::{
    Coefficients, Poles, Record, ResponseFit, Start, Structure, identify as respond,
};

const MILLI: f64 = 1e3;

pub(super) fn identify(common: &Common, answer: &mut Answer) -> Done {
    let samples = input::response(&common.data, answer)?;
    let thrust_record = Record::of(&samples, |s| s.duty, |s| s.thrust_n)?;
    let torque_record = Record::of(&samples, |s| s.duty, |s| s.torque_n_m)?;
    let thrust = respond(&thrust_record, Structure::SecondOrder, Start::Free)?;
    let torque = respond(&torque_record, Structure::SecondOrderWithZero, Start::Free)?;
    answer.warn(&thrust.warnings);
    answer.warn(&torque.warnings);
    bandwidth(&thrust, answer);
    if let Coefficients::SecondOrder { c1, c2 } = thrust.coefficients {
        answer.push("rotor_dynamics.thrust_c1_per_s", "1/s", c1);
        answer.push("rotor_dynamics.thrust_c2_per_s2", "1/s²", c2);
    }
    if let Coefficients::SecondOrderWithZero { c1, c2, c3, c4 } = torque.coefficients {
        answer.push("rotor_dynamics.torque_c1_per_s", "1/s", c1);
        answer.push("rotor_dynamics.torque_c2_per_s2", "1/s²", c2);
        answer.push("rotor_dynamics.torque_c3_per_s", "1/s", c3);
        answer.push("rotor_dynamics.torque_c4_per_s2", "1/s²", c4);
    }
    answer.figure = Some(figure((&thrust_record, &thrust), (&torque_record, &torque)));
    Ok(())
}

/// The bandwidth of level 3 as a vehicle file defines it: the slowest pole of the thrust's transfer function.
///
/// Not the bandwidth of a first-order fit, which takes up the fast pole too and comes out slower (11.3 instead of 14.5 rad/s on
/// the nominal rotor): levels 3 and 4 are to share the slow pole.
fn bandwidth(thrust: &ResponseFit, answer: &mut Answer) {
    match thrust.poles {
        Poles::One { rate } | Poles::Real { slow: rate, .. } => {
            let made = "slowest pole of the thrust's transfer function";
            answer.push_made("linear_rotor.bandwidth_rad_s", "rad/s", rate, made);
        }
        Poles::Complex { .. } => answer.warnings.push(
            "the thrust has a complex pair of poles, so it has no slowest pole to use as the bandwidth of level 3"
                .to_owned(),
        ),
    }
}

fn figure(
    (thrust_record, thrust): (&Record, &ResponseFit),
    (torque_record, torque): (&Record, &ResponseFit),
) -> Figure {
    let over_time = |record: &Record, values: &[f64], scale: f64| -> Vec<(f64, f64)> {
        let values = values.iter().map(|v| scale * v);
        record.times().iter().copied().zip(values).collect()
    };
    let fitted = |label: &str, record: &Record, fit: &ResponseFit, scale: f64| {
        plot::measured(
            Panel::new("Time *t*, s", label),
            over_time(record, record.outputs(), scale),
        )
        .line("fit", plot::FIT, over_time(record, &fit.simulated, scale))
    };
    let left = |label: &str, record: &Record, fit: &ResponseFit, scale: f64| {
        plot::residuals(
            Panel::new("Time *t*, s", label),
            over_time(record, &fit.residuals, scale),
        )
    };
    let duty = Panel::new("Time *t*, s", "Duty *ū*").line(
        "",
        plot::DATA,
        held(thrust_record.times(), thrust_record.inputs()),
    );
    plot::figure(1)
        .share_x()
        .panel(duty)
        .panel(fitted("Thrust *T*, N", thrust_record, thrust, 1.0))
        .panel(left("Residual of *T*, N", thrust_record, thrust, 1.0))
        .panel(fitted("Torque *Q*, mN m", torque_record, torque, MILLI))
        .panel(left("Residual of *Q*, mN m", torque_record, torque, MILLI))
}

/// A series that is held from sample to sample, as a line with corners.
fn held(times: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let steps = times.windows(2).zip(values);
    steps
        .flat_map(|(pair, value)| [(pair[0], *value), (pair[1], *value)])
        .collect()
}
