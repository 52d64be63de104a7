//! What the trajectory figures share: the reference, flights along it, their pictures and errors.

use super::settings;
use crate::data::DataTable;
use crate::flight::{Law, Scenario, Task, completed};
use crate::item::{Context, ItemError};
use crate::plot::space::View;
use crate::plot::svg::Svg;
use crate::plot::{Figure, Look, Panel, Space, reference_style};
use quad_dynamics::{Level, Vehicle};
use quad_ndi::{FlightLog, Waypoint};

/// The reference: take-off into a climbing left-hand loop that turns the heading once around, and back.
pub(crate) fn waypoints() -> Vec<Waypoint> {
    let at = |time_s, position_m, velocity_m_s, yaw_rad| Waypoint {
        time_s,
        position_m,
        velocity_m_s,
        yaw_rad,
        yaw_rate_rad_s: 0.0,
    };
    vec![
        at(0.0, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], 0.0),
        at(3.0, [2.0, 0.0, -1.0], [0.6, -0.9, -0.2], -0.8),
        at(6.0, [2.0, -2.5, -2.0], [-0.9, -0.6, -0.2], -2.4),
        at(9.0, [-0.5, -2.0, -2.2], [-0.6, 0.9, 0.3], -4.2),
        at(12.0, [0.0, 0.0, -1.0], [0.0, 0.0, 0.0], -std::f64::consts::TAU),
    ]
}

/// From where the loop is seen open.
const VIEW: View = View {
    azimuth_deg: -62.0,
    elevation_deg: 40.0,
};

/// Time flown, s: the trajectory and two seconds to settle.
const DURATION_S: f64 = 14.0;

/// The scenario of a controller that follows the reference.
pub(crate) fn scenario(law: Law) -> Scenario {
    let task = Task::Follow {
        waypoints: waypoints(),
    };
    Scenario {
        record_every: 10,
        ..Scenario::new(law, settings::flight(), task, DURATION_S)
    }
}

/// The same path in space at the heading of its start.
pub(super) fn steady_heading(scenario: Scenario) -> Scenario {
    let ahead = |w: Waypoint| Waypoint { yaw_rad: 0.0, ..w };
    Scenario {
        task: Task::Follow {
            waypoints: waypoints().into_iter().map(ahead).collect(),
        },
        ..scenario
    }
}

/// Largest distance of a flight from its reference, m.
pub(super) fn largest_distance(log: &FlightLog) -> f64 {
    let distance = |r: &quad_ndi::Record| (r.reference.flat.position - r.flight.position).norm();
    log.records.iter().map(distance).fold(0.0, f64::max)
}

/// A flight along the reference.
#[derive(Debug)]
pub(super) struct Path {
    /// Name in legends.
    pub(super) name: String,
    /// Column name in data.
    pub(super) column: String,
    /// Look.
    pub(super) look: Look,
    /// What was recorded.
    pub(super) log: FlightLog,
}

impl Path {
    /// Flies a scenario on a level.
    pub(super) fn fly(
        scenario: &Scenario,
        vehicle: &Vehicle,
        level: Level,
        name: String,
        look: Look,
    ) -> Result<Self, ItemError> {
        let column = name.replace([' ', ','], "_").to_lowercase();
        Ok(Self {
            name,
            column,
            look,
            log: scenario.fly_vehicle(vehicle, level)?,
        })
    }

    /// Distance from the reference over time, `(t, m)`.
    pub(super) fn errors(&self) -> Vec<(f64, f64)> {
        let distance = |r: &quad_ndi::Record| (r.reference.flat.position - r.flight.position).norm();
        self.log.records.iter().map(|r| (r.time_s, distance(r))).collect()
    }

    /// Root mean square of the distance from the reference, m; infinite for a flight that diverged.
    pub(super) fn rms_error(&self) -> f64 {
        if completed(&self.log) {
            quad_ndi::metrics::rms(&self.errors(), |_| 0.0)
        } else {
            f64::INFINITY
        }
    }

    /// The horizontal part of [`Path::rms_error`], m.
    pub(super) fn rms_along_ground(&self) -> f64 {
        let distance = |r: &quad_ndi::Record| (r.reference.flat.position - r.flight.position).xy().norm();
        let points: Vec<_> = self.log.records.iter().map(|r| (r.time_s, distance(r))).collect();
        if completed(&self.log) {
            quad_ndi::metrics::rms(&points, |_| 0.0)
        } else {
            f64::INFINITY
        }
    }
}

/// One controller on several levels.
pub(super) fn fly_levels(context: &Context, law: Law, levels: &[Level]) -> Result<Vec<Path>, ItemError> {
    use crate::plot::{level_name, level_style};
    let scenario = scenario(law);
    let vehicle = scenario.vehicle(context)?;
    let path = |&level: &Level| {
        let n = level.number();
        Path::fly(&scenario, &vehicle, level, level_name(n), level_style(n))
    };
    levels.iter().map(path).collect()
}

/// Trajectories in space, and the distance from the reference over time.
pub(super) fn picture(paths: &[Path]) -> Svg {
    let mut errors = Panel::new("Time *t*, s", "Distance from reference, m").y_include(0.0);
    for path in paths {
        errors = errors.line(path.name.clone(), path.look, path.errors());
    }
    Figure::columns(1)
        .panel(space(paths))
        .panel(errors)
        .panel_size(470.0, 300.0)
        .draw()
}

/// The space of the trajectories: right-handed axes north, west, up.
pub(super) fn empty_space() -> Space {
    Space::new("North *x*, m", "West −*y*, m", "Height −*z*, m").view(VIEW)
}

/// Trajectories in space, the reference among them.
pub(super) fn space(paths: &[Path]) -> Space {
    let mut space = empty_space();
    let point = |p: nalgebra::Vector3<f64>| Space::of_z_down(p.x, p.y, p.z);
    if let Some(first) = paths.first() {
        let reference = first
            .log
            .records
            .iter()
            .map(move |r| point(r.reference.flat.position));
        space = space.line("reference", reference_style(), reference);
    }
    for path in paths {
        space = space.line(
            path.name.clone(),
            path.look,
            path.log.records.iter().map(move |r| point(r.flight.position)),
        );
    }
    space
}

/// Columns: time, reference, and position of each path.
pub(super) fn table(paths: &[Path]) -> DataTable {
    let mut table = DataTable::new(["path", "t_s", "x_m", "y_m", "z_m", "yaw_rad", "distance_m"]);
    for path in paths {
        for (r, (_, distance)) in path.log.records.iter().zip(path.errors()).step_by(5) {
            let p = &r.flight.position;
            table.push([
                path.column.as_str().into(),
                r.time_s.into(),
                p.x.into(),
                p.y.into(),
                p.z.into(),
                r.flight.attitude.yaw.into(),
                distance.into(),
            ]);
        }
    }
    table
}

/// One sentence of numbers on each path.
pub(super) fn remarks(paths: &[Path]) -> Vec<String> {
    let remark = |p: &Path| {
        let largest = largest_distance(&p.log);
        format!(
            "{}: RMS distance {:.4} m, largest {largest:.4} m",
            p.name,
            p.rms_error()
        )
    };
    paths.iter().map(remark).collect()
}
