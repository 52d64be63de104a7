//! The five pairs of model and controller, chosen at run time.

use crate::cost::Cost;
use crate::error::ProblemError;
use crate::mission::{Mission, Pairing, Timing};
use crate::path::Path;
use crate::rollout::{Agents, Instant, Tally, rollout};
use ets::Ets;
use quad_dynamics::{Level, Level1, Level2, Level3, Level4, Level5, QuadrotorModel};
use quad_math::{Real, constant};
use quad_ndi::{C1, C2, C3, Controller, ControllerError, Leg};

/// Vehicle, controller and station of a level, over one kind of scalar: c1 on level 1, c2 on level 2, c3 above.
#[derive(Clone, Debug)]
pub(crate) enum Fleet<R: Real> {
    One(Agents<R, Level1<R>, C1<R>>),
    Two(Agents<R, Level2<R>, C2<R>>),
    Three(Agents<R, Level3<R>, C3<R>>),
    Four(Agents<R, Level4<R>, C3<R>>),
    Five(Agents<R, Level5<R>, C3<R>>),
}

impl<R: Real> Fleet<R> {
    /// Everybody of a mission at a level.
    pub(crate) fn build(mission: &Mission, level: Level, cost: &Cost<f64>) -> Result<Self, ProblemError> {
        let (vehicle, settings) = (&mission.vehicle, &mission.settings);
        Ok(match level {
            Level::One => Self::One(agents(mission, level, cost, C1::new(vehicle, settings))?),
            Level::Two => Self::Two(agents(mission, level, cost, C2::new(vehicle, settings))?),
            Level::Three => Self::Three(agents(mission, level, cost, C3::new(vehicle, settings))?),
            Level::Four => Self::Four(agents(mission, level, cost, C3::new(vehicle, settings))?),
            Level::Five => Self::Five(agents(mission, level, cost, C3::new(vehicle, settings))?),
        })
    }

    /// The level.
    pub(crate) fn level(&self) -> Level {
        match self {
            Self::One(_) => Level::One,
            Self::Two(_) => Level::Two,
            Self::Three(_) => Level::Three,
            Self::Four(_) => Level::Four,
            Self::Five(_) => Level::Five,
        }
    }

    /// The station.
    pub(crate) fn ets(&self) -> &Ets<R> {
        match self {
            Self::One(a) => &a.ets,
            Self::Two(a) => &a.ets,
            Self::Three(a) => &a.ets,
            Self::Four(a) => &a.ets,
            Self::Five(a) => &a.ets,
        }
    }

    /// The path along a leg, as the level's controller is told it.
    pub(crate) fn path(&self, leg: Leg<R>, gravity: f64) -> Path<R> {
        Path {
            leg,
            faced: self.ets().pedestal.origin(),
            gravity: constant(gravity),
            tilt_law: Pairing::of(self.level()).tilt_law(),
        }
    }

    /// Flies a path.
    pub(crate) fn fly(
        &self,
        timing: &Timing,
        path: &Path<R>,
        watch: impl FnMut(&Instant<'_, R>),
    ) -> Tally<R> {
        match self {
            Self::One(a) => rollout(a, timing, path, watch),
            Self::Two(a) => rollout(a, timing, path, watch),
            Self::Three(a) => rollout(a, timing, path, watch),
            Self::Four(a) => rollout(a, timing, path, watch),
            Self::Five(a) => rollout(a, timing, path, watch),
        }
    }
}

fn agents<R: Real, M: QuadrotorModel<R>, C: Controller<R>>(
    mission: &Mission,
    level: Level,
    cost: &Cost<f64>,
    controller: Result<C, ControllerError>,
) -> Result<Agents<R, M, C>, ProblemError> {
    Ok(Agents {
        model: M::build(&mission.vehicle, &level.phenomena())?,
        controller: controller?,
        ets: Ets::new(&mission.station),
        cost: cost.over(),
    })
}
