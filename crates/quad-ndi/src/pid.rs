//! Conventional cascaded PID: height; yaw; position → tilt → moments.
//!
//! Each loop is `b k_p e + I − k_d (ẏ_f − ẏ_d)`: the derivative of the measurement comes through a first-order
//! filter `ẏ_f = N (y − y_f)`, that of the set point from the reference, so a step gives no kick and a ramp no
//! lag. The integral `İ = k_i e − (1 − b) k_p (ẏ_f − ẏ_d) + k_w Δ` is held back by what
//! saturation took from the output, `Δ = saturated − demanded` (back-calculation). The filter is solved
//! exactly for a measurement held over the step and `ẏ_f` taken as its mean rate over it, so that a ramp's
//! slope comes out exact at any step.
//!
//! `b` is the set-point weight. At a step of the set point the proportional action sees `b` of it, the rest comes
//! through the integral; loads and smooth references see all of `k_p` whatever `b` is. On `ÿ = u`, the poles
//! `(s² + 2ζω s + ω²)(s + a)` and `b = ω²/k_p` put the step's zero on the integral's pole `−a`, so that the step is the
//! second-order response of a dynamic inversion and the integral leaves no overshoot
//! ([`PidGains::placed`]). With `b = 1` any integral overshoots: without load `∫e dt = 0`. A loop without integral
//! action has `b = 1`.
//! The loops know the vehicle's weight, inertia and allocation, so gains
//! are in 1/s², 1/s³ and 1/s and carry over between vehicles; they know nothing of coupling or lag, and use
//! no reference derivative above the first. [`tune`] finds gains. Source: thesis chapter 6.6.1
//! (structure); Åström and Hägglund, *Advanced PID Control*, chapters 3 and 8 (filter, set-point weight,
//! back-calculation).

mod settings;
mod tuning;

pub use settings::{PidGains, PidSettings};
pub use tuning::{LoopReport, LoopTarget, StartReport, Tuned, TunedLoop, TuningError, TuningOptions, tune};

use crate::controller::{Allocation, Control, Controller, ControllerError, Demand, limited, wrapped};
use crate::law::{AnyController, ControlLaw, LoopDesign};
use crate::{InCharge, Reference, TiltLaw};
use nalgebra::Vector3;
use quad_dynamics::{CommandLimits, Flight, Level, RigidBody, Vehicle};
use quad_math::{Flat, Real, constant};

/// The loops in the order of the controller's memory.
const LOOPS: usize = 6;

/// The place of yaw among them.
const YAW: usize = 5;

/// Cascaded PID.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pid<R: Real> {
    /// `k_p` of `[x, y, z, φ, θ, ψ]`, 1/s².
    pub proportional: [R; LOOPS],
    /// `k_i` of `[x, y, z, φ, θ, ψ]`, 1/s³.
    pub integral: [R; LOOPS],
    /// `k_d` of `[x, y, z, φ, θ, ψ]`, 1/s.
    pub derivative: [R; LOOPS],
    /// Bandwidth N of the derivative filters, rad/s.
    pub filter_bandwidth: R,
    /// Largest demanded tilt `√(φ² + θ²)`, rad.
    pub tilt_limit: R,
    /// Rate `k_w` of the back-calculation, 1/s.
    pub anti_windup: R,
    /// Set-point weight `b` of the loops with integral action.
    pub set_point_weight: R,
    /// What it believes of the rigid body.
    pub body: RigidBody<R>,
    /// What it believes of the rotors.
    pub allocation: Allocation<R>,
    /// Limits on its commands; `None` is off.
    pub limits: Option<CommandLimits<R>>,
}

/// What the cascade remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PidMemory<R: Real> {
    /// Integrals of the loops `[x, y, z, φ, θ, ψ]`, m/s² and rad/s².
    pub integrals: [R; LOOPS],
    /// Filtered measurements of `[x, y, z, φ, θ, ψ]`, m and rad.
    pub filtered: [R; LOOPS],
    /// 0 before the first call, 1 after: the first call starts the filters at the measurement.
    pub primed: R,
}

impl<R: Real> Pid<R> {
    /// The controller of a vehicle, without limits on its commands.
    ///
    /// # Errors
    /// A wrong setting; a singular control matrix.
    pub fn new(vehicle: &Vehicle, settings: &PidSettings) -> Result<Self, ControllerError> {
        settings.check()?;
        Ok(Self {
            proportional: settings.per_loop(|g| g.proportional),
            integral: settings.per_loop(|g| g.integral),
            derivative: settings.per_loop(|g| g.derivative),
            filter_bandwidth: constant(settings.filter_bandwidth_rad_s),
            tilt_limit: constant(settings.tilt_limit_rad),
            anti_windup: constant(settings.anti_windup_per_s),
            set_point_weight: constant(settings.set_point_weight),
            body: RigidBody::of(vehicle),
            allocation: Allocation::of(vehicle)?,
            limits: None,
        })
    }

    /// `b k_p e + I − k_d (ẏ_f − ẏ_d)` of one loop.
    #[inline(always)]
    fn output(&self, i: usize, error: R, integral: R, rate: R) -> R {
        self.weight(i) * self.proportional[i] * error + integral - self.derivative[i] * rate
    }

    /// The set-point weight of one loop: without integral action there is nothing to take the rest.
    #[inline(always)]
    fn weight(&self, i: usize) -> R {
        self.set_point_weight
            .select(self.integral[i].simd_gt(R::zero()), R::one())
    }

    /// The inner loops alone: a tilt `[φ, θ]`, rad, demanded directly as a pilot does, height and yaw from
    /// the reference. The position loops rest.
    #[inline(always)]
    pub fn hold_tilt(
        &self,
        memory: &PidMemory<R>,
        flight: &Flight<R>,
        reference: &Reference<R>,
        tilt: [R; 2],
        dt: R,
    ) -> Control<R, PidMemory<R>> {
        let outer = Outer {
            tilt,
            errors: [R::zero(); 2],
            rates: [R::zero(); 2],
            shortfall: [R::zero(); 2],
        };
        self.inner(memory, &self.sense(memory, flight, dt), &outer, reference, dt)
    }

    /// Measurements through their filters.
    #[inline(always)]
    fn sense(&self, memory: &PidMemory<R>, flight: &Flight<R>, dt: R) -> Sensed<R> {
        let (r, eta) = (&flight.position, &flight.attitude);
        let measured = [r.x, r.y, r.z, eta.roll, eta.pitch, eta.yaw];
        let primed = memory.primed.simd_gt(R::zero());
        // The yaw measurement may jump by a turn; its filter follows the short way round.
        let lag: [R; LOOPS] = std::array::from_fn(|i| {
            let difference = measured[i] - memory.filtered[i];
            let difference = if i == YAW { wrapped(difference) } else { difference };
            difference.select(primed, R::zero())
        });
        let keep = (-self.filter_bandwidth * dt).simd_exp();
        let gain = (R::one() - keep) / dt;
        Sensed {
            measured,
            filtered: std::array::from_fn(|i| measured[i] - lag[i] * keep),
            rates: lag.map(|difference| difference * gain),
        }
    }

    /// The position loops: horizontal accelerations, cut to the largest tilt, as roll and pitch.
    #[inline(always)]
    fn outer(&self, memory: &PidMemory<R>, sensed: &Sensed<R>, reference: &Reference<R>) -> Outer<R> {
        let flat = &reference.flat;
        let errors = [
            flat.position.x - sensed.measured[0],
            flat.position.y - sensed.measured[1],
        ];
        let rates = std::array::from_fn(|i| sensed.rates[i] - flat.velocity[i]);
        let raw: [R; 2] = std::array::from_fn(|i| self.output(i, errors[i], memory.integrals[i], rates[i]));
        let g = self.body.gravity;
        let largest = self.tilt_limit * g;
        let size = (raw[0] * raw[0] + raw[1] * raw[1]).simd_sqrt();
        let scale = largest / size.simd_max(largest);
        let cut = raw.map(|a| a * scale);
        let (sin, cos) = sensed.measured[YAW].simd_sin_cos();
        Outer {
            tilt: [
                (cut[1] * cos - cut[0] * sin) / g,
                -(cut[0] * cos + cut[1] * sin) / g,
            ],
            errors,
            rates,
            shortfall: [cut[0] - raw[0], cut[1] - raw[1]],
        }
    }

    /// Height, yaw and tilt loops, commands, and all integrals.
    #[inline(always)]
    fn inner(
        &self,
        memory: &PidMemory<R>,
        sensed: &Sensed<R>,
        outer: &Outer<R>,
        reference: &Reference<R>,
        dt: R,
    ) -> Control<R, PidMemory<R>> {
        let y = &sensed.measured;
        let errors = [
            outer.errors[0],
            outer.errors[1],
            reference.flat.position.z - y[2],
            outer.tilt[0] - y[3],
            outer.tilt[1] - y[4],
            wrapped(reference.flat.yaw - y[YAW]),
        ];
        // Roll and pitch demands come without rates.
        let (seen, flat) = (&sensed.rates, &reference.flat);
        let rates = [
            outer.rates[0],
            outer.rates[1],
            seen[2] - flat.velocity.z,
            seen[3],
            seen[4],
            seen[YAW] - flat.yaw_rate,
        ];
        let out = |i: usize| self.output(i, errors[i], memory.integrals[i], rates[i]);
        let demand = Demand {
            thrust: self.body.mass * (self.body.gravity - out(2)),
            moment: self.body.inertia * Vector3::new(out(3), out(4), out(YAW)),
        };
        let wanted = self.allocation.commands(&demand);
        let commands = limited(self.limits.as_ref(), wanted);

        // What the limits took, as accelerations of the loops.
        let taken = std::array::from_fn(|i| (commands[i] - wanted[i]) * self.allocation.thrust_gain);
        let taken = self.allocation.demand(&taken);
        let turned = self.body.inertia_inverse * taken.moment;
        let shortfall = [
            outer.shortfall[0],
            outer.shortfall[1],
            -taken.thrust / self.body.mass,
            turned.x,
            turned.y,
            turned.z,
        ];
        let integrals = std::array::from_fn(|i| {
            let unweighted = (R::one() - self.weight(i)) * self.proportional[i];
            let rate = self.integral[i] * errors[i] - unweighted * rates[i] + self.anti_windup * shortfall[i];
            // A loop without integral action has nothing to hold back.
            let active = self.integral[i].simd_gt(R::zero());
            memory.integrals[i] + rate.select(active, R::zero()) * dt
        });
        Control {
            commands,
            memory: PidMemory {
                integrals,
                filtered: sensed.filtered,
                primed: R::one(),
            },
        }
    }
}

/// Measurements of `[x, y, z, φ, θ, ψ]` as the loops see them.
struct Sensed<R> {
    measured: [R; LOOPS],
    filtered: [R; LOOPS],
    rates: [R; LOOPS],
}

/// What the position loops ask of the inner loops, and what their integrals are to learn.
struct Outer<R> {
    tilt: [R; 2],
    errors: [R; 2],
    /// Rates over those of the reference.
    rates: [R; 2],
    shortfall: [R; 2],
}

impl<R: Real> Controller<R> for Pid<R> {
    type Memory = PidMemory<R>;
    const LEVEL: Level = Level::One;

    fn initial_memory(&self) -> PidMemory<R> {
        PidMemory {
            integrals: [R::zero(); LOOPS],
            filtered: [R::zero(); LOOPS],
            primed: R::zero(),
        }
    }

    #[inline(always)]
    fn control(
        &self,
        memory: &PidMemory<R>,
        flight: &Flight<R>,
        reference: &Reference<R>,
        dt: R,
    ) -> Control<R, PidMemory<R>> {
        let sensed = self.sense(memory, flight, dt);
        let outer = self.outer(memory, &sensed, reference);
        self.inner(memory, &sensed, &outer, reference, dt)
    }
}

impl<R: Real> ControlLaw<R> for Pid<R> {
    const TILT_LAW: TiltLaw = TiltLaw::Exact;
    const INVERTS: bool = false;

    fn design(vehicle: &Vehicle, design: &LoopDesign) -> Result<Self, ControllerError> {
        Self::new(vehicle, &design.pid)
    }

    fn with_limits(self, limits: Option<CommandLimits<R>>) -> Self {
        Self { limits, ..self }
    }

    fn any(in_charge: InCharge<R, Self>) -> AnyController<R> {
        AnyController::Pid(in_charge)
    }
}

impl<R: Real> Flat<R> for PidMemory<R> {
    const LEN: usize = 2 * LOOPS + 1;

    #[inline(always)]
    fn write(&self, out: &mut [R]) {
        out[..LOOPS].copy_from_slice(&self.integrals);
        out[LOOPS..2 * LOOPS].copy_from_slice(&self.filtered);
        out[2 * LOOPS] = self.primed;
    }

    #[inline(always)]
    fn read(values: &[R]) -> Self {
        Self {
            integrals: std::array::from_fn(|i| values[i]),
            filtered: std::array::from_fn(|i| values[LOOPS + i]),
            primed: values[2 * LOOPS],
        }
    }
}
