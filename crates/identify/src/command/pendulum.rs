//! `identify pendulum`.

use super::Done;
use crate::arguments::{Axis, Common, Hung};
use crate::input;
use crate::output::Answer;
use crate::plot;
use quad_plot::Panel;
use sysid::pendulum::{Damping, Suspension, fit_history};

pub(super) fn identify(common: &Common, hung: &Hung, answer: &mut Answer) -> Done {
    let samples = input::swing(&common.data, answer)?;
    let suspension = Suspension {
        mass_kg: hung.mass_kg,
        half_spacing_m: hung.half_spacing_m,
        length_m: hung.length_m,
        gravity_m_s2: hung.gravity_m_s2,
    };
    let fit = fit_history(&suspension, &samples, Damping::ViscousAndQuadratic)?;
    answer.warn(&fit.warnings);
    let key = match hung.axis {
        Axis::Roll => "airframe.inertia_xx_kg_m2",
        Axis::Pitch => "airframe.inertia_yy_kg_m2",
        Axis::Yaw => "airframe.inertia_zz_kg_m2",
    };
    answer.push(key, "kg m²", fit.inertia);
    let over_time = |values: Vec<f64>| samples.iter().map(|s| s.time_s).zip(values).collect();
    let angles = samples.iter().map(|s| s.angle_rad).collect();
    let swing = plot::measured(Panel::new("Time *t*, s", "Angle *θ*, rad"), over_time(angles)).line(
        "fit",
        plot::FIT.dashed("4 2"),
        over_time(fit.fitted_rad),
    );
    let residuals = plot::residuals(
        Panel::new("Time *t*, s", "Residual, rad"),
        over_time(fit.residuals_rad),
    );
    answer.figure = Some(plot::figure(1).share_x().panel(swing).panel(residuals));
    Ok(())
}
