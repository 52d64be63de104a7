//! The rollout: vehicle, controller and station in one loop, pure and over any scalar.
//!
//! ```text
//! at k h        flight_k = what can be seen of x_k;  r_k = path(t_k, flight_k);  u_k = controller(flight_k, r_k)
//! every n h     the station captures and delivers frames of the receiver, and turns for n h;  the cost is sampled
//! to (k+1) h    x_{k+1} = RK4(x_k, u_k), commands held
//! ```
//!
//! The operations of [`sifre::ModelQuadrotor`], [`sifre::GimballedEts`] and [`sifre::Facing`] in their order, so that engine and rollout agree to the last
//! bit on `f64`. No heap, no branch on a number: each SIMD lane is a flight of its own.
//!
//! A flight fails when its position is beyond [`LOST_M`] or no number: from that instant on, each costs
//! [`FAILURE`] in place of its terms, whatever the lane then holds. Means are those of the trapezoidal rule over the station's instants.

use crate::cost::{Cost, FAILURE, Glance, LOST_M, Terms};
use crate::mission::Timing;
use crate::path::Path;
use ets::{Ets, EtsInput, EtsState};
use nalgebra::{SimdBool, Vector2, Vector3};
use quad_dynamics::{Flight, Input, QuadrotorModel, Snapshot};
use quad_math::{Real, constant, wrapped};
use quad_ndi::{Airborne, ClosedLoop, Controller, InCharge, Plant};

/// Everybody of a flight, over one kind of scalar.
#[derive(Clone, Debug)]
pub(crate) struct Agents<R: Real, M, C> {
    /// The vehicle.
    pub(crate) model: M,
    /// Its controller.
    pub(crate) controller: C,
    /// The station.
    pub(crate) ets: Ets<R>,
    /// What it costs.
    pub(crate) cost: Cost<R>,
}

/// What is seen at an instant of the station.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant<'a, R: Real> {
    /// Time, s.
    pub(crate) time_s: f64,
    /// The vehicle.
    pub(crate) flight: &'a Flight<R>,
    /// The station.
    pub(crate) ets: &'a EtsState<R>,
    /// Commands u of the step that ended now; those of hover at the start.
    pub(crate) commands: &'a [R; 4],
    /// Geometry and terms of the cost.
    pub(crate) glance: &'a Glance<R>,
}

/// What a rollout gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tally<R: Real> {
    /// The cost Φ: weighted means of the terms, and what a failure costs. Always finite.
    pub(crate) cost: R,
    /// Time means of the terms, the time after a failure counting as zero.
    pub(crate) means: Terms<R>,
    /// Share of the time after a failure, 0 to 1.
    pub(crate) failed: R,
}

/// Whether a flight is one still: neither comparison is true of NaN.
#[inline(always)]
pub(crate) fn goes_on<R: Real>(position: &Vector3<R>, terms: &Terms<R>) -> R::SimdBool {
    let sum = terms.array().into_iter().fold(R::zero(), |sum, term| sum + term);
    let inside = position.norm_squared().simd_lt(constant(LOST_M * LOST_M));
    inside & sum.simd_lt(constant(FAILURE))
}

/// The weight of a sample in the trapezoidal mean over `count` intervals.
#[inline(always)]
fn share(n: u64, count: u64) -> f64 {
    let half = if n == 0 || n == count { 0.5 } else { 1.0 };
    half / count as f64
}

/// The station's state at the start: at rest, its axis on the receiver as nearly as its travel allows.
pub(crate) fn aimed<R: Real>(ets: &Ets<R>, receiver: &Vector3<R>) -> EtsState<R> {
    let line = receiver - ets.pedestal.origin();
    let pan = wrapped(quad_math::atan2(line.y, line.x) - ets.pedestal.heading);
    let level = quad_math::sqrt(line.x * line.x + line.y * line.y);
    let tilt = quad_math::atan2(-line.z, level);
    let (p, t) = (&ets.gimbal.pan, &ets.gimbal.tilt);
    ets.at_rest(
        pan.simd_clamp(p.minimum, p.maximum),
        tilt.simd_clamp(t.minimum, t.maximum),
    )
}

/// The flight of a vehicle that starts exactly on its path, its rotors as in hover.
pub(crate) fn launched<R: Real, M: QuadrotorModel<R>>(model: &M, path: &Path<R>) -> (Snapshot<R>, Input<R>) {
    let hover = model.hover(Vector3::zeros(), R::zero());
    let snapshot = model.snapshot(&hover.state, &hover.input);
    let body = path.body(R::zero());
    (Snapshot { body, ..snapshot }, hover.input)
}

/// Flies a path and adds up what it costs; `watch` sees every instant of the station.
pub(crate) fn rollout<R: Real, M: QuadrotorModel<R>, C: Controller<R> + Copy>(
    agents: &Agents<R, M, C>,
    timing: &Timing,
    path: &Path<R>,
    watch: &mut dyn FnMut(&Instant<'_, R>),
) -> Tally<R> {
    let Agents {
        model,
        controller,
        ets,
        cost,
    } = agents;
    let (grid, count) = (&timing.grid, timing.grid.steps() / timing.ratio);
    let (h, h_station) = (constant(grid.step_s()), constant(timing.clock.step_s()));
    let (start, hover) = launched(model, path);
    let mut flying = ClosedLoop {
        plant: Airborne {
            model,
            state: model.adopt(&start, &hover),
        },
        feedback: InCharge::from(*controller),
    };
    let mut commands = hover.commands;
    let still = Input::still_air([R::zero(); 4]);
    let seen = flying.plant.flight();
    let receiver = ets.receiver.on(&seen.position, &seen.rotation.matrix);
    let mut station = aimed(ets, &receiver.centre);
    let (mut alive, mut failed) = (R::one(), R::zero());
    let mut sums = [R::zero(); 7];
    for k in 0..=grid.steps() {
        let flight = flying.plant.flight();
        if k % timing.ratio == 0 {
            let n = k / timing.ratio;
            let glance = cost.glance(ets, &station.gimbal, &flight, &commands);
            watch(&Instant {
                time_s: grid.time_s(k),
                flight: &flight,
                ets: &station,
                commands: &commands,
                glance: &glance,
            });
            alive = alive.select(goes_on(&flight.position, &glance.terms), R::zero());
            let flies = alive.simd_gt(R::zero());
            let weight: R = constant(share(n, count));
            for (sum, term) in sums.iter_mut().zip(glance.terms.array()) {
                *sum += (term * weight).select(flies, R::zero());
            }
            failed += R::zero().select(flies, weight);
            if n == count {
                break;
            }
            if flies.none() {
                failed += constant((n + 1..=count).map(|n| share(n, count)).sum());
                break;
            }
            let target = ets.receiver.on(&flight.position, &flight.rotation.matrix).centre;
            let input = EtsInput {
                target,
                noise: Vector2::zeros(),
            };
            station = ets.turn(&ets.look(&timing.clock, n, &station, &input), h_station);
        }
        let reference = path.reference(constant(grid.time_s(k)), &flight.position, &flight.velocity);
        commands = flying.step_as_seen(&flight, &reference, &still, h);
    }
    let means = Terms::from_array(sums);
    Tally {
        cost: cost.weighted(&means) + failed * constant(FAILURE),
        means,
        failed,
    }
}
