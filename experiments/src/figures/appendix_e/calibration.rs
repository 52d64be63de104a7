//! One calibration: samples from the virtual laboratory, the line, and how both are drawn.

use super::load_cells::{INSIDE, LINEAR};
use crate::data::DataTable;
use crate::drawing::{DisplayTable, Drawing};
use crate::item::ItemError;
use crate::plot::panel::BandPoint;
use crate::plot::style::{BLUE, Look, VERMILION};
use crate::plot::{Figure, Panel, series_style};
use quad_dynamics::Vehicle;
use serde::Serialize;
use std::ops::RangeInclusive;
use sysid::laboratory::generator;
use sysid::laboratory::load_cells::{Channel, LoadCell};
use sysid::load_cell::{Calibration, Sample, calibrate};

/// What is calibrated, and how it is written.
pub(super) struct Subject {
    pub(super) channel: Channel,
    /// The load in words with its symbol. Rich text.
    pub(super) quantity: &'static str,
    /// Unit of the picture.
    pub(super) unit: &'static str,
    /// Column of the data, in SI units.
    pub(super) column: &'static str,
    /// Units of the picture per SI unit.
    pub(super) scale: f64,
    pub(super) seed: u64,
}

/// Loads from none to capacity, and readings of each on either way.
const STEPS: u32 = 10;
const REPETITIONS: u32 = 2;
/// Largest departure from a straight line that is called linear, of the span.
pub(super) const DEPARTURE_ALLOWED: f64 = 1e-3;

#[derive(Serialize)]
struct Settings {
    seed: u64,
    steps: u32,
    repetitions: u32,
    cell: LoadCell,
}

struct Test {
    settings: Settings,
    samples: Vec<Sample>,
}

fn test(subject: &Subject) -> Result<Test, ItemError> {
    let cell = LoadCell::of(&Vehicle::qball_x4(), subject.channel);
    let samples = cell.calibrate(STEPS, REPETITIONS, &mut generator(subject.seed))?;
    let settings = Settings {
        seed: subject.seed,
        steps: STEPS,
        repetitions: REPETITIONS,
        cell,
    };
    Ok(Test { settings, samples })
}

fn data(subject: &Subject, samples: &[Sample]) -> DataTable {
    let mut data = DataTable::new([subject.column, "reading_v"]);
    for sample in samples {
        data.push([sample.load.into(), sample.reading_v.into()]);
    }
    data
}

/// Calibrations with other noise that are counted.
const COUNTED: u64 = 200;
/// Expected of 400 intervals of 95 %: the cell's bow of 0.01 % shifts the zero of a line by 0.33 mV, 0.6 standard errors, which no
/// interval of noise contains, so that 91 % of the zeros' and 95 % of the sensitivities' hit, 93 % in all; three standard
/// deviations of the count (1.3 %) to either side.
const EXPECTED: RangeInclusive<f64> = 0.89..=0.98;

/// Share of the intervals of zero and sensitivity that contain the cell's own, over calibrations with other noise.
fn coverage(subject: &Subject) -> Result<f64, ItemError> {
    let cell = LoadCell::of(&Vehicle::qball_x4(), subject.channel);
    let mut hits = 0;
    for repetition in 1..=COUNTED {
        // Seeds of the subjects are below a hundred.
        let mut noise = generator(100 * repetition + subject.seed);
        let samples = cell.calibrate(STEPS, REPETITIONS, &mut noise)?;
        let found = calibrate(&samples, cell.capacity.abs())?;
        hits += u32::from(found.zero().interval().contains(cell.zero_v));
        hits += u32::from(found.sensitivity().interval().contains(cell.sensitivity_v));
    }
    Ok(f64::from(hits) / (2 * COUNTED) as f64)
}

/// The figure of a calibration.
pub(super) fn curve(subject: &Subject) -> Result<Drawing, ItemError> {
    let Test { settings, samples } = test(subject)?;
    let cell = settings.cell;
    let found = calibrate(&samples, cell.capacity.abs())?;
    let (zero, sensitivity) = (found.zero(), found.sensitivity());
    let share = coverage(subject)?;
    let linearity = found.linearity;
    let lack = linearity.lack_of_fit.map_or_else(String::new, |test| {
        format!("lack of fit p = {:.2}, ", test.p_value)
    });
    let mut drawing = Drawing::picture(picture(subject, &samples, &found));
    for warning in &found.line.warnings {
        drawing = drawing.note(warning.to_string());
    }
    Ok(drawing
        .data(data(subject, &samples))
        .settings(&settings)?
        .check(
            LINEAR,
            linearity.is_straight() && linearity.departure < DEPARTURE_ALLOWED,
            format!(
                "quadratic term p = {:.2}, {lack}parabola departs by {:.3} % of the span",
                linearity.p_value,
                100.0 * linearity.departure
            ),
        )
        .check(
            INSIDE,
            EXPECTED.contains(&share),
            format!(
                "{:.1} % of the intervals; here zero {:.2} ± {:.2} mV (true {:.2}); sensitivity {:.5} ± {:.5} V/{} (true {:.5})",
                100.0 * share,
                1e3 * zero.value,
                1e3 * zero.half_width(),
                1e3 * cell.zero_v,
                sensitivity.value,
                sensitivity.half_width(),
                if subject.channel == Channel::Thrust {
                    "N"
                } else {
                    "(N m)"
                },
                cell.sensitivity_v
            ),
        ))
}

fn picture(subject: &Subject, samples: &[Sample], found: &Calibration) -> crate::plot::svg::Svg {
    let label = format!("{}, {}", subject.quantity, subject.unit);
    let span = found.largest_load - found.smallest_load;
    let loads = (0..=60).map(|k| found.smallest_load + span * f64::from(k) / 60.0);
    let line = |load: f64| found.reading(load);
    // Room for the markers at both ends.
    let room = 0.04 * span;
    let (left, right) = (
        subject.scale * (found.smallest_load - room),
        subject.scale * (found.largest_load + room),
    );
    let measured = samples.iter().zip(&found.line.residuals);
    let calibration = Panel::new(&label, "Reading *y*, V")
        .x_range(left, right)
        .line(
            "calibration line",
            Look::solid(VERMILION, 1.6),
            loads.clone().map(|x| (subject.scale * x, line(x).value)),
        )
        .markers(
            "virtual measurement",
            series_style(0),
            samples.iter().map(|s| (subject.scale * s.load, s.reading_v)),
        );
    let band = loads.map(|x| BandPoint {
        x: subject.scale * x,
        lower: -1e3 * line(x).half_width(),
        upper: 1e3 * line(x).half_width(),
    });
    let residuals = Panel::new(&label, "Residual, mV")
        .x_range(left, right)
        .band("95 % band of the line", Look::solid(VERMILION, 1.0), band)
        .markers(
            "",
            Look::solid(BLUE, 1.0),
            measured.map(|(s, r)| (subject.scale * s.load, 1e3 * r)),
        )
        .horizontal(0.0, "");
    Figure::columns(2).panel(calibration).panel(residuals).draw()
}

/// The table of samples of a calibration.
pub(super) fn samples(subject: &Subject) -> Result<Drawing, ItemError> {
    let Test { settings, samples } = test(subject)?;
    let each = REPETITIONS as usize;
    let mut shown = DisplayTable::new([
        format!("{}, {}", subject.quantity, subject.unit),
        "Up, V".to_owned(),
        "Up, V".to_owned(),
        "Down, V".to_owned(),
        "Down, V".to_owned(),
    ]);
    for k in 0..=STEPS as usize {
        let up = &samples[k * each..(k + 1) * each];
        // The way down begins with the last load.
        let back = (2 * STEPS as usize + 1 - k) * each;
        let down = &samples[back..back + each];
        let load = format!("{:.2}", subject.scale * up[0].load + 0.0).replace('-', "−");
        let readings = up
            .iter()
            .chain(down)
            .map(|s| format!("{:.4}", s.reading_v).replace('-', "−"));
        shown.push(std::iter::once(load).chain(readings));
    }
    Ok(Drawing::table(shown)
        .data(data(subject, &samples))
        .settings(&settings)?)
}
