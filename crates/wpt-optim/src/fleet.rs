//! The pairs of a level's model and its inversion, chosen at run time.

use crate::cost::Cost;
use crate::error::ProblemError;
use crate::mission::{Mission, Timing};
use crate::path::Path;
use crate::rollout::{Agents, Instant, Tally, launched, rollout};
use ets::Ets;
use quad_dynamics::{Level, LevelModel, Snapshot};
use quad_math::{Real, constant};
use quad_ndi::{AnyController, ControlLaw, Law, Leg, LoopDesign, PidSettings, WithPaired};
use std::fmt::Debug;
use std::sync::Arc;

/// Vehicle, controller and station of a level, over one kind of scalar: the level's model under the inversion that belongs to it.
#[derive(Clone, Debug)]
pub(crate) struct Fleet<R: Real> {
    level: Level,
    agents: Arc<dyn Rollout<R>>,
}

/// A flight across the station's field. Its only heap and its only indirect call are outside of the loop over time.
trait Rollout<R: Real>: Debug + Send + Sync {
    fn ets(&self) -> &Ets<R>;
    fn pilot(&self) -> AnyController<R>;
    fn launched(&self, path: &Path<R>) -> Snapshot<R>;
    fn fly(&self, timing: &Timing, path: &Path<R>, watch: &mut dyn FnMut(&Instant<'_, R>)) -> Tally<R>;
}

impl<R: Real, M: LevelModel<R>, C: ControlLaw<R>> Rollout<R> for Agents<R, M, C> {
    fn ets(&self) -> &Ets<R> {
        &self.ets
    }

    fn pilot(&self) -> AnyController<R> {
        C::any(self.controller.into())
    }

    fn launched(&self, path: &Path<R>) -> Snapshot<R> {
        launched(&self.model, path).0
    }

    fn fly(&self, timing: &Timing, path: &Path<R>, watch: &mut dyn FnMut(&Instant<'_, R>)) -> Tally<R> {
        rollout(self, timing, path, watch)
    }
}

/// Everybody of a mission, for whatever level.
struct Build<'a> {
    mission: &'a Mission,
    cost: &'a Cost<f64>,
}

impl<R: Real> WithPaired<R> for Build<'_> {
    type Out = Result<Arc<dyn Rollout<R>>, ProblemError>;

    fn with<M: LevelModel<R>, C: ControlLaw<R>>(self) -> Self::Out {
        Ok(Arc::new(agents::<R, M, C>(self.mission, self.cost)?))
    }
}

impl<R: Real> Fleet<R> {
    /// Everybody of a mission at a level.
    pub(crate) fn build(mission: &Mission, level: Level, cost: &Cost<f64>) -> Result<Self, ProblemError> {
        let agents = Law::visit_paired::<R, _>(level, Build { mission, cost })?;
        Ok(Self { level, agents })
    }

    /// The station.
    pub(crate) fn ets(&self) -> &Ets<R> {
        self.agents.ets()
    }

    /// The controller, as the engine takes it.
    pub(crate) fn pilot(&self) -> AnyController<R> {
        self.agents.pilot()
    }

    /// The vehicle at the start of a path, exactly on it.
    pub(crate) fn launched(&self, path: &Path<R>) -> Snapshot<R> {
        self.agents.launched(path)
    }

    /// The path along a leg, as the level's controller is given it.
    pub(crate) fn path(&self, leg: Leg<R>, gravity: f64) -> Path<R> {
        Path {
            leg,
            faced: self.ets().pedestal.origin(),
            gravity: constant(gravity),
            tilt_law: Law::paired(self.level).tilt_law(),
        }
    }

    /// Flies a path. One implementation for all levels and scalars, whoever watches.
    pub(crate) fn fly(
        &self,
        timing: &Timing,
        path: &Path<R>,
        watch: &mut dyn FnMut(&Instant<'_, R>),
    ) -> Tally<R> {
        self.agents.fly(timing, path, watch)
    }
}

fn agents<R: Real, M: LevelModel<R>, C: ControlLaw<R>>(
    mission: &Mission,
    cost: &Cost<f64>,
) -> Result<Agents<R, M, C>, ProblemError> {
    let design = LoopDesign {
        inversion: mission.settings,
        pid: PidSettings::default(),
    };
    Ok(Agents {
        model: M::build(&mission.vehicle, &M::LEVEL.phenomena())?,
        controller: C::design(&mission.vehicle, &design)?,
        ets: Ets::new(&mission.station),
        cost: cost.over(),
    })
}

#[cfg(test)]
mod tests {
    use super::agents;
    use crate::path::Path;
    use crate::rollout::{Agents, rollout};
    use crate::{Choice, LANES, Problem};
    use nalgebra::SimdValue;
    use quad_dynamics::{Level, Level3};
    use quad_math::{F32x8, constant};
    use quad_ndi::{C3, Law};

    /// Eight flights side by side in single precision.
    #[test]
    fn agree_single_precision_lanes() {
        let problem = Problem::nominal(Choice::Two, 4.0, Level::Three).unwrap();
        let mission = problem.mission();
        let eight: Agents<F32x8, Level3<F32x8>, C3<F32x8>> = agents(mission, &problem.cost).unwrap();
        let starts = [3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5];
        let values = [F32x8::from(starts.map(|x| x as f32)), constant(4.0)];
        let conditions = problem.decisions().iter().map(|d| d.condition);
        let path = Path {
            leg: mission.trajectory(conditions.zip(values)).unwrap(),
            faced: eight.ets.pedestal.origin(),
            gravity: constant(mission.vehicle.environment.gravity),
            tilt_law: Law::C3.tilt_law(),
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
