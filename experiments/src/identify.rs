//! The virtual laboratory's vehicle identified from its raw measurements: files, report and the claims of figure 6.14.

mod coverage;

pub use coverage::Coverage;

use crate::figures;
use crate::item::{Context, ItemError};
use crate::plot::{Figure, Panel, series_style};
use quad_dynamics::Vehicle;
use quad_dynamics::vehicle::VehicleFile;
use serde::Serialize;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use sysid::Estimate;
use sysid::load_cell::{ThrustSample, TorqueSample};
use sysid::pipeline::{Cells, Identified, Measurements, VirtualLaboratory, identify};

/// Centre of mass of the true vehicle, m: the nominal file has it at the origin, where nothing would be found.
const TRUE_CENTRE_OF_MASS_M: [f64; 3] = [0.004, -0.006, 0.012];

/// What a run says in the end.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The report, Markdown.
    pub report: String,
    /// Whether the identified vehicle flies figure 6.14's claims.
    pub claims_hold: bool,
    /// Where the files lie.
    pub out: PathBuf,
}

/// The vehicle that is measured, and what is taken as known about it.
struct Subject {
    nominal: VehicleFile,
    truth: VehicleFile,
    vehicle: Vehicle,
}

impl Subject {
    fn new(context: &Context) -> Result<Self, ItemError> {
        let path = context.data(crate::vehicle::NOMINAL_VEHICLE);
        let text =
            fs::read_to_string(&path).map_err(|e| ItemError::new(format!("{}: {e}", path.display())))?;
        let nominal = VehicleFile::parse(&text, crate::vehicle::NOMINAL_VEHICLE)?;
        let mut truth = nominal.clone();
        let centre = truth.airframe.centre_of_mass.iter_mut();
        centre
            .zip(TRUE_CENTRE_OF_MASS_M)
            .for_each(|(number, value)| number.value = value);
        let vehicle = Vehicle::from_file(&truth, "the true vehicle")?;
        Ok(Self {
            nominal,
            truth,
            vehicle,
        })
    }

    /// Measurements with the noise of a seed, and what is identified from them.
    fn identified(&self, seed: u64) -> Result<(Measurements, Identified), ItemError> {
        let measurements = VirtualLaboratory::new(figures::flight_settings()?)
            .measure(&self.vehicle, seed)
            .map_err(|e| ItemError::new(e.to_string()))?;
        let found = identify(&measurements, &self.nominal).map_err(|e| ItemError::new(e.to_string()))?;
        Ok((measurements, found))
    }
}

/// Measures the true vehicle in the virtual laboratory, identifies it, flies it, and writes everything below `out`.
///
/// # Errors
/// Files that can't be read or written; an identification or a flight that is refused.
pub fn run(context: &Context, seed: u64, out: &Path) -> Result<Outcome, ItemError> {
    let subject = Subject::new(context)?;
    let (measurements, found) = subject.identified(seed)?;
    let truth = &subject.truth;
    let identified = Vehicle::from_file(&found.file, "the identified vehicle")?;
    let claims = figures::claims_of_figure_6_14(&found.file.to_toml())?;

    let cells = Cells::calibrated(&measurements.thrust_cell, &measurements.torque_cell)
        .map_err(|e| ItemError::new(e.to_string()))?;
    let mut report = report(&found, truth, seed)?;
    report.push_str(&cell_table(&cells));
    let _ = writeln!(report, "\n## Figure 6.14 with the identified vehicle\n");
    for claim in &claims {
        let verdict = if claim.holds { "holds" } else { "DOES NOT HOLD" };
        let _ = writeln!(report, "- {}: {verdict} ({})", claim.claim.text, claim.measured);
    }
    let claims_hold = claims.iter().all(|c| c.holds);
    fs::create_dir_all(out).map_err(|e| ItemError::new(format!("{}: {e}", out.display())))?;
    raw(&measurements, out)?;
    write(&out.join("vehicle.toml"), found.file.to_toml().as_bytes())?;
    write(&out.join("report.md"), report.as_bytes())?;
    let png = crate::plot::raster::png(&picture(&cells, &measurements, &identified)?.draw());
    write(
        &out.join("thrust.png"),
        &png.map_err(|e| ItemError::new(e.to_string()))?,
    )?;
    Ok(Outcome {
        report,
        claims_hold,
        out: out.to_path_buf(),
    })
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), ItemError> {
    fs::write(path, bytes).map_err(|e| ItemError::new(format!("{}: {e}", path.display())))
}

fn rows<T: Serialize>(path: &Path, samples: &[T]) -> Result<(), ItemError> {
    let refused = |e: String| ItemError::new(format!("{}: {e}", path.display()));
    let mut writer = csv::Writer::from_path(path).map_err(|e| refused(e.to_string()))?;
    for sample in samples {
        writer.serialize(sample).map_err(|e| refused(e.to_string()))?;
    }
    writer.flush().map_err(|e| refused(e.to_string()))
}

fn raw(m: &Measurements, out: &Path) -> Result<(), ItemError> {
    rows(&out.join("supports.csv"), &m.placings)?;
    for (swing, name) in m.swings.iter().zip(["roll", "pitch", "yaw"]) {
        rows(&out.join(format!("pendulum_{name}.csv")), &swing.samples)?;
    }
    let thrust = m.thrust_cell.samples.iter();
    let thrust: Vec<ThrustSample> = thrust.map(|&s| s.into()).collect();
    rows(&out.join("load_cell_thrust.csv"), &thrust)?;
    let torque = m.torque_cell.samples.iter();
    let torque: Vec<TorqueSample> = torque.map(|&s| s.into()).collect();
    rows(&out.join("load_cell_torque.csv"), &torque)?;
    rows(&out.join("static_sweep.csv"), &m.sweep)?;
    rows(&out.join("operating_sweep.csv"), &m.operating)?;
    rows(&out.join("rotor_response.csv"), &m.dynamic)?;
    rows(&out.join("flight.csv"), &m.flight)
}

/// The table of the identified numbers beside the truth. Where the true number is that of a working point (rotor dynamics: hover,
/// the mean of the excitation) or of a fit (cubics, gains), the nominal file's derivation of it is the truth.
fn report(found: &Identified, truth: &VehicleFile, seed: u64) -> Result<String, ItemError> {
    let mut text = format!(
        "# Identification of the whole vehicle\n\nVirtual laboratory, seed {seed}. Intervals of 95 %: one in twenty is \
         expected to miss.\n\n| number | unit | estimate | standard error | 95 % interval | truth | inside? |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n"
    );
    let mut inside = 0;
    for p in &found.parameters {
        let truth = truth.get(p.key);
        let truth = truth
            .ok_or_else(|| ItemError::new(format!("no number {}", p.key)))?
            .value;
        let interval = p.estimate.interval();
        let contains = interval.contains(truth);
        inside += usize::from(contains);
        let _ = writeln!(
            text,
            "| `{}` | {} | {:.6} | {:.2e} | {:.6} to {:.6} | {truth:.6} | {} |",
            p.key,
            p.unit,
            p.estimate.value,
            p.estimate.standard_error,
            interval.lower,
            interval.upper,
            if contains { "yes" } else { "no" }
        );
    }
    let _ = writeln!(
        text,
        "\n{inside} of {} intervals contain the truth.\n\n## Warnings\n",
        found.parameters.len()
    );
    for r in &found.remarks {
        let _ = writeln!(text, "- {}: {}", r.bench, r.warning);
    }
    Ok(text)
}

/// The lines of the load cells, which every thrust and torque of the stand went through.
fn cell_table(cells: &Cells) -> String {
    let mut text = "\n## Load cells of the stand\n\n| cell | zero, mV | sensitivity, mV per N or N m |\n| --- | --- | --- |\n".to_owned();
    let in_mv = |e: Estimate| format!("{:.2} ± {:.2}", 1e3 * e.value, 1e3 * e.half_width());
    for (name, cell) in [("thrust", &cells.thrust), ("torque", &cells.torque)] {
        let _ = writeln!(
            text,
            "| {name} | {} | {} |",
            in_mv(cell.zero()),
            in_mv(cell.sensitivity())
        );
    }
    text.push_str(
        "\nThe errors of the lines are common to all readings of a sweep; the standard errors of the static numbers contain them.\n",
    );
    text
}

/// The static sweep and the identified cubic.
fn picture(cells: &Cells, m: &Measurements, vehicle: &Vehicle) -> Result<Figure, ItemError> {
    let cubic = vehicle
        .require_polynomial_rotor("the plot of the identified thrust")?
        .thrust;
    let minimum = vehicle.pwm.minimum;
    let measured: Vec<(f64, f64)> = cells
        .steady(&m.sweep)
        .iter()
        .map(|s| (s.effective(minimum), s.thrust_n))
        .collect();
    let end = measured.iter().map(|p| p.0).fold(0.0, f64::max);
    let curve = (0..=200).map(|i| end * f64::from(i) / 200.0);
    let curve: Vec<(f64, f64)> = curve.map(|x| (x, cubic.value(x))).collect();
    let panel = Panel::new(
        "Effective voltage *x* = (*ū* − *ū*_{min}) *V*_b, V",
        "Thrust *T*, N",
    )
    .markers("measured", series_style(0), measured)
    .line("identified cubic", series_style(1), curve);
    Ok(Figure::columns(1).panel(panel))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::item::repository_root;

    #[test]
    fn thesis_the_identified_vehicle_flies_figure_6_14() {
        let out = std::env::temp_dir().join(format!("identify-{}", std::process::id()));
        let outcome = run(&Context::new(repository_root(), false), 2, &out).unwrap();
        assert!(outcome.claims_hold, "{}", outcome.report);
        let text = fs::read_to_string(out.join("vehicle.toml")).unwrap();
        assert!(Vehicle::from_toml_str(&text, "vehicle.toml").is_ok());
        fs::remove_dir_all(out).unwrap();
    }
}
