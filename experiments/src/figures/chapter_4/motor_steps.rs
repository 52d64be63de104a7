//! Published step responses of a motor (data/README.md, `ntnu_motor`), where the reader has a copy.

use crate::item::{Context, ItemError};
use crate::plot::{Panel, reference_style, series_style};
use std::path::PathBuf;
use sysid::Estimate;
use sysid::rotor_dynamics::{Coefficients, Record, ResponseSample, Start, Structure, identify};

/// One step with its first-order fit.
struct FittedStep {
    times_s: Vec<f64>,
    simulated: Vec<f64>,
    time_constant_s: Estimate,
    rises: bool,
}

/// The record with a first-order fit to every step.
pub(super) struct MotorSteps {
    samples: Vec<ResponseSample>,
    steps: Vec<FittedStep>,
}

/// Samples before a step that its record begins with: a tenth of a second at rest.
const LEAD: usize = 5;

/// Reads and fits the record; `None` where it is not there.
///
/// # Errors
/// A file that cannot be read or fitted.
pub(super) fn read(context: &Context) -> Result<Option<MotorSteps>, ItemError> {
    let folder = std::env::var_os("QUAD_DATA").map_or_else(|| context.data("external"), PathBuf::from);
    let path = folder.join("ntnu_motor/sample_time_const_data.csv");
    if !path.is_file() {
        return Ok(None);
    }
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path)?;
    let samples = reader.deserialize().collect::<Result<Vec<ResponseSample>, _>>()?;
    let steps: Vec<usize> = (1..samples.len())
        .filter(|&k| samples[k].input != samples[k - 1].input)
        .collect();
    let ends = steps.iter().copied().skip(1).chain([samples.len()]);
    let fitted = steps.iter().zip(ends).map(|(&step, end)| {
        let lead = LEAD.min(step);
        let record = Record::new(&samples[step - lead..end])?;
        let fit = identify(&record, Structure::FirstOrder, Start::Equilibrium)?;
        let Coefficients::FirstOrder { bandwidth } = fit.coefficients else {
            return Err(ItemError::new("a first-order fit has one coefficient"));
        };
        Ok(FittedStep {
            times_s: record.times()[lead..].to_vec(),
            simulated: fit.simulated[lead..].to_vec(),
            time_constant_s: bandwidth.mapped(1.0 / bandwidth.value, bandwidth.value.powi(-2)),
            rises: samples[step].input > samples[step - 1].input,
        })
    });
    let steps = fitted.collect::<Result<Vec<_>, ItemError>>()?;
    Ok(Some(MotorSteps { samples, steps }))
}

impl MotorSteps {
    /// The record with its fits; the unit of the speed is not stated by the source.
    pub(super) fn panel(&self) -> Panel {
        let measured = self.samples.iter().map(|s| (s.time_s, s.output / 1e3));
        let panel = Panel::new("Time *t*, s", "Motor speed, 1000 units")
            .x_range(0.0, 4.0)
            .caption("real motor, first order");
        let panel = panel.markers("measured", reference_style(), measured);
        self.steps.iter().fold(panel, |panel, step| {
            let points = step
                .times_s
                .iter()
                .copied()
                .zip(step.simulated.iter().map(|y| y / 1e3));
            panel.line("model", series_style(1), points)
        })
    }

    /// The time constants in words.
    pub(super) fn words(&self) -> String {
        let of = |rises: bool| {
            let steps = self.steps.iter().filter(|step| step.rises == rises);
            let each = steps.map(|step| {
                let (t, w) = (step.time_constant_s.value, step.time_constant_s.half_width());
                format!("{t:.3} ± {w:.3}")
            });
            each.collect::<Vec<_>>().join(", ")
        };
        format!(
            "Real motor (NTNU, step responses at 50 Hz): time constants of first-order fits {} s up and {} s down, 95 % intervals; \
             published: 0.019 to 0.022 s up, 0.026 to 0.050 s down.",
            of(true),
            of(false)
        )
    }
}
