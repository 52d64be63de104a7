//! Picture, table and data of a replayed flight.

use super::flights::{FITTED, LEVELS, Run, Study, WINDOW};
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::ItemError;
use crate::plot::{Figure, Look, Panel, level_name, level_style};
use quad_dynamics::Level;
use sysid::validation::{AVERAGE_S, Agreement, Prediction};

/// The stretch that is drawn, s: all of it would be too dense to read.
const DRAWN: std::ops::Range<f64> = 10.0..14.0;

/// Labels of the six panels: left the translation along W, right the rotation along B.
const LABELS: [[&str; 2]; 3] = [
    ["North *v̇*_{x}, m s^{−2}", "Roll *ṗ*, rad s^{−2}"],
    ["East *v̇*_{y}, m s^{−2}", "Pitch *q̇*, rad s^{−2}"],
    ["Down *v̇*_{z}, m s^{−2}", "Yaw *ṙ*, rad s^{−2}"],
];

/// Measured curves stand behind the levels.
const MEASURED: Look = Look::solid("#9a9a9a", 4.0);

/// The drawing of a study without its claims.
pub(super) fn drawing(study: &Study, name: &str) -> Result<Drawing, ItemError> {
    let mut figure = Figure::columns(2).share_x().panel_size(400.0, 120.0);
    for (axis, labels) in LABELS.iter().enumerate() {
        for (column, label) in labels.iter().enumerate() {
            figure = figure.panel(panel(study, axis, column, label)?);
        }
    }
    let identified = &study.identified;
    let calibration = &study.calibration;
    Ok(Drawing::picture(figure.draw())
        .beneath(table(study))
        .data(series(study)?)
        .named_data("agreement", agreement(study, |p| p != Prediction::WholeFlight))
        // Tumbling is chaotic: on another processor rounding makes other numbers of it.
        .named_data(
            "whole-flight",
            agreement(study, |p| p == Prediction::WholeFlight)
                .with_volatile("fit_percent")
                .with_volatile("theil")
                .with_volatile("bias_share")
                .with_volatile("samples"),
        )
        .settings(&toml::toml! {
            flight = name
            fitted_flight = FITTED
            window_s = [(WINDOW.start), (WINDOW.end)]
            mean_s = AVERAGE_S
            thrust_curve_n = [
                (identified.thrust.curve().constant),
                (identified.thrust.curve().linear),
                (identified.thrust.curve().quadratic)
            ]
            arpl_motor_lag_s = (identified.thrust.lag().value)
            arpl_inertia_kg_m2 = [(identified.roll.inertia.value), (identified.pitch.inertia.value)]
            effective_mass_kg = (calibration.mass().value)
            inertia_kg_m2 = [(calibration.roll.inertia.value), (calibration.pitch.inertia.value)]
            motor_lag_s = (calibration.lag_s)
            delay_s = (calibration.delay_s())
            trim_duty = [
                (calibration.trim[0]),
                (calibration.trim[1]),
                (calibration.trim[2]),
                (calibration.trim[3])
            ]
            mean_voltage_v = (calibration.voltage)
        })?
        .note(identification(study))
        .note(CAVEATS))
}

const CAVEATS: &str = "Table: fit % (Theil's *U*) over all 13 s; fit 0 % is that of predicting the mean. *One-step*: the body restarts from the \
    measured state at every sample, so that this is the model's acceleration at the measured state; *horizon*: restarted every 0.1, 0.5 or \
    1 s, open loop in between; *whole flight*: started once. *p*, *q*, *r*, *v*_{z} are compared at the end of each horizon (one-step, whole \
    flight: every 0.05 s). Rates of an open-loop replay diverge, whatever the model: attitude is unstable. Horizontal accelerations rest \
    on motion capture's attitude times thrust and agree only weakly on the slow flights, where they are hardly larger than the offsets. Effective mass means mass over thrust scale: markers and motors can't be told apart.";

/// The identification in a sentence, with 95 % intervals and what it is worth on data it did not see.
fn identification(study: &Study) -> String {
    let found = &study.identified;
    let with_interval = |e: sysid::Estimate, scale: f64, digits: usize| {
        format!(
            "{:.digits$} ± {:.digits$}",
            scale * e.value,
            scale * e.half_width()
        )
    };
    let unseen = &study.unseen;
    format!(
        "Identified on the ARPL flights (95 % intervals, widened for correlated residuals): motor lag {} s, delay of the gyroscope {} ms, \
         *I*_{{xx}} = {}, *I*_{{yy}} = {} 10^{{−6}} kg m^{{2}}; in yaw only torque per thrust over inertia, {} kg^{{−1}} m^{{−1}}. On parts of those \
         flights kept back, fit % (*U*) of thrust {}, roll {}, pitch {}, yaw {}.",
        with_interval(found.thrust.lag(), 1.0, 3),
        with_interval(found.roll.delay, 1e3, 1),
        with_interval(found.roll.inertia, 1e6, 1),
        with_interval(found.pitch.inertia, 1e6, 1),
        with_interval(found.yaw.ratio(), 1.0, 0),
        cell(&unseen.thrust),
        cell(&unseen.roll),
        cell(&unseen.pitch),
        cell(&unseen.yaw),
    )
}

fn panel(study: &Study, axis: usize, column: usize, label: &str) -> Result<Panel, ItemError> {
    let fit = {
        let agreement = &study.run(Level::Five, Prediction::OneStep)?.agreement;
        let axes = if column == 0 {
            &agreement.acceleration
        } else {
            &agreement.angular_acceleration
        };
        fit_words(&axes[axis])
    };
    let mut panel = Panel::new("Time *t*, s", label)
        .caption(format!("level 5 fits {fit} %"))
        .x_range(DRAWN.start, DRAWN.end);
    for level in LEVELS {
        let replay = &study.run(level, Prediction::OneStep)?.replay;
        let series = if column == 0 {
            &replay.acceleration
        } else {
            &replay.angular_acceleration
        };
        let compared = &series[axis];
        let points = |values: &[f64]| -> Vec<(f64, f64)> {
            let pairs = compared.time.iter().copied().zip(values.iter().copied());
            pairs.filter(|(t, _)| DRAWN.contains(t)).collect()
        };
        if level == LEVELS[0] {
            panel = panel.line("measured", MEASURED, points(&compared.measured));
        }
        let number = level.number();
        panel = panel.line(
            level_name(number),
            level_style(number),
            points(&compared.predicted),
        );
    }
    Ok(panel)
}

/// What is compared, with the name of its column.
fn compared(run: &Run) -> [(&'static str, &Agreement); 10] {
    let a = &run.agreement;
    [
        ("acceleration_north", &a.acceleration[0]),
        ("acceleration_east", &a.acceleration[1]),
        ("acceleration_down", &a.acceleration[2]),
        ("roll_acceleration", &a.angular_acceleration[0]),
        ("pitch_acceleration", &a.angular_acceleration[1]),
        ("yaw_acceleration", &a.angular_acceleration[2]),
        ("roll_rate", &a.body_rates[0]),
        ("pitch_rate", &a.body_rates[1]),
        ("yaw_rate", &a.body_rates[2]),
        ("velocity_down", &a.velocity[2]),
    ]
}

fn table(study: &Study) -> DisplayTable {
    let mut table = DisplayTable::new([
        "Level",
        "Prediction",
        "*v̇*_{x}",
        "*v̇*_{y}",
        "*v̇*_{z}",
        "*ṗ*",
        "*q̇*",
        "*ṙ*",
        "*p*",
        "*q*",
        "*r*",
        "*v*_{z}",
    ]);
    for run in &study.runs {
        let mut row = vec![run.level.number().to_string(), run.prediction.to_string()];
        row.extend(compared(run).iter().map(|(_, a)| cell(a)));
        table.push(row);
    }
    table
}

fn fit_words(agreement: &Agreement) -> String {
    let fit = agreement
        .fit_percent
        .map_or("–".to_owned(), |f| format!("{f:.0}"));
    fit.replace('-', "−")
}

/// `31 (0.36)`: fit % and Theil's U.
pub(super) fn cell(agreement: &Agreement) -> String {
    format!("{} ({:.2})", fit_words(agreement), agreement.theil)
}

fn agreement(study: &Study, wanted: impl Fn(Prediction) -> bool) -> DataTable {
    let mut table = DataTable::new([
        "level",
        "prediction",
        "quantity",
        "fit_percent",
        "theil",
        "bias_share",
        "samples",
    ]);
    for run in study.runs.iter().filter(|run| wanted(run.prediction)) {
        for (quantity, a) in compared(run) {
            table.push([
                run.level.number().into(),
                run.prediction.to_string().into(),
                quantity.into(),
                a.fit_percent.unwrap_or(f64::NAN).into(),
                a.theil.into(),
                a.shares.map_or(0.0, |s| s.bias).into(),
                a.samples.into(),
            ]);
        }
    }
    // Horizons of a second amplify rounding by a factor of some thousands; 1e-4 of each column's range is still far below
    // what is printed.
    table.with_tolerance(1e-4)
}

fn series(study: &Study) -> Result<DataTable, ItemError> {
    // The recording's own numbers are not committed as a reference: they are others' data.
    let mut table = DataTable::new(["level", "quantity", "t_s", "measured", "predicted"])
        .with_tolerance(1e-4)
        .with_volatile("measured");
    for level in LEVELS {
        let replay = &study.run(level, Prediction::OneStep)?.replay;
        let named = [
            ("acceleration_m_s2", &replay.acceleration),
            ("angular_acceleration_rad_s2", &replay.angular_acceleration),
        ];
        for (name, axes) in named {
            for (axis, compared) in ["x", "y", "z"].iter().zip(axes) {
                for ((t, y), p) in compared
                    .time
                    .iter()
                    .zip(&compared.measured)
                    .zip(&compared.predicted)
                {
                    let quantity = format!("{name}_{axis}");
                    table.push([
                        level.number().into(),
                        quantity.into(),
                        (*t).into(),
                        (*y).into(),
                        (*p).into(),
                    ]);
                }
            }
        }
    }
    Ok(table)
}
