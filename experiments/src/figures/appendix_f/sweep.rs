//! What the figures of the appendix share: level 1's x-step under c1 with one setting of the attitude loop varied.

use crate::data::DataTable;
use crate::flight::{Law, Scenario, series};
use crate::item::{Context, ItemError};
use crate::plot::svg::Svg;
use crate::plot::{Figure, Panel, series_style};
use quad_dynamics::Level;
use quad_ndi::{AttitudeSettings, FlightLog, LoopSettings, Settings};

/// Which setting is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Varied {
    /// `ω_n,a / ω_n,p`.
    FrequencyRatio,
    /// `ζ_a`.
    Damping,
}

impl Varied {
    const fn values(self) -> [f64; 4] {
        match self {
            Self::FrequencyRatio => [3.0, 5.0, 10.0, 20.0],
            Self::Damping => [0.4, 0.7, 1.0, 1.5],
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

/// The appendix' settings: ζ_p = 1, τ_s,p = 2 s, and one value of what is varied.
pub(super) fn scenario(varied: Varied, value: f64) -> Scenario {
    let attitude = match varied {
        Varied::FrequencyRatio => AttitudeSettings {
            frequency_ratio: value,
            ..AttitudeSettings::default()
        },
        Varied::Damping => AttitudeSettings {
            damping: value,
            ..AttitudeSettings::default()
        },
    };
    let position = LoopSettings {
        settling_time_s: 2.0,
        ..LoopSettings::default()
    };
    Scenario::position_step(
        Law::C1,
        Settings {
            position,
            attitude,
            ..Settings::default()
        },
        5.0,
    )
}

/// One flight of a sweep.
#[derive(Debug)]
pub(super) struct Run {
    /// The value of what is varied.
    pub(super) value: f64,
    /// What was recorded.
    pub(super) log: FlightLog,
}

impl Run {
    /// x over time, m.
    pub(super) fn position(&self) -> Vec<(f64, f64)> {
        series(&self.log, |r| r.flight.position.x)
    }

    /// Longitudinal pseudo-input over time.
    pub(super) fn input(&self) -> Vec<(f64, f64)> {
        series(&self.log, |r| r.pseudo_inputs[2])
    }

    /// Largest longitudinal pseudo-input.
    pub(super) fn largest_input(&self) -> f64 {
        self.input().iter().map(|(_, u)| u.abs()).fold(0.0, f64::max)
    }
}

/// Flies level 1 once for each value.
pub(super) fn fly(context: &Context, varied: Varied) -> Result<Vec<Run>, ItemError> {
    let run = |value| {
        Ok(Run {
            value,
            log: scenario(varied, value).fly(context, Level::One)?,
        })
    };
    varied.values().into_iter().map(run).collect()
}

/// A picture of two quantities of each run, one above the other, and their data.
pub(super) fn picture(
    varied: Varied,
    runs: &[Run],
    labels: [&str; 2],
    quantities: [fn(&quad_ndi::Record) -> f64; 2],
    step: Option<f64>,
    until_s: f64,
) -> Svg {
    let mut panels = labels.map(|label| Panel::new("Time *t*, s", label));
    for (i, run) in runs.iter().enumerate() {
        for (panel, quantity) in panels.iter_mut().zip(quantities) {
            let points = series(&run.log, quantity);
            *panel = panel
                .clone()
                .line(varied.name(run.value), series_style(i), points);
        }
    }
    let [above, below] = panels;
    let above = step.into_iter().fold(above, |panel, y| panel.horizontal(y, ""));
    let [above, below] = [above, below].map(|panel| panel.x_range(0.0, until_s));
    Figure::columns(1)
        .panel(above)
        .panel(below)
        .share_x()
        .panel_size(440.0, 185.0)
        .draw()
}

/// Columns: the value varied, time, position, pitch, longitudinal input.
pub(super) fn table(varied: Varied, runs: &[Run]) -> DataTable {
    let mut table = DataTable::new([varied.column(), "t_s", "x_m", "pitch_rad", "u_long", "u_col"]);
    for run in runs {
        for r in run.log.records.iter().step_by(2) {
            table.push([
                run.value.into(),
                r.time_s.into(),
                r.flight.position.x.into(),
                r.flight.attitude.pitch.into(),
                r.pseudo_inputs[2].into(),
                r.pseudo_inputs[0].into(),
            ]);
        }
    }
    table
}
