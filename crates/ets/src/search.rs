//! Search for a lost target: a spiral about the last predicted line of sight, out and in again without end.
//!
//! At time t since the search began, pan and tilt are off the centre by `ρ (cos φ, sin φ)` with `ρ = ρ_max sin(ω_ρ t)`,
//! `φ = ω_φ t`, `ω_φ = v/ρ_max` and `ω_ρ = p ω_φ / 2πρ_max`: the fastest turn has speed v, and neighbouring turns are at most the
//! pitch p apart, which must be below the field of view for a search without gaps. *Choice*: the thesis does not say.
//!
//! Validity: centres away from the zenith, since an offset in pan is shortened there by the cosine of the tilt.

use crate::scalar::root;
use nalgebra::Vector3;
use quad_math::{Real, atan2, constant};
use std::f64::consts::TAU;

/// A spiral search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search<R> {
    /// Largest angle ρ_max from the centre, rad.
    pub radius: R,
    /// Distance p of neighbouring turns, rad.
    pub pitch: R,
    /// Speed v of the line of sight on the outermost turn, rad/s.
    pub speed: R,
}

impl Search<f64> {
    /// The same search over another scalar.
    pub fn over<R: Real>(&self) -> Search<R> {
        Search {
            radius: constant(self.radius),
            pitch: constant(self.pitch),
            speed: constant(self.speed),
        }
    }

    /// Time of one way from the centre to the largest angle, s: a quarter of the period of ρ.
    pub fn sweep_time(&self) -> f64 {
        let turn = self.speed / self.radius;
        (TAU / 4.0) / (self.pitch * turn / (TAU * self.radius))
    }
}

impl<R: Real> Search<R> {
    /// The direction in W, a unit vector, to look in at `time` (s) since the search about `centre` (W) began.
    #[inline(always)]
    pub fn direction(&self, centre: &Vector3<R>, time: R) -> Vector3<R> {
        let turn = self.speed / self.radius;
        let swing = self.pitch * turn / (self.radius * constant(TAU));
        let rho = self.radius * (swing * time).simd_sin();
        let (s, c) = (turn * time).simd_sin_cos();
        let azimuth = atan2(centre.y, centre.x) + rho * c;
        let horizontal = root(centre.x * centre.x + centre.y * centre.y);
        let elevation = atan2(-centre.z, horizontal) + rho * s;
        let ((s_a, c_a), (s_e, c_e)) = (azimuth.simd_sin_cos(), elevation.simd_sin_cos());
        Vector3::new(c_e * c_a, c_e * s_a, -s_e)
    }
}
