//! The equation of motion of the bifilar pendulum (see the module above for its derivation).

use super::Suspension;
use quad_math::{Flat, Rate, Real, State, System, constant};

/// A bifilar pendulum: suspension, moment of inertia and damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum<R: Real> {
    /// The suspension.
    pub suspension: Suspension,
    /// Moment of inertia I about the vertical axis through the centre of mass, kg m².
    pub inertia: R,
    /// Viscous damping c, N m s/rad.
    pub viscous: R,
    /// Quadratic damping d, N m s²/rad². Kink: the second derivative of the moment jumps at rest.
    pub quadratic: R,
}

/// Angle and rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing<R: Real> {
    /// θ from rest, rad.
    pub angle: R,
    /// θ̇, rad/s.
    pub rate: R,
}

/// Rate of change of a [`Swing`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingRate<R: Real> {
    /// θ̇, rad/s.
    pub rate: R,
    /// θ̈, rad/s².
    pub acceleration: R,
}

impl<R: Real> Rate<R> for SwingRate<R> {
    fn zero() -> Self {
        Self {
            rate: R::zero(),
            acceleration: R::zero(),
        }
    }

    fn add_scaled(&self, h: R, other: &Self) -> Self {
        Self {
            rate: self.rate + h * other.rate,
            acceleration: self.acceleration + h * other.acceleration,
        }
    }
}

impl<R: Real> State<R> for Swing<R> {
    type Rate = SwingRate<R>;

    fn advanced(&self, h: R, rate: &SwingRate<R>) -> Self {
        Self {
            angle: self.angle + h * rate.rate,
            rate: self.rate + h * rate.acceleration,
        }
    }
}

impl<R: Real> Flat<R> for Swing<R> {
    const LEN: usize = 2;

    fn write(&self, out: &mut [R]) {
        out[..2].copy_from_slice(&[self.angle, self.rate]);
    }

    fn read(values: &[R]) -> Self {
        Self {
            angle: values[0],
            rate: values[1],
        }
    }
}

impl<R: Real> Flat<R> for SwingRate<R> {
    const LEN: usize = 2;

    fn write(&self, out: &mut [R]) {
        out[..2].copy_from_slice(&[self.rate, self.acceleration]);
    }

    fn read(values: &[R]) -> Self {
        Self {
            rate: values[0],
            acceleration: values[1],
        }
    }
}

/// The rise of the body and its derivatives by the angle.
pub(crate) struct Rise<R> {
    /// z, m.
    pub(crate) height: R,
    /// z', m/rad.
    pub(crate) slope: R,
    /// z'', m/rad².
    pub(crate) curvature: R,
}

impl Suspension {
    /// z, z', z'' at an angle.
    pub(crate) fn rise<R: Real>(&self, angle: R) -> Rise<R> {
        let b2: R = constant(self.half_spacing_m.powi(2));
        let l: R = constant(self.length_m);
        let (sine, cosine) = angle.simd_sin_cos();
        let half_chord = (angle * constant(0.5)).simd_sin();
        let lift = b2 * half_chord * half_chord * constant(4.0);
        let h = (l * l - lift).simd_sqrt();
        let slope = b2 * sine / h;
        Rise {
            // L − h without cancellation.
            height: lift / (l + h),
            slope,
            curvature: b2 * cosine / h + slope * slope / h,
        }
    }
}

impl<R: Real> Pendulum<R> {
    /// Energy `½ (I + m z'²) θ̇² + m g z`, J, from rest at the bottom.
    pub fn energy(&self, swing: &Swing<R>) -> R {
        let rise = self.suspension.rise(swing.angle);
        let m: R = constant(self.suspension.mass_kg);
        let g: R = constant(self.suspension.gravity_m_s2);
        let inertia = self.inertia + m * rise.slope * rise.slope;
        inertia * swing.rate * swing.rate * constant(0.5) + m * g * rise.height
    }
}

impl<R: Real> System<R> for Pendulum<R> {
    type State = Swing<R>;
    type Input = ();

    /// `(I + m z'²) θ̈ = −m z' z'' θ̇² − m g z' − c θ̇ − d |θ̇| θ̇`.
    fn derivative(&self, swing: &Swing<R>, (): &()) -> SwingRate<R> {
        let m: R = constant(self.suspension.mass_kg);
        let g: R = constant(self.suspension.gravity_m_s2);
        let rise = self.suspension.rise(swing.angle);
        let rate = swing.rate;
        let damping = (self.viscous + self.quadratic * rate.simd_abs()) * rate;
        let moment = -m * rise.slope * (rise.curvature * rate * rate + g) - damping;
        SwingRate {
            rate,
            acceleration: moment / (self.inertia + m * rise.slope * rise.slope),
        }
    }
}
