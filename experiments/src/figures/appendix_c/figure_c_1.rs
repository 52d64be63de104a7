//! Figure C.1: coverage of the flight volume by cameras on the walls, before and after optimisation.

use super::rig::Settings;
use super::rig_picture::picture;
use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::figure::Legends;
use crate::plot::{Figure, Panel, series_style};
use coverage::{Camera, Coverage, Task, WallRig};
use optim::{Evolution, EvolutionSettings, Limits, Report, minimise};

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "C.1",
    title: "Coverage of the flight volume by motion-capture cameras",
    description: "Eight cameras of table B.1 on the walls of a room of 10 m by 8 m by 4 m (an assumption), mirrored in four quarters. Inner \
                  box: the flight volume; squares: parts of it that fewer than three cameras see; pyramids: what a camera sees to \
                  1.5 m. (a) Every eighth of the walls, 2.5 m up, looking straight across; (b) place, height, pan and tilt \
                  optimised by differential evolution; (c) part of the volume that at least *n* cameras see.",
    kind: Kind::Plot,
    origin: Origin::Simulated,
    claims: &[ABOVE],
    make: Make::Draw(draw),
};

const ABOVE: Claim = Claim::holds("optimised coverage above the initial one");

/// Evaluations of the search.
const EVALUATIONS: u64 = 4000;

fn draw(_context: &Context) -> Result<Drawing, ItemError> {
    let settings = Settings::nominal(EVALUATIONS);
    let task = settings.task()?;
    let rig = settings.rig()?;
    let before = rig.cameras(&rig.first_guess());
    let report = optimised(&task, &rig, &settings)?;
    let after = rig.cameras(&report.best.candidate.values);
    let (seen_before, seen_after) = (task.coverage(&before)?, task.coverage(&after)?);
    let figure = Figure::columns(3)
        .legends(Legends::EachPanel)
        .panel_size(330.0, 205.0)
        .panel(picture("first guess", &task, &settings, &before, &seen_before))
        .panel(picture("optimised", &task, &settings, &after, &seen_after))
        .panel(shares(&seen_before, &seen_after));
    Ok(Drawing::picture(figure.draw())
        .data(share_table(&seen_before, &seen_after))
        .named_data("cameras", camera_table(&before, &after))
        .settings(&settings)?
        .note(format!(
            "Differential evolution: {} evaluations in {:.1} s; stopped: {}.",
            report.evaluations,
            report.elapsed.as_secs_f64(),
            report.stop
        ))
        .check(
            ABOVE,
            seen_after.fraction > seen_before.fraction,
            format!(
                "{:.1} % of the volume is seen by at least three cameras, {:.1} % before",
                1e2 * seen_after.fraction,
                1e2 * seen_before.fraction
            ),
        ))
}

fn optimised(task: &Task, rig: &WallRig, settings: &Settings) -> Result<Report, ItemError> {
    let evolution = EvolutionSettings {
        seed: settings.seed,
        ..EvolutionSettings::default()
    };
    let mut search = Evolution::new(rig.variables(), evolution)?;
    let limits = Limits::evaluations(settings.evaluations);
    Ok(minimise(&mut search, |x: &[f64]| rig.cost(task, x), limits)?)
}

/// Part of the volume that at least n cameras see, n from 0 to the number of cameras.
fn share(coverage: &Coverage, n: u32) -> f64 {
    coverage.seen_by.iter().filter(|seen| **seen >= n).count() as f64 / coverage.seen_by.len() as f64
}

/// Most cameras shown in (c).
const MOST: u32 = 8;

fn shares(before: &Coverage, after: &Coverage) -> Panel {
    let points = |coverage| (1..=MOST).map(move |n| (f64::from(n), 1e2 * share(coverage, n)));
    Panel::new("Cameras *n*", "Volume seen by at least *n*, %")
        .caption("sightings")
        .line("", series_style(2), points(before))
        .line("", series_style(0), points(after))
        .markers("first guess", series_style(2), points(before))
        .markers("optimised", series_style(0), points(after))
        .vertical(3.0, "needed")
        .x_range(0.7, 8.3)
        .x_step(1.0)
        .y_range(-3.0, 103.0)
}

fn share_table(before: &Coverage, after: &Coverage) -> DataTable {
    let numbers: Vec<f64> = (0..=MOST).map(f64::from).collect();
    let column = |coverage| (0..=MOST).map(|n| share(coverage, n)).collect::<Vec<_>>();
    DataTable::from_columns(&[
        ("cameras", &numbers),
        ("share_before", &column(before)),
        ("share_after", &column(after)),
    ])
}

fn camera_table(before: &[Camera], after: &[Camera]) -> DataTable {
    let mut table = DataTable::new(["rig", "x_m", "y_m", "z_m", "azimuth_rad", "elevation_rad"]);
    for (rig, cameras) in [("before", before), ("after", after)] {
        for c in cameras {
            let p = c.position_m;
            table.push([
                rig.into(),
                p.x.into(),
                p.y.into(),
                p.z.into(),
                c.azimuth_rad.into(),
                c.elevation_rad.into(),
            ]);
        }
    }
    table
}
