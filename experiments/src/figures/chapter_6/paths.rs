//! What the trajectory figures share: the reference, flights along it, their pictures and errors.

use crate::data::DataTable;
use crate::item::ItemError;
use crate::plot::space::View;
use crate::plot::svg::Svg;
use crate::plot::{Figure, Look, Panel, Space, level_name, level_style, reference_style};
use crate::scenarios::{self, Flight};
use quad_ndi::{Settings, Waypoint};
use scenario::ReferenceFile;

/// The file that the reference and the settings of the loops are taken from.
const NAME: &str = "6.18";

/// The reference: take-off into a climbing left-hand loop that turns the heading once around, and back.
pub(crate) fn waypoints() -> Result<Vec<Waypoint>, ItemError> {
    let scenario = scenarios::find(NAME)?.scenario()?;
    match scenario.quadrotor.first().map(|quadrotor| &quadrotor.reference) {
        Some(ReferenceFile::Waypoints { waypoints }) => Ok(waypoints.iter().map(Waypoint::from).collect()),
        _ => Err(ItemError::new(format!("{NAME}.toml has no waypoints"))),
    }
}

/// What the loops of the flights along the reference are asked for.
pub(crate) fn flight_settings() -> Result<Settings, ItemError> {
    let scenario = scenarios::find(NAME)?.scenario()?;
    let first = scenario.quadrotor.first();
    let first = first.ok_or_else(|| ItemError::new(format!("{NAME}.toml has no quadrotor")))?;
    Ok(first.controller.design().inversion)
}

/// From where the loop is seen open.
const VIEW: View = View {
    azimuth_deg: -62.0,
    elevation_deg: 40.0,
};

/// A flight along the reference.
#[derive(Debug)]
pub(super) struct Path {
    /// Name in legends.
    pub(super) name: String,
    /// Column name in data.
    pub(super) column: String,
    /// Look.
    pub(super) look: Look,
    /// What it did.
    pub(super) flight: Flight,
}

impl Path {
    /// A flight with the name and look of its level.
    fn of_level(flight: Flight) -> Self {
        let number = flight.level.number();
        Self::new(level_name(number), level_style(number), flight)
    }

    /// A flight under this name.
    pub(super) fn new(name: String, look: Look, flight: Flight) -> Self {
        Self {
            column: name.replace([' ', ','], "_").to_lowercase(),
            name,
            look,
            flight,
        }
    }

    /// Root mean square of the distance from the reference, m; infinite for a flight that ended early.
    pub(super) fn rms_error(&self) -> f64 {
        self.rms(&self.flight.distances())
    }

    /// The horizontal part of [`Path::rms_error`], m.
    pub(super) fn rms_along_ground(&self) -> f64 {
        self.rms(
            &self
                .flight
                .series(|row| (row.reference - row.position).xy().norm()),
        )
    }

    fn rms(&self, distances: &[(f64, f64)]) -> f64 {
        match self.flight.is_complete {
            true => quad_ndi::metrics::rms(distances, |_| 0.0),
            false => f64::INFINITY,
        }
    }
}

/// Largest distance of a flight from its reference, m.
pub(super) fn largest_distance(flight: &Flight) -> f64 {
    flight.distances().iter().map(|(_, d)| *d).fold(0.0, f64::max)
}

/// The levels of a scenario file.
pub(super) fn fly_levels(name: &str) -> Result<Vec<Path>, ItemError> {
    let flights = scenarios::fly(name)?.flights;
    Ok(flights.into_iter().map(Path::of_level).collect())
}

/// Trajectories in space, and the distance from the reference over time.
pub(super) fn picture(paths: &[Path]) -> Svg {
    let mut errors = Panel::new("Time *t*, s", "Distance from reference, m").y_include(0.0);
    for path in paths {
        errors = errors.line(path.name.clone(), path.look, path.flight.distances());
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
        let reference = first.flight.rows.iter().map(move |row| point(row.reference));
        space = space.line("reference", reference_style(), reference);
    }
    for path in paths {
        space = space.line(
            path.name.clone(),
            path.look,
            path.flight.rows.iter().map(move |row| point(row.position)),
        );
    }
    space
}

/// Columns: time, reference, and position of each path.
pub(super) fn table(paths: &[Path]) -> DataTable {
    let mut table = DataTable::new(["path", "t_s", "x_m", "y_m", "z_m", "yaw_rad", "distance_m"]);
    for path in paths {
        for (r, (_, distance)) in path.flight.rows.iter().zip(path.flight.distances()).step_by(5) {
            let p = &r.position;
            table.push([
                path.column.as_str().into(),
                r.time_s.into(),
                p.x.into(),
                p.y.into(),
                p.z.into(),
                r.attitude.yaw.into(),
                distance.into(),
            ]);
        }
    }
    table
}

/// One sentence of numbers on each path.
pub(super) fn remarks(paths: &[Path]) -> Vec<String> {
    let remark = |p: &Path| {
        let largest = largest_distance(&p.flight);
        format!(
            "{}: RMS distance {:.4} m, largest {largest:.4} m",
            p.name,
            p.rms_error()
        )
    };
    paths.iter().map(remark).collect()
}
