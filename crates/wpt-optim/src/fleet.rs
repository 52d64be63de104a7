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

    /// Flies a path. One text per level and scalar, whoever watches.
    pub(crate) fn fly(
        &self,
        timing: &Timing,
        path: &Path<R>,
        watch: &mut dyn FnMut(&Instant<'_, R>),
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

#[cfg(test)]
mod tests {
    use super::agents;
    use crate::path::Path;
    use crate::rollout::{Agents, rollout};
    use crate::{Choice, LANES, Pairing, Problem};
    use nalgebra::SimdValue;
    use quad_dynamics::{Level, Level3};
    use quad_math::{F32x8, constant};
    use quad_ndi::C3;

    /// Eight flights side by side in single precision.
    #[test]
    fn agree_single_precision_lanes() {
        let problem = Problem::nominal(Choice::Two, 4.0, Level::Three).unwrap();
        let mission = problem.mission();
        let controller = C3::new(&mission.vehicle, &mission.settings);
        let eight: Agents<F32x8, Level3<F32x8>, C3<F32x8>> =
            agents(mission, Level::Three, &problem.cost, controller).unwrap();
        let starts = [3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5];
        let values = [F32x8::from(starts.map(|x| x as f32)), constant(4.0)];
        let conditions = problem.decisions().iter().map(|d| d.condition);
        let path = Path {
            leg: mission.trajectory(conditions.zip(values)).unwrap(),
            faced: eight.ets.pedestal.origin(),
            gravity: constant(mission.vehicle.environment.gravity),
            tilt_law: Pairing::C3.tilt_law(),
        };
        let tally = rollout(&eight, &problem.timing, &path, &mut |_| ());
        for (lane, x_0) in starts.into_iter().enumerate() {
            let double = problem.evaluate(&[x_0, 4.0]).unwrap().cost;
            let single = f64::from(tally.cost.extract(lane));
            // Positions of some metres are known to 5e-7 m; over 4000 steps rounding adds up to some 1e-5 m and rad, and
            // a spot of 0.1 m to that gives 1e-3 of its square at most.
            assert!((single - double).abs() < 1e-3 * double, "{single} and {double}");
        }
        assert_eq!(F32x8::LANES, 2 * LANES);
    }
}
