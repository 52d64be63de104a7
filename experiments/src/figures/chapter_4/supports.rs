//! The support test of this chapter: the vehicle's cage on three scales, in two orientations.

use super::bench;
use crate::data::{Cell, DataTable};
use crate::item::{Context, ItemError};
use crate::plot::Space;
use crate::plot::space::{Point3, View};
use crate::vehicle::NOMINAL_VEHICLE;
use nalgebra::Vector3;
use quad_dynamics::Vehicle;
use serde::Serialize;
use std::ops::RangeInclusive;
use sysid::centre_of_mass::{CentreOfMass, Placing, locate};
use sysid::laboratory::supports::{SupportRig, Triangle, icosahedral_cage};
use sysid::laboratory::{Sensor, generator};

/// Seed of the test.
const SEED: u64 = 4;
/// Circumscribed radius of the cage, m: about the size of the vehicle, assumed.
pub(super) const CAGE_RADIUS_M: f64 = 0.35;
/// Faces of the cage on which the vehicle stands: upright, and tilted by 70.5°.
const FACES: [usize; 2] = [0, 5];

/// From where figures 4.3 and 4.4 are seen: neither line along the other, no support before another.
pub(super) const VIEW: View = View {
    azimuth_deg: -42.0,
    elevation_deg: 24.0,
};

/// Everything that determines the test.
#[derive(Serialize)]
pub(super) struct Settings {
    vehicle: &'static str,
    centre_of_mass_m: [f64; 3],
    cage_radius_m: f64,
    faces: [usize; 2],
    seed: u64,
    rig: SupportRig,
}

/// Placings on a rig and the centre of mass from them.
pub(super) struct SupportTest {
    pub(super) settings: Settings,
    pub(super) vehicle: Vehicle,
    pub(super) placings: Vec<Placing>,
    pub(super) found: CentreOfMass,
}

/// The support triangles of both orientations.
pub(super) fn triangles() -> [Triangle; 2] {
    let cage = icosahedral_cage(CAGE_RADIUS_M);
    FACES.map(|face| cage[face])
}

/// The rig without imperfections, one placing per orientation.
pub(super) fn perfect_rig() -> SupportRig {
    SupportRig {
        scales_n: [Sensor::PERFECT; 3],
        position_m: Sensor::PERFECT,
        levelling_rad: 0.0,
        placings: 1,
    }
}

/// Does the test.
pub(super) fn test(context: &Context, rig: SupportRig) -> Result<SupportTest, ItemError> {
    let vehicle = bench::vehicle(context)?;
    let placings = rig.measure(&vehicle, &triangles(), &mut generator(SEED))?;
    let found = locate(&placings)?;
    Ok(SupportTest {
        settings: Settings {
            vehicle: NOMINAL_VEHICLE,
            centre_of_mass_m: bench::CENTRE_OF_MASS_M,
            cage_radius_m: CAGE_RADIUS_M,
            faces: FACES,
            seed: SEED,
            rig,
        },
        vehicle,
        placings,
        found,
    })
}

/// Tests with other noise that are counted.
pub(super) const COUNTED: u64 = 100;
/// Shares of 95 % intervals that a count of a hundred shows: three standard deviations (2.2 %) below, and none above.
pub(super) const EXPECTED: RangeInclusive<f64> = 0.88..=1.0;

/// Share of tests with other noise whose intervals contain the truth: of the weight, and of the centre of mass (300 intervals).
pub(super) struct Coverage {
    pub(super) weight: f64,
    pub(super) centre: f64,
}

/// Counts over [`COUNTED`] tests.
pub(super) fn coverage(context: &Context) -> Result<Coverage, ItemError> {
    let vehicle = bench::vehicle(context)?;
    let truth = vehicle.airframe.centre_of_mass;
    let weight = vehicle.airframe.mass * vehicle.environment.gravity;
    let (mut of_weight, mut of_centre) = (0_u32, 0_u32);
    for repetition in 1..=COUNTED {
        let noise = &mut generator(SEED + 100 * repetition);
        let placings = SupportRig::default().measure(&vehicle, &triangles(), noise)?;
        let found = locate(&placings)?;
        of_weight += u32::from(found.weight.interval().contains(weight));
        let inside = (0..3).filter(|&i| found.position[i].interval().contains(truth[i]));
        of_centre += inside.count() as u32;
    }
    Ok(Coverage {
        weight: f64::from(of_weight) / COUNTED as f64,
        centre: f64::from(of_centre) / (3 * COUNTED) as f64,
    })
}

/// The placings in the columns that [`Placing`] reads.
pub(super) fn table(placings: &[Placing]) -> DataTable {
    let mut columns = vec!["orientation".to_owned()];
    for i in 1..=3 {
        columns.extend(["x", "y", "z"].map(|axis| format!("{axis}_{i}_m")));
        columns.push(format!("force_{i}_n"));
    }
    let mut data = DataTable::new(columns);
    for placing in placings {
        let mut row = vec![Cell::Number(f64::from(placing.orientation))];
        for (point, force) in placing.points().iter().zip(placing.forces()) {
            row.extend(point.iter().chain([&force]).map(|value| Cell::Number(*value)));
        }
        data.rows.push(row);
    }
    data
}

/// A point of the airframe in a picture with right-handed axes forward, left, up, in millimetres.
pub(super) fn pictured(p: &Vector3<f64>) -> Point3 {
    Space::of_z_down(1e3 * p.x, 1e3 * p.y, 1e3 * p.z)
}

/// The twelve edges of the box of half sides `reach` about a point.
pub(super) fn box_edges(centre: &Vector3<f64>, reach: &Vector3<f64>) -> Vec<[Vector3<f64>; 2]> {
    let corner = |k: usize| {
        let side = |axis: usize| if k >> axis & 1 == 1 { 1.0 } else { -1.0 };
        centre + reach.component_mul(&Vector3::from_fn(|axis, _| side(axis)))
    };
    let edges = (0..8).flat_map(|k| (0..3).map(move |axis| (k, k | 1 << axis)));
    edges
        .filter(|(from, to)| from != to)
        .map(|(from, to)| [corner(from), corner(to)])
        .collect()
}
