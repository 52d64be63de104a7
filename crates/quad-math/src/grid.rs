//! A fixed time grid that is exact: instants are whole numbers of ticks, never sums of steps.
//!
//! `t_k = k · tick`, with the tick a whole number of nanoseconds. Adding `h = 0.001` a million times
//! misses the end by rounding; `k · tick` does not, and two rates of one grid meet exactly where they
//! should.

/// Nanoseconds in a second.
const NANOSECONDS_PER_SECOND: f64 = 1e9;

/// Longest span, ns, about 13 days. Up to 2⁵³ ns every whole number is an `f64`, so that
/// [`TimeGrid::time_s`] is the double nearest to the true instant; up to 2⁵⁰ ns such a double also
/// finds back to its whole number after the two roundings on the way.
const LONGEST_SPAN_NS: u64 = 1 << 50;

/// Relative distance from a whole number of nanoseconds that passes as rounding of the caller's own
/// arithmetic (`3.0 * 0.1`): a few units in the last place.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Instants `t_k = k · tick`, k = 0 to `steps`: both ends belong to the grid. It starts at zero.
///
/// ```
/// use quad_math::TimeGrid;
/// let grid = TimeGrid::from_seconds(0.001, 20.0)?;
/// assert_eq!(grid.steps(), 20_000);
/// assert_eq!(grid.times_s().last(), Some(20.0)); // exactly
/// # Ok::<(), quad_math::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TimeGrid {
    tick_ns: u64,
    steps: u64,
}

/// Why a time grid cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// A tick of zero nanoseconds.
    #[error("the tick of a time grid must be at least 1 ns")]
    ZeroTick,
    /// A step that is not a positive, finite number.
    #[error("the step of a time grid must be positive and finite, got {step_s} s")]
    BadStep {
        /// The step given, s.
        step_s: f64,
    },
    /// An end that is not a positive, finite number.
    #[error("the end of a time grid must be positive and finite, got {end_s} s")]
    BadEnd {
        /// The end given, s.
        end_s: f64,
    },
    /// A time that is not a whole number of nanoseconds.
    #[error("a time must be a whole number of nanoseconds, got {time_s} s")]
    NotWholeNanoseconds {
        /// The time given, s.
        time_s: f64,
    },
    /// An end that no instant of the grid meets.
    #[error("the end must be a multiple of the step, {tick_ns} ns, got {end_ns} ns")]
    EndOffGrid {
        /// The tick, ns.
        tick_ns: u64,
        /// The end, ns.
        end_ns: u64,
    },
    /// A span beyond 2⁵⁰ ns, about 13 days, where seconds in an `f64` begin to lose nanoseconds.
    #[error("a time grid may span at most 2^50 ns, got {span_s} s")]
    TooLong {
        /// The span asked for, s.
        span_s: f64,
    },
    /// A factor that does not divide the tick ([`TimeGrid::refined`]) or the number of steps
    /// ([`TimeGrid::coarsened`]).
    #[error("{factor} does not divide {number}")]
    NotDivisible {
        /// What was to be divided: nanoseconds of the tick, or the number of steps.
        number: u64,
        /// The factor given.
        factor: u64,
    },
}

impl TimeGrid {
    /// The grid of `steps` steps of `tick_ns` nanoseconds; no steps is the single instant zero.
    ///
    /// # Errors
    /// [`GridError::ZeroTick`], [`GridError::TooLong`].
    pub const fn new(tick_ns: u64, steps: u64) -> Result<Self, GridError> {
        if tick_ns == 0 {
            return Err(GridError::ZeroTick);
        }
        match tick_ns.checked_mul(steps) {
            Some(span_ns) if span_ns <= LONGEST_SPAN_NS => Ok(Self { tick_ns, steps }),
            _ => Err(GridError::TooLong {
                span_s: tick_ns as f64 * steps as f64 / NANOSECONDS_PER_SECOND,
            }),
        }
    }

    /// The grid from zero to `end_s` in steps of `step_s`, both in s.
    ///
    /// # Errors
    /// A step or an end that is NaN, infinite or not positive; a step or an end that is not a whole
    /// number of nanoseconds; an end that is not a whole number of steps; a span beyond 2⁵⁰ ns.
    pub fn from_seconds(step_s: f64, end_s: f64) -> Result<Self, GridError> {
        if !(step_s.is_finite() && step_s > 0.0) {
            return Err(GridError::BadStep { step_s });
        }
        if !(end_s.is_finite() && end_s > 0.0) {
            return Err(GridError::BadEnd { end_s });
        }
        if end_s * NANOSECONDS_PER_SECOND > LONGEST_SPAN_NS as f64 {
            return Err(GridError::TooLong { span_s: end_s });
        }
        let tick_ns = whole_nanoseconds(step_s)?;
        let end_ns = whole_nanoseconds(end_s)?;
        if !end_ns.is_multiple_of(tick_ns) {
            return Err(GridError::EndOffGrid { tick_ns, end_ns });
        }
        Self::new(tick_ns, end_ns / tick_ns)
    }

    /// Length of one step, ns.
    pub const fn tick_ns(&self) -> u64 {
        self.tick_ns
    }

    /// Number of steps; the grid has one instant more.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// Length of one step `h`, s.
    pub const fn step_s(&self) -> f64 {
        self.tick_ns as f64 / NANOSECONDS_PER_SECOND
    }

    /// The last instant, s.
    pub const fn end_s(&self) -> f64 {
        self.time_s(self.steps)
    }

    /// The instant `t_k = k · tick`, s: the `f64` nearest to it.
    ///
    /// `k` beyond [`Self::steps`] extends the grid; beyond 2⁵³ ns the result is rounded more than once.
    pub const fn time_s(&self, k: u64) -> f64 {
        // In integers while they hold the product, which is always so on the grid itself.
        match self.tick_ns.checked_mul(k) {
            Some(time_ns) => time_ns as f64 / NANOSECONDS_PER_SECOND,
            None => self.tick_ns as f64 * k as f64 / NANOSECONDS_PER_SECOND,
        }
    }

    /// All instants in order, s: `steps + 1` of them.
    pub fn times_s(&self) -> impl DoubleEndedIterator<Item = f64> + Clone + use<> {
        let grid = *self;
        (0..=grid.steps).map(move |k| grid.time_s(k))
    }

    /// How many of this grid's steps make one step of `coarse`, if a whole number does.
    ///
    /// With it a controller at 100 Hz runs inside a simulation at 1 kHz: every tenth instant of the
    /// fine grid is one of the coarse grid, exactly.
    pub const fn divides(&self, coarse: &Self) -> Option<u64> {
        if coarse.tick_ns.is_multiple_of(self.tick_ns) {
            Some(coarse.tick_ns / self.tick_ns)
        } else {
            None
        }
    }

    /// The same span in steps `factor` times shorter.
    ///
    /// # Errors
    /// [`GridError::NotDivisible`] if the tick is not a multiple of `factor` nanoseconds (or `factor`
    /// is zero).
    pub const fn refined(&self, factor: u64) -> Result<Self, GridError> {
        if factor == 0 || !self.tick_ns.is_multiple_of(factor) {
            return Err(GridError::NotDivisible {
                number: self.tick_ns,
                factor,
            });
        }
        Ok(Self {
            tick_ns: self.tick_ns / factor,
            steps: self.steps * factor,
        })
    }

    /// The same span in steps `factor` times longer.
    ///
    /// # Errors
    /// [`GridError::NotDivisible`] if the number of steps is not a multiple of `factor` (or `factor`
    /// is zero).
    pub const fn coarsened(&self, factor: u64) -> Result<Self, GridError> {
        if factor == 0 || !self.steps.is_multiple_of(factor) {
            return Err(GridError::NotDivisible {
                number: self.steps,
                factor,
            });
        }
        match self.tick_ns.checked_mul(factor) {
            Some(tick_ns) => Self::new(tick_ns, self.steps / factor),
            None => Err(GridError::TooLong {
                span_s: self.step_s() * factor as f64,
            }),
        }
    }
}

/// The whole number of nanoseconds that `time_s > 0` is.
fn whole_nanoseconds(time_s: f64) -> Result<u64, GridError> {
    let exact = time_s * NANOSECONDS_PER_SECOND;
    let whole = exact.round();
    // Less than half a nanosecond rounds to zero and is caught here; a step too long for the cast, which
    // saturates, cannot divide an end that was not.
    if whole < 1.0 || (exact - whole).abs() > ROUNDING * exact {
        return Err(GridError::NotWholeNanoseconds { time_s });
    }
    Ok(whole as u64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exact_no_instant_drifts() {
        let grid = TimeGrid::from_seconds(0.001, 1000.0).unwrap();
        for k in [1, 3, 999, 123_457, 1_000_000] {
            // Both sides are the double nearest to k/1000, so they are the same bits.
            assert_eq!(grid.time_s(k), k as f64 / 1000.0);
        }
        let summed = (0..grid.steps()).fold(0.0, |t, _| t + grid.step_s());
        assert_ne!(summed, grid.end_s(), "the accumulated time would have drifted");
        assert_eq!(grid.end_s(), 1000.0);
    }

    #[test]
    fn exact_rounding_of_the_caller_is_forgiven() {
        assert_ne!(0.1 * 3.0, 0.3);
        assert_eq!(
            TimeGrid::from_seconds(0.1, 0.1 * 3.0),
            TimeGrid::new(100_000_000, 3)
        );
        assert_eq!(
            TimeGrid::from_seconds(1.0 / 400.0, 2.0),
            TimeGrid::new(2_500_000, 800)
        );
    }

    #[test]
    fn exact_two_rates_meet() {
        let fine = TimeGrid::from_seconds(0.001, 2.0).unwrap();
        let coarse = fine.coarsened(10).unwrap();
        assert_eq!(fine.divides(&coarse), Some(10));
        assert_eq!(coarse.divides(&fine), None);
        assert_eq!(coarse.refined(10), Ok(fine));
        for k in 0..=coarse.steps() {
            assert_eq!(coarse.time_s(k), fine.time_s(10 * k));
        }
        assert_eq!(
            fine.refined(3),
            Err(GridError::NotDivisible {
                number: 1_000_000,
                factor: 3
            })
        );
        assert_eq!(
            fine.coarsened(0),
            Err(GridError::NotDivisible {
                number: 2000,
                factor: 0
            })
        );
        assert_eq!(
            fine.refined(0),
            Err(GridError::NotDivisible {
                number: 1_000_000,
                factor: 0
            })
        );
    }

    #[test]
    fn exact_wrong_questions_are_errors() {
        for step_s in [0.0, -0.001, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                TimeGrid::from_seconds(step_s, 1.0),
                Err(GridError::BadStep { .. })
            ));
            assert!(matches!(
                TimeGrid::from_seconds(0.001, step_s),
                Err(GridError::BadEnd { .. })
            ));
        }
        assert!(matches!(
            TimeGrid::from_seconds(1.0 / 3.0, 1.0),
            Err(GridError::NotWholeNanoseconds { .. })
        ));
        assert!(matches!(
            TimeGrid::from_seconds(1e-10, 1.0),
            Err(GridError::NotWholeNanoseconds { .. })
        ));
        assert_eq!(
            TimeGrid::from_seconds(0.3, 1.0),
            Err(GridError::EndOffGrid {
                tick_ns: 300_000_000,
                end_ns: 1_000_000_000
            })
        );
        assert!(matches!(
            TimeGrid::from_seconds(1.0, 1e300),
            Err(GridError::TooLong { .. })
        ));
        assert_eq!(TimeGrid::new(0, 5), Err(GridError::ZeroTick));
        assert!(matches!(
            TimeGrid::new(u64::MAX, 2),
            Err(GridError::TooLong { .. })
        ));
    }

    proptest! {
        #[test]
        fn prop_seconds_round_trip(tick_ns in 1_u64..1_000_000_000, steps in 1_u64..1_000_000) {
            let grid = TimeGrid::new(tick_ns, steps).unwrap();
            prop_assert_eq!(TimeGrid::from_seconds(grid.step_s(), grid.end_s()), Ok(grid));
            prop_assert_eq!(grid.times_s().next_back(), Some(grid.end_s()));
        }

        #[test]
        fn prop_times_increase(tick_ns in 1_u64..1_000_000, steps in 1_u64..500) {
            let grid = TimeGrid::new(tick_ns, steps).unwrap();
            let times: Vec<f64> = grid.times_s().collect();
            prop_assert_eq!(times.len() as u64, steps + 1);
            prop_assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
        }
    }
}
