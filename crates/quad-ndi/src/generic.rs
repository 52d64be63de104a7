//! Generic inversion: the Lie derivatives of any model by automatic differentiation.
//!
//! For `ẋ = f(x) + G(x) u`, `y = h(x)` with relative degree ν,
//! `y^(ν) = L_f^ν h + L_G L_f^(ν−1) h · u`, so `u = (L_G L_f^(ν−1) h)⁻¹ (v − L_f^ν h)`. The model's own
//! text runs over truncated Taylor series in time; `y^(ν)` is affine in `u`, so five evaluations give
//! drift and decoupling matrix exactly. Source: thesis chapter 6.1; Isidori, *Nonlinear Control Systems*,
//! chapter 5.
//!
//! For models whose derivative is affine in the commands with one relative degree for all outputs:
//! levels 1 and 2 (ν = 2) and 3 (ν = 3), without input limits, at pitch angles below 90°.

use nalgebra::{Matrix4, Matrix6x4, SimdComplexField, Vector4, Vector6};
use quad_dynamics::{Input, QuadrotorModel, StateOf};
use quad_math::{Flat, Taylor3, output_derivatives};

/// Condition number of the decoupling matrix, rows scaled, above which it counts as singular: beyond it a
/// command keeps less than half of its digits.
const LARGEST_CONDITION: f64 = 1e8;

/// The part of a model's input-output map that a linearising feedback cancels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decoupling {
    /// `L_f^ν h` for `y = [z, φ, θ, ψ]`.
    pub drift: Vector4<f64>,
    /// `L_G L_f^(ν−1) h`, columns in the order of the rotors.
    pub matrix: Matrix4<f64>,
    /// What each row is measured by when singularity is judged: for an angle the largest entry of its row; for
    /// z the largest entry of the rows of x, y and z, so that a thrust without vertical part (roll or pitch of
    /// 90°) shows as the singularity it is.
    pub scale: Vector4<f64>,
}

/// Why a model can't be inverted where it is.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum InversionError {
    /// The decoupling matrix is singular or nearly so: no input gives the demand.
    #[error(
        "the decoupling matrix is near singular (condition number {condition:.3e}): roll or pitch near 90 deg, a \
         state that isn't finite, or the wrong relative degree"
    )]
    NearSingular {
        /// Its condition number after scaling its rows; infinite if a row is zero or not finite.
        condition: f64,
    },
    /// The relative degree is not between 1 and 3.
    #[error("the relative degree must be 1 to 3 for this inversion, got {relative_degree}")]
    RelativeDegree {
        /// The relative degree asked for.
        relative_degree: usize,
    },
}

/// The angle `atan2(y, x)` less its present value: same derivatives.
///
/// [`quad_math::atan2`] is a rational approximation and loses digits with each derivative. Turned by its
/// present value the angle is zero, where num-dual's arc tangent is exact to rounding in all derivatives.
fn deviation(y: Taylor3, x: Taylor3) -> Taylor3 {
    let size = x.re.hypot(y.re);
    let (sin, cos) = (y.re / size, x.re / size);
    ((y * cos - x * sin) / (x * cos + y * sin)).simd_atan()
}

impl Decoupling {
    /// Drift and decoupling matrix of `y = [z, φ, θ, ψ]` at a state given as numbers (in the order of the
    /// model's [`Flat`] state).
    ///
    /// # Errors
    /// [`InversionError::RelativeDegree`].
    pub fn of<M: QuadrotorModel<Taylor3>>(
        model: &M,
        state: &[f64],
        relative_degree: usize,
    ) -> Result<Self, InversionError>
    where
        StateOf<Taylor3, M>: Flat<Taylor3>,
    {
        if !(1..=3).contains(&relative_degree) {
            return Err(InversionError::RelativeDegree { relative_degree });
        }
        // [z, φ, θ, ψ], then x and y for the scale of z.
        let response = |commands: [f64; 4]| {
            let input = Input::still_air(commands.map(Taylor3::from_re));
            let derivatives = output_derivatives(
                |x| model.derivative(x, &input),
                |x| {
                    let flight = model.flight(x);
                    let (r, m) = (&flight.position, &flight.rotation.matrix);
                    let cos_pitch = (m.m32 * m.m32 + m.m33 * m.m33).simd_sqrt();
                    let roll = deviation(m.m32, m.m33);
                    let pitch = deviation(-m.m31, cos_pitch);
                    [r.z, roll, pitch, deviation(m.m21, m.m11), r.x, r.y]
                },
                state,
            );
            Vector6::from(derivatives[relative_degree])
        };
        let drift = response([0.0; 4]);
        let columns = std::array::from_fn::<_, 4, _>(|j| {
            let mut commands = [0.0; 4];
            commands[j] = 1.0;
            response(commands) - drift
        });
        let all = Matrix6x4::from_columns(&columns);
        let largest = |row: usize| all.row(row).amax();
        let matrix = all.fixed_rows::<4>(0).into_owned();
        let thrust = largest(0).max(largest(4)).max(largest(5));
        Ok(Self {
            drift: drift.fixed_rows::<4>(0).into_owned(),
            matrix,
            scale: Vector4::new(thrust, largest(1), largest(2), largest(3)),
        })
    }

    /// The commands u that make `y^(ν) = v`.
    ///
    /// # Errors
    /// [`InversionError::NearSingular`].
    pub fn invert(&self, v: &Vector4<f64>) -> Result<[f64; 4], InversionError> {
        // Rows have different units.
        let scaled = Matrix4::from_fn(|i, j| self.matrix[(i, j)] / self.scale[i]);
        let target = Vector4::from_fn(|i, _| (v[i] - self.drift[i]) / self.scale[i]);
        if !scaled.iter().all(|x| x.is_finite()) {
            let condition = f64::INFINITY;
            return Err(InversionError::NearSingular { condition });
        }
        let singular_values = scaled.singular_values();
        let condition = singular_values.max() / singular_values.min();
        if condition.is_nan() || condition > LARGEST_CONDITION {
            return Err(InversionError::NearSingular { condition });
        }
        // Not by the singular vectors, which nalgebra finds to some ten digits only.
        let solution = scaled.lu().solve(&target);
        solution
            .map(Into::into)
            .ok_or(InversionError::NearSingular { condition })
    }
}
