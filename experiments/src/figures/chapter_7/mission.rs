//! The problems of the chapter: the nominal crossing with the parameter files' vehicle and station.

use crate::item::{Context, ItemError};
use crate::station::{NOMINAL_STATION, load_station};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use quad_dynamics::Level;
use std::sync::{Arc, Mutex, PoisonError};
use wpt_optim::{Choice, Grid, Mission, Penalties, Problem, Surface, Weights};

/// The nominal problem of these variables in this many seconds at a level.
pub(in crate::figures) fn problem(
    context: &Context,
    choice: Choice,
    duration_s: f64,
    level: Level,
) -> Result<Problem, ItemError> {
    let vehicle = Arc::new(load_vehicle(context, NOMINAL_VEHICLE)?);
    let station = load_station(context, NOMINAL_STATION)?;
    Ok(Problem::new(
        Mission::crossing(duration_s, vehicle, station),
        level,
        choice.decisions(),
        &Weights::default(),
        &Penalties::default(),
    )?)
}

/// Duration of the crossing whose cost is mapped, s.
pub(super) const MAPPED_S: f64 = 20.0;

/// Nodes along each variable; ±4 m, ±8 m and 0 are among them.
const FINE: Grid = Grid {
    columns: 41,
    rows: 41,
};
const COARSE: Grid = Grid {
    columns: 13,
    rows: 13,
};

/// The cost surfaces of all levels, once they are computed, and their grid.
static MAPPED: Mutex<Option<(Grid, Arc<Vec<Surface>>)>> = Mutex::new(None);

/// The cost of two variables over their box, at every level, lowest first.
pub(super) fn surfaces(context: &Context) -> Result<Arc<Vec<Surface>>, ItemError> {
    let wanted = if context.quick { COARSE } else { FINE };
    // Not locked while it computes: two figures at once may both do so, with the same result.
    let known = MAPPED.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if let Some((_, surfaces)) = known.filter(|(grid, _)| *grid == wanted) {
        return Ok(surfaces);
    }
    let map = |level| -> Result<Surface, ItemError> {
        Ok(problem(context, Choice::Two, MAPPED_S, level)?.surface(wanted)?)
    };
    let surfaces = Arc::new(Level::ALL.into_iter().map(map).collect::<Result<Vec<_>, _>>()?);
    *MAPPED.lock().unwrap_or_else(PoisonError::into_inner) = Some((wanted, Arc::clone(&surfaces)));
    Ok(surfaces)
}

/// Largest cost that pictures of surfaces show; flights right over the station cost up to some hundred.
pub(super) const CEILING: f64 = 100.0;
