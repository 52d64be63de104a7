//! Wind shear: a mean wind that grows with height.
//!
//! ```text
//! logarithmic   V(h) = V_ref ln(h/z_0) / ln(h_ref/z_0)
//! power         V(h) = V_ref (h/h_ref)^α
//! ```
//!
//! Valid in a neutral surface layer, from a few roughness lengths z_0 to some 300 m; below z_0 the logarithmic wind is nought
//! (kink), below the ground both are. Source: MIL-F-8785C, 1980, section 3.7.3.4 (logarithmic; reference height 20 ft, z_0
//! 0.15 ft for take-off and landing, 2 ft elsewhere); the power law: Simiu and Scanlan, Wind Effects on Structures, 1996 (α 1/7
//! over open ground).

use quad_math::{Real, constant};
use serde::{Deserialize, Serialize};

/// Least height over the reference height that the power law is evaluated at.
const LOWEST: f64 = 1e-12;

/// How the wind grows with height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "law", deny_unknown_fields)]
pub enum ShearProfile {
    /// By the logarithm of the height.
    Logarithmic {
        /// Roughness length z_0, m.
        roughness_m: f64,
    },
    /// By a power of the height.
    Power {
        /// Exponent α, dimensionless.
        exponent: f64,
    },
}

/// A profile of the mean wind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shear {
    /// Its law.
    pub profile: ShearProfile,
    /// Height h_ref above the ground, m, at which the mean wind is as stated (default: 20 ft).
    #[serde(default = "Shear::default_reference")]
    pub reference_height_m: f64,
}

/// Why a wind can't be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShearError {
    /// A roughness that is not positive and below the reference height.
    #[error(
        "the roughness length must lie above 0 and below the reference height, {reference_height_m} m, got {roughness_m} m"
    )]
    Roughness {
        /// Roughness length, m.
        roughness_m: f64,
        /// Reference height, m.
        reference_height_m: f64,
    },
    /// An exponent outside 0 to 1.
    #[error(
        "the exponent of the wind's power law must lie in 0 to 1 (0.143 for open ground), got {exponent}"
    )]
    Exponent {
        /// Exponent.
        exponent: f64,
    },
    /// A height that is not above the ground.
    #[error(
        "the wind's reference height must be positive (usually 20 ft = 6.096 m), got {reference_height_m} m"
    )]
    Height {
        /// Reference height, m.
        reference_height_m: f64,
    },
}

impl Shear {
    /// 20 ft, m.
    pub const USUAL_REFERENCE_HEIGHT_M: f64 = 6.096;

    const fn default_reference() -> f64 {
        Self::USUAL_REFERENCE_HEIGHT_M
    }

    /// Checks its numbers.
    ///
    /// # Errors
    /// [`ShearError`] with the number.
    pub fn check(&self) -> Result<(), ShearError> {
        let reference_height_m = self.reference_height_m;
        if !(reference_height_m.is_finite() && reference_height_m > 0.0) {
            return Err(ShearError::Height { reference_height_m });
        }
        match self.profile {
            ShearProfile::Logarithmic { roughness_m }
                if !(roughness_m > 0.0 && roughness_m < reference_height_m) =>
            {
                Err(ShearError::Roughness {
                    roughness_m,
                    reference_height_m,
                })
            }
            ShearProfile::Power { exponent } if !(exponent > 0.0 && exponent <= 1.0) => {
                Err(ShearError::Exponent { exponent })
            }
            _ => Ok(()),
        }
    }

    /// Wind at a height above the ground, m, over the wind at the reference height.
    pub fn gain<R: Real>(&self, height: R) -> R {
        match self.profile {
            ShearProfile::Logarithmic { roughness_m } => {
                let ratio = (height / constant(roughness_m)).simd_max(R::one());
                ratio.simd_ln() / constant((self.reference_height_m / roughness_m).ln())
            }
            ShearProfile::Power { exponent } => {
                // The root's slope is infinite on the ground: dual numbers stay off it.
                let ratio = height / constant(self.reference_height_m);
                let power = ratio.simd_max(constant(LOWEST)).simd_powf(constant(exponent));
                R::zero().select(height.simd_le(R::zero()), power)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn logarithmic() -> Shear {
        Shear {
            profile: ShearProfile::Logarithmic { roughness_m: 0.6096 },
            reference_height_m: 6.096,
        }
    }

    /// z_0 = h_ref/10: the wind is nought at z_0, one at h_ref, two at 10 h_ref, and ln 5/ln 10 half way up.
    #[test]
    fn exact_logarithmic_profile() {
        let gain = |h: f64| logarithmic().gain(h);
        for (height, expected) in [
            (0.6096, 0.0),
            (6.096, 1.0),
            (60.96, 2.0),
            (3.048, 0.698_970_004_336),
        ] {
            assert_relative_eq!(gain(height), expected, epsilon = 1e-12);
        }
        for below in [0.1, 0.0, -5.0] {
            assert_eq!(gain(below), 0.0);
        }
    }

    #[test]
    fn exact_power_profile() {
        let shear = Shear {
            profile: ShearProfile::Power { exponent: 0.5 },
            reference_height_m: 4.0,
        };
        for (height, expected) in [(0.0, 0.0), (1.0, 0.5), (4.0, 1.0), (16.0, 2.0), (-1.0, 0.0)] {
            assert_relative_eq!(shear.gain::<f64>(height), expected, epsilon = 1e-15);
        }
    }

    #[test]
    fn exact_wrong_profiles_are_errors() {
        let with = |profile, reference_height_m| {
            Shear {
                profile,
                reference_height_m,
            }
            .check()
        };
        let rough = |roughness_m| ShearProfile::Logarithmic { roughness_m };
        assert!(logarithmic().check().is_ok());
        for bad in [0.0, -1.0, 7.0, f64::NAN] {
            assert!(
                matches!(with(rough(bad), 6.0), Err(ShearError::Roughness { .. })),
                "{bad}"
            );
        }
        let message = with(rough(0.1), -20.0).unwrap_err().to_string();
        assert!(
            message.contains("-20 m") && message.contains("must be positive"),
            "{message}"
        );
        assert!(matches!(
            with(ShearProfile::Power { exponent: 2.0 }, 6.0),
            Err(ShearError::Exponent { .. })
        ));
    }
}
