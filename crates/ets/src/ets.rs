//! The whole station as one pure step: camera, tracker, gimbal, and the light on a receiver.
//!
//! A step at time `n h`: a frame is captured and delivered if it is due, the tracker commands the gimbal from what it
//! remembers, and the gimbal moves for h with the command held. Everything is an argument: the step's number, the target, the
//! noise. So the engine's agent and a batch rollout agree to the last bit on `f64`.

use crate::atmosphere::Atmosphere;
use crate::beam::{Beam, Ray};
use crate::camera::{Camera, Image};
use crate::clock::{FrameClock, FrameEvent};
use crate::gimbal::{Gimbal, GimbalCommand, GimbalState, Pedestal};
use crate::image::ImageKinematics;
use crate::power::PowerBudget;
use crate::receiver::{Face, LinkGeometry, Receiver};
use crate::sight::Sight;
use crate::station::Station;
use crate::tracker::{Plant, Tracker};
use nalgebra::{Vector2, Vector3};
use quad_math::{Flat, Real, constant, rk4_step};

/// An energy transmission system over one kind of scalar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ets<R> {
    /// Where it stands.
    pub pedestal: Pedestal<R>,
    /// Its gimbal.
    pub gimbal: Gimbal<R>,
    /// Its camera.
    pub camera: Camera<R>,
    /// Its tracker.
    pub tracker: Tracker<R>,
    /// Its beam.
    pub beam: Beam<R>,
    /// The air in front of it.
    pub atmosphere: Atmosphere<R>,
    /// The receiver that it serves.
    pub receiver: Receiver<R>,
}

/// What changes while a station runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EtsState<R: Real> {
    /// The gimbal.
    pub gimbal: GimbalState<R>,
    /// The tracker's memory.
    pub sight: Sight<R>,
}

/// What a step is given from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EtsInput<R: Real> {
    /// The target's position in W, m.
    pub target: Vector3<R>,
    /// Noise of this step's image, px, if a frame is captured: a sample that the caller drew, zero for none.
    pub noise: Vector2<R>,
}

/// The light on a receiver: geometry and power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<R: Real> {
    /// Range, incidence, spot offset.
    pub geometry: LinkGeometry<R>,
    /// Where the power goes.
    pub power: PowerBudget<R>,
}

impl<R: Real> Ets<R> {
    /// The station of a parameter set.
    pub fn new(station: &Station) -> Self {
        Self {
            pedestal: station.pedestal.over(),
            gimbal: station.gimbal.over(),
            camera: station.camera.over(),
            tracker: station.tracker.over(),
            beam: station.beam.over(),
            atmosphere: station.atmosphere.over(),
            receiver: station.receiver.over(),
        }
    }

    /// At rest at these angles (rad), nothing seen yet.
    pub fn at_rest(&self, pan: R, tilt: R) -> EtsState<R> {
        let gimbal = GimbalState::at_rest(pan, tilt);
        EtsState {
            gimbal,
            sight: Sight::nothing_yet(&self.axis(&gimbal), &self.tracker),
        }
    }

    /// The optical axis, which is the beam's direction too, in W: a unit vector.
    #[inline(always)]
    pub fn axis(&self, gimbal: &GimbalState<R>) -> Vector3<R> {
        self.pedestal.rotation(gimbal).matrix.column(0).into_owned()
    }

    /// What the camera sees of a target in W, without noise or rounding.
    #[inline(always)]
    pub fn view(&self, gimbal: &GimbalState<R>, target: &Vector3<R>) -> Image<R> {
        let r_wc = self.pedestal.rotation(gimbal).matrix;
        self.camera
            .project(&r_wc.tr_mul(&(target - self.pedestal.origin())))
    }

    /// The rates that the tracker commands.
    #[inline(always)]
    pub fn command(&self, state: &EtsState<R>) -> GimbalCommand<R> {
        let plant = Plant {
            state: &state.gimbal,
            gimbal: &self.gimbal,
            pedestal: &self.pedestal,
            kinematics: ImageKinematics {
                focal_length: self.camera.focal_length,
            },
        };
        self.tracker
            .dynamics
            .command(&plant, &state.sight.aim(&self.tracker))
    }

    /// Step number `n` of the clock, from time `n h` to `(n + 1) h`: [`Ets::look`], then [`Ets::turn`].
    #[inline(always)]
    pub fn step(&self, clock: &FrameClock, n: u64, state: &EtsState<R>, input: &EtsInput<R>) -> EtsState<R> {
        self.turn(&self.look(clock, n, state, input), constant(clock.step_s()))
    }

    /// The first half of step `n`: a frame is captured and delivered if it is due; no time passes.
    #[inline(always)]
    pub fn look(&self, clock: &FrameClock, n: u64, state: &EtsState<R>, input: &EtsInput<R>) -> EtsState<R> {
        let sight = self.see(clock.event(n), state, input);
        EtsState { sight, ..*state }
    }

    /// The second half of a step: the gimbal turns for `h` seconds under the [`Ets::command`] of now.
    #[inline(always)]
    pub fn turn(&self, state: &EtsState<R>, h: R) -> EtsState<R> {
        EtsState {
            gimbal: rk4_step(&self.gimbal, &state.gimbal, &self.command(state), h),
            sight: state.sight.aged(h),
        }
    }

    /// The tracker's memory after what happens to frames now.
    #[inline(always)]
    fn see(&self, event: FrameEvent, state: &EtsState<R>, input: &EtsInput<R>) -> Sight<R> {
        let capture = |sight: &Sight<R>| {
            let image = self
                .camera
                .read_out(&self.view(&state.gimbal, &input.target), &input.noise);
            let r_wc = self.pedestal.rotation(&state.gimbal).matrix;
            sight.capturing(r_wc * self.camera.direction(&image.point), image.visible)
        };
        match event {
            FrameEvent::None => state.sight,
            FrameEvent::Capture => capture(&state.sight),
            FrameEvent::Deliver => state.sight.delivered(&self.tracker),
            FrameEvent::CaptureThenDeliver => capture(&state.sight).delivered(&self.tracker),
            FrameEvent::DeliverThenCapture => capture(&state.sight.delivered(&self.tracker)),
        }
    }

    /// The axis of the beam.
    #[inline(always)]
    pub fn ray(&self, gimbal: &GimbalState<R>) -> Ray<R> {
        let r_we = self.pedestal.rotation(gimbal).matrix;
        Ray {
            origin: self.pedestal.origin() + r_we * Vector3::from(self.beam.offset),
            direction: r_we.column(0).into_owned(),
        }
    }

    /// The light on the receiver's face: geometry and power.
    #[inline(always)]
    pub fn link(&self, gimbal: &GimbalState<R>, face: &Face<R>) -> Link<R> {
        let ray = self.ray(gimbal);
        let light = self.beam.through(&self.atmosphere);
        Link {
            geometry: face.under(&ray),
            power: light.budget(&ray, face, &self.receiver.aperture, self.receiver.efficiency),
        }
    }
}

impl<R: Real> Flat<R> for EtsState<R> {
    const LEN: usize = <GimbalState<R> as Flat<R>>::LEN + <Sight<R> as Flat<R>>::LEN;

    fn write(&self, out: &mut [R]) {
        self.gimbal.write(out);
        self.sight.write(&mut out[<GimbalState<R> as Flat<R>>::LEN..]);
    }

    fn read(values: &[R]) -> Self {
        Self {
            gimbal: GimbalState::read(values),
            sight: Sight::read(&values[<GimbalState<R> as Flat<R>>::LEN..]),
        }
    }
}
