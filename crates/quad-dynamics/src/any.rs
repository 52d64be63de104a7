//! A quadrotor whose level is chosen, and may be changed, at run time.

use crate::model::StateOf;
use crate::{
    BuildError, Flight, Input, Kick, Level, Level1, Level2, Level3, Level4, Level5, PhenomenonSet,
    QuadrotorModel, Snapshot, Vehicle,
};
use nalgebra::Vector3;
use quad_math::{FixedStep, Flat, Real};

/// A model together with the state it is in.
#[derive(Clone, Debug)]
pub struct InFlight<R: Real, M: QuadrotorModel<R>> {
    /// The model.
    pub model: M,
    /// Its state.
    pub state: StateOf<R, M>,
}

/// A flying quadrotor of any level: model and state in one value, so that they can't be mismatched.
#[derive(Clone, Debug)]
pub enum AnyQuadrotor<R: Real> {
    /// Level 1.
    One(InFlight<R, Level1<R>>),
    /// Level 2.
    Two(InFlight<R, Level2<R>>),
    /// Level 3.
    Three(InFlight<R, Level3<R>>),
    /// Level 4.
    Four(InFlight<R, Level4<R>>),
    /// Level 5.
    Five(InFlight<R, Level5<R>>),
}

/// The same expression for whichever level is inside.
macro_rules! each_level {
    ($quadrotor:expr, $inner:ident => $body:expr) => {
        match $quadrotor {
            AnyQuadrotor::One($inner) => $body,
            AnyQuadrotor::Two($inner) => $body,
            AnyQuadrotor::Three($inner) => $body,
            AnyQuadrotor::Four($inner) => $body,
            AnyQuadrotor::Five($inner) => $body,
        }
    };
}

impl<R: Real, M: QuadrotorModel<R>> InFlight<R, M> {
    /// A vehicle in level hover at a position in W, m, heading ψ, rad.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    pub fn hovering(
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        position: Vector3<R>,
        yaw: R,
    ) -> Result<Self, BuildError> {
        let model = M::build(vehicle, phenomena)?;
        let state = model.hover(position, yaw).state;
        Ok(Self { model, state })
    }

    fn adopting(
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        snapshot: &Snapshot<R>,
        input: &Input<R>,
    ) -> Result<Self, BuildError> {
        let model = M::build(vehicle, phenomena)?;
        let state = model.adopt(snapshot, input);
        Ok(Self { model, state })
    }
}

impl<R: Real> AnyQuadrotor<R> {
    /// A vehicle at a level in level hover at a position in W, m, heading ψ, rad.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    pub fn hovering(
        level: Level,
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        position: Vector3<R>,
        yaw: R,
    ) -> Result<Self, BuildError> {
        Ok(match level {
            Level::One => Self::One(InFlight::hovering(vehicle, phenomena, position, yaw)?),
            Level::Two => Self::Two(InFlight::hovering(vehicle, phenomena, position, yaw)?),
            Level::Three => Self::Three(InFlight::hovering(vehicle, phenomena, position, yaw)?),
            Level::Four => Self::Four(InFlight::hovering(vehicle, phenomena, position, yaw)?),
            Level::Five => Self::Five(InFlight::hovering(vehicle, phenomena, position, yaw)?),
        })
    }

    /// A vehicle at a level in the middle of a flight, driven by this input.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    pub fn from_snapshot(
        level: Level,
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        snapshot: &Snapshot<R>,
        input: &Input<R>,
    ) -> Result<Self, BuildError> {
        Ok(match level {
            Level::One => Self::One(InFlight::adopting(vehicle, phenomena, snapshot, input)?),
            Level::Two => Self::Two(InFlight::adopting(vehicle, phenomena, snapshot, input)?),
            Level::Three => Self::Three(InFlight::adopting(vehicle, phenomena, snapshot, input)?),
            Level::Four => Self::Four(InFlight::adopting(vehicle, phenomena, snapshot, input)?),
            Level::Five => Self::Five(InFlight::adopting(vehicle, phenomena, snapshot, input)?),
        })
    }

    /// The same flight continued at another level, without a jump in what both levels have: position,
    /// velocity, attitude, rates, and thrust and torque where the new level has states for them.
    ///
    /// # Errors
    /// As [`QuadrotorModel::build`].
    pub fn at_level(
        &self,
        level: Level,
        vehicle: &Vehicle,
        phenomena: &PhenomenonSet,
        input: &Input<R>,
    ) -> Result<Self, BuildError> {
        Self::from_snapshot(level, vehicle, phenomena, &self.snapshot(input), input)
    }

    /// The level.
    pub fn level(&self) -> Level {
        match self {
            Self::One(_) => Level::One,
            Self::Two(_) => Level::Two,
            Self::Three(_) => Level::Three,
            Self::Four(_) => Level::Four,
            Self::Five(_) => Level::Five,
        }
    }

    /// Flies one step of `h` seconds with the input held.
    #[inline]
    pub fn step(&mut self, method: FixedStep, input: &Input<R>, h: R) {
        each_level!(self, q => q.state = method.step(&q.model, &q.state, input, h));
    }

    /// Changes velocity and body rates suddenly.
    pub fn kick(&mut self, kick: &Kick<R>) {
        each_level!(self, q => q.state = q.model.kicked(&q.state, kick));
    }

    /// What can be seen of the flight.
    #[inline]
    pub fn flight(&self) -> Flight<R> {
        each_level!(self, q => q.model.flight(&q.state))
    }

    /// Shows what can be seen of the flight to `look`: as [`Self::flight`], but only what is looked at is computed.
    ///
    /// The look is compiled into each level, so that Euler angles that nobody asks for cost nothing.
    #[inline(always)]
    pub fn see<T>(&self, look: impl FnOnce(&Flight<R>) -> T) -> T {
        each_level!(self, q => look(&q.model.flight(&q.state)))
    }

    /// Specific force at the centre of mass, along B, m/s²: what an ideal accelerometer there reads under this input.
    pub fn specific_force(&self, input: &Input<R>) -> Vector3<R> {
        each_level!(self, q => q.model.specific_force(&q.state, input))
    }

    /// The flight in terms that every level understands.
    pub fn snapshot(&self, input: &Input<R>) -> Snapshot<R> {
        each_level!(self, q => q.model.snapshot(&q.state, input))
    }

    /// The input that would hold hover.
    pub fn hover_input(&self) -> Input<R> {
        each_level!(self, q => q.model.hover(Vector3::zeros(), R::zero()).input)
    }

    /// The phenomena switched on.
    pub fn phenomena(&self) -> &PhenomenonSet {
        each_level!(self, q => q.model.phenomena())
    }

    /// How many numbers the state has.
    pub fn state_len(&self) -> usize {
        fn len<X: Flat<S>, S: Real>(_: &X) -> usize {
            X::LEN
        }
        each_level!(self, q => len::<_, R>(&q.state))
    }

    /// The state as numbers, in the order of its [`Flat`] implementation.
    pub fn write_state(&self, out: &mut [R]) {
        each_level!(self, q => q.state.write(out));
    }

    /// Takes the state from numbers in the order of its [`Flat`] implementation: the reverse of
    /// [`Self::write_state`].
    ///
    /// # Panics
    /// If there are fewer than [`Self::state_len`] numbers: a programming error, not an input error.
    pub fn read_state(&mut self, values: &[R]) {
        each_level!(self, q => q.state = Flat::read(values));
    }

    /// Takes over a flight that another model flew until now, driven by this input.
    ///
    /// As [`Self::from_snapshot`] with the model that is here already: nothing is built, so nothing can fail.
    pub fn adopt(&mut self, snapshot: &Snapshot<R>, input: &Input<R>) {
        each_level!(self, q => q.state = q.model.adopt(snapshot, input));
    }
}
