//! A quadrotor whose level is chosen, and may be changed, at run time.

use crate::{
    AnyQuadrotor, BuildError, Flight, InFlight, Input, Kick, Level, LevelModel, PhenomenonSet,
    QuadrotorModel, RigidBodyState, Snapshot, Vehicle, WithLevel, WithQuadrotor,
};
use nalgebra::Vector3;
use quad_math::{FixedStep, Flat, Real};

/// Level hover of a vehicle, for any level.
struct Hovering<'a, R: Real> {
    vehicle: &'a Vehicle,
    phenomena: &'a PhenomenonSet,
    position: Vector3<R>,
    yaw: R,
}

impl<R: Real> WithLevel<R> for Hovering<'_, R> {
    type Out = Result<AnyQuadrotor<R>, BuildError>;

    fn with<M: LevelModel<R>>(self) -> Self::Out {
        InFlight::hovering(self.vehicle, self.phenomena, self.position, self.yaw).map(M::any)
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
        level.visit(Hovering {
            vehicle,
            phenomena,
            position,
            yaw,
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
        let mut quadrotor = Self::hovering(level, vehicle, phenomena, Vector3::zeros(), R::zero())?;
        quadrotor.adopt(snapshot, input);
        Ok(quadrotor)
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

    /// Does something with the quadrotor, whatever its level.
    #[inline(always)]
    pub fn visit<V: WithQuadrotor<R>>(&mut self, visitor: V) -> V::Out {
        each_level!(self, q => visitor.with(q))
    }

    /// The level.
    #[inline]
    pub fn level(&self) -> Level {
        fn level<R: Real, M: LevelModel<R>>(_: &InFlight<R, M>) -> Level {
            M::LEVEL
        }
        each_level!(self, q => level(q))
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

    /// The rigid body of its state, where the level has one in body axes; `None` at level 1.
    pub fn rigid_body(&mut self) -> Option<&mut RigidBodyState<R>> {
        fn of<R: Real, M: QuadrotorModel<R>>(q: &mut InFlight<R, M>) -> Option<&mut RigidBodyState<R>> {
            M::rigid_body(&mut q.state)
        }
        each_level!(self, q => of(q))
    }

    /// Natural sizes of the states of rotors and supply: [`QuadrotorModel::own_scales`].
    pub fn own_scales(&self) -> Vec<R> {
        each_level!(self, q => q.model.own_scales())
    }

    /// An upper bound of the fastest pole of its rotors, rad/s: [`QuadrotorModel::fastest_pole`].
    pub fn fastest_pole(&self) -> R {
        each_level!(self, q => q.model.fastest_pole())
    }
}
