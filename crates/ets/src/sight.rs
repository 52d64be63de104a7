//! What the tracker remembers of the target: the line of sight by sampled, delayed frames, and its loss.
//!
//! A frame is captured, is in flight for the camera's latency and is then delivered. At the capture the image point
//! and the gimbal's encoders give the direction to the target in W, so that the platform's motion during the flight
//! does not matter: the delayed frame is not mistaken for a present one. Each delivery corrects direction `s` and rate `ṡ` by a
//! fading-memory filter of second order (Morrison, *Introduction to Sequential Smoothing and Prediction*, 1969): with
//! T since the sighting before,
//!
//! `s⁻ = s + ṡ T`, `e = m − s⁻`, `s ← s⁻ + (1 − δ²) e`, `ṡ ← ṡ + (1 − δ)² e/T`, `s` made a unit vector again.
//!
//! Between frames the line of sight is predicted, `s + ṡ t`. Loss of the target: up to the hold time t_hold after the last
//! sighting the prediction continues (*coasting*: the last rate is held); after that the [`Search`](crate::Search) begins about
//! the direction predicted for that instant. Re-acquisition: a sighting within t_hold corrects the filter; a later one, like
//! the first of all, starts it afresh with `ṡ = 0`.

use crate::image::PointMotion;
use crate::scalar::{choose, flag, is_set, unit};
use crate::tracker::Tracker;
use nalgebra::Vector3;
use quad_math::{Flat, Real, constant};

/// Least time between two sightings, s: guards a division, shorter than any camera's period.
const LEAST_INTERVAL: f64 = 1e-6;

/// A frame between its capture and its delivery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<R: Real> {
    /// Direction to the target in W at the capture, a unit vector; meaningless if it was not visible.
    pub direction: Vector3<R>,
    /// 1 if the target was visible, else 0.
    pub visible: R,
    /// Time since the capture, s.
    pub age: R,
}

/// The tracker's memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight<R: Real> {
    /// Direction `s` to the target in W at the capture of the last sighting, a unit vector.
    pub direction: Vector3<R>,
    /// Its rate `ṡ`, 1/s.
    pub rate: Vector3<R>,
    /// Time since the capture of the last sighting, s.
    pub since: R,
    /// 1 if the frame delivered last showed the target, else 0.
    pub seen: R,
    /// The frame in flight, or delivered last.
    pub frame: Frame<R>,
}

/// What a tracker is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The last frame showed the target.
    Tracking,
    /// The last frame did not; the last rate of the line of sight is held.
    Coasting,
    /// The target has been out of sight for longer than the hold time.
    Searching,
}

impl<R: Real> Sight<R> {
    /// Nothing seen yet: the search begins at once, about this direction in W.
    pub fn nothing_yet(direction: &Vector3<R>, tracker: &Tracker<R>) -> Self {
        let direction = unit(direction);
        Self {
            direction,
            rate: Vector3::zeros(),
            since: tracker.hold,
            seen: R::zero(),
            frame: Frame {
                direction,
                visible: R::zero(),
                age: R::zero(),
            },
        }
    }

    /// With a frame captured now.
    #[inline(always)]
    pub fn capturing(&self, direction: Vector3<R>, visible: R) -> Self {
        Self {
            frame: Frame {
                direction,
                visible,
                age: R::zero(),
            },
            ..*self
        }
    }

    /// With the frame in flight delivered: the filter's correction, or none if the target was not visible.
    #[inline(always)]
    pub fn delivered(&self, tracker: &Tracker<R>) -> Self {
        let Frame {
            direction: m,
            visible,
            age,
        } = self.frame;
        let interval = self.since - age;
        let afresh = flag::<R>(interval.simd_ge(tracker.hold));
        let t = interval.simd_max(constant(LEAST_INTERVAL));
        let (l, delta) = (R::one(), tracker.fading);
        let predicted = unit(&(self.direction + self.rate * t));
        let e = m - predicted;
        let direction = unit(&(predicted + e * (l - delta * delta)));
        let rate = self.rate + e * ((l - delta) * (l - delta) / t);
        // A unit vector turns across itself only.
        let rate = rate - direction * direction.dot(&rate);
        let direction = choose(afresh, &m, &direction);
        let rate = choose(afresh, &Vector3::zeros(), &rate);
        Self {
            direction: choose(visible, &direction, &self.direction),
            rate: choose(visible, &rate, &self.rate),
            since: age.select(is_set(visible), self.since),
            seen: visible,
            frame: self.frame,
        }
    }

    /// The same memory a time `h` (s) later.
    #[inline(always)]
    pub fn aged(&self, h: R) -> Self {
        Self {
            since: self.since + h,
            frame: Frame {
                age: self.frame.age + h,
                ..self.frame
            },
            ..*self
        }
    }

    /// Where to point, in W: the predicted line of sight, or that of the search.
    #[inline(always)]
    pub fn aim(&self, tracker: &Tracker<R>) -> PointMotion<R> {
        let lost = self.since - tracker.hold;
        let searching = flag::<R>(lost.simd_gt(R::zero()));
        let held = self.since.simd_min(tracker.hold);
        let predicted = self.direction + self.rate * held;
        let sought = tracker.search.direction(&predicted, lost.simd_max(R::zero()));
        PointMotion {
            position: choose(searching, &sought, &predicted),
            velocity: choose(searching, &Vector3::zeros(), &self.rate),
            acceleration: Vector3::zeros(),
        }
    }
}

impl Sight<f64> {
    /// What the tracker is doing.
    pub fn mode(&self, tracker: &Tracker<f64>) -> Mode {
        if self.since >= tracker.hold {
            Mode::Searching
        } else if self.seen == 1.0 {
            Mode::Tracking
        } else {
            Mode::Coasting
        }
    }
}

impl<R: Real> Flat<R> for Sight<R> {
    const LEN: usize = 13;

    fn write(&self, out: &mut [R]) {
        self.direction.write(out);
        self.rate.write(&mut out[3..]);
        out[6] = self.since;
        out[7] = self.seen;
        self.frame.direction.write(&mut out[8..]);
        out[11] = self.frame.visible;
        out[12] = self.frame.age;
    }

    fn read(values: &[R]) -> Self {
        Self {
            direction: Vector3::read(values),
            rate: Vector3::read(&values[3..]),
            since: values[6],
            seen: values[7],
            frame: Frame {
                direction: Vector3::read(&values[8..]),
                visible: values[11],
                age: values[12],
            },
        }
    }
}
