use crate::{ClockError, FrameClock, FrameEvent};

fn events(clock: &FrameClock, steps: u64) -> Vec<(u64, FrameEvent)> {
    (0..steps)
        .map(|n| (n, clock.event(n)))
        .filter(|(_, event)| *event != FrameEvent::None)
        .collect()
}

#[test]
fn exact_fifty_hertz_with_latency() {
    let clock = FrameClock::new(0.005, 50.0, 0.01).unwrap();
    use FrameEvent::{Capture, Deliver};
    assert_eq!(
        events(&clock, 9),
        [
            (0, Capture),
            (2, Deliver),
            (4, Capture),
            (6, Deliver),
            (8, Capture)
        ]
    );
}

#[test]
fn exact_order_within_one_step() {
    let at_once = FrameClock::new(0.01, 50.0, 0.0).unwrap();
    assert_eq!(
        events(&at_once, 3),
        [
            (0, FrameEvent::CaptureThenDeliver),
            (2, FrameEvent::CaptureThenDeliver)
        ]
    );
    // Steps of 10 ms, a latency of 15 ms: the frame of step 0 arrives in step 2, just before the next is taken.
    let late = FrameClock::new(0.01, 50.0, 0.015).unwrap();
    assert_eq!(
        events(&late, 3),
        [(0, FrameEvent::Capture), (2, FrameEvent::DeliverThenCapture)]
    );
}

/// 30 Hz on 1 ms: the period is no whole number of steps, yet after an hour there are exactly 30 × 3600 frames, each captured
/// less than a step late.
#[test]
fn exact_no_drift_over_an_hour() {
    let clock = FrameClock::new(0.001, 30.0, 0.03).unwrap();
    let (mut captured, mut delivered) = (0_u64, 0_u64);
    for n in 0..3_600_000_u64 {
        let event = clock.event(n);
        if matches!(event, FrameEvent::Capture | FrameEvent::DeliverThenCapture) {
            // The period is rounded to 33 333 333 ns.
            let due = captured as f64 * 33_333_333e-9;
            let late = n as f64 * 1e-3 - due;
            // Rounding of numbers up to 3600 s.
            assert!((-1e-9..1e-3).contains(&late), "frame {captured}: {late}");
            captured += 1;
        }
        if matches!(event, FrameEvent::Deliver | FrameEvent::DeliverThenCapture) {
            delivered += 1;
            assert_eq!(captured, delivered, "one frame in flight");
        }
    }
    // Frames 0 to 107 999; the rounded period is 1/3 ns short, 36 µs over an hour, which is below a step.
    assert_eq!((captured, delivered), (108_000, 108_000));
}

#[test]
fn exact_bad_times_are_refused() {
    assert!(matches!(
        FrameClock::new(0.0, 30.0, 0.0),
        Err(ClockError::BadTime { value_s: 0.0, .. })
    ));
    assert!(matches!(
        FrameClock::new(f64::NAN, 30.0, 0.0),
        Err(ClockError::BadTime { .. })
    ));
    assert!(matches!(
        FrameClock::new(0.001, 0.0, 0.0),
        Err(ClockError::BadTime { .. })
    ));
    assert!(matches!(
        FrameClock::new(0.001, -30.0, 0.0),
        Err(ClockError::BadTime { .. })
    ));
    assert!(matches!(
        FrameClock::new(0.001, 30.0, -0.001),
        Err(ClockError::BadTime { .. })
    ));
    assert!(matches!(
        FrameClock::new(0.1, 30.0, 0.0),
        Err(ClockError::StepBeyondPeriod { step_s: 0.1, .. })
    ));
    let error = FrameClock::new(0.001, 30.0, 0.04).unwrap_err();
    assert!(matches!(
        error,
        ClockError::LatencyBeyondPeriod { latency_s: 0.04, .. }
    ));
    assert!(error.to_string().contains("0.04 s"), "{error}");
}
