//! The virtual support test: an airframe on three scales, in several orientations.
//!
//! Statics of a body on three points in a nearly level plane: the forces, all along gravity, are the weight times the
//! barycentric coordinates of the point where the vertical through the centre of mass meets the plane,
//! `F_i = m g λ_i`, `Σ λ_i p_i = r − n̂_g (n · (r − p_1))/(n · n̂_g)`, `Σ λ_i = 1`.

use super::{Generator, Sensor, SensorError};
use crate::centre_of_mass::Placing;
use nalgebra::{Matrix3, Unit, Vector3};
use quad_dynamics::Vehicle;
use rand_distr::{Distribution, StandardNormal};
use serde::{Deserialize, Serialize};

/// Scales, position measurement and the care with which they are set up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SupportRig {
    /// The three scales, N. Each is read unloaded before a placing, and that reading subtracted.
    pub scales_n: [Sensor; 3],
    /// Measurement of one coordinate of a support point, along airframe axes, m.
    pub position_m: Sensor,
    /// Standard deviation of the plane's slope, about each of two axes, from placing to placing, rad.
    pub levelling_rad: f64,
    /// Placings in each orientation, each set up anew.
    pub placings: u32,
}

impl Default for SupportRig {
    /// Scales of 20 N that read to 0.01 N (one gram) with biases, points measured to 0.5 mm, levelled to 0.1°: assumed.
    fn default() -> Self {
        let scale = |bias| Sensor {
            noise: 0.01,
            bias,
            quantum: 0.01,
            minimum: -1.0,
            maximum: 20.0,
        };
        Self {
            scales_n: [scale(0.12), scale(-0.07), scale(0.04)],
            position_m: Sensor {
                noise: 5e-4,
                quantum: 1e-4,
                ..Sensor::PERFECT
            },
            levelling_rad: 1.7e-3,
            placings: 5,
        }
    }
}

/// Why a support test cannot be done.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SupportError {
    /// A sensor's numbers are wrong.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// The vertical through the centre of mass misses the support triangle.
    #[error(
        "orientation {orientation}: support {support} would have to pull with {force_n:.3} N: the airframe tips over"
    )]
    TipsOver {
        /// Orientation, counted from 0.
        orientation: usize,
        /// Support, 1 to 3.
        support: usize,
        /// Its force, N, negative.
        force_n: f64,
    },
    /// The points of a support triangle lie in a row.
    #[error("orientation {orientation}: the supports are collinear")]
    InARow {
        /// Orientation, counted from 0.
        orientation: usize,
    },
    /// Slope not finite or negative.
    #[error("the standard deviation of the slope must be finite and not negative, got {levelling_rad} rad")]
    Levelling {
        /// The value, rad.
        levelling_rad: f64,
    },
}

/// Three points of the airframe on which it can stand, m along airframe axes.
pub type Triangle = [Vector3<f64>; 3];

/// The 20 faces of a cage in the shape of an icosahedron with this circumscribed radius, m.
///
/// A stand-in for the protective cage, whose dimensions are not published: any rigid set of points serves the method.
/// On the first face the vehicle stands upright, a vertex forward; the others follow in the order of their tilt: three at 41.8°, six
/// at 70.5° and so on.
pub fn icosahedral_cage(radius_m: f64) -> Vec<Triangle> {
    let phi = 0.5 * (1.0 + 5_f64.sqrt());
    let mut vertices = Vec::new();
    for a in [-1.0, 1.0] {
        for b in [-phi, phi] {
            vertices.extend([
                Vector3::new(0.0, a, b),
                Vector3::new(a, b, 0.0),
                Vector3::new(b, 0.0, a),
            ]);
        }
    }
    // Edges are 2 long, the next longer diagonals 2 φ.
    let adjacent = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < 2.5;
    let mut faces = Vec::new();
    for (i, a) in vertices.iter().enumerate() {
        for (j, b) in vertices[..i].iter().enumerate().filter(|(_, b)| adjacent(a, b)) {
            let third = vertices[..j].iter().filter(|c| adjacent(a, c) && adjacent(b, c));
            faces.extend(third.map(|c| [*a, *b, *c].map(|v| v.normalize() * radius_m)));
        }
    }
    stood_upright(faces)
}

/// The faces turned so that one is level at the bottom with a vertex forward, in the order of their height above it.
fn stood_upright(mut faces: Vec<Triangle>) -> Vec<Triangle> {
    let centroid = |face: &Triangle| face.iter().sum::<Vector3<f64>>() / 3.0;
    let Some(first) = faces.first().copied() else {
        return faces;
    };
    let down = centroid(&first).normalize();
    let ahead = (first[0] - down * down.dot(&first[0])).normalize();
    // Rows: the new axes along the old ones.
    let turn = Matrix3::from_rows(&[
        ahead.transpose(),
        down.cross(&ahead).transpose(),
        down.transpose(),
    ]);
    for point in faces.iter_mut().flatten() {
        *point = turn * *point;
    }
    // In millionths of the radius, so that rounding does not decide between faces of equal height.
    let radius = first[0].norm();
    faces.sort_by_key(|face| (-1e6 * centroid(face).z / radius).round() as i64);
    faces
}

/// Forces of three supports, N, on a body of this weight whose centre of mass is at `centre`, gravity along `down`.
pub fn support_forces(
    triangle: &Triangle,
    centre: &Vector3<f64>,
    weight_n: f64,
    down: &Vector3<f64>,
) -> Option<[f64; 3]> {
    let [a, b, c] = triangle;
    // Σ λ_i p_i + s n̂_g = r with λ_1 = 1 − λ_2 − λ_3.
    let columns = Matrix3::from_columns(&[b - a, c - a, *down]);
    let solved = columns.lu().solve(&(centre - a))?;
    Some([1.0 - solved.x - solved.y, solved.x, solved.y].map(|share| share * weight_n))
}

impl SupportRig {
    /// Places a vehicle on each triangle the given number of times and reads the instruments. Positions are along the airframe's
    /// geometric axes, in which [`quad_dynamics::vehicle::Airframe::centre_of_mass`] is given.
    ///
    /// # Errors
    /// Wrong sensors, supports in a row, a vehicle that tips over.
    pub fn measure(
        &self,
        vehicle: &Vehicle,
        triangles: &[Triangle],
        generator: &mut Generator,
    ) -> Result<Vec<Placing>, SupportError> {
        for sensor in self.scales_n.iter().chain([&self.position_m]) {
            sensor.validate()?;
        }
        if !(self.levelling_rad.is_finite() && self.levelling_rad >= 0.0) {
            return Err(SupportError::Levelling {
                levelling_rad: self.levelling_rad,
            });
        }
        let mut placings = Vec::new();
        for (orientation, triangle) in triangles.iter().enumerate() {
            for _ in 0..self.placings {
                let forces = self.forces(vehicle, orientation, triangle, generator)?;
                let points = triangle.map(|p| p.map(|x| self.position_m.read(x, generator)));
                placings.push(Placing::new(orientation as u32, &points, &forces));
            }
        }
        Ok(placings)
    }

    /// Forces as read, N: loaded less unloaded reading.
    fn forces(
        &self,
        vehicle: &Vehicle,
        orientation: usize,
        triangle: &Triangle,
        generator: &mut Generator,
    ) -> Result<[f64; 3], SupportError> {
        let [a, b, c] = triangle;
        let normal = Unit::try_new((b - a).cross(&(c - a)), f64::EPSILON)
            .ok_or(SupportError::InARow { orientation })?;
        let along = (b - a).normalize();
        let mut slope = || -> f64 {
            let unit: f64 = StandardNormal.sample(generator);
            self.levelling_rad * unit
        };
        let down = normal.into_inner() + along * slope() + normal.cross(&along) * slope();
        let truth = support_forces(
            triangle,
            &vehicle.airframe.centre_of_mass,
            vehicle.weight(),
            &down.normalize(),
        )
        .ok_or(SupportError::InARow { orientation })?;
        if let Some(i) = truth.iter().position(|f| *f < 0.0) {
            return Err(SupportError::TipsOver {
                orientation,
                support: i + 1,
                force_n: truth[i],
            });
        }
        Ok(std::array::from_fn(|i| {
            let unloaded = self.scales_n[i].read(0.0, generator);
            self.scales_n[i].read(truth[i], generator) - unloaded
        }))
    }
}
