//! Cameras as a table, as CSV, as JSON, and as a plan of the room.

use super::Judged;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use coverage::{Camera, RoomFile, Task};
use optim::Report;
use quad_plot::style::{GREY, INK, Look, Marker};
use quad_plot::{Figure, Panel, series_style};
use serde_json::{Value, json};

/// Depth to which a camera's field is drawn, m.
const DEPTH_M: f64 = 1.5;

fn degrees(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}

/// For people.
pub(super) fn text(file: &RoomFile, judged: &[Judged], found: Option<&Report>) -> String {
    let mut text = String::new();
    if let Some(best) = judged.last() {
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED).set_header([
            "camera",
            "north, m",
            "east, m",
            "height, m",
            "azimuth, °",
            "elevation, °",
        ]);
        for (k, c) in (1..).zip(&best.cameras) {
            table.add_row([
                k.to_string(),
                format!("{:.2}", c.position_m.x),
                format!("{:.2}", c.position_m.y),
                format!("{:.2}", -c.position_m.z),
                format!("{:.1}", (10.0 * degrees(c.azimuth_rad)).round() % 3600.0 / 10.0),
                format!("{:.1}", c.elevation_rad.to_degrees()),
            ]);
        }
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        text += &format!("{table}\n");
    }
    for rig in judged {
        text += &format!(
            "{}: {} cameras, {:.1} % of the volume is seen by {} or more\n",
            rig.name,
            rig.cameras.len(),
            1e2 * rig.coverage.fraction,
            file.rig.needed
        );
    }
    if let Some(report) = found {
        text += &format!(
            "{} evaluations, {:.1} s; {}\n",
            report.evaluations,
            report.elapsed.as_secs_f64(),
            report.stop
        );
    }
    text
}

/// For machines.
pub(super) fn json(judged: &[Judged], found: Option<&Report>) -> Value {
    let camera = |c: &Camera| {
        json!({
            "position_m": [c.position_m.x, c.position_m.y, c.position_m.z],
            "azimuth_deg": degrees(c.azimuth_rad),
            "elevation_deg": c.elevation_rad.to_degrees(),
        })
    };
    let rig = |rig: &Judged| {
        json!({
            "name": rig.name,
            "covered": rig.coverage.fraction,
            "cameras": rig.cameras.iter().map(camera).collect::<Vec<_>>(),
        })
    };
    json!({
        "rigs": judged.iter().map(rig).collect::<Vec<_>>(),
        "evaluations": found.map(|report| report.evaluations),
        "stop": found.map(|report| report.stop.to_string()),
    })
}

/// One camera a row.
pub(super) fn csv(cameras: &[Camera]) -> String {
    let row = |c: &Camera| {
        let p = c.position_m;
        let (azimuth, elevation) = (degrees(c.azimuth_rad), c.elevation_rad.to_degrees());
        format!("{},{},{},{azimuth},{elevation}\n", p.x, p.y, p.z)
    };
    let head = "x_m,y_m,z_m,azimuth_deg,elevation_deg\n".to_owned();
    cameras.iter().fold(head, |text, c| text + &row(c))
}

/// The rigs from above: walls, volume, fields of view, and what too few see.
pub(super) fn figure(file: &RoomFile, task: &Task, judged: &[Judged]) -> Figure {
    judged.iter().fold(Figure::columns(2), |figure, rig| {
        figure.panel(plan(file, task, rig))
    })
}

fn rectangle([north, east]: [[f64; 2]; 2]) -> [(f64, f64); 5] {
    let at = |e: usize, n: usize| (east[e], north[n]);
    [at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(0, 0)]
}

fn plan(file: &RoomFile, task: &Task, rig: &Judged) -> Panel {
    let room = task.room();
    let walls = [room.length_m, room.width_m].map(|edge| [-0.5 * edge, 0.5 * edge]);
    let accent = series_style(0);
    let missing = task
        .points()
        .iter()
        .zip(&rig.coverage.seen_by)
        .filter(|(_, n)| **n < file.rig.needed)
        .map(|(p, _)| (p.y, p.x));
    let mut panel = Panel::new("East, m", "North, m")
        .caption(format!("{}: {:.1} %", rig.name, 1e2 * rig.coverage.fraction))
        .equal_aspect()
        .line("walls", Look::solid(INK, 1.4), rectangle(walls))
        .line("volume", Look::solid(GREY, 1.0), rectangle(file.volume_m()))
        .markers(
            format!("seen by fewer than {}", file.rig.needed),
            series_style(1).marked(Marker::Dot),
            missing,
        )
        .markers(
            "cameras",
            accent.marked(Marker::Square),
            rig.cameras.iter().map(|c| (c.position_m.y, c.position_m.x)),
        );
    for camera in &rig.cameras {
        let [a, b, ..] = camera.field(task.lens(), DEPTH_M).map(|p| (p.y, p.x));
        let from = (camera.position_m.y, camera.position_m.x);
        panel = panel.line("", Look::solid(accent.colour, 0.8), [from, a, b, from]);
    }
    panel
}
