//! A scene guessed from the channels of a recording.

use crate::columns::Columns;
use crate::scene::{NOMINAL_ARM_M, Scene};
use ets::Station;
use nalgebra::Vector3;
use sifre::Recording;

/// Rows at which it is asked which agent is nearest to a station's recorded target.
const ROWS_ASKED: usize = 50;

impl Scene {
    /// Guesses the agents from what is recorded of them: who has an attitude is a quadrotor, who has a gimbal is a ground
    /// station, who has a position alone is a target. A station tracks whoever stays nearest to its recorded target.
    ///
    /// What is not recorded is taken as nominal: a quadrotor's arm ([`NOMINAL_ARM_M`]), a station's lens, beam, receiver, limits
    /// and, if it has no channels `position` and `heading`, its place ([`Station::nominal`]). [`crate::html`] refuses a
    /// place that does not agree with the recorded ranges.
    pub fn from_recording(recording: &Recording) -> Self {
        let names: Vec<&str> = recording.channels().iter().map(|c| c.name.as_str()).collect();
        let of =
            |ending: &str| -> Vec<&str> { names.iter().filter_map(|n| n.strip_suffix(ending)).collect() };
        let (stations, flying, placed) = (of(".gimbal.pan"), of(".attitude.roll"), of(".position.x"));
        let mut scene = Self::new("Recorded flight");
        for name in &placed {
            let is_reference = name
                .strip_suffix(".reference")
                .is_some_and(|owner| placed.contains(&owner));
            scene = if flying.contains(name) {
                scene.quadrotor(*name, NOMINAL_ARM_M)
            } else if is_reference || stations.contains(name) {
                scene
            } else {
                scene.target(*name)
            };
        }
        let candidates: Vec<String> = scene.agents.iter().map(|agent| agent.name.clone()).collect();
        for name in stations {
            let mut station = Station::nominal();
            place(&mut station, name, recording);
            if let Some(tracks) = nearest(name, &candidates, recording) {
                scene = scene.ets(name, tracks, &station);
            }
        }
        scene
    }
}

/// Takes up where the station stands, if that is recorded.
fn place(station: &mut Station, name: &str, recording: &Recording) {
    let first = |channel: &str| recording.column(&format!("{name}.{channel}"))?.next();
    if let (Some(x), Some(y), Some(z), Some(heading)) = (
        first("position.x"),
        first("position.y"),
        first("position.z"),
        first("heading"),
    ) {
        station.pedestal.position = [x, y, z];
        station.pedestal.heading = heading;
    }
}

/// Who is nearest to the station's recorded target, on average; the first one if no target is recorded.
fn nearest<'a>(station: &str, candidates: &'a [String], recording: &Recording) -> Option<&'a String> {
    let columns = Columns::thinned(recording, ROWS_ASKED);
    let path = |name: &str| -> Option<Vec<Vector3<f64>>> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| columns.get(&format!("{name}.{axis}")));
        let (x, y, z) = (x?, y?, z?);
        Some((0..x.len()).map(|k| Vector3::new(x[k], y[k], z[k])).collect())
    };
    let Some(aim) = path(&format!("{station}.target")) else {
        return candidates.first();
    };
    let miss = |name: &String| {
        path(&format!("{name}.position")).map_or(f64::INFINITY, |p| {
            p.iter().zip(&aim).map(|(a, b)| (a - b).norm()).sum()
        })
    };
    candidates.iter().min_by(|a, b| miss(a).total_cmp(&miss(b)))
}
