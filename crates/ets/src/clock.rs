//! When frames are captured and delivered, on the exact grid of the simulation.
//!
//! Frame k is due at `k T`, T the camera's period. It is captured at the first step at or after that instant and delivered at the first
//! step at or after `k T` + latency. All in whole nanoseconds, so no drift; a period that is not a whole number of steps
//! (30 Hz on 1 ms) jitters by less than a step. One frame at most is in flight: the latency is below the period.

/// Nanoseconds in a second.
const NANOSECONDS_PER_SECOND: f64 = 1e9;

/// The camera's frames on a grid of steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameClock {
    step_ns: u64,
    period_ns: u64,
    latency_ns: u64,
}

/// What happens to frames at a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameEvent {
    /// Nothing.
    None,
    /// A frame is captured.
    Capture,
    /// The frame in flight is delivered.
    Deliver,
    /// A frame is captured and delivered at once.
    CaptureThenDeliver,
    /// The frame in flight is delivered, then the next one is captured.
    DeliverThenCapture,
}

/// Why a [`FrameClock`] cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ClockError {
    /// A time that is not finite, negative, or (step, period) not at least a nanosecond.
    #[error("{what} must be finite and at least {least_s} s, got {value_s} s")]
    BadTime {
        /// Which time.
        what: &'static str,
        /// The value given, s.
        value_s: f64,
        /// Least value accepted, s.
        least_s: f64,
    },
    /// Steps longer than the period would skip frames.
    #[error("the step must not exceed the camera's period, {period_s} s, got {step_s} s")]
    StepBeyondPeriod {
        /// The step, s.
        step_s: f64,
        /// The camera's period, s.
        period_s: f64,
    },
    /// A second frame would be in flight before the first is delivered.
    #[error(
        "the latency must be below the camera's period, {period_s} s (at most one frame in flight), got {latency_s} s"
    )]
    LatencyBeyondPeriod {
        /// The latency, s.
        latency_s: f64,
        /// The camera's period, s.
        period_s: f64,
    },
}

impl FrameClock {
    /// The clock of a camera with this frame rate (Hz) and latency (s) on steps of `step_s` (s).
    ///
    /// # Errors
    /// A time that is not positive (latency: negative) or not finite, a step longer than the period, a latency not below it.
    pub fn new(step_s: f64, frame_rate_hz: f64, latency_s: f64) -> Result<Self, ClockError> {
        let period_s = 1.0 / frame_rate_hz;
        let step_ns = nanoseconds("the step", step_s, 1)?;
        let period_ns = nanoseconds("the camera's period", period_s, 1)?;
        let latency_ns = nanoseconds("the camera's latency", latency_s, 0)?;
        if step_ns > period_ns {
            return Err(ClockError::StepBeyondPeriod { step_s, period_s });
        }
        if latency_ns >= period_ns {
            return Err(ClockError::LatencyBeyondPeriod { latency_s, period_s });
        }
        Ok(Self {
            step_ns,
            period_ns,
            latency_ns,
        })
    }

    /// Length of a step, s.
    pub fn step_s(&self) -> f64 {
        self.step_ns as f64 / NANOSECONDS_PER_SECOND
    }

    /// What happens at step `n`, that is at time `n` times the step.
    pub fn event(&self, n: u64) -> FrameEvent {
        let capture = self.due(n, 0);
        let delivery = self.due(n, self.latency_ns);
        match (capture, delivery) {
            (None, None) => FrameEvent::None,
            (Some(_), None) => FrameEvent::Capture,
            (None, Some(_)) => FrameEvent::Deliver,
            (Some(captured), Some(delivered)) if captured == delivered => FrameEvent::CaptureThenDeliver,
            (Some(_), Some(_)) => FrameEvent::DeliverThenCapture,
        }
    }

    /// The frame that falls due, `delay` after its instant, in the step that ends at `n`.
    fn due(&self, n: u64, delay_ns: u64) -> Option<u128> {
        // None before the delay has passed. 128 bits hold any product of two 64-bit numbers.
        let frame = |steps: u64| {
            let now = u128::from(steps) * u128::from(self.step_ns);
            now.checked_sub(u128::from(delay_ns))
                .map(|late| late / u128::from(self.period_ns))
        };
        let now = frame(n)?;
        let before = n.checked_sub(1).and_then(frame);
        (before != Some(now)).then_some(now)
    }
}

fn nanoseconds(what: &'static str, value_s: f64, least_ns: u64) -> Result<u64, ClockError> {
    let ns = (value_s * NANOSECONDS_PER_SECOND).round();
    if ns.is_finite() && ns >= least_ns as f64 && ns < u64::MAX as f64 {
        return Ok(ns as u64);
    }
    Err(ClockError::BadTime {
        what,
        value_s,
        least_s: least_ns as f64 / NANOSECONDS_PER_SECOND,
    })
}
