//! Fixed-step runs on an exact grid, stopped where the numbers stop being numbers.
//!
//! A run that diverges is a result, not an error: it keeps what was computed and says at which instant,
//! and from which state, the next step left the finite numbers.

use crate::{FixedStep, Flat, State, TimeGrid, euler, rk4};
use std::num::NonZeroU64;

/// A state and its instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<X> {
    /// The instant `t`, s.
    pub time_s: f64,
    /// The state at that instant.
    pub state: X,
}

/// How a run on a grid ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SimulationStatus<X> {
    /// It reached the end of the grid.
    Completed,
    /// Numerical divergence: a number of the state became NaN or infinite.
    Diverged {
        /// The first instant at which the state is not finite, s.
        time_s: f64,
        /// The last finite state and its instant; `None` if the initial state itself was not finite.
        last_finite: Option<Sample<X>>,
    },
}

/// What a run on a grid computed, to its end or to its divergence.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationRun<X> {
    /// The recorded samples, all finite, in order. The state where the run ended, or the last finite
    /// one before divergence, is always the last of them.
    pub samples: Vec<Sample<X>>,
    /// How the run ended.
    pub status: SimulationStatus<X>,
}

/// An instant of the grid as a step function sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Number `k` of the step, from 0.
    pub step: u64,
    /// Time `t_k` at its start, s.
    pub time_s: f64,
    /// Length `h` of the step, s.
    pub step_s: f64,
}

/// A fixed-step run: on which grid, by which method, and how many samples to keep.
///
/// ```
/// use quad_math::{Simulation, TimeGrid};
/// use nalgebra::Vector1;
/// let decay = Simulation::on(TimeGrid::from_seconds(0.01, 1.0)?);
/// let run = decay.run(|_, x: &Vector1<f64>| -x, Vector1::new(1.0));
/// assert!((run.samples[100].state.x - (-1.0_f64).exp()).abs() < 1e-10);
/// # Ok::<(), quad_math::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Simulation {
    /// The instants the run visits.
    pub grid: TimeGrid,
    /// The method of [`Simulation::run`].
    pub method: FixedStep,
    /// Every how many steps a sample is kept (the first and the last state always are).
    pub record_every: NonZeroU64,
}

impl Simulation {
    /// RK4 on the grid, every step recorded.
    pub const fn on(grid: TimeGrid) -> Self {
        Self {
            grid,
            method: FixedStep::Rk4,
            record_every: NonZeroU64::MIN,
        }
    }

    /// Integrates `ẋ = f(t, x)` from `initial` at `t = 0` to the end of the grid or to divergence.
    pub fn run<X>(&self, f: impl Fn(f64, &X) -> X::Rate, initial: X) -> SimulationRun<X>
    where
        X: State<f64> + Flat<f64>,
    {
        match self.method {
            FixedStep::Euler => self.run_map(|tick, x| euler(&f, tick.time_s, x, tick.step_s), initial),
            FixedStep::Rk4 => self.run_map(|tick, x| rk4(&f, tick.time_s, x, tick.step_s), initial),
        }
    }

    /// Runs any map from one instant to the next: a sampled controller with its memory around an
    /// integrator, noise, a hold. [`Simulation::method`] plays no part.
    ///
    /// Allocates before the first step only, if `step` does not.
    pub fn run_map<X>(&self, mut step: impl FnMut(Tick, &X) -> X, initial: X) -> SimulationRun<X>
    where
        X: Copy + Flat<f64>,
    {
        let every = self.record_every.get();
        let mut flat = vec![0.0; X::LEN];
        let mut is_finite = |x: &X| {
            x.write(&mut flat);
            flat.iter().all(|value| value.is_finite())
        };
        if !is_finite(&initial) {
            let status = SimulationStatus::Diverged {
                time_s: 0.0,
                last_finite: None,
            };
            return SimulationRun {
                samples: Vec::new(),
                status,
            };
        }

        // The initial state, every n-th, and the last.
        let mut samples = Vec::with_capacity((self.grid.steps() / every) as usize + 2);
        let mut current = Sample {
            time_s: 0.0,
            state: initial,
        };
        let step_s = self.grid.step_s();
        for k in 0..self.grid.steps() {
            if k.is_multiple_of(every) {
                samples.push(current);
            }
            let state = step(
                Tick {
                    step: k,
                    time_s: current.time_s,
                    step_s,
                },
                &current.state,
            );
            let time_s = self.grid.time_s(k + 1);
            if !is_finite(&state) {
                if !k.is_multiple_of(every) {
                    samples.push(current);
                }
                return SimulationRun {
                    samples,
                    status: SimulationStatus::Diverged {
                        time_s,
                        last_finite: Some(current),
                    },
                };
            }
            current = Sample { time_s, state };
        }
        samples.push(current);
        SimulationRun {
            samples,
            status: SimulationStatus::Completed,
        }
    }
}

impl<X> SimulationRun<X> {
    /// Whether the run reached the end of its grid.
    pub const fn is_complete(&self) -> bool {
        matches!(self.status, SimulationStatus::Completed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector1, Vector2};

    fn every(n: u64) -> NonZeroU64 {
        NonZeroU64::new(n).unwrap()
    }

    #[test]
    fn exact_harmonic_oscillator() {
        let simulation = Simulation::on(TimeGrid::from_seconds(0.01, 10.0).unwrap());
        let run = simulation.run(
            |_, x: &Vector2<f64>| Vector2::new(x.y, -x.x),
            Vector2::new(1.0, 0.0),
        );
        assert!(run.is_complete());
        assert_eq!(run.samples.len(), 1001);
        for sample in &run.samples {
            let truth = Vector2::new(sample.time_s.cos(), -sample.time_s.sin());
            // RK4's phase error is t h⁴/120 = 8.3e-10 at t = 10 s; its amplitude error t h⁵/144 far less.
            assert!((sample.state - truth).norm() < 9e-10);
        }
    }

    #[test]
    fn exact_the_last_state_is_always_recorded() {
        let grid = TimeGrid::from_seconds(0.1, 1.0).unwrap();
        for (n, count) in [(1, 11), (3, 5), (5, 3), (7, 3), (100, 2)] {
            let simulation = Simulation {
                record_every: every(n),
                ..Simulation::on(grid)
            };
            let run = simulation.run(|_, _: &Vector1<f64>| Vector1::new(1.0), Vector1::new(0.0));
            assert_eq!(run.samples.len(), count, "every {n}");
            assert!(
                run.samples.capacity() <= count + 1,
                "every {n}: storage is reserved once"
            );
            assert_eq!(run.samples.last().unwrap().time_s, 1.0);
        }
    }

    #[test]
    fn exact_divergence_keeps_what_was_computed() {
        // x' = x² from 1 has a pole at t = 1: Euler's iterates grow doubly exponentially past it.
        let grid = TimeGrid::from_seconds(0.1, 10.0).unwrap();
        for n in [1, 4] {
            let simulation = Simulation {
                method: FixedStep::Euler,
                record_every: every(n),
                ..Simulation::on(grid)
            };
            let run = simulation.run(|_, x: &Vector1<f64>| x.component_mul(x), Vector1::new(1.0));
            let SimulationStatus::Diverged {
                time_s,
                last_finite: Some(last),
            } = run.status
            else {
                panic!("{:?}", run.status)
            };
            assert!(last.state.x.is_finite() && last.state.x > 1e100);
            assert!((time_s - last.time_s - grid.step_s()).abs() < f64::EPSILON * 10.0);
            assert_eq!(run.samples.last(), Some(&last));
            assert!(run.samples.windows(2).all(|pair| pair[0].time_s < pair[1].time_s));
            assert!(run.samples.iter().all(|sample| sample.state.x.is_finite()));
        }
    }

    #[test]
    fn exact_a_bad_initial_state_is_reported_at_zero() {
        let simulation = Simulation::on(TimeGrid::from_seconds(0.1, 1.0).unwrap());
        let run = simulation.run(|_, x: &Vector1<f64>| *x, Vector1::new(f64::NAN));
        assert!(run.samples.is_empty());
        assert_eq!(
            run.status,
            SimulationStatus::Diverged {
                time_s: 0.0,
                last_finite: None
            }
        );
    }

    #[test]
    fn exact_a_map_sees_every_tick() {
        let simulation = Simulation::on(TimeGrid::from_seconds(0.25, 1.0).unwrap());
        let mut seen = Vec::new();
        let run = simulation.run_map(
            |tick, x: &Vector1<f64>| {
                seen.push(tick);
                x.add_scalar(tick.step_s)
            },
            Vector1::new(0.0),
        );
        assert_eq!(seen.len(), 4);
        assert_eq!(
            seen[3],
            Tick {
                step: 3,
                time_s: 0.75,
                step_s: 0.25
            }
        );
        // Quarters are exact in binary.
        assert_eq!(
            run.samples[4],
            Sample {
                time_s: 1.0,
                state: Vector1::new(1.0)
            }
        );
    }
}
