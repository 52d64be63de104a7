//! `identify centre-of-mass`.

use super::Done;
use crate::arguments::Common;
use crate::input;
use crate::output::Answer;
use crate::plot;
use quad_plot::style::Marker;
use quad_plot::{Figure, Look, Panel, series_style};
use sysid::centre_of_mass::{CentreOfMass, Placing, locate};

const MILLI: f64 = 1e3;

pub(super) fn identify(common: &Common, answer: &mut Answer) -> Done {
    let placings = input::placings(&common.data, answer)?;
    let fit = locate(&placings)?;
    answer.warn(&fit.warnings);
    let keys = [
        "airframe.centre_of_mass_m[0]",
        "airframe.centre_of_mass_m[1]",
        "airframe.centre_of_mass_m[2]",
    ];
    for (key, estimate) in keys.iter().zip(fit.position) {
        answer.push(key, "m", estimate);
    }
    answer.push("weight", "N", fit.weight);
    answer.figure = Some(figure(&placings, &fit));
    Ok(())
}

/// Two side views of the lines with the centre of mass, and by how much each line misses it.
fn figure(placings: &[Placing], fit: &CentreOfMass) -> Figure {
    let centre = fit.point();
    let view = |axis: usize, name: &str| {
        let mut panel = Panel::new(format!("{name}, mm"), "Up −*z*_{B}, mm");
        let mut named = Vec::new();
        for (placing, line) in placings.iter().zip(&fit.lines) {
            let first = !named.contains(&placing.orientation);
            named.push(placing.orientation);
            let label = match first {
                true => format!("lines of orientation {}", placing.orientation),
                false => String::new(),
            };
            let c = line.centre_of_pressure;
            let reach = line.direction * (1.3 * line.direction.dot(&(centre - c)));
            let ends = [c, c + reach].map(|p| (MILLI * p[axis], -MILLI * p.z));
            let look = Look {
                width: 0.9,
                dash: "",
                ..series_style(placing.orientation as usize)
            };
            panel = panel.line(label, look, ends);
        }
        let look = plot::FIT.marked(Marker::Diamond);
        panel.markers(
            "centre of mass",
            look,
            [(MILLI * centre[axis], -MILLI * centre.z)],
        )
    };
    let missed = (1..).zip(&fit.lines).map(|(number, line)| {
        let metres = line.offset_from(&centre).norm();
        (f64::from(number), MILLI * metres)
    });
    let misses = plot::residuals(
        Panel::new("Placing, in the file's order", "Line misses by, mm"),
        missed.collect(),
    );
    plot::figure(2)
        .panel(view(0, "Forward *x*_{B}"))
        .panel(view(1, "Right *y*_{B}"))
        .panel(misses)
}
