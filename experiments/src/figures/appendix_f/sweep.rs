//! What the figures of the appendix share: level 1's x-step under c1 with one setting of the attitude loop varied.

use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::ItemError;
use crate::plot::svg::Svg;
use crate::plot::{Figure, Panel, series_style};
use crate::scenarios::{self, Flight, Row, ScenarioFile};
use quad_ndi::AttitudeSettings;

/// Which setting is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Varied {
    /// `ω_n,a / ω_n,p`.
    FrequencyRatio,
    /// `ζ_a`.
    Damping,
}

impl Varied {
    /// The scenario file, with a quadrotor for each value.
    const fn file(self) -> &'static str {
        match self {
            Self::FrequencyRatio => "F.1",
            Self::Damping => "F.3",
        }
    }

    const fn of(self, attitude: &AttitudeSettings) -> f64 {
        match self {
            Self::FrequencyRatio => attitude.frequency_ratio,
            Self::Damping => attitude.damping,
        }
    }

    fn name(self, value: f64) -> String {
        match self {
            Self::FrequencyRatio => format!("*ω*_{{n,a}} = {value} *ω*_{{n,p}}"),
            Self::Damping => format!("*ζ*_{{a}} = {value}"),
        }
    }

    const fn column(self) -> &'static str {
        match self {
            Self::FrequencyRatio => "frequency_ratio",
            Self::Damping => "attitude_damping",
        }
    }
}

/// The flights of a scenario file, one for each value.
#[derive(Debug)]
pub(super) struct Sweep {
    varied: Varied,
    file: &'static ScenarioFile,
    /// The flights, in the order of the values.
    pub(super) runs: Vec<Run>,
}

/// One flight of a sweep.
#[derive(Debug)]
pub(super) struct Run {
    /// The value of what is varied.
    value: f64,
    /// What it did.
    flight: Flight,
}

impl Run {
    /// x over time, m.
    pub(super) fn position(&self) -> Vec<(f64, f64)> {
        self.flight.series(|row| row.position.x)
    }

    /// Largest longitudinal pseudo-input.
    pub(super) fn largest_input(&self) -> f64 {
        let inputs = self.flight.rows.iter().map(|row| row.pseudo_inputs[2].abs());
        inputs.fold(0.0, f64::max)
    }
}

/// Two quantities, one above the other.
pub(super) struct Shown {
    /// Their axis labels.
    pub(super) labels: [&'static str; 2],
    /// The quantities.
    pub(super) quantities: [fn(&Row) -> f64; 2],
    /// The set point of the upper one.
    pub(super) step: Option<f64>,
    /// End of the time axis, s.
    pub(super) until_s: f64,
}

/// Flies the file.
pub(super) fn fly(varied: Varied) -> Result<Sweep, ItemError> {
    let run = |flight: Flight| Run {
        value: varied.of(&flight.settings.attitude),
        flight,
    };
    Ok(Sweep {
        varied,
        file: scenarios::find(varied.file())?,
        runs: scenarios::fly(varied.file())?
            .flights
            .into_iter()
            .map(run)
            .collect(),
    })
}

impl Sweep {
    /// The drawing of two quantities of each run, with data and scenario.
    pub(super) fn drawing(&self, shown: &Shown) -> Drawing {
        Drawing::picture(self.picture(shown))
            .data(self.table())
            .scenario(self.file)
    }

    fn picture(&self, shown: &Shown) -> Svg {
        let mut panels = shown.labels.map(|label| Panel::new("Time *t*, s", label));
        for (i, run) in self.runs.iter().enumerate() {
            for (panel, quantity) in panels.iter_mut().zip(shown.quantities) {
                let points = run.flight.series(quantity);
                let name = self.varied.name(run.value);
                *panel = panel.clone().line(name, series_style(i), points);
            }
        }
        let [above, below] = panels;
        let above = shown
            .step
            .into_iter()
            .fold(above, |panel, y| panel.horizontal(y, ""));
        let [above, below] = [above, below].map(|panel| panel.x_range(0.0, shown.until_s));
        Figure::columns(1)
            .panel(above)
            .panel(below)
            .share_x()
            .panel_size(440.0, 185.0)
            .draw()
    }

    /// Columns: the value varied, time, position, pitch, longitudinal and collective input.
    fn table(&self) -> DataTable {
        let mut table = DataTable::new([self.varied.column(), "t_s", "x_m", "pitch_rad", "u_long", "u_col"]);
        for run in &self.runs {
            for row in run.flight.rows.iter().step_by(2) {
                table.push([
                    run.value.into(),
                    row.time_s.into(),
                    row.position.x.into(),
                    row.attitude.pitch.into(),
                    row.pseudo_inputs[2].into(),
                    row.pseudo_inputs[0].into(),
                ]);
            }
        }
        table
    }
}
