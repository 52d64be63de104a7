//! The laser beam: Gaussian, its waist at the emitter.
//!
//! `I(ρ, z) = 2P/(πw²) exp(−2ρ²/w²) exp(−βz)`, `w² = w_0² + (θz)²`, ρ from the axis, z along it.
//!
//! A perfect beam of waist w_0 diverges by `θ = λ/(πw_0)`; a real one by M² times that, so
//! `M² = πw_0θ/λ ≥ 1` is checked where a station is read. Assumptions: fundamental mode, axis of the beam along the
//! platform's x, no turbulence. Source: Siegman, *Lasers*, 1986, ch. 17; Beer-Lambert in [`crate::Atmosphere`].

use crate::atmosphere::Atmosphere;
use nalgebra::Vector3;
use quad_math::{Real, constant};
use std::f64::consts::PI;

/// A laser beam as it leaves the emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam<R> {
    /// Optical power P, W.
    pub power: R,
    /// Wavelength λ, m.
    pub wavelength: R,
    /// Radius w_0 at the waist, where the irradiance is 1/e² of that on the axis, m.
    pub waist_radius: R,
    /// Divergence θ far away, half angle to 1/e², rad.
    pub divergence: R,
    /// Where it leaves, in E from the crossing of the gimbal's axes, m.
    pub offset: [R; 3],
}

/// The beam's axis in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<R: Real> {
    /// The emitter in W, m.
    pub origin: Vector3<R>,
    /// Direction of the light in W, a unit vector.
    pub direction: Vector3<R>,
}

/// A beam in air: what the irradiance follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light<R> {
    /// Optical power at the emitter, W.
    pub power: R,
    /// Square of the waist radius, m².
    pub waist_squared: R,
    /// Square of the divergence, rad².
    pub divergence_squared: R,
    /// Attenuation of the air, 1/m.
    pub attenuation: R,
}

impl Beam<f64> {
    /// The same beam over another scalar.
    pub fn over<R: Real>(&self) -> Beam<R> {
        Beam {
            power: constant(self.power),
            wavelength: constant(self.wavelength),
            waist_radius: constant(self.waist_radius),
            divergence: constant(self.divergence),
            offset: self.offset.map(constant),
        }
    }
}

impl<R: Real> Beam<R> {
    /// Beam quality `M² = πw_0θ/λ`, 1 for a perfect beam.
    pub fn quality(&self) -> R {
        self.waist_radius * self.divergence * constant(PI) / self.wavelength
    }

    /// The beam in this air.
    #[inline(always)]
    pub fn through(&self, air: &Atmosphere<R>) -> Light<R> {
        Light {
            power: self.power,
            waist_squared: self.waist_radius * self.waist_radius,
            divergence_squared: self.divergence * self.divergence,
            attenuation: air.attenuation(self.wavelength),
        }
    }
}

impl<R: Real> Light<R> {
    /// `w²` at a distance z along the axis (m), m².
    #[inline(always)]
    pub fn radius_squared(&self, z: R) -> R {
        self.waist_squared + self.divergence_squared * z * z
    }

    /// `w'/w = θ²z/w²`, 1/m: how far a streamline leaves the axis per length and per distance from it.
    #[inline(always)]
    pub fn spread(&self, z: R) -> R {
        self.divergence_squared * z / self.radius_squared(z)
    }

    /// Irradiance across the beam at the squared distance ρ² (m²) from the axis and z (m) along it, W/m².
    #[inline(always)]
    pub fn irradiance(&self, rho_squared: R, z: R) -> R {
        let w2 = self.radius_squared(z);
        let exponent = -(rho_squared * constant(2.0) / w2 + self.attenuation * z);
        self.power * constant(2.0 / PI) / w2 * exponent.simd_exp()
    }

    /// Power that is left at z (m) along the axis, W.
    #[inline(always)]
    pub fn power_at(&self, z: R) -> R {
        self.power * (-self.attenuation * z).simd_exp()
    }
}
