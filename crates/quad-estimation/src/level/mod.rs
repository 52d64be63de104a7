//! The process of a flying quadrotor: any level's model, with what disturbs it and what its sensors get wrong.
//!
//! ```text
//! state      model's own state, d_B, b_g, b_a
//! dynamics   ẋ = f(x, u) of the level, the disturbance d_B added to its specific force, in steps of RK4
//! errors     δ = [δr, δv, δθ, δω, δrotors, δsupply, δd, δb_g, δb_a]
//! noise      Q = h · diag(densities²), added after the step
//! readings   accelerometer f(x, u) + d_B + b_a, gyroscope ω + b_g, the others by position and attitude
//! ```
//!
//! The filter is driven by the commands, not by the inertial unit: the model predicts rates and specific force,
//! and gyroscope and accelerometer are measurements like any other. That is what makes the level matter. The
//! disturbance `d_B` is a random walk of specific force, for all that the level leaves out or has wrong (wind, drag, a thrust gain);
//! without it an accelerometer could tell nothing that the model does not know already, and white noise would have to cover
//! steady errors.
//!
//! Assumptions: biases and the disturbance walk randomly; within a step the disturbance acts along the body as it was at
//! the end, an error of second order in the step; Q is of first order in the step. Source of the error state: Solà (2017),
//! chapter 5; of disturbances as states: Muske and Badgwell, *J. Process Control* 12 (2002); the rest is this project's choice.

mod jacobian;
mod layout;
mod uncertainty;

pub use layout::places;
pub(crate) use layout::turn_between;
pub use uncertainty::{InitialUncertainty, ProcessNoise};

use crate::sensor::{Instrument, Reading, Seen};
use crate::{Belief, EstimationError, Process};
use jacobian::{Seeded, by_chunks};
use layout::{EXTRAS, Layout};
use nalgebra::{DMatrix, DVector, Vector3};
use quad_dynamics::{AnyQuadrotor, BuildError, Input, Level, PhenomenonSet, Snapshot, Vehicle};
use quad_math::{FixedStep, Flat, Real, constant};

/// Longest step of the integrator, s; longer predictions take several.
const LONGEST_STEP_S: f64 = 0.01;
/// Largest step times pole: RK4 is stable to 2.8 and good to 1 % of a decay at 1.5.
const STEP_TIMES_POLE: f64 = 1.5;

/// A level's model as a filter sees it.
#[derive(Clone, Debug)]
pub struct LevelProcess {
    model: AnyQuadrotor<f64>,
    dual: AnyQuadrotor<Seeded>,
    layout: Layout,
    noise: ProcessNoise,
}

/// The model's numbers a step later, disturbance included.
fn step<R: Real>(
    model: &mut AnyQuadrotor<R>,
    layout: &Layout,
    x: &[R],
    input: &Input<R>,
    step_s: f64,
) -> Vec<R> {
    let pieces = (step_s / layout.longest_step_s).ceil().max(1.0);
    let h: R = constant(step_s / pieces);
    let d_b = layout.disturbance(x);
    let mut moved = x.to_vec();
    for _ in 0..pieces as u64 {
        model.read_state(&moved);
        model.step(FixedStep::Rk4, input, h);
        model.write_state(&mut moved);
        layout.push(&mut moved, &d_b, h);
    }
    moved
}

/// What a state shows: the level's model and the disturbance.
fn seen<R: Real>(model: &mut AnyQuadrotor<R>, layout: &Layout, x: &[R], input: &Input<R>) -> Seen<R> {
    model.read_state(x);
    let mut seen = Seen::of(model, input);
    seen.specific_force += layout.disturbance(x);
    seen
}

/// What an instrument is expected to read.
fn read<R: Real>(
    model: &mut AnyQuadrotor<R>,
    layout: &Layout,
    x: &[R],
    input: &Input<R>,
    instrument: Instrument,
) -> Reading<R> {
    let seen = seen(model, layout, x, input);
    match (instrument, instrument.ideal(&seen)) {
        (Instrument::Accelerometer, Reading::Vector(f)) => Reading::Vector(f + layout.accelerometer_bias(x)),
        (Instrument::Gyroscope, Reading::Vector(w)) => Reading::Vector(w + layout.gyroscope_bias(x)),
        (_, reading) => reading,
    }
}

/// An input as constants of another scalar.
fn lifted<R: Real>(input: &Input<f64>) -> Input<R> {
    Input {
        commands: input.commands.map(constant),
        wind: input.wind.map(constant),
        air_rates: input.air_rates.map(constant),
    }
}

impl LevelProcess {
    /// The process of a vehicle at a level with these phenomena and this noise.
    ///
    /// # Errors
    /// A model that can't be built; noise that is not positive.
    pub fn new(
        level: Level,
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        noise: ProcessNoise,
    ) -> Result<Self, LevelError> {
        noise.validate()?;
        let model = AnyQuadrotor::hovering(level, vehicle, phenomena, Vector3::zeros(), 0.0)?;
        let dual = AnyQuadrotor::hovering(
            level,
            vehicle,
            phenomena,
            Vector3::zeros(),
            constant::<Seeded>(0.0),
        )?;
        let longest_step_s = LONGEST_STEP_S.min(STEP_TIMES_POLE / model.fastest_pole());
        let layout = Layout::of(&model, longest_step_s);
        Ok(Self {
            model,
            dual,
            layout,
            noise,
        })
    }

    /// The level.
    pub fn level(&self) -> Level {
        self.model.level()
    }

    /// What disturbs it.
    pub fn noise(&self) -> &ProcessNoise {
        &self.noise
    }

    /// The input that holds a hover.
    pub fn hover_input(&self) -> Input<f64> {
        self.model.hover_input()
    }

    /// A belief about a flight: undisturbed, unbiased, uncertain by these deviations.
    ///
    /// # Errors
    /// A deviation that is not positive and finite; a flight that is not finite.
    pub fn belief(
        &self,
        flight: &Snapshot<f64>,
        input: &Input<f64>,
        uncertainty: &InitialUncertainty,
    ) -> Result<Belief, EstimationError> {
        uncertainty.validate()?;
        let mut model = self.model.clone();
        model.adopt(flight, input);
        let mut mean = DVector::zeros(self.layout.state_len());
        model.write_state(mean.as_mut_slice());
        let deviations = uncertainty.deviations(&self.layout);
        Belief::new(mean, DMatrix::from_diagonal(&deviations.map(|s| s * s)))
    }

    /// The model in a believed state: what a controller flies by.
    pub fn model_at(&mut self, mean: &DVector<f64>) -> &AnyQuadrotor<f64> {
        self.model.read_state(mean.as_slice());
        &self.model
    }

    /// What there is to be seen of a state: where the process is the truth, its sensors look at this.
    pub fn seen(&mut self, x: &DVector<f64>, input: &Input<f64>) -> Seen<f64> {
        seen(&mut self.model, &self.layout, x.as_slice(), input)
    }

    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// `y(x ⊞ δ)` by the model over numbers, and its Jacobian at `δ = 0` over dual numbers.
    pub(crate) fn jacobian_of(
        &mut self,
        x: &DVector<f64>,
        outputs: usize,
        mut f: impl FnMut(&mut AnyQuadrotor<Seeded>, &Layout, &[Seeded]) -> Vec<Seeded>,
    ) -> DMatrix<f64> {
        let Self { dual, layout, .. } = self;
        let x: Vec<Seeded> = x.iter().map(|&value| constant(value)).collect();
        by_chunks(layout.error_len(), outputs, |error| {
            f(dual, layout, &layout.retract(&x, error))
        })
    }
}

/// Why a process of a level can't be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LevelError {
    /// The model can't be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// Its noise makes no sense.
    #[error(transparent)]
    Noise(#[from] EstimationError),
}

impl Process for LevelProcess {
    type Input = Input<f64>;
    type Instrument = Instrument;

    fn state_len(&self) -> usize {
        self.layout.state_len()
    }

    fn error_len(&self) -> usize {
        self.layout.error_len()
    }

    fn readings(&self, instrument: Instrument) -> usize {
        instrument.readings()
    }

    fn retract(&self, x: &DVector<f64>, error: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.layout.retract(x.as_slice(), error.as_slice()))
    }

    fn local(&self, reference: &DVector<f64>, x: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.layout.local(reference.as_slice(), x.as_slice()))
    }

    fn reset_jacobian(&self, error: &DVector<f64>) -> DMatrix<f64> {
        self.layout.reset_jacobian(error.as_slice())
    }

    fn transition(&mut self, x: &DVector<f64>, input: &Input<f64>, step_s: f64) -> DVector<f64> {
        DVector::from_vec(step(&mut self.model, &self.layout, x.as_slice(), input, step_s))
    }

    fn transition_jacobian(&mut self, x: &DVector<f64>, input: &Input<f64>, step_s: f64) -> DMatrix<f64> {
        let after = self.transition(x, input, step_s);
        let reference: Vec<Seeded> = after.iter().map(|&value| constant(value)).collect();
        let input = lifted(input);
        let n = self.layout.error_len();
        // Biases stand still: their columns are those of the identity, and what is left is seeded.
        let seeded = n - (EXTRAS - 3);
        let Self { dual, layout, .. } = self;
        let x: Vec<Seeded> = x.iter().map(|&value| constant(value)).collect();
        let zeros = vec![constant::<Seeded>(0.0); EXTRAS - 3];
        let mut jacobian = DMatrix::identity(n, n);
        let columns = by_chunks(seeded, n, |error| {
            let error = [error, &zeros].concat();
            let moved = step(dual, layout, &layout.retract(&x, &error), &input, step_s);
            layout.local(&reference, &moved)
        });
        jacobian.columns_mut(0, seeded).copy_from(&columns);
        jacobian
    }

    fn process_noise(&self, step_s: f64) -> DVector<f64> {
        self.noise
            .densities(&self.layout)
            .map(|density| density * density * step_s)
    }

    fn observe(&mut self, x: &DVector<f64>, input: &Input<f64>, instrument: Instrument) -> DVector<f64> {
        let reading = read(&mut self.model, &self.layout, x.as_slice(), input, instrument);
        DVector::from_column_slice(reading.as_slice())
    }

    fn observe_jacobian(
        &mut self,
        x: &DVector<f64>,
        input: &Input<f64>,
        instrument: Instrument,
    ) -> DMatrix<f64> {
        let input = lifted(input);
        self.jacobian_of(x, instrument.readings(), |dual, layout, x| {
            read(dual, layout, x, &input, instrument).as_slice().to_vec()
        })
    }
}

impl Layout {
    /// The disturbance d pushes for h seconds: `r += R d h²/2`, `v += d h`.
    fn push<R: Real>(&self, x: &mut [R], d_b: &Vector3<R>, h: R) {
        let rotation = self.attitude(x).rotation().matrix;
        let d_w = rotation * d_b;
        let kick = if self.velocity_is_along_body() { *d_b } else { d_w } * h;
        let moved = Vector3::<R>::read(x) + d_w * (h * h * constant(0.5));
        let faster = Vector3::<R>::read(&x[3..]) + kick;
        moved.write(x);
        faster.write(&mut x[3..]);
    }
}
