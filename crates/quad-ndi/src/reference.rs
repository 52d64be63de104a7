//! What a controller is asked to do: flat outputs with their derivatives, and the attitude they imply.
//!
//! The flat outputs of a quadrotor are `y = [x, y, z, ψ]`: position and heading with their derivatives
//! fix everything else. From the acceleration follows the tilt that makes it,
//!
//! ```text
//! exact          θ = atan(−a'_x / (g − a_z)),  φ = atan(a'_y / √(a'_x² + (g − a_z)²))
//! small angles   θ = −a'_x / g,                φ = a'_y / g
//! ```
//!
//! with `a'` the acceleration along heading axes (`a'_x` forward, `a'_y` right), and from its derivatives
//! follow the rates of that tilt. Drag is not part of it. Source: thesis chapters 6.3 and 7.4.2 (that the
//! trajectory's derivatives are fed forward); Mellinger and Kumar, ICRA 2011 (flatness).

use nalgebra::Vector3;
use quad_kinematics::EulerAngles;
use quad_math::{Real, constant};

/// Position and heading with their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatOutput<R: Real> {
    /// Position in W, m.
    pub position: Vector3<R>,
    /// Velocity in W, m/s.
    pub velocity: Vector3<R>,
    /// Acceleration in W, m/s².
    pub acceleration: Vector3<R>,
    /// Third derivative of the position, m/s³.
    pub jerk: Vector3<R>,
    /// Fourth derivative of the position, m/s⁴.
    pub snap: Vector3<R>,
    /// Fifth derivative of the position, m/s⁵.
    pub crackle: Vector3<R>,
    /// Heading ψ, rad.
    pub yaw: R,
    /// ψ̇, rad/s.
    pub yaw_rate: R,
    /// ψ̈, rad/s².
    pub yaw_acceleration: R,
    /// Third derivative of ψ, rad/s³.
    pub yaw_jerk: R,
}

/// Rates of the attitude that a flat output implies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeFeedForward<R: Real> {
    /// `[φ̇, θ̇, ψ̇]`, rad/s.
    pub rates: Vector3<R>,
    /// `[φ̈, θ̈, ψ̈]`, rad/s².
    pub accelerations: Vector3<R>,
    /// Third derivatives of `[φ, θ, ψ]`, rad/s³.
    pub jerks: Vector3<R>,
}

/// What a controller is asked to do at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference<R: Real> {
    /// Where to be and how to move.
    pub flat: FlatOutput<R>,
    /// How the attitude moves along with it.
    pub attitude: AttitudeFeedForward<R>,
}

/// How accelerations and tilt go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TiltLaw {
    /// `θ = −a'_x / g`, as level 1 has it.
    SmallAngle,
    /// The exact law, as levels 2 and up have it.
    Exact,
}

impl<R: Real> FlatOutput<R> {
    /// Rest at a position in W, m, heading ψ, rad.
    pub fn at_rest(position: Vector3<R>, yaw: R) -> Self {
        let (o, none) = (Vector3::zeros(), R::zero());
        Self {
            position,
            velocity: o,
            acceleration: o,
            jerk: o,
            snap: o,
            crackle: o,
            yaw,
            yaw_rate: none,
            yaw_acceleration: none,
            yaw_jerk: none,
        }
    }
}

impl<R: Real> FlatOutput<R> {
    /// The attitude η = [φ, θ, ψ] that the path implies in gravity `g`, m/s².
    pub fn attitude(&self, gravity: R, law: TiltLaw) -> EulerAngles<R> {
        let (roll, pitch) = tilt(self, gravity, law);
        EulerAngles::new(roll.0[0], pitch.0[0], self.yaw)
    }
}

impl<R: Real> Reference<R> {
    /// Hold a position in W, m, heading ψ, rad.
    pub fn hold(position: Vector3<R>, yaw: R) -> Self {
        let o = Vector3::zeros();
        Self {
            flat: FlatOutput::at_rest(position, yaw),
            attitude: AttitudeFeedForward {
                rates: o,
                accelerations: o,
                jerks: o,
            },
        }
    }

    /// Follow a flat output in gravity `g`, m/s², feeding forward the rates of the attitude it implies.
    pub fn following(flat: FlatOutput<R>, gravity: R, law: TiltLaw) -> Self {
        let (roll, pitch) = tilt(&flat, gravity, law);
        Self {
            flat,
            attitude: AttitudeFeedForward {
                rates: Vector3::new(roll.0[1], pitch.0[1], flat.yaw_rate),
                accelerations: Vector3::new(roll.0[2], pitch.0[2], flat.yaw_acceleration),
                jerks: Vector3::new(roll.0[3], pitch.0[3], flat.yaw_jerk),
            },
        }
    }
}

/// Roll and pitch, each with three time derivatives, that make the acceleration of a flat output.
fn tilt<R: Real>(flat: &FlatOutput<R>, gravity: R, law: TiltLaw) -> (Jet<R>, Jet<R>) {
    let axis = |i: usize| Jet([flat.acceleration[i], flat.jerk[i], flat.snap[i], flat.crackle[i]]);
    let (sin, cos) = Jet([flat.yaw, flat.yaw_rate, flat.yaw_acceleration, flat.yaw_jerk]).sin_cos();
    let forward = axis(0) * cos + axis(1) * sin;
    let right = axis(1) * cos - axis(0) * sin;
    match law {
        TiltLaw::SmallAngle => {
            let scale = R::one() / gravity;
            (right.scaled(scale), forward.scaled(-scale))
        }
        TiltLaw::Exact => {
            let mut up = axis(2).scaled(-R::one());
            up.0[0] += gravity;
            let pitch = (forward.scaled(-R::one()) * up.recip()).atan();
            let roll = (right * (forward * forward + up * up).sqrt().recip()).atan();
            (roll, pitch)
        }
    }
}

/// A function of time by its value and first three derivatives: the little automatic differentiation
/// that feed-forward needs, over any scalar, lanes included.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Jet<R>([R; 4]);

impl<R: Real> Jet<R> {
    fn scaled(self, k: R) -> Self {
        Self(self.0.map(|x| x * k))
    }

    fn sin_cos(self) -> (Self, Self) {
        let [y, d1, d2, d3] = self.0;
        let (s, c) = y.simd_sin_cos();
        let three: R = constant(3.0);
        let (square, mixed, cube) = (d1 * d1, three * d1 * d2, d1 * d1 * d1);
        (
            Self([s, c * d1, c * d2 - s * square, c * d3 - s * mixed - c * cube]),
            Self([c, -s * d1, -s * d2 - c * square, -s * d3 - c * mixed + s * cube]),
        )
    }

    /// `1/f` from `f · (1/f) = 1`, differentiated.
    fn recip(self) -> Self {
        let [f, f1, f2, f3] = self.0;
        let (two, three): (R, R) = (constant(2.0), constant(3.0));
        let h = R::one() / f;
        let h1 = -f1 * h * h;
        let h2 = -(two * f1 * h1 + f2 * h) * h;
        let h3 = -(three * (f1 * h2 + f2 * h1) + f3 * h) * h;
        Self([h, h1, h2, h3])
    }

    /// `√f` from `√f · √f = f`, differentiated.
    fn sqrt(self) -> Self {
        let [f, f1, f2, f3] = self.0;
        let r = f.simd_sqrt();
        let half_inverse = constant::<R>(0.5) / r;
        let r1 = f1 * half_inverse;
        let r2 = (f2 - constant::<R>(2.0) * r1 * r1) * half_inverse;
        let r3 = (f3 - constant::<R>(6.0) * r1 * r2) * half_inverse;
        Self([r, r1, r2, r3])
    }

    /// `atan f` from `(atan f)' = f' / (1 + f²)`.
    fn atan(self) -> Self {
        let [f, f1, f2, f3] = self.0;
        let mut below = self * self;
        below.0[0] += R::one();
        let [g, g1, g2, _] = below.recip().0;
        let two = constant::<R>(2.0);
        Self([
            f.simd_atan(),
            f1 * g,
            f2 * g + f1 * g1,
            f3 * g + two * f2 * g1 + f1 * g2,
        ])
    }
}

impl<R: Real> std::ops::Add for Jet<R> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<R: Real> std::ops::Sub for Jet<R> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<R: Real> std::ops::Mul for Jet<R> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ([f, f1, f2, f3], [g, g1, g2, g3]) = (self.0, other.0);
        let (two, three): (R, R) = (constant(2.0), constant(3.0));
        Self([
            f * g,
            f1 * g + f * g1,
            f2 * g + two * f1 * g1 + f * g2,
            f3 * g + three * (f2 * g1 + f1 * g2) + f * g3,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual3_64;
    use proptest::prelude::*;

    /// The tilt law itself over num-dual's third-order numbers.
    fn tilt_by_dual(flat: &FlatOutput<f64>, g: f64) -> [Dual3_64; 2] {
        use num_dual::DualNum;
        let a = |i: usize| Dual3_64::new(flat.acceleration[i], flat.jerk[i], flat.snap[i], flat.crackle[i]);
        let psi = Dual3_64::new(flat.yaw, flat.yaw_rate, flat.yaw_acceleration, flat.yaw_jerk);
        let (s, c) = psi.sin_cos();
        let (forward, right, up) = (a(0) * c + a(1) * s, a(1) * c - a(0) * s, -a(2) + g);
        [
            (right / (forward * forward + up * up).sqrt()).atan(),
            (-forward / up).atan(),
        ]
    }

    proptest! {
        #[test]
        fn agree_feed_forward_with_automatic_differentiation(
            v in proptest::collection::vec(-3.0..3.0, 16),
        ) {
            let at = |i: usize| Vector3::new(v[i], v[i + 1], v[i + 2]);
            let flat = FlatOutput {
                acceleration: at(0), jerk: at(3), snap: at(6), crackle: at(9),
                yaw: v[12], yaw_rate: v[13], yaw_acceleration: v[14], yaw_jerk: v[15],
                ..FlatOutput::at_rest(Vector3::zeros(), 0.0)
            };
            let ours = Reference::following(flat, 9.81, TiltLaw::Exact).attitude;
            for (i, dual) in tilt_by_dual(&flat, 9.81).into_iter().enumerate() {
                // Rounding of some tens of operations on numbers up to a hundred.
                prop_assert!((ours.rates[i] - dual.v1).abs() < 1e-12);
                prop_assert!((ours.accelerations[i] - dual.v2).abs() < 1e-11);
                prop_assert!((ours.jerks[i] - dual.v3).abs() < 1e-10);
            }
        }
    }
}
